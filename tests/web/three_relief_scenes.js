// What three_relief_test.mjs asks of each renderer. Every function gets { THREE, drawing, addRelief, untangle }.
import { cameraAt, Drawing, groundMesh, heightTexture, kGrounds, kRelief, kSize, shadowsAgree, showingUv, texelsOff } from './three_relief.js';

const kDepth = 0.06;

// way: webgl: WebGLRenderer; nodes webgl, nodes webgpu: WebGPURenderer with that backend.
export async function opened(way) {
  const isNode = way.startsWith('nodes'), folder = '/package/three';
  const THREE = await import(isNode ? 'three/webgpu' : 'three');
  const { addRelief } = await import(`${folder}/${isNode ? 'relief_nodes' : 'relief'}.js`), { untangle } = await import(`${folder}/${isNode ? 'tsl' : 'index'}.js`);
  const renderer = isNode ? new THREE.WebGPURenderer({ forceWebGL: way === 'nodes webgl' }) : new THREE.WebGLRenderer();
  await renderer.init?.();
  if (way === 'nodes webgpu' && !renderer.backend.isWebGPUBackend) return undefined;
  return { THREE, drawing: new Drawing(THREE, renderer), addRelief, untangle };
}

const relief = (THREE, more = {}) => ({ heightMap: heightTexture(THREE), heightDepth: kDepth, heightSteps: 64, ...more });

// Texels from the truth, with the relief and without.
export async function truth({ THREE, drawing, addRelief }) {
  const found = {};
  for (const [name, degrees] of [['plane', 55], ['cylinder', 40]]) {
    const ground = kGrounds[name], camera = cameraAt(THREE, degrees), plain = groundMesh(THREE, ground, showingUv(THREE));
    const without = texelsOff(THREE, ground, camera, kDepth, await drawing.draw(camera, plain));
    addRelief(plain.material, relief(THREE));
    found[name] = { ...texelsOff(THREE, ground, camera, kDepth, await drawing.draw(camera, plain)), without: without.mean };
  }
  return found;
}

// Texels from the truth for other sides, shading and uv sets; `other set` has its map on a set that the height map is not on, and
// is compared with the drawing without relief.
export async function kinds({ THREE, drawing, addRelief }) {
  const camera = cameraAt(THREE, 50), found = {};
  const inside = ({ geometry: { attributes: { normal }, index } }) => { normal.array.forEach((x, k, all) => { all[k] = -x; }); index.array.reverse(); };
  const onSet1 = ({ geometry, material }) => { geometry.setAttribute('uv1', geometry.attributes.uv); geometry.setAttribute('uv', geometry.attributes.uv.clone()); material.emissiveMap.channel = 1; };
  for (const [name, change, channel = 0] of [
    ['flat', ({ material }) => { material.flatShading = true; }], ['flat, double', ({ material }) => { Object.assign(material, { flatShading: true, side: THREE.DoubleSide }); }],
    ['double', ({ material }) => { material.side = THREE.DoubleSide; }], ['back', mesh => { inside(mesh); mesh.material.side = THREE.BackSide; }],
    ['mirrored', mesh => { mesh.scale.x = -1; }], ['scaled', mesh => { mesh.scale.setScalar(2); mesh.geometry.attributes.position.array.forEach((x, k, all) => { all[k] = x / 2; }); }],
    ['matrix', () => {}], ['set 1', onSet1, 1], ['other set', mesh => { onSet1(mesh); mesh.material.emissiveMap.channel = 0; }, 1]]) {
    const material = showingUv(THREE), mesh = groundMesh(THREE, kGrounds.plane, material), options = relief(THREE);
    change(mesh);
    options.heightMap.channel = channel;
    const { heightMap } = options, field = { ...kRelief };
    if (name === 'matrix') {
      Object.assign(heightMap, { rotation: 0.5 }).repeat.set(1.3, 0.8);
      heightMap.offset.set(0.2, 0.1);
      heightMap.updateMatrix();
      field.matrix = heightMap.matrix.elements;
    }
    const before = name === 'other set' && await drawing.draw(camera, mesh);
    addRelief(material, options);
    const after = await drawing.draw(camera, mesh);
    found[name] = before ? Math.max(...before.map((x, k) => Math.abs(x - after[k]))) : texelsOff(THREE, kGrounds.plane, camera, kDepth, after, { relief: field }).mean;
  }
  return found;
}

// Two halves of one drawing, left and right of x = 0: two materials on one map with two depths, then with two maps and one
// depth. Texels from the truth of each; then the same with the materials exchanged at run time.
export async function pairs({ THREE, drawing, addRelief }) {
  const camera = cameraAt(THREE, 50), found = {}, one = heightTexture(THREE);
  const other = { side: kRelief.side, data: kRelief.data.map(height => Math.round(255 - 0.5 * height)) }, second = heightTexture(THREE, other);
  for (const [name, given] of [['depths', [[one, kRelief, 0.06], [one, kRelief, 0.02]]], ['maps', [[one, kRelief, 0.06], [second, other, 0.06]]]]) {
    const halves = given.map(([heightMap, field, heightDepth], k) => {
      const mesh = groundMesh(THREE, kGrounds.plane, addRelief(showingUv(THREE), relief(THREE, { heightMap, heightDepth })));
      mesh.geometry.setDrawRange(6 * k, 6);
      return { mesh, field, heightDepth, heightMap, isMeasured: p => (k ? p.x > 0.02 : p.x < -0.02) };
    });
    const measure = async () => {
      const pixels = await drawing.draw(camera, ...halves.map(({ mesh }) => mesh));
      return halves.map(({ mesh, isMeasured }) => {
        const field = mesh.material.heightMap === one ? kRelief : other;
        return texelsOff(THREE, kGrounds.plane, camera, mesh.material.heightDepth, pixels, { relief: field, isMeasured }).mean;
      });
    };
    found[name] = await measure();
    const [a, b] = halves;
    Object.assign(a.mesh.material, { heightMap: b.heightMap, heightDepth: b.heightDepth });
    Object.assign(b.mesh.material, { heightMap: a.heightMap, heightDepth: a.heightDepth });
    found[`${name}, exchanged`] = await measure();
  }
  return found;
}

// Maximum difference between drawings with and without the relief of a map whose mips have a colour each: the relief may not
// change which mip is read.
export async function mips({ THREE, drawing, addRelief }) {
  const side = 256, levels = [];
  for (let n = side, k = 0; n >= 1; n /= 2, ++k) levels.push({ data: new Uint8Array(n * n * 4).fill(25 * k), width: n, height: n });
  const map = new THREE.DataTexture(levels[0].data, side, side);
  Object.assign(map, { mipmaps: levels, generateMipmaps: false, minFilter: THREE.LinearMipmapLinearFilter, magFilter: THREE.LinearFilter, needsUpdate: true, wrapS: THREE.RepeatWrapping, wrapT: THREE.RepeatWrapping });
  map.repeat.set(7, 5);
  const material = new THREE.MeshStandardMaterial({ color: 0, roughness: 1, emissive: 'white', emissiveMap: map }), mesh = groundMesh(THREE, kGrounds.plane, material), camera = cameraAt(THREE, 55);
  const before = await drawing.draw(camera, mesh);
  addRelief(material, relief(THREE));
  const after = await drawing.draw(camera, mesh);
  return { levels: new Set(Array.from(before, x => Math.floor(x * 10))).size, worst: Math.max(...before.map((x, k) => Math.abs(x - after[k]))) };
}

// Agreement of the relief's own shadow with rays to the light.
export async function shadow({ THREE, drawing, addRelief }) {
  const camera = cameraAt(THREE, 20), depth = 0.08, light = new THREE.DirectionalLight('white', 3), to = new THREE.Vector3(0.9, 0.4, 1).normalize();
  light.position.copy(to);
  const draw = async selfShadow => {
    const material = addRelief(new THREE.MeshLambertMaterial(), relief(THREE, { heightDepth: depth, selfShadow }));
    return drawing.draw(camera, groundMesh(THREE, kGrounds.plane, material), light);
  };
  const lit = await draw(false), shaded = await draw(true), ratio = Float32Array.from({ length: kSize * kSize }, (_, k) => shaded[4 * k] / lit[4 * k]);
  return shadowsAgree(THREE, kGrounds.plane, camera, depth, to, ratio);
}

// A map of smooth colours, with its own matrix.
function colours(THREE, k, low, high) {
  const side = 64, data = new Uint8Array(side * side * 4);
  for (let y = 0; y < side; ++y)
    for (let x = 0; x < side; ++x)
      for (let c = 0; c < 4; ++c) data[4 * (y * side + x) + c] = 255 * (low + (high - low) * (0.5 + 0.5 * Math.sin(2 * Math.PI * ((c + 1) * x + (k % 3) * y) / side + c + k)));
  const map = new THREE.DataTexture(data, side, side);
  Object.assign(map, { wrapS: THREE.RepeatWrapping, wrapT: THREE.RepeatWrapping, magFilter: THREE.LinearFilter, minFilter: THREE.LinearFilter, needsUpdate: true, rotation: 0.1 * k });
  map.repeat.set(1 + 0.1 * k, 1);
  return map;
}

const kMaps = ['map', 'alphaMap', 'normalMap', 'roughnessMap', 'metalnessMap', 'emissiveMap', 'aoMap', 'lightMap', 'clearcoatMap', 'clearcoatNormalMap', 'clearcoatRoughnessMap',
  'sheenColorMap', 'sheenRoughnessMap', 'iridescenceMap', 'iridescenceThicknessMap', 'specularIntensityMap', 'specularColorMap', 'anisotropyMap'];

const kMapsOfNodes = ['map', 'normalMap', 'clearcoatNormalMap', 'anisotropyMap', 'aoMap']; // nodes read all others as `map`

// A flat relief at a constant height, seen without perspective, is the surface with shifted coordinates. Greatest difference
// in 255 between the two for each map, also with cotan's frames; and how much the shift changes, which is the signal.
export async function everyMap({ THREE, drawing, addRelief, untangle }) {
  const { renderer } = drawing;
  const height = 51, camera = new THREE.OrthographicCamera(-0.6, 0.6, 0.6, -0.6, 0.1, 10), found = {}, angle = 0.7;
  camera.position.set(0.4, -Math.sin(angle) * 2, Math.cos(angle) * 2);
  camera.lookAt(0.4, 0, 0);
  const flat = heightTexture(THREE, { side: 4, data: new Uint8Array(16).fill(height) });
  // x > 0: grad u = (1, 1), grad v = (0, -1). The line of sight sinks by 0.8 of the depth.
  const travel = (1 - height / 255) * 0.2 * Math.tan(angle), shift = [travel, -travel];
  const light = new THREE.DirectionalLight('white', 3);
  light.position.set(1, 1, 2);
  const materialOf = (names, anisotropy) => new THREE.MeshPhysicalMaterial({
    roughness: 0.6, metalness: 0.5, emissive: 0x444444, clearcoat: 0.7, clearcoatRoughness: 0.3, sheen: 0.5, sheenColor: 'white', iridescence: 0.8, specularColor: 'white', anisotropy, transparent: names.includes('alphaMap'),
    ...Object.fromEntries(names.map(name => [name, colours(THREE, kMaps.indexOf(name), name.endsWith('ormalMap') ? 0.35 : 0, name.endsWith('ormalMap') ? 0.65 : 1)])) });
  const apart = (a, b) => Math.max(...a.map((x, k) => Math.abs(x - b[k]))) * 255;
  const several = ['map', 'normalMap', 'roughnessMap', 'clearcoatNormalMap'], single = renderer.isWebGPURenderer ? kMapsOfNodes : kMaps;
  for (const [name, names] of [...single.map(name => [name, [name]]), ['several', several], ['several, untangled', several]]) {
    const draw = async (isMoved, uvShift) => {
      const material = materialOf(names, name === 'anisotropyMap' ? 0.9 : 0), mesh = groundMesh(THREE, kGrounds.plane, material, uvShift);
      mesh.geometry.setDrawRange(6, 6); // without the mirrored half
      if (name.endsWith('untangled')) untangle(mesh);
      if (isMoved) addRelief(material, { heightMap: flat, heightDepth: 0.2, heightSteps: 64 });
      return drawing.draw(camera, mesh, light, new THREE.AmbientLight('white', 1));
    };
    const plain = await draw(false, [0, 0]), moved = await draw(true, [0, 0]), expected = await draw(false, shift);
    found[name] = { off: apart(moved, expected), signal: apart(plain, expected) };
  }
  return found;
}

// Numbers of values that are not finite, and the difference to the drawing without relief, for input that has no relief.
export async function degenerate({ THREE, drawing, addRelief }) {
  const found = {}, camera = cameraAt(THREE, 50), grazing = cameraAt(THREE, 89.9), edge = cameraAt(THREE, 90);
  const light = new THREE.DirectionalLight('white', 3);
  light.position.set(1, 0, 0.3);
  const cases = {
    zeroDepth: { depth: 0 }, nanDepth: { depth: NaN }, endlessDepth: { depth: Infinity }, negativeDepth: { depth: -1 }, noMap: { map: null },
    constantUv: { uv: () => [0.3, 0.3] }, noUv: { remove: 'uv' }, uvOnALine: { uv: (u) => [u, 2 * u], changes: true }, nanUv: { uv: () => [NaN, 0], changes: true },
    zeroNormals: { zero: 'normal', changes: true }, behind: { camera: cameraAt(THREE, 130) }, grazing: { camera: grazing, changes: true }, edgeOn: { camera: edge, changes: true },
    lightBehind: { light: [0, 0, -1], changes: true },
  };
  for (const [name, { depth = kDepth, map, uv, remove, zero, camera: from = camera, light: to = [1, 0, 0.3], changes = false }] of Object.entries(cases)) {
    const draw = async (isMoved) => {
      const material = showingUv(THREE), mesh = groundMesh(THREE, kGrounds.plane, material), { attributes } = mesh.geometry;
      Object.assign(material, { side: THREE.DoubleSide, color: new THREE.Color('grey') });
      if (uv) for (let k = 0; k < attributes.uv.count; ++k) attributes.uv.setXY(k, ...uv(attributes.uv.getX(k)));
      if (remove) mesh.geometry.deleteAttribute(remove);
      if (zero) attributes[zero].array.fill(0);
      light.position.set(...to);
      if (isMoved) {
        addRelief(material, relief(THREE));
        if (map === null) material.heightMap = null;
        material.heightDepth = depth;
      }
      return drawing.draw(from, mesh, light);
    };
    const plain = await draw(false), moved = await draw(true), wasFinite = plain.every(Number.isFinite);
    found[name] = { broken: wasFinite ? moved.filter(x => !Number.isFinite(x)).length : 0, apart: changes ? 0 : Math.max(...plain.map((x, k) => Math.abs(x - moved[k]))) };
  }
  return found;
}

// Numbers of pixels that differ between orders of calls, and for clones: all have the relief and the frame.
export async function calls({ THREE, drawing, addRelief, untangle }) {
  const camera = cameraAt(THREE, 50), light = new THREE.DirectionalLight('white', 3), options = relief(THREE), normalMap = colours(THREE, 2, 0.35, 0.65);
  light.position.set(1, 1, 2);
  const draw = async (...steps) => {
    const mesh = groundMesh(THREE, kGrounds.plane, new THREE.MeshStandardMaterial({ normalMap, roughness: 0.5 }));
    for (const step of steps) await step(mesh);
    return drawing.draw(camera, mesh, light);
  };
  const add = ({ material }) => addRelief(material, options), frame = mesh => untangle(mesh, { frame: 'orthonormal', note() {} });
  const clone = mesh => { mesh.material = mesh.material.clone(); }, drawn = mesh => drawing.draw(camera, mesh, light), none = ({ material }) => Object.assign(material, { heightMap: null, needsUpdate: true });
  const differ = (a, b) => { let count = 0; for (let k = 0; k < a.length; k += 4) count += Math.abs(a[k] - b[k]) > 2e-3; return count; };
  const whole = await draw(frame, add), plain = await draw(frame), stock = await draw();
  return {
    signal: [differ(whole, plain), differ(plain, stock)],
    same: Object.fromEntries(Object.entries({
      reliefFirst: await draw(add, frame), drawnBetween: await draw(drawn, frame, drawn, add), clone: await draw(frame, add, clone), cloneOfClone: await draw(add, clone, frame, clone), twice: await draw(add, frame, add),
    }).map(([name, pixels]) => [name, differ(whole, pixels)])),
    removed: differ(plain, await draw(frame, add, drawn, none)),
  };
}

// A drawing of the relief.
export function images({ THREE, drawing, addRelief }) {
  return drawing.draw(cameraAt(THREE, 55), groundMesh(THREE, kGrounds.plane, addRelief(showingUv(THREE), relief(THREE))));
}
