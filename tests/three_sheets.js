// Scenes of the sheet that three.js draws with both of its renderers.

const sheetTexels = 128;

function sheetMap(THREE) {
  const map = new THREE.DataTexture(domeTexels(sheetTexels), sheetTexels, sheetTexels);
  map.wrapS = map.wrapT = THREE.RepeatWrapping;
  map.needsUpdate = true;
  return map;
}

// Two by two units, the left half mirrored. uv set 1 is set 0 rotated by 90 degrees. stored: 0 without tangents; else
// bitangents run along v (1) or against it (-1).
function sheetGeometry(THREE, chart, stored) {
  const position = [], normal = [], uv = [], uv1 = [], tangent = [];
  sheetCorners(chart).forEach(([x, y, u, v], corner) => {
    position.push(x, y, 0);
    normal.push(0, 0, 1);
    uv.push(u, v);
    uv1.push(-v, u);
    const [t, b] = chartFrame(chart, corner < 6 ? -1 : 1, 'orthonormal');
    tangent.push(t[0], t[1], 0, Math.sign(t[0] * b[1] - t[1] * b[0]) * stored);
  });
  const geometry = new THREE.BufferGeometry();
  const set = (name, values, width) => geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, width));
  set('position', position, 3);
  set('normal', normal, 3);
  set('uv', uv, 2);
  set('uv1', uv1, 2);
  if (stored) set('tangent', tangent, 4);
  return geometry;
}

const sheetCharts = {
  square: [1, 0, 0, 0, 1, 1],
  stretched: [1, 0, 0, 0, 0.5, 0.5],
  sheared: [1, 0.5, 0.1, 0, 1, 1],
};

// what: the drawn vector, 'normal' (default), 'coat', 't' or 'b'. chart: a key of sheetCharts, for the map's
// coordinates.
const sheetCases = {
  front: {},
  back: { angle: Math.PI - 0.4 },
  'mirrored transform': { scaleX: -1 },
  'mirrored transform, back': { scaleX: -1, angle: Math.PI - 0.4 },
  stretched: { chart: 'stretched' },
  sheared: { chart: 'sheared' },
  'tangents along v': { stored: 1 },
  'tangents against v': { stored: -1 },
  'tangents, stretched': { stored: -1, chart: 'stretched' },
  'tangents, mirrored transform': { stored: -1, scaleX: -1 },
  'tangents, y down': { stored: -1, up: -1, angle: Math.PI - 0.4 },
  'y down': { up: -1 },
  'y down, back': { up: -1, angle: Math.PI - 0.4 },
  'y down, wound for it': { up: -1, wound: true, side: 'FrontSide' },
  'seen from inside': { side: 'BackSide', angle: Math.PI - 0.4 },
  flat: { flat: true },
  instanced: { instanced: true },
  'uv set 1': { channel: 1 },
  'rotated texture': { rotation: 0.5 },
  'coat': { what: 'coat' },
  'coat, back': { what: 'coat', angle: Math.PI - 0.4 },
  'coat, y down': { what: 'coat', up: -1 },
  'coat on uv set 1, bumps on set 0': { what: 'coat', channel: 1, both: true },
  'coat, tangents against v': { what: 'coat', stored: -1 },
  'anisotropy along u': { what: 't' },
  'anisotropy across': { what: 'b' },
  'anisotropy along u, stretched': { what: 't', chart: 'stretched' },
  'anisotropy along u, sheared': { what: 't', chart: 'sheared' },
  'anisotropy across, stretched': { what: 'b', chart: 'stretched' },
  'anisotropy along u, y down': { what: 't', up: -1 },
  'anisotropy across, tangents against v': { what: 'b', stored: -1 },
};

// A few cases of each kind, for frames whose parts other frames' tests cover.
const someCases = ['front', 'back', 'stretched', 'sheared', 'tangents, stretched', 'y down', 'y down, wound for it', 'coat', 'uv set 1', 'anisotropy across'];

// Texels that encode the direction of u, of v, or against v.
const directionTexels = (what, sign) =>
  new Float32Array(sheetTexels * sheetTexels * 4).map((_, i) => (i % 4 === (what === 't' ? 0 : 1) ? 127.5 * (1 + sign) : 127.5));

// Two planes beside one another with a material each, of one kind and with the same settings but another map, or another
// matrix of the map. change(scene): what is tried; write(material, what): makes a material write the vector;
// draw(scene, camera): the pixels, 64 x 32. Returns the degrees of both halves by kind of material.
const twoMaterialCases = {
  standard: { kind: 'MeshStandardMaterial', what: 'normal' },
  'standard, as nodes': { kind: 'MeshStandardNodeMaterial', what: 'normal' },
  coats: { kind: 'MeshPhysicalMaterial', what: 'coat' },
  'coats, as nodes': { kind: 'MeshPhysicalNodeMaterial', what: 'coat' },
  'anisotropy under bumps': { kind: 'MeshPhysicalMaterial', what: 'normal', anisotropy: 0.5 },
  'three materials, two maps': { kind: 'MeshStandardMaterial', what: 'normal', extra: true },
  'two matrices': { kind: 'MeshStandardMaterial', what: 'normal', rotation: Math.PI },
};
async function twoMaterials(THREE, change, write, draw) {
  const result = {};
  for (const [name, { kind, what, anisotropy, extra, rotation = 0 }] of Object.entries(twoMaterialCases)) {
    if (!THREE[kind]) continue; // no node materials there
    const scene = new THREE.Scene(), camera = new THREE.OrthographicCamera(-2, 2, 1, -1, 0.1, 10);
    camera.position.z = 5;
    scene.add(new THREE.DirectionalLight('white', 3));
    const texels = rotation ? [twoTexels[1], twoTexels[1]] : twoTexels;
    const maps = texels.map((texel, k) => {
      const map = new THREE.DataTexture(new Uint8Array(texel), 1, 1);
      map.rotation = k * rotation; // u and v run against x and y then, and the texel leans to the other side
      map.needsUpdate = true;
      return map;
    });
    [...maps, ...extra ? [maps[0]] : []].forEach((map, k) => {
      const material = new THREE[kind]({ [what === 'coat' ? 'clearcoatNormalMap' : 'normalMap']: map });
      if (what === 'coat') material.clearcoat = 1;
      if (anisotropy) material.anisotropy = anisotropy;
      const mesh = new THREE.Mesh(new THREE.PlaneGeometry(1.8, 1.8), material);
      mesh.position.set(k % 2 * 2 - 1, 0, k < 2 ? 0 : -1); // the third is behind the first
      scene.add(mesh);
    });
    await change(scene);
    scene.traverse(child => { if (child.isMesh) write(child.material, what); });
    result[name] = halvesErrors(await draw(scene, camera), 64, 32, rotation ? [texels[0], texels[1].map((c, i) => (i < 2 ? 255 - c : c))] : texels);
  }
  return result;
}

// draw(scene, camera, what, up) returns RGBA floats, bottom row first. frame: the frame in which the map is read;
// 'stock' is orthonormal with tangents and otherwise cotangent; undefined is the same, but orthonormal also where the
// map is not repeated.
function sheetScenes(THREE, size, frame, draw, cases = Object.keys(sheetCases)) {
  const result = {};
  const map = sheetMap(THREE);
  for (const name of cases) {
    const { what = 'normal', angle = 0.4, scaleX = 1, stored = 0, up = 1, chart: chartName = 'square', side = 'DoubleSide',
            channel = 0, rotation = 0, flat, instanced, both, wound } = sheetCases[name];
    let chart = sheetCharts[chartName];
    const geometry = sheetGeometry(THREE, chart, stored);
    if (wound) geometry.setIndex([2, 1, 0, 5, 4, 3, 8, 7, 6, 11, 10, 9]); // y down reverses the winding
    const own = map.clone();
    own.channel = channel;
    own.rotation = rotation;
    own.needsUpdate = true;
    if (channel) chart = [...chart.slice(3).map(c => -c), ...chart.slice(0, 3)];
    if (rotation) { // as three's Matrix3.setUvTransform
      const c = Math.cos(rotation), s = Math.sin(rotation);
      chart = [0, 1].flatMap(row => [0, 1, 2].map(k => (row ? -s * chart[k] + c * chart[k + 3] : c * chart[k] + s * chart[k + 3])));
    }
    const material = new THREE.MeshPhysicalMaterial({ side: THREE[side], flatShading: !!flat });
    if (what !== 'coat' || both) material.normalMap = both ? map : own;
    if (what === 'coat') {
      material.clearcoat = 1;
      material.clearcoatNormalMap = own;
      if (stored) material.clearcoatNormalScale.y = stored;
    }
    if (what === 't' || what === 'b') material.anisotropy = 0.5;
    if (stored) material.normalScale.y = stored;
    const mesh = instanced ? new THREE.InstancedMesh(geometry, material, 1) : new THREE.Mesh(geometry, material);
    mesh.position.set(0.1, -0.05, -3.5);
    mesh.rotation.y = angle;
    mesh.scale.x = instanced ? 1 : scaleX;
    if (instanced) mesh.setMatrixAt(0, new THREE.Matrix4().makeScale(0.5, 0.5, 0.5)); // the mesh has twice the size
    if (instanced) mesh.scale.setScalar(2);
    mesh.frustumCulled = false;
    const camera = new THREE.PerspectiveCamera(40, 1, 0.1, 100);
    const zoom = camera.projectionMatrix.elements[5];
    const scene = new THREE.Scene();
    scene.add(new THREE.DirectionalLight('white', 3), mesh);
    const place = mesh.position.toArray();
    const finish = pixels => {
      const directions = what === 't' || what === 'b';  // do not depend on the texel
      return sheetErrors({ pixels, size, texels: directions ? directionTexels(what, what === 'b' && stored || 1) : map.image.data, texelCount: sheetTexels,
                           place, angle, scaleX, up, zoom, chart,
                           frame: directions || frame === 'orthonormal' || (!frame || frame === 'stock') && stored || !frame && chartName === 'stretched' ? 'orthonormal' : 'cotangent' });
    };
    const pixels = draw(scene, camera, what, up);
    result[name] = pixels.then ? pixels.then(finish) : finish(pixels);
  }
  return result;
}
