// Three scenes of docs/how-to/beyond.md: as stock three.js draws them, by cotan, and the truth. For three_beyond_test.mjs.
// Each function returns { errors, panels }: numbers by name, and squares of linear colours, rows from the bottom, with a label.
import { Drawing, eachRay, groundMesh, heightAt, heightTexture, kGrounds, meets, showingUv, texelsOff } from './three_relief.js';

export const kSide = 340; // pixels of a panel
const kDomeDepth = 0.05, kPerUnit = 4; // domes of a height map, per unit of uv
const clamp = x => Math.min(Math.max(x, 0), 1), mix = (a, b, k) => a.map((x, i) => x + (b[i] - x) * k);

// A dome of each cell: its height and slopes, in units of uv.
function dome(u, v) {
  const cell = x => 2 * (x * kPerUnit - Math.floor(x * kPerUnit)) - 1, x = cell(u), y = cell(v), square = x * x + y * y;
  if (square >= 0.64) return { h: 0, hu: 0, hv: 0 };
  const z = Math.sqrt(1 - square);
  return { h: (z - 0.6) / (2 * kPerUnit), hu: -x / z, hv: -y / z };
}

function textureOf(THREE, side, texel, { repeat = 1, offset = 0 } = {}) {
  const data = new Uint16Array(side * side * 4), half = THREE.DataUtils.toHalfFloat;
  for (let y = 0; y < side; ++y) for (let x = 0; x < side; ++x) data.set(texel((x + 0.5) / side, (y + 0.5) / side).map(half), 4 * (y * side + x));
  const map = new THREE.DataTexture(data, side, side, THREE.RGBAFormat, THREE.HalfFloatType);
  Object.assign(map, { wrapS: THREE.RepeatWrapping, wrapT: THREE.RepeatWrapping, magFilter: THREE.LinearFilter, minFilter: THREE.LinearFilter, needsUpdate: true });
  map.repeat.set(repeat, repeat);
  map.offset.set(offset, offset);
  return map;
}
const slopeTexel = (hu, hv) => { const l = Math.hypot(hu, hv, 1); return [0.5 - hu / l / 2, 0.5 - hv / l / 2, 0.5 + 1 / l / 2, 1]; };

function flatCamera(THREE, degrees, half) {
  const camera = new THREE.OrthographicCamera(-half, half, half, -half, 0.1, 10), angle = THREE.MathUtils.degToRad(degrees);
  camera.position.set(0, -Math.sin(angle) * 3, Math.cos(angle) * 3);
  camera.lookAt(0, 0, 0);
  camera.updateMatrixWorld();
  return camera;
}

// ---- parallax on a plane with sheared and mirrored uv --------------------------------------------

// parallaxUV of three/tsl with the height at the pixel, with tangents that three makes and without; addRelief of cotan.
export async function parallax() {
  const THREE = await import('three/webgpu'), tsl = await import('three/tsl'), { addRelief } = await import('/package/three/relief_nodes.js');
  const renderer = new THREE.WebGPURenderer({ forceWebGL: true }), camera = flatCamera(THREE, 60, 0.48), ground = kGrounds.plane, side = 512, errors = {};
  await renderer.init();
  const drawing = new Drawing(THREE, renderer, kSide), field = { side, data: new Uint8Array(side * side) };
  for (let y = 0; y < side; ++y) for (let x = 0; x < side; ++x) field.data[y * side + x] = Math.round(255 * dome((x + 0.5) / side, (y + 0.5) / side).h / kDomeDepth);
  const paint = (u, v) => {
    const { h, hu, hv } = dome(u, v), [x, y, z] = [-hu, -hv, 1].map(c => c / Math.hypot(hu, hv, 1));
    return [...mix([0.09, 0.16, 0.3], [0.75, 0.42, 0.16], clamp(3 * h / kDomeDepth)).map(c => c * (0.25 + 0.9 * Math.max(0, -0.5 * x - 0.5 * y + 0.7 * z))), 1];
  };
  const painted = textureOf(THREE, 1024, paint), heightMap = heightTexture(THREE, field);
  const stock = material => {
    const uv = tsl.parallaxUV(tsl.uv(), tsl.texture(heightMap, tsl.uv()).r.oneMinus().mul(kDomeDepth)).xy;
    material.emissiveNode = tsl.texture(material.emissiveMap).sample(uv); // with its matrix
  };
  const draw = async (change, map, { tangents, on = ground } = {}) => {
    const material = new THREE.MeshStandardNodeMaterial({ color: 0, roughness: 1, emissive: 'white', emissiveMap: map }), mesh = groundMesh(THREE, on, material);
    if (tangents) mesh.geometry.computeTangents();
    change(material);
    return drawing.draw(camera, mesh);
  };
  const cotan = material => addRelief(material, { heightMap, heightDepth: kDomeDepth, heightSteps: 64 }), uvMap = () => showingUv(THREE).emissiveMap;
  const off = async (change, more) => texelsOff(THREE, more?.on ?? ground, camera, kDomeDepth, await draw(change, uvMap(), more), { relief: field, size: kSide, every: 7 }).mean;
  errors.cotan = await off(cotan);
  errors.stock = await off(stock);
  errors['stock, tangents'] = await off(stock, { tangents: true });
  errors.unmoved = await off(() => {});
  const on = { ...ground, uv: (s, t) => [s, t] };
  for (const [name, change, tangents] of [['cotan', cotan], ['stock', stock], ['stock, tangents', stock, true]]) errors[`${name}, square`] = await off(change, { on, tangents });
  const truth = new Float32Array(kSide * kSide * 4);
  eachRay(THREE, camera, (pixel, origin, direction) => {
    const found = meets(THREE, ground, origin, direction, kDomeDepth, field);
    if (found) truth.set(paint(...found.uv), 4 * pixel);
  }, kSide);
  return { errors, panels: [['green', `Cotan: ${errors.cotan.toFixed(1)} texels off`, await draw(cotan, painted)],
    ['red', `three.js, parallaxUV: ${errors.stock.toFixed(0)} off`, await draw(stock, painted)], ['grey', 'truth', truth]] };
}

// ---- a decal over a seam -------------------------------------------------------------------------

const kDecal = { width: 1.3, alpha: 0.8 };

// The waves that the surface itself has, per unit of its uv: height and slopes.
function waves(u, v) {
  const k = 2 * Math.PI * 3, d = 0.7 * k, a = 0.3 / (1.25 * k), { sin, cos } = Math;
  return { h: a * (sin(k * u + 1) * cos(k * v) + 0.5 * sin(d * (u + v))), hu: a * (k * cos(k * u + 1) * cos(k * v) + 0.5 * d * cos(d * (u + v))),
    hv: a * (-k * sin(k * u + 1) * sin(k * v) + 0.5 * d * cos(d * (u + v))) };
}

// An upright cylinder of radius 1. Left of the seam u runs around and v down; right of it the chart is turned by 90 degrees.
const chart = (angle, y) => (angle < 0 ? [angle, -y] : [y, angle]);
const decalAt = (angle, y) => [Math.sin(angle) / kDecal.width + 0.5, y / kDecal.width + 0.5]; // v up
const isInDecal = (angle, y) => Math.hypot(Math.sin(angle), y) < kDecal.width / 2;

// The normal of the surface that is displaced by both heights, by differences of positions. decalOnly: by that of the decal.
function displaced(THREE, angle, y, decalOnly) {
  const alpha = isInDecal(angle, y) ? (decalOnly ? 1 : kDecal.alpha) : 0, isRight = angle >= 0, e = 1e-5;
  const moved = (da, dy) => {
    const a = angle + da, t = y + dy, own = waves(...(isRight ? [t, a] : [a, -t])).h, h = own * (1 - alpha) + dome(...decalAt(a, t)).h * kDecal.width * alpha;
    return new THREE.Vector3(Math.sin(a) * (1 + h), t, Math.cos(a) * (1 + h));
  };
  return moved(e, 0).sub(moved(-e, 0)).cross(moved(0, e).sub(moved(0, -e))).normalize();
}

function cylinder(THREE, columns = 256) {
  const geometry = new THREE.BufferGeometry(), position = [], normal = [], uv = [], index = [];
  for (const [from, to] of [[-1.5, -1e-7], [0, 1.5]])
    for (let i = 0; i <= columns; ++i)
      for (const y of [-1, 1]) {
        const angle = from + (to - from) * i / columns, k = position.length / 3;
        position.push(Math.sin(angle), y, Math.cos(angle));
        normal.push(Math.sin(angle), 0, Math.cos(angle));
        uv.push(...chart(angle, y));
        if (i < columns && y < 0) index.push(k, k + 2, k + 1, k + 1, k + 2, k + 3);
      }
  for (const [name, values, width] of [['position', position, 3], ['normal', normal, 3], ['uv', uv, 2]]) geometry.setAttribute(name, new THREE.Float32BufferAttribute(values, width));
  return geometry.setIndex(index);
}

const wavesMap = THREE => textureOf(THREE, 1024, (s, t) => { const { hu, hv } = waves(s * 4 - 2, t * 4 - 2); return slopeTexel(hu, hv); }, { repeat: 0.25, offset: 0.5 });
const domesMap = THREE => textureOf(THREE, 1024, (u, v) => { const { hu, hv } = dome(u, v); return slopeTexel(hu, hv); });
const decalColour = (u, v) => [...(dome(u, v).h > 0 ? [0.8, 0.5, 0.08] : [0.5, 0.08, 0.06]), Math.hypot(u - 0.5, v - 0.5) < 0.5 ? kDecal.alpha : 0];
const kBaseColour = [0.16, 0.17, 0.2];

// Makes a material of WebGLRenderer write its normal.
function writeNormals(material) {
  material.onBeforeCompile = shader => { shader.fragmentShader = shader.fragmentShader.replace('#include <dithering_fragment>', 'gl_FragColor = vec4( normalize( normal ), diffuseColor.a > 0.1 ? 1.0 : 0.0 );'); };
  Object.assign(material, { transparent: false, alphaTest: 0.1 });
  return material;
}

function lamps(THREE) {
  return [[-0.6, 0.55, 0.58]].map(to => {
    const light = new THREE.DirectionalLight('white', 3);
    light.position.set(...to);
    return light;
  }).concat(new THREE.AmbientLight('white', 0.5));
}

// three's shading of given normals and colours: an image of object-space normals on a square in front of the camera.
async function shaded(THREE, drawing, normals, colours) {
  const copied = (array, scale, offset) => {
    const map = new THREE.DataTexture(Float32Array.from(array, (x, k) => (k % 4 === 3 ? 1 : x * scale + offset)), kSide, kSide, THREE.RGBAFormat, THREE.FloatType);
    map.needsUpdate = true;
    return map;
  };
  const material = new THREE.MeshStandardMaterial({ map: copied(colours, 1, 0), normalMap: copied(normals, 0.5, 0.5), normalMapType: THREE.ObjectSpaceNormalMap, roughness: 0.45 });
  return drawing.draw(frontCamera(THREE), new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material), ...lamps(THREE));
}
function frontCamera(THREE, half = 1) {
  const camera = new THREE.OrthographicCamera(-half, half, half, -half, 0.1, 10);
  camera.position.z = 3;
  camera.updateMatrixWorld();
  return camera;
}

// Degrees between drawn and expected directions over pixels where use(x, y) gives the expected one. isLine: up to its sign.
function degreesOff(THREE, pixels, use, isLine = false) {
  const found = [], got = new THREE.Vector3();
  eachPixel((k, x, y) => {
    const expected = use(x, y);
    if (!expected || pixels[4 * k + 3] < 0.5) return;
    const angle = THREE.MathUtils.radToDeg(got.fromArray(pixels, 4 * k).angleTo(expected));
    found.push(isLine ? Math.min(angle, 180 - angle) : angle);
  });
  return found.length > 10000 && found.every(Number.isFinite) ? found.reduce((sum, x) => sum + x, 0) / found.length : NaN;
}
function eachPixel(use) {
  for (let k = 0; k < kSide * kSide; ++k) use(k, (k % kSide + 0.5) / kSide * 2 - 1, (Math.floor(k / kSide) + 0.5) / kSide * 2 - 1);
}

// DecalGeometry of three with a normalMap over a surface with another; the lines of the page, with the text that the tool prints.
export async function decal({ text }) {
  const THREE = await import('three'), { DecalGeometry } = await import('three/addons/geometries/DecalGeometry.js'), camera = frontCamera(THREE), errors = {};
  const drawing = new Drawing(THREE, new THREE.WebGLRenderer(), kSide), base = new THREE.Mesh(cylinder(THREE)), decalGeometry = new DecalGeometry(base, new THREE.Vector3(0, 0, 1), new THREE.Euler(), new THREE.Vector3(kDecal.width, kDecal.width, 1));
  const surface = () => new THREE.MeshStandardMaterial({ color: new THREE.Color(...kBaseColour), normalMap: wavesMap(THREE), roughness: 0.45 });
  const sticker = () => new THREE.MeshStandardMaterial({ map: textureOf(THREE, 512, decalColour), normalMap: domesMap(THREE), roughness: 0.45, transparent: true, polygonOffset: true, polygonOffsetFactor: -4 });
  const over = (x, y) => { const angle = Math.asin(x); return isInDecal(angle, y) && Math.hypot(x, y) < kDecal.width / 2 - 0.02 ? angle : undefined; };
  const truthOf = decalOnly => (x, y) => { const angle = over(x, y); return angle === undefined ? undefined : displaced(THREE, angle, y, decalOnly); };
  const stock = await drawing.draw(camera, new THREE.Mesh(decalGeometry, writeNormals(sticker())));
  errors.stock = degreesOff(THREE, stock, truthOf(false));
  errors['stock, to the decal alone'] = degreesOff(THREE, stock, truthOf(true));
  base.material = writeNormals(surface());
  errors['stock, the surface'] = degreesOff(THREE, await drawing.draw(camera, base), (x, y) => (over(x, y) === undefined && Math.abs(x) < 0.9 && Math.abs(x) > 0.03 ? displaced(THREE, Math.asin(x), y) : undefined));

  const material = new THREE.RawShaderMaterial({ glslVersion: THREE.GLSL3, uniforms: { waves: { value: wavesMap(THREE) }, domes: { value: domesMap(THREE) } },
    vertexShader: `precision highp float; in vec3 position; in vec3 normal; in vec2 uv; out vec3 p; out vec3 n; out vec2 at; uniform mat4 modelViewMatrix, projectionMatrix;
void main() { p = position; n = normal; at = uv; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }`,
    fragmentShader: `precision highp float; precision highp int; in vec3 p; in vec3 n; in vec2 at; out vec4 drawn; uniform sampler2D waves, domes;
${text}
void main() {
  const float w = ${kDecal.width};
  cotan_frame f = cotan_frame_gradient(n, dFdx(p), dFdy(p), dFdx(at), dFdy(at));
  vec2 box = p.xy / w + 0.5;
  cotan_frame decal = cotan_frame_projected(n, vec3(1, 0, 0) / w, vec3(0, 1, 0) / w);
  vec3 g = cotan_gradient_of_slope(decal, cotan_slope_of_texel(texture(domes, box).xyz * 2.0 - 1.0) * w);
  vec3 below = cotan_gradient_of_slope(f, cotan_slope_of_texel(texture(waves, at * 0.25 + 0.5).xyz * 2.0 - 1.0));
  drawn = vec4(cotan_resolve_gradient(n, mix(below, g, length(box - 0.5) < 0.5 ? ${kDecal.alpha} : 0.0)), 1.0);
}` });
  const ours = await drawing.draw(camera, new THREE.Mesh(base.geometry, material));
  errors.cotan = degreesOff(THREE, ours, truthOf(false));

  const truth = new Float32Array(ours.length), colours = new Float32Array(ours.length);
  eachPixel((k, x, y) => {
    const angle = Math.asin(x), [u, v] = decalAt(angle, y);
    truth.set(displaced(THREE, angle, y).toArray(), 4 * k);
    colours.set(mix(kBaseColour, decalColour(u, v), isInDecal(angle, y) ? kDecal.alpha : 0), 4 * k);
  });
  const picture = await drawing.draw(camera, new THREE.Mesh(base.geometry, surface()), new THREE.Mesh(decalGeometry, sticker()), ...lamps(THREE));
  return { errors, panels: [['green', `Cotan: ${errors.cotan.toFixed(1)} degrees off`, await shaded(THREE, drawing, ours, colours)],
    ['red', `three.js, DecalGeometry: ${errors.stock.toFixed(1)} off`, picture], ['grey', 'truth', await shaded(THREE, drawing, truth, colours)]] };
}

// ---- grooves on a sphere with sheared and turned uv ----------------------------------------------

const kTurn = [Math.cos(Math.PI / 6), Math.sin(Math.PI / 6)];
const brushedUv = (a, b) => [kTurn[0] * (a + b) - kTurn[1] * b, kTurn[1] * (a + b) + kTurn[0] * b]; // sheared by 45 degrees, turned by 30

function sphere(THREE) {
  const columns = 192, rows = 128, geometry = new THREE.BufferGeometry(), position = [], uv = [], index = [];
  for (let j = 0; j <= rows; ++j)
    for (let i = 0; i <= columns; ++i) {
      const a = (i / columns - 0.5) * 3.4, b = (j / rows - 0.5) * 3.1, k = position.length / 3;
      position.push(Math.sin(a) * Math.cos(b), Math.sin(b), Math.cos(a) * Math.cos(b));
      uv.push(...brushedUv(a, b));
      if (i < columns && j < rows) index.push(k, k + 1, k + columns + 1, k + columns + 1, k + 1, k + columns + 2);
    }
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(position, 3));
  geometry.setAttribute('normal', new THREE.Float32BufferAttribute(position, 3));
  geometry.setAttribute('uv', new THREE.Float32BufferAttribute(uv, 2));
  return geometry.setIndex(index);
}

// The direction of the grooves, turned by `rotation` from u towards v: the curve of constant v has the angles (c + s, -s) in
// longitude and latitude, where the inverse of the uv's matrix has its first column.
function groovesAt(THREE, x, y, rotation) {
  if (Math.hypot(x, y) > 0.9) return undefined;
  const n = new THREE.Vector3(x, y, Math.sqrt(1 - x * x - y * y)), a = Math.atan2(n.x, n.z), b = Math.asin(y), [c, s] = kTurn;
  const along = (da, db) => new THREE.Vector3(Math.cos(a) * Math.cos(b), 0, -Math.sin(a) * Math.cos(b)).multiplyScalar(da)
    .add(new THREE.Vector3(-Math.sin(a) * Math.sin(b), Math.cos(b), -Math.cos(a) * Math.sin(b)).multiplyScalar(db));
  const t = along(c + s, -s).normalize(), across = n.clone().cross(t); // uv are not mirrored: v increases to the left of u
  return t.multiplyScalar(Math.cos(rotation)).add(across.multiplyScalar(Math.sin(rotation)));
}

// MeshPhysicalMaterial of three with anisotropy: without tangents, with those of computeTangents(), and after untangle().
export async function grooves() {
  const THREE = await import('three'), { untangle } = await import('/package/three/index.js'), camera = frontCamera(THREE), errors = {};
  const drawing = new Drawing(THREE, new THREE.WebGLRenderer(), kSide);
  const made = (way, rotation = 0, write = false) => {
    const material = new THREE.MeshPhysicalMaterial({ color: new THREE.Color(0.9, 0.75, 0.55), metalness: 1, roughness: 0.35, anisotropy: 0.85, anisotropyRotation: rotation });
    if (!write) material.roughnessMap = brushed(THREE);
    if (write) material.onBeforeCompile = shader => { shader.fragmentShader = shader.fragmentShader.replace('#include <dithering_fragment>', 'gl_FragColor = vec4( normalize( material.anisotropyT ), 1.0 );'); };
    const mesh = new THREE.Mesh(sphere(THREE), material);
    if (way === 'tangents') mesh.geometry.computeTangents();
    if (way === 'cotan') untangle(mesh);
    return mesh;
  };
  for (const [name, rotation] of [['', 0], [', rotation', 0.6]])
    for (const [way, label] of [['cotan', 'cotan'], ['stock', 'stock'], ['tangents', 'stock, tangents']])
      errors[label + name] = degreesOff(THREE, await drawing.draw(camera, made(way, rotation, true)), (x, y) => groovesAt(THREE, x, y, rotation), true);
  const lights = [[-0.6, 0.55, 0.58], [0.5, 0.2, 0.8]].map(to => { const light = new THREE.DirectionalLight('white', 0.7); light.position.set(...to); return light; });
  const panel = way => drawing.draw(camera, made(way), ...lights, new THREE.AmbientLight('white', 0.5));
  return { errors, panels: [['green', `Cotan, no tangents: ${errors.cotan.toFixed(1)} off`, await panel('cotan')], ['red', `three.js, no tangents: ${errors.stock.toFixed(0)} off`, await panel('stock')],
    ['grey', `three.js, tangents: ${errors['stock, tangents'].toFixed(1)} off`, await panel('tangents')]] };
}
const brushed = THREE => textureOf(THREE, 1024, (u, v) => [1, 0.8 + 0.2 * Math.sin(2 * Math.PI * 15 * v), 1, 1]);

// ---- images --------------------------------------------------------------------------------------

const kStrip = 34, kGap = 6, kColours = { green: '#0d6b33', red: '#b8211c', grey: '#404047' };

// The panels side by side, with a strip of words each, as JPEG in base64.
export function joined(panels) {
  const canvas = document.createElement('canvas'), context = canvas.getContext('2d');
  canvas.width = panels.length * (kSide + kGap) - kGap;
  canvas.height = kSide + kStrip;
  panels.forEach(([colour, words, pixels], which) => {
    const image = new ImageData(kSide, kSide), left = which * (kSide + kGap);
    for (let k = 0; k < kSide * kSide; ++k) {
      const to = 4 * ((kSide - 1 - Math.floor(k / kSide)) * kSide + k % kSide);
      for (let c = 0; c < 3; ++c) {
        const x = clamp(pixels[4 * k + c]);
        image.data[to + c] = Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
      }
      image.data[to + 3] = 255;
    }
    context.putImageData(image, left, 0);
    context.fillStyle = kColours[colour];
    context.fillRect(left, kSide, kSide, kStrip);
    Object.assign(context, { fillStyle: 'white', font: 'bold 17px DejaVu Sans', textAlign: 'center', textBaseline: 'middle' });
    context.fillText(words, left + kSide / 2, kSide + kStrip / 2, kSide - 8);
  });
  return canvas.toDataURL('image/jpeg', 0.88).split(',')[1];
}
