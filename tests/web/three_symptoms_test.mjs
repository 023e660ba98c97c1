// Every entry with a tick of docs/how-to/three-normal-maps.md in stock three.js, before and after the line of the page,
// compared with the analytic relief: node three_symptoms_test.mjs SOURCES NODE_MODULES [CASE]
// SOURCES: bindings/js. Exit code 77: skipped.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { launch, serve } from './chromium.mjs';
import { here, runCases, skip } from './shared.mjs';

const [sources, modules, only] = process.argv.slice(2);
if (!fs.existsSync(path.join(modules, 'three'))) skip('three is not installed (see the test npm_packages)');
if (!fs.existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium')) skip('no chromium');
const { address, close } = await serve({ package: sources, modules, tests: here });
const browser = await launch(modules), guide = fs.readFileSync(path.join(here, '../../docs/how-to/three-normal-maps.md'), 'utf8');
const page = await browser.newPage(), said = [];
await page.route(address, route => route.fulfill({ contentType: 'text/html', body: `<!doctype html><script type="importmap">${JSON.stringify({ imports: { three: '/modules/three/build/three.module.js' } })}</script>` }));
page.on('console', message => { if (message.type() === 'error') said.push(message.text()); });
await page.goto(address);

// Entries with a tick: what one sees -> its last line.
const rows = Object.fromEntries([...guide.matchAll(/^- \*\*(.+)\*\* ✓((?:.+\n)(?:  .+\n)*)/gm)].map(([, seen, text]) => [seen, text.trim().split('\n').at(-1).trim()]));
const code = line => /^`(.*)`$/.exec(line)?.[1] ?? assert.fail(`${line}: expected one line of code`);
const block = start => guide.match(/```js\n[^]*?```/g).map(text => text.slice(6, -3)).find(text => text.startsWith(start)) ?? assert.fail(start);
const used = new Set();

// row: the beginning of what one sees, but for its capital.
async function measured(name, row, line) {
  const found = Object.keys(rows).filter(text => text.toLowerCase().startsWith(row.toLowerCase()));
  assert.equal(found.length, 1, `rows "${row}": ${found}`);
  used.add(found[0]);
  const result = await page.evaluate(async ([name, line]) => (await import('/tests/three_symptoms.js')).measure(name, line), [name, line ?? code(rows[found[0]])]);
  console.log(`${row}: ${JSON.stringify(result, (_, x) => (typeof x === 'number' ? Number(x.toPrecision(3)) : x))}`);
  assert.ok(result.after.drawn > 3000 && result.after.broken === 0, row);
  return result;
}

// Expects a fault of at least `wrong` degrees, and `right` after the line: the eight bits of the map, between texels.
async function isFixed(name, row, { wrong = 10, right = 0.3 } = {}) {
  const { before, after } = await measured(name, row);
  assert.ok(before.degrees > wrong, `${row}: ${before.degrees} degrees before`);
  assert.ok(after.degrees < right, `${row}: ${after.degrees} degrees after`);
}

const cases = {
  async bumpsThatLookLikeDentsAreFixed() {
    await isFixed('green', 'dents instead of bumps');
    await isFixed('mirroredUv', 'dents where uv are mirrored');
    await isFixed('mirroredMesh', 'dents on a mesh with negative scale');
    await isFixed('flippedRows', 'a new map on a loaded glTF');
    await isFixed('rowsFromTheTop', 'a KTX2 map on a shape');
    await isFixed('rotated', 'light is wrong where the texture is rotated');
    await isFixed('secondUv', 'light is wrong with `map.channel = 1`');
  },

  async aMapThatIsSetLateNeedsAnUpdate() { await isFixed('late', 'nothing changes'); },

  async strengthIsFixed() {
    await isFixed('colour', 'everything leans', { wrong: 20 });
    await isFixed('weak', 'relief is too weak', { wrong: 5, right: 0.5 }); // half the slopes, in the same eight bits
  },

  // 24 x 16 facets: interpolated normals remain 0.1 degrees off, and those of the seam and the poles more.
  async facetsAreFixed() { await isFixed('facets', 'facets on a model without normals', { wrong: 3, right: 1 }); },

  async tangentsOfLength0BreakPixels() {
    const { before, after } = await measured('noTangent', 'black or flickering spots');
    assert.ok(before.broken > 1000 || before.degrees > 5, JSON.stringify(before));
    assert.ok(after.degrees < 0.3, `${after.degrees} degrees`);
  },

  async coatsAreFixed() {
    await isFixed('coat', 'only the coat has dents');
    const { before, after } = await measured('coatOfTwo', 'the coat is black', 'ofThree()');
    assert.ok(before.degrees > 90, `${before.degrees} degrees: it faces away`);
    assert.ok(after.degrees < 0.3, `${after.degrees} degrees`);
  },

  async mirroredInstancesAreDrawn() {
    const { before, after } = await measured('mirroredInstance', 'mirrored instances', block('mesh.scale.x = -1;'));
    assert.equal(before.drawn, 0);
    assert.ok(after.degrees < 0.3, `${after.degrees} degrees`);
  },

  async meshNormalMaterialDrawsTwoChannels() {
    assert.deepEqual(said, []);
    const { before, after } = await measured('twoChannels', '`MeshNormalMaterial` draws nothing', block("material.onBeforeCompile = (shader) => {\n  shader.fragmentShader = '#define"));
    assert.equal(before.drawn, 0);
    assert.match(said.join(), /saturate/);
    assert.ok(after.degrees < 0.3, `${after.degrees} degrees`);
  },

  async everyEntryWithATickIsRun() {
    if (!only) assert.deepEqual([...used].sort(), Object.keys(rows).sort());
  },
};
await runCases(cases, only);
await browser.close();
close();
