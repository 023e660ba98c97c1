// Which way green of a normal map points according to stored tangents.
import { cornersOf, numbersOf, readingOf, transformedUv, uvMatrixOf, uvNameOf } from './mesh_data.js';

// Fractions of the compared area on which tangents contradict the uv: from kDecided on tangents decide the direction of
// green, from kMentioned on there is a note.
const kDecided = 0.9, kMentioned = 0.1;

// Whether GLTFLoader made this texture. Then v runs down the image, green is declared to point against v, and the
// loader has flipped the sign of normalScale.y in materials of meshes without tangents.
export const ofGltf = map => map?.userData?.mimeType !== undefined;

// Areas of a geometry by the direction of the bitangent cross(normal, tangent) * tangent.w: `against` or `along`
// increasing v. `aligned` is the part of `along` where the tangent is within 90 degrees of dP/du. Each corner counts a
// third of its triangle. Triangles without area in space or in uv and corners without a tangent are left out.
function bitangentAreas(geometry, map) {
  const { position, normal, [uvNameOf(map)]: coordinates, tangent } = geometry.attributes, areas = { against: 0, along: 0, aligned: 0 };
  if (!position || !normal || !coordinates || !tangent) return areas;
  const corners = cornersOf(geometry), p = numbersOf(position, 3), n = numbersOf(normal, 3), t = numbersOf(tangent, 4), uv = transformedUv(coordinates, uvMatrixOf(map));
  const e1 = [0, 0, 0], e2 = [0, 0, 0];
  for (let k = 0; k + 2 < corners.length; k += 3) {
    const [a, b, c] = corners.subarray(k, k + 3);
    for (let i = 0; i < 3; ++i) {
      e1[i] = p[b * 3 + i] - p[a * 3 + i];
      e2[i] = p[c * 3 + i] - p[a * 3 + i];
    }
    const v1 = uv[b * 2 + 1] - uv[a * 2 + 1], v2 = uv[c * 2 + 1] - uv[a * 2 + 1];
    const side = Math.sign((uv[b * 2] - uv[a * 2]) * v2 - v1 * (uv[c * 2] - uv[a * 2]));
    const face = [e1[1] * e2[2] - e1[2] * e2[1], e1[2] * e2[0] - e1[0] * e2[2], e1[0] * e2[1] - e1[1] * e2[0]];
    const third = Math.hypot(...face) / 6;
    if (!side || !(third > 0)) continue;
    for (const corner of [a, b, c]) {
      let facing = 0, alongU = 0, length = 0;
      for (let i = 0; i < 3; ++i) {
        facing += face[i] * n[corner * 3 + i];
        alongU += (e1[i] * v2 - e2[i] * v1) * side * t[corner * 4 + i];
        length += t[corner * 4 + i] ** 2;
      }
      const direction = Math.sign(side * facing * t[corner * 4 + 3]);
      if (!direction || !(length > 0)) continue;
      areas[direction > 0 ? 'along' : 'against'] += third;
      if (direction > 0 && alongU > 0) areas.aligned += third;
    }
  }
  return areas;
}

// Collects what the stored tangents of meshes say about their normal maps. To be used before the tangents are removed.
export class StoredGreens {
  #areas = new Map();  // by geometry, then by readingOf(map)
  #votes = new Map(); // by image: { compared, contradicting, name, used }, the first two are areas

  areas(geometry, map) {
    if (!this.#areas.has(geometry)) this.#areas.set(geometry, new Map());
    const known = this.#areas.get(geometry), reading = readingOf(map);
    if (!known.has(reading)) known.set(reading, bitangentAreas(geometry, map));
    return known.get(reading);
  }

  // Counts a geometry with tangents whose material reads the map.
  add(geometry, map, material) {
    if (!ofGltf(map)) return;
    if (!this.#votes.has(map.source)) this.#votes.set(map.source, { compared: 0, contradicting: 0, used: new Set(),
      name: map.name ? `normal map '${map.name}'` : `the normal map of material '${material.name}'` });
    const vote = this.#votes.get(map.source), use = `${geometry.uuid} ${readingOf(map)}`;
    if (vote.used.has(use)) return;
    vote.used.add(use);
    const { along, against, aligned } = this.areas(geometry, map);
    vote.compared += along + against;
    vote.contradicting += aligned;
  }

  // The contradicting fraction of the compared area; 0 if nothing was compared.
  #contradiction({ compared, contradicting }) { return compared > 0 ? contradicting / compared : 0; }

  // Whether green of a glTF map is to be read reversed; undefined if no mesh with tangents reads the map.
  reversed(map) {
    const vote = this.#votes.get(map.source);
    return vote && vote.compared > 0 ? this.#contradiction(vote) >= kDecided : undefined;
  }

  // One line for each map on which tangents contradict the texture coordinates.
  notes() {
    return [...this.#votes.values()].map(vote => [this.#contradiction(vote), vote.name]).filter(([fraction]) => fraction >= kMentioned).map(([fraction, name]) => {
      const begin = `TANGENT.w contradicts the texture coordinates on ${Math.round(100 * fraction)} % of the area of ${name}`;
      return fraction >= kDecided ? `${begin}: without stored tangents its green is flipped (the option convention overrides this)`
        : `${begin}: its green is read as declared (the option convention overrides this)`;
    });
  }
}
