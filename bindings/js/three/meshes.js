// Prepares meshes for both renderers of three.js before frames are replaced: removes tangents, adapts materials so that
// they look the same without them, and adds the attributes of the frames `triangle` and `smooth` to geometries.
import { checkTypes, choice, options as checked } from '../src/arrays.js';
import { usage, wordsFor } from '../src/errors.js';
import { kFrames, kKey, mapOf, guessedFrame, namedFrame, readsTangents } from './frames.js';
import { ofGltf, StoredGreens } from './greens.js';
import { readingOf, uvNameOf } from './mesh_data.js';
import { kSmoothAttributes, withSmooth } from './smooth.js';
import { kTriangleAttribute, withTriangles } from './triangles.js';

const kScales = { normalScale: 'normalMap', clearcoatNormalScale: 'clearcoatNormalMap' };
const kConventions = ['gltf', 'directx'];

// State of materials that have a frame of ours: { frame, against, wants }. against: whether bitangents run against v.
// wants: for each scale, whether green in the file points along v (1) or against it (-1); the scale includes this sign.
const known = new WeakMap();

// Checks the options of untangle() and fills in defaults.
export function untangleOptions(given, more = {}) {
  const o = checked(given, { frame: undefined, convention: undefined, note: undefined, ...more });
  o.note ??= line => console.info(`Cotan: ${line}`);
  if (o.frame !== undefined) choice(o.frame, 'options.frame', kFrames);
  if (o.convention !== undefined) choice(o.convention, 'options.convention', kConventions);
  checkTypes(o, 'function', 'note');
  return o;
}

// Checks the arguments of replaceFrame() and fills in defaults.
export function replaceOptions(material, given, more) {
  if (!material?.isMaterial) throw usage(`material: expected a Material, found ${wordsFor(material)}`);
  const o = checked(given, { frame: undefined, against: false, ...more });
  checkTypes(o, 'boolean', 'against');
  if (o.from !== undefined && !o.from?.isMaterial) throw usage(`options.from: expected a Material, found ${wordsFor(o.from)}`);
  return o;
}

const keeping = new WeakSet(); // materials whose clone() was replaced

// Makes material.clone() call replace(clone, material), which applies the frame to the clone. Does not affect copy().
export function keepInClones(material, replace) {
  if (keeping.has(material)) return material;
  keeping.add(material);
  const { clone } = material;
  return Object.defineProperty(material, 'clone', { configurable: true, writable: true, value() {
    const made = clone.call(material);
    replace(made, material);
    if (known.has(material)) known.set(made, known.get(material));
    return made;
  } });
}

// Removes the tangents of all meshes of `target`, an Object3D or GLTFLoader's result, and calls
// replace(material, { frame, against, from }) for every material with a normalScale. frame: one of kSupported. against:
// whether the bitangents of the material's anisotropy run against increasing v. o: options from untangleOptions().
// provoking: which vertex of a triangle flat values are taken from. instances, triangles, deformed: whether the
// renderer supports stored frames on instanced meshes, the frame `triangle`, and `smooth` on skinned meshes.
export function untangleMeshes(target, o, { provoking = 'last', instances = true, deformed = true, triangles = true }, replace) {
  const roots = target?.isObject3D ? [target] : target?.scenes;
  if (!roots) throw usage(`target: expected an Object3D or the result of GLTFLoader, found ${wordsFor(target)}`);
  const meshes = new Set();
  for (const root of roots) root.traverse(child => { if (child.isMesh) meshes.add(child); });
  const reported = new Set(), once = report => line => { if (!reported.has(line)) report(line); reported.add(line); };
  const all = { o, provoking, instances, deformed, triangles, loaded: !target.isObject3D, greens: new StoredGreens(), made: new Map(),
    note: once(o.note), warn: once(line => console.warn(`Cotan: ${line}`)) };
  for (const { geometry, material } of meshes)
    if (geometry.attributes.tangent)
      for (const one of [material].flat().filter(readsTangents))
        for (const name of Object.values(kScales)) if (one[name]) all.greens.add(geometry, one[name], one);
  if (!o.convention) all.greens.notes().forEach(all.note);
  const copies = new Map();   // by material: its copies by the settings that meshes need
  const earlier = new Map();  // by material: its state before this call
  const stored = new Set();
  for (const mesh of meshes) {
    const materials = [mesh.material].flat(), { geometry } = mesh;
    if (geometry.attributes.tangent) stored.add(geometry);
    if (!materials.some(material => material.normalScale)) continue;
    for (const material of materials) if (!earlier.has(material)) earlier.set(material, known.get(material));
    const frames = framesFor(mesh, materials, earlier, all);
    const copied = materials.map((material, k) => {
      if (!material.normalScale) return material;
      return copyFor(material, { frame: frames[k], ...signsOf(geometry, material, earlier.get(material), all) }, copies, replace);
    });
    mesh.material = Array.isArray(mesh.material) ? copied : copied[0];
  }
  for (const geometry of stored) {
    geometry.dispose(); // frees the renderer's buffer of the tangents
    geometry.deleteAttribute('tangent');
  }
  freeTogether(meshes, all.made);
  return target;
}

// Disposes of replaced geometries without meshes. A new geometry is disposed of together with the one that it replaced.
function freeTogether(meshes, made) {
  const inUse = new Set([...meshes].map(mesh => mesh.geometry));
  for (const { from } of made.values()) if (!inUse.has(from)) from.dispose();
  for (const { from, geometry } of made.values()) from.addEventListener('dispose', () => geometry.dispose());
}

// The frame for each material of a mesh. Gives the mesh a geometry with the attributes that these frames read.
function framesFor(mesh, materials, earlier, all) {
  const tangents = !!mesh.geometry.attributes.tangent;
  const frames = materials.map(material => material.normalScale && requestedFrame(mesh.geometry, material, earlier.get(material), all));
  for (const [frame, name, give] of [['smooth', kSmoothAttributes[0], withSmooth], ['triangle', kTriangleAttribute, withTriangles]]) {
    if (!frames.includes(frame) || mesh.geometry.attributes[name] && !tangents) continue;
    const readers = materials.filter((_, k) => frames[k] === frame), why = reasonAgainst(mesh, readers, frame, all);
    if (why) {
      all.warn(`mesh "${mesh.name}" ${why}: its frame is cotangent, not ${frame}`);
      frames.forEach((found, k) => { if (found === frame) frames[k] = 'cotangent'; });
      continue;
    }
    const map = mapOf(readers[0]), key = [mesh.geometry.uuid, readingOf(map), frame].join();
    if (!all.made.has(key)) all.made.set(key, { from: mesh.geometry, geometry: give(mesh.geometry, map, all.provoking) });
    mesh.geometry = all.made.get(key).geometry;
  }
  return frames;
}

// The frame for a material on a geometry. before: the material's state, whose frame is kept if none is requested and
// the geometry has no tangents.
function requestedFrame(geometry, material, before, { o, warn, note }) {
  const tangents = !!geometry.attributes.tangent, named = namedFrame(material, warn);
  if (o.frame === undefined && before && !tangents) return before.frame;
  if (o.frame === undefined || o.frame === 'auto') return named ?? guessedFrame(geometry, mapOf(material), tangents);
  if (named && named !== o.frame) note(`material "${material.name}": its maps are for the frame ${material.userData[kKey]} (${kKey}), but are read with ${o.frame}`);
  return o.frame;
}

// The reason why a mesh cannot have a frame that is stored in its geometry; empty if it can.
function reasonAgainst(mesh, materials, frame, { instances, deformed, triangles }) {
  if (frame === 'triangle' && !triangles) return 'needs the option renderer';
  if (!instances && mesh.isInstancedMesh) return 'has instances, whose transforms node materials do not provide';
  if (Object.keys(mesh.geometry.morphAttributes).length || mesh.isSkinnedMesh && (frame === 'triangle' || !deformed)) return 'deforms';
  if (mesh.isBatchedMesh) return 'is a BatchedMesh, whose vertices cannot be renumbered';
  const readings = new Set(materials.flatMap(({ normalMap, clearcoatNormalMap }) => [normalMap, clearcoatNormalMap].filter(Boolean)).map(readingOf));
  if (readings.size > 1) return 'has normal maps over different texture coordinates';
  const { position, normal, [uvNameOf(mapOf(materials[0]))]: uv } = mesh.geometry.attributes;
  if (!position || !uv) return 'has no texture coordinates';
  return frame === 'smooth' && !normal ? 'has no normals' : '';
}

// { wants, factors, against } for a material: wants and against as in `known`; factors: by scale, the sign to multiply
// the current scale with, so that it includes that of wants.
function signsOf(geometry, material, before, { o, greens, loaded }) {
  const tangents = !!geometry.attributes.tangent, wants = {}, factors = {};
  for (const [name, mapName] of Object.entries(kScales)) {
    if (!material[name]) continue;
    const map = material[mapName], gltf = map ? ofGltf(map) : loaded;
    const now = before?.wants[name] ?? (gltf && !tangents ? -1 : 1); // GLTFLoader flips it if there are no tangents
    wants[name] = wantedSign(geometry, map, { o, greens, gltf, tangents, means: readsTangents(material), now });
    factors[name] = now * wants[name];
  }
  const { along, against } = greens.areas(geometry, mapOf(material)), gltf = loaded || ofGltf(mapOf(material));
  return { wants, factors, against: tangents ? against > along || along === 0 && gltf : before?.against ?? gltf };
}

function wantedSign(geometry, map, { o, greens, gltf, tangents, means, now }) {
  if (o.convention && map) return (o.convention === 'gltf') === (gltf || map.flipY === false) ? -1 : 1; // v runs down the image there
  if (gltf && map) return !tangents ? now : means && greens.reversed(geometry, map) ? 1 : -1;
  const { along, against } = greens.areas(geometry, map);
  return !tangents ? now : against > along || along === 0 && gltf ? -1 : 1;
}

// The material with the given settings: the original for the first settings that meshes need, copies for others.
function copyFor(material, { frame, against, wants, factors }, copies, replace) {
  if (!copies.has(material)) copies.set(material, { made: new Map(), scales: Object.fromEntries(Object.keys(factors).map(name => [name, material[name].clone()])) });
  const { made, scales } = copies.get(material), key = [frame, against, ...Object.values(factors)].join();
  if (!made.has(key)) {
    const copy = made.size === 0 ? material : material.clone();
    made.set(key, copy);
    if (copy !== material) material.addEventListener('dispose', () => copy.dispose());
    for (const [name, factor] of Object.entries(factors)) {
      copy[name].copy(scales[name]);
      copy[name].y *= factor;
    }
    known.set(copy, { frame, against, wants });
    replace(copy, { frame, against, from: material });
  }
  return made.get(key);
}
