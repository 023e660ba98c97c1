// Measures the frames that could read a map on a surface, at points of it, as the library does
// (src/bake/lint/choose_frames.cpp): the angle between perturbed normals.
import { fansOf } from './fans.js';
import { tangentsOf } from './mikktspace.js';
import { placedBy, pointsOver } from './sampling.js';
import { gradientsOf } from './smooth.js';
import { decodeAt } from './texels.js';

// A surface at `count` points for each of its stretches (addStretch). Empty places if no triangle has area in space and uv.
export class Sample {
  #surface;
  #vectors = new Map(); // by frame: the values that are made at the vertices

  constructor(surface, stretches, count) {
    this.#surface = surface;
    this.places = stretches.map(m => placeOf(placedBy(surface, m), count));
  }

  get usable() { return this.places.every(({ count }) => count > 0); }

  // { values, slots } of a frame that reads vertices: element slots[c] of values belongs to corner c.
  #vectorsOf(frame) {
    if (!this.#vectors.has(frame)) {
      const wanted = this.places.flatMap(({ triangles }) => [...new Set(triangles)].flatMap(k => [3 * k, 3 * k + 1, 3 * k + 2]));
      const fans = this.#vectors.get('fans') ?? fansOf(this.#surface, wanted);
      this.#vectors.set('fans', fans);
      this.#vectors.set(frame, { slots: fans.at, values: frame === 'smooth' ? gradientsOf(this.#surface, fans).values : tangentsOf(this.#surface, fans) });
    }
    return this.#vectors.get(frame);
  }

  // t and b of a frame at the points of a place, six numbers each. stored: tangents, four numbers for each vertex, of the
  // frame `stored`. The bitangent of tangents is w * cross(normal, tangent).
  framesAt(place, frame, stored) {
    if (frame === 'orthonormal') return orthonormalAt(place);
    if (frame === 'triangle') return trianglesAt(place);
    if (frame === 'stored') return tangentsAt(place, { values: stored, slots: this.#surface.corners });
    if (!this.#surface.normal) return orthonormalAt(place); // of flat triangles these are the same
    return frame === 'smooth' ? smoothAt(place, this.#vectorsOf(frame)) : tangentsAt(place, this.#vectorsOf(frame));
  }
}

function placeOf(surface, count) {
  const { corners, position, normal, uv } = surface, { triangles, weights, total } = pointsOver(surface, count), found = triangles.length;
  const n = new Float64Array(3 * found), e = new Float64Array(6 * found), d = new Float64Array(4 * found), at = new Float64Array(2 * found), sum = [0, 0, 0];
  for (let k = 0; k < found; ++k) {
    const f = 3 * triangles[k], a = corners[f], b = corners[f + 1], c = corners[f + 2], wb = weights[2 * k], wc = weights[2 * k + 1], wa = 1 - wb - wc;
    for (let i = 0; i < 3; ++i) {
      e[6 * k + i] = position[3 * b + i] - position[3 * a + i];
      e[6 * k + 3 + i] = position[3 * c + i] - position[3 * a + i];
      sum[i] = 0;
    }
    for (let i = 0; i < 2; ++i) {
      d[4 * k + i] = uv[2 * b + i] - uv[2 * a + i];
      d[4 * k + 2 + i] = uv[2 * c + i] - uv[2 * a + i];
      at[2 * k + i] = wa * uv[2 * a + i] + wb * uv[2 * b + i] + wc * uv[2 * c + i];
    }
    if (normal) for (const [vertex, weight] of [[a, wa], [b, wb], [c, wc]]) {
      const x = normal[3 * vertex], y = normal[3 * vertex + 1], z = normal[3 * vertex + 2], scale = weight / (Math.sqrt(x * x + y * y + z * z) || 1);
      sum[0] += x * scale;
      sum[1] += y * scale;
      sum[2] += z * scale;
    }
    if (!unit(n, 3 * k, sum[0], sum[1], sum[2])) {
      const x = 6 * k;
      unit(n, 3 * k, e[x + 1] * e[x + 5] - e[x + 2] * e[x + 4], e[x + 2] * e[x + 3] - e[x] * e[x + 5], e[x] * e[x + 4] - e[x + 1] * e[x + 3]);
    }
  }
  return { surface, count: found, triangles, weights, total, n, e, d, at };
}

// Writes the unit vector along (x, y, z), or zeros; returns whether it has a direction.
function unit(out, at, x, y, z) {
  const length = Math.sqrt(x * x + y * y + z * z), usable = length > 1e-20 && length < Infinity;
  out[at] = usable ? x / length : 0;
  out[at + 1] = usable ? y / length : 0;
  out[at + 2] = usable ? z / length : 0;
  return usable;
}

// b = cross(n, t) * side
function acrossFrom({ n }, k, out, side) {
  const i = 3 * k, j = 6 * k;
  out[j + 3] = (n[i + 1] * out[j + 2] - n[i + 2] * out[j + 1]) * side;
  out[j + 4] = (n[i + 2] * out[j] - n[i] * out[j + 2]) * side;
  out[j + 5] = (n[i] * out[j + 1] - n[i + 1] * out[j]) * side;
}

function orthonormalAt(place) {
  const { count, n, e, d } = place, out = new Float64Array(6 * count);
  for (let k = 0; k < count; ++k) {
    const i = 3 * k, j = 6 * k, l = 4 * k, nx = n[i], ny = n[i + 1], nz = n[i + 2];
    const determinant = d[l] * d[l + 3] - d[l + 1] * d[l + 2], s = determinant < 0 ? -1 : 1;
    if (!determinant) continue;
    const p = d[l + 3] * s, q = d[l + 1] * s; // t = p e1 - q e2, in the plane of n
    const x = e[j] * p - e[j + 3] * q, y = e[j + 1] * p - e[j + 4] * q, z = e[j + 2] * p - e[j + 5] * q, along = x * nx + y * ny + z * nz;
    unit(out, j, x - nx * along, y - ny * along, z - nz * along);
    acrossFrom(place, k, out, s * facing(place, k));
  }
  return out;
}

// 1 if the normal is on the side from which the triangle is counterclockwise, else -1.
function facing({ n, e }, k) {
  const i = 3 * k, j = 6 * k;
  return n[i] * (e[j + 1] * e[j + 5] - e[j + 2] * e[j + 4]) + n[i + 1] * (e[j + 2] * e[j + 3] - e[j] * e[j + 5]) + n[i + 2] * (e[j] * e[j + 4] - e[j + 1] * e[j + 3]) < 0 ? -1 : 1;
}

function trianglesAt(place) {
  const { count, n, e, d } = place, out = new Float64Array(6 * count), u = [0, 0, 0], v = [0, 0, 0];
  for (let k = 0; k < count; ++k) {
    const i = 3 * k, j = 6 * k, l = 4 * k;
    let uu = 0, vv = 0;
    for (let c = 0; c < 3; ++c) {
      u[c] = e[j + c] * d[l + 2] - e[j + 3 + c] * d[l];
      v[c] = e[j + c] * d[l + 3] - e[j + 3 + c] * d[l + 1];
      uu += u[c] * u[c];
      vv += v[c] * v[c];
    }
    const longest = Math.sqrt(Math.max(uu, vv)), scale = longest > 0 ? facing(place, k) / longest : 0;
    for (let c = 0; c < 3; ++c) {
      const p = (c + 1) % 3, q = (c + 2) % 3;
      out[j + c] = (n[i + p] * u[q] - n[i + q] * u[p]) * scale;
      out[j + 3 + c] = (n[i + p] * v[q] - n[i + q] * v[p]) * scale;
    }
  }
  return out;
}

function tangentsAt(place, { values, slots }) {
  const { count, triangles, weights, surface: { linear: m, side } } = place, out = new Float64Array(6 * count), moved = [0, 0, 0];
  for (let k = 0; k < count; ++k) {
    let x = 0, y = 0, z = 0, w = 0;
    for (let c = 0; c < 3; ++c) {
      const at = 4 * slots[3 * triangles[k] + c], weight = c === 0 ? 1 - weights[2 * k] - weights[2 * k + 1] : weights[2 * k + c - 1];
      const a = values[at], b = values[at + 1], d = values[at + 2];
      unit(moved, 0, m[0] * a + m[3] * b + m[6] * d, m[1] * a + m[4] * b + m[7] * d, m[2] * a + m[5] * b + m[8] * d);
      x += weight * moved[0];
      y += weight * moved[1];
      z += weight * moved[2];
      w += weight * values[at + 3];
    }
    unit(out, 6 * k, x, y, z);
    acrossFrom(place, k, out, w * side);
  }
  return out;
}

function smoothAt(place, { values, slots }) {
  const { count, triangles, weights, n, surface: { planes: m } } = place, out = new Float64Array(6 * count), sum = new Float64Array(6);
  for (let k = 0; k < count; ++k) {
    sum.fill(0);
    for (let c = 0; c < 3; ++c) {
      const at = 6 * slots[3 * triangles[k] + c], weight = c === 0 ? 1 - weights[2 * k] - weights[2 * k + 1] : weights[2 * k + c - 1];
      for (let i = 0; i < 6; ++i) sum[i] += weight * values[at + i];
    }
    let longest = 0;
    for (let o = 0; o < 6; o += 3) {
      const x = m[0] * sum[o] + m[3] * sum[o + 1] + m[6] * sum[o + 2], y = m[1] * sum[o] + m[4] * sum[o + 1] + m[7] * sum[o + 2], z = m[2] * sum[o] + m[5] * sum[o + 1] + m[8] * sum[o + 2];
      const i = 3 * k, along = x * n[i] + y * n[i + 1] + z * n[i + 2];
      out[6 * k + o] = x - n[i] * along;
      out[6 * k + o + 1] = y - n[i + 1] * along;
      out[6 * k + o + 2] = z - n[i + 2] * along;
      longest = Math.max(longest, out[6 * k + o] ** 2 + out[6 * k + o + 1] ** 2 + out[6 * k + o + 2] ** 2);
    }
    const scale = longest > 0 && longest < Infinity ? 1 / Math.sqrt(longest) : 0;
    for (let i = 0; i < 6; ++i) out[6 * k + i] *= scale;
  }
  return out;
}

// ---- errors -------------------------------------------------------------------------------------

// The decoded texels of a map at the points of a place, with its slopes scaled, three numbers each.
export function texelsAt({ count, at }, map, texels, scaleX, scaleY) {
  const out = new Float64Array(3 * count);
  for (let k = 0; k < count; ++k) {
    decodeAt(map, texels, at[2 * k], at[2 * k + 1], out, 3 * k);
    out[3 * k] *= scaleX;
    out[3 * k + 1] *= scaleY;
  }
  return out;
}

const kNormal = [0, 0, 0], kOther = [0, 0, 0];

function perturb({ n }, k, frames, x, y, z, out) {
  const i = 3 * k, j = 6 * k;
  for (let c = 0; c < 3; ++c) out[c] = frames[j + c] * x + frames[j + 3 + c] * y + n[i + c] * z;
  const square = out[0] * out[0] + out[1] * out[1] + out[2] * out[2];
  if (!(square > 1e-12 && square < Infinity)) for (let c = 0; c < 3; ++c) out[c] = n[i + c];
}

// Degrees between the normals that two frames (framesAt) make of texels. green: factor on green for the first frame.
export function degreesBetween(place, frames, meaning, texels, green) {
  const found = new Float64Array(place.count), a = kNormal, b = kOther;
  for (let k = 0; k < place.count; ++k) {
    const x = texels[3 * k], y = texels[3 * k + 1], z = texels[3 * k + 2];
    perturb(place, k, frames, x, green * y, z, a);
    perturb(place, k, meaning, x, y, z, b);
    const i = a[1] * b[2] - a[2] * b[1], j = a[2] * b[0] - a[0] * b[2], l = a[0] * b[1] - a[1] * b[0];
    found[k] = Math.atan2(Math.sqrt(i * i + j * j + l * l), a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * 180 / Math.PI;
  }
  return found;
}

// { points, mean, percentile95, percentile99, maximum } of values that are finite.
export function summaryOf(values) {
  const sorted = values.filter(Number.isFinite).sort(), points = sorted.length;
  const upTo = fraction => sorted[Math.max(Math.ceil(fraction * points) - 1, 0)];
  return { points, mean: sorted.reduce((sum, x) => sum + x, 0) / points, percentile95: upTo(0.95), percentile99: upTo(0.99), maximum: sorted[points - 1] };
}
