// The package's single files in pages without a bundler, as servers of files serve them:
//   node one_file_test.mjs TARBALL NODE_MODULES [CASE]
// The page is that of bindings/js/README.md, beside the unpacked package. Exit code 77: skipped.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { gzipSync } from 'node:zlib';
import { launch, serve } from './chromium.mjs';
import { data, missing } from './data.mjs';
import { emptyFolder, here, installed, runCases, skip } from './shared.mjs';

const [tarball, modules, only] = process.argv.slice(2);
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
for (const name of ['three', 'fast-png', 'playwright-core']) if (!fs.existsSync(path.join(modules, name))) skip(`${name} is not installed (see the test npm_packages)`);
if (!fs.existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium')) skip('no chromium');
if (missing) skip(missing);
const { decode } = await import(path.join(path.resolve(modules), 'fast-png/lib/index.js'));
const cotan = path.join(installed(tarball), 'node_modules/cotan'), model = path.join(data, 'models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb');
const judged = emptyFolder(); // where three_judge.js finds untangle()
fs.mkdirSync(path.join(judged, 'three'));
fs.copyFileSync(path.join(cotan, 'dist/three.js'), path.join(judged, 'three/index.js'));
const { address, close } = await serve({ package: judged, dist: path.join(cotan, 'dist'), modules, data, tests: here });
const browser = await launch(modules);

// Opens a page with a text. unpkg.com is answered with the files of npm's packages. said: gets errors.
async function opened(body) {
  const page = await browser.newPage({ viewport: { width: 320, height: 240 } }), said = [];
  page.on('pageerror', (error) => said.push(error.message));
  page.on('console', (message) => { if (message.type() === 'error' && !/favicon/.test(message.location().url)) said.push(message.text()); });
  await page.route('https://unpkg.com/**', (route) => {
    const [, name, file] = /^\/(\w+)(?:@[\d.]+)?\/(.*)$/.exec(new URL(route.request().url()).pathname);
    return route.fulfill({ path: path.join(modules, name, file), contentType: 'text/javascript', headers: { 'access-control-allow-origin': '*' } });
  });
  await page.route(`${address}package/dist/*`, (route) => route.fulfill({ path: path.join(cotan, 'dist', path.basename(new URL(route.request().url()).pathname)), contentType: 'text/javascript' }));
  await page.route(`${address}model.glb`, (route) => route.fulfill({ path: model }));
  await page.route(address, (route) => route.fulfill({ contentType: 'text/html', body }));
  await page.goto(address);
  return { page, said };
}
const withMap = (imports) => `<!doctype html><script type="importmap">${JSON.stringify({ imports: { 'three/addons/': '/modules/three/examples/jsm/', ...imports } })}</script>`;

const cases = {
  async thePageOfTheReadmeDrawsItsModel() {
    const [, text] = /```html\n(<!doctype html>\n<style>[^]*?)```/.exec(fs.readFileSync(path.join(cotan, 'README.md'), 'utf8')) ?? assert.fail('the README has no page');
    const { page, said } = await opened(text);
    let values = 0;
    for (const began = Date.now(); values < 150 && said.length === 0 && Date.now() - began < 60000;) {
      await page.waitForTimeout(300);
      const { data: pixels, width, height, channels } = decode(await page.screenshot());
      values = new Set(Array.from({ length: width * height }, (_, k) => pixels[channels * k] * 65536 + pixels[channels * k + 1] * 256 + pixels[channels * k + 2])).size;
    }
    assert.deepEqual(said, []);
    assert.ok(values >= 150, `${values} colours`);
    await page.close();
  },

  async theModelLooksAsWithItsTangents() {
    const { page, said } = await opened(withMap({ three: '/modules/three/build/three.module.js' }));
    const { default: { normal } } = await page.evaluate(async () => (await import('/tests/three_judge.js')).measure('/data/models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb', { default: {} }));
    console.log(JSON.stringify(normal));
    assert.deepEqual([said, normal.frames], [[], ['orthonormal']]);
    assert.ok(normal.count > 10000 && normal.mean < 0.1, `${normal.mean} degrees`);
    await page.close();
  },

  async bothFilesExportWhatTheirEntriesDo() {
    const maps = { three: { three: '/modules/three/build/three.module.js' },
      'three-tsl': { three: '/modules/three/build/three.webgpu.js', 'three/webgpu': '/modules/three/build/three.webgpu.js', 'three/tsl': '/modules/three/build/three.tsl.js' } };
    for (const [name, map] of Object.entries(maps)) {
      const { page, said } = await opened(withMap(map));
      const found = await page.evaluate(async (name) => {
        const THREE = await import('three'), module = await import(`/dist/${name}.js`), map = new THREE.DataTexture(Uint8Array.of(128, 128, 255, 255), 1, 1);
        const material = new THREE.MeshStandardMaterial({ normalMap: map }), mesh = new THREE.Mesh(new THREE.SphereGeometry(), material), [{ frame }] = module.untangle(mesh, { frame: 'smooth' });
        let code;
        try { module.untangle(7); } catch (error) { code = error instanceof module.CotanError && error.code; }
        return { names: Object.keys(module).sort(), frame, node: !!material.normalNode, vectors: !!mesh.geometry.attributes.cotanU, code };
      }, name);
      assert.deepEqual(said, []);
      assert.deepEqual(found, { names: ['CotanError', 'addRelief', ...name === 'three' ? [] : ['perturbedNormal'], 'replaceFrame', 'untangle', 'untangled'], frame: 'smooth', node: name !== 'three', vectors: true, code: 'usage' });
      await page.close();
      const size = gzipSync(fs.readFileSync(path.join(cotan, `dist/${name}.js`)), { level: 9 }).length;
      assert.ok(size > 10000 && size < 29000, `${name}: ${size} bytes`);
    }
  },
};
await runCases(cases, only);
await browser.close();
close();
