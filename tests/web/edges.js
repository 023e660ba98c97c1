// The page of edges_test.mjs. Draws meshes by WebGL 2 and WebGPU, and measures the normal of each pixel against that of
// the edges of its triangle. Both are made by the same printed function, so only the screen differences can be wrong.
const kSize = 192, kTilted = [0.786, 0.54, 0.905]; // stored: 35 degrees in the direction (3, 0.4)

// 20 floats for each vertex: clip space, position from the eye, normal, uv, the triangle's edges, and their uv.
const kAttributes = [['clip', 4], ['p', 3], ['n', 3], ['uv', 2], ['e1', 3], ['e2', 3], ['duv', 4]];
const kFloats = kAttributes.reduce((sum, [, count]) => sum + count, 0);

const subtract = (a, b) => a.map((x, k) => x - b[k]);
const normalised = v => { const length = Math.hypot(...v); return v.map(x => x / length); };

// The eye looks along -z with a vertical field of view of 53 degrees; no far plane.
const clipOf = ([x, y, z]) => [2 * x, 2 * y, -z - 0.2, -z];

function soupOf(triangles) {
  const data = new Float32Array(triangles.length * 3 * kFloats);
  triangles.forEach((corners, k) => {
    const edges = [1, 2].map(i => subtract(corners[i].p, corners[0].p)), length = Math.hypot(...edges[0]);
    const [e1, e2] = edges.map(e => e.map(x => x / length)); // large ones would be outside the limits of the printed text
    const duv = [1, 2].flatMap(i => subtract(corners[i].uv, corners[0].uv).map(x => x / length));
    corners.forEach((c, i) => data.set([...clipOf(c.p), ...c.p, ...c.n, ...c.uv, ...e1, ...e2, ...duv], (3 * k + i) * kFloats));
  });
  return data;
}

// A sphere of side * side quads with sheared uv, mirrored in one half; turned, so that no edge lies along the pixels.
function sphere(side) {
  const corner = (x, y) => {
    const longitude = 2 * Math.PI * x / side, latitude = Math.PI * (y / side - 0.5) * 0.999;
    const n = [Math.cos(latitude) * Math.cos(longitude), Math.sin(latitude), Math.cos(latitude) * Math.sin(longitude)];
    const turned = [0.8 * n[0] - 0.6 * n[1], 0.6 * n[0] + 0.8 * n[1], n[2]];
    return { p: [turned[0], turned[1], turned[2] - 2.6], n: turned };
  };
  const triangles = [];
  for (let y = 0; y < side; ++y)
    for (let x = 0; x < side; ++x) {
      const flip = x < side / 2 ? 1 : -1;
      const at = (i, j) => ({ ...corner(x + i, y + j), uv: [flip * (x + i) / side * 6 + 0.7 * (y + j) / side, (y + j) / side * 3] });
      triangles.push([at(0, 0), at(1, 1), at(1, 0)], [at(0, 0), at(0, 1), at(1, 1)]);
    }
  return soupOf(triangles);
}

// A plane below the eye that ends at the horizon, in two triangles. Above the horizon it would lie behind the eye, and so
// do the positions that pixels there are given as neighbours of covered ones.
function ground() {
  const far = 1e5, at = (x, z) => ({ p: [x, -1, z], n: [0, 1, 0], uv: [x + 0.5 * z, z] });
  const corners = [at(-far, 0.5), at(far, 0.5), at(far, -far), at(-far, -far)];
  return soupOf([[corners[0], corners[1], corners[2]], [corners[0], corners[2], corners[3]]]);
}

const kScenes = { sphere: sphere(24), small: sphere(110), ground: ground() };

// Each way to shade: scene; samples per pixel; p, n, uv: how they are interpolated; essl, wgsl: statements that set
// `normal`, or `skip`. `pick` differs between neighbours. k is 1, which no compiler knows.
function waysOf(only) {
  const call = 'normal = cotan_perturb_normal(n, p, uv, m);', both = (text) => ({ essl: text, wgsl: text });
  const essl = (text) => text.replaceAll('let q', 'vec3 q').replaceAll('let w', 'vec2 w').replaceAll('i32', 'int').replace('var i', 'int i');
  const same = (wgsl) => ({ essl: essl(wgsl), wgsl });
  const computed = 'let q = p * k; let w = uv * k; normal = cotan_perturb_normal(n, q, w, m);';
  const differences = 'normal = cotan_perturb_normal_from_differences(n, px, py, ux, uy, m);';
  const wgslOf = (kind) => `let px = dpdx${kind}(p); let py = dpdy${kind}(p); let ux = dpdx${kind}(uv); let uy = dpdy${kind}(uv); ${differences}`;
  const all = (how) => ({ samples: 4, p: how, n: how, uv: how });
  const tiny = ', triangles of 2 pixels';
  return Object.fromEntries(Object.entries({
    'one sample': {},
    ['one sample' + tiny]: { scene: 'small' },
    'up to the horizon': { scene: 'ground' },
    'MSAA': { samples: 4 },
    ['MSAA' + tiny]: { scene: 'small', samples: 4 },
    'sample shading': all('sample'),
    ['sample shading' + tiny]: { scene: 'small', ...all('sample') },
    'centroid': all('centroid'),
    ['centroid' + tiny]: { scene: 'small', ...all('centroid') },
    'centroid for uv only': { samples: 4, uv: 'centroid' },
    ['centroid for uv only' + tiny]: { scene: 'small', samples: 4, uv: 'centroid' },
    'coarse differences': { scene: 'small', wgsl: wgslOf('Coarse'), essl: '' },
    'fine differences': { scene: 'small', wgsl: wgslOf('Fine'), essl: '' },
    'discard after the call': same(call + ' if (pick) { discard; }'),
    'discard before the call': same('if (pick) { discard; } ' + call),
    'in an if': same(`if (pick) { ${call} } else { skip = true; }`),
    'in an if, of what it computes': same(`if (pick) { ${computed} } else { skip = true; }`),
    'after a return': { essl: essl(`if (pick) { o = vec4(0.0); return; } ${computed}`), wgsl: `if (pick) { return vec4f(0.0); } ${computed}` },
    'in a loop': same(`for (var i = 0; i < 4; i++) { if (i >= i32(x) % 4) { break; } ${computed} } skip = i32(x) % 4 == 0;`),
    'differences before an if': {
      essl: `vec3 px = dFdx(p), py = dFdy(p); vec2 ux = dFdx(uv), uy = dFdy(uv); if (pick) { ${differences} } else { skip = true; }`,
      wgsl: wgslOf('').replace(differences, `if (pick) { ${differences} } else { skip = true; }`),
    },
    'normalised position': same('normal = cotan_perturb_normal(n, normalize(p), uv, m);'),
    'constant position': same('normal = cotan_perturb_normal(n, p * 0.0 + vec3(0.0, 0.0, -1.0), uv, m);'),
  }).filter(([name]) => !only || only.includes(name)).map(([name, way]) => [name, { scene: 'sphere', ...both(call), ...way }]));
}

// values: for each sample its error in degrees, 1 if it is covered, the number of its triangle, and 1 if the normal is
// that of the surface. counts: which samples count, all without it. broken: samples without a number.
function statisticsOf(values, counts = () => true) {
  const errors = [];
  let broken = 0, plain = 0;
  for (let k = 0; k < values.length; k += 4) {
    const covered = values[k + 1];
    if (covered === 0 || !counts(k / 4)) continue;
    plain += values[k + 3] / covered;
    if (values[k] >= 0) errors.push(values[k] / covered);
    else ++broken;
  }
  const sum = errors.reduce((a, b) => a + b, 0), count = errors.length + broken;
  return { count, mean: sum / errors.length, worst: errors.reduce((a, b) => Math.max(a, b), 0), broken, plain: plain / count };
}

function webgl2(text, only) {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (!gl) return { skipped: 'no WebGL 2' };
  if (!gl.getExtension('EXT_color_buffer_float')) return { skipped: 'no float targets' };
  const info = gl.getExtension('WEBGL_debug_renderer_info');
  const head = '#version 300 es\nprecision highp float;\nprecision highp int;\n';
  const compile = (kind, source, name) => {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(`${name}: ${gl.getShaderInfoLog(shader)}`);
    return shader;
  };
  const buffers = Object.fromEntries(Object.entries(kScenes).map(([name, data]) => {
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    return [name, buffer];
  }));
  const targetOf = samples => {
    const target = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, target);
    for (const [attachment, format] of [[gl.COLOR_ATTACHMENT0, samples ? gl.RGBA16F : gl.RGBA32F], [gl.DEPTH_ATTACHMENT, gl.DEPTH_COMPONENT24]]) {
      const buffer = gl.createRenderbuffer();
      gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
      gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples, format, kSize, kSize);
      gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
    }
    return target;
  };
  const targets = { 0: targetOf(0), 4: targetOf(4) };
  const resolved = gl.createFramebuffer(), texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA16F, kSize, kSize);
  gl.bindFramebuffer(gl.FRAMEBUFFER, resolved);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  gl.viewport(0, 0, kSize, kSize);
  gl.enable(gl.DEPTH_TEST);
  const found = {};
  for (const [name, way] of Object.entries(waysOf(only))) {
    if (way.essl === '' || way.p === 'sample') continue; // WebGL 2 has neither
    const samples = way.samples ?? 0, how = v => (way[v] ? way[v] + ' ' : '');
    const outs = side => `${how('p')}${side} vec3 p; ${how('n')}${side} vec3 n; ${how('uv')}${side} vec2 uv;\nflat ${side} vec3 e1, e2; flat ${side} vec4 duv;\n`;
    const vertex = head + kAttributes.map(([a, count], k) => `layout(location = ${k}) in vec${count} ${a}_in;\n`).join('') + outs('out')
      + 'void main() { gl_Position = clip_in; ' + kAttributes.slice(1).map(([a]) => `${a} = ${a}_in; `).join('') + '}';
    const fragment = head + text + outs('in') + `out vec4 o;\nuniform float k;\nvoid main() {
      float x = gl_FragCoord.x, y = gl_FragCoord.y; bool pick = (int(x) + int(y)) % 2 == 0, skip = false;
      vec3 m = vec3(${kTilted}), normal = vec3(0.0);
      ${way.essl}
      if (skip) { o = vec4(0.0); return; }
      vec3 truth = cotan_perturb_normal_from_differences(n, e1, e2, duv.xy, duv.zw, m);
      float angle = 2.0 * degrees(asin(min(1.0, 0.5 * length(normal - truth))));
      o = vec4(angle, 1.0, 0.0, length(normal - normalize(n)) < 0.01 ? 1.0 : 0.0); }`;
    const program = gl.createProgram();
    gl.attachShader(program, compile(gl.VERTEX_SHADER, vertex, name));
    gl.attachShader(program, compile(gl.FRAGMENT_SHADER, fragment, name));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(`${name}: ${gl.getProgramInfoLog(program)}`);
    gl.useProgram(program);
    gl.uniform1f(gl.getUniformLocation(program, 'k'), 1);
    gl.bindBuffer(gl.ARRAY_BUFFER, buffers[way.scene]);
    let offset = 0;
    kAttributes.forEach(([, count], k) => {
      gl.enableVertexAttribArray(k);
      gl.vertexAttribPointer(k, count, gl.FLOAT, false, kFloats * 4, offset * 4);
      offset += count;
    });
    gl.bindFramebuffer(gl.FRAMEBUFFER, targets[samples]);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    gl.drawArrays(gl.TRIANGLES, 0, kScenes[way.scene].length / kFloats);
    if (samples) {
      gl.bindFramebuffer(gl.READ_FRAMEBUFFER, targets[samples]);
      gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, resolved);
      gl.blitFramebuffer(0, 0, kSize, kSize, 0, 0, kSize, kSize, gl.COLOR_BUFFER_BIT, gl.NEAREST);
      gl.bindFramebuffer(gl.FRAMEBUFFER, resolved);
    }
    const read = new Float32Array(4 * kSize * kSize);
    gl.readPixels(0, 0, kSize, kSize, gl.RGBA, gl.FLOAT, read);
    found[name] = statisticsOf(read);
  }
  if (gl.getError()) throw new Error('WebGL error');
  return { driver: info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : 'unknown', found };
}

async function webgpu(text, only) {
  const adapter = navigator.gpu && await navigator.gpu.requestAdapter();
  if (!adapter) return { skipped: 'no WebGPU adapter' };
  const device = await adapter.requestDevice(), errors = [];
  device.addEventListener('uncapturederror', e => errors.push(e.error.message));
  const U = GPUBufferUsage;
  const upload = data => {
    const buffer = device.createBuffer({ size: data.byteLength, usage: U.VERTEX | U.UNIFORM | U.COPY_DST });
    device.queue.writeBuffer(buffer, 0, data);
    return buffer;
  };
  const buffers = Object.fromEntries(Object.entries(kScenes).map(([name, data]) => [name, upload(data)])), one = upload(new Float32Array([1, 0, 0, 0]));
  const T = GPUTextureUsage;
  const readerOf = samples => device.createShaderModule({ code: `@group(0) @binding(0) var drawn: ${samples > 1 ? 'texture_multisampled_2d' : 'texture_2d'}<f32>;
    @group(0) @binding(1) var<storage, read_write> out: array<vec4f>;
    @compute @workgroup_size(8, 8) fn main(@builtin(global_invocation_id) id: vec3u) {
      for (var s = 0u; s < ${samples}u; s++) { out[(id.y * ${kSize}u + id.x) * ${samples}u + s] = textureLoad(drawn, vec2i(id.xy), ${samples > 1 ? 'i32(s)' : '0'}); } }` });
  const readers = {};
  const found = {};
  for (const [name, way] of Object.entries(waysOf(only))) {
    const samples = way.samples ?? 1, format = samples > 1 ? 'rgba16float' : 'rgba32float';
    const how = v => (way[v] ? `@interpolate(perspective, ${way[v]}) ` : '');
    const code = 'diagnostic(off, derivative_uniformity);\n' + text + `
    struct Seen { @builtin(position) at: vec4f, @location(0) ${how('p')}p: vec3f, @location(1) ${how('n')}n: vec3f, @location(2) ${how('uv')}uv: vec2f,
      @location(3) @interpolate(flat) e1: vec3f, @location(4) @interpolate(flat) e2: vec3f, @location(5) @interpolate(flat) duv: vec4f, @location(6) @interpolate(flat) number: f32 }
    @group(0) @binding(0) var<uniform> ones: vec4f;
    @vertex fn place(@location(0) clip: vec4f, @location(1) p: vec3f, @location(2) n: vec3f, @location(3) uv: vec2f, @location(4) e1: vec3f,
      @location(5) e2: vec3f, @location(6) duv: vec4f, @builtin(vertex_index) index: u32) -> Seen {
      return Seen(clip, p, n, uv, e1, e2, duv, f32(index / 3u % 2000u) + 1.0); }
    @fragment fn shade(seen: Seen) -> @location(0) vec4f {
      let p = seen.p; let n = seen.n; let uv = seen.uv; let k = ones.x; let x = seen.at.x; let pick = (i32(x) + i32(seen.at.y)) % 2 == 0;
      let m = vec3f(${kTilted}); var skip = false; var normal = vec3f(0.0);
      ${way.wgsl}
      if (skip) { return vec4f(0.0); }
      let truth = cotan_perturb_normal_from_differences(n, seen.e1, seen.e2, seen.duv.xy, seen.duv.zw, m);
      let angle = 2.0 * degrees(asin(min(1.0, 0.5 * length(normal - truth))));
      return vec4f(angle, 1.0, seen.number, select(0.0, 1.0, length(normal - normalize(n)) < 0.01)); }`;
    const module = device.createShaderModule({ code });
    for (const message of (await module.getCompilationInfo()).messages)
      if (message.type === 'error') throw new Error(`${name}: line ${message.lineNum}: ${message.message}`);
    let offset = 0;
    const attributes = kAttributes.map(([, count], shaderLocation) => {
      const attribute = { format: `float32x${count}`, offset: offset * 4, shaderLocation };
      offset += count;
      return attribute;
    });
    const pipeline = device.createRenderPipeline({ layout: 'auto', multisample: { count: samples },
      depthStencil: { format: 'depth32float', depthCompare: 'less', depthWriteEnabled: true },
      vertex: { module, entryPoint: 'place', buffers: [{ arrayStride: kFloats * 4, attributes }] },
      fragment: { module, entryPoint: 'shade', targets: [{ format }] } });
    const target = usage => device.createTexture({ size: [kSize, kSize], format: usage === 'depth' ? 'depth32float' : format, sampleCount: samples, usage: T.RENDER_ATTACHMENT | T.TEXTURE_BINDING });
    const color = target('color'), depth = target('depth');
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginRenderPass({ colorAttachments: [{ view: color.createView(), loadOp: 'clear', storeOp: 'store' }],
      depthStencilAttachment: { view: depth.createView(), depthLoadOp: 'clear', depthClearValue: 1, depthStoreOp: 'discard' } });
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries: [{ binding: 0, resource: { buffer: one } }] }));
    pass.setVertexBuffer(0, buffers[way.scene]);
    pass.draw(kScenes[way.scene].length / kFloats);
    pass.end();
    const bytes = kSize * kSize * samples * 16;
    const out = device.createBuffer({ size: bytes, usage: U.STORAGE | U.COPY_SRC }), read = device.createBuffer({ size: bytes, usage: U.COPY_DST | U.MAP_READ });
    readers[samples] ??= device.createComputePipeline({ layout: 'auto', compute: { module: readerOf(samples), entryPoint: 'main' } });
    const compute = encoder.beginComputePass();
    compute.setPipeline(readers[samples]);
    compute.setBindGroup(0, device.createBindGroup({ layout: readers[samples].getBindGroupLayout(0), entries: [{ binding: 0, resource: color.createView() }, { binding: 1, resource: { buffer: out } }] }));
    compute.dispatchWorkgroups(kSize / 8, kSize / 8);
    compute.end();
    encoder.copyBufferToBuffer(out, 0, read, 0, bytes);
    device.queue.submit([encoder.finish()]);
    await read.mapAsync(GPUMapMode.READ);
    const values = new Float32Array(read.getMappedRange().slice(0));
    // A pixel that more than one triangle covers, or none in part.
    const isEdge = samples === 1 ? undefined : at => {
      const first = at - at % samples;
      for (let s = 1; s < samples; ++s)
        if (values[4 * (first + s) + 2] !== values[4 * first + 2]) return true;
      return false;
    };
    found[name] = statisticsOf(values, isEdge);
    if (errors.length) throw new Error(`${name}: ${errors[0]}`);
  }
  const i = adapter.info;
  return { driver: `${i.vendor} ${i.architecture} ${i.device} ${i.description}`.trim(), found };
}

// texts: { essl, wgsl }, printed by cotan shader. only: names of ways, all without it.
globalThis.measureEdges = async (texts, only) => {
  const caught = async run => { try { return await run(); } catch (e) { return { error: String(e) }; } };
  return { webgl2: await caught(() => webgl2(texts.essl, only)), webgpu: await caught(() => webgpu(texts.wgsl, only)) };
};
