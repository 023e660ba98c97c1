// The frame `triangle`: two vectors in the plane of each triangle, stored at its provoking vertex.
import { BufferAttribute, DataUtils, IntType } from 'three';
import { withVertices } from './gathered.js';
import { meshOf } from './mesh_data.js';
import { combine, cross, dot, readEdges } from './vectors.js';

export const kTriangleAttribute = 'cotanTriangle';

// A copy of the geometry with U = e1 d2.u - e2 d1.u and V likewise, six halfs in three words, at the provoking vertex
// of each triangle (docs/explanation/triangle.md). Splits vertices that provoke two triangles.
// map: the normal map, whose uv set and matrix are used; provoking: 'last' (WebGL) or 'first' (WebGPU).
export function withTriangles(geometry, map, provoking) {
  const mesh = meshOf(geometry, map), { corners } = mesh, words = wordsOf(mesh);
  const sources = Array.from({ length: geometry.attributes.position.count }, (_, k) => k);  // by new vertex: the old one
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
  const made = withVertices(geometry, sources, corners);
  const packed = new Uint32Array(sources.length * 3);
  provoked.forEach((triangle, vertex) => packed.set(words.subarray(triangle * 3, triangle * 3 + 3), vertex * 3));
  const attribute = new BufferAttribute(packed, 3);
  attribute.gpuType = IntType;
  return made.setAttribute(kTriangleAttribute, attribute);
}

// U and V of each triangle as three words of two halfs, the longer vector with length one. Zeros if degenerate.
function wordsOf(mesh) {
  const { corners, normal } = mesh, words = new Uint32Array(corners.length), e = new Float64Array(10), n = new Float64Array(3), vectors = new Float64Array(6);
  for (let k = 0; k < corners.length; k += 3) {
    readEdges(e, mesh, k);
    let facing = 1;  // positive if the normals agree with the winding; without normals the winding counts
    if (normal) {
      cross(n, 0, e, 0, e, 3);
      facing = [0, 1, 2].reduce((sum, c) => sum + dot(n, 0, normal, 3 * corners[k + c]), 0);
    }
    for (let i = 0; i < 2; ++i) combine(vectors, 3 * i, e, 0, e[8 + i], e, 3, -e[6 + i]);
    const longest = Math.sqrt(Math.max(dot(vectors, 0, vectors, 0), dot(vectors, 3, vectors, 3)));
    const scale = longest > 0 && longest < Infinity ? Math.sign(facing) / longest : 0, half = i => DataUtils.toHalfFloat(scale ? vectors[i] * scale : 0);
    for (let i = 0; i < 3; ++i) words[k + i] = half(2 * i) + half(2 * i + 1) * 65536;
  }
  return words;
}
