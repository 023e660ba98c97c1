// Which way green of a normal map points according to stored tangents.
import { dot } from './vectors.js';

// Whether GLTFLoader made this texture. Then v runs down the image, green is declared to point against v, and the
// loader has flipped the sign of normalScale.y in materials of meshes without tangents.
export const ofGltf = map => map?.userData?.mimeType !== undefined;

// Areas of a surface by the direction of the bitangent cross(normal, tangent) * w: `against` or `along` increasing v.
// `aligned` is the part of `along` where the tangent is within 90 degrees of dP/du. Points without tangents are left out.
export function bitangentAreas(sample) {
  const [place] = sample.places, areas = { against: 0, along: 0, aligned: 0 }, { count, total } = place;
  const stored = sample.framesAt(place, 'stored'), own = sample.framesAt(place, 'orthonormal');
  for (let k = 0; k < count; ++k) {
    const direction = dot(stored, 6 * k + 3, own, 6 * k + 3);
    if (!direction) continue;
    areas[direction > 0 ? 'along' : 'against'] += total / count;
    if (direction > 0 && dot(stored, 6 * k, own, 6 * k) > 0) areas.aligned += total / count;
  }
  return areas;
}

// Collects which maps are read with green reversed on meshes whose tangents are removed.
export class GreenNotes {
  #maps = new Map(); // by image: { name, compared, contradicting, used, reversed }

  add(map, material, { along, against, aligned }, reversed) {
    if (!this.#maps.has(map.source)) this.#maps.set(map.source, { compared: 0, contradicting: 0, used: 0, reversed: 0,
      name: map.name ? `normal map '${map.name}'` : `the normal map of material '${material.name}'` });
    const whole = this.#maps.get(map.source);
    whole.compared += along + against;
    whole.contradicting += aligned;
    ++whole.used;
    if (reversed) ++whole.reversed;
  }

  // One line for each map that is reversed on some geometry.
  lines() {
    return [...this.#maps.values()].filter(({ reversed }) => reversed).map(({ name, compared, contradicting, used, reversed }) =>
      `TANGENT.w contradicts the texture coordinates on ${Math.round(100 * contradicting / compared)} % of the area of ${name}: without stored tangents its green is flipped`
      + `${reversed < used ? ` in ${reversed} of ${used} geometries` : ''} (the option convention overrides this)`);
  }
}
