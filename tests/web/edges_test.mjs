// What happens to the frame at the edges of triangles and of control flow, on software drivers in headless Chromium:
//   node edges_test.mjs NODE_MODULES COTAN [CASE]
//   node edges_test.mjs NODE_MODULES COTAN --print    the rows of docs/how-to/beyond.md
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

import { launch } from './chromium.mjs';
import { here, runCases, skip } from './shared.mjs';

const [modules, tool, only] = process.argv.slice(2);
if (!fs.existsSync(path.join(modules, 'playwright-core'))) skip('playwright-core is not installed');
const kDrivers = { // options that follow those of launch()
  swiftshader: ['--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader'],
  mesa: ['--use-angle=gl-egl', '--ignore-gpu-blocklist'], // WebGL 2 only
};

async function measured(driver, form, frame, names) {
  const print = (lang) => execFileSync(tool, ['shader', '--lang', lang, '--frame', frame, '--form', form], { encoding: 'utf8' });
  const browser = await launch(modules, kDrivers[driver]);
  try {
    const page = await browser.newPage();
    await page.route('http://localhost/', (route) => route.fulfill({ contentType: 'text/html', body: '<!doctype html>' })); // WebGPU wants a safe origin
    await page.goto('http://localhost/');
    await page.addScriptTag({ path: path.join(here, 'edges.js') });
    const found = await page.evaluate(([texts, names]) => globalThis.measureEdges(texts, names), [{ essl: print('essl'), wgsl: print('wgsl') }, names]);
    for (const { error } of Object.values(found)) assert.ok(!error, `${driver}: ${error}`);
    return found;
  } finally {
    await browser.close();
  }
}
const kept = new Map();
/** Results by the name of the way, of WebGL 2 and of WebGPU. Ends the case if the driver is not there. */
async function results(driver, form = 'fused', frame = 'gradient', names = undefined) {
  const key = [driver, form, frame, names].join();
  if (!kept.has(key)) kept.set(key, await measured(driver, form, frame, names));
  const found = kept.get(key);
  if (driver === 'mesa') {
    if (!/llvmpipe/.test(found.webgl2.driver ?? '')) skip('Chromium takes no llvmpipe here');
    return [found.webgl2.found];
  }
  assert.ok(found.webgl2.found && found.webgpu.found, JSON.stringify(found));
  return [found.webgl2.found, found.webgpu.found];
}

// Half floats store the multisampled results: steps of 0.03 degrees at 40, and far smaller ones here. In float32 the
// error of a footprint of 1e-3 of the distance is 0.002 degrees, and slivers at the silhouette have a tenth of that.
const kExact = 0.05;
const kExactWays = ['one sample', 'one sample, triangles of 2 pixels', 'up to the horizon', 'MSAA', 'MSAA, triangles of 2 pixels', 'coarse differences', 'fine differences',
  'discard after the call', 'differences before an if'];

function expectExact(ways, names, api) {
  for (const name of names) {
    const way = ways[name];
    if (!way && /coarse|fine/.test(name) && api !== 'WebGPU') continue; // WebGL 2 does not have it
    assert.ok(way.count > 4000 && way.broken === 0, `${api}, ${name}: ${JSON.stringify(way)}`);
    assert.ok(way.worst < kExact, `${api}, ${name}: ${way.worst} degrees`);
    assert.equal(way.plain, 0, `${api}, ${name}: bumps are gone`);
  }
}

const cases = {
  async helperLanesAndMsaaLeaveTheFrameExact() {
    (await results('swiftshader')).forEach((ways, k) => expectExact(ways, kExactWays, k ? 'WebGPU' : 'WebGL 2'));
    const few = ['up to the horizon', 'MSAA, triangles of 2 pixels'];
    for (const frame of ['orthonormal', 'cotangent'])
      for (const ways of await results('swiftshader', 'fused', frame, few)) expectExact(ways, few, frame);
  },
  async helperLanesAndMsaaDoSoOnAnotherDriver() {
    for (const ways of await results('mesa')) expectExact(ways, kExactWays, 'llvmpipe');
  },
  async centroidForUvAloneBreaksTheFrame() {
    for (const driver of Object.keys(kDrivers))
      for (const ways of await results(driver))
        assert.ok(ways['centroid for uv only'].mean > 2, driver);
  },
  async nothingGivesNaN() {
    const wrong = ['centroid, triangles of 2 pixels', 'centroid for uv only, triangles of 2 pixels', 'sample shading', 'normalised position', 'constant position'];
    for (const form of ['fused', 'total'])
      for (const ways of await results('swiftshader', form, 'gradient', form === 'total' ? wrong : undefined))
        for (const [name, way] of Object.entries(ways)) assert.equal(way.broken, 0, `${form} ${name}`);
    for (const ways of await results('mesa'))
      for (const [name, way] of Object.entries(ways)) assert.equal(way.broken, 0, name);
  },
  async aNormalisedPositionLeansAndAConstantOneIsFlat() {
    for (const ways of await results('swiftshader')) {
      assert.ok(ways['normalised position'].mean > 11);
      assert.equal(ways['constant position'].plain, 1);
    }
  },
  async thePageHasTheMeasuredNumbers() {
    const page = fs.readFileSync(path.join(here, '../../docs/how-to/beyond.md'), 'utf8');
    const [webgl2, webgpu] = await results('swiftshader');
    const rows = [...page.split('## At the edges')[1].split('\n## ')[0].matchAll(/^\| ([^|]+?) +\| ([^|]+?) +\|/gm)]
      .filter(([, name]) => name in webgpu || name in webgl2);
    assert.ok(rows.length >= 8, `${rows.length} rows`);
    for (const [, name, said] of rows) assert.equal(said, shown((webgpu[name] ?? webgl2[name])), name);
  },
};

// "mean, worst" in degrees; exact below the bar.
function shown(way) {
  if (way.plain === 1) return 'no bumps';
  return way.worst < kExact ? 'exact' : `${way.mean.toPrecision(2)}, ${way.worst.toFixed(0)}`;
}

if (only === '--print')
  for (const driver of Object.keys(kDrivers))
    for (const form of ['fused', 'total'])
      (await results(driver, form)).forEach((ways, k) => {
        console.log(`${driver}, ${k ? 'WebGPU' : 'WebGL 2'}, ${form}`);
        for (const [name, way] of Object.entries(ways)) console.log(`| ${name} | ${shown(way)} |`, way.count, way.plain.toFixed(5));
      });
else await runCases(cases, only);
