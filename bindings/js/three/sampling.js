// Points on the surface of a mesh, spread evenly by area, as in the library (src/bake/lint/map_fit.cpp).
import { meshOf, numbersOf, uvNameOf } from './mesh_data.js';
import { cross, dot, readEdges, transform, uvArea } from './vectors.js';

const kPoints = 4096, kTotalPoints = 128 * kPoints, kMinPoints = 16; // of a surface, of all, of a surface of many
export const kFew = 512; // points of a first look
const kMaxStretches = 8;

// The number of points of each surface, a power of two, given the number of surfaces.
export const pointsOfEach = surfaces => Math.min(Math.max(2 ** Math.floor(Math.log2(kTotalPoints / Math.max(surfaces, 1))), kMinPoints), kPoints);

// { corners, position, normal, uv } of a geometry, or of the triangles that a group of materials draws, as its map sees them.
// normal is null, and triangles count as flat, without normals and in flat shading. Null without texture coordinates.
export function surfaceOf(geometry, group, map, flat) {
  const { position, [uvNameOf(map)]: uv } = geometry.attributes;
  if (!position || !uv) return null;
  const mesh = meshOf(geometry, map), groups = geometry.groups.filter(({ materialIndex = 0 }) => materialIndex === group);
  const draws = (_, c) => groups.some(({ start, count }) => c >= start && c - (c - start) % 3 + 3 <= start + count);
  return { ...mesh, corners: group === undefined ? mesh.corners : mesh.corners.filter(draws), normal: flat ? null : mesh.normal };
}

// ---- transforms ---------------------------------------------------------------------------------

// Adds the linear part of a Matrix4 to `known`, unless it differs from one of them only by rotation, mirroring and uniform
// scale, which change nothing.
export function addStretch(known, { elements: e }) {
  const m = Float64Array.from([0, 1, 2, 4, 5, 6, 8, 9, 10], i => e[i]), gram = gramOf(m);
  if (known.length < kMaxStretches && !known.some(other => other.isSkinnedMesh || alike(gramOf(other), gram))) known.push(m);
}

const gramOf = m => [0, 3, 6].flatMap(i => [0, 3, 6].map(j => dot(m, i, m, j)));

function alike(a, b) {
  const ta = a[0] + a[4] + a[8], tb = b[0] + b[4] + b[8];
  return a.every((x, i) => Math.abs(x * tb - b[i] * ta) <= 1e-5 * ta * tb);
}

const kIdentity = Float64Array.of(1, 0, 0, 0, 1, 0, 0, 0, 1);

// The surface moved as a mesh is: by a linear map (columns), positions by it and normals by `planes`, its cofactors with the
// sign of the determinant; a map without stretch is left out. Or by the bones of a SkinnedMesh, as three does: normals by
// the same matrices. linear, planes: for vertex k from step * k on.
export function placedBy(surface, m) {
  if (m.isSkinnedMesh) return posedBy(surface, m);
  if (alike(gramOf(m), gramOf(kIdentity))) return { ...surface, linear: kIdentity, planes: kIdentity, side: 1, step: 0 };
  const planes = new Float64Array(9);
  for (let i = 0; i < 3; ++i) cross(planes, 3 * i, m, (3 * i + 3) % 9, m, (3 * i + 6) % 9);
  const side = dot(m, 0, planes, 0) < 0 ? -1 : 1;
  planes.forEach((x, i) => { planes[i] = x * side; });
  return { ...surface, position: movedBy(m, 0, surface.position), normal: surface.normal && movedBy(planes, 0, surface.normal), linear: m, planes, side, step: 0 };
}

function posedBy(surface, mesh) {
  const { skeleton, bindMatrix, geometry: { attributes: { skinIndex, skinWeight } } } = mesh, { position, normal } = surface, count = position.length / 3;
  const indices = numbersOf(skinIndex, 4), weights = numbersOf(skinWeight, 4), linear = new Float64Array(9 * count), moves = new Float64Array(position.length);
  const bones = skeleton.bones.map((bone, k) => bone.matrixWorld.clone().multiply(skeleton.boneInverses[k]).multiply(bindMatrix).elements);
  for (let k = 0; k < 4 * count; ++k) {
    const e = bones[indices[k]], weight = weights[k], vertex = k >> 2;
    if (!e || !weight) continue;
    for (let i = 0; i < 9; ++i) linear[9 * vertex + i] += weight * e[i + Math.floor(i / 3)];
    for (let i = 0; i < 3; ++i) moves[3 * vertex + i] += weight * e[12 + i];
  }
  const moved = movedBy(linear, 9, position);
  return { ...surface, position: moved.map((x, k) => x + moves[k]), normal: normal && movedBy(linear, 9, normal), linear, planes: linear, side: 1, step: 9 };
}

function movedBy(m, step, vectors) {
  const moved = new Float64Array(vectors.length);
  for (let k = 0; k < moved.length; k += 3) transform(moved, k, m, step * k / 3, vectors, k);
  return moved;
}

// ---- points -------------------------------------------------------------------------------------

const kEdges = new Float64Array(10), kFace = new Float64Array(3);

// Area of a triangle in space; 0 if it has none, or none in uv.
function mappedArea(surface, triangle) {
  readEdges(kEdges, surface, 3 * triangle);
  cross(kFace, 0, kEdges, 0, kEdges, 3);
  const area = Math.sqrt(dot(kFace, 0, kFace, 0)) / 2;
  return uvArea(kEdges) && area < Infinity ? area : 0;
}

// `count` points at equal steps of area over the triangles that have area in space and in uv: { triangles, weights,
// total }, with three barycentric weights for each point, and the area of all. Empty if there are no such triangles.
// The first kFew are spread over all. Points within triangles follow the sequence of the plastic number (R2).
export function pointsOver(surface, count) {
  const all = surface.corners.length / 3, areas = new Float64Array(all);
  let total = 0;
  for (let i = 0; i < all; ++i) total += areas[i] = mappedArea(surface, i);
  if (!(total > 0)) return { triangles: new Uint32Array(0), weights: new Float64Array(0), total: 0 };
  const step = Math.ceil(count / kFew), triangles = new Uint32Array(count), weights = new Float64Array(3 * count);
  let triangle = 0, upTo = areas[0];
  for (let k = 0; k < count; ++k) {
    const at = (k + 0.5) / count * total;
    while (triangle + 1 < all && upTo <= at) upTo += areas[++triangle];
    let a = (0.5 + 0.7548776662466927 * k) % 1, b = (0.5 + 0.5698402909980532 * k) % 1;
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    const slot = k % step * kFew + Math.floor(k / step);
    triangles[slot] = triangle;
    weights.set([1 - a - b, a, b], 3 * slot);
  }
  return { triangles, weights, total };
}
