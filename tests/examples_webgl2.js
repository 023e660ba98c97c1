// Runs after the script of examples/webgl2. Returns the largest angle between the page's normals and those of the
// analytic sheet over the pixels of a float target. Texels are read without filtering, so that the stored bytes are the
// input.
function report() {
  if (!gl.getExtension('EXT_color_buffer_float')) return { skipped: 'no float targets' };
  const width = gl.drawingBufferWidth, height = gl.drawingBufferHeight, aspect = width / height;
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  const mapBinding = gl.getParameter(gl.TEXTURE_BINDING_2D);
  const target = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, target);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, width, height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
  gl.bindTexture(gl.TEXTURE_2D, mapBinding);
  const result = {};
  for (const up of [1, -1]) {
    draw(true, up);
    const pixels = new Float32Array(width * height * 4);
    gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, pixels);
    const side = { front: { worst: 0, count: 0 }, back: { worst: 0, count: 0 } };
    for (let y = 0; y < height; ++y)
      for (let x = 0; x < width; ++x) {
        const got = pixels.subarray((y * width + x) * 4, (y * width + x) * 4 + 4);
        if (got[3] === 0) continue;
        const expected = truth((2 * (x + 0.5) / width - 1) * aspect / zoom, (2 * (y + 0.5) / height - 1) * up / zoom);
        if (!expected) continue;
        const n = expected.normal;
        const degrees = Math.atan2(
          Math.hypot(n[1] * got[2] - n[2] * got[1], n[2] * got[0] - n[0] * got[2], n[0] * got[1] - n[1] * got[0]),
          n[0] * got[0] + n[1] * got[1] + n[2] * got[2]) * 180 / Math.PI;
        const s = side[expected.side];
        s.worst = degrees <= s.worst ? s.worst : degrees; // NaN is kept
        ++s.count;
      }
    result[up > 0 ? 'upright' : 'flipped'] = side;
  }
  return result;
}
// The normal that the ray (rx, ry, -1) from the eye hits, or null near an edge of a texel, quad or the mirror line.
function truth(rx, ry) {
  for (const { place, angle } of views) {
    const c = Math.cos(angle), s = Math.sin(angle);
    const normal = [s, 0, c], along = [c, 0, -s];           // the sheet's z and x axes in the world
    const ray = [rx, ry, -1];
    const toPlace = place.map((p, i) => p - eye[i]);
    const facing = normal[0] * ray[0] + normal[2] * ray[2];
    const depth = (normal[0] * toPlace[0] + normal[2] * toPlace[2]) / facing;
    const hit = ray.map((r, i) => r * depth - toPlace[i]);  // from the sheet's centre
    const x = hit[0] * along[0] + hit[2] * along[2], y = hit[1];
    // 0.02 exceeds the 2x2 pixels that differences use.
    if (Math.abs(x) > 0.98 || Math.abs(y) > 0.98 || Math.abs(x) < 0.02) continue;
    const column = Math.abs(x) * mapSize, row = (1 - y) % 1 * mapSize;
    // Corners are snapped to 1/16 of a pixel or finer, and a pixel is up to 3 texels wide: 0.1 of a texel each way.
    const near = f => Math.abs(f - Math.round(f)) < 0.2;
    if (near(column) || near(row)) return null;
    const at = (Math.floor(row) * mapSize + Math.floor(column)) * 4;
    // The stored vector: red along +u, away from the centre; green against +v, upwards.
    const m = [0, 1, 2].map(i => Math.max((map[at + i] - 128) / 127, -1));
    const mx = m[0] * Math.sign(x), sign = facing < 0 ? 1 : -1;
    const v = [mx * along[0] + m[2] * normal[0], m[1], mx * along[2] + m[2] * normal[2]].map(k => k * sign);
    return { normal: v, side: facing < 0 ? 'front' : 'back' };
  }
  return null;
}
let found;
try { found = report(); } catch (e) { found = { error: String(e) }; }
parent.postMessage({ page: 'webgl2', found }, '*');
