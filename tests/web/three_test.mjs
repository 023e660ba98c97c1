// Tests cotan/three from the tarball without drawing: node three_test.mjs TARBALL NODE_MODULES DATA [CASE]
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { hills, installed, load, runCases, skip } from './shared.mjs';

const [tarball, modules, only] = process.argv.slice(2);
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
if (!fs.existsSync(path.join(modules, 'three'))) skip('three is not installed (see the test npm_packages)');
const folder = installed(tarball, modules, ['three']);
fs.writeFileSync(path.join(folder, 'from.js'), 'export const from = (name) => import(name);\n');
const { from } = await import(pathToFileURL(path.join(folder, 'from.js')));
const THREE = await from('three'), { untangle, replaceFrame, CotanError } = await from('cotan/three');
const library = await load(folder, 'tangents');
await library.ready;

/** A map as GLTFLoader creates it. */
function mapOf(name = 'bumps', data = Uint8Array.of(128, 128, 255, 255), side = 1) {
  const map = new THREE.DataTexture(data, side, side);
  map.name = name;
  map.userData.mimeType = 'image/png';
  return map;
}

/** The same with 64 x 64 texels of waves, up to 27 degrees steep. */
function bumpyMap(side = 64) {
  const data = new Uint8Array(side * side * 4);
  for (let y = 0; y < side; ++y)
    for (let x = 0; x < side; ++x) {
      const slopes = [0.5 * Math.sin(x / 3), 0.4 * Math.cos(y / 4), 1], length = Math.hypot(...slopes);
      data.set([...slopes.map((c) => Math.round(127.5 + 127.5 * c / length)), 255], 4 * (y * side + x));
    }
  return mapOf('bumps', data, side);
}

/** A glTF square of two triangles. w: 1 as glTF defines it, -1 reversed, 0 for no tangents; area: of the square. */
function square(map, w, { area = 1, material = new THREE.MeshStandardMaterial({ normalMap: map, name: 'cloth' }), mirrored = false } = {}) {
  const geometry = new THREE.BufferGeometry(), side = Math.sqrt(area), u = mirrored ? [1, 0, 1, 0] : [0, 1, 0, 1], along = mirrored ? -1 : 1;
  const set = (name, values, width) => geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, width));
  set('position', [0, 0, 0, side, 0, 0, 0, side, 0, side, side, 0], 3);
  set('normal', [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1], 3);
  set('uv', [u[0], 1, u[1], 1, u[2], 0, u[3], 0], 2); // v down
  if (w) set('tangent', Array(4).fill([along, 0, 0, along * w]).flat(), 4); // cross(n, t) * w points up: against v
  else material.normalScale.y *= -1; // as the loader does
  geometry.setIndex([0, 1, 2, 2, 1, 3]);
  return new THREE.Mesh(geometry, material);
}

/** Returns the notes, and the sign of each mesh's scale after untangle(): -1 for green up in the image, as in glTF. */
function untangledSigns(meshes, options = {}) {
  const scene = new THREE.Scene(), notes = [];
  scene.add(...meshes);
  untangle({ scenes: [scene] }, { note: (line) => notes.push(line), ...options });
  return { signs: meshes.map((mesh) => Math.sign(mesh.material.normalScale.y)), notes };
}

const frameOf = (mesh) => /cotan,(\w+)/.exec(mesh.material.customProgramCacheKey())[1];

const cases = {
  greenFollowsTheTangentsOfEachMesh() {
    const shared = mapOf(), other = mapOf('other');
    const meshes = [square(shared, -1, { area: 9.2 }), square(shared, 1, { area: 0.8 }), square(shared, 0), square(other, 1), square(shared, -1, { mirrored: true })];
    const { signs, notes } = untangledSigns(meshes);
    assert.deepEqual(signs, [1, -1, -1, -1, 1]); // as declared where there are no tangents, or right ones
    assert.deepEqual(notes, ["TANGENT.w contradicts the texture coordinates on 93 % of the area of normal map 'bumps': "
      + 'without stored tangents its green is flipped in 2 of 3 geometries (the option convention overrides this)']);
    const few = mapOf(), reversed = square(few, -1, { area: 0.9 });
    assert.deepEqual(untangledSigns([reversed, square(few, 1, { area: 9.1 })]).signs, [1, -1]);
  },

  aMeshWithoutTangentsStaysAsDeclaredWhateverOthersStore() {
    for (const w of [-1, 1]) { // of the other mesh with the same map
      const map = mapOf(), without = square(map, 0, { material: new THREE.MeshStandardMaterial({ normalMap: map, name: 'B' }) });
      assert.deepEqual(untangledSigns([square(map, w), without]).signs, [-w, -1]);
    }
  },

  // They once followed the other meshes of the map. Now the error says that no frame without tangents fits.
  tangentsThatAreReversedInPartsStay() {
    for (const reversed of [3, 6]) { // corners, of 12
      const map = bumpyMap(), mesh = square(map, 1), other = square(map, -1, { area: 10 }), notes = [], scene = new THREE.Scene().add(mesh, other);
      mesh.name = 'mixed';
      mesh.geometry = mesh.geometry.toNonIndexed();
      for (let k = 0; k < reversed; ++k) mesh.geometry.attributes.tangent.setW(k % 3, -1);
      const before = Array.from(mesh.geometry.attributes.tangent.array), decisions = untangle({ scenes: [scene] }, { note: (line) => notes.push(line) });
      assert.deepEqual(decisions.map(({ frame, keepsTangents, reason, meaning }) => [frame, keepsTangents, reason, meaning]),
        [['mikktspace', true, 'keeps', 'stored'], ['orthonormal', false, 'fits', 'stored']]);
      assert.deepEqual(Array.from(mesh.geometry.attributes.tangent.array), before);
      assert.equal(other.geometry.attributes.tangent, undefined);
      assert.match(notes[0], /^TANGENT\.w contradicts the texture coordinates on 100 % of the area of normal map 'bumps'/);
      assert.match(notes[1], /^mesh "mixed": its tangents stay \(1 KB\): degrees on average without them: orthonormal \d+\.\d\d, triangle \d+\.\d\d, smooth \d+\.\d\d, mikktspace \d+\.\d\d$/);
      assert.equal(notes.length, 2);
    }
  },

  tangentsBelongToTheUvBeforeTheTexturesTransform() {
    for (const [repeat, rotation] of [[[1, -1], 0], [[-1, 1], 0], [[1, 1], Math.PI / 2], [[-1, 1], 0.3]]) {
      const map = mapOf();
      map.repeat.set(...repeat);
      map.rotation = rotation;
      assert.deepEqual(untangledSigns([square(map, 1)]), { signs: [-1], notes: [] }, `${repeat} ${rotation}`);
    }
  },

  tangentsSayNothingOfMapsForOtherFrames() {
    for (const [frame, sign] of [['smooth', -1], ['orthonormal', -1], ['mikktspace', 1], ['vertex', 1]]) {
      const mesh = square(mapOf(), -1);
      mesh.material.userData.cotanFrame = frame;
      assert.deepEqual(untangledSigns([mesh]).signs, [sign], frame);
    }
  },

  // Tangents opposite to dP/du were once dropped, and the map was read as declared. Now they stay, and the render is as before.
  tangentsThatPointElsewhereDoNotReverseGreen() {
    for (const [options, signs, kept] of [[{}, [1], true], [{ frame: 'orthonormal' }, [-1], false]]) {
      const map = bumpyMap(), mesh = square(map, -1), { tangent } = mesh.geometry.attributes;
      for (let k = 0; k < tangent.count; ++k) tangent.setX(k, -1); // opposite to dP/du; w is right
      assert.deepEqual(untangledSigns([mesh], options).signs, signs);
      assert.equal(!!mesh.geometry.attributes.tangent, kept);
    }
    const without = square(mapOf(), -1), { uv } = without.geometry.attributes;
    for (let k = 0; k < uv.count; ++k) uv.setXY(k, 0.5, 0.5); // no area: nothing is compared, and what is there stays
    without.name = 'flat';
    assert.deepEqual(untangledSigns([without]), { signs: [1], notes: ['mesh "flat": its tangents stay (1 KB): no triangle has an area both in space and in uv'] });
    assert.deepEqual(untangledSigns([without], { frame: 'orthonormal' }), { signs: [-1], notes: [] });
  },

  clearCoatsFollowTheSameRule() {
    const material = new THREE.MeshPhysicalMaterial({ normalMap: mapOf('base'), clearcoatNormalMap: mapOf('coat') });
    const coated = square(null, -1, { material }), scene = new THREE.Scene(), notes = [];
    scene.add(coated, square(material.normalMap, 1, { area: 100 })); // another mesh, whose tangents are right
    untangle({ scenes: [scene] }, { note: (line) => notes.push(line) });
    assert.deepEqual([coated.material.normalScale.y, coated.material.clearcoatNormalScale.y], [1, 1]);
    assert.equal(notes.length, 2);
    assert.match(notes[0], /on 1 % of the area of normal map 'base'.* in 1 of 2 geometries/);
    assert.match(notes[1], /100 % of the area of normal map 'coat'/);
  },

  theOptionConventionOverridesTangents() {
    for (const [convention, sign] of [['gltf', -1], ['directx', 1]])
      for (const w of [1, -1, 0]) assert.deepEqual(untangledSigns([square(mapOf(), w)], { convention }), { signs: [sign], notes: [] });
  },

  repeatedCallsAndLaterMeshesAgree() {
    const map = mapOf(), material = new THREE.MeshStandardMaterial({ normalMap: map });
    const meshes = [square(map, -1, { material }), square(map, -1, { material })];
    assert.deepEqual(untangledSigns([meshes[0]]).signs, [1]);
    assert.deepEqual(untangledSigns([meshes[0]]), { signs: [1], notes: [] });
    assert.deepEqual(untangledSigns([meshes[1]]).signs, [1]);
  },

  autoIsTheFrameOfTheMaterialOrOrthonormal() {
    const drawn = (userData, options, mesh = square(mapOf(), 0)) => {
      Object.assign(mesh.material.userData, userData);
      return [untangledSigns([mesh], options).notes, frameOf(mesh)];
    };
    assert.deepEqual(drawn({}), [[], 'orthonormal']);
    assert.deepEqual(drawn({}, {}, square(mapOf(), 1)), [[], 'orthonormal']);
    for (const frame of ['smooth', 'triangle', 'cotangent', 'orthonormal']) assert.deepEqual(drawn({ cotanFrame: frame }), [[], frame]);
    assert.deepEqual(drawn({ cotanFrame: 'smooth' }, { frame: 'auto' }), [[], 'smooth']);
    assert.deepEqual(drawn({ cotanFrame: 'mikktspace' }), [[], 'orthonormal']);
    assert.deepEqual(drawn({ cotanFrame: 'smooth' }, { frame: 'cotangent' }),
      [['material "cloth": its maps are for the frame smooth (cotanFrame), but are read with cotangent'], 'cotangent']);
    const { warn } = console, said = [];
    console.warn = (line) => said.push(line);
    try {
      assert.deepEqual(drawn({ cotanFrame: 'sideways' }), [[], 'orthonormal']);
    } finally {
      console.warn = warn;
    }
    assert.deepEqual(said, ['Cotan: material "cloth": cotanFrame: expected cotangent, orthonormal, smooth, triangle, found "sideways": it is ignored']);
    const material = new THREE.MeshStandardMaterial({ normalMap: mapOf() });
    material.userData.cotanFrame = 'cotangent';
    assert.equal(frameOf({ material: replaceFrame(material) }), 'cotangent');
  },

  repeatedMapsOnOwnShapesUseCotangent() {
    const map = new THREE.DataTexture(Uint8Array.of(128, 128, 255, 255), 1, 1), frames = [];
    for (const [repeat, geometry] of [[1, new THREE.BufferGeometry().copy(new THREE.PlaneGeometry())], [4, new THREE.BufferGeometry().copy(new THREE.PlaneGeometry())], [1, new THREE.SphereGeometry()]]) {
      map.repeat.set(repeat, 1);
      const mesh = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ normalMap: map }));
      untangle(mesh);
      frames.push(frameOf(mesh));
    }
    assert.deepEqual(frames, ['orthonormal', 'cotangent', 'cotangent']);
  },

  smoothUsesTheCotangentsOfTheLibrary() {
    for (const mirrored of [false, true]) {
      const mesh = hills(6);
      if (mirrored) for (let i = 0; i < mesh.uvs.length; i += 2) mesh.uvs[i] = Math.abs(mesh.uvs[i] - 0.5);
      const geometry = new THREE.BufferGeometry(), map = mapOf(), made = library.splitMirrored(mesh);
      const gathered = (array, width) => Float32Array.from(Array.from(made.sources).flatMap((k) => [...array.subarray(k * width, (k + 1) * width)]));
      const split = { positions: gathered(mesh.positions, 3), normals: gathered(mesh.normals, 3), uvs: gathered(mesh.uvs, 2), indices: made.indices };
      geometry.setAttribute('position', new THREE.BufferAttribute(mesh.positions, 3));
      geometry.setAttribute('normal', new THREE.BufferAttribute(mesh.normals, 3));
      geometry.setAttribute('uv', new THREE.BufferAttribute(mesh.uvs, 2));
      geometry.setIndex(new THREE.BufferAttribute(Uint16Array.from(mesh.indices), 1));
      const drawn = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ normalMap: map }));
      untangle(drawn, { frame: 'smooth' });
      const { attributes, index } = drawn.geometry, expected = library.smooth(split);
      assert.equal(attributes.position.count, made.sources.length);
      assert.equal(made.sources.length > 49, mirrored); // copies only where sides meet
      for (const [name, values] of [['cotanU', expected.u], ['cotanV', expected.v]])
        for (let c = 0; c < made.indices.length; ++c) { // the library computes in float
          const ours = [0, 1, 2].map((i) => attributes[name].getComponent(index.getX(c), i)), theirs = values.subarray(3 * made.indices[c], 3 * made.indices[c] + 3);
          const apart = Math.hypot(...ours.map((x, i) => x - theirs[i]));
          assert.ok(apart < 2e-5 * Math.hypot(...theirs), `corner ${c}: ${ours} and ${theirs}`);
        }
    }
  },

  // Both materials were once blue: the key of the program was that of the hook which untangle() found.
  laterHooksAreInTheKeyAndKeepTheFrame() {
    const shader = () => ({ vertexShader: '#include <common>', fragmentShader: `#include <normalmap_pars_fragment>\n#include <normal_fragment_maps>\n` });
    const [red, blue] = [0, 1].map(() => square(mapOf(), 0)), calls = [];
    untangle({ scenes: [new THREE.Group().add(red, blue)] });
    const plain = red.material.customProgramCacheKey();
    assert.equal(plain, blue.material.customProgramCacheKey());
    red.material.onBeforeCompile = () => { calls.push('red'); };
    blue.material.onBeforeCompile = () => { calls.push('blue'); };
    const keys = [red, blue].map(({ material }) => material.customProgramCacheKey());
    assert.equal(new Set([plain, ...keys]).size, 3, keys.join('\n'));
    for (const { material } of [red, blue]) {
      const given = shader();
      material.onBeforeCompile(given, null);
      assert.match(given.fragmentShader, /cotan_frame_orthonormal/);
    }
    assert.deepEqual(calls, ['red', 'blue']);
    // A hook that calls the previous one, as in three's examples: everything runs once.
    const { material } = red, before = material.onBeforeCompile;
    material.onBeforeCompile = (given, renderer) => { before(given, renderer); calls.push('after'); };
    const given = shader();
    material.onBeforeCompile(given, null);
    assert.deepEqual(calls.slice(2), ['red', 'after']);
    assert.equal(given.fragmentShader.match(/mat3 getTangentFrame/g).length, 1);
    material.customProgramCacheKey = () => 'mine';
    assert.match(material.customProgramCacheKey(), /^cotan,orthonormal.*mine$/s);
  },

  clonesOfMaterialsKeepTheFrame() {
    for (const frame of ['cotangent', 'smooth']) {
      const mesh = square(mapOf(), -1);
      untangledSigns([mesh], { frame });
      const clone = mesh.material.clone(), again = clone.clone();
      for (const material of [clone, again]) {
        assert.equal(frameOf({ material }), frame);
        assert.equal(material.normalScale.y, 1); // green is read as in the original
        const given = { vertexShader: '#include <common>\n#include <defaultnormal_vertex>', fragmentShader: '#include <normalmap_pars_fragment>\n#include <normal_fragment_maps>' };
        material.onBeforeCompile(given, null);
        assert.match(given.fragmentShader, new RegExp(`cotan_frame_${frame}\\( n`));
      }
      mesh.material = clone;
      assert.deepEqual(untangledSigns([mesh]).signs, [1]); // the clone is recognized: green is not inverted twice
    }
    const material = new THREE.MeshStandardMaterial({ normalMap: mapOf() });
    replaceFrame(material, { frame: 'cotangent' });
    assert.equal(frameOf({ material: material.clone() }), 'cotangent');
    const copy = new THREE.MeshStandardMaterial().copy(material); // copy() calls no hook: `from` gives the frame
    assert.equal(frameOf({ material: replaceFrame(copy, { from: material }) }), 'cotangent');
  },

  // WebGLRenderer frees the resources of a geometry or material on its event `dispose`.
  replacementsAreFreedWithTheOriginal() {
    for (const frame of ['smooth', 'triangle', 'orthonormal']) {
      const mesh = square(mapOf(), 1), old = mesh.geometry, freed = [];
      const watch = (geometry, name) => geometry.addEventListener('dispose', () => freed.push(name));
      watch(old, 'old');
      untangledSigns([mesh], { frame });
      assert.ok(freed.includes('old'), `${frame}: what was drawn of the tangents and the old vertices is freed`);
      if (mesh.geometry === old) continue;
      watch(mesh.geometry, 'new');
      old.dispose();
      assert.ok(freed.includes('new'), frame);
    }
    const map = mapOf(), material = new THREE.MeshStandardMaterial({ normalMap: map }), meshes = [square(map, 1, { material }), square(map, 1, { material, mirrored: true })];
    meshes[1].geometry.attributes.tangent.array.fill(-1);
    material.userData.cotanFrame = 'smooth';
    const other = square(map, 1, { material });
    other.geometry.morphAttributes.position = [other.geometry.attributes.position]; // smooth cannot be used then
    const { warn } = console;
    console.warn = () => {};
    untangledSigns([...meshes, other]);
    console.warn = warn;
    assert.notEqual(other.material, meshes[0].material);
    const [first, copy] = meshes[0].material === material ? [material, other.material] : [other.material, meshes[0].material];
    let gone = 0;
    copy.addEventListener('dispose', () => { ++gone; });
    first.dispose();
    assert.equal(gone, 1);
  },

  // 0.160 has no three/tsl at all, 0.180 has one without the names that are needed.
  async olderVersionsOfThreeWorkAndTooOldOnesAreRefused() {
    globalThis.self ??= globalThis; // three 0.180's nodes ask for it
    for (const revision of ['160', '180']) {
      if (!fs.existsSync(path.join(modules, `three${revision}`))) skip(`three${revision} is not installed (see the test npm_packages)`);
      const place = installed(tarball);
      fs.symlinkSync(path.join(path.resolve(modules), `three${revision}`), path.join(place, 'node_modules/three'));
      fs.writeFileSync(path.join(place, 'from.mjs'), 'export const from = (name) => import(name);\n');
      const { from: older } = await import(pathToFileURL(path.join(place, 'from.mjs'))), old = await older('three');
      assert.equal(old.REVISION, revision);
      const material = new old.MeshStandardMaterial({ normalMap: new old.DataTexture(new Uint8Array(4), 1, 1) }), classic = await older('cotan/three');
      classic.untangle(new old.Mesh(new old.PlaneGeometry(), material));
      assert.match(material.customProgramCacheKey(), /cotan,cotangent/);
      await assert.rejects(older('cotan/three/tsl'), (error) => error instanceof classic.CotanError && error.code === 'unavailable'
        && error.message === `three: expected version 0.185 or later for cotan/three/tsl, found ${revision}`);
      // The peer dependency requires no more than that.
      assert.equal(JSON.parse(fs.readFileSync(path.join(place, 'node_modules/cotan/package.json'), 'utf8')).peerDependencies.three, '>=0.160.0');
    }
  },

  // three leaves the nodes of such a material out of the key by which it shares programs. A program of its own for each
  // material would cost 20 times as long at the first frame of 100 materials.
  async materialsOfOneFrameShareAProgramAndOthersDoNot() {
    const TSL = await from('cotan/three/tsl'), maps = [mapOf('a'), mapOf('b')];
    for (const Kind of [THREE.MeshStandardMaterial, THREE.MeshPhysicalMaterial]) {
      const [a, b] = maps.map((normalMap) => TSL.replaceFrame(new Kind({ normalMap }))), key = a.customProgramCacheKey();
      assert.equal(key, b.customProgramCacheKey());
      assert.equal(key, a.clone().customProgramCacheKey());
      const twoChannels = mapOf('c');
      twoChannels.format = THREE.RGFormat;
      assert.notEqual(key, TSL.replaceFrame(new Kind({ normalMap: twoChannels })).customProgramCacheKey());
      assert.notEqual(key, TSL.replaceFrame(new Kind({ normalMap: maps[0] }), { frame: 'smooth' }).customProgramCacheKey());
      assert.notEqual(key, TSL.replaceFrame(new Kind({ normalMap: maps[0] }), { against: true }).customProgramCacheKey());
      const own = TSL.replaceFrame(new Kind({ normalMap: maps[0] }));
      own.colorNode = TSL.perturbedNormal(maps[0]); // a node of the user
      assert.notEqual(key, own.customProgramCacheKey());
      a.customProgramCacheKey = () => 'set later'; // by the user
      assert.match(a.customProgramCacheKey(), /cotan,orthonormal,.*set later/);
      TSL.replaceFrame(a, { frame: 'cotangent' });
      assert.match(a.customProgramCacheKey(), /cotan,cotangent,.*set later/);
    }
  },

  // A map that is named without a mesh is read like most are baked, as `cotan shader` advises. The functions are found in
  // what the node makes for a builder that says no more than which language it needs.
  async nodesOfAUserReadMapsForMikkTSpaceUnlessAFrameIsNamed() {
    const { perturbedNormal } = await from('cotan/three/tsl');
    const builder = { isFlatShading: () => false, renderer: { backend: { isWebGPUBackend: true } } };
    const framesOf = (frame) => {
      const seen = new Set(), found = new Set();
      const walk = (part) => {
        if (!part || typeof part !== 'object' || seen.has(part)) return;
        seen.add(part);
        for (const [, name] of typeof part.code === 'string' ? part.code.matchAll(/fn cotan_frame_(\w+)/g) : []) found.add(name);
        Object.values(part).forEach(walk);
      };
      walk(perturbedNormal(mapOf(), undefined, frame).shaderNode.jsFunc([], builder));
      return [...found].join();
    };
    assert.deepEqual([undefined, 'orthonormal', 'cotangent'].map(framesOf), ['orthonormal', 'orthonormal', 'cotangent']);
  },

  unknownArgumentsAreRefused() {
    for (const [work, field] of [[() => untangle(), 'target'], [() => untangle(new THREE.Scene(), { frame: 'mikktspace' }), 'options.frame'],
      [() => untangle(new THREE.Scene(), { fraem: 'smooth' }), 'options.fraem'], [() => untangle(new THREE.Scene(), { note: 'loud' }), 'options.note'],
      [() => untangle(new THREE.Scene(), { convention: 'unity' }), 'options.convention'],
      ...[0, -1, NaN, Infinity, '1', true].map((maxDegrees) => [() => untangle(new THREE.Scene(), { maxDegrees }), 'options.maxDegrees']), [() => replaceFrame(), 'material'], [() => replaceFrame(new THREE.Mesh()), 'material'],
      [() => replaceFrame(new THREE.MeshStandardMaterial(), { frame: 'smoth' }), 'options.frame'], [() => replaceFrame(new THREE.MeshStandardMaterial(), { fraem: 'smooth' }), 'options.fraem'],
      [() => replaceFrame(new THREE.MeshStandardMaterial(), { against: 1 }), 'options.against'], [() => replaceFrame(new THREE.MeshStandardMaterial(), { from: {} }), 'options.from']])
      assert.throws(work, (error) => error instanceof CotanError && error instanceof library.CotanError && error.code === 'usage' && error.field === field);
  },
};
await runCases(cases, only);
