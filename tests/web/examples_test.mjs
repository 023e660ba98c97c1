// The pages of examples/ as they are, with the npm packages that they name, in headless Chromium:
//   node examples_test.mjs ROOT NODE_MODULES [CASE]
// ROOT: the sources. Exit code 77: skipped.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { kGpuArguments, launch, serve } from './chromium.mjs';
import { dataFile } from './data.mjs';
import { runCases, skip } from './shared.mjs';

const [root, modules, only] = process.argv.slice(2);
for (const name of ['three', 'babylonjs', 'fast-png', 'playwright-core']) if (!fs.existsSync(path.join(modules, name))) skip(`${name} is not installed (see the test npm_packages)`);
if (!fs.existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium')) skip('no chromium');
const { decode } = await import(createRequire(path.join(modules, 'x.js')).resolve('fast-png'));
const { address, close } = await serve({ examples: path.join(root, 'examples'), bindings: path.join(root, 'bindings') });
const browser = await launch(modules, kGpuArguments);

/** Opens a page, which finds node_modules beside it, as its README says. `said` gets errors and failed requests. */
async function opened(name) {
  const page = await browser.newPage({ viewport: { width: 640, height: 360 } }), said = [];
  page.on('console', message => { if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver/.test(message.text())) said.push(message.text()); });
  page.on('pageerror', error => said.push(error.message));
  page.on('requestfailed', request => said.push(request.url()));
  await page.route(/\/node_modules\//, route => route.fulfill({ path: path.join(modules, new URL(route.request().url()).pathname.split('/node_modules/')[1]) }));
  await page.goto(`${address}examples/${name}`, { waitUntil: 'load' });
  return { page, said };
}

/** Brightness of pixels of the page's canvas: their number of different values, and the fraction above that of the corner. */
async function seen(page) {
  const { data, width, height, channels } = decode(await page.locator('canvas').first().screenshot()), found = [];
  for (let k = 0; k < width * height; ++k) found.push(data[channels * k] + data[channels * k + 1] + data[channels * k + 2]);
  return { values: new Set(found).size, covered: found.filter(x => x > found[0] + 30).length / found.length, found };
}

// A canvas without bumps has a few values: background and flat surfaces.
async function expectBumps(page, said, label, least = 0.15) {
  const began = Date.now();
  let look = await seen(page);
  while (!(look.values > 150 && look.covered > least) && said.length === 0 && Date.now() - began < 60000) {
    await page.waitForTimeout(300);
    look = await seen(page);
  }
  assert.deepEqual(said, [], label);
  assert.ok(look.values > 150 && look.covered > least, `${label}: ${look.values} values, ${look.covered} covered`);
  console.log(`${label}: ${look.values} values, ${(100 * look.covered).toFixed(0)} % covered`);
  return look;
}

const cases = {
  async babylonDrawsItsSheets() {
    const { page, said } = await opened('babylon/index.html');
    await expectBumps(page, said, 'babylon');
  },

  async threeDrawsItsSheetsAndAModelOfTheUser() {
    const { page, said } = await opened('three/index.html'), { found: before } = await expectBumps(page, said, 'three');
    const model = dataFile('models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb');
    if (!fs.existsSync(model)) return;
    await page.setInputFiles('#model', model);
    const began = Date.now();
    let changed = 0;
    while (changed < 0.1 && said.length === 0 && Date.now() - began < 60000) {
      await page.waitForTimeout(500);
      const { found } = await seen(page);
      changed = found.filter((x, k) => Math.abs(x - before[k]) > 20).length / before.length;
    }
    await expectBumps(page, said, 'three, a model', 0.05); // parts of metal reflect nothing
    assert.ok(changed >= 0.1, `${changed} of the image changed`);
  },

  async webGl2DrawsItsSheets() {
    const { page, said } = await opened('webgl2/index.html');
    await expectBumps(page, said, 'webgl2');
  },
};
await runCases(cases, only);
await browser.close();
close();
