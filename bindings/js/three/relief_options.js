// The options of addRelief() for both renderers. They are properties of the material, so that they can change later.
import { checkTypes, options as checked } from '../src/arrays.js';
import { usage, wordsFor } from '../src/errors.js';
import { keepInClones } from './clones.js';

export const kHalvings = 6; // readings after those that find the relief
const kMaxSteps = 256;

// Checks the arguments of addRelief(), stores the options in the material, and calls add(material), also for its clones.
export function withRelief(material, given, add) {
  if (!material?.isMaterial) throw usage(`material: expected a Material, found ${wordsFor(material)}`);
  if (!material.normalScale)
    throw usage(`material: expected one of the kinds that have a normalMap, as MeshStandardMaterial, found ${material.type}`);
  const o = checked(given, { heightMap: undefined, heightDepth: undefined, heightSteps: 16, selfShadow: true });
  const { heightMap, heightDepth, heightSteps } = o;
  if (!heightMap?.isTexture || heightMap.isCubeTexture || heightMap.isData3DTexture || heightMap.isDataArrayTexture)
    throw usage(`options.heightMap: expected a Texture of two dimensions, found ${wordsFor(heightMap)}`);
  if (heightMap.colorSpace.startsWith('srgb'))
    throw usage(`options.heightMap: expected colorSpace NoColorSpace, as heights are stored, found '${heightMap.colorSpace}'`);
  if (!(typeof heightDepth === 'number' && heightDepth >= 0 && heightDepth < Infinity))
    throw usage(`options.heightDepth: expected a length of 0 or more, found ${wordsFor(heightDepth)}`);
  if (!(Number.isInteger(heightSteps) && heightSteps >= 1 && heightSteps <= kMaxSteps))
    throw usage(`options.heightSteps: expected an integer from 1 to ${kMaxSteps}, found ${wordsFor(heightSteps)}`);
  checkTypes(o, 'boolean', 'selfShadow');
  Object.assign(material, o, { needsUpdate: true });
  add(material);
  return keepInClones(material, 'relief', (clone, source) => { if (source.heightMap) withRelief(clone, reliefOf(source), add); });
}

const reliefOf = ({ heightMap, heightDepth, heightSteps, selfShadow }) => ({ heightMap, heightDepth, heightSteps, selfShadow });

// Text that differs where the shaders of materials with a relief do.
export const keyOfRelief = ({ heightMap, heightSteps, selfShadow }) => ['relief', heightMap?.channel ?? 'none', heightSteps, selfShadow].join();

// The text of `cotan shader` with other names, so that it can be in a shader that also has the text of a frame.
export const renamed = text => text.replaceAll('cotan_', 'cotanr_');
