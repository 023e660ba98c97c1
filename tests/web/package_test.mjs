// The npm package from its tarball, installed in an empty folder and run by node:
//   node package_test.mjs TARBALL LIBRARY [CASE]
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { gzipSync } from 'node:zlib';

import { basisFolder, texelsOf, transcoder } from './basis_transcoder.mjs';
import { data, missing } from './data.mjs';
import { emptyFolder, filesUnder, here, hills, imageOf, installed, load, parseGlb, runCases, skip } from './shared.mjs';

const [tarball, library, only] = process.argv.slice(2), modules = path.join(path.dirname(path.dirname(path.dirname(tarball))), 'npm/node_modules');
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
const folder = installed(tarball);
const cotan = await load(folder), small = await load(folder, 'tangents');
await Promise.all([cotan.ready, small.ready]);
const native = (what, place) => execFileSync('python3', [path.join(here, 'native.py'), library, what, place]);
const needsData = () => { if (missing) skip(missing); };

const cases = {
  async bothEntryPointsLoad() {
    for (const name of ['cotan_beside', 'tangents_beside']) {
      const beside = await load(folder, name);
      await beside.ready;
      assert.equal(beside.version(), cotan.version());
    }
    const program = "import { ready, tangents } from 'cotan/tangents'; import * as all from 'cotan'; await ready; await all.ready;"
      + ' console.log(tangents({ positions: [0,0,0, 1,0,0, 0,1,0], normals: [0,0,1, 0,0,1, 0,0,1], uvs: [0,1, 1,1, 0,0] }).join(" "))';
    fs.writeFileSync(path.join(folder, 'use.js'), program);
    // u runs along x and v against y: w is 1, because cross(n, t) = y points up in the image.
    assert.equal(execFileSync('node', ['use.js'], { cwd: folder, encoding: 'utf8' }).trim(), '1 0 0 1 1 0 0 1 1 0 0 1');
    fs.writeFileSync(path.join(folder, 'old.js'), "delete process.getBuiltinModule; const { ready, version } = await import('cotan/tangents/beside'); await ready; console.log(version())");
    assert.equal(execFileSync('node', ['old.js'], { cwd: folder, encoding: 'utf8' }).trim(), cotan.version(), 'Node.js before 20.16');
  },

  async tangentsEqualTheNativeOnes() {
    const place = emptyFolder(), mesh = hills(60);
    fs.writeFileSync(path.join(place, 'mesh.bin'), Buffer.concat([Uint32Array.of(mesh.positions.length / 3, mesh.indices.length),
      mesh.positions, mesh.normals, mesh.uvs, mesh.indices].map((array) => Buffer.from(array.buffer))));
    native('tangents', place);
    for (const module of [cotan, small]) {
      const { u, v } = module.smooth(mesh), t = module.triangles(mesh);
      const made = [module.tangents(mesh), module.tangents(mesh, { kind: 'vertex' }), u, v, t.u, t.v];
      const expected = fs.readFileSync(path.join(place, 'native.bin'));
      let at = 0;
      made.forEach((array, k) => {
        assert.ok(Buffer.from(array.buffer).equals(expected.subarray(at, at + array.byteLength)), `array ${k}`);
        at += array.byteLength;
      });
      assert.equal(at, expected.length);
    }
  },

  async lintAndConvertMatchTheNativeOnes() {
    needsData();
    const close = (a, b, where) => {
      if (typeof a === 'number' && typeof b === 'number')
        return assert.ok(Math.abs(a - b) <= 1e-6 * Math.max(1, Math.abs(a)), `${where}: ${a} and ${b}`);
      if (a === null || typeof a !== 'object') return assert.equal(a, b, where);
      assert.deepEqual(Object.keys(a), Object.keys(b), where);
      for (const key of Object.keys(a)) if (key !== 'bytes_after') close(a[key], b[key], `${where}.${key}`);
    };
    let compared = 0;
    for (const file of [path.join(data, 'bad/made/ok_quad.glb'), ...filesUnder(path.join(data, 'models')).filter((name) =>
      name.endsWith('.glb') && fs.statSync(name).size < 2e6).slice(0, 4)]) {
      const place = emptyFolder(), model = fs.readFileSync(file);
      fs.writeFileSync(path.join(place, 'model.glb'), model);
      native('model', place);
      const json = (name) => JSON.parse(fs.readFileSync(path.join(place, name), 'utf8'));
      const linted = await cotan.lint(model).catch((error) => assert.match(error.message, /need the package sharp/));
      if (!linted) continue; // a JPEG map, which each library rounds differently
      ++compared;
      const { over_limit: over, ...found } = linted; // only the package adds over_limit
      assert.deepEqual(over, []);
      close(found, json('lint.json'), 'lint');
      const made = await cotan.convert(model, { mode: 'convert' }), { mode, bytes, ...report } = made.report;
      assert.deepEqual([mode, bytes], ['convert', { before: model.length, after: made.glb.length }]);
      close(report, json('converted.json'), 'convert');
      const ours = parseGlb(made.glb), theirs = parseGlb(fs.readFileSync(path.join(place, 'converted.glb')));
      assert.deepEqual(ours.json.accessors, theirs.json.accessors);
      for (let i = 0; i < (theirs.json.images ?? []).length; ++i) {
        if (theirs.json.images[i].uri) {
          assert.equal(ours.json.images[i].uri, theirs.json.images[i].uri);
          continue;
        }
        const [a, b] = [imageOf(ours, i), imageOf(theirs, i)];
        if (Buffer.from(a).equals(Buffer.from(b))) continue; // unchanged
        const [x, y] = [await cotan.decodePng(a), await cotan.decodePng(b)];
        assert.deepEqual([x.width, x.height, x.bits], [y.width, y.height, y.bits]);
        assert.ok(Buffer.from(x.data.buffer).equals(Buffer.from(y.data.buffer)), `${file}: image ${i}`);
      }
    }
    assert.ok(compared > 1, `${compared} models`);
  },

  // A model of 258 KB once became 618 KB, with maps as PNG for a frame that nobody requested. Tangents stay exactly where
  // the library says so, where glTF requires them, and where a map could not be decoded.
  async droppingTangentsNeverMakesAFileLarger() {
    needsData();
    const { default: validator } = await import(path.join(modules, 'gltf-validator/index.js')).catch(() => ({}));
    let dropped = 0;
    for (const file of ['models/SketchfabCat/scene.gltf', 'animated/lumberjack.glb', 'models/TwoSidedPlane/TwoSidedPlane.glb', 'models/ClearCoatTest/ClearCoatTest.glb', 'models/FlightHelmet/FlightHelmet.gltf',
      'models/BoomBox/BoomBox.gltf', 'models/GlamVelvetSofa/GlamVelvetSofa.glb', 'models/NormalTangentTest/NormalTangentTest.glb', 'models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb', 'models/MultiUVTest/MultiUVTest.glb']) {
      const place = path.join(data, file), model = fs.readFileSync(place), files = {};
      const original = file.endsWith('.glb') ? parseGlb(model).json : JSON.parse(model);
      for (const { uri } of [...original.buffers, ...original.images ?? []]) if (uri) files[decodeURIComponent(uri)] = fs.readFileSync(path.join(path.dirname(place), decodeURIComponent(uri)));
      const sharpless = async (bytes, name) => { // what node can decode without sharp: PNG
        if (bytes[0] === 0x89) return cotan.decodePng(bytes);
        throw new cotan.CotanError('unavailable', `${name}: no decoder`);
      };
      const { glb, report } = await cotan.convert(model, { files, decode: sharpless }), { json } = parseGlb(glb);
      const before = model.length + Object.values(files).reduce((sum, bytes) => sum + bytes.length, 0);
      console.log(`${file}: ${report.mode}, ${report.bytes.before} bytes before, ${report.bytes.after} after; ${report.notes}`);
      assert.deepEqual(report.bytes, { before, after: glb.length });
      assert.ok(glb.length <= 1.02 * before, `${file}: ${glb.length} bytes of ${before}`);
      // Only a coat with a map over a surface without one requires TANGENT among these.
      const requires = (material) => !material?.normalTexture && material?.extensions?.KHR_materials_clearcoat?.clearcoatNormalTexture;
      const unread = report.decisions.length === 0, chosen = new Map(report.decisions.map((one) => [`${one.mesh} ${one.primitive}`, one]));
      if (unread) assert.ok(report.notes.some((line) => /no decoder; its maps are not judged and its tangents stay/.test(line)), file);
      json.meshes.forEach(({ primitives }, m) => primitives.forEach(({ attributes, targets = [], material, extras }, p) => {
        const before = original.meshes[m].primitives[p], decision = chosen.get(`${m} ${p}`), stays = unread || decision?.tangents_stay || !!requires(json.materials?.[material]);
        const names = decision && !['no_map', 'not_judged'].includes(decision.reason);
        [attributes, ...targets].forEach((one, k) => assert.equal('TANGENT' in one, 'TANGENT' in [before.attributes, ...before.targets ?? []][k] && stays, `${file}: ${m} ${p}`));
        assert.equal(extras?.cotanFrame, names ? decision.frame : undefined, `${file}: ${m} ${p}`);
      }));
      if (report.mode === 'drop') {
        ++dropped;
        const images = (original.images ?? []).map(({ uri }, k) => (uri ? files[decodeURIComponent(uri)] : imageOf(parseGlb(model), k)));
        const reversed = report.maps.filter((map) => map.green_reversed).map(({ image }) => image);
        for (const [k, bytes] of images.entries()) {
          const after = imageOf(parseGlb(glb), k);
          if (!reversed.includes(k)) assert.ok(Buffer.from(after).equals(Buffer.from(bytes)), `${file}: image ${k}`);
          else if (bytes[0] === 0x89) { // lossless: nothing but green differs, which is mirrored about zero
            const [a, b] = [await cotan.decodePng(bytes), await cotan.decodePng(after)], most = b.bits === 16 ? 65535 : 255;
            assert.ok(a.data.every((value, i) => (i % 4 === 1 ? Math.abs(value + b.data[i] - most) <= 1 : value === b.data[i])), `${file}: image ${k}`);
          }
        }
        for (const [k, material] of json.materials.entries()) {
          const { cotanUnsigned: _, ...extras } = material.extras ?? {}; // says how a reversed map is read
          assert.deepEqual(reversed.length === 0 ? material.extras ?? {} : extras, original.materials[k].extras ?? {}, file);
        }
      }
      if (validator) {
        const faults = async (bytes) => (await validator.validateBytes(bytes, { maxIssues: 10000, externalResourceFunction: async (uri) => new Uint8Array(files[decodeURIComponent(uri)]) })).issues.messages
          .filter(({ severity }) => severity === 0).map(({ code }) => code);
        const known = new Set(await faults(new Uint8Array(model)));
        assert.deepEqual((await faults(glb)).filter((code) => !known.has(code)), [], file);
      }
    }
    assert.ok(dropped >= 8, `${dropped} with their maps as they are`);
  },

  // Green of its maps is reversed by itself, and right together with its tangents. It must not be inverted twice.
  async greenThatTangentsReverseIsNotFixed() {
    needsData();
    const place = path.join(data, 'models/SketchfabCat'), model = fs.readFileSync(path.join(place, 'scene.gltf')), files = {};
    for (const { uri } of [...JSON.parse(model).buffers, ...JSON.parse(model).images]) files[decodeURIComponent(uri)] = fs.readFileSync(path.join(place, decodeURIComponent(uri)));
    const { report } = await cotan.convert(model, { files, fixGreen: true, mode: 'drop' });
    assert.deepEqual([report.green_fixed, report.mode], [undefined, 'keep']); // no map is read: the tangents stay
  },

  // The typings promise both spellings; the library asks for the decoded one.
  async filesAreFoundByTheirUrisAsWrittenOrDecoded() {
    needsData();
    const place = path.join(data, 'models/BoomBox'), model = JSON.parse(fs.readFileSync(path.join(place, 'BoomBox.gltf'))), written = {}, decoded = {};
    [...model.buffers, ...model.images].forEach((one, k) => {
      const bytes = fs.readFileSync(path.join(place, one.uri));
      one.uri = `a%20folder/file%20%C3%A9%25${k}`;
      written[one.uri] = bytes;
      decoded[`a folder/file \u00e9%${k}`] = bytes;
    });
    const bytes = new TextEncoder().encode(JSON.stringify(model)), [first, second] = [await cotan.convert(bytes, { files: written }), await cotan.convert(bytes, { files: decoded })];
    assert.ok(Buffer.from(first.glb).equals(Buffer.from(second.glb)));
    assert.deepEqual(first.report.bytes, second.report.bytes);
    assert.deepEqual(await cotan.lint(bytes, { files: written }), await cotan.lint(bytes, { files: decoded }));
  },

  async modesOfConversionAreChosenAndRefused() {
    needsData();
    const model = fs.readFileSync(path.join(data, 'models/TwoSidedPlane/TwoSidedPlane.glb'));
    // Its tangents reverse green: `drop`, which changes no map, keeps them.
    for (const [options, mode] of [[{}, 'drop'], [{ mode: 'auto' }, 'drop'], [{ maxDegrees: 2 }, 'drop'], [{ from: 'mikktspace' }, 'drop'], [{ generateTangents: true }, 'drop'],
      [{ mode: 'drop' }, 'keep'], [{ mode: 'convert' }, 'convert'], [{ to: 'orthonormal' }, 'convert'], [{ bits: 16 }, 'convert']])
      assert.equal((await cotan.convert(model, options)).report.mode, mode, JSON.stringify(options));
    for (const options of [{ mode: 'all' }, { mode: 'drop', to: 'smooth' }, { mode: 'drop', bits: 8 }, { mode: 'drop', maxDegrees: 1 }, { maxDegrees: 0 }, { maxDegrees: '1' }, { maxDegrees: NaN }])
      await assert.rejects(cotan.convert(model, options), (error) => error instanceof cotan.CotanError && error.code === 'usage');
  },

  // The cat has parts on which each frame is visibly off: with a larger limit fewer keep their tangents, and what lint
  // predicts with a limit is what convert does with it.
  async maxDegreesMovesTheChoiceInLintAndConvert() {
    needsData();
    const place = path.join(data, 'models/SketchfabCat'), model = fs.readFileSync(path.join(place, 'scene.gltf')), files = {}, kept = [];
    for (const { uri } of [...JSON.parse(model).buffers, ...JSON.parse(model).images]) files[decodeURIComponent(uri)] = fs.readFileSync(path.join(place, decodeURIComponent(uri)));
    for (const maxDegrees of [undefined, 2]) {
      const { glb, report } = await cotan.convert(model, { files, maxDegrees }), found = await cotan.lint(model, { files, maxDegrees });
      kept.push(parseGlb(glb).json.meshes.flatMap((mesh) => mesh.primitives).filter(({ attributes }) => 'TANGENT' in attributes).length);
      assert.deepEqual(report.decisions.map(({ frame, tangents_stay: stays }) => [frame, stays]).sort(), found.decisions.map(({ frame, tangents_stay: stays }) => [frame, stays]).sort());
      assert.deepEqual([found.primitives_keeping, report.mode], [kept.at(-1), 'drop']);
      for (const { tangents_stay: stays, candidates, reason } of report.decisions) {
        assert.equal(reason, stays ? 'keeps' : 'fits');
        const fits = candidates.filter(({ stored, mean, percentile99 }) => !stored && mean <= (maxDegrees ?? 0.3) && percentile99 <= 10 * (maxDegrees ?? 0.3));
        assert.equal(fits.length === 0, stays);
      }
    }
    assert.ok(kept[0] > kept[1], `${kept} keep their tangents`);
  },

  async pngFilesRoundTrip() {
    for (const [bits, Type] of [[8, Uint8Array], [16, Uint16Array]])
      for (const alpha of [false, true]) {
        const picture = { width: 37, height: 11, bits, data: Type.from({ length: 37 * 11 * 4 }, (_, i) => (i % 4 === 3 && !alpha ? -1 : i * i * 257 + 7 * i)) };
        const again = await cotan.decodePng(await cotan.encodePng(picture));
        assert.deepEqual(again, picture);
      }
  },

  async mapsConvertAndTheirGreenIsDetected() {
    const side = 64, waves = { width: side, height: side, data: new Float32Array(side * side * 4) };
    const height = (x, y) => Math.sin(2 * Math.PI * x / side) * Math.cos(4 * Math.PI * y / side);
    for (let y = 0; y < side; ++y)
      for (let x = 0; x < side; ++x) waves.data.fill(height(x, y), 4 * (y * side + x), 4 * (y * side + x) + 4);
    const map = cotan.fromHeight(waves, { scale: 2, bits: 16 });
    assert.equal(cotan.detect(map).green, 'up');
    const turned = cotan.convertMap(map, { to: 'directx' });
    assert.equal(cotan.detect(turned).green, 'down');
    const back = cotan.toHeight(turned, { from: 'directx' });
    // Central differences attenuate a wave of 32 texels by 0.6 %.
    back.data.forEach((h, i) => assert.ok(Math.abs(h - 2 * height(i % side, Math.floor(i / side))) < 0.04));
    assert.deepEqual(cotan.mips(map).map((level) => level.normals.width), [64, 32, 16, 8, 4, 2, 1]);
    assert.deepEqual(cotan.mips(map)[0].roughness.data, cotan.mips(map, { roughness: 0.3 })[0].roughness.data); // as map mips
    assert.equal(cotan.info(map).content, 'tangent space');
    // Two channels wherever they are, and exchanged ones: as stated, and found.
    const eight = cotan.convertMap(map, { bits: 8 }), moved = (texel) => ({ ...eight, data: eight.data.map((_, i, all) => texel(all.subarray(i - i % 4, i - i % 4 + 4))[i % 4]) });
    for (const [from, stored] of [['gltf,xy', moved(([x, y]) => [255, y, 255, x])], ['gltf,xy', moved(([x, y]) => [x, x, x, y])],
      ['gltf', moved(([x, y]) => [x, y, 128, 255])], ['gltf,bgr', moved(([x, y, z, a]) => [z, y, x, a])]])
      for (const words of [from, 'auto'])
        cotan.convertMap(stored, { from: words, to: 'opengl' }).data.forEach((value, i) => assert.ok(Math.abs(value - eight.data[i]) <= 2, words));
    const flat = { width: 1, height: 1, data: Uint16Array.of(32768, 32768, 65535, 65535) };
    const same = cotan.blend(map, flat).data;
    map.data.forEach((value, i) => assert.ok(Math.abs(value - same[i]) <= 1));
    assert.match(cotan.shader({ language: 'wgsl', frame: 'orthonormal' }), /fn /);
    assert.match(cotan.shader({ language: 'godot', convention: 'godot' }), /\nshader_type spatial;/);
    assert.equal(cotan.shader({ language: 'godot' }), cotan.shader({ language: 'godot', frame: 'orthonormal' }));
    const ofStage = (stage) => cotan.shader({ language: 'wgsl', frame: 'triangle', stage });
    assert.match(ofStage('fragment'), /fn cotan_perturb_normal_on_triangle\(/);
    assert.doesNotMatch(ofStage('fragment'), /fn cotan_make_triangle\(/);
    assert.match(ofStage('vertex'), /fn cotan_make_triangle\(/);
    assert.match(ofStage(undefined), /fn cotan_make_triangle\([^]*fn cotan_perturb_normal_on_triangle\(/);
    const points = { normals: [0, 0, 1], dpdx: [2, 0, 0], dpdy: [0, 2, 0], duvdx: [-1, 0], duvdy: [0, 1] };
    const out = cotan.apply('cotangent', points, [0.6, 0.48, 0.64]); // u along -x
    [-0.6, 0.48, 0.64].forEach((value, i) => assert.ok(Math.abs(out[i] - value) < 1e-5));
    cotan.encode('cotangent', points, out).forEach((value, i) => assert.ok(Math.abs(value - [0.6, 0.48, 0.64][i]) < 1e-5));
  },

  async errorsNameTheFieldAndTheFault() {
    const fails = (work, expected) => assert.throws(work, (error) => {
      assert.ok(error instanceof cotan.CotanError || error instanceof small.CotanError, String(error));
      for (const [name, value] of Object.entries(expected)) assert.equal(error[name], value, error.message);
      return !error.message.includes('\n');
    });
    const mesh = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], normals: [0, 0, 1, 0, 0, 1, 0, 0, 1], uvs: [0, 0, 1, 0, 0, 1] };
    fails(() => cotan.tangents({ ...mesh, indices: [0, 1, 3] }),
      { code: 'input', field: 'mesh.indices[2]', expected: 'less than 3', found: '3' });
    fails(() => small.tangents({ ...mesh, uvs: [0] }), { code: 'usage', field: 'mesh.uvs' });
    fails(() => small.tangents({ ...mesh, indices: [0, 1, -1] }), { code: 'usage', field: 'mesh.indices[2]', found: '-1' });
    fails(() => small.tangents({ ...mesh, indices: [0, 1] }), { code: 'usage' });
    fails(() => small.tangents(), { code: 'usage' });
    fails(() => small.tangents(mesh, { kind: 'smooth' }), { code: 'usage', field: 'options.kind' });
    fails(() => small.tangents(mesh, { knid: 'vertex' }), { code: 'usage' });
    fails(() => cotan.convertMap({ width: 2, height: 2, data: new Uint8Array(15) }), { code: 'usage', field: 'map.data' });
    fails(() => cotan.shader({ language: 'basic' }), { code: 'usage' });
    fails(() => cotan.shader({ language: 'wgsl' }), { code: 'usage', expected: 'orthonormal for maps that were baked for MikkTSpace, as most are; smooth or cotangent for maps that you bake for this shader' });
    fails(() => cotan.shader({ frame: 'triangle', stage: 'pixel' }), { code: 'usage', field: 'options.stage', found: "'pixel'" });
    fails(() => cotan.shader({ frame: 'cotangent', stage: 'mesh' }), { code: 'usage', expected: 'the frame triangle in its fused form' });
    await assert.rejects(cotan.lint(new Uint8Array(3)), { code: 'input' });
    await assert.rejects(cotan.lint('model.glb'), { code: 'usage' });
    await assert.rejects(cotan.convert(new TextEncoder().encode('{}')), { code: 'input' });
  },

  // A height of 1e9 with 4 bytes of data once encoded endlessly, and 3000 x 30000 with 4 bytes gave an empty image.
  async encodePngValidatesItsImageFirst() {
    const data = new Uint8Array(4);
    for (const [picture, field] of [[{ width: 1, height: 1e9, data }, 'image.height'], [{ width: 3000, height: 30000, data }, 'image.data'],
      [{ width: 1, height: 1, data: [0, 0, 0, 0] }, 'image.data'], [{ width: 1, height: 1, data: new Float32Array(4) }, 'image.data'],
      [{ width: 1, height: 1, bits: 16, data }, 'image.bits'], [undefined, 'image']])
      await assert.rejects(cotan.encodePng(picture), (error) => error instanceof cotan.CotanError && error.code === 'usage' && error.field === field);
    await assert.rejects(cotan.encodePng({ width: 65536, height: 2048, data: { length: 4 } }), cotan.CotanError);
    const png = await cotan.encodePng({ width: 1, height: 1, data: Uint8ClampedArray.of(1, 2, 3, 255) }); // without bits, as from a canvas
    assert.deepEqual([...(await cotan.decodePng(png)).data], [1, 2, 3, 255]);
  },

  // Sizes of 32 bits wrap: 357,913,942 elements of 12 bytes are 2^32 + 8 bytes, not 8, and 2^32 + 12 bytes are not 12.
  async sizesThatOverflow32BitsAreRefused() {
    const model = (accessor, view) => new TextEncoder().encode(JSON.stringify({
      asset: { version: '2.0' }, buffers: [{ byteLength: 36, uri: `data:;base64,${Buffer.alloc(36).toString('base64')}` }],
      bufferViews: [{ buffer: 0, byteLength: 36, ...view }],
      accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', ...accessor }, { componentType: 5126, count: 3, type: 'VEC3' }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }], nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }], scene: 0,
    }));
    await cotan.lint(model({}, {}));
    for (const [accessor, view] of [[{ count: 357913942 }, {}], [{ count: 357913942, bufferView: undefined }, {}], [{ byteOffset: 4294967296 }, {}],
      [{}, { byteOffset: 4294967296 }], [{}, { byteLength: 4294967332 }], [{ count: 4294967299 }, {}]])
      for (const work of [cotan.lint, cotan.convert])
        await assert.rejects(work(model(accessor, view)), (error) => error instanceof cotan.CotanError
          && error.code === 'input' && !/stopped/.test(error.message), JSON.stringify([accessor, view]));
  },

  async everyFunctionRefusesNonsenseWithACotanError() {
    const nonsense = [undefined, null, 0, -1, NaN, 1e9, 'text', true, [], [1], ['a'], [1n], {}, () => 1, new Uint8Array(3), new Float64Array(9), new BigInt64Array(3), new DataView(new ArrayBuffer(8)),
      { width: 1, height: 1, data: new Uint8Array(4) }, { positions: [0, 0, 0], normals: [0], uvs: {} }, { from: 7 }, { maps: [], primitives: [7] }, { files: null }, { decode: 1 }];
    let calls = 0, refused = 0;
    for (const [name, work] of Object.entries({ ...cotan })) {
      if (typeof work !== 'function' || name === 'CotanError') continue;
      for (const first of nonsense)
        for (const second of nonsense)
          for (const third of [undefined, nonsense[(calls * 7) % nonsense.length]]) {
            ++calls;
            try {
              await work(first, second, third);
            } catch (error) {
              ++refused;
              assert.ok(error instanceof cotan.CotanError, `${name}(${[first, second, third].map(String)}): ${error.stack}`);
              // A billion vertices exhaust the memory: the library may stop, and a new instance replaces it.
              const full = [first, second, third].includes(1e9) ? /undefined is not|Cannot read/ : /undefined is not|Cannot read|the library stopped/;
              assert.doesNotMatch(error.message, full, `${name}: ${error.message}`);
            }
          }
    }
    assert.ok(calls > 10000 && refused > 0.8 * calls, `${refused} of ${calls} refused`);
  },

  // "Install libdraco-dev and build Cotan again" does not help users of npm.
  async missingDecodersAreExplainedForNpmUsers() {
    needsData();
    for (const [file, word] of [['heart_draco.glb', 'Draco'], ['pirate_meshopt.glb', 'meshoptimizer']])
      for (const work of [cotan.lint, cotan.convert])
        await assert.rejects(work(fs.readFileSync(path.join(data, 'compressed', file))), (error) => {
          assert.ok(error.code === 'unavailable' || error.code === 'input', error.code);
          assert.ok(error.message.includes('cotan/gltf-transform') && !/build Cotan|-dev/.test(error.message), error.message);
          return error instanceof cotan.CotanError;
        }, word);
  },

  async badInputLeaksNothing() {
    const memory = () => process.memoryUsage().arrayBuffers;
    const round = async () => {
      for (const work of [() => cotan.tangents({ positions: [0, 0, 0], normals: [0, 0, 1], uvs: [0, 0], indices: [0, 0, 1] }),
        () => cotan.convertMap({ width: 1, height: 1, data: new Uint8Array(4) }, { to: 'nonsense' }),
        () => cotan.tangents({ positions: [NaN, 0, 0], normals: [0, 0, Infinity], uvs: [0, NaN], indices: [0, 0, 0] }),
        () => cotan.shader({ frame: 'none' }), () => cotan.mips({ width: 1, height: 1, data: new Uint8Array(4) }, { roughness: 7 })]) {
        try {
          work();
        } catch (error) {
          assert.ok(error instanceof cotan.CotanError, String(error));
        }
      }
    };
    for (let i = 0; i < 200; ++i) await round();
    globalThis.gc?.();
    const before = memory();
    for (let i = 0; i < 2000; ++i) await round(); // five calls each
    globalThis.gc?.();
    assert.ok(memory() - before < 2e6, `${memory() - before} bytes more`);
  },

  async badFilesAreRefusedOrRead() {
    needsData();
    let read = 0, refused = 0;
    for (const file of filesUnder(path.join(data, 'bad')).filter((name) => /\.(glb|gltf)$/.test(name))) {
      const model = fs.readFileSync(file), files = {};
      for (const beside of filesUnder(path.dirname(file)))
        if (fs.statSync(beside).size < 1e6) files[path.relative(path.dirname(file), beside)] = fs.readFileSync(beside);
      for (const work of [cotan.lint, cotan.convert])
        try {
          await work(model, { files });
          ++read;
        } catch (error) {
          assert.ok(error instanceof cotan.CotanError && ['input', 'unavailable', 'limit'].includes(error.code), `${file}: ${error.stack}`);
          assert.doesNotMatch(error.message, /the library stopped/, file);
          ++refused;
        }
    }
    for (const file of filesUnder(path.join(data, 'bad')).filter((name) => name.endsWith('.png')))
      try {
        cotan.info(await cotan.decodePng(fs.readFileSync(file)));
        ++read;
      } catch (error) {
        assert.ok(error instanceof cotan.CotanError, `${file}: ${error.stack}`);
        ++refused;
      }
    assert.ok(read > 10 && refused > 10, `${read} read, ${refused} refused`);
  },

  async namesOfTheLastVersionWork() {
    assert.equal(cotan.decodePicture, cotan.decodeImage);
    const report = (stored) => ({ primitives: [{ mesh: 'a', normal_map: -1, uv: {}, stored_tangents: stored }], maps: [] });
    for (const stored of [{ rotated: 0.5 }, { turned: 0.5 }, { rotated: 0.5, turned: 0.5 }]) {
      const found = cotan.overLimits(report(stored), { limitArea: 1 });
      assert.deepEqual(found.map(({ kind, percent }) => [kind, percent]), [['rotated_tangents', 50]]);
    }
    assert.deepEqual(cotan.overLimits(report({ rotated: 0, turned: 0.5 }), { limitArea: 1 }), []);
  },

  async basisUniversalIsReadAsByItsTranscoder() {
    if (!fs.existsSync(basisFolder(modules))) skip('three is not installed (see the test npm_packages)');
    const made = await transcoder(modules), file = (name) => fs.readFileSync(path.join(here, `../../fuzz/corpus/image/${name}.ktx2`));
    for (const name of ['uastc_map', 'etc1s', 'etc1s_alpha']) {
      const wanted = texelsOf(made, file(name)), found = await cotan.decodeImage(file(name), name);
      assert.deepEqual([found.width, found.height, found.bits], [wanted.width, wanted.height, 8], name);
      assert.ok(Buffer.from(found.data).equals(Buffer.from(wanted.data)), name);
    }
    await assert.rejects(cotan.decodeImage(file('uastc_reserved'), 'a.ktx2'), { code: 'input', message: /^a\.ktx2: broken ktx2 image: UASTC: block 0, 0 / });
    await assert.rejects(cotan.decodeImage(file('uastc_zstd'), 'a.ktx2'), { code: 'unavailable', message: /^a\.ktx2: KTX2 with Zstandard is read by/ });
    // In a model: a quad with the map, read by lint and by convert.
    const floats = Float32Array.of(0, 0, 0, 2, 0, 0, 0, 1, 0, 2, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 1, 1, 0, 0, 1, 0);
    const bytes = Buffer.concat([Buffer.from(floats.buffer), Buffer.from(Uint32Array.of(0, 1, 2, 2, 1, 3).buffer)]);
    const view = (at, count, type, parts) => ({ view: { buffer: 0, byteOffset: at, byteLength: 4 * count * parts }, accessor: { componentType: type === 'SCALAR' ? 5125 : 5126, count, type } });
    const parts = [view(0, 4, 'VEC3', 3), view(48, 4, 'VEC3', 3), view(96, 4, 'VEC2', 2), view(128, 6, 'SCALAR', 1)];
    Object.assign(parts[0].accessor, { min: [0, 0, 0], max: [2, 1, 0] });
    const model = (name) => Buffer.from(JSON.stringify({
      asset: { version: '2.0' }, extensionsUsed: ['KHR_texture_basisu'], extensionsRequired: ['KHR_texture_basisu'],
      buffers: [{ byteLength: bytes.length, uri: `data:application/octet-stream;base64,${bytes.toString('base64')}` }],
      bufferViews: parts.map((part) => part.view), accessors: parts.map((part, bufferView) => ({ bufferView, ...part.accessor })),
      images: [{ uri: `data:image/ktx2;base64,${file(name).toString('base64')}` }], textures: [{ extensions: { KHR_texture_basisu: { source: 0 } } }],
      materials: [{ normalTexture: { index: 0 } }],
      meshes: [{ primitives: [{ attributes: { POSITION: 0, NORMAL: 1, TEXCOORD_0: 2 }, indices: 3, material: 0 }] }], nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }], scene: 0,
    }));
    const { report } = await cotan.convert(model('etc1s'), { mode: 'convert', to: 'cotangent' });
    assert.deepEqual(report.unread_maps, []);
    assert.equal(report.maps[0].format, 'PNG');
    assert.ok(!(await cotan.lint(model('etc1s'))).primitives[0].not_judged);
    assert.match((await cotan.lint(model('uastc_zstd'))).primitives[0].not_judged, /KTX2 with Zstandard/);
  },

  async packageIsSmall() {
    const place = path.join(folder, 'node_modules/cotan');
    const packed = (...names) => gzipSync(Buffer.concat(names.map((name) => fs.readFileSync(path.join(place, name)))), { level: 9 }).length;
    const script = (name) => fs.readFileSync(path.join(place, name), 'utf8');
    const reached = (name, seen = new Set()) => {
      if (seen.has(name)) return seen;
      seen.add(name);
      for (const [, to] of script(name).matchAll(/from '(\.[^']+)'/g)) reached(path.join(path.dirname(name), to), seen);
      return seen;
    };
    // Limits with the wasm in a separate file; inside the scripts, as text, it takes 2.4 % and 0.5 % more. 33,900: 30,000,
    // 1 KB to refuse sparse, detached and other wrong arguments by name and to replace an instance after any fault,
    // 2 KB for the search of meshes for numbers that are not finite and a shortcut that halves the time of smooth
    // cotangents, and 500 bytes for large arrays of zeros and meshes with a vertex for every corner. 425,000: it was
    // 453,000 with std::locale, which {fmt} uses unless Findfmt.cmake turns it off. 445,000: names of meshes
    // and files, CMYK, green that tangents reverse, and the faults of a model's maps take 18 KB; the locale, 2 KB. 441,600
    // are used: frames that are chosen by measurement take 9 KB, for which texts of lighting functions, which the package
    // cannot print, went: 12 KB. 450,000: each variant of a file is judged, 5 KB, and old names of fields, 1 KB.
    // 34,700 and 451,500: tangents with the weights of meshoptimizer, 0.7 KB; hard edges that lint names, what other engines
    // read as zero, and the materials of models with several maps, 3 KB. 454,500: ETC2 and EAC in KTX2, 3 KB.
    // 463,000: Basis Universal, and KTX2 that decodeImage reads, 8 KB. 466,500: BC in KTX2, 2.3 KB in each of two modules,
    // and new maps that stay KTX2, 1 KB.
    // 34,800: a second way to modules of Node.js before 20.16. 120,000: tables for EAC, which take a fifth of the time, and
    // UASTC by four lines at once, 5 KB. 468,000: levels with their roughness in strips, 1 KB. 122,500: BC7
    // by eight lanes, in half the time, 2.5 KB. 469,000: halfs that HLSL rounds itself, 0.5 KB. 472,500 and
    // 137,500: maps are read as the command reads them, and `auto` looks at a map; 3 KB, and 15 KB in a module that had
    // none of it.
    // With the libraries of scripts/web-libraries, 49 KB more to unpack Zstandard. The encoders of blocks are a module of
    // their own: 137 KB, and 138 KB more to pack Zstandard.
    const packs = !fs.readFileSync(path.join(place, 'wasm/cotan.wasm')).includes('libzstd, which unpacks');
    for (const [name, most] of [['tangents', 34800], ['cotan', packs ? 521500 : 472500], ['textures', packs ? 275500 : 137500]]) {
      const beside = packed(...reached(`${name}_beside.js`), `wasm/${name}.wasm`), inside = packed(...reached(`${name}.js`));
      console.log(`${name}: ${beside} bytes gzipped, ${inside} with the wasm inside`);
      assert.ok(beside <= most, `${name}: ${beside} bytes gzipped`);
      assert.ok(inside <= 1.03 * most, `${name}: ${inside} bytes gzipped, the wasm inside`);
    }
  },
};
await runCases(cases, only);
