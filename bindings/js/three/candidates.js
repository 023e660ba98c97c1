// Measures the frames that could read a map on a surface, at points of it, as the library does
// (src/bake/lint/choose_frames.cpp): the angle between perturbed normals.
import { fansOf } from './fans.js';
import { tangentsOf } from './mikktspace.js';
import { kFew, placedBy, pointsOver } from './sampling.js';
import { gradientsOf } from './smooth.js';
import { decodeAt } from './texels.js';
import { combine, cross, dot, flatten, normalise, readEdges, transform } from './vectors.js';

// A surface at its places (placesOf). tangents: that came with the geometry, four numbers for each vertex. transform: the linear part of the texture's matrix
// that they are to be moved by, if any.
export class Sample {
  #surface;
  #fans;
  #vectors = new Map(); // by frame: the values that are made at the vertices
  #transform;

  constructor(surface, places, tangents, transform) {
    this.#surface = surface;
    this.#transform = transform;
    this.#vectors.set('stored', { values: tangents, slots: surface.corners });
    this.places = places;
  }

  // The same surface at a few of its points.
  few() { return new Sample(this.#surface, this.places.map(place => ({ ...place, count: Math.min(place.count, kFew) })), this.#vectors.get('stored').values, this.#transform); }

  get usable() { return this.places.every(place => place.count); }

  // { values, slots } of a frame that reads vertices: element slots[c] of values belongs to corner c.
  #vectorsOf(frame) {
    if (!this.#vectors.has(frame)) {
      const fans = this.#fans ??= fansOf(this.#surface, this.places.flatMap(({ triangles, count }) => [...new Set(triangles.subarray(0, count))].flatMap(k => [3 * k, 3 * k + 1, 3 * k + 2])));
      this.#vectors.set(frame, { slots: fans.at, values: frame === 'smooth' ? gradientsOf(this.#surface, fans).values : tangentsOf(this.#surface, fans) });
    }
    return this.#vectors.get(frame);
  }

  // t and b of a frame, or of the `stored` tangents, at the points of a place, six numbers each. The bitangent of tangents is
  // w * cross(normal, tangent).
  framesAt(place, frame) {
    if (frame === 'triangle') return trianglesAt(place);
    if (frame === 'orthonormal' || frame !== 'stored' && !this.#surface.normal) return orthonormalAt(place); // the same on flat triangles
    const vectors = this.#vectorsOf(frame);
    return frame === 'smooth' ? smoothAt(place, vectors) : tangentsAt(place, vectors, frame === 'stored' && this.#transform);
  }
}

// By which dP/du turns about the normal when uv are transformed: cosine and sine for each point.
function turnsOf(place, [a, b, c, d]) {
  const determinant = a * d - b * c, e = place.e.slice(), turns = new Float64Array(2 * place.count);
  for (let j = 6; j < e.length; j += 10)
    for (let i = j; i < j + 4; i += 2) {
      const u = e[i], v = e[i + 1];
      e[i] = (d * u - b * v) / determinant;
      e[i + 1] = (a * v - c * u) / determinant;
    }
  const from = orthonormalAt({ ...place, e }), to = orthonormalAt(place);
  for (let k = 0; k < place.count; ++k) {
    acrossFrom(place, k, from, 1);
    for (let i = 0; i < 2; ++i) turns[2 * k + i] = dot(to, 6 * k, from, 6 * k + 3 * i);
  }
  return turns;
}

// A surface at `count` points for each of its stretches (addStretch); empty if no triangle has area in space and uv.
export const placesOf = (surface, stretches, count) => stretches.map(m => placeOf(placedBy(surface, m), count));

function placeOf(surface, count) {
  const { corners, normal, uv } = surface, { triangles, weights, total } = pointsOver(surface, count), found = triangles.length;
  const n = new Float64Array(3 * found), e = new Float64Array(10 * found), at = new Float64Array(2 * found), own = new Float64Array(3), edges = new Float64Array(10);
  for (let k = 0; k < found; ++k) {
    readEdges(edges, surface, 3 * triangles[k]);
    e.set(edges, 10 * k);
    for (let c = 0; c < 3; ++c) {
      const vertex = corners[3 * triangles[k] + c], weight = weights[3 * k + c];
      for (let i = 0; i < 2; ++i) at[2 * k + i] += weight * uv[2 * vertex + i];
      if (!normal) continue;
      combine(own, 0, normal, 3 * vertex, 1, own, 0, 0);
      normalise(own, 0);
      combine(n, 3 * k, n, 3 * k, 1, own, 0, weight);
    }
    if (normalise(n, 3 * k)) continue;
    cross(n, 3 * k, e, 10 * k, e, 10 * k + 3);
    normalise(n, 3 * k);
  }
  return { surface, count: found, triangles, weights, total, n, e, at };
}

// b = cross(n, t) * side
const acrossFrom = ({ n }, k, out, side) => cross(out, 6 * k + 3, n, 3 * k, out, 6 * k, side);

function orthonormalAt(place) {
  const { count, e, n } = place, out = new Float64Array(6 * count);
  for (let k = 0; k < count; ++k) {
    const j = 10 * k, determinant = e[j + 6] * e[j + 9] - e[j + 7] * e[j + 8], s = determinant < 0 ? -1 : 1;
    if (!determinant) continue;
    combine(out, 6 * k, e, j, e[j + 9] * s, e, j + 3, -e[j + 7] * s);
    flatten(out, 6 * k, n, 3 * k);
    normalise(out, 6 * k);
    acrossFrom(place, k, out, s * facing(place, k));
  }
  return out;
}

const kFace = new Float64Array(3);

// 1 if the normal is on the side from which the triangle is counterclockwise, else -1.
function facing({ n, e }, k) {
  cross(kFace, 0, e, 10 * k, e, 10 * k + 3);
  return dot(n, 3 * k, kFace, 0) < 0 ? -1 : 1;
}

// Makes the longer of t and b a unit vector.
function rescale(out, j, sign) {
  const longest = Math.sqrt(Math.max(dot(out, j, out, j), dot(out, j + 3, out, j + 3))), scale = longest > 0 && longest < Infinity ? sign / longest : 0;
  for (let i = j; i < j + 6; ++i) out[i] *= scale;
}

function trianglesAt(place) {
  const { count, n, e } = place, out = new Float64Array(6 * count), uv = new Float64Array(6);
  for (let k = 0; k < count; ++k) {
    const j = 10 * k;
    for (let i = 0; i < 2; ++i) combine(uv, 3 * i, e, j, e[j + 8 + i], e, j + 3, -e[j + 6 + i]);
    rescale(uv, 0, facing(place, k));
    for (let i = 0; i < 6; i += 3) cross(out, 6 * k + i, n, 3 * k, uv, i);
  }
  return out;
}

// matrix: of the uv that the tangents are to be moved to; may be missing.
function tangentsAt(place, { values, slots }, matrix) {
  const { count, triangles, weights, surface: { corners, linear, side, step } } = place, out = new Float64Array(6 * count), moved = new Float64Array(3);
  const turns = matrix && turnsOf(place, matrix), mirrors = matrix && matrix[0] * matrix[3] < matrix[1] * matrix[2] ? -1 : 1;
  for (let k = 0; k < count; ++k) {
    let w = 0;
    for (let c = 0; c < 3; ++c) {
      const corner = 3 * triangles[k] + c, at = 4 * slots[corner], weight = weights[3 * k + c];
      transform(moved, 0, linear, step * corners[corner], values, at);
      normalise(moved, 0);
      combine(out, 6 * k, out, 6 * k, 1, moved, 0, weight);
      w += weight * values[at + 3];
    }
    normalise(out, 6 * k);
    if (turns) {
      acrossFrom(place, k, out, 1);
      combine(out, 6 * k, out, 6 * k, turns[2 * k], out, 6 * k + 3, turns[2 * k + 1]);
    }
    acrossFrom(place, k, out, w * side * mirrors);
  }
  return out;
}

function smoothAt(place, { values, slots }) {
  const { count, n, triangles, weights, surface: { corners, planes, step } } = place, out = new Float64Array(6 * count), moved = new Float64Array(3);
  for (let k = 0; k < count; ++k) {
    for (let i = 0; i < 6; i += 3) {
      for (let c = 0; c < 3; ++c) {
        const corner = 3 * triangles[k] + c;
        transform(moved, 0, planes, step * corners[corner], values, 6 * slots[corner] + i);
        combine(out, 6 * k + i, out, 6 * k + i, 1, moved, 0, weights[3 * k + c]);
      }
      flatten(out, 6 * k + i, n, 3 * k);
    }
    rescale(out, 6 * k, 1);
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

// Writes the perturbed normal, of any length.
function perturb({ n }, k, frames, x, y, z, out) {
  combine(out, 0, frames, 6 * k, x, frames, 6 * k + 3, y);
  combine(out, 0, out, 0, 1, n, 3 * k, z);
  const square = dot(out, 0, out, 0);
  if (!(square > 1e-12 && square < Infinity)) combine(out, 0, n, 3 * k, 1, out, 0, 0);
}

// Degrees between the normals that two frames (framesAt) make of texels. green: factor on green for the first frame.
export function degreesBetween(place, frames, meaning, texels, green) {
  const found = new Float64Array(place.count), a = new Float64Array(3), b = new Float64Array(3);
  for (let k = 0; k < place.count; ++k) {
    const x = texels[3 * k], y = texels[3 * k + 1], z = texels[3 * k + 2];
    perturb(place, k, frames, x, green * y, z, a);
    perturb(place, k, meaning, x, y, z, b);
    cross(kFace, 0, a, 0, b, 0);
    found[k] = Math.atan2(Math.sqrt(dot(kFace, 0, kFace, 0)), dot(a, 0, b, 0)) * 180 / Math.PI;
  }
  return found;
}

const kU = new Float64Array(3), kAcross = new Float64Array(3);

// Writes the direction of constant v, or of 45 degrees between it and the one across it (`across`: the sign of b).
function groove({ n }, k, frames, across, out) {
  cross(kU, 0, frames, 6 * k + 3, n, 3 * k);
  normalise(kU, 0);
  cross(kAcross, 0, n, 3 * k, kU, 0); // on the side of b
  combine(out, 0, kU, 0, dot(kU, 0, frames, 6 * k) < 0 ? -1 : 1, kAcross, 0, across);
}

// Degrees between the directions of anisotropy that two frames make, regardless of their signs. across: 0 if the directions are
// those of u, otherwise 1, or -1 if the bitangents of the second frame run against those of the first.
export function degreesOfGrooves(place, frames, meaning, across) {
  const found = new Float64Array(place.count), a = new Float64Array(3), b = new Float64Array(3);
  for (let k = 0; k < place.count; ++k) {
    groove(place, k, frames, across, a);
    groove(place, k, meaning, Math.abs(across), b);
    cross(kFace, 0, a, 0, b, 0);
    found[k] = Math.atan2(Math.sqrt(dot(kFace, 0, kFace, 0)), Math.abs(dot(a, 0, b, 0))) * 180 / Math.PI;
  }
  return found;
}

// { points, mean, percentile95, percentile99, maximum } of the values that are finite; NaN without any.
export function summaryOf(values) {
  const sorted = Float64Array.from(values).filter(Number.isFinite).sort(), points = sorted.length;
  const upTo = fraction => sorted[Math.max(Math.ceil(fraction * points) - 1, 0)] ?? NaN;
  return { points, mean: sorted.reduce((sum, x) => sum + x, 0) / points, percentile95: upTo(0.95), percentile99: upTo(0.99), maximum: upTo(1) };
}
