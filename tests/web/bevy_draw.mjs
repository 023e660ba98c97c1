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

/** The normal that glTF wants: t along the growth of u, b where green points, up in the image. m: signed. Constant uv
 * have no t and b. */
export function expected({ along, up, u, v }, m) {
  const area = u[0] * v[1] - u[1] * v[0];
  if (area === 0) return kNormal;
  const du = add(times(along, v[1] / area), times(up, -v[0] / area)), dv = add(times(along, -u[1] / area), times(up, u[0] / area));
  const t = unit(add(du, times(kNormal, -dot(du, kNormal)))), b = cross(kNormal, t);
  return unit(add(add(times(t, m[0]), times(b, dot(b, dv) < 0 ? m[1] : -m[1])), times(kNormal, m[2])));
}

/** The vertex shader of a sheet. back: with the other winding. */
export function vertexShader({ along, up, u, v }, back) {
  const three = (a) => `vec3f(${a.map(String).join(', ')})`;
  return `struct Out { @builtin(position) position: vec4f, @location(0) world_position: vec4f, @location(1) world_normal: vec3f, @location(2) uv: vec2f }
@vertex fn vertex(@builtin(vertex_index) index: u32) -> Out {
    let i = ${back ? '(3u - index) % 3u' : 'index'};
    let at = vec2f(f32(i32(i & 1u)) * 4.0 - 1.0, f32(i32(i >> 1u)) * 4.0 - 1.0);
    let p = ${three(add(kEye, [0, 0, -5]))} + at.x * ${three(along)} + at.y * ${three(up)};
    return Out(vec4f(at, 0.5, 1.0), vec4f(p, 1.0), ${three(times(kNormal, 0.9))}, vec2f(${u[0]} * at.x + ${u[1]} * at.y, ${v[0]} * at.x + ${v[1]} * at.y));
}`;
}

export const degrees = (a, b) => Math.atan2(Math.hypot(...cross(a, b)), dot(a, b)) * (180 / Math.PI);
export const eye = kEye;

/** Runs in the page. jobs: { vertex, fragment, texel, eye, flags }. Returns the drawn numbers, four for each pixel. */
export async function drawn(jobs) {
  const adapter = await navigator.gpu.requestAdapter(), device = await adapter.requestDevice(), results = [];
  device.onuncapturederror = (event) => { throw new Error(event.error.message); };
  for (const { vertex, fragment, texel, eye, flags } of jobs) {
    device.pushErrorScope('validation');
    const target = device.createTexture({ size: [8, 8], format: 'rgba32float', usage: GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC });
    const map = device.createTexture({ size: [1, 1], format: 'rgba8unorm', usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST });
    device.queue.writeTexture({ texture: map }, new Uint8Array([...texel, 255]), {}, [1, 1]);
    const uniform = (bytes) => {
      const buffer = device.createBuffer({ size: bytes.byteLength, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
      device.queue.writeBuffer(buffer, 0, bytes);
      return { buffer };
    };
    const material = new Float32Array(20);
    material[4] = material[9] = material[14] = 1; // uv_transform
    new Uint32Array(material.buffer)[16] = flags;
    const pipeline = device.createRenderPipeline({ layout: 'auto', vertex: { module: device.createShaderModule({ code: vertex }) },
      fragment: { module: device.createShaderModule({ code: fragment }), entryPoint: 'fragment', targets: [{ format: 'rgba32float' }] } });
    const group = (index, entries) => device.createBindGroup({ layout: pipeline.getBindGroupLayout(index), entries });
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginRenderPass({ colorAttachments: [{ view: target.createView(), loadOp: 'clear', storeOp: 'store' }] });
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, group(0, [{ binding: 0, resource: uniform(new Float32Array([...eye, 0])) }]));
    pass.setBindGroup(1, group(1, [{ binding: 0, resource: uniform(material) }, { binding: 9, resource: map.createView() }, { binding: 10, resource: device.createSampler() }]));
    pass.draw(3);
    pass.end();
    const buffer = device.createBuffer({ size: 256 * 8, usage: GPUBufferUsage.COPY_DST | GPUBufferUsage.MAP_READ });
    encoder.copyTextureToBuffer({ texture: target }, { buffer, bytesPerRow: 256 }, [8, 8]);
    device.queue.submit([encoder.finish()]);
    const error = await device.popErrorScope();
    if (error) throw new Error(error.message);
    await buffer.mapAsync(GPUMapMode.READ);
    const all = new Float32Array(buffer.getMappedRange());
    results.push(Array.from({ length: 8 }, (_, y) => [...all.subarray(64 * y, 64 * y + 32)]).flat());
  }
  return results;
}
