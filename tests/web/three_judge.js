// Stock three.js as the reference: degrees between the normals that it draws of a model with its tangents and without.
// For meshes with a normal map and no tangents, the reference uses three's own computeMikkTSpaceTangents.
import * as THREE from 'three';
import { DRACOLoader } from 'three/addons/loaders/DRACOLoader.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import * as MikkTSpace from 'three/addons/libs/mikktspace.module.js';
import { computeMikkTSpaceTangents } from 'three/addons/utils/BufferGeometryUtils.js';
import { untangle } from '/package/three/index.js';

const kSize = 320;
// In front, behind, on both sides, above and below; none along an axis.
const kViews = [[0.1, 0.15, 1], [-0.2, 0.25, -1], [1, 0.1, 0.2], [-1, 0.3, -0.1], [0.15, 1, 0.3], [0.2, -1, 0.1]];

export const renderer = new THREE.WebGLRenderer();
const target = new THREE.WebGLRenderTarget(kSize, kSize, { type: THREE.FloatType });
renderer.setClearColor(0, 0);
const libs = '/modules/three/examples/jsm/libs/';
const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder).setDRACOLoader(new DRACOLoader().setDecoderPath(`${libs}draco/gltf/`))
  .setKTX2Loader(new KTX2Loader().setTranscoderPath(`${libs}basis/`).detectSupport(renderer));

export const load = (bytes, base) => loader.parseAsync(bytes.slice(0), base);

export const meshesOf = gltf => {
  const found = [];
  gltf.scene.traverse(child => { if (child.isMesh) found.push(child); });
  return found;
};
const materialsOf = meshes => new Set(meshes.flatMap(({ material }) => material));
export const mapped = material => material.normalMap ?? material.clearcoatNormalMap;

// three makes bitangents from a tangent and a normal that are both mirrored, which inverts them. The reference follows
// the file, whose node mirrors the whole mesh.
function forMirroredNode(mesh) {
  if (mesh.matrixWorld.determinant() > 0) return;
  mesh.geometry = mesh.geometry.clone();
  const { tangent } = mesh.geometry.attributes;
  for (let k = 0; k < tangent.count; ++k) tangent.setW(k, -tangent.getW(k));
}

// Prepares the reference: stored tangents, or MikkTSpace tangents where there are none. Returns the number of meshes
// with each.
export async function judged(gltf) {
  await MikkTSpace.ready;
  const counts = { stored: 0, generated: 0 }, turned = new Map();
  for (const mesh of meshesOf(gltf)) {
    if (!mapped(mesh.material)) continue;
    if (mesh.geometry.attributes.tangent) {
      ++counts.stored;
      forMirroredNode(mesh);
      continue;
    }
    const { position, normal, [uvNameOf(mapped(mesh.material))]: uv } = mesh.geometry.attributes;
    if (!position || !normal || !uv) continue;
    ++counts.generated;
    const key = `${mesh.geometry.uuid} ${mapped(mesh.material).uuid}`;
    if (!turned.has(key)) turned.set(key, withTangents(mesh.geometry, mapped(mesh.material)));
    mesh.geometry = turned.get(key);
    forMirroredNode(mesh);
    if (!turned.has(mesh.material)) { // without tangents the loader has inverted green
      turned.set(mesh.material, mesh.material.clone());
      for (const name of ['normalScale', 'clearcoatNormalScale']) if (mesh.material[name]) turned.get(mesh.material)[name].y *= -1;
    }
    mesh.material = turned.get(mesh.material);
  }
  return counts;
}

const uvNameOf = ({ channel }) => (channel ? `uv${channel}` : 'uv');

// Uses texture coordinates of the map's set, transformed by the map's matrix, both of which three's own function
// ignores.
function withTangents(geometry, map) {
  const made = geometry.index ? geometry.toNonIndexed() : geometry.clone(), place = new THREE.Vector2();
  const { uv: first, [uvNameOf(map)]: uv } = made.attributes;
  map.updateMatrix();
  const moved = Array.from({ length: uv.count }, (_, k) => place.fromBufferAttribute(uv, k).applyMatrix3(map.matrix).toArray()).flat();
  computeMikkTSpaceTangents(made.setAttribute('uv', new THREE.Float32BufferAttribute(moved, 2)), MikkTSpace);
  return first ? made.setAttribute('uv', first) : made;
}

// three uses tangents for a clear coat only if there is a normal map too, and assumes them in the coat's scale in any
// case.
export function withFlatBumps(material) {
  if (material.normalMap || !material.clearcoatNormalMap) return;
  material.normalMap = new THREE.DataTexture(Uint8Array.of(128, 128, 255, 255), 1, 1);
  material.normalMap.needsUpdate = true;
}

// Makes a material write a normal, or zeros if it has no such map.
export function write(material, what) {
  const { onBeforeCompile: before, customProgramCacheKey: key } = material, own = Object.hasOwn(material, 'customProgramCacheKey');
  const has = what === 'normal' ? material.normalMap : material.clearcoatNormalMap;
  Object.assign(material, { transparent: false, transmission: 0, alphaTest: material.alphaTest || (material.transparent ? 0.5 : 0) });
  material.onBeforeCompile = (shader, given) => {
    before.call(material, shader, given);
    shader.fragmentShader = shader.fragmentShader.replace('#include <dithering_fragment>', `gl_FragColor = ${has ? `vec4( normalize( ${what} ), 1.0 )` : 'vec4( 0.0 )'};`);
  };
  material.customProgramCacheKey = () => `${what} ${!!has} ${own ? key.call(material) : ''}`;
  material.needsUpdate = true;
}

function drawn(gltf, box) {
  const scene = new THREE.Scene(), middle = box.getCenter(new THREE.Vector3()), radius = box.getSize(new THREE.Vector3()).length() / 2;
  scene.add(gltf.scene, new THREE.AmbientLight('white', 1));
  const camera = new THREE.PerspectiveCamera(30, 1, radius / 100, radius * 20);
  return kViews.map(view => {
    camera.position.copy(middle).add(new THREE.Vector3(...view).normalize().multiplyScalar(radius / Math.sin(Math.PI / 12)));
    camera.lookAt(middle);
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, camera);
    const pixels = new Float32Array(kSize * kSize * 4);
    renderer.readRenderTargetPixels(target, 0, 0, kSize, kSize, pixels);
    return pixels;
  });
}

function degreesBetween(views, others) {
  const found = [];
  views.forEach((a, view) => {
    const b = others[view];
    for (let i = 0; i < a.length; i += 4) {
      if (a[i + 3] < 0.5 || b[i + 3] < 0.5) continue;
      const cross = Math.hypot(a[i + 1] * b[i + 2] - a[i + 2] * b[i + 1], a[i + 2] * b[i] - a[i] * b[i + 2], a[i] * b[i + 1] - a[i + 1] * b[i]);
      found.push(Math.atan2(cross, a[i] * b[i] + a[i + 1] * b[i + 1] + a[i + 2] * b[i + 2]) * 180 / Math.PI);
    }
  });
  found.sort((x, y) => x - y);
  return { count: found.length, finite: found.every(Number.isFinite), mean: found.reduce((sum, x) => sum + x, 0) / found.length, most: found[Math.floor(0.95 * (found.length - 1))], most99: found[Math.floor(0.99 * (found.length - 1))] };
}

// url: a model. ways: options of untangle() by name; null for the model as loaded. Returns the degrees for each, of the
// normals and the clear coat's, if any, over the pixels of materials with such a map; and the notes.
export async function measure(url, ways) {
  const bytes = await (await fetch(url)).arrayBuffer(), base = url.replace(/[^/]*$/, ''), found = {};
  for (const what of ['normal', 'clearcoatNormal']) {
    let original;
    const box = new THREE.Box3();
    for (const [way, options] of [['judge'], ...Object.entries(ways)]) {
      const gltf = await load(bytes, base), notes = [];
      gltf.scene.updateMatrixWorld(true);
      const meshes = meshesOf(gltf);
      if (!meshes.some(mesh => what === 'normal' ? mesh.material.normalMap : mesh.material.clearcoatNormalMap)) break;
      if (way === 'judge') {
        box.setFromObject(gltf.scene);
        found.tangents = await judged(gltf);
      } else if (options) {
        untangle(gltf, { ...options, note: line => notes.push(line) });
      }
      meshesOf(gltf).forEach((mesh, k) => { mesh.renderOrder = k; }); // instead of ids that loading assigns
      const materials = materialsOf(meshesOf(gltf));
      if (way === 'judge' && what !== 'normal') for (const material of materials) withFlatBumps(material);
      for (const material of materials) write(material, what);
      const views = drawn(gltf, box);
      if (way === 'judge') original = views;
      else (found[way] ??= {})[what] = { ...degreesBetween(original, views), notes, frames: [...new Set([...materials].filter(mapped).map(material => /cotan,(\w+)/.exec(material.customProgramCacheKey())?.[1]))] };
      for (const material of materials) material.dispose();
      for (const { geometry } of meshesOf(gltf)) geometry.dispose();
    }
  }
  return found;
}
