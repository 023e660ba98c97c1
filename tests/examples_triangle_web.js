// Runs after the scripts of examples/triangle-web/*.html. Measures the page's normals against those of the analytic
// sheets, and normals of the models beside this page against those that Cotan's own renderer drew with the frame
// triangle (NAME.normals, four floats a pixel) and the same map (map.bytes). drawn(way) draws into floats, bottom row
// first; texels are read without filtering, so that the stored bytes are the input.
const width = 480, height = 240;
document.querySelector('canvas').width = width;
document.querySelector('canvas').height = height;
function fetched(name) {
  const request = new XMLHttpRequest();
  return new Promise((done, fail) => {
    request.open('GET', name);
    request.responseType = 'arraybuffer';
    request.onload = () => done(request.response);
    request.onerror = () => fail(name);
    request.send();
  });
}
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
function degreesBetween(a, b) {
  const cross = Math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
  return Math.atan2(cross, dot(a, b)) * 180 / Math.PI; // NaN is kept
}
// u = |x| + (1 - y)/2, v = 1 - y on the sheet. By hand: grad u = (sign x, -1/2) is the longer with sqrt(5)/2, grad v =
// (0, -1). Null where the ray misses, near a sheet's edge or seam, and near the edge of a texel.
function truth(ray, middle, angle) {
  const c = Math.cos(angle), s = Math.sin(angle), normal = [s, 0, c], along = [c, 0, -s], toMiddle = [middle, 0, -4];
  const depth = dot(normal, toMiddle) / dot(normal, ray);
  const hit = ray.map((r, i) => r * depth - toMiddle[i]), x = dot(hit, along), y = hit[1];
  if (!(Math.abs(x) < 0.99 && Math.abs(y) < 0.99 && Math.abs(x) > 0.01)) return null;
  const column = (Math.abs(x) + (1 - y) / 2) % 1 * mapSize, row = (1 - y) % 1 * mapSize;
  // Corners are snapped to 1/16 of a pixel or finer, and a pixel is up to 6 texels wide here.
  const near = f => Math.abs(f - Math.round(f)) < 0.3;
  if (near(column) || near(row)) return null;
  const at = (Math.floor(row) * mapSize + Math.floor(column)) * 4;
  const m = [0, 1, 2].map(i => Math.max((map[at + i] - 128) / 127, -1) * (i === 1 ? -1 : 1)); // along +v
  const longest = Math.sqrt(1.25), onX = m[0] * Math.sign(x) / longest, onY = (-0.5 * m[0] - m[1]) / longest;
  const side = dot(normal, ray) < 0 ? 1 : -1;
  return [onX * along[0] + m[2] * normal[0], onY, onX * along[2] + m[2] * normal[2]].map(k => k * side);
}
function sheetErrors(pixels) {
  const found = { front: { worst: 0, count: 0 }, back: { worst: 0, count: 0 } };
  for (let row = 0; row < height; ++row)
    for (let column = 0; column < width; ++column) {
      const ray = [(2 * (column + 0.5) / width - 1) * 2 / zoom, (2 * (row + 0.5) / height - 1) / zoom, -1];
      const right = column >= width / 2;
      const expected = right ? truth(ray, 1.2, Math.PI - 0.4) : truth(ray, -1.2, 0.4);
      if (!expected) continue;
      const at = 4 * (row * width + column), degrees = degreesBetween(pixels.subarray(at, at + 3), expected);
      const side = found[right ? 'back' : 'front'];
      side.worst = degrees <= side.worst ? side.worst : degrees; // NaN is kept
      ++side.count;
    }
  return found;
}
// Error of the lit image of the sheets compared with the analytic normals, in 8-bit steps. bytes: rows from the top.
function imageErrors(bytes) {
  const found = { worst: 0, count: 0 }, toLight = [-1, 1.5, 1.5].map(k => k / Math.hypot(1, 1.5, 1.5));
  for (let row = 0; row < height; ++row)
    for (let column = 0; column < width; ++column) {
      const ray = [(2 * (column + 0.5) / width - 1) * 2 / zoom, (1 - 2 * (row + 0.5) / height) / zoom, -1];
      const expected = column >= width / 2 ? truth(ray, 1.2, Math.PI - 0.4) : truth(ray, -1.2, 0.4);
      if (!expected) continue;
      const n = expected.map(k => k / Math.hypot(...expected));
      const level = 255 * (0.1 + 0.9 * Math.max(dot(n, toLight), 0)) ** (1 / 2.2);
      found.worst = Math.max(found.worst, Math.abs(bytes[4 * (row * width + column) + 1] - level));
      ++found.count;
    }
  return found;
}
function modelErrors(pixels, expected) {
  const degrees = [];
  for (let k = 0; k < width * height; ++k) {
    const e = expected.subarray(4 * k, 4 * k + 3), p = pixels.subarray(4 * k, 4 * k + 3);
    if (dot(e, e) > 0.5 && dot(p, p) > 0.5) degrees.push(degreesBetween(p, e));
  }
  degrees.sort((a, b) => a - b);
  return { count: degrees.length, finite: degrees.every(Number.isFinite), median: degrees[degrees.length >> 1],
           most95: degrees[Math.floor(degrees.length * 0.95)] };
}
// The number of pixels covered in both images, and the number that differ or are covered in only one.
function apart(a, b) {
  const found = { pixels: 0, apart: 0 };
  for (let at = 0; at < 4 * width * height; at += 4) {
    const n = a.subarray(at, at + 3), m = b.subarray(at, at + 3), here = dot(n, n) > 0.5, there = dot(m, m) > 0.5;
    found.pixels += here && there;
    found.apart += here !== there || (here && !(degreesBetween(n, m) < 0.06)); // both were rounded to halfs
  }
  return found;
}
// ways: the page's methods; provoking: the corner; models: by name; odd: the number of files odd0, odd1, ..., which all
// look the same.
async function errorsOf(ways, provoking, models, odd, drawn) {
  const found = { sheets: {}, models: {}, odd: [] };
  load(sheets(provoking));
  loadMap(map, mapSize);
  for (const way of ways) found.sheets[way] = sheetErrors(await drawn(way));
  loadMap(new Uint8Array(await fetched('map.bytes')), 128);
  for (const name of models) {
    load(readGlb(await fetched(name + '_' + provoking + '.glb'), provoking));
    const expected = new Float32Array(await fetched(name + '.normals'));
    for (const way of ways) (found.models[name] ||= {})[way] = modelErrors(await drawn(way), expected);
    try {
      readGlb(await fetched(name + '.glb'), provoking);
    } catch (e) {
      found.models[name].refused = e.message;
    }
  }
  for (const way of ways)
    for (let k = 0, first; k < odd; ++k) {
      load(readGlb(await fetched('odd' + k + '_' + provoking + '.glb'), provoking));
      const pixels = Float32Array.from(await drawn(way));
      first ||= pixels;
      found.odd.push(apart(pixels, first));
    }
  return found;
}
function webgl2() {
  if (!gl.getExtension('EXT_color_buffer_float')) return { skipped: 'no float targets' };
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  [[gl.RGBA32F, gl.COLOR_ATTACHMENT0], [gl.DEPTH_COMPONENT32F, gl.DEPTH_ATTACHMENT]].forEach(([format, place]) => {
    gl.bindRenderbuffer(gl.RENDERBUFFER, gl.createRenderbuffer());
    gl.renderbufferStorage(gl.RENDERBUFFER, format, width, height);
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, place, gl.RENDERBUFFER, gl.getParameter(gl.RENDERBUFFER_BINDING));
  });
  return errorsOf(['provoking', 'read'], 'last', modelNames, oddCount, way => {
    gl.activeTexture(gl.TEXTURE0 + units.indexOf('normal_map'));
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    draw(way, true);
    const pixels = new Float32Array(width * height * 4);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, pixels);
    if (gl.getError()) throw new Error('a WebGL error');
    return pixels;
  });
}
async function webgpu() {
  if (!await ready) return { skipped: 'no WebGPU adapter' };
  device.onuncapturederror = e => { throw new Error(e.error.message); };
  const usage = GPUTextureUsage.RENDER_ATTACHMENT | GPUTextureUsage.COPY_SRC;
  const target = device.createTexture({ size: [width, height], format: 'rgba32float', usage });
  const found = await errorsOf(ways(), 'first', modelNames, oddCount, async way => {
    draw(target, true, 'nearest', way);
    return upwards(new Float32Array(await bytesOf(target, 16)));
  });
  found.ways = ways();
  load(sheets('first'));
  loadMap(map, mapSize);
  found.canvas = await canvasErrors(usage);
  return found;
}
// Reads back a texture with `perPixel` bytes a pixel, rows from the top.
async function bytesOf(texture, perPixel) {
  const row = perPixel * width, bytesPerRow = Math.ceil(row / 256) * 256; // alignment required by copies
  const read = device.createBuffer({ size: bytesPerRow * height, usage: GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST });
  const encoder = device.createCommandEncoder();
  encoder.copyTextureToBuffer({ texture }, { buffer: read, bytesPerRow }, [width, height]);
  device.queue.submit([encoder.finish()]);
  await read.mapAsync(GPUMapMode.READ);
  const padded = new Uint8Array(read.getMappedRange()), bytes = new Uint8Array(row * height);
  for (let y = 0; y < height; ++y) bytes.set(padded.subarray(y * bytesPerRow, y * bytesPerRow + row), y * row);
  return bytes.buffer;
}
function upwards(down) {
  const pixels = new Float32Array(down.length), row = 4 * width;
  for (let y = 0; y < height; ++y) pixels.set(down.subarray(y * row, (y + 1) * row), (height - 1 - y) * row);
  return pixels;
}
// The page's own canvas: normals as halfs, and the image that it displays.
async function canvasErrors(usage) {
  const drawn = async (format, showNormals, perPixel) => {
    context.configure({ device, format, usage, alphaMode: 'premultiplied' });
    const texture = context.getCurrentTexture();
    draw(texture, showNormals, 'nearest');
    return bytesOf(texture, perPixel);
  };
  const ofHalf = h => ((h & 0x8000) ? -1 : 1) * ((h >> 10 & 31) ? 2 ** ((h >> 10 & 31) - 15) * (1 + (h & 1023) / 1024)
                                                                    : (h & 1023) * 2 ** -24);
  const halfs = new Uint16Array(await drawn('rgba16float', true, 8));
  const sheets = sheetErrors(upwards(Float32Array.from(halfs, ofHalf)));
  const picture = imageErrors(new Uint8Array(await drawn(navigator.gpu.getPreferredCanvasFormat(), false, 4)));
  return { sheets, picture };
}
(async () => {
  let found;
  try { found = await (measuredPage === 'webgl2' ? webgl2() : webgpu()); } catch (e) { found = { error: String(e) }; }
  parent.postMessage({ page: measuredPage, found }, '*');
})();
