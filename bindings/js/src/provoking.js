// Vertices for shaders that make U and V of the frame `triangle` at the vertex that provokes it.
import { choice, options, words } from './arrays.js';
import { counted, splitBy } from './tangents.js';

export const provokingFunction = (library) => (vertexCount, indices, given) => {
  const { vertex } = options(given, { vertex: 'first' });
  choice(vertex, 'options.vertex', ['first', 'last']);
  const list = words(indices, 'indices');
  counted(vertexCount);
  return library.run((s) => {
    const corners = s.room(4 * list.length);
    const split = splitBy(s, vertexCount, list.length, (...out) =>
      s.call('cotan_provoking', vertexCount, list.length, s.put(list), vertex === 'last' ? 1 : 0, ...out, corners));
    return { ...split, corners: s.take(Uint32Array, corners, list.length) };
  });
};
