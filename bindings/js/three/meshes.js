// What both renderers of three.js need before a frame is replaced: meshes without tangents, materials that mean the same
// without them, and geometries that carry what the frames `triangle` and `smooth` read.
import { choice, options as checked } from '../src/arrays.js';
import { usage, wordsFor } from '../src/errors.js';
import { kFrames, kKey, mapOf, meantFrame, namedFrame } from './frames.js';
import { ofGltf, StoredGreens } from './greens.js';
import { readingOf, uvNameOf } from './mesh_data.js';
import { kSmoothAttributes, withSmooth } from './smooth.js';
import { kTriangleAttribute, withTriangles } from './triangles.js';

const kScales = { normalScale: 'normalMap', clearcoatNormalScale: 'clearcoatNormalMap' };
const kConventions = ['gltf', 'directx'];

// What is known of materials that have a frame from us: the frame; whether bitangents run against v there; by scale, whether
// green as the file has it runs along v (1) or against it (-1), which the scale has been multiplied with.
const known = new WeakMap();

// Options of untangle(), with no name that is not known and no value that means nothing.
export function untangleOptions(given, more = {}) {
  const o = checked(given, { frame: undefined, convention: undefined, note: undefined, ...more });
  o.note ??= line => console.info(`Cotan: ${line}`);
  if (o.frame !== undefined) choice(o.frame, 'options.frame', kFrames);
  if (o.convention !== undefined) choice(o.convention, 'options.convention', kConventions);
  if (typeof o.note !== 'function') throw usage(`options.note: expected a function, found ${wordsFor(o.note)}`);
  return o;
}

// The same for replaceFrame().
export function replaceOptions(material, given, more) {
  if (!material?.isMaterial) throw usage(`material: expected a Material, found ${wordsFor(material)}`);
  const o = checked(given, { frame: undefined, against: false, ...more });
  if (typeof o.against !== 'boolean') throw usage(`options.against: expected true or false, found ${wordsFor(o.against)}`);
  if (o.from !== undefined && !o.from?.isMaterial) throw usage(`options.from: expected a Material, found ${wordsFor(o.from)}`);
  return o;
}

const keeping = new WeakSet(); // materials whose clones keep the frame

// replace(clone, material) gives clones of the material what it has. copy() does not ask it.
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

// Removes the tangents of all meshes of `target`, an Object3D or what GLTFLoader gives, and calls replace(material, found)
// for every material with a normal map's scale. found.frame: one of kDrawn; found.against: bitangents, as the anisotropy of
// the material means them, run against increasing v. o: as untangleOptions has them.
// provoking: the vertex of a triangle that flat values are taken from. instances, triangles, deformed: whether the renderer
// can draw carried frames of instances, the frame `triangle`, and `smooth` of skins.
export function untangleMeshes(target, o, { provoking = 'last', instances = true, deformed = true, triangles = true }, replace) {
  const roots = target?.isObject3D ? [target] : target?.scenes;
  if (!roots) throw usage(`target: expected an Object3D or what GLTFLoader gives, found ${wordsFor(target)}`);
  const meshes = new Set();
  for (const root of roots) root.traverse(child => { if (child.isMesh) meshes.add(child); });
  const said = new Set(), once = say => line => { if (!said.has(line)) say(line); said.add(line); };
  const all = { o, provoking, instances, deformed, triangles, loaded: !target.isObject3D, greens: new StoredGreens(), made: new Map(),
    note: once(o.note), warn: once(line => console.warn(`Cotan: ${line}`)) };
  for (const { geometry, material } of meshes)
    if (geometry.attributes.tangent)
      for (const one of [material].flat())
        for (const name of Object.values(kScales)) if (one[name]) all.greens.add(geometry, one[name], one);
  if (!o.convention) all.greens.notes().forEach(all.note);
  const copies = new Map();   // of materials, by what their meshes want
  const earlier = new Map();  // what is known of materials before this
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
    geometry.dispose(); // what the renderer holds of its tangents
    geometry.deleteAttribute('tangent');
  }
  freeTogether(meshes, all.made);
  return target;
}

// What the renderer holds of geometries that no mesh shows any more is freed, and of what took their place once they are.
function freeTogether(meshes, made) {
  const shown = new Set([...meshes].map(mesh => mesh.geometry));
  for (const { from } of made.values()) if (!shown.has(from)) from.dispose();
  for (const { from, geometry } of made.values()) from.addEventListener('dispose', () => geometry.dispose());
}

// The frame of each material of a mesh, whose geometry gets what they read.
function framesFor(mesh, materials, earlier, all) {
  const tangents = !!mesh.geometry.attributes.tangent;
  const frames = materials.map(material => material.normalScale && wishedFrame(mesh.geometry, material, earlier.get(material), all));
  for (const [frame, name, give] of [['smooth', kSmoothAttributes[0], withSmooth], ['triangle', kTriangleAttribute, withTriangles]]) {
    if (!frames.includes(frame) || mesh.geometry.attributes[name] && !tangents) continue;
    const readers = materials.filter((_, k) => frames[k] === frame), why = cannot(mesh, readers, frame, all);
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

// before: what is known of the material, which stays where nothing else is wished for and no tangents say more.
function wishedFrame(geometry, material, before, { o, warn, note }) {
  const tangents = !!geometry.attributes.tangent, named = namedFrame(material, warn);
  if (o.frame === undefined && before && !tangents) return before.frame;
  if (o.frame === undefined || o.frame === 'auto') return named ?? meantFrame(geometry, mapOf(material), tangents);
  if (named && named !== o.frame) note(`material "${material.name}": its maps are for the frame ${material.userData[kKey]} (${kKey}), and read with ${o.frame}`);
  return o.frame;
}

// Why a mesh cannot have a frame that its geometry carries; empty where it can.
function cannot(mesh, materials, frame, { instances, deformed, triangles }) {
  if (frame === 'triangle' && !triangles) return 'needs the option renderer';
  if (!instances && mesh.isInstancedMesh) return 'has instances, whose transforms nodes do not tell';
  if (Object.keys(mesh.geometry.morphAttributes).length || mesh.isSkinnedMesh && (frame === 'triangle' || !deformed)) return 'deforms';
  if (mesh.isBatchedMesh) return 'is a batch, whose geometry is not ours to renumber';
  const readings = new Set(materials.flatMap(({ normalMap, clearcoatNormalMap }) => [normalMap, clearcoatNormalMap].filter(Boolean)).map(readingOf));
  if (readings.size > 1) return 'has normal maps over different texture coordinates';
  const { position, normal, [uvNameOf(mapOf(materials[0]))]: uv } = mesh.geometry.attributes;
  if (!position || !uv) return 'has no texture coordinates';
  return frame === 'smooth' && !normal ? 'has no normals' : '';
}

// For each scale of a material whether green as the file has it runs along v (1) or against it (-1), and what is to be
// multiplied with the scale so that it says that.
function signsOf(geometry, material, before, { o, greens, loaded }) {
  const tangents = !!geometry.attributes.tangent, wants = {}, turns = {};
  for (const [name, mapName] of Object.entries(kScales)) {
    if (!material[name]) continue;
    const map = material[mapName], gltf = map ? ofGltf(map) : loaded;
    const now = before?.wants[name] ?? (gltf && !tangents ? -1 : 1); // three's loader turns it where there are no tangents
    wants[name] = wantedSign(geometry, map, { o, greens, gltf, tangents, now });
    turns[name] = now * wants[name];
  }
  const { along, against } = greens.areas(geometry, mapOf(material)), gltf = loaded || ofGltf(mapOf(material));
  return { wants, turns, against: tangents ? against > along || along === 0 && gltf : before?.against ?? gltf };
}

function wantedSign(geometry, map, { o, greens, gltf, tangents, now }) {
  if (o.convention && map) return (o.convention === 'gltf') === (gltf || map.flipY === false) ? -1 : 1; // v runs down the picture there
  if (gltf && map) {
    const reversed = greens.reversed(map);
    return reversed === undefined && !tangents ? now : reversed ? 1 : -1;
  }
  const { along, against } = greens.areas(geometry, map);
  return !tangents ? now : against > along || along === 0 && gltf ? -1 : 1;
}

// The material for meshes that want the same of it: itself for the first of them, copies for others.
function copyFor(material, { frame, against, wants, turns }, copies, replace) {
  if (!copies.has(material)) copies.set(material, { made: new Map(), scales: Object.fromEntries(Object.keys(turns).map(name => [name, material[name].clone()])) });
  const { made, scales } = copies.get(material), key = [frame, against, ...Object.values(turns)].join();
  if (!made.has(key)) {
    const copy = made.size === 0 ? material : material.clone();
    made.set(key, copy);
    if (copy !== material) material.addEventListener('dispose', () => copy.dispose());
    for (const [name, turn] of Object.entries(turns)) {
      copy[name].copy(scales[name]);
      copy[name].y *= turn;
    }
    known.set(copy, { frame, against, wants });
    replace(copy, { frame, against, from: material });
  }
  return made.get(key);
}
