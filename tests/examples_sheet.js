// Shared by the pages for three.js and Babylon.js: how far normals are from those of the sheet of the examples, drawn with
// its texels unfiltered. Right-handed axes, the eye in the origin looking along -z; the sheet is turned about y by
// `angle`, moved to `place` and scaled by `scaleX` in x. pixels: RGBA floats, the first row at the picture's bottom;
// up: -1 where that row is the top; zoom: 1 / tan(half the field of view). expected: in place of the analytic sheet's,
// normals laid out like `pixels`. above: what is lower than this in y is left out. chart: u = chart[0] |x| + chart[1] y +
// chart[2], v likewise with the next three; green points along v. frame: 'cotangent', or 'orthonormal' (tangent first).
// oneSided: back faces keep the front's normal. half: 1 for the plain half only, -1 for the mirrored. Degrees, the largest
// and the mean.
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
      // More than the 2x2 pixels that differences are taken over, and the snapping of corners to 1/16 of a pixel.
      if (!(Math.abs(x) < 0.97 && Math.abs(y) < 0.97 && Math.abs(x) > 0.03 && x * half >= 0)) continue;
      if (y + place[1] < above + 0.03) continue;
      const turns = f => f - Math.floor(f);
      const u = turns(chart[0] * Math.abs(x) + chart[1] * y + chart[2]) * texelCount;
      const v = turns(chart[3] * Math.abs(x) + chart[4] * y + chart[5]) * texelCount;
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
      worst = degrees <= worst ? worst : degrees; // a NaN stays
      sum += degrees;
      ++count;
    }
  return { worst, mean: sum / count, count };
}

// The two covectors of a chart in the sheet's plane, where x has this sign; zeros where it is constant.
function chartFrame(chart, sign, frame) {
  const u = [chart[0] * sign, chart[1]], v = [chart[3] * sign, chart[4]];
  if (frame === 'cotangent') {
    const longest = Math.max(Math.hypot(...u), Math.hypot(...v)) || 1;
    return [u.map(c => c / longest), v.map(c => c / longest)];
  }
  const turned = Math.sign(u[0] * v[1] - u[1] * v[0]); // dP/du is at right angles to the gradient of v
  const t = [v[1], -v[0]].map(c => turned * c / (Math.hypot(...v) || 1));
  return [t, [-t[1] * turned, t[0] * turned]];
}

// Texels of four by four domes, RGBA of 8 bits, read as 2c - 1, green along v.
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

const greenTurned = texels => texels.map((x, i) => (i % 4 === 1 ? 255 - x : x));

// x, y, u and v of the sheet's four triangles, corner by corner; the first six are the mirrored half.
function sheetCorners(chart) {
  const halves = [[[-1, 1], [-1, -1], [0, 1], [0, 1], [-1, -1], [0, -1]], [[0, 1], [0, -1], [1, 1], [1, 1], [0, -1], [1, -1]]];
  return halves.flat().map(([x, y]) =>
    [x, y, chart[0] * Math.abs(x) + chart[1] * y + chart[2], chart[3] * Math.abs(x) + chart[4] * y + chart[5]]);
}

// A file from the disk, which fetch() does not read. type: 'text' or 'arraybuffer'.
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
