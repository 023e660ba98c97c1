// Completes the data that make.py wrote: tangents by npm's mikktspace, compression, and what comes from packages.
//   node finish.mjs NODE_MODULES FOLDER [ASSIMP]
// ASSIMP: the models of Debian's assimp-testmodels.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [modules, folder, assimp] = process.argv.slice(2);
const require = createRequire(path.join(path.resolve(modules), 'x.js'));
const from = (name) => import(pathToFileURL(path.join(path.resolve(modules), name)).href);
const { NodeIO, VertexLayout } = await from('@gltf-transform/core/dist/index.js');
const { ALL_EXTENSIONS, EXTMeshoptCompression, KHRDracoMeshCompression, KHRTextureBasisu } = await from('@gltf-transform/extensions/dist/index.js');
const { meshopt, unweld, weld } = await from('@gltf-transform/functions/dist/index.js');
const { MeshoptDecoder, MeshoptEncoder, MeshoptSimplifier } = await from('meshoptimizer/index.js');
const draco = require('draco3dgltf'), jpeg = require('jpeg-js'), mikktspace = require('mikktspace');
const { decode } = await from('fast-png/lib/index.js');
await Promise.all([MeshoptDecoder.ready, MeshoptEncoder.ready, MeshoptSimplifier.ready]);
const decoders = await draco.createDecoderModule();
const io = new NodeIO().setVertexLayout(VertexLayout.SEPARATE).registerExtensions(ALL_EXTENSIONS).registerDependencies({
  'draco3d.decoder': decoders, 'draco3d.encoder': await draco.createEncoderModule(),
  'meshopt.decoder': MeshoptDecoder, 'meshopt.encoder': MeshoptEncoder,
});
const at = (name) => path.join(folder, name);

// ---- tangents ----

// One tangent for each corner, of arrays without indices; w in the sense of glTF if v points down.
function cornerTangents(positions, normals, uvs) {
  const tangents = mikktspace.generateTangents(positions, normals, uvs).slice();
  for (let k = 3; k < tangents.length; k += 4) tangents[k] *= -1;
  return tangents;
}

function rotate(tangent, normal, degrees) {
  const [c, s] = [Math.cos(degrees * Math.PI / 180), Math.sin(degrees * Math.PI / 180)], [x, y, z] = normal, [a, b, d] = tangent;
  return [a * c + (y * d - z * b) * s, b * c + (z * a - x * d) * s, d * c + (x * b - y * a) * s, tangent[3]];
}

// What is wrong with the tangents of a file, by the word of its job; by default nothing is.
function faulty(kind, tangent, { index, normal, position }) {
  if (kind === 'inverted') return [...tangent.slice(0, 3), -tangent[3]];
  if (kind.startsWith('inverted below ')) return position[1] < Number(kind.split(' ')[2]) ? [...tangent.slice(0, 3), -tangent[3]] : tangent;
  if (kind === 'half reversed') return normal[0] + normal[1] + normal[2] > 0 ? tangent.map((x, k) => (k < 3 ? -x : x)) : tangent;
  if (kind === 'rotated') return rotate(tangent, normal, index % 64 === 0 ? 9 : 0.35); // by angles that tests expect
  return tangent;
}

async function addTangents(document, kind, only) {
  await document.transform(unweld());
  for (const mesh of document.getRoot().listMeshes())
    for (const primitive of mesh.listPrimitives()) {
      const [position, normal, uv] = ['POSITION', 'NORMAL', 'TEXCOORD_0'].map((name) => primitive.getAttribute(name));
      if (!position || !normal || !uv || !new RegExp(only ?? '').test(mesh.getName())) continue;
      const made = cornerTangents(position.getArray(), normal.getArray(), uv.getArray());
      const accessor = document.createAccessor().setType('VEC4').setArray(made).setBuffer(document.getRoot().listBuffers()[0]);
      for (let index = 0; index < accessor.getCount(); ++index)
        accessor.setElement(index, faulty(kind, accessor.getElement(index, []),
          { index, normal: normal.getElement(index, []), position: position.getElement(index, []) }));
      primitive.setAttribute('TANGENT', accessor);
    }
  await document.transform(weld());
}

// ---- images and compression ----

function rgba(png) {
  const { width, height, channels, data } = decode(png), out = new Uint8Array(4 * width * height).fill(255);
  for (let k = 0; k < width * height; ++k) for (let c = 0; c < channels; ++c) out[4 * k + c] = data[channels * k + c];
  return { width, height, data: out };
}

async function recode(document, kind) {
  for (const texture of document.getRoot().listTextures()) {
    const png = texture.getImage();
    if (kind === 'jpeg') texture.setImage(new Uint8Array(jpeg.encode(rgba(png), 95).data)).setMimeType('image/jpeg');
    else {
      const { encodeToKTX2 } = await from('ktx2-encoder/dist/node/index.js');
      texture.setImage(await encodeToKTX2(png, { isUASTC: true, isPerceptual: false, imageDecoder: async () => rgba(png) })).setMimeType('image/ktx2');
    }
  }
  if (kind === 'ktx2') document.createExtension(KHRTextureBasisu).setRequired(true);
}

for (const job of JSON.parse(fs.readFileSync(at('unfinished/jobs.json')))) {
  const document = await io.read(at(`unfinished/${job.file}`));
  document.getRoot().getAsset().generator = 'scripts/test-data';
  if (job.tangents) await addTangents(document, job.tangents, job.only);
  if (job.images) await recode(document, job.images);
  if (job.compress === 'draco')
    document.createExtension(KHRDracoMeshCompression).setRequired(true)
      .setEncoderOptions({ quantizationBits: { POSITION: 16, NORMAL: 14, TEX_COORD: 16, GENERIC: 16 } });
  if (job.compress === 'meshopt') {
    await document.transform(meshopt({ encoder: MeshoptEncoder, level: 'medium' }));
    document.createExtension(EXTMeshoptCompression).setRequired(true);
  }
  fs.mkdirSync(at(path.dirname(job.file)), { recursive: true });
  for (const texture of document.getRoot().listTextures())
    if (job.file.endsWith('.gltf')) fs.mkdirSync(path.dirname(at(path.join(path.dirname(job.file), texture.getURI()))), { recursive: true });
  await io.write(at(job.file), document);
}

// ---- from packages ----

if (assimp) { // the geometry and maps of Khronos, with MikkTSpace tangents
  const document = await io.read(path.join(assimp, 'glTF2/ClearCoat-glTF/ClearCoatTest.gltf'));
  await addTangents(document, 'mikktspace');
  fs.mkdirSync(at('models/ClearCoatTest'), { recursive: true });
  await io.write(at('models/ClearCoatTest/ClearCoatTest.glb'), document);
}

// The bytes of a file that @pmndrs/assets has as a data URI in a module.
async function asset(name) {
  return Buffer.from((await from(`@pmndrs/assets/${name}.js`)).default.split('base64,')[1], 'base64');
}
fs.mkdirSync(at('environments'), { recursive: true });
fs.writeFileSync(at('environments/studio.exr'), await asset('hdri/studio.exr'));
// Maps of photographed surfaces. How it is known: the correlation between the changes of one slope and the other, which
// is 1 for a relief and -1 with green reversed.
for (const [name, green, curl] of [['0001', '+Y', 0.60], ['0003', '+Y', 0.58], ['0008', '+Y', 0.78], ['0015', '+Y', 0.59], ['0026', '+Y', 0.65],
  ['0028', '+Y', 0.67], ['0002', '-Y', -0.46], ['0021', '-Y', -0.48]]) {
  fs.writeFileSync(at(`textures/pmndrs_${name}.webp`), await asset(`normals/${name}.webp`));
  fs.appendFileSync(at('textures/CONVENTIONS.tsv'), `pmndrs_${name}.webp\t${green}\tcurl test ${curl}\n`);
}

// ---- the bunny: a scan, and a simplified mesh with charts ----

async function decodeDraco(file) {
  const decoders = await require('draco3d').createDecoderModule(); // that of glTF knows fewer kinds of streams
  const bytes = fs.readFileSync(file), buffer = new decoders.DecoderBuffer(), decoder = new decoders.Decoder(), mesh = new decoders.Mesh();
  buffer.Init(new Int8Array(bytes), bytes.length);
  decoder.DecodeBufferToMesh(buffer, mesh);
  const points = new decoders.DracoFloat32Array(), face = new decoders.DracoInt32Array();
  decoder.GetAttributeFloatForAllPoints(mesh, decoder.GetAttribute(mesh, decoder.GetAttributeId(mesh, decoders.POSITION)), points);
  const indices = [];
  for (let k = 0; k < mesh.num_faces(); ++k) {
    decoder.GetFaceFromMesh(mesh, k, face);
    indices.push(face.GetValue(0), face.GetValue(1), face.GetValue(2));
  }
  return { positions: Float32Array.from({ length: 3 * mesh.num_points() }, (_, k) => points.GetValue(k)), indices: Uint32Array.from(indices) };
}

// Normals of vertices, averaged by the area of the triangles around each position.
function smoothNormals(positions, indices) {
  const sums = new Map(), key = (i) => positions.subarray(3 * i, 3 * i + 3).join();
  for (let k = 0; k < indices.length; k += 3) {
    const [a, b, c] = [0, 1, 2].map((j) => positions.subarray(3 * indices[k + j], 3 * indices[k + j] + 3));
    const [e, f] = [b, c].map((p) => [0, 1, 2].map((j) => p[j] - a[j]));
    const n = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
    for (const j of [0, 1, 2]) {
      const sum = sums.get(key(indices[k + j])) ?? [0, 0, 0];
      sums.set(key(indices[k + j]), sum.map((x, i) => x + n[i]));
    }
  }
  return Float32Array.from({ length: positions.length }, (_, k) => {
    const sum = sums.get(key(Math.floor(k / 3))) ?? [0, 0, 1];
    return sum[k % 3] / Math.hypot(...sum);
  });
}

function obj({ positions, normals, uvs, indices }) {
  const rows = (word, array, n) => Array.from({ length: array.length / n }, (_, i) => `${word} ${array.subarray(n * i, n * i + n).join(' ')}`);
  const corner = (i) => `${i + 1}/${uvs ? i + 1 : ''}/${i + 1}`;
  return [...rows('v', positions, 3), ...(uvs ? rows('vt', uvs, 2) : []), ...rows('vn', normals, 3),
    ...Array.from({ length: indices.length / 3 }, (_, f) => `f ${[0, 1, 2].map((k) => corner(indices[3 * f + k])).join(' ')}`), ''].join('\n');
}

const watlas = await from('watlas/dist/watlas.js');
await watlas.Initialize();
fs.mkdirSync(at('bake/bunny'), { recursive: true });
const high = await decodeDraco(path.join(modules, 'draco3d/bunny.drc'));
fs.writeFileSync(at('bake/bunny/bunny_high.obj'), obj({ ...high, normals: smoothNormals(high.positions, high.indices) }));
const [simple] = MeshoptSimplifier.simplify(high.indices, high.positions, 3, 3 * 1500, 0.05);
const atlas = new watlas.Atlas();
atlas.addMesh({ vertexCount: high.positions.length / 3, vertexPositionData: high.positions, vertexPositionStride: 12, indexCount: simple.length, indexData: simple });
atlas.generate({}, { padding: 4, resolution: 512 });
const charted = atlas.getMesh(0), lowIndices = new Uint32Array(charted.indexCount);
charted.getIndexArray(lowIndices);
const xrefs = Array.from({ length: charted.vertexCount }, (_, k) => charted.getVertex(k));
const low = {
  positions: Float32Array.from(xrefs.flatMap(({ xref }) => [...high.positions.subarray(3 * xref, 3 * xref + 3)])),
  uvs: Float32Array.from(xrefs.flatMap(({ uv }) => [uv[0] / atlas.width, uv[1] / atlas.height])),
  indices: lowIndices,
};
fs.writeFileSync(at('bake/bunny/bunny_low.obj'), obj({ ...low, normals: smoothNormals(low.positions, low.indices) }));

// ---- MikkTSpace tangents of another implementation: float32 x y z w of each corner, in the order of the file ----

function cornersOf(file) {
  const lists = { v: [], vt: [], vn: [] }, [positions, normals, uvs] = [[], [], []];
  for (const line of fs.readFileSync(file, 'utf8').split('\n')) {
    const [word, ...values] = line.trim().split(/\s+/);
    if (word in lists) lists[word].push(values.map(Number));
    if (word === 'f')
      for (let k = 2; k < values.length; ++k)
        for (const corner of [0, k - 1, k]) {
          const [v, vt, vn] = values[corner].split('/').map((i) => Number(i) - 1);
          positions.push(...lists.v[v]);
          uvs.push(...lists.vt[vt]);
          normals.push(...lists.vn[vn]);
        }
  }
  return [positions, normals, uvs].map((list) => Float32Array.from(list));
}

fs.mkdirSync(at('mikktspace'), { recursive: true });
const keep = (name, parts) => fs.writeFileSync(at(`mikktspace/${name}.mikk.f32`), Buffer.concat(parts.map((p) => Buffer.from(p.buffer, p.byteOffset, p.byteLength))));
for (const name of ['bake/bunny/bunny_low', 'classic/normal_map_stress_test_low', 'classic/teapot_patches']) {
  const tangents = mikktspace.generateTangents(...cornersOf(at(`${name}.obj`))).slice(); // v points up here
  keep(path.basename(name), [tangents]);
}
for (const name of ['models/NormalTangentTest/NormalTangentTest.glb', 'models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb', 'models/BoomBox/BoomBox.gltf', 'synthetic/uv_cases.gltf']) {
  const document = await io.read(at(name)), parts = [];
  await document.transform(unweld());
  for (const mesh of document.getRoot().listMeshes())
    for (const primitive of mesh.listPrimitives())
      parts.push(cornerTangents(...['POSITION', 'NORMAL', 'TEXCOORD_0'].map((word) => primitive.getAttribute(word).getArray())));
  keep(path.basename(name, path.extname(name)), parts);
}
