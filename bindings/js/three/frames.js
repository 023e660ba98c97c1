// Chooses the frame that a normal map is read with.
import { choice } from '../src/arrays.js';
import { readingOf, transformedUv, uvNameOf } from './mesh_data.js';
import { ofGltf } from './greens.js';

export const kSupported = ['cotangent', 'orthonormal', 'smooth', 'triangle'];
export const kFrames = ['auto', ...kSupported];
export const kKey = 'cotanFrame'; // in a material's userData, which are the extras of glTF

export const isGrooved = material => material.anisotropy > 0;

// The map whose texture coordinates tangents and the direction of anisotropy are for: that of bumps, else of anisotropy, else of
// the coat. Without any it is set 0.
export const mapOf = material => material.normalMap ?? (isGrooved(material) ? material.anisotropyMap : null) ?? material.clearcoatNormalMap;

// Whether a map of the material has other texture coordinates than mapOf(): then it needs a frame of its own.
export const standsAlone = (material, map) => !!map && readingOf(map) !== readingOf(mapOf(material));

// What a file says about a map's frame: of the primitive, else of the material.
const nameIn = (material, geometry) => geometry?.userData?.[kKey] ?? material.userData?.[kKey];

// The supported frame for the name in the userData of the geometry or material: `orthonormal` for MikkTSpace. Undefined if
// there is none. warn: called with a line about an unsupported name.
export function namedFrame(material, warn = () => {}, geometry = undefined) {
  const found = nameIn(material, geometry);
  if (found === undefined) return undefined;
  if (kSupported.includes(found)) return found;
  if (/^(mikktspace|vertex|area-weighted)$/.test(found)) return 'orthonormal';
  if (found === 'exact') return 'cotangent'; // has the same directions
  warn(`material "${material.name}": ${kKey}: expected ${kSupported.join(', ')}, found ${JSON.stringify(found)}: it is ignored`);
  return undefined;
}

// Whether the maps are for tangents: not if the file names a frame without them.
export const meansTangents = (material, geometry) => ![...kSupported, 'exact', 'gradient'].includes(nameIn(material, geometry));

// The frame for a material alone: the requested one, else the one that the material names, else `orthonormal`.
export function frameFor(material, requested = 'auto') {
  choice(requested, 'options.frame', kFrames);
  return requested === 'auto' ? namedFrame(material) ?? 'orthonormal' : requested;
}

// Guesses the frame of a map whose material names none. Maps of models are assumed to be made for MikkTSpace, to which
// `orthonormal` is nearest. Tiled maps and maps on three's own shapes were painted without a model and get `cotangent`,
// which is exact where they stretch. tangents: whether the mesh has stored tangents, a sign of a model.
export function guessedFrame(geometry, map, tangents) {
  if (!map) return 'cotangent';
  const shape = geometry.parameters !== undefined;
  return tangents || ofGltf(map) || !shape && !repeats(geometry, map) ? 'orthonormal' : 'cotangent';
}

const kEdge = 0.01; // tolerance by which uv may exceed the range of one tile

function repeats({ attributes }, map) {
  const uv = attributes[uvNameOf(map)];
  if (!uv) return false;
  const transformed = transformedUv(uv, map);
  return [0, 1].some(i => {
    let low = Infinity, high = -Infinity;
    for (let k = i; k < transformed.length; k += 2) {
      low = Math.min(low, transformed[k]);
      high = Math.max(high, transformed[k]);
    }
    return high - low > 1 + kEdge;
  });
}
