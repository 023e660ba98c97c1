// The faults of docs/how-to/three-normal-maps.md in stock three.js, each with its analytic truth: for
// three_symptoms_test.mjs.
import * as THREE from 'three';
import { untangle } from '/package/three/index.js';

const kSize = 128;
const renderer = new THREE.WebGLRenderer(), target = new THREE.WebGLRenderTarget(kSize, kSize, { type: THREE.FloatType });
const camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 10);
camera.position.z = 5;

// The relief: its slopes (x and y of the normal over z) at a point of the image, y up.
const slopesAt = (u, v) => [0.5 * Math.sin(19 * u + 3 * v), 0.4 * Math.cos(13 * v) - 0.1];
const unit = ([x, y, z]) => [x, y, z].map(c => c / Math.hypot(x, y, z));

// A map of the relief. down: green points down; top: rows are stored from the top; strength: of the slopes.
function mapOf({ down = false, top = false, strength = 1, channels = 4 } = {}) {
  const data = new Uint8Array(kSize * kSize * channels);
  for (let y = 0; y < kSize; ++y)
    for (let x = 0; x < kSize; ++x) {
      const [sx, sy] = slopesAt((x + 0.5) / kSize, (y + 0.5) / kSize), n = unit([strength * sx, strength * (down ? -sy : sy), 1]);
      const bytes = [...n.map(c => Math.round(127.5 + 127.5 * c)), 255];
      data.set(channels === 2 ? bytes.slice(0, 2) : bytes, channels * ((top ? kSize - 1 - y : y) * kSize + x));
    }
  const map = new THREE.DataTexture(data, kSize, kSize, channels === 2 ? THREE.RGFormat : THREE.RGBAFormat);
  map.minFilter = map.magFilter = THREE.LinearFilter;
  map.needsUpdate = true;
  return map;
}

// A square that fills the image. gltf: v runs down.
function square({ gltf = false, tangents = false } = {}) {
  const geometry = new THREE.PlaneGeometry(2, 2), { uv } = geometry.attributes;
  if (tangents) geometry.computeTangents(); // bitangents along the image's upward direction, as in glTF
  if (gltf) for (let k = 0; k < uv.count; ++k) uv.setY(k, 1 - uv.getY(k));
  return geometry;
}

const standard = (map, more) => new THREE.MeshStandardMaterial({ normalMap: map, ...more });

// What a scene shows: name -> { mesh, truth, what, given }. truth(x, y): the slopes of the surface seen at a point of the
// image, 0 to 1, y up; missing: those of the relief. what: the normal that is measured. given: more names for the line.
const scenes = {
  green() { return { mesh: new THREE.Mesh(square(), standard(mapOf({ down: true }))) }; },
  mirroredUv() {
    const geometry = new THREE.PlaneGeometry(2, 2, 2, 1).toNonIndexed(), { position, uv } = geometry.attributes, tangents = [];
    for (let k = 0; k < uv.count; ++k) { // uv are mirrored left of the middle; the tangents know it, but not w
      const left = Math.floor(k / 6) === 0;
      uv.setXY(k, Math.abs(position.getX(k)), 1 - uv.getY(k));
      tangents.push(left ? -1 : 1, 0, 0, 1);
    }
    geometry.setAttribute('tangent', new THREE.Float32BufferAttribute(tangents, 4));
    const truth = (x, y) => {
      const [sx, sy] = slopesAt(Math.abs(2 * x - 1), y);
      return [x < 0.5 ? -sx : sx, sy];
    };
    return { mesh: new THREE.Mesh(geometry, standard(mapOf({ top: true }))), truth };
  },
  mirroredMesh() {
    const mesh = new THREE.Mesh(square({ tangents: true }), standard(mapOf()));
    mesh.scale.x = -1;
    return { mesh, truth: (x, y) => { const [sx, sy] = slopesAt(1 - x, y); return [-sx, sy]; } };
  },
  flippedRows() {
    const map = mapOf({ top: true }); // as TextureLoader makes it
    map.flipY = true;
    return { mesh: new THREE.Mesh(square({ gltf: true, tangents: true }), standard(map)) };
  },
  rowsFromTheTop() { return { mesh: new THREE.Mesh(square(), standard(mapOf({ top: true }))) }; }, // as KTX2
  rotated() {
    const map = mapOf();
    map.center.set(0.5, 0.5);
    map.rotation = Math.PI / 2;
    map.updateMatrix();
    const [a, b, , c, d] = map.matrix.elements;
    const truth = (x, y) => {
      const at = new THREE.Vector2(x, y).applyMatrix3(map.matrix), [su, sv] = slopesAt(at.x, at.y);
      return [a * su + b * sv, c * su + d * sv]; // gradients of u and v
    };
    return { mesh: new THREE.Mesh(square({ tangents: true }), standard(map)), truth };
  },
  secondUv() {
    const geometry = square(), { uv } = geometry.attributes, map = mapOf();
    geometry.setAttribute('uv1', uv.clone());
    for (let k = 0; k < uv.count; ++k) uv.setXY(k, -uv.getY(k), uv.getX(k));
    geometry.computeTangents();
    map.channel = 1;
    return { mesh: new THREE.Mesh(geometry, standard(map)) };
  },
  colour() {
    const map = mapOf();
    map.colorSpace = THREE.SRGBColorSpace;
    return { mesh: new THREE.Mesh(square(), standard(map)) };
  },
  weak() { return { mesh: new THREE.Mesh(square(), standard(mapOf({ strength: 0.5 }))) }; },
  late() {
    const mesh = new THREE.Mesh(square(), standard(null));
    draw(mesh, 'normal');
    mesh.material.normalMap = mapOf();
    return { mesh };
  },
  facets() {
    const geometry = new THREE.SphereGeometry(0.9, 24, 16);
    geometry.deleteAttribute('normal');
    const truth = (x, y) => {
      const [a, b] = [2 * x - 1, 2 * y - 1].map(c => c / 0.9), z = Math.sqrt(1 - a * a - b * b);
      return z > 0.4 ? [a / z, b / z] : undefined;
    };
    return { mesh: new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ flatShading: true })), truth };
  },
  noTangent() {
    const geometry = square({ gltf: true, tangents: true });
    for (let k = 0; k < 3; ++k) geometry.attributes.tangent.setXYZ(k, 0, 0, 0);
    return { mesh: new THREE.Mesh(geometry, standard(mapOf({ top: true }))) };
  },
  coatOfTwo() {
    const material = new THREE.MeshPhysicalMaterial({ clearcoat: 1, clearcoatNormalMap: mapOf({ channels: 2 }) });
    return { mesh: new THREE.Mesh(square(), material), what: 'clearcoatNormal', given: { ofThree: () => { material.clearcoatNormalMap = mapOf(); } } };
  },
  coat() {
    const map = mapOf({ top: true });
    return { mesh: new THREE.Mesh(square({ gltf: true, tangents: true }), new THREE.MeshPhysicalMaterial({ clearcoat: 1, clearcoatNormalMap: map })), what: 'clearcoatNormal' };
  },
  mirroredInstance() {
    const mesh = new THREE.InstancedMesh(square(), standard(mapOf()), 1), matrix = new THREE.Matrix4().makeScale(-1, 1, 1);
    mesh.setMatrixAt(0, matrix);
    return { mesh, truth: scenes.mirroredMesh().truth, given: { matrix, k: 0 } };
  },
  twoChannels() { return { mesh: new THREE.Mesh(square(), new THREE.MeshNormalMaterial({ normalMap: mapOf({ channels: 2 }) })) }; },
};

// The normals that three.js shades with, four floats a pixel; the fourth is 0 where nothing is drawn.
function draw(mesh, what) {
  const { material } = mesh, { onBeforeCompile: before } = material, isNormal = material.isMeshNormalMaterial;
  if (!isNormal) {
    material.onBeforeCompile = (shader, given) => {
      before.call(material, shader, given);
      shader.fragmentShader = shader.fragmentShader.replace('#include <dithering_fragment>', `gl_FragColor = vec4( ${what}, 1.0 );`);
    };
  }
  renderer.setRenderTarget(target);
  renderer.setClearColor(0, 0);
  renderer.clear();
  renderer.render(mesh.parent ?? new THREE.Scene().add(mesh), camera);
  const pixels = new Float32Array(kSize * kSize * 4);
  renderer.readRenderTargetPixels(target, 0, 0, kSize, kSize, pixels);
  material.onBeforeCompile = before;
  return isNormal ? pixels.map((c, k) => (k % 4 < 3 && pixels[k | 3] > 0.5 ? 2 * c - 1 : c)) : pixels;
}

// Returns the pixels that show the surface, those of them that are not numbers, and the mean angle of the others in degrees.
function judged(mesh, truth, what) {
  const pixels = draw(mesh, what), found = { drawn: 0, broken: 0, degrees: NaN };
  let sum = 0;
  for (let y = 0; y < kSize; ++y)
    for (let x = 0; x < kSize; ++x) {
      const k = 4 * (y * kSize + x), slopes = truth((x + 0.5) / kSize, (y + 0.5) / kSize);
      if (!(pixels[k + 3] > 0.5) || !slopes) continue;
      ++found.drawn;
      const n = new THREE.Vector3(...pixels.subarray(k, k + 3));
      if (n.toArray().every(Number.isFinite) && n.length() > 0.5) sum += THREE.MathUtils.radToDeg(n.angleTo(new THREE.Vector3(...slopes, 1)));
      else ++found.broken;
    }
  found.degrees = sum / (found.drawn - found.broken);
  return found;
}

// Draws a scene as it is, and after a line of the page.
export function measure(name, line) {
  const { mesh, truth = slopesAt, what = 'normal', given = {} } = scenes[name](), before = judged(mesh, truth, what);
  const { geometry, material } = mesh, map = material.normalMap;
  const names = { THREE, untangle, mesh, geometry, material, map, ...given };
  new Function(...Object.keys(names), line)(...Object.values(names));
  return { before, after: judged(mesh, truth, what), tangents: !!mesh.geometry.attributes.tangent };
}
