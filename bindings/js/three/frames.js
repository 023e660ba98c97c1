// Which frame a normal map is read with.
import { choice } from '../src/arrays.js';
import { turnedUv, turnOf, uvNameOf } from './mesh_data.js';
import { ofGltf } from './greens.js';

export const kDrawn = ['cotangent', 'orthonormal', 'smooth', 'triangle'];
export const kFrames = ['auto', ...kDrawn];
export const kKey = 'cotanFrame'; // of a material's userData: glTF's extras

export const mapOf = material => material.normalMap ?? material.clearcoatNormalMap;

// The frame that a material names for its maps; undefined where it names none. Maps for MikkTSpace are read as
// `orthonormal`. warn: gets a line about a name that is not drawn here.
export function namedFrame(material, warn = () => {}) {
  const found = material.userData?.[kKey];
  if (found === undefined) return undefined;
  if (kDrawn.includes(found)) return found;
  if (found === 'mikktspace' || found === 'vertex') return 'orthonormal';
  if (found === 'exact') return 'cotangent'; // the same directions
  warn(`material "${material.name}": ${kKey}: expected ${kDrawn.join(', ')}, found ${JSON.stringify(found)}: it is ignored`);
  return undefined;
}

// The frame that a material alone is given: the one that is wished for, else the one that it names, else `orthonormal`.
export function frameFor(material, wished = 'auto') {
  choice(wished, 'options.frame', kFrames);
  return wished === 'auto' ? namedFrame(material) ?? 'orthonormal' : wished;
}

// The frame of a map that no frame is named for. Maps of models mean MikkTSpace, whose nearest is `orthonormal`; maps that
// the texture coordinates repeat, and those on three's shapes, were painted without a model and stretch: `cotangent`.
// tangents: whether the mesh has or had stored ones, which say that it is a model.
export function meantFrame(geometry, map, tangents) {
  if (!map) return 'cotangent';
  const shape = geometry.parameters !== undefined;
  return tangents || ofGltf(map) || !shape && !repeats(geometry, map) ? 'orthonormal' : 'cotangent';
}

const kEdge = 0.01; // of the map, that charts may stand over

function repeats({ attributes }, map) {
  const uv = attributes[uvNameOf(map)];
  if (!uv) return false;
  const turned = turnedUv(uv, turnOf(map)), low = [Infinity, Infinity], high = [-Infinity, -Infinity];
  for (let k = 0; k < turned.length; ++k) {
    low[k % 2] = Math.min(low[k % 2], turned[k]);
    high[k % 2] = Math.max(high[k % 2], turned[k]);
  }
  return high.some((value, i) => value - low[i] > 1 + kEdge);
}
