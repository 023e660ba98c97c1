// Directions of grooves and normals of coats that three.js draws of curved surfaces whose maps have texture coordinates of
// their own, beside those of the surfaces' formulas. For three_directions_test.mjs.
const kSize = 256, kSegments = 48;

// Points of a surface and their derivatives by its parameters a and b, which lie within `from` and `to`.
const kSurfaces = {
  plane: { from: [-1, -1], to: [1, 1], at: (a, b) => [[a, b, 0], [1, 0, 0], [0, 1, 0]] },
  sphere: { from: [-1.7, -1.2], to: [1.7, 1.2], at: (a, b) => {
    const [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
    return [[sa * cb, sb, ca * cb], [ca * cb, 0, -sa * cb], [-sa * sb, cb, -ca * sb]];
  } },
  torus: { from: [-3.1, -3.1], to: [3.1, 3.1], at: (a, b) => {
    const [ca, sa, cb, sb] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)], r = 0.75 + 0.35 * cb;
    return [[ca * r, sa * r, 0.35 * sb], [-sa * r, ca * r, 0], [-0.35 * ca * sb, -0.35 * sa * sb, 0.35 * cb]];
  } },
};

// Texture coordinates of set 0 and set 1, as rows of what a and b are multiplied with: sheared by 45 degrees and turned by 30,
// and turned by 70.
const turn = degrees => { const angle = degrees * Math.PI / 180; return [Math.cos(angle), Math.sin(angle)]; };
const [c0, s0] = turn(30), [c1, s1] = turn(70);
const kSets = [[c0, c0 - s0, s0, s0 + c0], [c1, -s1, s1, c1]];

// What a material has: its maps by texture coordinate set, by how much their textures are turned, what is drawn, and the set
// that it must follow. rotation: of the directions, from u towards v. anisotropy: where the coat is drawn. mirrored: the mesh is.
export const kCases = {
  'no maps': { maps: {}, draws: 'along', set: 0 },
  'no maps, rotation': { maps: {}, draws: 'along', set: 0, rotation: 0.6 },
  'no maps, rotation, mirrored mesh': { maps: {}, draws: 'along', set: 0, rotation: 0.6, mirrored: true },
  'map of grooves on set 1': { maps: { anisotropyMap: 1 }, draws: 'along', set: 1 },
  'map of grooves, texture turned': { maps: { anisotropyMap: 1 }, turned: { anisotropyMap: 0.5 }, draws: 'along', set: 1 },
  'bumps on set 0, map of grooves on set 1': { maps: { normalMap: 0, anisotropyMap: 1 }, draws: 'along', set: 0 },
  'bumps on set 1, map of grooves on set 0': { maps: { normalMap: 1, anisotropyMap: 0 }, draws: 'along', set: 1 },
  'coat on set 1, map of grooves on set 0': { maps: { clearcoatNormalMap: 1, anisotropyMap: 0 }, draws: 'along', set: 0 },
  'coat on set 1 over grooves of set 0': { maps: { clearcoatNormalMap: 1, anisotropyMap: 0 }, draws: 'coat', set: 1, anisotropy: 0.5 },
  'coat on set 1, bumps on set 0': { maps: { normalMap: 0, clearcoatNormalMap: 1 }, draws: 'coat', set: 1 },
  'coat on set 1, texture turned, bumps on set 0': { maps: { normalMap: 0, clearcoatNormalMap: 1 }, turned: { clearcoatNormalMap: 0.5 }, draws: 'coat', set: 1 },
};
const kCoat = [0.4, 0.25, Math.sqrt(1 - 0.16 - 0.0625)]; // the normal in the coat's map

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2], cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
const unit = a => { const l = Math.hypot(...a); return a.map(x => x / l); }, sum = (a, x, b, y) => a.map((v, i) => v * x + b[i] * y);

// The matrix of the texture coordinates that a map is read with; three turns them by [c, s; -s, c].
const matrixOf = (set, turned = 0) => { const [a, b, c, d] = kSets[set], [x, y] = [Math.cos(turned), Math.sin(turned)]; return [x * a + y * c, x * b + y * d, x * c - y * a, x * d - y * b]; };

// The unit direction of constant v and increasing u, the one across it towards increasing v, and the normal.
function frameAt(surface, a, b, [p, q, r, s]) {
  const [, pa, pb] = surface.at(a, b), side = Math.sign(p * s - q * r), t = unit(sum(pa, s * side, pb, -r * side)), n = unit(cross(pa, pb));
  return { t, b: cross(n, t).map(x => x * side), n };
}

function geometryOf(THREE, surface, stored) {
  const geometry = new THREE.BufferGeometry(), all = { position: [], normal: [], uv: [], uv1: [], uv2: [], tangent: [] }, index = [], m = kSegments + 1;
  for (let j = 0; j < m; ++j)
    for (let i = 0; i < m; ++i) {
      const [a, b] = [i, j].map((k, axis) => surface.from[axis] + (surface.to[axis] - surface.from[axis]) * k / kSegments), { t, n, b: across } = frameAt(surface, a, b, kSets[stored ?? 0]);
      all.position.push(...surface.at(a, b)[0]);
      all.normal.push(...n);
      kSets.forEach(([p, q, r, s], set) => all[set ? 'uv1' : 'uv'].push(p * a + q * b, r * a + s * b));
      all.uv2.push(a, b);
      all.tangent.push(...t, Math.sign(dot(cross(n, t), across)));
      const k = j * m + i;
      if (i < kSegments && j < kSegments) index.push(k, k + 1, k + m, k + m, k + 1, k + m + 1);
    }
  for (const [name, values] of Object.entries(all))
    if (name !== 'tangent' || stored !== undefined) geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, { position: 3, normal: 3, tangent: 4 }[name] ?? 2));
  return geometry.setIndex(index);
}

function materialOf(THREE, { maps, turned = {}, draws, rotation = 0, anisotropy = draws === 'along' ? 0.5 : 0 }) {
  const material = new THREE.MeshPhysicalMaterial({ side: THREE.DoubleSide, clearcoat: draws === 'coat' ? 1 : 0, anisotropy, anisotropyRotation: rotation });
  for (const [name, channel] of Object.entries(maps)) {
    const texel = name === 'anisotropyMap' ? [1, 0.5, 1, 1] : name === 'normalMap' ? [0.5, 0.5, 1, 1] : [...kCoat.map(x => (1 + x) / 2), 1];
    const map = new THREE.DataTexture(new Uint16Array(texel.map(THREE.DataUtils.toHalfFloat)), 1, 1, THREE.RGBAFormat, THREE.HalfFloatType);
    Object.assign(map, { channel, rotation: turned[name] ?? 0, needsUpdate: true });
    material[name] = map;
  }
  return material;
}

const kWays = {
  stock: { change: () => {} },
  'stock, tangents': { stored: true, change: () => {} },
  untangled: { change: (untangle, mesh) => untangle(mesh, { note() {} }) },
  'untangled, tangents': { stored: true, change: (untangle, mesh) => untangle(mesh, { note() {} }) },
  'untangled, tangents stay': { stored: true, change: (untangle, mesh) => untangle(mesh, { note() {}, maxDegrees: 1e-9 }) },
};
for (const frame of ['orthonormal', 'cotangent', 'smooth', 'triangle']) kWays[frame] = { change: (untangle, mesh, renderer) => untangle(mesh, { frame, note() {}, ...renderer.isWebGPURenderer && { renderer } }) };

const kAll = [{ surfaces: Object.keys(kSurfaces), cases: Object.keys(kCases), ways: Object.keys(kWays) }];

// { pixels, mean, most, tangents } by surface, case and way: degrees from the truth, and whether the mesh still has tangents. kind:
// 'webgl', or for WebGPURenderer 'nodes' on WebGL 2 and 'webgpu'. Stored tangents are those of bumps, else of the map of grooves, else right.
export async function measure(kind, asked = kAll) {
  const THREE = await import(kind === 'webgl' ? 'three' : 'three/webgpu'), tsl = kind !== 'webgl' && await import('three/tsl'), found = {};
  const { untangle } = await import(kind === 'webgl' ? '/package/three/index.js' : '/package/three/tsl.js');
  const renderer = kind === 'webgl' ? new THREE.WebGLRenderer() : new THREE.WebGPURenderer({ forceWebGL: kind === 'nodes' });
  await renderer.init?.();
  if (kind === 'webgpu' && !renderer.backend.isWebGPUBackend) return null;
  const target = new (kind === 'webgl' ? THREE.WebGLRenderTarget : THREE.RenderTarget)(kSize, kSize, { type: THREE.FloatType });
  renderer.setClearColor(0, 0);
  const camera = new THREE.OrthographicCamera(-1.2, 1.2, 1.2, -1.2, 0.1, 10);
  camera.position.z = 3;
  const draw = async mesh => {
    renderer.setRenderTarget(target);
    renderer.clear?.();
    renderer.render(new THREE.Scene().add(mesh, new THREE.DirectionalLight()), camera);
    if (tsl) return renderer.readRenderTargetPixelsAsync(target, 0, 0, kSize, kSize);
    const pixels = new Float32Array(kSize * kSize * 4);
    renderer.readRenderTargetPixels(target, 0, 0, kSize, kSize, pixels);
    return pixels;
  };
  const showing = (material, what) => {
    if (tsl) { material.outputNode = tsl.vec4(what === 'along' ? tsl.anisotropyT : tsl.clearcoatNormalView, 1); return; }
    const before = material.onBeforeCompile;
    material.onBeforeCompile = (shader, given) => {
      before.call(material, shader, given);
      shader.fragmentShader = shader.fragmentShader.replace('#include <dithering_fragment>', `gl_FragColor = vec4( ${what === 'along' ? 'material.anisotropyT' : 'clearcoatNormal'}, 1.0 );`);
    };
  };
  const parametersOf = () => {
    if (tsl) { const material = new THREE.MeshBasicNodeMaterial({ side: THREE.DoubleSide }); material.outputNode = tsl.vec4(tsl.uv(2), 0, 1); return material; }
    return new THREE.ShaderMaterial({ side: THREE.DoubleSide, vertexShader: 'attribute vec2 uv2; varying vec2 at; void main() { at = uv2; gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 ); }',
      fragmentShader: 'varying vec2 at; void main() { gl_FragColor = vec4( at, 0.0, 1.0 ); }' });
  };
  const parametersDrawn = {};
  const one = async (name, label, way) => {
    const surface = kSurfaces[name], { set, draws, turned = {}, rotation = 0, maps, mirrored } = kCases[label], { stored, change } = kWays[way];
    const placed = mesh => { if (mirrored) mesh.scale.x = -1; return mesh; }, seen = ([x, y, z]) => (mirrored ? [-x, y, z] : [x, y, z]);
    const parameters = parametersDrawn[[name, mirrored]] ??= await draw(placed(new THREE.Mesh(geometryOf(THREE, surface), parametersOf())));
    const reader = draws === 'coat' ? 'clearcoatNormalMap' : ['normalMap', 'anisotropyMap', 'clearcoatNormalMap'].find(key => key in maps), matrix = matrixOf(set, turned[reader]);
    const mesh = placed(new THREE.Mesh(geometryOf(THREE, surface, stored && (maps.normalMap ?? maps.anisotropyMap ?? set)), materialOf(THREE, kCases[label])));
    change(untangle, mesh, renderer);
    showing(mesh.material, draws);
    const pixels = await draw(mesh), degrees = [];
    for (let i = 0; i < pixels.length; i += 4) {
      if (!(parameters[i + 3] > 0 && pixels[i + 3] > 0)) continue;
      const { t, b, n } = frameAt(surface, parameters[i], parameters[i + 1], matrix);
      if (n[2] < 0.2) continue; // silhouettes, and backs
      const truth = draws === 'coat' ? sum(sum(t, kCoat[0], b, kCoat[1]), 1, n, kCoat[2]) : sum(t, Math.cos(rotation), b, Math.sin(rotation));
      const drawn = [pixels[i], pixels[i + 1], pixels[i + 2]];
      degrees.push(Math.atan2(Math.hypot(...cross(drawn, seen(truth))), dot(drawn, seen(truth))) * 180 / Math.PI);
    }
    const tangents = !!mesh.geometry.attributes.tangent;
    mesh.geometry.dispose();
    mesh.material.dispose();
    return { pixels: degrees.length, mean: degrees.reduce((x, y) => x + y, 0) / degrees.length, most: degrees.reduce((x, y) => Math.max(x, y), 0), tangents };
  };
  for (const { surfaces, cases, ways } of asked)
    for (const name of surfaces) for (const label of cases) for (const way of ways) ((found[name] ??= {})[label] ??= {})[way] = await one(name, label, way);
  renderer.dispose();
  return found;
}

// A model with the tangents of its file and after untangle(): mean degrees between the directions of grooves that stock three
// draws, the frames that were taken, and whether tangents are left.
export async function measureModel(url) {
  const THREE = await import('three'), { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js'), { untangle } = await import('/package/three/index.js');
  const renderer = new THREE.WebGLRenderer(), target = new THREE.WebGLRenderTarget(kSize, kSize, { type: THREE.FloatType }), views = [], frames = new Set();
  renderer.setClearColor(0, 0);
  let tangents = 0;
  for (const change of [() => {}, gltf => untangle(gltf, { note() {} }).forEach(({ frame, material }) => { if (material.anisotropy > 0) frames.add(frame); })]) {
    const gltf = await new GLTFLoader().loadAsync(url), box = new THREE.Box3().setFromObject(gltf.scene), sphere = box.getBoundingSphere(new THREE.Sphere()), { radius } = sphere;
    change(gltf);
    tangents = 0;
    gltf.scene.traverse(child => {
      if (!child.isMesh) return;
      child.visible = child.material.anisotropy > 0;
      tangents += child.visible && child.geometry.attributes.tangent ? 1 : 0;
      const { material } = child, before = material.onBeforeCompile;
      material.onBeforeCompile = (shader, given) => {
        before.call(material, shader, given);
        shader.fragmentShader = shader.fragmentShader.replace('#include <dithering_fragment>', 'gl_FragColor = vec4( normalize( material.anisotropyT ), 1.0 );');
      };
    });
    const camera = new THREE.OrthographicCamera(-radius, radius, radius, -radius, 0.1 * radius, 5 * radius), pixels = new Float32Array(kSize * kSize * 4);
    camera.position.copy(sphere.center).add(new THREE.Vector3(0.1, 0.15, 1).normalize().multiplyScalar(3 * radius));
    camera.lookAt(sphere.center);
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(new THREE.Scene().add(gltf.scene, new THREE.DirectionalLight()), camera);
    renderer.readRenderTargetPixels(target, 0, 0, kSize, kSize, pixels);
    views.push(pixels);
  }
  let total = 0, count = 0;
  const [a, b] = views;
  for (let i = 0; i < a.length; i += 4) {
    if (!(a[i + 3] > 0.5 && b[i + 3] > 0.5)) continue;
    const p = a.subarray(i, i + 3), q = b.subarray(i, i + 3);
    total += Math.atan2(Math.hypot(...cross(p, q)), Math.abs(dot(p, q))) * 180 / Math.PI;
    ++count;
  }
  return { pixels: count, mean: total / count, frames: [...frames], tangents };
}
