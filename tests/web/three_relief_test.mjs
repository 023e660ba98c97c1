// Height maps of cotan/three/relief and cotan/three/tsl/relief in headless Chromium, compared with rays against the
// displaced surface: node three_relief_test.mjs SOURCES NODE_MODULES [CASE]
// SOURCES: bindings/js. Exit code 77: skipped.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { kGpuArguments, launch, serve } from './chromium.mjs';
import { here, runCases, skip } from './shared.mjs';

const [sources, modules, only] = process.argv.slice(2);
if (!fs.existsSync(path.join(modules, 'three'))) skip('three is not installed (see the test npm_packages)');
if (!fs.existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium')) skip('no chromium');
const { address, close } = await serve({ package: sources, modules, tests: here });
const browser = await launch(modules, kGpuArguments);

// Calls a function of three_relief_scenes.js in a page of its own, with a version of three. Expects no error, and no warning of three.
async function asked(way, what, three = 'three') {
  const page = await browser.newPage(), said = [], build = `/modules/${three}/build`;
  const imports = way.startsWith('nodes') ? { three: `${build}/three.webgpu.js`, 'three/webgpu': `${build}/three.webgpu.js`, 'three/tsl': `${build}/three.tsl.js` } : { three: `${build}/three.module.js` };
  await page.route(address, route => route.fulfill({ contentType: 'text/html', body: `<!doctype html><script type="importmap">${JSON.stringify({ imports })}</script>` }));
  const isExpected = /attribute "uv" not found/; // where the scene has none
  page.on('console', message => { if (message.type() === 'error' || /THREE/.test(message.text()) && !isExpected.test(message.text())) said.push(message.text()); });
  await page.goto(address);
  const found = await page.evaluate(async ([way, what]) => {
    const scenes = await import('/tests/three_relief_scenes.js'), given = await scenes.opened(way);
    const found = given && await scenes[what](given);
    return ArrayBuffer.isView(found) ? [...found] : found;
  }, [way, what]);
  await page.close();
  assert.deepEqual(said, [], `${way}, ${what}`);
  if (found === undefined) console.log(`left out: ${way}, ${what}: no WebGPU`);
  return found;
}
const kWays = ['webgl', 'nodes webgl', 'nodes webgpu'];
async function each(what, check) {
  for (const way of process.env.WAYS?.split(',') ?? kWays) {
    const found = await asked(way, what);
    if (found === undefined) continue;
    console.log(`${way}, ${what}: ${JSON.stringify(found, (_, x) => (typeof x === 'number' ? Number(x.toPrecision(4)) : x))}`);
    check(found, way);
  }
}

// On the plane the search ends within depth / 64 / 64 of the truth, and half floats of the map round by 1/8 texel. A few rays
// meet an edge of a box elsewhere. A cylinder of radius 1 is taken as its tangent plane, whose error is depth over radius.
function expectTruth({ plane, cylinder }, label) {
  assert.ok(plane.count > 1600 && cylinder.count > 1600, label);
  assert.ok(plane.mean < 0.5 && plane.most95 < 1 && plane.without > 15, `${label}: ${JSON.stringify(plane)}`);
  assert.ok(cylinder.mean < 0.1 * cylinder.without && cylinder.without > 15, `${label}: ${JSON.stringify(cylinder)}`);
}

const cases = {
  reliefIsWhereTheLineOfSightMeetsIt: () => each('truth', expectTruth),

  sidesShadingAndUvSetsDoNotMatter: () => each('kinds', (found, way) => {
    assert.equal(Object.keys(found).length, 9);
    for (const [name, off] of Object.entries(found)) assert.ok(off < 0.5, `${way}, ${name}: ${off}`);
  }),

  async olderVersionsOfThreeDrawTheSame() {
    for (const three of ['three160', 'three180']) if (fs.existsSync(path.join(modules, three))) expectTruth(await asked('webgl', 'truth', three), three);
  },

  async nodesOfOlderVersionsAreRefusedByName() {
    if (!fs.existsSync(path.join(modules, 'three180'))) skip('three180 is not installed (see the test npm_packages)');
    await assert.rejects(asked('nodes webgl', 'truth', 'three180'), /expected version 0\.187 or later for cotan\/three\/tsl\/relief, found 180/);
  },

  async nodesDrawWhatWebGLRendererDraws() {
    const [first, ...others] = (await Promise.all(kWays.map(way => asked(way, 'images')))).filter(Boolean);
    assert.ok(others.length > 0);
    for (const other of others) {
      const apart = first.map((x, k) => Math.abs(x - other[k])).sort((a, b) => a - b);
      // u and v are stored as a quarter; edges of triangles and of boxes may lie in other pixels.
      assert.ok(apart[Math.floor(0.995 * apart.length)] < 0.25 / 512, `${apart[Math.floor(0.995 * apart.length)] * 4 * 512} texels`);
    }
  },

  twoMaterialsKeepTheirMapsAndDepths: () => each('pairs', (found, way) => {
    assert.deepEqual(Object.keys(found), ['depths', 'depths, exchanged', 'maps', 'maps, exchanged']);
    for (const [name, texels] of Object.entries(found)) for (const off of texels) assert.ok(off < 0.5, `${way}, ${name}: ${texels}`);
  }),

  mipsAreThoseOfTheSurface: () => each('mips', ({ levels, worst }, way) => {
    assert.ok(levels > 3, `${way}: the drawing reads ${levels} mips`);
    assert.ok(worst < 2e-3, `${way}: ${worst}`); // where between two mips, of which it is 0.1 from one to the next
  }),

  shadowsAreWhereTheRayToTheLightMeetsTheRelief: () => each('shadow', ({ count, dark, agree }, way) => {
    assert.ok(count > 4000 && dark > 0.05 && dark < 0.6, `${way}: ${dark} of ${count} in the shadow`);
    assert.ok(agree > 0.98, `${way}: ${agree}`);
  }),

  // The search ends within 0.2 / 64 / 64 of the constant height: 0.004 texels, where a texel is 100 of 255 at most.
  everyMapIsLookedUpAtTheMovedCoordinates: () => each('everyMap', (found, way) => {
    for (const [name, { off, signal }] of Object.entries(found)) {
      assert.ok(signal > 2, `${way}, ${name}: the map changes the drawing by ${signal}`);
      assert.ok(off < 1 && off < signal / 8, `${way}, ${name}: ${off} of 255, ${signal} without the relief`);
    }
  }),

  inputWithoutAReliefDrawsTheSurfaceAsItIs: () => each('degenerate', (found, way) => {
    for (const [name, { broken, apart }] of Object.entries(found)) assert.ok(broken === 0 && apart < 1e-3, `${way}, ${name}: ${broken} values are not finite, ${apart} apart`);
  }),

  orderOfCallsAndClonesDoNotMatter: () => each('calls', ({ signal, same, removed }, way) => {
    for (const count of signal) assert.ok(count > 1000, `${way}: ${signal}`);
    for (const [name, count] of Object.entries({ ...same, removed })) assert.equal(count, 0, `${way}, ${name}`);
  }),
};
await runCases(cases, only);
await browser.close();
close();
