// The frame `triangle`: two vectors in the plane of each triangle, at the vertex that its flat values are taken from.
import { BufferAttribute, BufferGeometry, DataUtils, IntType } from 'three';

export const kTriangleAttribute = 'cotanTriangle';

// The geometry with U = e1 d2.u - e2 d1.u and V likewise as three words of halfs (docs/triangle.md) at the vertices that
// provoke; vertices that provoke two triangles are split, about as many as triangles remain. Attributes are copied.
// uvName: the attribute that the normal map is over; turn: [m00, m01, m10, m11] of the texture's matrix;
// provoking: 'last' (WebGL) or 'first' (WebGPU).
export function withTriangles(geometry, uvName, turn, provoking) {
  const { position, normal, [uvName]: uv } = geometry.attributes;
  const count = geometry.index ? geometry.index.count : position.count;
  const corners = Uint32Array.from({ length: count - count % 3 }, (_, k) => geometry.index ? geometry.index.getX(k) : k);
  const sources = Array.from({ length: position.count }, (_, k) => k);  // of each new vertex
  const words = [], own = new Set();
  for (let k = 0; k < corners.length; k += 3) {
    const [a, b, c] = corners.subarray(k, k + 3);
    let turns = [a, b, c].findIndex(vertex => !own.has(vertex));
    if (turns < 0) {  // all three provoke others
      turns = 0;
      sources.push(a);
      corners[k] = sources.length - 1;
    }
    const [p, q, r] = [0, 1, 2].map(i => corners[k + (turns + i) % 3]);
    own.add(p);
    corners.set(provoking === 'first' ? [p, q, r] : [q, r, p], k);
    words[p] = wordsOf(vectors(position, normal, uv, a, b, c), turn);
  }
  const made = new BufferGeometry().copy(geometry);
  made.deleteAttribute('tangent');
  for (const name of Object.keys(made.attributes)) made.setAttribute(name, gathered(geometry.attributes[name], sources));
  const packed = new Uint32Array(sources.length * 3);
  words.forEach((word, vertex) => packed.set(word, vertex * 3));
  const attribute = new BufferAttribute(packed, 3);
  attribute.gpuType = IntType;
  made.setAttribute(kTriangleAttribute, attribute);
  made.setIndex(new BufferAttribute(sources.length > 65535 ? corners : Uint16Array.from(corners), 1));
  return made;
}

function vectors(position, normal, uv, a, b, c) {
  const xyz = (attribute, k) => [attribute.getX(k), attribute.getY(k), attribute.getZ(k)];
  const [p0, p1, p2] = [a, b, c].map(k => xyz(position, k));
  const e1 = p1.map((x, i) => x - p0[i]), e2 = p2.map((x, i) => x - p0[i]);
  const along = get => {
    const d1 = uv[get](b) - uv[get](a), d2 = uv[get](c) - uv[get](a);
    return e1.map((x, i) => x * d2 - e2[i] * d1);
  };
  const face = [0, 1, 2].map(i => e1[(i + 1) % 3] * e2[(i + 2) % 3] - e1[(i + 2) % 3] * e2[(i + 1) % 3]);
  // The side that the normals point to is the outside; the winding's, where there are none.
  const side = !normal ? 1
    : Math.sign([a, b, c].map(k => xyz(normal, k)).reduce((sum, n) => sum + n[0] * face[0] + n[1] * face[1] + n[2] * face[2], 0));
  return [along('getX').map(x => x * side), along('getY').map(x => x * side)];
}

// Three words of two halfs; the longer vector has length one. Zeros where there is no frame.
function wordsOf([u, v], [m00, m01, m10, m11]) {
  const six = [...u.map((x, i) => m00 * x + m01 * v[i]), ...u.map((x, i) => m10 * x + m11 * v[i])];
  const longest = Math.max(Math.hypot(...six.slice(0, 3)), Math.hypot(...six.slice(3)));
  const halfs = six.map(x => longest > 0 && longest < Infinity ? DataUtils.toHalfFloat(x / longest) : 0);
  return [0, 2, 4].map(i => halfs[i] + halfs[i + 1] * 65536);
}

function gathered(attribute, sources) {
  if (attribute.isInstancedBufferAttribute) return attribute.clone();
  const { itemSize, normalized, gpuType } = attribute;
  const [array, stride, offset] = attribute.isInterleavedBufferAttribute
    ? [attribute.data.array, attribute.data.stride, attribute.offset] : [attribute.array, itemSize, 0];
  const values = new array.constructor(sources.length * itemSize);
  sources.forEach((source, k) => {
    for (let i = 0; i < itemSize; ++i) values[k * itemSize + i] = array[source * stride + offset + i];
  });
  const made = new BufferAttribute(values, itemSize, normalized);
  if (gpuType !== undefined) made.gpuType = gpuType;
  return made;
}
