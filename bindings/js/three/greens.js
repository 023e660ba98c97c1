// Which way green of a normal map points according to stored tangents.
import { numbersOf, transformedUv, uvMatrixOf, uvNameOf } from './mesh_data.js';

const kMentioned = 0.1; // fraction of the area on which tangents contradict the uv, from which it is said

// Whether GLTFLoader made this texture. Then v runs down the image, green is declared to point against v, and the
// loader has flipped the sign of normalScale.y in materials of meshes without tangents.
export const ofGltf = map => map?.userData?.mimeType !== undefined;

// Areas of a surface by the direction of the bitangent cross(normal, tangent) * w: `against` or `along` increasing v.
// `aligned` is the part of `along` where the tangent is within 90 degrees of dP/du. Points without tangents are left out.
// tangents: at the vertices, for the same uv as those of the sample.
export function bitangentAreas(sample, tangents) {
  const [place] = sample.places, areas = { against: 0, along: 0, aligned: 0 }, { count, total } = place;
  const stored = sample.framesAt(place, 'stored', tangents), own = sample.framesAt(place, 'orthonormal');
  const dot = (k, from) => stored[6 * k + from] * own[6 * k + from] + stored[6 * k + from + 1] * own[6 * k + from + 1] + stored[6 * k + from + 2] * own[6 * k + from + 2];
  for (let k = 0; k < count; ++k) {
    const direction = dot(k, 3);
    if (!direction) continue;
    areas[direction > 0 ? 'along' : 'against'] += total / count;
    if (direction > 0 && dot(k, 0) > 0) areas.aligned += total / count;
  }
  return areas;
}

// The tangents of the geometry, four numbers for each vertex. Those of a glTF belong to its uv before the texture's
// transform, and are moved to the uv after it, as the library does (transformTangents): dP/du' is vRow.y dP/du - vRow.x dP/dv
// over the determinant.
export function storedTangents(geometry, map, corners) {
  const { position, normal, tangent, [uvNameOf(map)]: coordinates } = geometry.attributes, given = numbersOf(tangent, 4);
  const [a, b, c, d] = uvMatrixOf(map), determinant = a * d - b * c;
  if (!ofGltf(map) || !(Math.abs(determinant) > 0) || !normal || b === 0 && c === 0 && a > 0 && d > 0) return given;
  const moved = Float64Array.from(given), side = Math.sign(determinant), turned = c && new Float64Array(2 * tangent.count);
  if (c) addTurns({ corners, position: numbersOf(position, 3), normal: numbersOf(normal, 3), uv: transformedUv(coordinates) }, c / determinant, d / determinant, turned);
  const n = numbersOf(normal, 3);
  for (let k = 0; k < tangent.count; ++k) {
    const t = moved.subarray(4 * k, 4 * k + 4), [x, y, z] = t;
    t[3] *= side;
    let along = d * side < 0 ? -1 : 1, across = 0;
    if (c) {
      const length = Math.hypot(turned[2 * k], turned[2 * k + 1]);
      if (!(length > 0 && length < Infinity)) continue;
      along = turned[2 * k] / length;
      across = turned[2 * k + 1] / length;
    }
    const nx = n[3 * k], ny = n[3 * k + 1], nz = n[3 * k + 2], scale = across / (Math.hypot(nx, ny, nz) || 1);
    t[0] = along * x + scale * (ny * z - nz * y);
    t[1] = along * y + scale * (nz * x - nx * z);
    t[2] = along * z + scale * (nx * y - ny * x);
  }
  return moved;
}

// For each vertex: dP/du' in the basis of dP/du and n x dP/du, times area.
function addTurns({ corners, position, normal, uv }, c, d, turned) {
  const u = [0, 0, 0], v = [0, 0, 0], e1 = [0, 0, 0], e2 = [0, 0, 0];
  for (let k = 0; k < corners.length; k += 3) {
    const [p, q, r] = corners.subarray(k, k + 3), u1 = uv[2 * q] - uv[2 * p], v1 = uv[2 * q + 1] - uv[2 * p + 1], u2 = uv[2 * r] - uv[2 * p], v2 = uv[2 * r + 1] - uv[2 * p + 1];
    const area = u1 * v2 - v1 * u2;
    for (let i = 0; i < 3; ++i) {
      e1[i] = position[3 * q + i] - position[3 * p + i];
      e2[i] = position[3 * r + i] - position[3 * p + i];
      u[i] = (e1[i] * v2 - e2[i] * v1) / area;
      v[i] = (e2[i] * u1 - e1[i] * u2) / area;
    }
    const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]], face = cross(e1, e2), length = Math.hypot(...u);
    if (!(length > 0 && length < Infinity) || !v.every(Number.isFinite)) continue;
    const alongV = (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]) / length, across = Math.hypot(...cross(u, v)) / length * (area < 0 ? -1 : 1);
    for (const vertex of [p, q, r]) {
      const side = face[0] * normal[3 * vertex] + face[1] * normal[3 * vertex + 1] + face[2] * normal[3 * vertex + 2] < 0 ? -1 : 1;
      turned[2 * vertex] += Math.hypot(...face) * (d * length - c * alongV);
      turned[2 * vertex + 1] -= Math.hypot(...face) * c * across * side;
    }
  }
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

  // One line for each map that is reversed on some geometry, or on which tangents contradict the texture coordinates.
  lines() {
    return [...this.#maps.values()].map(({ name, compared, contradicting, used, reversed }) => {
      const fraction = compared > 0 ? contradicting / compared : 0;
      if (reversed === 0 && fraction < kMentioned) return '';
      const begin = `TANGENT.w contradicts the texture coordinates on ${Math.round(100 * fraction)} % of the area of ${name}`;
      const where = reversed < used ? ` in ${reversed} of ${used} geometries` : '';
      return reversed > 0 ? `${begin}: without stored tangents its green is flipped${where} (the option convention overrides this)`
        : `${begin}: its green is read as declared (the option convention overrides this)`;
    }).filter(Boolean);
  }
}
