// Which way green of a normal map runs, where stored tangents say so.
import { cornersOf, numbersOf, readingOf, turnedUv, turnOf, uvNameOf } from './mesh_data.js';

// Of the area that was compared: from the first on stored tangents decide, from the second on they are mentioned.
const kDecided = 0.9, kMentioned = 0.1;

// Whether three's loader for glTF made this texture: v runs down, green is declared to run against v, and materials of
// meshes without tangents have had the sign of their scale turned.
export const ofGltf = map => map?.userData?.mimeType !== undefined;

// Areas of a geometry by where cross(normal, tangent) * tangent.w points, a third of each triangle for its corners: against
// increasing v; along it; and of that `aligned`, where the tangent lies within 90 degrees of dP/du. Corners of triangles
// without area in space or in uv, and without a tangent, do not count.
function bitangentAreas(geometry, map) {
  const { position, normal, [uvNameOf(map)]: coordinates, tangent } = geometry.attributes, areas = { against: 0, along: 0, aligned: 0 };
  if (!position || !normal || !coordinates || !tangent) return areas;
  const corners = cornersOf(geometry), p = numbersOf(position, 3), n = numbersOf(normal, 3), t = numbersOf(tangent, 4), uv = turnedUv(coordinates, turnOf(map));
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
      const way = Math.sign(side * facing * t[corner * 4 + 3]);
      if (!way || !(length > 0)) continue;
      areas[way > 0 ? 'along' : 'against'] += third;
      if (way > 0 && alongU > 0) areas.aligned += third;
    }
  }
  return areas;
}

// What stored tangents say of the normal maps of some meshes. Call it before tangents are removed.
export class StoredGreens {
  #areas = new Map();  // by geometry, then by how the map reads it
  #shares = new Map(); // by image: { compared, contradicting, name, used }

  areas(geometry, map) {
    if (!this.#areas.has(geometry)) this.#areas.set(geometry, new Map());
    const known = this.#areas.get(geometry), reading = readingOf(map);
    if (!known.has(reading)) known.set(reading, bitangentAreas(geometry, map));
    return known.get(reading);
  }

  // A geometry with tangents whose material reads the map.
  add(geometry, map, material) {
    if (!ofGltf(map)) return;
    if (!this.#shares.has(map.source)) this.#shares.set(map.source, { compared: 0, contradicting: 0, used: new Set(),
      name: map.name ? `normal map '${map.name}'` : `the normal map of material '${material.name}'` });
    const share = this.#shares.get(map.source), use = `${geometry.uuid} ${readingOf(map)}`;
    if (share.used.has(use)) return;
    share.used.add(use);
    const { along, against, aligned } = this.areas(geometry, map);
    share.compared += along + against;
    share.contradicting += aligned;
  }

  // Of what was compared, 0 where nothing was.
  #contradiction({ compared, contradicting }) { return compared > 0 ? contradicting / compared : 0; }

  // Whether green of a map of glTF is read the other way than declared; undefined where no mesh with tangents reads it.
  reversed(map) {
    const share = this.#shares.get(map.source);
    return share && share.compared > 0 ? this.#contradiction(share) >= kDecided : undefined;
  }

  // One line for each map whose tangents contradict the texture coordinates.
  notes() {
    return [...this.#shares.values()].map(share => [this.#contradiction(share), share.name]).filter(([part]) => part >= kMentioned).map(([part, name]) => {
      const begin = `TANGENT.w contradicts the texture coordinates on ${Math.round(100 * part)} % of the area of ${name}`;
      return part >= kDecided ? `${begin}: without stored tangents its green is read the other way (the option convention overrides this)`
        : `${begin}: its green is read as declared (the option convention overrides this)`;
    });
  }
}
