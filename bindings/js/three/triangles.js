// The frame `triangle`: two vectors in the plane of each triangle, stored at its provoking vertex.
import { BufferAttribute, BufferGeometry, DataUtils, IntType } from 'three';
import { gathered } from './gathered.js';
import { cornersOf, numbersOf, uvMatrixOf, uvNameOf } from './mesh_data.js';

export const kTriangleAttribute = 'cotanTriangle';

// A copy of the geometry with U = e1 d2.u - e2 d1.u and V likewise, six halfs in three words, at the provoking vertex
// of each triangle (docs/explanation/triangle.md). Splits vertices that provoke two triangles.
// map: the normal map, whose uv set and matrix are used; provoking: 'last' (WebGL) or 'first' (WebGPU).
export function withTriangles(geometry, map, provoking) {
  const { position, normal, [uvNameOf(map)]: uv } = geometry.attributes, corners = cornersOf(geometry);
  const words = wordsOf(corners, numbersOf(position, 3), normal && numbersOf(normal, 3), numbersOf(uv, 2), uvMatrixOf(map));
  const sources = Array.from({ length: position.count }, (_, k) => k);  // by new vertex: the old one
  const provoked = [];  // by new vertex: the triangle that it provokes
  for (let k = 0; k < corners.length; k += 3) {
    let rotation = 0;
    while (rotation < 3 && provoked[corners[k + rotation]] !== undefined) ++rotation;
    if (rotation === 3) {  // all three already provoke other triangles
      rotation = 0;
      sources.push(corners[k]);
      corners[k] = sources.length - 1;
    }
    const p = corners[k + rotation], q = corners[k + (rotation + 1) % 3], r = corners[k + (rotation + 2) % 3];
    provoked[p] = k / 3;
    const first = provoking === 'first';
    corners[k] = first ? p : q;
    corners[k + 1] = first ? q : r;
    corners[k + 2] = first ? r : p;
  }
  const made = new BufferGeometry().copy(geometry);
  made.deleteAttribute('tangent');
  for (const name of Object.keys(made.attributes)) made.setAttribute(name, gathered(geometry.attributes[name], sources));
  const packed = new Uint32Array(sources.length * 3);
  provoked.forEach((triangle, vertex) => packed.set(words.subarray(triangle * 3, triangle * 3 + 3), vertex * 3));
  const attribute = new BufferAttribute(packed, 3);
  attribute.gpuType = IntType;
  made.setAttribute(kTriangleAttribute, attribute);
  made.setIndex(new BufferAttribute(sources.length > 65535 ? corners : Uint16Array.from(corners), 1));
  return made;
}

// U and V of each triangle as three words of two halfs, the longer vector with length one. Zeros if degenerate.
function wordsOf(corners, position, normal, uv, [m00, m01, m10, m11]) {
  const words = new Uint32Array(corners.length), e1 = [0, 0, 0], e2 = [0, 0, 0], u = [0, 0, 0], v = [0, 0, 0];
  for (let k = 0; k < corners.length; k += 3) {
    const a = corners[k], b = corners[k + 1], c = corners[k + 2];
    for (let i = 0; i < 3; ++i) {
      e1[i] = position[b * 3 + i] - position[a * 3 + i];
      e2[i] = position[c * 3 + i] - position[a * 3 + i];
    }
    const u1 = uv[b * 2] - uv[a * 2], u2 = uv[c * 2] - uv[a * 2], v1 = uv[b * 2 + 1] - uv[a * 2 + 1], v2 = uv[c * 2 + 1] - uv[a * 2 + 1];
    let facing = normal ? 0 : 1;  // positive if the normals agree with the winding; without normals the winding counts
    for (let i = 0; normal && i < 3; ++i) {
      const j = (i + 1) % 3, l = (i + 2) % 3;
      facing += (e1[j] * e2[l] - e1[l] * e2[j]) * (normal[a * 3 + i] + normal[b * 3 + i] + normal[c * 3 + i]);
    }
    for (let i = 0; i < 3; ++i) {
      const alongU = e1[i] * u2 - e2[i] * u1, alongV = e1[i] * v2 - e2[i] * v1;
      u[i] = m00 * alongU + m01 * alongV;
      v[i] = m10 * alongU + m11 * alongV;
    }
    const longest = Math.sqrt(Math.max(u[0] * u[0] + u[1] * u[1] + u[2] * u[2], v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    const scale = longest > 0 && longest < Infinity ? Math.sign(facing) / longest : 0;
    const half = x => DataUtils.toHalfFloat(scale ? x * scale : 0);
    words[k] = half(u[0]) + half(u[1]) * 65536;
    words[k + 1] = half(u[2]) + half(v[0]) * 65536;
    words[k + 2] = half(v[1]) + half(v[2]) * 65536;
  }
  return words;
}
