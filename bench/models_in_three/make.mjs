// Makes the models of models.json that are not files of a package as they are: node make.mjs LIST MODELS TOOLS DATA OUT
// LIST: models.json. MODELS, TOOLS: node_modules of models and of the packages that change them. DATA: made by
// scripts/test-data. OUT: the folder for one .glb for each entry with `made`, whose steps models.json explains.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [list, models, tools, data, out] = process.argv.slice(2).map((name) => path.resolve(name));
const require = createRequire(path.join(tools, 'x.js'));
const from = (name) => import(pathToFileURL(path.join(tools, name)).href);
const { NodeIO, VertexLayout } = await from('@gltf-transform/core/dist/index.js');
const { ALL_EXTENSIONS, EXTMeshGPUInstancing, EXTMeshoptCompression, EXTTextureWebP, KHRDracoMeshCompression, KHRTextureTransform } =
  await from('@gltf-transform/extensions/dist/index.js');
const { meshopt, quantize, unweld, weld } = await from('@gltf-transform/functions/dist/index.js');
const { MeshoptDecoder, MeshoptEncoder } = await from('meshoptimizer/index.js');
const draco = require('draco3dgltf'), mikktspace = require('mikktspace');
await Promise.all([MeshoptDecoder.ready, MeshoptEncoder.ready]);
// Not interleaved: three keeps the buffer of interleaved attributes if one of them is removed.
const io = new NodeIO().setVertexLayout(VertexLayout.SEPARATE).registerExtensions(ALL_EXTENSIONS).registerDependencies({
  'draco3d.decoder': await draco.createDecoderModule(), 'draco3d.encoder': await draco.createEncoderModule(),
  'meshopt.decoder': MeshoptDecoder, 'meshopt.encoder': MeshoptEncoder,
});

const primitivesOf = (document) => document.getRoot().listMeshes().flatMap((mesh) => mesh.listPrimitives());
const accessorOf = (document, type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(document.getRoot().listBuffers()[0]);
const floats = (accessor) => Float32Array.from({ length: accessor.getCount() * accessor.getElementSize() },
  (_, k) => accessor.getElement(Math.floor(k / accessor.getElementSize()), [])[k % accessor.getElementSize()]);

// ---- maps ----

// Gives every material a normal map. repeat: how often it repeats along u and v. set: of the texture coordinates.
function addMap(document, { map, repeat = 1, set = 0 }) {
  const webp = map.endsWith('.webp');
  if (webp) document.createExtension(EXTTextureWebP).setRequired(true);
  const texture = document.createTexture(map).setMimeType(webp ? 'image/webp' : 'image/png').setImage(fs.readFileSync(path.join(data, 'textures', map)));
  for (const material of document.getRoot().listMaterials()) {
    const info = material.setNormalTexture(texture).getNormalTextureInfo().setTexCoord(set);
    if (repeat === 1) continue;
    const transform = document.createExtension(KHRTextureTransform).setRequired(true);
    info.setExtension('KHR_texture_transform', transform.createTransform().setScale([repeat, repeat]));
  }
}

// Adds texture coordinates of set 1: those of set 0 after a rotation by 30 degrees.
function addSet(document) {
  const c = Math.cos(Math.PI / 6), s = 0.5;
  for (const primitive of primitivesOf(document)) {
    const uv = floats(primitive.getAttribute('TEXCOORD_0'));
    primitive.setAttribute('TEXCOORD_1', accessorOf(document, 'VEC2', uv.map((x, k) => (k % 2 ? s * uv[k - 1] + c * x : c * x - s * uv[k + 1]))));
  }
}

// ---- tangents ----

const subtract = (a, b) => a.map((x, k) => x - b[k]), dot = (a, b) => a.reduce((sum, x, k) => sum + x * b[k], 0);
const cross = (a, b) => [0, 1, 2].map((k) => a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);

// Sums of dP/du and dP/dv at each vertex, orthogonal to its normal: many exporters do so instead of MikkTSpace
// (Lengyel, Computing Tangent Space Basis Vectors for an Arbitrary Mesh). w in the sense of glTF, with v down.
function averagedTangents(primitive, uvName) {
  const [position, normal, uv] = ['POSITION', 'NORMAL', uvName].map((name) => primitive.getAttribute(name)), indices = primitive.getIndices().getArray();
  const sums = Array.from({ length: position.getCount() }, () => [[0, 0, 0], [0, 0, 0]]);
  for (let k = 0; k + 2 < indices.length; k += 3) {
    const corners = [...indices.subarray(k, k + 3)], [p, w] = [position, uv].map((accessor) => corners.map((i) => accessor.getElement(i, [])));
    const [e, f] = [subtract(p[1], p[0]), subtract(p[2], p[0])], [a, b] = [subtract(w[1], w[0]), subtract(w[2], w[0])], r = 1 / (a[0] * b[1] - b[0] * a[1]);
    if (!Number.isFinite(r)) continue;
    for (const i of corners)
      for (let j = 0; j < 3; ++j) {
        sums[i][0][j] += (e[j] * b[1] - f[j] * a[1]) * r;
        sums[i][1][j] += (f[j] * a[0] - e[j] * b[0]) * r;
      }
  }
  return Float32Array.from(sums.flatMap(([t, b], i) => {
    const n = normal.getElement(i, []), along = dot(n, t), flat = t.map((x, j) => x - n[j] * along), length = Math.hypot(...flat);
    const unit = length > 0 ? flat.map((x) => x / length) : [1, 0, 0];
    return [...unit, dot(cross(n, unit), b) < 0 ? 1 : -1];
  }));
}

// kind: `mikktspace`, `inverted` (the same with -w) or `averaged`.
async function addTangents(document, kind, uvName) {
  if (kind !== 'averaged') await document.transform(unweld());
  for (const primitive of primitivesOf(document)) {
    if (!primitive.getAttribute(uvName)) continue;
    let tangents;
    if (kind === 'averaged') tangents = averagedTangents(primitive, uvName);
    else {
      tangents = mikktspace.generateTangents(...['POSITION', 'NORMAL', uvName].map((name) => floats(primitive.getAttribute(name)))).slice();
      if (kind !== 'inverted') for (let k = 3; k < tangents.length; k += 4) tangents[k] *= -1; // v points down in glTF
    }
    primitive.setAttribute('TANGENT', accessorOf(document, 'VEC4', tangents));
  }
  if (kind !== 'averaged') await document.transform(weld());
}

// ---- shapes ----

// Makes every node with a mesh three instances beside one another.
function addInstances(document) {
  const extension = document.createExtension(EXTMeshGPUInstancing).setRequired(true), half = Math.SQRT1_2;
  for (const node of document.getRoot().listNodes()) {
    if (!node.getMesh()) continue;
    const points = node.getMesh().listPrimitives().flatMap((primitive) => [primitive.getAttribute('POSITION').getMin([]), primitive.getAttribute('POSITION').getMax([])]);
    const wide = 1.5 * Math.max(...points.flat().map(Math.abs));
    node.setExtension('EXT_mesh_gpu_instancing', extension.createInstancedMesh()
      .setAttribute('TRANSLATION', accessorOf(document, 'VEC3', Float32Array.of(-wide, 0, 0, 0, 0, 0, wide, 0, 0)))
      .setAttribute('ROTATION', accessorOf(document, 'VEC4', Float32Array.of(0, 0, 0, 1, 0, half, 0, half, half, 0, 0, half)))
      .setAttribute('SCALE', accessorOf(document, 'VEC3', Float32Array.of(1, 1, 1, 0.7, 0.7, 0.7, 1, 1.4, 1))));
  }
}

// Adds a target that swells every mesh in waves along its normals.
function addMorph(document) {
  for (const mesh of document.getRoot().listMeshes()) {
    mesh.setWeights([0]);
    for (const primitive of mesh.listPrimitives()) {
      const [position, normal] = ['POSITION', 'NORMAL'].map((name) => floats(primitive.getAttribute(name)));
      const size = Math.max(...position.map(Math.abs));
      const moved = position.map((_, k) => normal[k] * 0.08 * size * Math.sin(9 * position[k - k % 3 + 1] / size));
      primitive.addTarget(document.createPrimitiveTarget().setAttribute('POSITION', accessorOf(document, 'VEC3', moved)));
    }
  }
}

// Adds an animation of two seconds that bends every joint but the first by 25 degrees and back.
function addBending(document) {
  const animation = document.createAnimation('bend'), half = 25 * Math.PI / 360;
  for (const joint of document.getRoot().listSkins().flatMap((skin) => skin.listJoints()).slice(1)) {
    const [x, y, z, w] = joint.getRotation(), [c, s] = [Math.cos(half), Math.sin(half)];
    const bent = [c * x + s * w, c * y - s * z, c * z + s * y, c * w - s * x]; // after a rotation about its own x
    const sampler = document.createAnimationSampler().setInput(accessorOf(document, 'SCALAR', Float32Array.of(0, 1, 2)))
      .setOutput(accessorOf(document, 'VEC4', Float32Array.of(x, y, z, w, ...bent, x, y, z, w)));
    animation.addSampler(sampler).addChannel(document.createAnimationChannel().setTargetNode(joint).setTargetPath('rotation').setSampler(sampler));
  }
}

async function compress(document, kind) {
  if (kind === 'draco')
    document.createExtension(KHRDracoMeshCompression).setRequired(true)
      .setEncoderOptions({ quantizationBits: { POSITION: 14, NORMAL: 10, TEX_COORD: 12, GENERIC: 12 } }); // as gltf-transform does
  if (kind === 'quantized') await document.transform(quantize());
  if (kind === 'meshopt') {
    await document.transform(meshopt({ encoder: MeshoptEncoder, level: 'medium' }));
    document.createExtension(EXTMeshoptCompression).setRequired(true);
  }
}

fs.mkdirSync(out, { recursive: true });
for (const { name, package: source, made } of JSON.parse(fs.readFileSync(list)).models.filter(({ made }) => made)) {
  const document = await io.read(path.join(models, source));
  document.getRoot().getAsset().generator = 'bench/models-in-three';
  if (made.set) addSet(document);
  if (made.map) addMap(document, made);
  if (made.tangents) await addTangents(document, made.tangents, `TEXCOORD_${made.set ?? 0}`);
  if (made.bend) addBending(document);
  if (made.morph) addMorph(document);
  if (made.instances) addInstances(document);
  if (made.compress) await compress(document, made.compress);
  await io.write(path.join(out, `${name}.glb`), document);
}
