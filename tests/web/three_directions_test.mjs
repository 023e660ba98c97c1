// Directions of anisotropic highlights and normals of clear coats after untangle(), where maps have texture coordinates of their
// own, compared with formulas and with stock three.js that has tangents: node three_directions_test.mjs SOURCES NODE_MODULES [CASE]
// SOURCES: bindings/js. With ALL in the environment it only prints all measurements. Exit code 77: skipped.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { kGpuArguments, launch, serve } from './chromium.mjs';
import { data, missing } from './data.mjs';
import { here, runCases, skip } from './shared.mjs';

const [sources, modules, only] = process.argv.slice(2);
if (!fs.existsSync(path.join(modules, 'three'))) skip('three is not installed (see the test npm_packages)');
if (!fs.existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium')) skip('no chromium');
const { address, close } = await serve({ package: sources, modules, data, tests: here });
const browser = await launch(modules, kGpuArguments);

async function measured(kind, call, given) {
  const page = await browser.newPage(), build = '/modules/three/build', said = [];
  const imports = { three: kind === 'webgl' ? `${build}/three.module.js` : `${build}/three.webgpu.js`, 'three/webgpu': `${build}/three.webgpu.js`, 'three/tsl': `${build}/three.tsl.js`, 'three/addons/': '/modules/three/examples/jsm/' };
  await page.route(address, route => route.fulfill({ contentType: 'text/html', body: `<!doctype html><script type="importmap">${JSON.stringify({ imports })}</script>` }));
  page.on('console', message => { if (message.type() === 'error' && !/favicon/.test(message.location().url)) said.push(message.text()); });
  await page.goto(address);
  const found = await page.evaluate(async ([call, given]) => (await import('/tests/three_directions.js'))[call](...given), [call, given]);
  await page.close();
  assert.deepEqual(said, []);
  return found;
}

function print(kind, found) {
  for (const [surface, cases] of Object.entries(found))
    for (const [label, ways] of Object.entries(cases))
      console.log(`${kind}, ${surface}, ${label}: ${Object.entries(ways).map(([way, { mean, most, tangents }]) => `${way} ${mean.toFixed(2)}, ${most.toFixed(1)}${tangents ? ' (has tangents)' : ''}`).join('; ')}`);
}

// limits: by way, the least and the greatest mean error in degrees, and whether the mesh has tangents.
function expectAll(found, limits) {
  for (const [way, { mean, pixels, tangents }] of Object.entries(found)) {
    const [from, to, has = false] = limits[way];
    assert.ok(pixels > 10000 && mean >= from && mean <= to, `${way}: expected ${from} to ${to} degrees, found ${mean} in ${pixels} pixels`);
    assert.equal(tangents, has, `${way}: whether the mesh has tangents`);
  }
}

const kBoth = ['stock, tangents', 'untangled, tangents'];
const kKept = 'coat on set 1 over grooves of set 0', kOnOther = 'map of grooves on set 1', kMirrored = 'no maps, rotation, mirrored mesh';
async function hold(kind) {
  const under = 'bumps on set 1, map of grooves on set 0', stays = 'coat on set 1, map of grooves on set 0';
  const found = await measured(kind, 'measure', [kind, [
    { surfaces: kind === 'webgl' ? ['plane', 'sphere', 'torus'] : ['torus'], cases: ['no maps, rotation'], ways: kBoth },
    { surfaces: ['torus'], cases: [kMirrored], ways: [...kBoth, 'untangled, tangents stay'] },
    { surfaces: ['torus'], cases: [kOnOther], ways: ['stock', ...kBoth, 'untangled', 'orthonormal'] },
    { surfaces: ['torus'], cases: [under, stays, kKept, 'coat on set 1, bumps on set 0'], ways: kBoth },
  ]]);
  if (!found) skip('no WebGPU in this Chromium');
  print(kind, found);
  for (const { 'no maps, rotation': one } of Object.values(found)) expectAll(one, { 'stock, tangents': [0, 0.1, true], 'untangled, tangents': [0, 0.3] });
  const { torus } = found, judge = [0, 0.1, true];
  expectAll(torus[kMirrored], { 'stock, tangents': [20, 180, true], 'untangled, tangents': [0, 0.3], 'untangled, tangents stay': judge });
  expectAll(torus[kOnOther], { stock: [20, 180], 'stock, tangents': judge, 'untangled, tangents': [0, 0.3], untangled: [0, 0.3], orthonormal: [0, 2] });
  expectAll(torus[under], { 'stock, tangents': judge, 'untangled, tangents': [0, 0.3] });
  // `smooth` is for one set of texture coordinates, and `orthonormal` is too far off: the tangents stay.
  expectAll(torus[stays], { 'stock, tangents': judge, 'untangled, tangents': judge });
  expectAll(torus[kKept], { 'stock, tangents': [10, 180, true], 'untangled, tangents': [0, 1, true] });
  expectAll(torus['coat on set 1, bumps on set 0'], { 'stock, tangents': [10, 180, true], 'untangled, tangents': [0, 1] });
}

const cases = {
  eachMapHasAFrameOfItsOwn: () => hold('webgl'),
  eachMapHasAFrameOfItsOwnOnWebGPU: () => hold('webgpu'),

  // The nodes are the same as on WebGPU, but their functions are another text.
  async eachMapHasAFrameOfItsOwnInNodesOnWebGL() {
    const found = await measured('nodes', 'measure', ['nodes', [{ surfaces: ['torus'], cases: [kOnOther], ways: ['untangled'] }, { surfaces: ['torus'], cases: [kKept], ways: ['untangled, tangents'] }]]);
    print('nodes', found);
    expectAll(found.torus[kOnOther], { untangled: [0, 0.3] });
    expectAll(found.torus[kKept], { 'untangled, tangents': [0, 1, true] });
  },

  // Its spheres have 24 segments: 1.2 degrees with `orthonormal`, which was once taken without looking.
  async groovesOfAModelAreThoseOfItsTangents() {
    if (missing) skip(missing);
    const found = await measured('webgl', 'measureModel', ['/data/models/AnisotropyStrengthTest/AnisotropyStrengthTest.glb']);
    console.log(JSON.stringify(found));
    assert.ok(found.pixels > 1000 && found.mean < 0.2, `${found.mean} degrees`);
    assert.deepEqual([found.frames, found.tangents], [['smooth'], 0]);
  },
};
if (process.env.ALL) for (const kind of ['webgl', 'nodes', 'webgpu']) print(kind, await measured(kind, 'measure', [kind]) ?? {});
else await runCases(cases, only);
await browser.close();
close();
