// Shared by the pages for three.js and Babylon.js: how far normals are from those of the sheet of the examples, drawn with
// its texels unfiltered. Right-handed axes, the eye in the origin looking along -z; the sheet is turned about y by
// `angle`, moved to `place` and scaled by `scaleX` in x. pixels: RGBA floats, the first row at the picture's bottom;
// up: -1 where that row is the top; zoom: 1 / tan(half the field of view). expected: in place of the analytic sheet's,
// normals laid out like `pixels`. above: what is lower than this in y is left out. Degrees, the largest and the mean.
function sheetErrors({ pixels, size, texels, texelCount, place, angle, scaleX, up, zoom, expected, above = -Infinity }) {
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
      if (!(Math.abs(x) < 0.97 && Math.abs(y) < 0.97 && Math.abs(x) > 0.03)) continue;
      if (y + place[1] < above + 0.03) continue;
      const u = Math.abs(x) * texelCount, v = (y + 1) % 1 * texelCount;
      const near = f => Math.abs(f - Math.round(f)) < 0.2;
      if (near(u) || near(v)) continue;
      const at = (Math.floor(v) * texelCount + Math.floor(u)) * 4;
      const m = [0, 1, 2].map(i => texels[at + i] / 127.5 - 1);
      const side = facing < 0 ? 1 : -1; // a thin sheet: the back's normal is the front's, negated
      const n = expected ? expected.subarray((row * size + column) * 4, (row * size + column) * 4 + 3)
        : [0, 1, 2].map(i => side * (m[0] * Math.sign(x) * along[i] + m[1] * (i === 1) + m[2] * normal[i]));
      const got = pixels.subarray((row * size + column) * 4, (row * size + column) * 4 + 3);
      const cross = Math.hypot(n[1] * got[2] - n[2] * got[1], n[2] * got[0] - n[0] * got[2], n[0] * got[1] - n[1] * got[0]);
      const lengths = [n, got].map(a => Math.hypot(...a));
      const unit = lengths.every(length => Math.abs(length - 1) < 0.02); // 8-bit texels are a little off
      const degrees = unit ? Math.atan2(cross, dot(n, got)) * 180 / Math.PI : NaN;
      worst = degrees <= worst ? worst : degrees; // a NaN stays
      sum += degrees;
      ++count;
    }
  return { worst, mean: sum / count, count };
}
