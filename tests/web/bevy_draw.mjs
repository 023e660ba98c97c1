// Draws one triangle over a small target with a fragment shader of StandardMaterial's bindings, and the formula of what
// it should show.

const add = (a, b) => a.map((x, i) => x + b[i]), times = (a, s) => a.map((x) => x * s), dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = (a) => times(a, 1 / Math.sqrt(dot(a, a)));

/** Sheets in world space: x and y of the screen move along `along` and `up`, uv by `u` and `v` for each of the two. */
export const kSheets = {
  plain: { along: [1, 0, 0], up: [0, 1, 0], u: [1, 0], v: [0, -1] },
  'mirrored uv': { along: [1, 0, 0], up: [0, 1, 0], u: [-1, 0], v: [0, -1] },
  'both mirrored': { along: [1, 0, 0], up: [0, 1, 0], u: [-1, 0], v: [0, 1] },
  'sheared and stretched uv': { along: [1, 0.2, 0.1], up: [-0.3, 0.8, 0.4], u: [3, 0.7], v: [0.4, -0.9] },
  'mirrored and sheared uv': { along: [1, 0.2, 0.1], up: [-0.3, 0.8, 0.4], u: [-2, 0.6], v: [0.5, -0.8] },
  'y down': { along: [1, 0, 0], up: [0, -1, 0], u: [1, 0.3], v: [0.2, 1] },
  'seen from behind': { along: [-1, 0, 0.1], up: [0, 1, 0.2], u: [-1, 0.2], v: [0.1, -1] },
  'constant uv': { along: [1, 0, 0], up: [0, 1, 0], u: [0, 0], v: [0, 0] },
};
const kNormal = unit([0.3, -0.2, 1]), kEye = [4, -3, 12];

/** The tangent that glTF stores: t along the growth of u; w such that w n x t is where green points, up in the image. */
function tangentOf({ along, up, u, v }) {
  const area = u[0] * v[1] - u[1] * v[0];
  if (area === 0) return [0, 0, 0, 0];
  const du = add(times(along, v[1] / area), times(up, -v[0] / area)), dv = add(times(along, -u[1] / area), times(up, u[0] / area));
  const t = unit(add(du, times(kNormal, -dot(du, kNormal))));
  return [...t, dot(cross(kNormal, t), dv) < 0 ? 1 : -1];
}
/** The normal that a texel stands for. m: signed. Constant uv have no tangent, and give the mesh's normal. */
export function expected(sheet, m) {
  const [x, y, z, w] = tangentOf(sheet), t = [x, y, z];
  return w === 0 ? kNormal : unit(add(add(times(t, m[0]), times(cross(kNormal, t), w * m[1])), times(kNormal, m[2])));
}

/** The vertex shader of a sheet. back: with the other winding. length: of the normals. */
export function vertexShader(sheet, back, length = 0.9) {
  const { along, up, u, v } = sheet;
  const three = (a) => `vec3f(${a.map(String).join(', ')})`;
  return `struct Out { @builtin(position) position: vec4f, @location(0) world_position: vec4f, @location(1) world_normal: vec3f, @location(2) uv: vec2f, @location(4) world_tangent: vec4f, @location(6) @interpolate(flat) instance_index: u32 }
@vertex fn vertex(@builtin(vertex_index) index: u32) -> Out {
    let i = ${back ? '(3u - index) % 3u' : 'index'};
    let at = vec2f(f32(i32(i & 1u)) * 4.0 - 1.0, f32(i32(i >> 1u)) * 4.0 - 1.0);
    let p = ${three(add(kEye, [0, 0, -5]))} + at.x * ${three(along)} + at.y * ${three(up)};
    return Out(vec4f(at, 0.5, 1.0), vec4f(p, 1.0), ${three(times(kNormal, length))}, vec2f(${u[0]} * at.x + ${u[1]} * at.y, ${v[0]} * at.x + ${v[1]} * at.y),
        vec4f(${tangentOf(sheet).join(', ')}), 0u);
}`;
}

export const degrees = (a, b) => Math.atan2(Math.hypot(...cross(a, b)), dot(a, b)) * (180 / Math.PI);
export const eye = kEye;

/** Where the uniforms of the stand-ins and of Bevy 0.19.1 have what a draw needs, in bytes. */
export const kStandIns = { eye: 0, transform: 16, flags: 64 }, kBevy = { eye: 448, transform: 48, flags: 160 };

/** Runs in the page. jobs: { vertex, fragment, texel, eye, flags, at }; the material is in group 3. Returns the drawn
 * numbers of each, four for a pixel. */
export async function drawn(jobs) {
  const adapter = await navigator.gpu.requestAdapter(), device = await adapter.requestDevice(), results = [];
  const layout = (entries) => device.createBindGroupLayout({ entries: entries.map((e) => ({ visibility: GPUShaderStage.FRAGMENT, ...e })) });
  const textures = [1, 3, 5, 7, 9, 11], samplers = textures.map((i) => i + 1);
  const layouts = [layout([{ binding: 0, buffer: {} }]), layout([]), layout([{ binding: 0, buffer: { type: 'read-only-storage' } }]),
    layout([{ binding: 0, buffer: {} }, ...textures.map((binding) => ({ binding, texture: {} })), ...samplers.map((binding) => ({ binding, sampler: {} }))])];
  const buffer = (usage, fill) => {
    const bytes = new ArrayBuffer(4096), made = device.createBuffer({ size: bytes.byteLength, usage: usage | GPUBufferUsage.COPY_DST });
    fill((at, numbers) => new Float32Array(bytes, at, numbers.length).set(numbers), (at, word) => { new Uint32Array(bytes)[at / 4] = word; });
    device.queue.writeBuffer(made, 0, bytes);
    return { buffer: made };
  };
  for (const { vertex, fragment, texel, eye, flags, at } of jobs) {
    device.pushErrorScope('validation');
    const target = device.createTexture({ size: [8, 8], format: 'rgba32float', usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC });
    const map = device.createTexture({ size: [1, 1], format: 'rgba8unorm', usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST });
    device.queue.writeTexture({ texture: map }, new Uint8Array([...texel, 255]), {}, [1, 1]);
    const view = buffer(GPUBufferUsage.UNIFORM, (put) => put(at.eye, eye));
    const mesh = buffer(GPUBufferUsage.STORAGE, (put, word) => word(132, 0x80000000)); // the flag of a transform that does not mirror
    const material = buffer(GPUBufferUsage.UNIFORM, (put, word) => {
      put(0, [1, 1, 1, 1]);
      put(at.transform, [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]);
      word(at.flags, flags);
    });
    const pipeline = device.createRenderPipeline({ layout: device.createPipelineLayout({ bindGroupLayouts: layouts }), vertex: { module: device.createShaderModule({ code: vertex }) },
      fragment: { module: device.createShaderModule({ code: fragment }), entryPoint: 'fragment', targets: [{ format: 'rgba32float' }] } });
    const groups = [[{ binding: 0, resource: view }], [], [{ binding: 0, resource: mesh }], [{ binding: 0, resource: material },
      ...textures.map((binding) => ({ binding, resource: map.createView() })), ...samplers.map((binding) => ({ binding, resource: device.createSampler() }))]];
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginRenderPass({ colorAttachments: [{ view: target.createView(), loadOp: 'clear', storeOp: 'store' }] });
    pass.setPipeline(pipeline);
    groups.forEach((entries, i) => pass.setBindGroup(i, device.createBindGroup({ layout: layouts[i], entries })));
    pass.draw(3);
    pass.end();
    const read = device.createBuffer({ size: 256 * 8, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
    encoder.copyTextureToBuffer({ texture: target }, { buffer: read, bytesPerRow: 256 }, [8, 8]);
    device.queue.submit([encoder.finish()]);
    const error = await device.popErrorScope();
    if (error) throw new Error(error.message);
    await read.mapAsync(GPUMapMode.READ);
    const all = new Float32Array(read.getMappedRange());
    results.push(Array.from({ length: 8 }, (_, y) => [...all.subarray(64 * y, 64 * y + 32)]).flat());
  }
  return results;
}
