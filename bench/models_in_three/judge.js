// Measures one model in stock three.js, in a browser: normals with the tangents that its file means, and after
// untangle().
import * as THREE from 'three';
import { judged, load, mapped, meshesOf, renderer, withFlatBumps, write } from '/tests/three_judge.js';
import { untangle } from '/package/three/index.js';
import { drawUnfolded, layoutOf, unfold } from './unfolded.js';

// In front, behind, on both sides, above and below; none along an axis.
const kViews = [[0.1, 0.15, 1], [-0.2, 0.25, -1], [1, 0.1, 0.2], [-1, 0.3, -0.1], [0.15, 1, 0.3], [0.2, -1, 0.1]];
const kKinds = { normal: 'normalMap', clearcoatNormal: 'clearcoatNormalMap' };
const kRounds = 3;          // of untangle(), for its time
const kBinsPerDegree = 200; // of the histograms that percentiles come from
const kVisibleDegrees = 3;  // white in the image of differences

// "mesh, primitive" of the file for each mesh of the scene. Instances have the key of the mesh that they repeat.
function keyOf(gltf, mesh) {
  const found = gltf.parser.associations.get(mesh) ?? {};
  if (found.meshes !== undefined) return `${found.meshes}, ${found.primitives ?? 0}`;
  const node = gltf.parser.json.nodes[found.nodes];
  return `${node?.mesh ?? mesh.name}, 0`;
}

// Loads a model in one of its poses: 0 is that of the file, 1 the middle of its first animation, or of all morph
// targets.
async function loadPosed(bytes, base, pose) {
  const gltf = await load(bytes, base);
  if (pose && gltf.animations.length) {
    const mixer = new THREE.AnimationMixer(gltf.scene);
    mixer.clipAction(gltf.animations[0]).play();
    mixer.setTime(gltf.animations[0].duration / 2);
  } else if (pose) {
    for (const { morphTargetInfluences } of meshesOf(gltf)) morphTargetInfluences?.fill(0.5);
  }
  gltf.scene.updateMatrixWorld(true);
  for (const mesh of meshesOf(gltf)) mesh.frustumCulled = false;
  return gltf;
}

// Bytes of vertices and indices of all meshes, as they are uploaded. Interleaved attributes are uploaded together.
function bytesOf(gltf) {
  const counted = new Set(), all = { total: 0, tangents: 0 };
  for (const { geometry } of meshesOf(gltf))
    for (const [name, attribute] of [...Object.entries(geometry.attributes), ['index', geometry.index]]) {
      const buffer = attribute?.data ?? attribute;
      if (!buffer || counted.has(buffer)) continue;
      counted.add(buffer);
      const bytes = buffer.array.byteLength;
      all.total += bytes;
      if (name === 'tangent') all.tangents += bytes;
    }
  return all;
}

// The area of a mesh in the scene.
function areaOf(mesh) {
  const [a, b, c] = [0, 1, 2].map(() => new THREE.Vector3()), { index, attributes: { position } } = mesh.geometry;
  let area = 0;
  for (let k = 0; k + 2 < (index ?? position).count; k += 3) {
    [a, b, c].forEach((corner, i) => corner.fromBufferAttribute(position, index ? index.getX(k + i) : k + i).applyMatrix4(mesh.matrixWorld));
    area += b.sub(a).cross(c.sub(a)).length() / 2;
  }
  return area * (mesh.isInstancedMesh ? mesh.count : 1);
}

const frameOf = material => /cotan,(\w+)/.exec(material.customProgramCacheKey())?.[1];

// Whether tangents are the loaded ones, or those in fewer bits.
function alike(a, b) {
  if (!a || a.count !== b?.count) return false;
  for (let k = 0; k < 4 * a.count; ++k) if (Math.abs(a.getComponent(k >> 2, k % 4) - b.getComponent(k >> 2, k % 4)) > 1e-3) return false;
  return true;
}

// What untangle() decided for each primitive: the frame, or `tangents` where those of the file are needed; and the mean
// that it predicts, which is 0 where loaded tangents are drawn. before: their attributes by mesh. Without decisions, the
// frame is the one that its material is drawn with.
function decisionsOf(gltf, decisions, before) {
  const found = new Map();
  for (const mesh of meshesOf(gltf)) {
    if (!mapped(mesh.material)) continue;
    const own = decisions?.find(one => one.mesh === mesh && one.material === mesh.material);
    const { frame, keepsTangents, reason } = own ?? { frame: frameOf(mesh.material) ?? 'none', keepsTangents: !!mesh.geometry.attributes.tangent };
    const drawsLoaded = alike(mesh.geometry.attributes.tangent, before.get(mesh));
    const predicted = drawsLoaded ? 0 : own?.candidates.find(one => one.frame === frame)?.mean;
    found.set(keyOf(gltf, mesh), { frame: keepsTangents ? 'tangents' : frame, drawsLoaded, predicted, reason, candidates: own?.candidates });
  }
  return found;
}

// The smallest box around all meshes in this pose.
function boxOf(gltf) {
  const box = new THREE.Box3();
  for (const mesh of meshesOf(gltf)) {
    mesh.skeleton?.update();
    if (!mesh.isInstancedMesh) { box.expandByObject(mesh, !!(mesh.isSkinnedMesh || mesh.morphTargetInfluences)); continue; }
    mesh.computeBoundingBox();
    box.union(mesh.boundingBox.clone().applyMatrix4(mesh.matrixWorld));
  }
  return box;
}

// Draws every view; one Float32Array of RGBA for each.
function drawn(gltf, box, size) {
  const target = new THREE.WebGLRenderTarget(size, size, { type: THREE.FloatType }), scene = new THREE.Scene();
  const middle = box.getCenter(new THREE.Vector3()), radius = box.getSize(new THREE.Vector3()).length() / 2;
  scene.add(gltf.scene, new THREE.AmbientLight('white', 1));
  const camera = new THREE.PerspectiveCamera(30, 1, radius / 100, radius * 20);
  const views = kViews.map(view => {
    camera.position.copy(middle).add(new THREE.Vector3(...view).normalize().multiplyScalar(radius / Math.sin(Math.PI / 12)));
    camera.lookAt(middle);
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, camera);
    const pixels = new Float32Array(size * size * 4);
    renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
    return pixels;
  });
  target.dispose();
  return views;
}

// Which primitive each pixel shows: the number of its key in `keys`, from 1; 0 where there is none.
function drawnKeys(gltf, box, size, keys) {
  const own = new Map();
  for (const mesh of meshesOf(gltf)) {
    const { side, map, alphaMap, opacity, transparent, alphaTest } = mesh.material, key = keyOf(gltf, mesh);
    if (!keys.includes(key)) keys.push(key);
    own.set(mesh, mesh.material);
    const drawnNumber = { value: keys.indexOf(key) + 1 };
    mesh.material = new THREE.MeshBasicMaterial({ side, map: map ?? null, alphaMap: alphaMap ?? null, opacity, alphaTest: alphaTest || (transparent ? 0.5 : 0) });
    mesh.material.customProgramCacheKey = () => 'number of the primitive';
    mesh.material.onBeforeCompile = shader => {
      shader.uniforms.drawnNumber = drawnNumber;
      shader.fragmentShader = `uniform float drawnNumber;\n${shader.fragmentShader.replace('#include <dithering_fragment>', 'gl_FragColor = vec4( drawnNumber );')}`;
    };
  }
  const views = drawn(gltf, box, size).map(pixels => Uint16Array.from({ length: pixels.length / 4 }, (_, k) => pixels[4 * k]));
  for (const [mesh, material] of own) {
    mesh.material.dispose();
    mesh.material = material;
  }
  return views;
}

// Draws the normals, or the clear coat's; alpha is 1 where a material has such a map. sharp: without mipmaps, so that
// small images show the texels of the map itself, as predictions sample them.
function drawnNormals(gltf, box, size, kind, sharp) {
  const meshes = meshesOf(gltf), materials = new Set(meshes.map(({ material }) => material));
  meshes.forEach((mesh, k) => { mesh.renderOrder = k; }); // instead of ids that loading assigns
  for (const material of materials) {
    for (const map of [material.normalMap, material.clearcoatNormalMap]) if (map && sharp) Object.assign(map, { minFilter: THREE.LinearFilter, generateMipmaps: false });
    write(material, kind);
  }
  return { views: drawn(gltf, box, size), materials };
}

// Degrees over the whole surface of each mesh with such a map, as a Histogram, by key: those of the instance, or of the
// mesh of several with one key, that has the largest mean. Both scenes write normals. The untangled model is loaded later:
// call it with the original alone first, which returns what the second call needs.
function drawnSurfaces(gltf, box, shows, before) {
  const scene = new THREE.Scene().add(gltf.scene), middle = box.getCenter(new THREE.Vector3()), found = new Map();
  new Set(meshesOf(gltf).map(({ material }) => material)).forEach(unfold);
  meshesOf(gltf).forEach((mesh, k) => {
    const key = keyOf(gltf, mesh);
    if (!shows.has(key)) return;
    for (let instance = 0; instance < (mesh.isInstancedMesh ? mesh.count : 1); ++instance) {
      const id = `${k} ${instance}`, layout = before?.get(id).layout ?? layoutOf(mesh, instance), pixels = drawUnfolded(renderer, scene, mesh, instance, layout, middle);
      found.set(id, { key, layout, pixels });
    }
  });
  return found;
}

function surfaceDegrees(before, after) {
  const found = new Map();
  for (const [id, { key, pixels: a }] of before) {
    const degrees = new Histogram(), b = after.get(id).pixels;
    for (let i = 0; i < a.length; i += 4) {
      const apart = a[i + 3] > 0.5 && b[i + 3] > 0.5 ? degreesAt(a, b, i) : NaN;
      if (Number.isFinite(apart)) degrees.add(apart);
    }
    if (degrees.weight && !(found.get(key)?.mean > degrees.mean)) found.set(key, degrees);
  }
  return found;
}

function release(gltf) {
  for (const { geometry, material } of meshesOf(gltf)) {
    geometry.dispose();
    for (const value of Object.values(material)) if (value?.isTexture) value.dispose();
    material.dispose();
  }
}

const degreesAt = (a, b, i) => {
  const cross = Math.hypot(a[i + 1] * b[i + 2] - a[i + 2] * b[i + 1], a[i + 2] * b[i] - a[i] * b[i + 2], a[i] * b[i + 1] - a[i + 1] * b[i]);
  return Math.atan2(cross, a[i] * b[i] + a[i + 1] * b[i + 1] + a[i + 2] * b[i + 2]) * 180 / Math.PI;
};

class Histogram {
  bins = new Float64Array(180 * kBinsPerDegree + 1);
  sum = 0;
  weight = 0;
  max = 0;
  add(degrees, weight = 1) {
    this.bins[Math.round(degrees * kBinsPerDegree)] += weight;
    this.sum += degrees * weight;
    this.weight += weight;
    this.max = Math.max(this.max, degrees);
  }
  addAll(other, factor) {
    other.bins.forEach((weight, k) => { this.bins[k] += weight * factor; });
    this.sum += other.sum * factor;
    this.weight += other.weight * factor;
    this.max = Math.max(this.max, other.max);
  }
  get mean() { return this.sum / this.weight; }
  below(fraction) {
    let sum = 0;
    const bin = this.bins.findIndex(weight => (sum += weight) >= fraction * this.weight);
    return bin / kBinsPerDegree;
  }
  get numbers() { return { mean: this.mean, p95: this.below(0.95), p99: this.below(0.99), max: this.max }; }
}

const round = value => (typeof value === 'number' && !Number.isInteger(value) ? Number(value.toPrecision(4)) : value);

// The view with the largest sum of degrees: the normals with tangents, those without, and their difference, as a PNG in
// a data URI.
function imageOf(withTangents, without, size) {
  const sums = withTangents.map((a, k) => a.reduce((sum, _, i) => (i % 4 === 3 && a[i] > 0.5 && without[k][i] > 0.5 ? sum + degreesAt(a, without[k], i - 3) : sum), 0));
  const worst = sums.indexOf(Math.max(...sums)), canvas = new OffscreenCanvas(3 * size, size), context = canvas.getContext('2d');
  const image = context.createImageData(3 * size, size);
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      const from = 4 * ((size - 1 - y) * size + x), [a, b] = [withTangents[worst], without[worst]];
      const put = (column, colour) => image.data.set([...colour, 255], 4 * (y * 3 * size + column * size + x));
      const shown = a[from + 3] > 0.5 && b[from + 3] > 0.5, apart = shown ? degreesAt(a, b, from) / kVisibleDegrees * 255 : 0;
      [a, b].forEach((view, column) => put(column, view[from + 3] > 0.5 ? [0, 1, 2].map(i => 127.5 * (view[from + i] + 1)) : [0, 0, 0]));
      put(2, [apart, apart, apart]);
    }
  context.putImageData(image, 0, 0);
  return canvas.convertToBlob().then(blob => new Promise(done => { const reader = new FileReader(); reader.onload = () => done(reader.result); reader.readAsDataURL(blob); }));
}

// Loads a model and calls untangle() three times: what it decided, the vertex data before and after, and the median of its
// times.
async function untangledTimes(bytes, base, options, notes) {
  const spans = [], found = {};
  for (let round = 0; round < kRounds; ++round) {
    const gltf = await loadPosed(bytes, base, 0), before = bytesOf(gltf);
    const loaded = new Map(meshesOf(gltf).map(mesh => [mesh, mesh.geometry.attributes.tangent])), start = await window.threadTime();
    const result = untangle(gltf, { ...options, note: line => round || notes.push(line) });
    spans.push(1000 * (await window.threadTime() - start));
    if (!round) Object.assign(found, { tangentBytes: before.tangents, savedBytes: before.total - bytesOf(gltf).total, decisions: decisionsOf(gltf, [result, result?.decisions].find(Array.isArray), loaded) });
    release(gltf);
  }
  return { ...found, milliseconds: spans.sort((a, b) => a - b)[kRounds >> 1] };
}

// url: a model. Only the median time of untangle(), in milliseconds.
export async function time(url, { options }) {
  const bytes = await (await fetch(url)).arrayBuffer();
  return round((await untangledTimes(bytes, url.replace(/[^/]*$/, ''), options, [])).milliseconds);
}

// url: a model. posed: whether to draw it in the middle of its animation too. Returns the degrees over all pixels that
// show a normal map or the map of a clear coat, for each primitive and each kind of map, and what untangle() did.
export async function measure(url, { posed = false, size = 512, sharp = false, options, image = false }) {
  const bytes = await (await fetch(url)).arrayBuffer(), base = url.replace(/[^/]*$/, '');
  const keys = [], parts = new Map(), whole = new Map(), found = { stored: 0, generated: 0, notes: [], notFinite: 0 };
  Object.assign(found, await untangledTimes(bytes, base, options, found.notes));
  for (const [kind, name] of Object.entries(kKinds))
    for (const pose of posed ? [0, 1] : [0]) {
      const original = await loadPosed(bytes, base, pose), box = boxOf(original);
      if (!meshesOf(original).some(({ material }) => material[name])) { release(original); continue; }
      const areas = new Map();
      const shows = new Set(meshesOf(original).filter(({ material }) => material[name]).map(mesh => keyOf(original, mesh)));
      for (const mesh of meshesOf(original)) areas.set(keyOf(original, mesh), (areas.get(keyOf(original, mesh)) ?? 0) + areaOf(mesh));
      const shown = drawnKeys(original, box, size, keys);
      Object.assign(found, await judged(original));
      if (kind !== 'normal') for (const { material } of meshesOf(original)) withFlatBumps(material);
      const { views: expected } = drawnNormals(original, box, size, kind, sharp);
      const surfaces = pose ? undefined : drawnSurfaces(original, box, shows);
      release(original);
      const untangled = await loadPosed(bytes, base, pose);
      await untangle(untangled, { ...options, note: () => {} });
      const alsoShown = drawnKeys(untangled, box, size, keys);
      const { views, materials } = drawnNormals(untangled, box, size, kind, sharp);
      for (const { normalScale, clearcoatNormalScale } of materials) for (const scale of [normalScale, clearcoatNormalScale]) if (scale) scale.y *= -1;
      const reversed = drawn(untangled, box, size);
      if (surfaces) {
        for (const { normalScale, clearcoatNormalScale } of materials) for (const scale of [normalScale, clearcoatNormalScale]) if (scale) scale.y *= -1;
        whole.set(kind, surfaceDegrees(surfaces, drawnSurfaces(untangled, box, shows, surfaces)));
      }
      release(untangled);
      if (image && !found.image) found.image = await imageOf(expected, views, size);
      expected.forEach((a, view) => {
        const b = views[view], c = reversed[view];
        for (let k = 0; k < shown[view].length; ++k) {
          const i = 4 * k, number = shown[view][k];
          if (!number || number !== alsoShown[view][k] || a[i + 3] < 0.5 || b[i + 3] < 0.5) continue;
          const key = keys[number - 1], id = `${key} ${kind}`;
          if (!shows.has(key)) continue; // two surfaces in one place
          const degrees = degreesAt(a, b, i), against = degreesAt(a, c, i);
          if (!Number.isFinite(degrees)) { ++found.notFinite; continue; }
          if (!parts.has(id)) parts.set(id, { key, kind, area: areas.get(key), degrees: new Histogram(), reversed: 0, low: [2, 2, 2], high: [-2, -2, -2] });
          const part = parts.get(id);
          part.degrees.add(degrees);
          part.reversed += against;
          for (let j = 0; j < 3; ++j) {
            part.low[j] = Math.min(part.low[j], a[i + j]);
            part.high[j] = Math.max(part.high[j], a[i + j]);
          }
        }
      });
    }
  const all = new Histogram(), byArea = new Histogram();
  for (const { degrees, area } of parts.values()) {
    all.addAll(degrees, 1);
    byArea.addAll(degrees, area / degrees.weight);
  }
  const rounded = object => Object.fromEntries(Object.entries(object).map(([name, value]) => [name, round(value)]));
  const { decisions, image: picture, ...rest } = found;
  const primitives = [...parts.values()].map(({ key, kind, area, degrees, reversed, low, high }) => {
    const { frame, drawsLoaded, predicted, reason, candidates } = decisions.get(key) ?? { frame: 'none' };
    return { primitive: key, kind, frame, drawsLoaded, predicted, reason, candidates: candidates && rounded(Object.fromEntries(candidates.map(one => [one.frame, one.mean]))), pixels: degrees.weight, area, ...degrees.numbers, reversedMean: reversed / degrees.weight,
      range: Math.max(...high.map((value, j) => value - low[j])), surface: whole.get(kind)?.get(key)?.mean };
  });
  return { ...rounded(rest), pixels: all.weight, ...rounded(all.numbers), byArea: rounded(byArea.numbers), primitives: primitives.map(rounded), image: picture };
}
