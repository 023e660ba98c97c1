// Prepares meshes for both renderers of three.js before frames are replaced: decides with which frame each map is read,
// removes tangents that are not needed, adapts materials so that they look the same without them, and adds the vectors of the
// frames `triangle` and `smooth`, or tangents, to geometries.
import { checkTypes, choice, options as checked } from '../src/arrays.js';
import { usage, wordsFor } from '../src/errors.js';
import { Chooser, greenAlongV, markGenerated, scalesOf, storedIn } from './choose.js';
import { keepInClones as keep } from './clones.js';
import { isGrooved, kFrames, kKey, mapOf, meansTangents, namedFrame, standsAlone } from './frames.js';
import { withVertices } from './gathered.js';
import { GreenNotes, ofGltf } from './greens.js';
import { numbersOf, readingOf, turns, uvMatrixOf, uvNameOf } from './mesh_data.js';
import { packed, withTangents } from './mikktspace.js';
import { kSmoothAttributes, withSmooth } from './smooth.js';
import { kTriangleAttribute, withTriangles } from './triangles.js';

// Instead of a frame, where three draws tangents: what is corrected. `inverted` says whether three inverts the bitangents, by
// which the directions of anisotropy turn. kCoatAlone: the coat gets `orthonormal` of its own texture coordinates, too.
export const kCoatAlone = 'coat', kTangents = 'tangents';

const kConventions = ['gltf', 'directx'];
const kMaxDegrees = 0.3;

// State of materials that we have set: { frame, against, corrected, wants, includes }. frame: one of kSupported, or `mikktspace`
// where three reads tangents by itself. corrected: as kTangents, if anything is. against: whether bitangents run against v. wants: for each scale, whether green in the file
// points along v (1) or against it (-1). includes: the sign that the scale has been multiplied with, for the bitangents that
// the material is drawn with.
const known = new WeakMap();

const decided = new WeakMap(); // by geometry, then by material: a decision and the maps that it was for

// Checks the options of untangle() and fills in defaults.
export function untangleOptions(given, more = {}) {
  const o = checked(given, { frame: undefined, convention: undefined, note: undefined, maxDegrees: kMaxDegrees, ...more });
  o.note ??= line => console.info(`Cotan: ${line}`);
  if (o.frame !== undefined) choice(o.frame, 'options.frame', kFrames);
  if (o.convention !== undefined) choice(o.convention, 'options.convention', kConventions);
  checkTypes(o, 'function', 'note');
  if (!(typeof o.maxDegrees === 'number' && o.maxDegrees > 0 && o.maxDegrees < Infinity))
    throw usage(`options.maxDegrees: expected a number of degrees above 0, found ${wordsFor(o.maxDegrees)}`);
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

// Makes material.clone() call replace(clone, material), which applies the frame to the clone.
export const keepInClones = (material, replace) => keep(material, 'frame', (made, source) => {
  replace(made, source);
  if (known.has(source)) known.set(made, known.get(source));
});

// Decides about all meshes of `target`, an Object3D or GLTFLoader's result, removes tangents that are not needed, and calls
// replace(material, { frame, against, from }) for every material with a normalScale that is drawn without tangents, and
// restore(material) for one that is drawn with tangents again. frame: one of kSupported. against: whether the bitangents of
// the material's anisotropy run against increasing v. o: options from untangleOptions(). provoking: which vertex of a
// triangle flat values are taken from. instances, triangles, deformed: whether the renderer supports stored frames on
// instanced meshes, the frame `triangle`, and `smooth` on skinned meshes. Returns one decision for each mesh and material.
export function untangleMeshes(target, o, { provoking = 'last', instances = true, deformed = true, triangles = true }, replace, restore) {
  const roots = target?.isObject3D ? [target] : target?.scenes;
  if (!roots) throw usage(`target: expected an Object3D or the result of GLTFLoader, found ${wordsFor(target)}`);
  const found = new Set();
  for (const root of roots) {
    root.updateWorldMatrix?.(true, true);
    root.traverse(child => { if (child.isMesh) found.add(child); });
  }
  const meshes = [...found], reported = new Set(), once = report => line => { if (!reported.has(line)) report(line); reported.add(line); };
  const all = { o, provoking, instances, deformed, triangles, loaded: !target.isObject3D, made: new Map(), greens: new GreenNotes(), counted: new Set(), replace, restore,
    copies: new Map(), earlier: new Map(), note: once(o.note), warn: once(line => console.warn(`Cotan: ${line}`)) };
  for (const { material } of meshes) for (const one of [material].flat()) all.earlier.set(one, known.get(one));
  all.chooser = new Chooser(meshes, { mean: o.maxDegrees, percentile99: 10 * o.maxDegrees }, (mesh, frame) => reasonAgainst(mesh, [mesh.material].flat(), frame, all), all.warn);
  const plans = meshes.map(mesh => ({ mesh, geometry: mesh.geometry, decisions: decisionsFor(mesh, all) }));
  const keeps = ({ decisions }) => decisions.some(({ frame }) => frame === 'mikktspace');
  // First the meshes that three draws with tangents: they get the materials that are not changed.
  for (const plan of [...plans.filter(keeps), ...plans.filter(plan => !keeps(plan))]) apply(plan, keeps(plan), all);
  removeTangents(plans, keeps);
  packTangents(plans);
  if (!o.convention) all.greens.lines().forEach(all.note);
  freeTogether(meshes, all.made);
  return plans.flatMap(({ mesh, geometry, decisions }) => [mesh.material].flat().map((material, k) => {
    const decision = decisions[k];
    if (decision.keepsTangents) noteKept(mesh, geometry, decision, all);
    else if (material.normalScale) remember(mesh.geometry, material, decision);
    return { mesh, material, ...decision };
  }));
}

// ---- decisions ----------------------------------------------------------------------------------

// The maps of a material that read a frame.
const mapsOf = material => [material.normalMap, material.clearcoatNormalMap, isGrooved(material) ? mapOf(material) : null];

function remember(geometry, material, decision) {
  if (!decided.has(geometry)) decided.set(geometry, new WeakMap());
  decided.get(geometry).set(material, { decision, maps: mapsOf(material), tangent: storedIn(geometry) });
}

// What an earlier call decided, if that still holds.
function remembered(geometry, material, { o }) {
  const found = decided.get(geometry)?.get(material);
  if (!found || found.tangent !== storedIn(geometry) || found.decision.reason === 'notJudged' || mapsOf(material).some((map, k) => map !== found.maps[k])) return undefined;
  return o.frame === undefined || o.frame === 'auto' && found.decision.reason !== 'requested' ? found.decision : undefined;
}

// One decision for each material of a mesh. All agree whether three reads tangents.
function decisionsFor(mesh, all) {
  const materials = [mesh.material].flat(), decisions = materials.map((material, k) => decisionFor(mesh, material, k, all));
  const mapped = materials.map(material => !!(material.normalScale && mapOf(material))), reads = ({ frame }) => frame === 'mikktspace';
  if (!decisions.some(reads) || decisions.every((one, k) => reads(one) || !mapped[k])) return decisions;
  const kept = decisions.some(({ keepsTangents }) => keepsTangents);
  // A map for another frame cannot be drawn with tangents: then no map of the mesh is.
  const fixed = decisions.some(({ reason }, k) => mapped[k] && ['named', 'painted', 'requested'].includes(reason));
  return decisions.map((one, k) => {
    if (!mapped[k] || reads(one) !== fixed) return one;
    return { ...one, frame: fixed ? 'orthonormal' : 'mikktspace', keepsTangents: !fixed && kept, reason: 'shared' };
  });
}

function decisionFor(mesh, material, k, all) {
  const { o, chooser, note, earlier } = all, before = earlier.get(material), plain = (frame, reason) => ({ frame, keepsTangents: false, meaning: 'named', reason, candidates: [] });
  if (!material.normalScale) return { ...plain('orthonormal', 'noMap'), meaning: 'none' };
  const found = remembered(mesh.geometry, material, all);
  if (found) return found;
  if (o.frame === undefined && before && before.frame !== 'mikktspace' && !storedIn(mesh.geometry)) return plain(before.frame, 'earlier');
  if (o.frame === undefined || o.frame === 'auto') return chooser.decide(mesh, material, k);
  const named = namedFrame(material, all.warn, mesh.geometry);
  if (named && named !== o.frame) note(`material "${material.name}": its maps are for the frame ${(mesh.geometry.userData?.[kKey] ?? material.userData[kKey])} (${kKey}), but are read with ${o.frame}`);
  return plain(o.frame, 'requested');
}

// The reason why a mesh cannot have a frame that is stored in its geometry, for materials that read it; empty if it can.
function reasonAgainst(mesh, materials, frame, { instances, deformed, triangles }) {
  if (frame === 'orthonormal') return '';
  if (frame === 'triangle' && !triangles) return 'needs the option renderer';
  if (!instances && mesh.isInstancedMesh) return 'has instances';
  const morphs = Object.keys(mesh.geometry.morphAttributes).length > 0;
  if (frame !== 'mikktspace' && (morphs || mesh.isSkinnedMesh && (frame === 'triangle' || !deformed))) return 'deforms';
  if (mesh.isBatchedMesh) return 'is a BatchedMesh';
  const readings = new Set(materials.flatMap(material => (material.normalScale ? mapsOf(material) : [])).filter(Boolean).map(readingOf));
  if (readings.size > 1) return 'has normal maps over different texture coordinates';
  const { position, normal, [uvNameOf(firstMapOf(materials))]: uv } = mesh.geometry.attributes;
  if (!position || !uv) return 'has no texture coordinates';
  return frame !== 'triangle' && !normal ? 'has no normals' : '';
}

// Says that the tangents of a mesh stay, why, and what they cost.
function noteKept(mesh, geometry, { reason, why, candidates }, { note }) {
  const { array, count, itemSize } = storedIn(geometry), kilobytes = Math.ceil(count * itemSize * array.BYTES_PER_ELEMENT / 1024);
  const measured = candidates.map(one => `${one.frame} ${one.points ? one.mean.toFixed(2) : `(${one.why ?? 'not finite'})`}`).join(', ');
  const because = reason === 'notJudged' ? why : reason === 'shared' ? 'another material of the mesh needs them' : `degrees on average without them: ${measured}`;
  note(`mesh "${mesh.name}": its tangents stay (${kilobytes} KB): ${because}`);
}

// ---- meshes -------------------------------------------------------------------------------------

// Gives a mesh the geometry and the materials for its decisions. tangents: whether three reads tangents.
function apply({ mesh, decisions }, tangents, all) {
  const materials = [mesh.material].flat(), { geometry } = mesh;
  if (!materials.some(material => material.normalScale)) return;
  const reads = tangents && drawsStored(mesh, firstMapOf(materials), decisions);
  const signs = materials.map((material, k) => material.normalScale && signsOf(mesh, material, k, { tangents, reads }, all));
  if (tangents) giveTangents(mesh, materials, decisions, all);
  else giveVectors(mesh, materials, decisions, all);
  const copied = materials.map((material, k) => {
    if (!material.normalScale) return material;
    const same = decided.get(geometry)?.get(material)?.decision === decisions[k];
    return copyFor(material, { frame: tangents ? 'mikktspace' : decisions[k].frame, ...signs[k] }, same, all);
  });
  mesh.material = Array.isArray(mesh.material) ? copied : copied[0];
}

const made = (mesh, key, all, make) => {
  const whole = [mesh.geometry.uuid, key].join();
  if (!all.made.has(whole)) all.made.set(whole, { from: mesh.geometry, geometry: make() });
  return all.made.get(whole).geometry;
};

const firstMapOf = materials => materials.map(mapOf).find(Boolean);

// Whether three draws the tangents that came with the mesh, needed or not: not if they are for other uv than the map's.
const drawsStored = (mesh, map, decisions) => !!storedIn(mesh.geometry) && (decisions.some(({ keepsTangents }) => keepsTangents) || !(ofGltf(map) && turns(map)));

// Whether three inverts the bitangents of a mesh: it makes them from a mirrored tangent and a normal that is not.
const inverts = mesh => !mesh.isSkinnedMesh && mesh.matrixWorld.determinant() < 0;

// Tangents that were loaded are drawn as they are. Others are made, for mirrored meshes with the other w.
function giveTangents(mesh, materials, decisions, all) {
  const map = firstMapOf(materials), { geometry } = mesh, gltf = map ? ofGltf(map) : all.loaded;
  if (drawsStored(mesh, map, decisions) || geometry.attributes.tangent && !storedIn(geometry)) return;
  mesh.geometry = made(mesh, ['mikktspace', readingOf(map), inverts(mesh)], all, () => markGenerated(withTangents(geometry, map, gltf !== inverts(mesh))));
}

// Adds the attributes that the frames of a mesh read to its geometry.
function giveVectors(mesh, materials, decisions, all) {
  const tangents = !!mesh.geometry.attributes.tangent;
  for (const [frame, name, give] of [['smooth', kSmoothAttributes[0], withSmooth], ['triangle', kTriangleAttribute, withTriangles]]) {
    const readers = materials.filter((material, k) => material.normalScale && decisions[k].frame === frame);
    if (!readers.length || mesh.geometry.attributes[name] && !tangents) continue;
    const why = reasonAgainst(mesh, readers, frame, all);
    if (why) {
      all.warn(`mesh "${mesh.name}" ${why}: its frame is cotangent, not ${frame}`);
      decisions.forEach((one, k) => { if (one.frame === frame) decisions[k] = { ...one, frame: 'cotangent' }; });
      continue;
    }
    const map = mapOf(readers[0]);
    mesh.geometry = made(mesh, [readingOf(map), frame], all, () => give(mesh.geometry, map, all.provoking));
  }
}

// Removes tangents that nothing reads. A geometry that other meshes draw with tangents is copied without them.
function removeTangents(plans, keeps) {
  const kept = new Set(plans.filter(keeps).map(({ mesh }) => mesh.geometry)), bare = new Map(), dropped = new Set();
  for (const plan of plans) {
    const { mesh, geometry } = plan;
    if (!geometry.attributes.tangent || keeps(plan)) continue;
    if (!kept.has(geometry)) dropped.add(geometry);
    else if (mesh.geometry === geometry) {
      if (!bare.has(geometry)) bare.set(geometry, withVertices(geometry, []));
      mesh.geometry = bare.get(geometry);
    }
  }
  for (const geometry of dropped) {
    geometry.dispose(); // frees the renderer's buffer of the tangents
    geometry.deleteAttribute('tangent');
  }
  for (const [geometry, copy] of bare) geometry.addEventListener('dispose', () => copy.dispose());
}

// Packs tangents of floats that MikkTSpace makes, too. Those that stay are left as they are.
function packTangents(plans) {
  const kept = new Set(plans.filter(({ decisions }) => decisions.some(({ keepsTangents }) => keepsTangents)).map(({ mesh }) => mesh.geometry));
  for (const { mesh: { geometry } } of plans) {
    const tangents = storedIn(geometry);
    if (kept.has(geometry) || !tangents || tangents.isInterleavedBufferAttribute || tangents.array.BYTES_PER_ELEMENT < 4) continue;
    geometry.dispose(); // frees the renderer's buffer of the old ones
    geometry.setAttribute('tangent', packed(numbersOf(tangents, 4)));
  }
}

// Disposes of replaced geometries without meshes. A new geometry is disposed of together with the one that it replaced.
function freeTogether(meshes, made) {
  const inUse = new Set(meshes.map(mesh => mesh.geometry));
  for (const { from } of made.values()) if (!inUse.has(from)) from.dispose();
  for (const { from, geometry } of made.values()) from.addEventListener('dispose', () => geometry.dispose());
}

// ---- materials ----------------------------------------------------------------------------------

// { wants, includes, factors, against, inverted } for a material: see `known`, kTangents; factors: by scale, the sign to multiply the current scale
// with, so that it includes the new one. tangents, reads: whether three draws tangents, and whether they are the stored ones.
function signsOf(mesh, material, k, { tangents, reads }, { o, chooser, greens, counted, loaded, earlier }) {
  const stored = !!storedIn(mesh.geometry), wants = {}, includes = {}, factors = {}, before = earlier.get(material), means = meansTangents(material, mesh.geometry);
  for (const [name, mapName] of scalesOf(material)) {
    const map = material[mapName], gltf = map ? ofGltf(map) : loaded, initial = gltf && !stored ? -1 : 1; // GLTFLoader flips it if there are no tangents
    const alone = standsAlone(material, map); // tangents say nothing of it
    let shown = alone ? before?.wants[name] : reads && !o.convention ? undefined : before?.wants[name] ?? initial; // which way tangents and uv say
    if (stored && !alone && (!reads || o.convention)) {
      const areas = chooser.areas(mesh, material, k, map);
      shown = !gltf || !map ? areas.against > areas.along || areas.along === 0 && gltf ? -1 : 1 : means ? greenAlongV(map, areas) : -1;
      const use = [mesh.geometry.uuid, map?.uuid, k].join();
      if (!tangents && gltf && map && means && !counted.has(use)) greens.add(map, material, areas, shown > 0);
      counted.add(use);
    }
    // v runs down the image in glTF
    wants[name] = o.convention && map ? ((o.convention === 'gltf') === (gltf || map.flipY === false) ? -1 : 1) : shown ?? (gltf ? -1 : 1);
    // Green is right as it is for stored bitangents, unless three inverts them; those that are made run against v for a glTF.
    includes[name] = alone ? wants[name] : reads ? (o.convention ? wants[name] * shown : 1) * (inverts(mesh) ? -1 : 1) : tangents && gltf ? -wants[name] : wants[name];
    factors[name] = (before?.includes[name] ?? initial) * includes[name];
  }
  const map = mapOf(material), gltf = loaded || ofGltf(map);
  return { wants, includes, factors, inverted: reads && isGrooved(material) && inverts(mesh), against: stored && !tangents ? runsAgainst(chooser.areas(mesh, material, k, map), map, gltf) : before?.against ?? gltf };
}

// Whether stored bitangents run against increasing v as the map is read. Those of a glTF are for v before its transform.
function runsAgainst({ along, against }, map, gltf) {
  const [a, b, c, d] = uvMatrixOf(map);
  return ofGltf(map) && a * d - b * c < 0 ? along > against : against > along || along === 0 && gltf;
}

// The material with the given settings: the original for the first settings that meshes need, copies for others. same:
// whether an earlier call has set them.
function copyFor(material, { frame, against, inverted, wants, includes, factors }, same, { copies, earlier, replace, restore }) {
  if (!copies.has(material)) copies.set(material, { made: new Map(), scales: Object.fromEntries(Object.keys(factors).map(name => [name, material[name].clone()])) });
  const { made, scales } = copies.get(material), tangents = frame === 'mikktspace', key = [frame, tangents ? inverted : against, ...Object.values(factors)].join();
  const corrected = tangents && (standsAlone(material, material.clearcoatNormalMap) ? kCoatAlone : inverted ? kTangents : undefined);
  if (!made.has(key)) {
    const before = earlier.get(material), switches = before && (before.frame === 'mikktspace') !== tangents; // meshes elsewhere may have it as it is
    const copy = made.size === 0 && !switches ? material : material.clone();
    made.set(key, copy);
    if (copy !== material) material.addEventListener('dispose', () => copy.dispose());
    for (const [name, factor] of Object.entries(factors)) {
      copy[name].copy(scales[name]);
      copy[name].y *= factor;
    }
    known.set(copy, { frame, against, corrected, wants, includes });
    if (same && copy === material) return copy;
    if (!tangents || corrected) replace(copy, { frame: corrected || frame, against, inverted, from: material });
    else {
      if (switches || before?.corrected) restore(copy);
      else if (copy !== material && Object.hasOwn(material, 'onBeforeCompile')) copy.onBeforeCompile = material.onBeforeCompile;
      if (Object.values(factors).some(factor => factor < 0)) keepInClones(copy, () => {});
    }
  }
  return made.get(key);
}
