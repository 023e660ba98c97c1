// Which way green of a normal map points according to stored tangents.
import { cornersOf, numbersOf, uvMatrixOf, uvNameOf } from './mesh_data.js';

// The same rule as in the library (scene/normal_maps.hpp): fractions of the compared area on which tangents contradict the
// uv. From kDecided on green is reversed; between the two, all meshes that show the map decide together.
const kDecided = 0.9, kMentioned = 0.1;
const fractionOf = ({ compared, contradicting }) => (compared > 0 ? contradicting / compared : 0);
const unclear = vote => !(vote.compared > 0) || fractionOf(vote) > kMentioned && fractionOf(vote) < kDecided;

// Whether GLTFLoader made this texture. Then v runs down the image, green is declared to point against v, and the
// loader has flipped the sign of normalScale.y in materials of meshes without tangents.
export const ofGltf = map => map?.userData?.mimeType !== undefined;

// Areas of a geometry by the direction of the bitangent cross(normal, tangent) * tangent.w: `against` or `along`
// increasing v of the geometry, before a texture transforms it: tangents belong to these uv. `aligned` is the part of `along` where the tangent is within 90 degrees of dP/du. Each corner counts a
// third of its triangle. Triangles without area in space or in uv and corners without a tangent are left out.
function bitangentAreas(geometry, uvName) {
  const { position, normal, [uvName]: coordinates, tangent } = geometry.attributes, areas = { against: 0, along: 0, aligned: 0 };
  if (!position || !normal || !coordinates || !tangent) return areas;
  const corners = cornersOf(geometry), p = numbersOf(position, 3), n = numbersOf(normal, 3), t = numbersOf(tangent, 4), uv = numbersOf(coordinates, 2);
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
  #areas = new Map();  // by geometry, then by uv set
  #maps = new Map(); // by image: { compared, contradicting, name, used }; areas of all geometries that show it

  #areasOf(geometry, map) {
    if (!this.#areas.has(geometry)) this.#areas.set(geometry, new Map());
    const known = this.#areas.get(geometry), name = uvNameOf(map);
    if (!known.has(name)) known.set(name, bitangentAreas(geometry, name));
    return known.get(name);
  }

  // The areas where bitangents point along and against increasing v as the map is read, transformed.
  areas(geometry, map) {
    const { along, against } = this.#areasOf(geometry, map), [a, b, c, d] = uvMatrixOf(map);
    return a * d - b * c < 0 ? { along: against, against: along } : { along, against };
  }

  #voteOf(geometry, map) {
    const { along, against, aligned } = this.#areasOf(geometry, map);
    return { compared: along + against, contradicting: aligned };
  }

  // Counts a geometry with tangents whose material reads the map.
  add(geometry, map, material) {
    if (!ofGltf(map)) return;
    if (!this.#maps.has(map.source)) this.#maps.set(map.source, { compared: 0, contradicting: 0, used: new Map(),
      name: map.name ? `normal map '${map.name}'` : `the normal map of material '${material.name}'` });
    const whole = this.#maps.get(map.source), use = `${geometry.uuid} ${uvNameOf(map)}`;
    if (whole.used.has(use)) return;
    const vote = this.#voteOf(geometry, map);
    whole.used.set(use, vote);
    whole.compared += vote.compared;
    whole.contradicting += vote.contradicting;
  }

  // Whether green of a glTF map is to be read reversed on a geometry with tangents.
  reversed(geometry, map) {
    return this.#reversed(this.#voteOf(geometry, map), this.#maps.get(map.source));
  }
  #reversed(vote, whole) { return fractionOf(unclear(vote) ? whole : vote) >= kDecided; }

  // One line for each map that is reversed on some geometry, or on which tangents contradict the texture coordinates.
  notes() {
    return [...this.#maps.values()].map(whole => {
      const votes = [...whole.used.values()], reversed = votes.filter(vote => this.#reversed(vote, whole)).length;
      if (reversed === 0 && fractionOf(whole) < kMentioned) return '';
      const begin = `TANGENT.w contradicts the texture coordinates on ${Math.round(100 * fractionOf(whole))} % of the area of ${whole.name}`;
      const where = reversed < votes.length ? ` in ${reversed} of ${votes.length} geometries` : '';
      return reversed > 0 ? `${begin}: without stored tangents its green is flipped${where} (the option convention overrides this)`
        : `${begin}: its green is read as declared (the option convention overrides this)`;
    }).filter(Boolean);
  }
}
