// The frame `smooth`: gradients of u and v averaged at the vertices, as in src/core/tangents.cpp.
import { BufferAttribute, BufferGeometry } from 'three';
import { cornersOf, numbersOf, transformedUv, uvMatrixOf, uvNameOf } from './mesh_data.js';
import { gathered } from './gathered.js';

export const kSmoothAttributes = ['cotanU', 'cotanV'];

// A copy of the geometry with the gradients of u and v, per unit of length, at its vertices. Splits vertices shared by
// mirrored and unmirrored triangles. Attributes are copied if vertices were split, else shared.
// map: the normal map, whose uv set and matrix are used. The geometry must have positions, normals and this uv set.
export function withSmooth(geometry, map) {
  const { position, normal, [uvNameOf(map)]: uv } = geometry.attributes;
  const mesh = { corners: cornersOf(geometry), position: numbersOf(position, 3), normal: numbersOf(normal, 3), uv: transformedUv(uv, uvMatrixOf(map)) };
  const sides = sidesOf(mesh), { corners, sources } = splitMirrored(mesh.corners, sides, position.count);
  const { u, v } = averaged(mesh, corners, sides, sources);
  const split = sources.length > position.count, made = new BufferGeometry().copy(geometry);
  made.deleteAttribute('tangent');
  if (split) {
    for (const name of Object.keys(made.attributes)) made.setAttribute(name, gathered(geometry.attributes[name], sources));
    made.setIndex(new BufferAttribute(sources.length > 65535 ? corners : Uint16Array.from(corners), 1));
  }
  made.setAttribute('cotanU', new BufferAttribute(u, 3));
  made.setAttribute('cotanV', new BufferAttribute(v, 3));
  return made;
}

// Calls work(corner, vertex) for each corner, with the edges to the next and to the previous corner in kEdges.
const kEdges = new Float64Array(10); // e1, e2, then u and v along each

function eachCorner({ corners, position, uv }, work) {
  for (let c = 0; c < corners.length; ++c) {
    const f = c - c % 3, a = corners[c], b = corners[f + (c + 1) % 3], d = corners[f + (c + 2) % 3];
    for (let i = 0; i < 3; ++i) {
      kEdges[i] = position[b * 3 + i] - position[a * 3 + i];
      kEdges[3 + i] = position[d * 3 + i] - position[a * 3 + i];
    }
    for (let i = 0; i < 2; ++i) {
      kEdges[6 + i] = uv[b * 2 + i] - uv[a * 2 + i];
      kEdges[8 + i] = uv[d * 2 + i] - uv[a * 2 + i];
    }
    work(c, a);
  }
}

// For each corner: 1 if (dP/du, dP/dv, normal) is right-handed, -1 if left-handed, 0 if degenerate.
function sidesOf(mesh) {
  const sides = new Int8Array(mesh.corners.length), { normal } = mesh;
  eachCorner(mesh, (c, vertex) => {
    const [px, py, pz, qx, qy, qz, u1, v1, u2, v2] = kEdges, x = py * qz - pz * qy, y = pz * qx - px * qz, z = px * qy - py * qx;
    const nx = normal[3 * vertex], ny = normal[3 * vertex + 1], nz = normal[3 * vertex + 2];
    const facing = nx || ny || nz ? x * nx + y * ny + z * nz : 1; // a zero normal is replaced by the triangle's
    const side = (u1 * v2 - v1 * u2) * facing;
    sides[c] = Number.isFinite(side) ? Math.sign(side) : 0;
  });
  return sides;
}

// Splits the vertices that triangles of both sides share. Right-handed corners get the copy, all others the original.
function splitMirrored(corners, sides, count) {
  const used = new Uint8Array(count), right = new Map(), made = corners.slice();
  const sources = Array.from({ length: count }, (_, k) => k);
  corners.forEach((vertex, c) => { if (sides[c]) used[vertex] |= sides[c] > 0 ? 2 : 1; });
  corners.forEach((vertex, c) => {
    if (used[vertex] !== 3 || sides[c] <= 0) return;
    if (!right.has(vertex)) right.set(vertex, sources.push(vertex) - 1);
    made[c] = right.get(vertex);
  });
  return { corners: made, sources };
}

// For each vertex: the first vertex that has the same position, normal and uv.
function welded({ position, normal, uv }) {
  const count = position.length / 3, first = new Uint32Array(count), size = 2 ** Math.ceil(Math.log2(2 * count + 2)), table = new Int32Array(size).fill(-1);
  const values = new Float32Array(8), bits = new Uint32Array(values.buffer), keys = new Float32Array(8 * count);
  for (let k = 0; k < count; ++k) {
    for (let i = 0; i < 3; ++i) {
      values[i] = position[3 * k + i] + 0; // -0 becomes 0
      values[3 + i] = normal[3 * k + i] + 0;
      if (i < 2) values[6 + i] = uv[2 * k + i] + 0;
    }
    keys.set(values, 8 * k);
    let slot = bits.reduce((hash, x) => Math.imul(hash ^ x, 0x9e3779b1) ^ hash >>> 15, 0) & size - 1;
    const equal = other => { for (let i = 0; i < 8; ++i) if (keys[8 * other + i] !== values[i]) return false; return true; };
    while (table[slot] >= 0 && !equal(table[slot])) slot = slot + 1 & size - 1;
    if (table[slot] < 0) table[slot] = k;
    first[k] = table[slot];
  }
  return first;
}

// Averages the gradients of equal vertices, separately for both sides, weighted by corner angles in the tangent plane.
function averaged(mesh, corners, sides, sources) {
  const { corners: old, normal } = mesh, known = welded(mesh), slots = new Uint32Array(sources.length);
  corners.forEach((vertex, c) => { if (sides[c]) slots[vertex] = 2 * known[old[c]] + (sides[c] > 0 ? 1 : 0) + 1; });
  const sums = new Float64Array(14 * known.length); // u, v and the weight, by welded vertex and side
  eachCorner(mesh, (c, vertex) => {
    if (!sides[c]) return;
    const [px, py, pz, qx, qy, qz, u1, v1, u2, v2] = kEdges;
    let x = normal[3 * vertex], y = normal[3 * vertex + 1], z = normal[3 * vertex + 2];
    const length = Math.sqrt(x * x + y * y + z * z) || 1;
    x /= length;
    y /= length;
    z /= length;
    const ax = qy * z - qz * y, ay = qz * x - qx * z, az = qx * y - qy * x, bx = y * pz - z * py, by = z * px - x * pz, bz = x * py - y * px;
    const determinant = px * ax + py * ay + pz * az; // twice the signed area of the projected edges
    if (!(Math.abs(determinant) > 0)) return;
    const along = px * x + py * y + pz * z, other = qx * x + qy * y + qz * z;
    const weight = Math.atan2(Math.abs(determinant), px * qx + py * qy + pz * qz - along * other), slot = 7 * (2 * known[vertex] + (sides[c] > 0 ? 1 : 0));
    const scale = weight / determinant;
    sums[slot] += scale * (ax * u1 + bx * u2);
    sums[slot + 1] += scale * (ay * u1 + by * u2);
    sums[slot + 2] += scale * (az * u1 + bz * u2);
    sums[slot + 3] += scale * (ax * v1 + bx * v2);
    sums[slot + 4] += scale * (ay * v1 + by * v2);
    sums[slot + 5] += scale * (az * v1 + bz * v2);
    sums[slot + 6] += weight;
  });
  const u = new Float32Array(3 * sources.length), v = new Float32Array(3 * sources.length);
  sources.forEach((source, vertex) => {
    const pair = 14 * known[source], slot = slots[vertex] ? 7 * (slots[vertex] - 1) : sums[pair + 6] > 0 ? pair : pair + 7;
    for (let i = 0; sums[slot + 6] > 0 && i < 3; ++i) {
      u[3 * vertex + i] = sums[slot + i] / sums[slot + 6];
      v[3 * vertex + i] = sums[slot + 3 + i] / sums[slot + 6];
    }
  });
  return { u, v };
}
