// Tests cotan/gltf-transform from the tarball: node gltf_transform_test.mjs TARBALL NODE_MODULES [CASE]
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { texelsOf, transcoder } from './basis_transcoder.mjs';
import { data, hasZstandard, missing } from './data.mjs';
import { filesUnder, hills, imageOf, installed, load, parseGlb, runCases, skip } from './shared.mjs';

const [tarball, modules, only] = process.argv.slice(2);
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
if (!fs.existsSync(path.join(modules, '@gltf-transform'))) skip('the npm packages are not installed');
const folder = installed(tarball, modules, ['@gltf-transform', 'draco3dgltf', 'meshoptimizer', 'property-graph', 'ktx-parse', 'sharp', 'gltf-validator']);
// Imports from the installed folder, so that there is only the one copy of glTF-Transform that the package finds.
fs.writeFileSync(path.join(folder, 'from.js'), 'export const from = (name) => import(name);\n');
const { from } = await import(pathToFileURL(path.join(folder, 'from.js')));
const { Document, NodeIO } = await from('@gltf-transform/core');
const cotan = await load(folder), transforms = await load(folder, 'gltf-transform/index');
await cotan.ready;

/** A hilly mesh whose normal map has the same tilted texel everywhere. */
async function hillsDocument(mirrored = false) {
  const document = new Document(), buffer = document.createBuffer(), mesh = hills(6);
  if (mirrored) for (let i = 0; i < mesh.uvs.length; i += 2) mesh.uvs[i] = Math.abs(mesh.uvs[i] - 0.5);
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const picture = { width: 32, height: 32, bits: 8, data: new Uint8Array(4096) };
  for (let i = 0; i < 4096; i += 4) picture.data.set([166, 153, 249, 255], i);
  const texture = document.createTexture('bumps').setImage(await cotan.encodePng(picture)).setMimeType('image/png');
  const material = document.createMaterial().setNormalTexture(texture);
  const primitive = document.createPrimitive().setMaterial(material).setIndices(accessor('SCALAR', Uint16Array.from(mesh.indices)))
    .setAttribute('POSITION', accessor('VEC3', mesh.positions)).setAttribute('NORMAL', accessor('VEC3', mesh.normals))
    .setAttribute('TEXCOORD_0', accessor('VEC2', mesh.uvs));
  document.createScene().addChild(document.createNode().setMesh(document.createMesh('hills').addPrimitive(primitive)));
  return { document, mesh, primitive, texture };
}

async function sharpOrSkip() {
  try {
    const sharp = (await from('sharp')).default;
    await sharp({ create: { width: 1, height: 1, channels: 3, background: 'red' } }).webp().toBuffer();
    return sharp;
  } catch (error) {
    return skip(`sharp does not run here: ${error.message.split('\n')[0]}`);
  }
}

/** The GLB with its image also as the source of the texture, and without a reader that must support the extension. */
function withFallback(glb, extension = 'EXT_texture_webp') {
  const { json, bin } = parseGlb(glb), [texture] = json.textures;
  texture.source = texture.extensions[extension].source;
  delete json.extensionsRequired;
  const text = Buffer.from(JSON.stringify(json)), padded = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]), head = Buffer.alloc(20), chunk = Buffer.alloc(8);
  [0x46546c67, 2, 28 + padded.length + bin.length, padded.length, 0x4e4f534a].forEach((word, k) => head.writeUInt32LE(word, 4 * k));
  [bin.length, 0x004e4942].forEach((word, k) => chunk.writeUInt32LE(word, 4 * k));
  return new Uint8Array(Buffer.concat([head, padded, chunk, bin]));
}

/** Mean angle between two maps, of 8 or 16 bits, by the angle's cosine and sine in double. */
function degreesBetween(a, b) {
  const at = ({ bits, data }, i) => [0, 1, 2].map((k) => data[i + k] / (2 ** bits - 1) * 2 - 1);
  let sum = 0;
  for (let i = 0; i < a.data.length; i += 4) {
    const [p, q] = [at(a, i), at(b, i)], dot = p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    sum += Math.acos(Math.min(1, Math.max(-1, dot / Math.hypot(...p) / Math.hypot(...q)))) * 180 / Math.PI;
  }
  return sum / (a.data.length / 4);
}

/** Domes as a normal map, with green up or down in the image. */
function domes(size, up) {
  const picture = { width: size, height: size, bits: 8, data: new Uint8Array(4 * size * size) };
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      const [p, q] = [x, y].map((k) => 4 * ((k + 0.5) / size) % 2 - 1), r = Math.hypot(p, q) < 0.8 ? 1 : 0;
      const n = [p * r, (up ? -1 : 1) * q * r, Math.sqrt(1 - r * (p * p + q * q))];
      picture.data.set([...n.map((c) => Math.round(128 + 127 * c)), 255], 4 * (y * size + x));
    }
  return picture;
}

/** A smooth relief as a normal map, with one wave along each side. */
function waves(size) {
  const picture = { width: size, height: size, bits: 8, data: new Uint8Array(4 * size * size) };
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      const slopes = [x, y].map((k) => 0.3 * Math.cos(2 * Math.PI * (k + 0.5) / size)), length = Math.hypot(...slopes, 1);
      picture.data.set([...[-slopes[0], slopes[1], 1].map((c) => Math.round(128 + 127 * c / length)), 255], 4 * (y * size + x));
    }
  return picture;
}

const cornersOf = (primitive, semantic, size) => {
  const out = [], element = [];
  for (const vertex of primitive.getIndices().getArray()) out.push(...primitive.getAttribute(semantic).getElement(vertex, element).slice(0, size));
  return Float32Array.from(out);
};

const cases = {
  async indexedPrimitivesGetTheTangentsOfTheirCorners() {
    for (const mirrored of [false, true]) {
      const { document, mesh, primitive } = await hillsDocument(mirrored);
      const before = cornersOf(primitive, 'POSITION', 3);
      await document.transform(transforms.tangents());
      assert.deepEqual(cornersOf(primitive, 'TANGENT', 4), cotan.tangents(mesh));
      assert.deepEqual(cornersOf(primitive, 'POSITION', 3), before);
      assert.equal(primitive.getAttribute('POSITION').getCount() > 49, mirrored); // copies only where sides meet
    }
  },

  async tangentsHaveUnitLengthWhereDirectionsCancel() { // as glTF requires
    const { document, primitive } = await hillsDocument();
    const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(document.getRoot().listBuffers()[0]);
    const mesh = {
      positions: Float32Array.of(0, 0, 0, 1, 0, 0, 0.5, 0.9, 0, -0.5, 0.9, 0, -1, 0, 0),
      normals: Float32Array.from({ length: 15 }, (_, i) => Number(i % 3 === 2)),
      uvs: Float32Array.of(0, 0, 1, 0, 0, -1, 0, 1, 1, 0), // at the origin opposite directions of u
      indices: Uint16Array.of(0, 1, 2, 0, 2, 3, 0, 3, 4),
    };
    primitive.setIndices(accessor('SCALAR', mesh.indices)).setAttribute('POSITION', accessor('VEC3', mesh.positions))
      .setAttribute('NORMAL', accessor('VEC3', mesh.normals)).setAttribute('TEXCOORD_0', accessor('VEC2', mesh.uvs));
    await document.transform(transforms.tangents());
    const corners = cotan.tangents(mesh), written = cornersOf(primitive, 'TANGENT', 4);
    assert.deepEqual([...corners.slice(12, 16)], [0, 0, 0, 1]);
    assert.deepEqual([...written.slice(12, 16)], [1, 0, 0, 1]);
    for (let i = 0; i < written.length; i += 4) assert.ok(Math.abs(Math.hypot(...written.slice(i, i + 3)) - 1) < 1e-6, i);
  },

  async untangentMatchesConvert() {
    const { document, primitive, texture } = await hillsDocument();
    await document.transform(transforms.tangents());
    const { glb, report } = await cotan.convert(await new NodeIO().writeBinary(document), { mode: 'convert' });
    assert.equal(report.maps[0].kept, false);
    const image = (await new NodeIO().readBinary(glb)).getRoot().listTextures()[0].getImage();
    await document.transform(transforms.untangent({ mode: 'convert' }));
    assert.equal(primitive.getAttribute('TANGENT'), null);
    assert.deepEqual(await cotan.decodePng(texture.getImage()), await cotan.decodePng(image));
    await document.transform(transforms.untangent({ from: 'cotangent', to: 'mikktspace' }));
    assert.ok(primitive.getAttribute('TANGENT'));
  },

  // Both doors: the map's green is reversed where its only mesh reverses it; where a second mesh reads the map as declared,
  // with tangents or without, the map stays and the first mesh keeps its tangents.
  async greenIsDecidedByEveryMeshThatShowsTheMap() {
    for (const second of [null, 'tangents', 'none']) {
      const { document, primitive, texture } = await hillsDocument(), io = new NodeIO();
      const flat = (semantic, z) => primitive.getAttribute(semantic).setArray(primitive.getAttribute(semantic).getArray().map((value, i) => (i % 3 === 2 ? z : z === 0 ? value : 0)));
      flat('POSITION', 0); // so that every frame reads the map alike
      flat('NORMAL', 1);
      await document.transform(transforms.tangents());
      const other = primitive.clone();
      const tangent = primitive.getAttribute('TANGENT').clone();
      primitive.setAttribute('TANGENT', tangent.setArray(tangent.getArray().map((value, i) => (i % 4 === 3 ? -value : value))));
      if (second) document.getRoot().listScenes()[0].addChild(document.createNode().setMesh(document.createMesh('second').addPrimitive(other)));
      if (second === 'none') other.setAttribute('TANGENT', null);
      const before = texture.getImage(), model = await io.writeBinary(document), made = await cotan.convert(model);
      let report;
      document.setLogger({ debug() {}, info() {}, warn() {}, error() {} });
      await document.transform(transforms.untangent({ report: (found) => { report = found; } }));
      for (const [door, file, notes] of [['convert', await io.readBinary(made.glb), made.report.notes], ['untangent', document, report.notes]]) {
        const meshes = file.getRoot().listMeshes().map((mesh) => !!mesh.listPrimitives()[0].getAttribute('TANGENT')), [map] = file.getRoot().listTextures();
        const { data } = await cotan.decodePng(map.getImage()), what = `${door}, second: ${second}: ${notes}`;
        if (second) assert.deepEqual(meshes, [true, false], what);
        else assert.deepEqual(meshes, [false], what);
        if (second) assert.deepEqual(Buffer.from(map.getImage()), Buffer.from(before), what);
        else assert.deepEqual([...data.subarray(0, 3)], [166, 255 - 153, 249], what); // 2c - 1 changes its sign
        assert.ok(notes.some((line) => line.includes('bumps') && /reverse (its )?green/.test(line)), what);
      }
    }
  },

  async lintNormalsReportsAndChangesNothing() {
    const { document } = await hillsDocument();
    const before = await new NodeIO().writeBinary(document);
    let found;
    await document.transform(transforms.lintNormals({ report: (report) => { found = report; } }));
    assert.deepEqual(await new NodeIO().writeBinary(document), before);
    assert.equal(found.primitives.length, 1);
    assert.ok(found.recommendation.length > 20);
  },

  // Domes with green down: bumps look like dents.
  async aModelWithGreenReversedFailsTheCheck() {
    for (const up of [true, false]) {
      const { document, texture } = await hillsDocument();
      texture.setImage(await cotan.encodePng(domes(64, up)));
      let found;
      const checked = document.transform(transforms.lintNormals({ limit: 180, report: (report) => { found = report; } }));
      if (up) await checked;
      else await assert.rejects(checked, (error) => error instanceof cotan.CotanError && error.code === 'limit' && /normal map normal.png: green points opposite to what the file says/.test(error.message));
      assert.equal(found.over_limit.length, up ? 0 : 1);
      assert.equal(found.check.passed, up);
      assert.deepEqual(found.check.failures.map(({ kind, text }) => [kind, text]), found.over_limit.map(({ kind, text }) => [kind, text]));
      assert.equal(found.warnings.some((line) => /normal map normal.png: green points opposite to what the file says/.test(line)), !up, found.warnings.join());
      assert.deepEqual(cotan.overLimits(found), []); // without a limit nothing is over it
      assert.ok(cotan.overLimits(found, { limit: 0, frame: 'cotangent' }).length > found.over_limit.length);
    }
    const { document } = await hillsDocument();
    for (const [options, field] of [[{ limit: 200 }, 'options.limit'], [{ limitArea: -1 }, 'options.limitArea'], [{ limit: 1, frame: 'smoth' }, 'options.frame']])
      await assert.rejects(document.transform(transforms.lintNormals(options)), (error) => error.code === 'usage' && error.field === field);
  },

  // 2c - 1 decodes 127.5 as zero, the exact expansion 128: maps for the two differ by half a step.
  async newMapsAreEncodedFor2cMinus1() {
    const found = {};
    for (const unsigned of [undefined, 'biased', 'exact']) {
      const { document, texture } = await hillsDocument();
      await document.transform(transforms.tangents(), transforms.untangent({ to: 'smooth', unsigned }));
      found[unsigned] = [(await cotan.decodePng(texture.getImage())).data, document.getRoot().listMaterials()[0].getExtras()];
    }
    assert.deepEqual(found.undefined, found.biased);
    assert.notDeepEqual(found.exact[0], found.biased[0]);
    assert.deepEqual(found.biased[1], { cotanFrame: 'smooth', cotanUnsigned: 'biased' });
    assert.deepEqual(found.exact[1], { cotanFrame: 'smooth' });
    const { document } = await hillsDocument();
    await assert.rejects(document.transform(transforms.untangent({ unsigned: 'half' })), (error) => error.code === 'usage');
  },

  async materialsNameTheFrameOfTheirMaps() {
    const { document } = await hillsDocument(), [material] = document.getRoot().listMaterials(), { decodePng } = cotan;
    await document.transform(transforms.tangents());
    material.setExtras({ kept: [1, 2] });
    const original = await decodePng(document.getRoot().listTextures()[0].getImage());
    await document.transform(transforms.untangent({ to: 'smooth' }));
    assert.deepEqual(material.getExtras(), { kept: [1, 2], cotanFrame: 'smooth', cotanUnsigned: 'biased' });
    const again = await new NodeIO().readBinary(await new NodeIO().writeBinary(document)); // through a file
    assert.equal(again.getRoot().listMaterials()[0].getExtras().cotanFrame, 'smooth');
    await again.transform(transforms.untangent({ to: 'mikktspace' })); // from the frame that it names
    assert.deepEqual(again.getRoot().listMaterials()[0].getExtras(), { kept: [1, 2], cotanUnsigned: 'biased' });
    const back = await decodePng(again.getRoot().listTextures()[0].getImage());
    const steps = back.data.reduce((most, x, k) => Math.max(most, Math.abs(x - original.data[k])), 0);
    assert.ok(steps <= 3, `${steps} steps of 8 bits there and back`);
  },

  async provokingGivesEachTriangleItsOwnVertex() {
    for (const [vertex, offset] of [['first', 0], ['last', 2]]) {
      const { document, primitive } = await hillsDocument();
      const before = cornersOf(primitive, 'POSITION', 3);
      await document.transform(transforms.provoking({ vertex }));
      primitive.getIndices().getArray().forEach((index, i) => { if (i % 3 === offset) assert.equal(index, (i - offset) / 3); });
      const after = cornersOf(primitive, 'POSITION', 3); // triangles may start with another vertex
      for (let f = 0; f < before.length; f += 9) {
        const key = (array) => [0, 3, 6].map((k) => array.subarray(f + k, f + k + 3).join()).sort().join(' ');
        assert.equal(key(after), key(before));
      }
    }
  },

  async compressedModelsAreReadByTheDecodersOfGltfTransform() {
    if (missing) skip(missing);
    const { ALL_EXTENSIONS } = await from('@gltf-transform/extensions');
    const draco = (await from('draco3dgltf')).default;
    const { MeshoptDecoder, MeshoptEncoder } = await from('meshoptimizer');
    await Promise.all([MeshoptDecoder.ready, MeshoptEncoder.ready]);
    const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
      'draco3d.decoder': await draco.createDecoderModule(), 'draco3d.encoder': await draco.createEncoderModule(),
      'meshopt.decoder': MeshoptDecoder, 'meshopt.encoder': MeshoptEncoder,
    });
    for (const file of filesUnder(path.join(data, 'compressed')).filter((name) => name.endsWith('.glb'))) {
      const document = await io.read(file), messages = [];
      const keep = (text) => messages.push(text);
      document.setLogger({ debug: keep, info: keep, warn: keep, error: keep });
      const used = document.getRoot().listExtensionsUsed().map((extension) => extension.extensionName).sort();
      let report;
      await document.transform(transforms.lintNormals());
      if (!used.includes('KHR_texture_basisu')) { // whose map of 4096 x 4096 takes minutes; ktx2MapsStayKtx2 has smaller ones
        await document.transform(transforms.untangent({ mode: 'convert', report: (found) => { report = found; } }));
        for (const mesh of document.getRoot().listMeshes())
          for (const primitive of mesh.listPrimitives()) assert.ok(!primitive.getAttribute('TANGENT'), file);
      }
      assert.deepEqual(document.getRoot().listExtensionsUsed().map((extension) => extension.extensionName).sort(), used);
      assert.ok((await io.writeBinary(document)).length > 1000);
      if (report) console.log(`${path.basename(file)}: ${used.join(' ')}: ${report.maps.filter((map) => !map.kept).length} of ${report.maps.length} maps remade`);
    }
  },

  async ktx2MapsAreReportedWithAdvice() {
    const file = path.join(data, 'compressed/jet_fighter_draco_basisu.glb');
    if (!fs.existsSync(file)) skip(`${path.basename(file)} is not there: run scripts/test-data`);
    if (!hasZstandard(file)) skip('its KTX2 is not packed with Zstandard, and is read');
    const { ALL_EXTENSIONS } = await from('@gltf-transform/extensions');
    const io = new NodeIO().registerExtensions(ALL_EXTENSIONS)
      .registerDependencies({ 'draco3d.decoder': await (await from('draco3dgltf')).default.createDecoderModule() });
    const document = await io.read(file), warnings = [];
    document.setLogger({ debug() {}, info() {}, warn: (text) => warnings.push(text), error() {} });
    const normalMaps = new Set(document.getRoot().listMaterials().map((material) => material.getNormalTexture()).filter(Boolean));
    const before = [...normalMaps].map((texture) => texture.getImage());
    assert.ok([...normalMaps].every((texture) => texture.getMimeType() === 'image/ktx2') && normalMaps.size > 0);
    let report;
    await document.transform(transforms.untangent({ mode: 'convert', report: (found) => { report = found; } }));
    assert.equal(report.unread_maps.length, normalMaps.size);
    for (const { image, name, format, advice } of report.unread_maps) {
      assert.equal(document.getRoot().listTextures()[image].getMimeType(), 'image/ktx2');
      assert.equal(format, 'KTX2 with Zstandard');
      assert.match(advice, /gltf-transform ktxdecompress/);
      assert.ok(warnings.some((text) => text.startsWith('untangent: ') && text.includes(name) && text.includes(format) && text.includes(advice)), warnings.join('\n'));
    }
    assert.deepEqual([...normalMaps].map((texture) => texture.getImage()), before);
  },

  // A model of 1.79 MB once became 8.7 MB, with maps as PNG for a frame that nobody requested.
  async untangentDropsTangentsAndNoFileGrows() {
    if (missing) skip(missing);
    const { ALL_EXTENSIONS } = await from('@gltf-transform/extensions');
    const draco = (await from('draco3dgltf')).default;
    const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({ 'draco3d.decoder': await draco.createDecoderModule(), 'draco3d.encoder': await draco.createEncoderModule() });
    // Tangents of the second and third reverse green. New JPEG maps of the second would lose too much, and PNG is larger;
    // KTX2 maps are not judged. Nothing of either is changed then.
    for (const [file, mode] of [['models/ClearCoatTest/ClearCoatTest.glb', 'drop'], ['compressed/chess_board_draco.glb', 'keep'], ['compressed/jet_fighter_draco_basisu.glb', 'keep']]) {
      const document = await io.read(path.join(data, file)), plain = (await io.writeBinary(document)).length;
      document.setLogger({ debug() {}, info() {}, warn() {}, error() {} });
      const images = document.getRoot().listTextures().map((texture) => texture.getImage()), types = document.getRoot().listTextures().map((texture) => texture.getMimeType());
      let report;
      await document.transform(transforms.untangent({ report: (found) => { report = found; } }));
      const size = (await io.writeBinary(document)).length, has = document.getRoot().listMeshes().some((mesh) => mesh.listPrimitives().some((primitive) => primitive.getAttribute('TANGENT')));
      console.log(`${file}: ${fs.statSync(path.join(data, file)).size} bytes, ${plain} written again, ${size} after; ${report.mode} ${JSON.stringify(report.bytes)} ${report.notes}`);
      assert.equal(report.mode, mode, `${file}: ${report.notes}`);
      assert.ok(size <= 1.02 * plain, `${file}: ${size} bytes of ${plain}`);
      assert.ok(has, file); // a coat of the first one requires them: notes say so
      assert.equal(report.notes.some((line) => /glTF requires TANGENT for KHR_materials_clearcoat/.test(line)), mode === 'drop', report.notes.join());
      assert.deepEqual(document.getRoot().listTextures().map((texture) => texture.getMimeType()), types, file);
      assert.deepEqual(document.getRoot().listTextures().map((texture) => texture.getImage()), images, file);
      if (mode === 'keep') assert.ok(report.notes.some((line) => /: maps and tangents are kept|KTX2 with Zstandard/.test(line)), report.notes.join());
      assert.ok(report.bytes.after <= report.bytes.before, file);
    }
  },

  async unknownOptionsAreRefusedAtOnce() {
    for (const [work, field] of [[() => transforms.untangent({ too: 'smooth' }), 'options.too'], [() => transforms.untangent({ mode: 'all' }), 'options.mode'], [() => transforms.tangents({ kind: 'smooth' }), 'options.kind'],
      [() => transforms.provoking({ vertex: 'middle' }), 'options.vertex'], [() => transforms.lintNormals({ limits: 1 }), 'options.limits']])
      assert.throws(work, (error) => error instanceof cotan.CotanError && error.code === 'usage' && error.field === field);
  },

  async gltfTransformRunsOurCommands() {
    const program = path.join(modules, '@gltf-transform/cli/bin/cli.js');
    if (!fs.existsSync(program)) skip('@gltf-transform/cli is not installed');
    const io = new NodeIO(), file = (name) => path.join(folder, name), { document, mesh } = await hillsDocument();
    await io.write(file('in.glb'), document);
    const run = (...words) => {
      const { status, stdout, stderr } = spawnSync(process.execPath, [program, ...words, '--config', 'node_modules/cotan/gltf-transform/config.mjs'],
        { cwd: folder, encoding: 'utf8', env: { ...process.env, NO_COLOR: '1' } });
      assert.equal(status, 0, `${words.join(' ')}: ${stdout}${stderr}`);
      return stdout + stderr;
    };
    const primitiveOf = async (name) => (await io.read(file(name))).getRoot().listMeshes()[0].listPrimitives()[0];
    run('cotan-tangents', 'in.glb', 'tangents.glb');
    assert.deepEqual(cornersOf(await primitiveOf('tangents.glb'), 'TANGENT', 4), cotan.tangents(mesh));
    run('cotan-tangents', 'tangents.glb', 'vertex.glb', '--kind', 'vertex', '--overwrite', 'true');
    assert.deepEqual(cornersOf(await primitiveOf('vertex.glb'), 'TANGENT', 4), cotan.tangents(mesh, { kind: 'vertex' }));

    run('untangent', 'tangents.glb', 'free.glb', '--to', 'cotangent');
    const ours = await io.read(file('tangents.glb'));
    await ours.transform(transforms.untangent({ to: 'cotangent' }));
    assert.equal((await primitiveOf('free.glb')).getAttribute('TANGENT'), null);
    const [map, expected] = [await io.read(file('free.glb')), ours].map((d) => d.getRoot().listTextures()[0].getImage());
    assert.deepEqual(await cotan.decodePng(map), await cotan.decodePng(expected));

    run('provoking', 'in.glb', 'last.glb', '--vertex', 'last');
    (await primitiveOf('last.glb')).getIndices().getArray().forEach((index, i) => { if (i % 3 === 2) assert.equal(index, (i - 2) / 3); });
    const { recommendation } = await cotan.lint(fs.readFileSync(file('in.glb')));
    assert.ok(run('lint-normals', 'in.glb').includes(recommendation.split('\n')[0]));
    assert.match(run('--help'), /untangent/);
  },

  async checkCommandHasALimitAReportAndAnExitCode() {
    const program = path.join(modules, '@gltf-transform/cli/bin/cli.js');
    if (!fs.existsSync(program)) skip('@gltf-transform/cli is not installed');
    const file = (name) => path.join(folder, name), { document, texture } = await hillsDocument();
    await new NodeIO().write(file('right.glb'), document);
    texture.setImage(await cotan.encodePng(domes(64, false)));
    await new NodeIO().write(file('down.glb'), document);
    const run = (...words) => {
      const { status, stdout, stderr } = spawnSync(process.execPath, [program, 'lint-normals', ...words, '--config', 'node_modules/cotan/gltf-transform/config.mjs'],
        { cwd: folder, encoding: 'utf8', env: { ...process.env, NO_COLOR: '1' } });
      return { status, stdout, stderr };
    };
    assert.equal(run('right.glb', '--limit', '90').status, 0);
    assert.equal(run('down.glb').status, 0); // no limit, no check
    const tight = run('right.glb', '--limit', '0', '--frame', 'cotangent', '--json', 'report.json');
    assert.equal(tight.status, 5, tight.stdout + tight.stderr);
    assert.match(tight.stderr, /lint-normals: hills.*: 95th percentile of the error with cotangent .* degrees, limit 0/);
    const report = JSON.parse(fs.readFileSync(file('report.json')));
    assert.deepEqual(report.over_limit, (await cotan.lint(fs.readFileSync(file('right.glb')), { limit: 0, frame: 'cotangent' })).over_limit);
    assert.equal(report.command, 'lint-normals');
    const down = run('down.glb', '--limit', '90');
    assert.equal(down.status, 5);
    assert.match(down.stderr, /green points opposite to what the file says/);
    assert.equal(run('right.glb', '--limit', '200').status, 1);
  },

  // EXT_texture_webp in the package itself and in the plug-in: read, judged, and written as WebP if all readers must read it
  // and nothing visible is lost.
  async webpMapsAreReadAndStayWebp() {
    const sharp = await sharpOrSkip(), { EXTTextureWebP } = await from('@gltf-transform/extensions'), { default: validator } = await from('gltf-validator');
    const io = new NodeIO().registerExtensions([EXTTextureWebP]);
    const judged = ({ maps, fits, primitives, recommendation }) => JSON.stringify({ maps: maps.map(({ name, ...rest }) => rest), fits: fits.map(({ name, ...rest }) => rest), primitives, recommendation });
    for (const [how, options, isRequired] of [['lossless', { lossless: true }, true], ['lossy', { quality: 95 }, true], ['with a fallback', { lossless: true }, false]]) {
      const { document, texture } = await hillsDocument(), plain = await hillsDocument();
      for (const one of [texture, plain.texture]) one.setImage(await cotan.encodePng(how === 'lossy' ? waves(256) : domes(64, true)));
      await document.transform(transforms.tangents());
      await plain.document.transform(transforms.tangents());
      document.createExtension(EXTTextureWebP).setRequired(true);
      texture.setImage(new Uint8Array(await sharp(texture.getImage()).webp(options).toBuffer())).setMimeType('image/webp');
      let model = await io.writeBinary(document);
      if (!isRequired) model = withFallback(model);
      const report = await cotan.lint(model), png = await cotan.lint(await io.writeBinary(plain.document));
      assert.deepEqual(report.primitives.map((p) => p.not_judged), [''], how);
      if (how !== 'lossy') assert.equal(judged(report), judged(png), how);
      assert.equal((await cotan.convert(model)).report.mode, 'drop', how);
      const { glb, report: made } = await cotan.convert(model, { mode: 'convert' }), { json } = parseGlb(glb), [texel] = json.textures, used = json.extensionsUsed ?? [], required = json.extensionsRequired ?? [];
      assert.deepEqual(made.unread_maps, [], how);
      assert.equal(made.maps[0].kept, false, how);
      const isWebp = how === 'lossless', image = isWebp ? texel.extensions.EXT_texture_webp.source : texel.source;
      assert.equal(json.images[image].mimeType, isWebp ? 'image/webp' : 'image/png', how);
      assert.deepEqual([used.includes('EXT_texture_webp'), required.includes('EXT_texture_webp'), texel.source === undefined], [isWebp, isWebp, isWebp], how);
      assert.equal(made.maps[0].format, isWebp ? 'WebP' : 'PNG', how);
      assert.equal(made.notes.some((line) => /does not require its readers to support WebP/.test(line)), !isRequired, `${how}: ${made.notes}`);
      assert.equal(made.notes.some((line) => /WebP of quality 90 would have an error of [\d.]+ degrees/.test(line)), how === 'lossy', `${how}: ${made.notes}`);
      assert.deepEqual((await validator.validateBytes(glb)).issues.messages.filter(({ severity }) => severity === 0), [], how);
      // The same texels as of the PNG, but for losses.
      const file = imageOf({ json, bin: glb.subarray(28 + new DataView(glb.buffer).getUint32(12, true)) }, image), fromPng = await cotan.convert(await io.writeBinary(plain.document), { mode: 'convert' });
      const expected = await cotan.decodePng(imageOf(parseGlb(fromPng.glb), 0)), found = await cotan.decodeImage(file), degrees = degreesBetween(found, expected);
      console.log(`${how}: ${made.maps[0].format} of ${made.maps[0].bytes_after} bytes, ${made.maps[0].degrees_of_encoding.toFixed(3)} degrees said, ${degrees.toFixed(3)} found`);
      if (how !== 'lossy') assert.ok(degrees < 1e-5, how); // the same texels, but for rounding of the cosine
      assert.ok(degrees < 1, how);
      // The plug-in makes the same file of the map.
      if (isRequired) {
        await document.transform(transforms.lintNormals(), transforms.untangent({ mode: 'convert' }));
        assert.equal(texture.getMimeType(), isWebp ? 'image/webp' : 'image/png', how);
        assert.deepEqual([...texture.getImage()], [...file], how);
      }
    }
  },

  async ktx2MapsStayKtx2() {
    const { KHRTextureBasisu } = await from('@gltf-transform/extensions'), { default: validator } = await from('gltf-validator'), { ready, texture: made } = await load(folder, 'textures');
    await ready;
    const io = new NodeIO().registerExtensions([KHRTextureBasisu]), judge = await transcoder(modules), relief = domes(64, true);
    const { document, texture } = await hillsDocument(), plain = await hillsDocument();
    texture.setImage(made(relief, { from: 'gltf,biased', compress: 'uastc' }).bytes).setMimeType('image/ktx2');
    plain.texture.setImage(await cotan.encodePng({ ...texelsOf(judge, texture.getImage()), bits: 8 }));
    for (const one of [document, plain.document]) await one.transform(transforms.tangents());
    document.createExtension(KHRTextureBasisu).setRequired(true);
    const model = await io.writeBinary(document), expected = await cotan.decodePng(imageOf(parseGlb((await cotan.convert(await io.writeBinary(plain.document), { mode: 'convert' })).glb), 0));
    const { glb, report } = await cotan.convert(model, { mode: 'convert', texture: made }), parsed = parseGlb(glb), [map] = report.maps, file = imageOf(parsed, 0);
    assert.deepEqual(parsed.json.textures.map(({ source, extensions }) => [source, extensions.KHR_texture_basisu.source]), [[undefined, 0]]);
    assert.deepEqual([parsed.json.images[0].mimeType, parsed.json.extensionsRequired, map.format], ['image/ktx2', ['KHR_texture_basisu'], 'KTX2 with uastc']);
    assert.deepEqual((await validator.validateBytes(glb)).issues.messages.filter(({ severity }) => severity === 0), []);
    const degrees = degreesBetween({ ...texelsOf(judge, file), bits: 8 }, expected);
    console.log(`uastc: ${map.degrees_of_encoding.toFixed(3)} degrees said, ${degrees.toFixed(3)} found by another decoder`);
    assert.ok(Math.abs(degrees - map.degrees_of_encoding) < 0.02 && degrees < 0.5 && degrees > 0.001);
    assert.ok(report.notes.some((line) => /bumps: stays KTX2 with uastc, which has an error of 0\.\d\d degrees/.test(line)), report.notes.join());
    assert.equal(new DataView(file.buffer, file.byteOffset).getUint32(40, true), 7, 'all levels, as before');
    // The transform makes the same file. Without the encoder, or where readers may lack KTX2, the map becomes PNG and a note says why.
    let said;
    await document.transform(transforms.untangent({ mode: 'convert', report: (found) => { said = found; } }));
    assert.deepEqual([texture.getMimeType(), said.maps[0].format, said.notes], ['image/ktx2', 'KTX2 with uastc', report.notes]);
    assert.ok(Buffer.from(texture.getImage()).equals(file));
    for (const [given, options, why] of [[model, {}, /KTX2 is written by options\.texture/], [withFallback(model, 'KHR_texture_basisu'), { texture: made }, /does not require its readers to support KTX2/]]) {
      const { report: { maps: [other], notes } } = await cotan.convert(given, { mode: 'convert', ...options });
      assert.deepEqual([other.format, notes.filter((line) => why.test(line)).length], ['PNG', 1], notes.join());
    }
    // Green alone.
    const { document: reversed, texture: down } = await hillsDocument();
    down.setImage(made(domes(64, false), { from: 'gltf,biased', compress: 'uastc' }).bytes).setMimeType('image/ktx2');
    reversed.createExtension(KHRTextureBasisu).setRequired(true);
    const fixed = await cotan.convert(await io.writeBinary(reversed), { fixGreen: true, texture: made });
    assert.deepEqual(fixed.report.green_fixed, ['bumps']);
    const was = degreesBetween({ ...texelsOf(judge, made(relief, { from: 'gltf,biased', compress: 'uastc' }).bytes), bits: 8 }, relief);
    const is = degreesBetween({ ...texelsOf(judge, imageOf(parseGlb(fixed.glb), 0)), bits: 8 }, relief);
    console.log(`green reversed: ${is.toFixed(3)} degrees from the relief, ${was.toFixed(3)} encoded once`);
    assert.ok(is < 1.5 * was, 'nearly as exact as blocks of the right map');
  },

  // Chroma at half the resolution cost 3.6 degrees, which no report said.
  async lossesOfAnEncoderAreMeasuredAndVisibleOnesAvoided() {
    const sharp = await sharpOrSkip(), found = {};
    const cases = [['4:2:0', (up) => domes(64, up), { quality: 80, chromaSubsampling: '4:2:0' }], ['4:4:4', () => waves(256), { quality: 97, chromaSubsampling: '4:4:4' }]];
    for (const [how, relief, options] of cases)
      for (const door of how === '4:2:0' ? ['convert', 'untangent', 'fixGreen'] : ['convert', 'untangent']) {
        const { document, texture } = await hillsDocument();
        texture.setImage(new Uint8Array(await sharp(await cotan.encodePng(relief(door !== 'fixGreen'))).jpeg(options).toBuffer())).setMimeType('image/jpeg');
        await document.transform(transforms.tangents());
        const model = await new NodeIO().writeBinary(document);
        let report, file;
        if (door === 'untangent') {
          await document.transform(transforms.untangent({ mode: 'convert', report: (one) => { report = one; } }));
          file = texture.getImage();
        } else {
          const made = await cotan.convert(model, door === 'fixGreen' ? { mode: 'drop', fixGreen: true } : { mode: 'convert' });
          report = made.report;
          file = imageOf(parseGlb(made.glb), 0);
        }
        const isPng = file[0] === 0x89, where = `${how}, ${door}`;
        found[where] = isPng;
        if (door === 'fixGreen') assert.deepEqual(report.green_fixed, ['bumps'], where);
        assert.equal(report.notes.some((line) => /JPEG of quality \d+ would have an error of [\d.]+ degrees on average, so the new map is PNG/.test(line)), isPng, `${where}: ${report.notes}`);
        if (door === 'fixGreen') continue;
        const [map] = report.maps;
        assert.equal(map.format, isPng ? 'PNG' : 'JPEG', where);
        // The same map without losses, from the library; the degrees between the two by arithmetic of this test.
        const whole = await cotan.convert(model, { mode: 'convert', bits: 16 }), exact = await cotan.decodePng(imageOf(parseGlb(whole.glb), 0));
        const degrees = degreesBetween(await cotan.decodeImage(file), exact);
        console.log(`${where}: ${map.format}, ${map.degrees_of_encoding.toFixed(2)} degrees said, ${degrees.toFixed(2)} found; ${report.notes.find((line) => /would have/.test(line)) ?? ''}`);
        assert.ok(Math.abs(map.degrees_of_encoding - degrees) < 0.25, where); // rounding to 8 bits
        assert.ok(degrees < 0.75, where);
      }
    assert.deepEqual(found, { '4:2:0, convert': true, '4:2:0, untangent': true, '4:2:0, fixGreen': true, '4:4:4, convert': false, '4:4:4, untangent': false });
  },

  // An encoder of the caller may lose something, make another image or none at all.
  async anEncoderOfTheCallerIsChecked() {
    const { document } = await hillsDocument();
    await document.transform(transforms.tangents());
    const model = await new NodeIO().writeBinary(document), converted = (encode) => cotan.convert(model, { mode: 'convert', encode });
    const lossless = await converted(async (picture) => cotan.encodePng(picture)), darker = await converted((picture) => cotan.encodePng({ ...picture, data: picture.data.map((value, i) => (i % 4 === 0 ? value - 8 : value)) }));
    assert.equal(lossless.report.maps[0].degrees_of_encoding, 0);
    const { degrees_of_encoding: said } = darker.report.maps[0];
    assert.ok(said > 2 && said < 4, `${said} degrees for 8 of 255 steps in x`); // atan(8 / 127.5) is 3.6 degrees
    for (const [encode, words] of [[async () => new Uint8Array([0xff, 0xd8, 0xff]), /expected a PNG file, found other data/], [async () => 'text', /expected bytes/],
      [() => cotan.encodePng({ width: 1, height: 1, data: new Uint8Array(4) }), /expected an image of 32 x 32, found 1 x 1/],
      [async (picture) => (await cotan.encodePng(picture)).subarray(0, 60), /options\.encode: PNG/]])
      await assert.rejects(converted(encode), (error) => error instanceof cotan.CotanError && error.code === 'usage' && words.test(error.message));
  },

  // glTF requires TANGENT where a material needs a tangent space and has no normal map to derive it with.
  async conversionsMakeNoNewErrorsOfTheValidator() {
    if (!fs.existsSync(data)) skip(`${data} is not here`);
    const { ALL_EXTENSIONS } = await from('@gltf-transform/extensions'), { default: validator } = await from('gltf-validator'), draco = (await from('draco3dgltf')).default;
    const { MeshoptDecoder, MeshoptEncoder } = await from('meshoptimizer');
    await Promise.all([MeshoptDecoder.ready, MeshoptEncoder.ready]);
    const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({ 'draco3d.decoder': await draco.createDecoderModule(), 'draco3d.encoder': await draco.createEncoderModule(),
      'meshopt.decoder': MeshoptDecoder, 'meshopt.encoder': MeshoptEncoder });
    let count = 0, kept = 0;
    for (const file of ['models', 'materials', 'animated', 'compressed'].flatMap((name) => filesUnder(path.join(data, name))).filter((name) => /\.(glb|gltf)$/.test(name))) {
      const model = new Uint8Array(fs.readFileSync(file)), beside = (uri) => new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri)))), files = {};
      const errorsOf = async (bytes) => new Set((await validator.validateBytes(bytes, { maxIssues: 0, externalResourceFunction: async (uri) => beside(uri) })).issues.messages.filter(({ severity }) => severity === 0).map(({ code }) => code));
      const { json } = file.endsWith('.glb') ? parseGlb(model) : { json: JSON.parse(new TextDecoder().decode(model)) }, known = await errorsOf(model);
      for (const { uri } of [...json.buffers ?? [], ...json.images ?? []]) if (uri && !uri.startsWith('data:')) files[uri] = beside(uri);
      const check = async (door, bytes) => {
        ++count;
        kept += JSON.stringify(parseGlb(bytes).json.meshes).includes('TANGENT');
        const fresh = [...await errorsOf(bytes)].filter((code) => !known.has(code));
        assert.deepEqual(fresh, [], `${file}, ${door}`);
      };
      // Maps of 2048 x 2048 take long to convert; their tangents are dropped in the same way.
      const modes = Object.values(files).concat(model).some((bytes) => bytes.length > 5e5) ? ['drop'] : ['drop', 'convert'];
      for (const mode of modes) {
        const made = await cotan.convert(model, { mode, files }).catch((error) => assert.match(error.message, /compression/));
        if (made) await check(`convert, ${mode}`, made.glb);
        const document = await io.read(file);
        document.setLogger({ debug() {}, info() {}, warn() {}, error() {} });
        await document.transform(transforms.untangent({ mode }));
        await check(`untangent, ${mode}`, await io.writeBinary(document));
      }
    }
    console.log(`${count} files, ${kept} with tangents`);
    assert.ok(count > 40 && kept >= 4);
  },

  async newMapsKeepTheFormatOfTheOldOnes() {
    const sharp = await sharpOrSkip(), { EXTTextureWebP } = await from('@gltf-transform/extensions');
    const { document, texture } = await hillsDocument();
    const plain = texture.getImage();
    document.createExtension(EXTTextureWebP).setRequired(true);
    texture.setImage(new Uint8Array(await sharp(plain).webp({ lossless: true }).toBuffer())).setMimeType('image/webp');
    await document.transform(transforms.untangent({ mode: 'convert' }));
    const other = await hillsDocument();
    await other.document.transform(transforms.untangent({ mode: 'convert' }));
    assert.equal(texture.getMimeType(), 'image/webp'); // lossless like the original
    const texels = await cotan.decodeImage(texture.getImage()), expected = await cotan.decodePng(other.texture.getImage());
    assert.deepEqual([...texels.data], [...expected.data]);
    const jpeg = await hillsDocument(), png = await hillsDocument();
    png.texture.setImage(await cotan.encodePng(waves(256)));
    jpeg.texture.setImage(new Uint8Array(await sharp(png.texture.getImage()).jpeg({ quality: 97, chromaSubsampling: '4:4:4' }).toBuffer())).setMimeType('image/jpeg');
    const before = jpeg.texture.getImage().length;
    for (const one of [jpeg, png]) await one.document.transform(transforms.untangent({ mode: 'convert' }));
    assert.equal(jpeg.texture.getMimeType(), 'image/jpeg');
    const { data } = await cotan.decodeImage(jpeg.texture.getImage()), wanted = (await cotan.decodePng(png.texture.getImage())).data;
    const steps = data.reduce((most, value, k) => Math.max(most, Math.abs(value - wanted[k])), 0);
    assert.ok(steps <= 8 && jpeg.texture.getImage().length < 1.5 * before, `${steps} steps, ${jpeg.texture.getImage().length} bytes for ${before}`);
  },
};
await runCases(cases, only);
