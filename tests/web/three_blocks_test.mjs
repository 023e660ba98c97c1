// Stock three.js draws the blocks that `cotan map convert --compress` writes, in headless Chromium, with the
// error that `cotan map diff` names: node three_blocks_test.mjs SOURCES NODE_MODULES TOOL [CASE]
// SOURCES: bindings/js. Exit code 77: skipped.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { launch, serve } from './chromium.mjs';
import { emptyFolder, runCases, skip } from './shared.mjs';

const [sources, modules, tool, only] = process.argv.slice(2);
if (!fs.existsSync(path.join(modules, 'three'))) skip('three is not installed (see the test npm_packages)');
if (!fs.existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium')) skip('no chromium');
const folder = emptyFolder(), size = 64;
const { address, close } = await serve({ modules, made: folder });
const browser = await launch(modules);
const kTwo = ['bc5', 'eac-rg11'], kThree = ['bc7', 'uastc', 'astc-4x4', 'astc-6x6']; // the formats that three's KTX2Loader knows

// A relief with two waves and noise, so that blocks lose something.
async function writeMap() {
  const { encodePng } = await import(path.resolve(sources, 'src/png.js'));
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
  const errors = {};
  for (const word of ['none', ...kTwo, ...kThree]) {
    run('convert', 'map.png', '--from', 'gltf', '--to', kTwo.includes(word) ? 'gltf,xy' : 'gltf', '--compress', word, '-o', `${word}.ktx2`);
    errors[word] = JSON.parse(run('diff', 'map.png', `${word}.ktx2`, '--from', 'gltf', '--to', 'gltf', '--json', '-', '--quiet')).angles.mean_degrees;
  }
  return errors;
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

const cases = {
  async threeDrawsTheFilesWithTheErrorsThatDiffNames() {
    await writeMap();
    const errors = writeBlocks(), page = await browser.newPage(), said = [], build = '/modules/three/build';
    await page.route(address, route => route.fulfill({ contentType: 'text/html', body: `<!doctype html><script type="importmap">${JSON.stringify({ imports: { three: `${build}/three.module.js` } })}</script>` }));
    page.on('console', message => { if (message.type() === 'error' || /THREE/.test(message.text())) said.push(message.text()); });
    await page.goto(address);
    const plain = await drawnByThree(page, 'none'), formats = new Set([plain.format]);
    assert.ok(new Set(plain.normals.map(c => c.toFixed(2))).size > 50, 'the relief is drawn');
    for (const word of [...kTwo, ...kThree]) {
      const { format, normals } = await drawnByThree(page, word), angle = meanAngle(normals, plain.normals);
      console.log(`${word}: ${angle.toFixed(3)} degrees in three, ${errors[word].toFixed(3)} by map diff`);
      formats.add(format);
      assert.ok(errors[word] > 0.1, 'blocks lose something');
      // `none` has 8 bits, which are up to 0.2 degrees away from the 16 of the map.
      assert.ok(Math.abs(angle - errors[word]) < 0.1 + 0.1 * errors[word], `${word}: ${angle} and ${errors[word]}`);
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
};
await runCases(cases, only);
await browser.close();
close();
