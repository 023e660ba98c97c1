// Frames at surface points, and shader text.
import { choice, floats, options } from './arrays.js';
import { usage, wordsFor } from './instance.js';

export function frameFunctions(library) {
  const kAtVertices = { mikktspace: ['tangents'], 'area-weighted': ['tangents'], vertex: ['tangents'], smooth: ['u', 'v'] }; // attributes, by frame
  const namesOf = (s) => Array.from({ length: s.wasm.cotan_frame_count() }, (_, i) => s.textAt(s.wasm.cotan_frame_name(i)));
  const atPoints = (functions, what) => (frame, points, values) => library.run((s) => {
    choice(frame, 'frame', namesOf(s));
    if (points === null || typeof points !== 'object') throw usage(`points: expected an object of arrays, found ${wordsFor(points)}`);
    const normals = floats(points.normals, 'points.normals', 3), count = normals.length / 3;
    const array = (name, size) => s.put(floats(points[name], `points.${name}`, size, count));
    const given = s.put(floats(values, what, 3, count)), out = s.allocate(12 * count);
    const name = s.text(frame, 'frame'), read = kAtVertices[frame], attribute = (one, size) => (read.includes(one) ? array(one, size) : 0);
    if (read)
      s.call(functions[1], name, s.struct(count, s.put(normals), attribute('tangents', 4), attribute('u', 3), attribute('v', 3)), given, out);
    else
      s.call(functions[0], name, s.struct(count, s.put(normals), array('dpdx', 3), array('dpdy', 3), array('duvdx', 2), array('duvdy', 2)), given, out);
    return s.take(Float32Array, out, 3 * count);
  });

  return {
    apply: atPoints(['cotan_frame_apply', 'cotan_vertex_frame_apply'], 'texels'),
    encode: atPoints(['cotan_frame_encode', 'cotan_vertex_frame_encode'], 'normals'),
    frames: () => library.run(namesOf),
    shader: (given) => library.run((s) => {
      const o = options(given, { language: 'glsl', frame: '', convention: 'gltf,exact', stage: undefined });
      if (o.stage !== undefined) choice(o.stage, 'options.stage', ['fragment', 'vertex', 'mesh', 'compute']);
      s.text(o.frame, 'options.frame');
      const frame = s.text(o.stage ? `${o.frame},${o.stage}` : o.frame, 'options.frame');
      const words = [s.text(o.language, 'options.language'), frame, s.text(o.convention, 'options.convention')];
      const size = s.put(new Uint32Array(1));
      s.call('cotan_shader_text', ...words, 0, size);
      const text = s.allocate(s.view(Uint32Array, size, 1)[0]);
      s.call('cotan_shader_text', ...words, text, size);
      return s.textAt(text);
    }),
  };
}
