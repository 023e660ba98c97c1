// Every argument of every function with bad values: node arguments_test.mjs TARBALL NODE_MODULES [CASE]
// The environment's SEED draws other pairs of bad values.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { walkBadValues } from './bad_values.mjs';
import { installed, load, runCases, skip } from './shared.mjs';

const [tarball, modules, only] = process.argv.slice(2), seed = Number(process.env.SEED ?? 20261128);
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
if (!fs.existsSync(path.join(modules, '@gltf-transform'))) skip('the npm packages are not installed');
const folder = installed(tarball, modules, ['@gltf-transform', 'property-graph', 'ktx-parse', 'three']);
fs.writeFileSync(path.join(folder, 'from.js'), 'export const from = (name) => import(name);\n');
const { from } = await import(pathToFileURL(path.join(folder, 'from.js')));
const cotan = await load(folder), small = await load(folder, 'tangents');
await Promise.all([cotan.ready, small.ready]);

const mesh = () => ({ positions: [0, 0, 0, 1, 0, 0, 0, 1, 0], normals: new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1]), uvs: [0, 0, 1, 0, 0, 1], indices: [0, 1, 2] });
const map = () => ({ width: 2, height: 2, bits: 8, data: new Uint8Array(16).fill(128) });
const corners = () => Array(3).fill([1, 0, 0, 1]).flat();
const points = () => ({ normals: [0, 0, 1], dpdx: [1, 0, 0], dpdy: [0, 1, 0], duvdx: [1, 0], duvdy: [0, 1] });
const png = await cotan.encodePng(map());
const model = new TextEncoder().encode(JSON.stringify({
  asset: { version: '2.0' }, buffers: [{ byteLength: 96, uri: 'mesh.bin' }], images: [{ uri: 'map.png' }], textures: [{ source: 0 }], materials: [{ normalTexture: { index: 0 } }],
  bufferViews: [{ buffer: 0, byteOffset: 0, byteLength: 36 }, { buffer: 0, byteOffset: 36, byteLength: 36 }, { buffer: 0, byteOffset: 72, byteLength: 24 }],
  accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0] }, { bufferView: 1, componentType: 5126, count: 3, type: 'VEC3' },
    { bufferView: 2, componentType: 5126, count: 3, type: 'VEC2' }],
  meshes: [{ primitives: [{ attributes: { POSITION: 0, NORMAL: 1, TEXCOORD_0: 2 }, material: 0 }] }], nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }], scene: 0,
}));
const bin = Buffer.from(Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1).buffer);
const files = () => ({ 'mesh.bin': new Uint8Array(bin), 'map.png': new Uint8Array(png) });

const call = (work, names, ...args) => ({ call: work, names, args: () => args.map((arg) => (typeof arg === 'function' ? arg() : arg)) });
const ofTangents = (module) => ({
  tangents: call(module.tangents, ['mesh', 'options'], mesh, { kind: 'vertex' }),
  smooth: call(module.smooth, ['mesh'], mesh),
  triangles: call(module.triangles, ['mesh'], mesh),
  split: call(module.split, ['vertexCount', 'indices', 'corners'], 3, () => [0, 1, 2], corners),
  splitMirrored: call(module.splitMirrored, ['mesh'], mesh),
  packTriangles: call(module.packTriangles, ['u', 'v'], () => [1, 0, 0], () => [0, 1, 0]),
  packSmooth: call(module.packSmooth, ['normals', 'u', 'v', 'options'], () => [0, 0, 1], () => [1, 0, 0], () => [0, 1, 0], { bytes: 4 }),
  packTangents: call(module.packTangents, ['normals', 'tangents'], () => [0, 0, 1], () => [1, 0, 0, 1]),
});
const whole = {
  ...ofTangents(cotan),
  provoking: call(cotan.provoking, ['vertexCount', 'indices', 'options'], 3, () => [0, 1, 2], { vertex: 'last' }),
  detect: call(cotan.detect, ['map'], map),
  info: call(cotan.info, ['map'], map),
  convertMap: call(cotan.convertMap, ['map', 'options'], map, { from: 'gltf', to: 'directx', bits: 16 }),
  blend: call(cotan.blend, ['base', 'detail', 'options'], map, map, { convention: 'gltf', mode: 'udn', strength: 1, bits: 8 }),
  fromHeight: call(cotan.fromHeight, ['height', 'options'], map, () => ({ scale: [1, 2], to: 'gltf', bits: 8 })),
  toHeight: call(cotan.toHeight, ['map', 'options'], map, { from: 'gltf' }),
  mips: call(cotan.mips, ['map', 'options'], map, { convention: 'gltf', roughness: 0.5 }),
  apply: call(cotan.apply, ['frame', 'points', 'texels'], 'cotangent', points, () => [0, 0, 1]),
  encode: call(cotan.encode, ['frame', 'points', 'normals'], 'mikktspace', { normals: [0, 0, 1], tangents: [1, 0, 0, 1] }, () => [0, 0, 1]),
  smoothFrame: call(cotan.apply, ['frame', 'points', 'texels'], 'smooth', { normals: [0, 0, 1], u: [1, 0, 0], v: [0, 1, 0] }, () => [0, 0, 1]),
  shader: call(cotan.shader, ['options'], { language: 'glsl', frame: 'triangle', convention: 'gltf', stage: 'vertex' }),
  decodePng: call(cotan.decodePng, ['bytes'], png),
  encodePng: call(cotan.encodePng, ['image'], map),
  decodeImage: call(cotan.decodeImage, ['bytes', 'name'], png, 'map.png'),
  lint: call(cotan.lint, ['model', 'options'], model, () => ({ files: files(), decode: cotan.decodePng, progress: () => true, distance: 1, limit: 90, limitArea: 90, frame: 'smooth' })),
  convert: call(cotan.convert, ['model', 'options'], model, () => ({ files: files(), decode: cotan.decodePng, encode: cotan.encodePng, progress: () => true, mode: 'convert', from: 'mikktspace',
    to: 'cotangent', bits: 8, keepTangents: false, generateTangents: true, fixGreen: false, unsigned: 'exact' })),
  overLimits: call(cotan.overLimits, ['report', 'options'], await cotan.lint(model, { files: files() }), { limit: 1, limitArea: 1, frame: 'orthonormal' }),
};
const exported = (module) => Object.entries(module).filter(([, value]) => typeof value === 'function' && value !== module.CotanError).map(([name]) => name);

const cases = {
  async everyArgumentOfTheTangents() {
    const calls = ofTangents(small);
    assert.deepEqual(exported(small).filter((name) => !(name in calls) && name !== 'version'), []);
    console.log(`${await walkBadValues(calls, small.CotanError, { seed })} calls`);
  },

  async everyArgumentOfTheWholePackage() {
    assert.deepEqual(exported(cotan).filter((name) => !(name in whole) && !['version', 'frames', 'decodePicture'].includes(name)), []);
    whole.overLimits.depth = 3; // entries of a report are the library's own
    whole.overLimits.fine = (at) => at[0] === 0 && at.length > 1;
    whole.decodeImage.fine = (at, kind) => at[0] === 1 && kind === 'text with NUL'; // a name for messages
    console.log(`${await walkBadValues(whole, cotan.CotanError, { seed })} calls`);
  },

  async everyOptionOfTheTransforms() {
    const transforms = await from('cotan/gltf-transform'), { NodeIO } = await from('@gltf-transform/core');
    const document = await new NodeIO().readJSON({ json: JSON.parse(new TextDecoder().decode(model)), resources: files() });
    document.setLogger({ debug() {}, info() {}, warn() {}, error() {} });
    const applied = (name) => async (...args) => { await document.transform(transforms[name](...args)); };
    console.log(`${await walkBadValues({
      tangents: call(applied('tangents'), ['options'], { kind: 'vertex', overwrite: true }),
      provoking: call(applied('provoking'), ['options'], { vertex: 'first' }),
      lintNormals: call(applied('lintNormals'), ['options'], () => ({ distance: 1, limit: 90, limitArea: 90, frame: 'smooth', decode: cotan.decodePng, report: () => {} })),
      untangent: call(applied('untangent'), ['options'], () => ({ mode: 'convert', from: 'mikktspace', to: 'cotangent', bits: 8, keepTangents: false, generateTangents: true, unsigned: 'exact',
        decode: cotan.decodePng, report: () => {} })),
    }, cotan.CotanError, { seed })} calls`);
  },

  async everyArgumentForThree() {
    const THREE = await from('three'), classic = await from('cotan/three'), nodes = await from('cotan/three/tsl');
    const material = () => new THREE.MeshStandardMaterial({ normalMap: new THREE.DataTexture(new Uint8Array(4), 1, 1) });
    const scene = () => new THREE.Scene().add(new THREE.Mesh(new THREE.PlaneGeometry(), material()));
    const calls = ({ untangle, untangled, replaceFrame }) => ({
      untangle: call(untangle, ['target', 'options'], scene, () => ({ frame: 'smooth', maxDegrees: 1, convention: 'gltf', note: () => {} })),
      untangled: call(untangled, ['options'], () => ({ frame: 'smooth', maxDegrees: 1, convention: 'gltf', note: () => {} })),
      replaceFrame: call(replaceFrame, ['material', 'options'], material, () => ({ frame: 'smooth', against: true })),
    });
    const { warn } = console;
    console.warn = () => {};
    try {
      const count = await walkBadValues(calls(classic), classic.CotanError, { seed });
      const more = await walkBadValues({ ...calls(nodes), perturbedNormal: call(nodes.perturbedNormal, ['map', 'scale', 'frame'], () => new THREE.Texture(), () => undefined, 'cotangent') },
        nodes.CotanError, { seed });
      let relief = 0;
      for (const name of ['cotan/three/relief', 'cotan/three/tsl/relief']) {
        const { addRelief, CotanError } = await from(name), options = () => ({ heightMap: new THREE.Texture(), heightDepth: 1, heightSteps: 8, selfShadow: false });
        relief += await walkBadValues({ addRelief: call(addRelief, ['material', 'options'], material, options) }, CotanError, { seed });
      }
      console.log(`${count + more + relief} calls`);
    } finally {
      console.warn = warn;
    }
  },
};
await runCases(cases, only);
