// Renumbers vertices for shaders that compute U and V of the frame `triangle` at the provoking vertex.
import { choice, options, triangleIndices } from './arrays.js';
import { counted, splitBy } from './tangents.js';

export const provokingFunction = (library) => (vertexCount, indices, given) => {
  const { vertex } = options(given, { vertex: 'first' });
  choice(vertex, 'options.vertex', ['first', 'last']);
  const list = triangleIndices(indices, 'indices');
  counted(vertexCount);
  return library.run((s) => {
    const corners = s.allocate(4 * list.length);
    const split = splitBy(s, vertexCount, list.length, (...out) =>
      s.call('cotan_provoking', vertexCount, list.length, s.put(list), vertex === 'last' ? 1 : 0, ...out, corners));
    return { ...split, corners: s.take(Uint32Array, corners, list.length) };
  });
};
