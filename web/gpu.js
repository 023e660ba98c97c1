// The WebGPU backend of picture.js. All images share one device.
let asked;

// A promise of the device; null if there is none or after it was lost.
export function gpuDevice() {
  asked ??= request().catch(() => null);
  return asked;
}

async function request() {
  const adapter = await navigator.gpu?.requestAdapter();
  if (!adapter) return null;
  const { maxTextureDimension2D } = adapter.limits; // the default limit is too low for large maps
  const device = await adapter.requestDevice({ requiredLimits: { maxTextureDimension2D } });
  device.lost.then(() => { asked = Promise.resolve(null); });
  return device;
}

// The values as an array of vec4s in the order of `names`.
export function packed(names, values) {
  const numbers = new Float32Array(4 * names.length);
  names.forEach((name, k) => numbers.set([values[name]].flat(), 4 * k));
  return numbers;
}

const kWholeCanvas = `
struct Corner { @builtin(position) at: vec4f, @location(0) place: vec2f }
@vertex fn whole_canvas(@builtin(vertex_index) k: u32) -> Corner {
  let place = vec2f(f32(k & 1u), f32(k >> 1u)) * 2.0;
  return Corner(vec4f(place * 2.0 - 1.0, 0.0, 1.0), place);
}
@fragment fn pixel(corner: Corner) -> @location(0) vec4f { return colour_at(corner.place); }`;

const pixels = ({ wgsl, values, maps }) => `
struct Values { ${values.map(name => `${name}: vec4f`).join(', ')} }
@group(0) @binding(0) var<uniform> v: Values;
${maps.length > 0 ? '@group(0) @binding(1) var smoothly: sampler;' : ''}
${maps.map((name, k) => `@group(0) @binding(${k + 2}) var ${name}: texture_2d<f32>;`).join('\n')}
${wgsl}${kWholeCanvas}`;

// Computes a mip level from the next larger one: each texel is the mean of four.
const kHalved = `
@group(0) @binding(0) var smoothly: sampler;
@group(0) @binding(1) var above: texture_2d<f32>;
fn colour_at(place: vec2f) -> vec4f { return textureSample(above, smoothly, vec2f(place.x, 1.0 - place.y)); }${kWholeCanvas}`;

async function pipelineOf(device, code, format) {
  const module = device.createShaderModule({ code });
  return device.createRenderPipelineAsync({ layout: 'auto', vertex: { module }, fragment: { module, targets: [{ format }] } });
}

// Throws if the shaders do not compile.
export async function gpuPainter(device, canvas, shader) {
  const context = canvas.getContext('webgpu'), format = navigator.gpu.getPreferredCanvasFormat();
  const [pipeline, halved] = await Promise.all([pipelineOf(device, pixels(shader), format), pipelineOf(device, kHalved, 'rgba8unorm')]);
  context.configure({ device, format, alphaMode: 'opaque' });
  const sampler = device.createSampler({ addressModeU: 'repeat', addressModeV: 'repeat', magFilter: 'linear', minFilter: 'linear', mipmapFilter: 'linear' });
  const buffer = device.createBuffer({ size: 16 * shader.values.length, usage: GPUBufferUsage.UNIFORM | GPUBufferUsage.COPY_DST });
  const textures = {};

  function paint(encoder, how, view, resources) {
    const pass = encoder.beginRenderPass({ colorAttachments: [{ view, loadOp: 'clear', storeOp: 'store' }] });
    pass.setPipeline(how);
    pass.setBindGroup(0, device.createBindGroup({ layout: how.getBindGroupLayout(0), entries: resources.map((resource, binding) => ({ binding, resource })) }));
    pass.draw(3);
    pass.end();
  }

  function put(map, { width, height, data }) {
    textures[map]?.destroy();
    const levels = 1 + Math.floor(Math.log2(Math.max(width, height)));
    const texture = textures[map] = device.createTexture({ size: [width, height], mipLevelCount: levels, format: 'rgba8unorm',
      usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST | GPUTextureUsage.RENDER_ATTACHMENT });
    device.queue.writeTexture({ texture }, data, { bytesPerRow: 4 * width }, [width, height]);
    const encoder = device.createCommandEncoder(), level = k => texture.createView({ baseMipLevel: k, mipLevelCount: 1 });
    for (let k = 1; k < levels; ++k) paint(encoder, halved, level(k), [sampler, level(k - 1)]);
    device.queue.submit([encoder.finish()]);
  }
  const nothing = { width: 1, height: 1, data: new Uint8Array(4) };
  for (const map of shader.maps) put(map, nothing);

  return {
    put,
    draw(values) {
      device.queue.writeBuffer(buffer, 0, packed(shader.values, values));
      const encoder = device.createCommandEncoder();
      paint(encoder, pipeline, context.getCurrentTexture().createView(),
        [{ buffer }, ...(shader.maps.length > 0 ? [sampler] : []), ...shader.maps.map(map => textures[map].createView())]);
      device.queue.submit([encoder.finish()]);
    },
  };
}
