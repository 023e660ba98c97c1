// Tangents, and the vectors of other frames, from arrays.
import { choice, floats, options, triangleIndices } from './arrays.js';
import { usage, wordsFor } from './instance.js';

function arraysOf(mesh) {
  if (mesh === null || typeof mesh !== 'object') throw usage(`mesh: expected an object, found ${wordsFor(mesh)}`);
  const positions = floats(mesh.positions, 'mesh.positions', 3);
  const vertices = positions.length / 3;
  const indices = mesh.indices === undefined || mesh.indices === null ? null : triangleIndices(mesh.indices, 'mesh.indices');
  const corners = indices ? indices.length : vertices;
  if (corners % 3 !== 0) throw usage(`mesh.positions: expected three vertices for each triangle, found ${corners}`);
  return {
    positions, vertices, corners,
    indices: indices ?? Uint32Array.from({ length: vertices }, (_, i) => i),
    normals: floats(mesh.normals, 'mesh.normals', 3, vertices),
    uvs: floats(mesh.uvs, 'mesh.uvs', 2, vertices),
  };
}

/** Calls work(indices, sources, count) with output buffers for a vertex split, and returns { indices, sources }. */
export const splitBy = (s, vertices, corners, work) => {
  const indices = s.allocate(4 * corners), sources = s.allocate(4 * (vertices + corners)), count = s.allocate(4);
  work(indices, sources, count);
  return {
    indices: s.take(Uint32Array, indices, corners),
    sources: s.take(Uint32Array, sources, s.view(Uint32Array, count, 1)[0]),
  };
};

/** Returns vertexCount if it is a valid number of vertices. */
export function counted(vertexCount) {
  if (!(Number.isInteger(vertexCount) && vertexCount >= 0 && vertexCount < 2 ** 32))
    throw usage(`vertexCount: expected a 32-bit unsigned integer, found ${wordsFor(vertexCount)}`);
  return vertexCount;
}

/** The public functions on a loaded library. */
export function tangentFunctions(library) {
  const withMesh = (mesh, work) => library.run((s) => {
    const m = arraysOf(mesh);
    const at = s.struct(m.vertices, s.put(m.positions), s.put(m.normals), s.put(m.uvs), m.corners, s.put(m.indices));
    return work(s, m, at);
  });
  const vectorPairs = (s, count, work) => {
    const u = s.allocate(12 * count), v = s.allocate(12 * count);
    work(u, v);
    return { u: s.take(Float32Array, u, 3 * count), v: s.take(Float32Array, v, 3 * count) };
  };
  const pack = (given, name, size, counted, Type, width) => library.run((s) => {
    const count = counted.length / size;
    const out = s.allocate(Type.BYTES_PER_ELEMENT * width * count);
    s.call(name, count, ...given.map((array) => s.put(array)), out);
    return s.take(Type, out, width * count);
  });

  return {
    tangents(mesh, given) {
      const { kind } = options(given, { kind: 'mikktspace' });
      choice(kind, 'options.kind', ['mikktspace', 'area-weighted', 'vertex']);
      return withMesh(mesh, (s, m, at) => {
        const out = s.allocate(16 * m.corners);
        s.call('cotan_tangents', s.text(kind), at, 1, out);
        return s.take(Float32Array, out, 4 * m.corners);
      });
    },

    smooth(mesh) {
      return withMesh(mesh, (s, m, at) =>
        vectorPairs(s, m.vertices, (u, v) => s.call('cotan_smooth_cotangents', at, u, v)));
    },

    triangles(mesh) {
      return withMesh(mesh, (s, m, at) =>
        vectorPairs(s, m.corners / 3, (u, v) => s.call('cotan_triangle_vectors', at, 1, u, v)));
    },

    split(vertexCount, indices, corners) {
      const list = triangleIndices(indices, 'indices');
      const values = floats(corners, 'corners', 4, list.length);
      counted(vertexCount);
      return library.run((s) => splitBy(s, vertexCount, list.length, (...out) =>
        s.call('cotan_split_vertices', vertexCount, list.length, s.put(list), s.put(values), ...out)));
    },

    splitMirrored(mesh) {
      return withMesh(mesh, (s, m, at) => splitBy(s, m.vertices, m.corners, (...out) =>
        s.call('cotan_split_mirrored', at, ...out)));
    },

    packTriangles(u, v) {
      const us = floats(u, 'u', 3), vs = floats(v, 'v', 3, us.length / 3);
      return pack([us, vs], 'cotan_pack_triangles', 3, us, Uint32Array, 3);
    },

    packSmooth(normals, u, v, given) {
      const { bytes } = options(given, { bytes: 8 });
      choice(bytes, 'options.bytes', [4, 8]);
      const ns = floats(normals, 'normals', 3), us = floats(u, 'u', 3, ns.length / 3), vs = floats(v, 'v', 3, ns.length / 3);
      return bytes === 8 ? pack([ns, us, vs], 'cotan_pack_smooth8', 3, ns, Int16Array, 4)
        : pack([ns, us, vs], 'cotan_pack_smooth4', 3, ns, Uint32Array, 1);
    },

    packTangents(normals, tangents) {
      const ns = floats(normals, 'normals', 3), ts = floats(tangents, 'tangents', 4, ns.length / 3);
      return pack([ns, ts], 'cotan_pack_tangents', 3, ns, Uint16Array, 1);
    },
  };
}
