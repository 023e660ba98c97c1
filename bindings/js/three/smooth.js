// The frame `smooth`: gradients of u and v averaged at the vertices, as in src/core/tangents.cpp.
import { BufferAttribute } from 'three';
import { eachFan, fansOf } from './fans.js';
import { withVertices } from './gathered.js';
import { meshOf } from './mesh_data.js';
import { combine, cross, dot, normalise, readEdges, uvArea } from './vectors.js';

export const kSmoothAttributes = ['cotanU', 'cotanV'];

// A copy of the geometry with the gradients of u and v, per unit of length, at its vertices. Splits vertices shared by
// mirrored and unmirrored triangles.
// map: the normal map, whose uv set and matrix are used. The geometry must have positions, normals and this uv set.
export function withSmooth(geometry, map) {
  const mesh = meshOf(geometry, map), { position } = geometry.attributes;
  const fans = fansOf(mesh), { sides, values } = gradientsOf(mesh, fans);
  const { corners, sources } = splitMirrored(mesh.corners, fans, sides, position.count);
  const made = withVertices(geometry, sources, sources.length > position.count && corners);
  const u = new Float32Array(3 * sources.length), v = new Float32Array(3 * sources.length);
  corners.forEach((vertex, c) => {
    const at = 6 * fans.at[c];
    if (!sides[fans.at[c]] && (u[3 * vertex] || u[3 * vertex + 1] || u[3 * vertex + 2])) return; // others know more
    for (let i = 0; i < 3; ++i) {
      u[3 * vertex + i] = values[at + i];
      v[3 * vertex + i] = values[at + 3 + i];
    }
  });
  made.setAttribute('cotanU', new BufferAttribute(u, 3));
  made.setAttribute('cotanV', new BufferAttribute(v, 3));
  return made;
}

// { sides, values } for the corners of fans.list. sides: 1 if (dP/du, dP/dv, normal) is right-handed, -1 if left-handed, 0 if
// degenerate. values: gradients of u and of v, averaged over the corners of the same side, weighted by their angles in the
// tangent plane; degenerate corners have those of either side.
export function gradientsOf(mesh, fans) {
  const { list } = fans, sides = new Int8Array(list.length), values = new Float64Array(6 * list.length), sums = new Float64Array(14), e = new Float64Array(10), n = new Float64Array(3), work = new Float64Array(6);
  eachFan(fans, (begin, end) => {
    combine(n, 0, mesh.normal, 3 * mesh.corners[list[begin]], 1, n, 0, 0);
    const facing = normalise(n, 0);
    sums.fill(0);
    for (let k = begin; k < end; ++k) {
      readEdges(e, mesh, list[k]);
      cross(work, 0, e, 3, n, 0);
      cross(work, 3, n, 0, e, 0);
      const determinant = dot(e, 0, work, 0); // twice the signed area of the projected edges
      const side = uvArea(e) * (facing ? determinant : 1); // a zero normal is replaced by the triangle's
      sides[k] = Number.isFinite(side) ? Math.sign(side) : 0;
      if (!sides[k] || !determinant) continue;
      const weight = Math.atan2(Math.abs(determinant), dot(e, 0, e, 3) - dot(e, 0, n, 0) * dot(e, 3, n, 0)), slot = sides[k] > 0 ? 7 : 0, scale = weight / determinant;
      for (let i = 0; i < 6; ++i) sums[slot + i] += scale * (i < 3 ? work[i] * e[6] + work[i + 3] * e[8] : work[i - 3] * e[7] + work[i] * e[9]);
      sums[slot + 6] += weight;
    }
    for (let k = begin; k < end; ++k) {
      const slot = sides[k] > 0 || !sides[k] && !(sums[6] > 0) ? 7 : 0;
      for (let i = 0; i < 6 && sums[slot + 6] > 0; ++i) values[6 * k + i] = sums[slot + i] / sums[slot + 6];
    }
  });
  return { sides, values };
}

// Splits the vertices that triangles of both sides share: those of the second side get a copy.
function splitMirrored(corners, { at }, sides, count) {
  const first = new Int8Array(count), copies = new Map(), made = corners.slice(), sources = Array.from({ length: count }, (_, k) => k);
  corners.forEach((vertex, c) => {
    const side = sides[at[c]];
    if (!side || (first[vertex] ||= side) === side) return;
    if (!copies.has(vertex)) copies.set(vertex, sources.push(vertex) - 1);
    made[c] = copies.get(vertex);
  });
  return { corners: made, sources };
}
