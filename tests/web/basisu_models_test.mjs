// Stock three.js and Filament open the models of `cotan convert --compress uastc`, in headless Chromium, and draw them as
// they draw the same model with PNG: node basisu_models_test.mjs SOURCES NODE_MODULES TOOL [CASE]
// SOURCES: bindings/js. Exit code 77: skipped.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { launch, serve } from './chromium.mjs';
import { emptyFolder, runCases, skip } from './shared.mjs';

const [sources, modules, tool, only] = process.argv.slice(2);
for (const name of ['three', 'filament', 'gltf-validator'])
  if (!fs.existsSync(path.join(modules, name))) skip(`${name} is not installed (see the test npm_packages)`);
if (!fs.existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium')) skip('no chromium');
const folder = emptyFolder(), side = 64;
const { address, close } = await serve({ modules, made: folder });
const browser = await launch(modules);

const run = (...words) => execFileSync(tool, words, { cwd: folder, encoding: 'utf8' });

// Two squares side by side, each with a material and a map of its own: waves along u, and along v.
async function writeModels() {
  const { encodePng } = await import(path.resolve(sources, 'src/png.js'));
  for (const [name, slope] of [['along-u', (x, y) => [0.6 * Math.cos(x / 3), 0.1]], ['along-v', (x, y) => [-0.2, 0.5 * Math.cos(y / 5)]]]) {
    const data = new Uint8Array(4 * side * side);
    for (let y = 0; y < side; ++y)
      for (let x = 0; x < side; ++x) {
        const [a, b] = slope(x, y), length = Math.hypot(a, b, 1);
        [a / length, b / length, 1 / length, 1].forEach((c, k) => { data[4 * (y * side + x) + k] = Math.round((c + 1) / 2 * 255); });
      }
    fs.writeFileSync(path.join(folder, `${name}.png`), await encodePng({ width: side, height: side, data }));
  }
  const floats = (left) => [left, -0.5, 0, left + 1, -0.5, 0, left + 1, 0.5, 0, left, 0.5, 0];
  const arrays = [new Float32Array(floats(-1)), new Float32Array(floats(0)), new Float32Array([0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1]), new Float32Array([0, 1, 1, 1, 1, 0, 0, 0]), new Uint16Array([0, 1, 2, 0, 2, 3])];
  const bytes = Buffer.concat(arrays.map(a => Buffer.from(a.buffer)));
  let at = 0;
  const views = arrays.map(a => ({ buffer: 0, byteOffset: (at += a.byteLength) - a.byteLength, byteLength: a.byteLength }));
  const accessor = (bufferView, componentType, type, count, more = {}) => ({ bufferView, componentType, type, count, ...more });
  const primitive = (position, material) => ({ primitives: [{ attributes: { POSITION: position, NORMAL: 2, TEXCOORD_0: 3 }, indices: 4, material }] });
  const box = (left) => ({ min: [left, -0.5, 0], max: [left + 1, 0.5, 0] });
  fs.writeFileSync(path.join(folder, 'squares.gltf'), JSON.stringify({
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0, 1] }], nodes: [{ mesh: 0 }, { mesh: 1 }], meshes: [primitive(0, 0), primitive(1, 1)],
    materials: [0, 1].map(index => ({ normalTexture: { index }, pbrMetallicRoughness: { metallicFactor: 0, roughnessFactor: 0.6 } })),
    textures: [{ source: 0 }, { source: 1 }], images: [{ uri: 'along-u.png' }, { uri: 'along-v.png' }],
    accessors: [accessor(0, 5126, 'VEC3', 4, box(-1)), accessor(1, 5126, 'VEC3', 4, box(0)), accessor(2, 5126, 'VEC3', 4), accessor(3, 5126, 'VEC2', 4), accessor(4, 5123, 'SCALAR', 6)],
    bufferViews: views, buffers: [{ byteLength: bytes.length, uri: `data:application/octet-stream;base64,${bytes.toString('base64')}` }],
  }));
  run('convert', 'squares.gltf', '-o', 'plain.glb', '--quiet');
  return JSON.parse(run('convert', 'squares.gltf', '--compress', 'uastc', '-o', 'uastc.glb', '--json', '-', '--quiet'));
}

async function pageOf(body) {
  const page = await browser.newPage(), said = [];
  await page.route(address, route => route.fulfill({ contentType: 'text/html', body: `<!doctype html>${body}` }));
  page.on('console', message => { if (message.type() === 'error') said.push(message.text()); });
  page.on('pageerror', error => said.push(error.message));
  await page.goto(address);
  return { page, said };
}

// Differences of 8-bit colours, and how far the picture of each half varies.
function compared(a, b) {
  let sum = 0, most = 0;
  for (let i = 0; i < a.length; ++i) {
    const off = Math.abs(a[i] - b[i]);
    sum += off;
    most = Math.max(most, off);
  }
  return { mean: sum / a.length, most };
}
const spread = (pixels) => Math.max(...pixels.filter((_, k) => k % 4 === 0)) - Math.min(...pixels.filter((_, k) => k % 4 === 0));

const report = await writeModels();
const cases = {
  async bothMapsAreStoredAndTheModelIsValid() {
    assert.deepEqual(report.compressed.map(map => map.name), ['along-u.png', 'along-v.png']);
    const validator = (await import(path.resolve(modules, 'gltf-validator/index.js'))).default;
    const { issues, info } = await validator.validateBytes(new Uint8Array(fs.readFileSync(path.join(folder, 'uastc.glb'))));
    assert.deepEqual(issues.messages.filter(message => message.severity < 1), []);
    assert.deepEqual(info.extensionsRequired ?? info.extensionsUsed, ['KHR_texture_basisu']);
  },

  async threeDrawsEachMapWithTheErrorThatConvertNames() {
    const build = '/modules/three/build';
    const { page, said } = await pageOf(`<script type="importmap">${JSON.stringify({ imports: { three: `${build}/three.module.js` } })}</script>`);
    const drawn = (file, blocks) => page.evaluate(async ([file, blocks, side]) => {
      const THREE = await import('three'), examples = '/modules/three/examples/jsm';
      const { GLTFLoader } = await import(`${examples}/loaders/GLTFLoader.js`), { KTX2Loader } = await import(`${examples}/loaders/KTX2Loader.js`);
      const renderer = new THREE.WebGLRenderer(), ktx2 = new KTX2Loader().setTranscoderPath(`${examples}/libs/basis/`).detectSupport(renderer);
      for (const name of Object.keys(ktx2.workerConfig)) ktx2.workerConfig[name] = name === blocks;
      const { scene } = await new GLTFLoader().setKTX2Loader(ktx2).loadAsync(`/made/${file}`);
      scene.traverse(({ material }) => {
        if (!material) return;
        material.normalMap.minFilter = material.normalMap.magFilter = THREE.NearestFilter;
        material.onBeforeCompile = shader => { shader.fragmentShader = shader.fragmentShader.replace('#include <opaque_fragment>', 'gl_FragColor = vec4(normal, 1.0);'); };
      });
      const camera = new THREE.OrthographicCamera(-1, 1, 0.5, -0.5, 0, 2);
      camera.position.z = 1;
      const target = new THREE.WebGLRenderTarget(2 * side, side, { type: THREE.FloatType }), pixels = new Float32Array(8 * side * side);
      renderer.setRenderTarget(target);
      renderer.render(scene, camera);
      renderer.readRenderTargetPixels(target, 0, 0, 2 * side, side, pixels);
      return [...pixels];
    }, [file, blocks, side]);
    const plain = await drawn('plain.glb'), astc = await drawn('uastc.glb', 'astcSupported'), bc7 = await drawn('uastc.glb', 'bptcSupported');
    // ASTC holds UASTC as it is, but SwiftShader cuts it to 8 bits instead of rounding: half a step is 0.22 degrees. BC7 has
    // end points of fewer bits.
    for (const [word, blocks, more] of [['astc', astc, 0.22], ['bc7', bc7, 0.3]])
    for (const half of [0, 1]) {
      let sum = 0;
      for (let y = 0; y < side; ++y)
        for (let x = 0; x < side; ++x) {
          const at = 4 * (y * 2 * side + half * side + x), a = plain.slice(at, at + 3), b = blocks.slice(at, at + 3);
          sum += Math.acos(Math.min(1, (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) / Math.hypot(...a) / Math.hypot(...b)));
        }
      const angle = sum / side ** 2 * 180 / Math.PI, named = report.compressed[half].mean_degrees;
      console.log(`three, ${word}, map ${half}: ${angle.toFixed(3)} degrees, ${named.toFixed(3)} by convert`);
      assert.ok(named > 0.02 && angle > named / 2 && angle < named + more);
    }
    assert.deepEqual(said, []);
    await page.close();
  },

  async filamentDrawsTheSamePictureAsFromPng() {
    const { page, said } = await pageOf('<canvas width="128" height="64"></canvas><script src="/modules/filament/filament.js"></script>');
    const drawn = (file) => page.evaluate(async (file) => {
      globalThis.started ??= new Promise(done => Filament.init([], done));
      await globalThis.started;
      const canvas = document.createElement('canvas');
      canvas.width = 128, canvas.height = 64;
      document.body.append(canvas);
      const context = { antialias: false, preserveDrawingBuffer: true };
      const engine = Filament.Engine.create(canvas, context), scene = engine.createScene(), view = engine.createView(), renderer = engine.createRenderer();
      const bytes = new Uint8Array(await (await fetch(`/made/${file}`)).arrayBuffer());
      const asset = engine.createAssetLoader().createAsset(bytes);
      await new Promise(done => asset.loadResources(done, null, '', 1));
      scene.addEntities(asset.getRenderableEntities());
      const sun = Filament.EntityManager.get().create();
      Filament.LightManager.Builder(Filament.LightManager$Type.DIRECTIONAL).color([1, 1, 1]).intensity(100000).direction([0.5, 0.4, -0.7]).build(engine, sun);
      scene.addEntity(sun);
      const camera = engine.createCamera(Filament.EntityManager.get().create());
      camera.setProjection(Filament.Camera$Projection.ORTHO, -1, 1, -0.5, 0.5, 0.1, 10);
      camera.lookAt([0, 0, 2], [0, 0, 0], [0, 1, 0]);
      view.setCamera(camera);
      view.setScene(scene);
      view.setViewport([0, 0, 128, 64]);
      for (let frame = 0; frame < 5; ++frame) {
        renderer.render(engine.createSwapChain ? (globalThis[`chain-${file}`] ??= engine.createSwapChain()) : null, view);
        await new Promise(requestAnimationFrame);
      }
      const copy = document.createElement('canvas').getContext('2d');
      copy.canvas.width = 128, copy.canvas.height = 64;
      copy.drawImage(canvas, 0, 0);
      return { pixels: [...copy.getImageData(0, 0, 128, 64).data], url: canvas.toDataURL() };
    }, file);
    const plain = await drawn('plain.glb'), blocks = await drawn('uastc.glb');
    if (process.env.COTAN_PICTURES)
      for (const [name, { url }] of Object.entries({ plain, blocks })) fs.writeFileSync(path.join(process.env.COTAN_PICTURES, `${name}.png`), Buffer.from(url.split(',')[1], 'base64'));
    const { mean, most } = compared(plain.pixels, blocks.pixels);
    console.log(`filament: ${mean.toFixed(2)} of 255 on average, ${most} at most; the picture spans ${spread(plain.pixels)}`);
    assert.ok(spread(plain.pixels) > 60, 'the relief is drawn');
    assert.ok(mean < 2, `${mean} of 255`);
    assert.deepEqual(said, []);
    await page.close();
  },
};
await runCases(cases, only);
await browser.close();
close();
