// The recipe for <model-viewer> of docs/how-to/web.md, with the package from the tarball:
//   node model_viewer_test.mjs TARBALL NODE_MODULES [CASE]
// Exit code 77: skipped.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { launch, serve } from './chromium.mjs';
import { data, missing } from './data.mjs';
import { here, installed, runCases, skip } from './shared.mjs';

const [tarball, modules, only] = process.argv.slice(2);
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
for (const name of ['three183', '@google/model-viewer', 'esbuild', 'fast-png', 'playwright-core'])
  if (!fs.existsSync(path.join(modules, name))) skip(`${name} is not installed (see the test npm_packages)`);
if (!fs.existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium')) skip('no chromium');
if (missing) skip(missing);
const { decode } = await import(path.join(path.resolve(modules), 'fast-png/lib/index.js'));

// The lines of the page, with the version of three that model-viewer names. `how` replaces the options of untangle().
const guide = fs.readFileSync(path.join(here, '../../docs/how-to/web.md'), 'utf8');
const [, lines] = /```js\n(import '@google\/model-viewer';[^]*?)```/.exec(guide) ?? assert.fail('web.md has no recipe');
const folder = installed(tarball, modules, ['three183', '@google']);
fs.writeFileSync(path.join(folder, 'page.js'), `${lines.replace('untangle(scene)', '(window.decided = window.how && untangle(scene, window.how))')}\nwindow.sceneOf = sceneOf;`);
execFileSync(path.join(modules, '.bin/esbuild'), ['page.js', '--bundle', '--format=esm', '--alias:three=three183', '--outfile=bundle.js', '--log-level=error'], { cwd: folder });
const { address, close } = await serve({ app: folder, data });
const browser = await launch(modules);

// Opens a page with a model. how: options of untangle(); null draws what model-viewer draws alone. Returns the image, the
// decisions, and what is there after drawing: meshes with tangents, and the frames of materials.
async function shown(file, how) {
  const page = await browser.newPage({ viewport: { width: 320, height: 320 } }), said = [];
  page.on('pageerror', error => said.push(error.message));
  page.on('console', message => { if (message.type() === 'error' && !/favicon/.test(message.location().url)) said.push(message.text()); });
  await page.route(`${address}app/index.html`, route => route.fulfill({ contentType: 'text/html', body: `<!doctype html><style>body{margin:0}</style><script>window.how = ${JSON.stringify(how)}; addEventListener('load', () => {
    document.querySelector('model-viewer').addEventListener('load', () => { window.loaded = true; }); });
    // On a busy machine it would draw with fewer pixels.
    customElements.whenDefined('model-viewer').then(() => { customElements.get('model-viewer').minimumRenderScale = 1; });</script><script type="module" src="bundle.js"></script>
    <model-viewer src="/data/${file}" interaction-prompt="none" camera-orbit="20deg 70deg auto" style="width: 320px; height: 320px"></model-viewer>` }));
  await page.goto(`${address}app/index.html`);
  await page.waitForFunction(() => window.loaded && document.querySelector('model-viewer').modelIsVisible, undefined, { timeout: 120000 });
  // Until the model has faded in and the camera is at rest: three images alike.
  let taken = await page.screenshot();
  for (let alike = 0, tries = 0; alike < 2; ++tries) {
    assert.ok(tries < 60, 'the image never comes to rest');
    await page.waitForTimeout(700);
    const next = await page.screenshot();
    alike = next.equals(taken) ? alike + 1 : 0;
    taken = next;
  }
  const image = decode(taken);
  const found = await page.evaluate(() => {
    const frames = new Set();
    let tangents = 0;
    window.sceneOf(document.querySelector('model-viewer')).traverse(({ geometry, material }) => {
      if (!material?.normalMap) return;
      if (geometry.attributes.tangent) ++tangents;
      frames.add(/cotan,(\w+)/.exec(material.customProgramCacheKey())?.[1] ?? 'stock');
    });
    return { tangents, frames: [...frames], decided: window.decided?.map(({ frame, keepsTangents }) => ({ frame, keepsTangents })) };
  });
  await page.close();
  assert.deepEqual(said, []);
  return { image, ...found };
}

// Mean difference of the pixels in which the images are not white, in steps of 8 bits; and the number of these.
function apart({ image: a }, { image: b }) {
  let sum = 0, count = 0;
  for (let k = 0; k < a.data.length; k += a.channels) {
    if ([0, 1, 2].every(c => a.data[k + c] > 250)) continue;
    for (let c = 0; c < 3; ++c) sum += Math.abs(a.data[k + c] - b.data[k + c]) / 3;
    ++count;
  }
  return { mean: sum / count, count };
}

const cases = {
  async theRecipeDropsTangentsAndTheImageStays() {
    const file = 'models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb';
    const stock = await shown(file, null), free = await shown(file, {}), reversed = await shown(file, { convention: 'directx' });
    const same = apart(stock, free), other = apart(stock, reversed);
    console.log(JSON.stringify({ same, other, stock: [stock.tangents, stock.frames], free: [free.tangents, free.frames], decided: free.decided }));
    assert.ok(stock.tangents > 0 && stock.frames.join() === 'stock');
    assert.ok(free.tangents === 0 && free.frames.join() === 'orthonormal' && free.decided.length > 0);
    assert.ok(same.count > 10000 && same.mean < 1, `${same.count} pixels, ${same.mean} steps`);
    assert.ok(other.mean > 4 * same.mean && other.mean > 2, `reversed green changes ${other.mean} steps only`);
  },
};
await runCases(cases, only);
await browser.close();
close();
