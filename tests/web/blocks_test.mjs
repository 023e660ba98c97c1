// Stock three.js and Babylon.js draw the blocks that `cotan map convert --compress` writes, in headless Chromium, with
// the error that `cotan map diff` names: node blocks_test.mjs ROOT NODE_MODULES TOOL [CASE]
// ROOT: the sources. Exit code 77: skipped.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { launch, serve } from './chromium.mjs';
import { emptyFolder, runCases, skip } from './shared.mjs';

const [root, modules, tool, only] = process.argv.slice(2);
for (const name of ['three', 'babylonjs']) if (!fs.existsSync(path.join(modules, name))) skip(`${name} is not installed (see the test npm_packages)`);
if (!fs.existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium')) skip('no chromium');
const folder = emptyFolder(), size = 64;
const { address, close } = await serve({ modules, made: folder, examples: path.join(root, 'examples') });
const browser = await launch(modules);
const kTwo = ['bc5', 'eac-rg11'], kThree = ['bc7', 'uastc', 'astc-4x4', 'astc-6x6']; // channels of formats that three's KTX2Loader knows

// A relief with two waves and noise, so that blocks lose something.
async function writeMap() {
  const { encodePng } = await import(path.resolve(root, 'bindings/js/src/png.js'));
  const data = new Uint16Array(4 * size * size);
  let seed = 7;
  const noise = () => (seed = (seed * 1103515245 + 12345) % 2147483648) / 2147483648 - 0.5;
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      const slope = [0.4 * Math.cos(x / 5) + 0.3 * noise(), 0.3 * Math.sin(y / 7 + x / 11) + 0.3 * noise(), 1], length = Math.hypot(...slope);
      [...slope.map(c => c / length), 1].forEach((c, k) => { data[4 * (y * size + x) + k] = Math.round((c + 1) / 2 * 65535); });
    }
  fs.writeFileSync(path.join(folder, 'map.png'), await encodePng({ width: size, height: size, data }));
}

const run = (...words) => execFileSync(tool, ['map', ...words], { cwd: folder, encoding: 'utf8' });
function writeBlocks() {
  const found = {};
  for (const word of ['none', ...kTwo, ...kThree]) {
    run('convert', 'map.png', '--from', 'gltf', '--to', kTwo.includes(word) ? 'gltf,xy' : 'gltf', '--compress', word, '-o', `${word}.ktx2`);
    found[word] = JSON.parse(run('diff', 'map.png', `${word}.ktx2`, '--from', 'gltf', '--to', 'gltf', '--json', '-', '--quiet')).angles.mean_degrees;
  }
  return found;
}

// Returns the normals that three draws with a map on a plane, as seen from above, three floats a pixel.
// only: the one kind of blocks that three's transcoder may turn the file into; else the device's own.
async function drawnByThree(page, word, only) {
  return page.evaluate(async ([word, size, only]) => {
    const THREE = await import('three'), { KTX2Loader } = await import('/modules/three/examples/jsm/loaders/KTX2Loader.js');
    const renderer = new THREE.WebGLRenderer(), loader = new KTX2Loader().setTranscoderPath('/modules/three/examples/jsm/libs/basis/').detectSupport(renderer);
    if (only) for (const name of Object.keys(loader.workerConfig)) loader.workerConfig[name] = name === only;
    const map = await loader.loadAsync(`/made/${word}.ktx2`);
    map.minFilter = map.magFilter = THREE.NearestFilter;
    map.needsUpdate = true;
    const scene = new THREE.Scene(), camera = new THREE.OrthographicCamera(-1, 1, 1, -1, 0, 2);
    camera.position.z = 1;
    // MeshNormalMaterial of three 0.187 does not compile with two channels: its shader lacks `saturate`.
    const material = new THREE.MeshStandardMaterial({ normalMap: map, toneMapped: false });
    material.onBeforeCompile = shader => { shader.fragmentShader = shader.fragmentShader.replace('#include <opaque_fragment>', 'gl_FragColor = vec4(normal, 1.0);'); };
    scene.add(new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material));
    const target = new THREE.WebGLRenderTarget(size, size, { type: THREE.FloatType }), pixels = new Float32Array(4 * size * size);
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    renderer.readRenderTargetPixels(target, 0, 0, size, size, pixels);
    return { format: map.format, normals: [...pixels].filter((_, k) => k % 4 < 3) };
  }, [word, size, only]);
}

function meanAngle(a, b) {
  let sum = 0;
  for (let i = 0; i < a.length; i += 3) {
    const dot = a[i] * b[i] + a[i + 1] * b[i + 1] + a[i + 2] * b[i + 2];
    sum += Math.acos(Math.min(1, dot / Math.hypot(a[i], a[i + 1], a[i + 2]) / Math.hypot(b[i], b[i + 1], b[i + 2])));
  }
  return sum / (a.length / 3) * 180 / Math.PI;
}

// The same by Babylon.js, whose page drawnByBabylon is called in. Frames differ from three's by a rotation at most.
async function drawnByBabylon(page, file, channels) {
  return page.evaluate(async ([file, channels, size]) => {
    const { engine, readBlocks, useTwoChannels } = globalThis, scene = new BABYLON.Scene(engine);
    const camera = new BABYLON.FreeCamera('above', new BABYLON.Vector3(0, 0, -1), scene);
    Object.assign(camera, { mode: BABYLON.Camera.ORTHOGRAPHIC_CAMERA, orthoLeft: -1, orthoRight: 1, orthoBottom: -1, orthoTop: 1, minZ: 0, maxZ: 2 });
    const map = await new Promise((done, fail) => {
      const made = new BABYLON.Texture(`/made/${file}`, scene, { invertY: false, noMipmap: true, samplingMode: BABYLON.Texture.NEAREST_SAMPLINGMODE, onLoad: () => done(made), onError: why => fail(new Error(why)) });
    });
    const material = new BABYLON.StandardMaterial('normals', scene), plane = BABYLON.MeshBuilder.CreatePlane('plane', { size: 2 }, scene);
    plane.material = Object.assign(material, { bumpTexture: map });
    if (channels === 2) useTwoChannels(BABYLON, material);
    class Normals extends BABYLON.MaterialPluginBase {
      constructor() { super(material, 'Normals', 300, { NORMALS: true }, true, true); }
      getCustomCode(type) { return type === 'fragment' ? { CUSTOM_FRAGMENT_BEFORE_FRAGCOLOR: 'color = vec4(normalW, 1.0);' } : null; }
    }
    new Normals();
    const target = new BABYLON.RenderTargetTexture('target', size, scene, { type: BABYLON.Engine.TEXTURETYPE_FLOAT, generateMipMaps: false });
    Object.assign(target, { activeCamera: camera, renderList: [plane] });
    while (!target.isReadyForRendering()) await new Promise(done => setTimeout(done, 20));
    target.render();
    const pixels = await target.readPixels();
    const { format } = map.getInternalTexture();
    scene.dispose();
    return { format, normals: [...pixels].filter((_, k) => k % 4 < 3) };
  }, [file, channels, size]);
}

// Babylon's own reader of Basis Universal comes from its web site, not from npm. Binomial's transcoder takes its place,
// behind the interface that Babylon calls (run in the page).
async function standInForKtx2Decoder() {
  const astc4x4 = 10, basis = await globalThis.BASIS({ locateFile: name => `/modules/three/examples/jsm/libs/basis/${name}` });
  basis.initializeBasis();
  class KTX2Decoder {
    async decode(bytes) {
      const file = new basis.KTX2File(new Uint8Array(bytes));
      file.startTranscoding();
      const data = new Uint8Array(file.getImageTranscodedSizeInBytes(0, 0, 0, astc4x4)), width = file.getWidth(), height = file.getHeight();
      if (!file.transcodeImage(data, 0, 0, 0, astc4x4, 0, -1, -1)) throw new Error('not transcoded');
      return { width, height, transcodedFormat: 0x93b0, mipmaps: [{ data, width, height }], isInGammaSpace: false, hasAlpha: false };
    }
  }
  globalThis.KTX2DECODER = { KTX2Decoder, MSCTranscoder: {}, WASMMemoryManager: {} };
  BABYLON.KhronosTextureContainer2.DefaultNumWorkers = 0; // in this thread, which has the module
}

await writeMap();
const errors = writeBlocks();
function expectError(where, word, normals, plain) {
  const angle = meanAngle(normals, plain.normals);
  console.log(`${word}: ${angle.toFixed(3)} degrees in ${where}, ${errors[word].toFixed(3)} by map diff`);
  assert.ok(errors[word] > 0.1, 'blocks lose something');
  // The plain map has 8 bits, which are up to 0.2 degrees away from the 16 of the map.
  assert.ok(Math.abs(angle - errors[word]) < 0.1 + 0.1 * errors[word], `${word}: ${angle} and ${errors[word]}`);
}
const values = ({ normals }) => new Set(normals.map(c => c.toFixed(2))).size;

const cases = {
  async threeDrawsTheFilesWithTheErrorsThatDiffNames() {
    const page = await browser.newPage(), said = [], build = '/modules/three/build';
    await page.route(address, route => route.fulfill({ contentType: 'text/html', body: `<!doctype html><script type="importmap">${JSON.stringify({ imports: { three: `${build}/three.module.js` } })}</script>` }));
    page.on('console', message => { if (message.type() === 'error' || /THREE/.test(message.text())) said.push(message.text()); });
    await page.goto(address);
    const plain = await drawnByThree(page, 'none'), formats = new Set([plain.format]);
    assert.ok(values(plain) > 50, 'the relief is drawn');
    for (const word of [...kTwo, ...kThree]) {
      const { format, normals } = await drawnByThree(page, word);
      formats.add(format);
      expectError('three', word, normals, plain);
    }
    assert.deepEqual(said, []);
    assert.equal(formats.size, 6, 'each file is drawn from its own format, and uastc as astc');
    // Devices without ASTC get other blocks. BC7 holds UASTC nearly as it is; ETC2 and BC3 have less than half of its bits for colour.
    for (const [only, most] of [['astcSupported', 1.1], ['bptcSupported', 1.3], ['etc2Supported', 8], ['dxtSupported', 6]]) {
      const { format, normals } = await drawnByThree(page, 'uastc', only), angle = meanAngle(normals, plain.normals);
      console.log(`uastc with ${only}: ${angle.toFixed(3)} degrees`);
      formats.add(format);
      assert.ok(angle < most * errors.uastc, only);
    }
    assert.equal(formats.size, 8, 'each kind is another format');
    await page.close();
  },

  async babylonDrawsTheFilesWithTheErrorsThatDiffNames() {
    const page = await browser.newPage(), said = [], basis = '/modules/three/examples/jsm/libs/basis/basis_transcoder.js';
    await page.route(address, route => route.fulfill({ contentType: 'text/html', body: `<!doctype html><canvas></canvas><script src="/modules/babylonjs/babylon.js"></script><script src="${basis}"></script>` }));
    page.on('console', message => { if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text())) said.push(message.text()); });
    await page.goto(address);
    await page.evaluate(async () => {
      Object.assign(globalThis, await import('/examples/babylon/cotan_blocks.js'));
      globalThis.engine = new BABYLON.Engine(document.querySelector('canvas'), false);
      globalThis.readBlocks(BABYLON);
    });
    await page.evaluate(standInForKtx2Decoder);
    const plain = await drawnByBabylon(page, 'map.png', 3), formats = new Set();
    assert.ok(values(plain) > 50, 'the relief is drawn');
    for (const word of [...kTwo, ...kThree]) {
      const { format, normals } = await drawnByBabylon(page, `${word}.ktx2`, kTwo.includes(word) ? 2 : 3);
      formats.add(format);
      expectError('Babylon', word, normals, plain);
    }
    assert.equal(formats.size, 5, 'each file is drawn from its own format, and uastc as astc');
    assert.ok(meanAngle((await drawnByBabylon(page, 'bc5.ktx2', 3)).normals, plain.normals) > 20, 'z must be rebuilt');
    assert.deepEqual(said, []);
    const bytes = fs.readFileSync(path.join(folder, 'bc7.ktx2'));
    for (const length of [bytes.length - 1, 100, 80, 50]) {
      fs.writeFileSync(path.join(folder, `cut${length}.ktx2`), bytes.subarray(0, length));
      await assert.rejects(drawnByBabylon(page, `cut${length}.ktx2`, 3), `${length} bytes`);
    }
    await page.close();
  },
};
await runCases(cases, only);
await browser.close();
close();
