// Scenes with cotan/three/relief, and rays against the displaced surface, which are the truth. For three_relief_test.mjs.
// THREE: the module of the renderer under test.

export const kSize = 128, kTexels = 512; // of the drawing; of a map, per unit of uv
const kScale = 0.25, kOffset = 0.5; // of the matrix of the map that shows texture coordinates

// Domes and boxes, from 0 to 1. Read as a GPU does it: bilinearly, repeated.
export const kRelief = (() => {
  const side = 256, data = new Uint8Array(side * side);
  for (let y = 0; y < side; ++y)
    for (let x = 0; x < side; ++x) {
      const u = (4 * (x + 0.5) / side) % 2 - 1, v = (4 * (y + 0.5) / side) % 2 - 1, isBox = x < side / 2 !== y < side / 2;
      const height = isBox ? (Math.max(Math.abs(u), Math.abs(v)) < 0.6 ? 0.9 : 0.1) : Math.max(0, 0.9 * (1 - 1.4 * (u * u + v * v))) + 0.1;
      data[y * side + x] = Math.round(255 * height);
    }
  return { side, data };
})();

export function heightAt({ side, data, matrix: m }, u, v) {
  if (m) [u, v] = [m[0] * u + m[3] * v + m[6], m[1] * u + m[4] * v + m[7]];
  const x = u * side - 0.5, y = v * side - 0.5, i = Math.floor(x), j = Math.floor(y), a = x - i, b = y - j;
  const at = (i, j) => data[((j % side) + side) % side * side + ((i % side) + side) % side] / 255;
  return (at(i, j) * (1 - a) + at(i + 1, j) * a) * (1 - b) + (at(i, j + 1) * (1 - a) + at(i + 1, j + 1) * a) * b;
}

export function heightTexture(THREE, { side, data } = kRelief) {
  const map = new THREE.DataTexture(data, side, side, THREE.RedFormat);
  map.wrapS = map.wrapT = THREE.RepeatWrapping;
  map.magFilter = map.minFilter = THREE.LinearFilter;
  map.needsUpdate = true;
  return map;
}

// A map that shows where it is looked up: u and v, from -2 to 2.
function uvTexture(THREE) {
  const side = 64, data = new Uint16Array(side * side * 4), half = THREE.DataUtils.toHalfFloat;
  for (let y = 0; y < side; ++y) for (let x = 0; x < side; ++x) data.set([half((x + 0.5) / side), half((y + 0.5) / side), 0, half(1)], 4 * (y * side + x));
  const map = new THREE.DataTexture(data, side, side, THREE.RGBAFormat, THREE.HalfFloatType);
  map.magFilter = map.minFilter = THREE.LinearFilter;
  map.repeat.set(kScale, kScale);
  map.offset.set(kOffset, kOffset);
  map.needsUpdate = true;
  return map;
}

// Surfaces on which u = |x| + y and v = -y, unless they have a function `uv`: sheared by 45 degrees and mirrored at x = 0. The
// cylinder has the radius 1.
export const kGrounds = {
  plane: { along: p => p.x, above: p => p.z, point: (s, t) => [s, t, 0], normal: () => [0, 0, 1], columns: 2 },
  cylinder: {
    along: p => Math.atan2(p.x, p.z), above: p => Math.hypot(p.x, p.z) - 1,
    point: (s, t) => [Math.sin(s), t, Math.cos(s)], normal: s => [Math.sin(s), 0, Math.cos(s)], columns: 256,
  },
};
const sheared = (s, t) => [Math.abs(s) + t, -t];
const uvOf = (ground, p) => (ground.uv ?? sheared)(ground.along(p), p.y);

export function groundMesh(THREE, ground, material, uvShift = [0, 0]) {
  const { point, normal, columns, uv: uvAt = sheared } = ground, geometry = new THREE.BufferGeometry(), position = [], normals = [], uv = [], index = [];
  for (let i = 0; i <= columns; ++i)
    for (const t of [-1, 1]) {
      const s = 2 * i / columns - 1;
      position.push(...point(s, t));
      normals.push(...normal(s));
      uv.push(...uvAt(s, t).map((x, k) => x + uvShift[k]));
    }
  for (let i = 0; i < 2 * columns; i += 2) index.push(i, i + 2, i + 1, i + 1, i + 2, i + 3);
  for (const [name, values, width] of [['position', position, 3], ['normal', normals, 3], ['uv', uv, 2]])
    geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, width));
  geometry.setIndex(index);
  return new THREE.Mesh(geometry, material);
}

// A material that only shows where its map is looked up.
export const showingUv = THREE => new THREE.MeshStandardMaterial({ color: 0, roughness: 1, emissive: 'white', emissiveMap: uvTexture(THREE) });

// Renders into floats: rows from the bottom.
export class Drawing {
  constructor(THREE, renderer, size = kSize) {
    const Target = THREE.WebGLRenderTarget ?? THREE.RenderTarget;
    Object.assign(this, { THREE, renderer, target: new Target(size, size, { type: THREE.FloatType }), size });
    renderer.setClearColor(0, 0);
  }

  async draw(camera, ...objects) {
    const { renderer, target, THREE, size } = this, isNode = !THREE.WebGLRenderTarget || renderer.isWebGPURenderer;
    const scene = new THREE.Scene();
    scene.add(...objects);
    renderer.setRenderTarget(target);
    if (!isNode) renderer.clear();
    renderer.render(scene, camera);
    if (!isNode) {
      const pixels = new Float32Array(size * size * 4);
      renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
      return pixels;
    }
    const read = await renderer.readRenderTargetPixelsAsync(target, 0, 0, size, size);
    if (!renderer.backend.isWebGPUBackend) return read;
    const row = 4 * size, pixels = new Float32Array(size * row); // WebGPU gives the top row first, and rows of 256 bytes
    for (let y = 0; y < size; ++y) pixels.set(read.subarray(y * read.length / size, y * read.length / size + row), (size - 1 - y) * row);
    return pixels;
  }
}

export function cameraAt(THREE, degrees, distance = 3) {
  const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 100), angle = THREE.MathUtils.degToRad(degrees);
  camera.position.set(0.2, -Math.sin(angle) * distance, Math.cos(angle) * distance);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld();
  return camera;
}

// Calls use(pixel, origin, direction) for the ray of every pixel of a drawing with this many rows.
export function eachRay(THREE, camera, use, size = kSize) {
  const from = new THREE.Vector3(), to = new THREE.Vector3();
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      from.set((x + 0.5) / size * 2 - 1, (y + 0.5) / size * 2 - 1, -1).unproject(camera);
      to.set((x + 0.5) / size * 2 - 1, (y + 0.5) / size * 2 - 1, 1).unproject(camera).sub(from).normalize();
      use(y * size + x, from, to);
    }
}

// Where a ray meets the height field: small steps in space, then bisection. Undefined where it misses the ground or leaves it.
export function meets(THREE, ground, origin, direction, depth, relief) {
  const start = ground.columns === kGrounds.plane.columns ? -origin.z / direction.z : hitCylinder(origin, direction);
  if (!(start > 0)) return undefined;
  const p = new THREE.Vector3(), at = distance => p.copy(direction).multiplyScalar(start + distance).add(origin);
  const surface = at(0).clone();
  if (Math.abs(ground.along(p)) > 0.97 || Math.abs(p.y) > 0.97) return undefined;
  const inside = distance => {
    at(distance);
    return ground.above(p) <= (heightAt(relief, ...uvOf(ground, p)) - 1) * depth + 1e-9;
  };
  let low = 0, high = 0;
  const n = new THREE.Vector3(...ground.normal(ground.along(surface))), end = 1.6 * depth / Math.max(-n.dot(direction), 0.3);
  while (high < end && !inside(high)) {
    low = high;
    high += end / 600;
  }
  for (let i = 0; i < 25; ++i) {
    const middle = (low + high) / 2;
    if (inside(middle)) high = middle;
    else low = middle;
  }
  at(high);
  return { uv: uvOf(ground, p), point: p.clone(), surface };
}

function hitCylinder({ x, z }, d) {
  const a = d.x * d.x + d.z * d.z, b = x * d.x + z * d.z, root = b * b - a * (x * x + z * z - 1);
  return root > 0 ? (-b - Math.sqrt(root)) / a : NaN;
}

// Distances in texels between what a drawing of showingUv() looks up and where the rays meet. isMeasured: of a point. every: how
// many pixels to a measured one; the rays take most of the time. 3 has no common factor with the width.
export function texelsOff(THREE, ground, camera, depth, pixels, { relief = kRelief, isMeasured = () => true, size = kSize, every = 3 } = {}) {
  const errors = [];
  eachRay(THREE, camera, (pixel, origin, direction) => {
    const found = pixel % every === 0 && meets(THREE, ground, origin, direction, depth, relief);
    if (!found || !isMeasured(found.surface)) return;
    const [nx, , nz] = ground.normal(ground.along(found.surface));
    if (-(direction.x * nx + direction.z * nz) < 0.3) return;
    const [u, v] = [0, 1].map(i => (pixels[4 * pixel + i] - kOffset) / kScale);
    errors.push(Math.hypot(u - found.uv[0], v - found.uv[1]) * kTexels);
  }, size);
  errors.sort((a, b) => a - b);
  return { count: errors.length, mean: errors.reduce((sum, x) => sum + x, 0) / errors.length, most95: errors[Math.floor(0.95 * errors.length)] };
}

// The fraction of points on whose shadow the drawing and rays to the light agree. ratio: brightness of a pixel with the
// shadow over that without.
export function shadowsAgree(THREE, ground, camera, depth, light, ratio) {
  let agree = 0, dark = 0, count = 0;
  eachRay(THREE, camera, (pixel, origin, direction) => {
    const found = meets(THREE, ground, origin, direction, depth, kRelief);
    if (!found) return;
    const p = new THREE.Vector3(), end = -ground.above(found.point) / light.z;
    let deepest = Infinity; // of the ray to the light over the relief
    for (let k = 16; k <= 200; ++k) { // above the point itself
      p.copy(light).multiplyScalar(end * k / 200).add(found.point);
      deepest = Math.min(deepest, ground.above(p) / depth + 1 - heightAt(kRelief, ...uvOf(ground, p)));
    }
    if (Math.abs(deepest) < 0.03) return; // grazing: decided by where the readings fall
    ++count;
    const isDark = ratio[pixel] < 0.5;
    dark += isDark;
    agree += isDark === deepest < 0;
  });
  return { count, dark: dark / count, agree: agree / count };
}
