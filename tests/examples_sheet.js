// Shared by the pages for three.js and Babylon.js. Returns the largest and the mean error, in degrees, of normals drawn
// on the examples' sheet with unfiltered texels. Axes are right-handed, with the eye at the origin looking along -z.
// The sheet is rotated about y by `angle`, moved to `place` and scaled by `scaleX` in x. pixels: RGBA floats, bottom
// row first; up: -1 if the top row is first; zoom: 1 / tan(half the field of view); expected: normals laid out like
// `pixels`, which replace the analytic ones; above: points lower than this in y are skipped; chart: u = chart[0] |x| +
// chart[1] y + chart[2], and v likewise with the next three, green along v; frame: 'cotangent', or 'orthonormal'
// (tangent first); oneSided: back faces keep the front's normal; half: 1 for the unmirrored half only, -1 for the
// mirrored.
function sheetErrors({ pixels, size, texels, texelCount, place, angle, scaleX, up, zoom, expected, above = -Infinity,
                       chart = [1, 0, 0, 0, 1, 1], frame = 'cotangent', oneSided, half = 0 }) {
  const c = Math.cos(angle), s = Math.sin(angle);
  const along = [c * scaleX, 0, -s * scaleX], normal = [s, 0, c];
  let worst = 0, sum = 0, count = 0;
  for (let row = 0; row < size; ++row)
    for (let column = 0; column < size; ++column) {
      const ray = [(2 * (column + 0.5) / size - 1) / zoom, (2 * (row + 0.5) / size - 1) / zoom * up, -1];
      const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
      const facing = dot(normal, ray), depth = dot(normal, place) / facing;
      const hit = ray.map((r, i) => r * depth - place[i]);
      const x = dot(hit, along), y = hit[1];
      // Margins for the 2x2 pixels that differences use and the snapping of corners to 1/16 of a pixel.
      if (!(Math.abs(x) < 0.97 && Math.abs(y) < 0.97 && Math.abs(x) > 0.03 && x * half >= 0)) continue;
      if (y + place[1] < above + 0.03) continue;
      const fractional = f => f - Math.floor(f);
      const u = fractional(chart[0] * Math.abs(x) + chart[1] * y + chart[2]) * texelCount;
      const v = fractional(chart[3] * Math.abs(x) + chart[4] * y + chart[5]) * texelCount;
      const near = f => Math.abs(f - Math.round(f)) < 0.2;
      if (near(u) || near(v)) continue;
      const at = (Math.floor(v) * texelCount + Math.floor(u)) * 4;
      const m = [0, 1, 2].map(i => texels[at + i] / 127.5 - 1);
      const side = facing < 0 || oneSided ? 1 : -1; // a thin sheet: the back's normal is the front's, negated
      const [t, b] = chartFrame(chart, Math.sign(x), frame);
      const n = expected ? expected.subarray((row * size + column) * 4, (row * size + column) * 4 + 3)
        : [0, 1, 2].map(i => side * ((m[0] * t[0] + m[1] * b[0]) * along[i] + (m[0] * t[1] + m[1] * b[1]) * (i === 1) + m[2] * normal[i]));
      const got = pixels.subarray((row * size + column) * 4, (row * size + column) * 4 + 3);
      const cross = Math.hypot(n[1] * got[2] - n[2] * got[1], n[2] * got[0] - n[0] * got[2], n[0] * got[1] - n[1] * got[0]);
      const unit = Math.abs(Math.hypot(...got) - 1) < 0.02;
      const degrees = unit ? Math.atan2(cross, dot(n, got)) * 180 / Math.PI : NaN;
      worst = degrees <= worst ? worst : degrees; // NaN is kept
      sum += degrees;
      ++count;
    }
  return { worst, mean: sum / count, count };
}

// The two covectors of a chart in the plane of the sheet where x has this sign; zeros where the chart is constant.
function chartFrame(chart, sign, frame) {
  const u = [chart[0] * sign, chart[1]], v = [chart[3] * sign, chart[4]];
  if (frame === 'cotangent') {
    const longest = Math.max(Math.hypot(...u), Math.hypot(...v)) || 1;
    return [u.map(c => c / longest), v.map(c => c / longest)];
  }
  const handedness = Math.sign(u[0] * v[1] - u[1] * v[0]); // dP/du is perpendicular to the gradient of v
  const t = [v[1], -v[0]].map(c => handedness * c / (Math.hypot(...v) || 1));
  return [t, [-t[1] * handedness, t[0] * handedness]];
}

// Texels of four by four domes, 8-bit RGBA, decoded as 2c - 1, green along v.
function domeTexels(count) {
  const texels = new Uint8Array(count * count * 4);
  for (let row = 0; row < count; ++row)
    for (let column = 0; column < count; ++column) {
      const x = (column + 0.5) / count * 4 % 2 - 1, y = (row + 0.5) / count * 4 % 2 - 1;
      const n = Math.hypot(x, y) < 0.8 ? [x, y, Math.sqrt(1 - x * x - y * y)] : [0, 0, 1];
      texels.set([...n.map(c => Math.round(127.5 * c + 127.5)), 255], (row * count + column) * 4);
    }
  return texels;
}

// Two one-texel maps, decoded as 2c - 1: flat, and tilted by 45 degrees along u.
const twoTexels = [[128, 128, 255, 255], [218, 128, 218, 255]];

// Degrees at the centres of the left and the right half between the drawn normals and those of `texels` on a plane that
// faces the eye, with u to the right and v up. pixels: RGBA floats of width x height.
function halvesErrors(pixels, width, height, texels = twoTexels) {
  return texels.map((texel, half) => {
    const at = 4 * (Math.floor(height / 2) * width + Math.floor(width * (half + 0.5) / 2)), got = pixels.subarray(at, at + 3);
    const m = [0, 1, 2].map(i => texel[i] / 127.5 - 1);
    const dot = m[0] * got[0] + m[1] * got[1] + m[2] * got[2];
    const cross = Math.hypot(m[1] * got[2] - m[2] * got[1], m[2] * got[0] - m[0] * got[2], m[0] * got[1] - m[1] * got[0]);
    return Math.atan2(cross, dot) * 180 / Math.PI;
  });
}

const greenFlipped = texels => texels.map((x, i) => (i % 4 === 1 ? 255 - x : x));

// x, y, u and v of the sheet's four triangles, corner by corner; the first six corners are the mirrored half.
function sheetCorners(chart) {
  const halves = [[[-1, 1], [-1, -1], [0, 1], [0, 1], [-1, -1], [0, -1]], [[0, 1], [0, -1], [1, 1], [1, 1], [0, -1], [1, -1]]];
  return halves.flat().map(([x, y]) =>
    [x, y, chart[0] * Math.abs(x) + chart[1] * y + chart[2], chart[3] * Math.abs(x) + chart[4] * y + chart[5]]);
}

// Loads a file from the disk, which fetch() refuses. type: 'text' or 'arraybuffer'.
function loadFile(url, type) {
  const request = new XMLHttpRequest();
  return new Promise((done, fail) => {
    request.open('GET', url);
    request.responseType = type;
    request.onload = () => done(request.response);
    request.onerror = () => fail(new Error(url));
    request.send();
  });
}
