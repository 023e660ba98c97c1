// The scenes of docs/how-to/beyond.md that stock three.js draws differently, measured against the truth:
//   node three_beyond_test.mjs SOURCES NODE_MODULES TOOL [CASE]
// SOURCES: bindings/js. TOOL: cotan, whose printed text is used as the page says. With IMAGES=FOLDER in the environment it
// writes the images of the page: IMAGES=docs/pictures. Exit code 77: skipped.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { launch, serve } from './chromium.mjs';
import { here, runCases, skip } from './shared.mjs';

const [sources, modules, tool, only] = process.argv.slice(2);
if (!fs.existsSync(path.join(modules, 'three'))) skip('three is not installed (see the test npm_packages)');
if (!fs.existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium')) skip('no chromium');
const { address, close } = await serve({ package: sources, modules, tests: here });
const browser = await launch(modules), guide = fs.readFileSync(path.join(here, '../../docs/how-to/beyond.md'), 'utf8');

async function measured(scene, given) {
  const page = await browser.newPage(), said = [], build = '/modules/three/build';
  const imports = { three: scene === 'parallax' ? `${build}/three.webgpu.js` : `${build}/three.module.js`, 'three/webgpu': `${build}/three.webgpu.js`, 'three/tsl': `${build}/three.tsl.js`, 'three/addons/': '/modules/three/examples/jsm/' };
  await page.route(address, route => route.fulfill({ contentType: 'text/html', body: `<!doctype html><script type="importmap">${JSON.stringify({ imports })}</script>` }));
  page.on('console', message => { if (message.type() === 'error') said.push(message.text()); });
  await page.goto(address);
  const { errors, image } = await page.evaluate(async ([scene, given, isDrawn]) => {
    const scenes = await import('/tests/three_beyond.js'), { errors, panels } = await scenes[scene](given);
    return { errors, image: isDrawn && scenes.joined(panels) };
  }, [scene, given, !!process.env.IMAGES]);
  await page.close();
  assert.deepEqual(said, []);
  console.log(`${scene}: ${JSON.stringify(errors, (_, x) => (typeof x === 'number' ? Number(x.toPrecision(3)) : x))}`);
  if (image) fs.writeFileSync(path.join(process.env.IMAGES, `three-${scene}.jpg`), Buffer.from(image, 'base64'));
  return errors;
}

/** The page's row for a scene: the numbers in it, which are those measured, but for rounding and another rasteriser. */
function expectPage(scene, ...expected) {
  const row = guide.split('\n').find(line => line.startsWith(`| ${scene} |`)) ?? assert.fail(`beyond.md has no row ${scene}`);
  const numbers = row.split('|').slice(2).join(' ').match(/\d+(\.\d+)?/g).map(Number);
  assert.equal(numbers.length, expected.length, row);
  numbers.forEach((number, k) => assert.ok(Math.abs(number - expected[k]) <= 0.06 + 0.05 * expected[k], `${row}: ${number} is now ${expected[k]}`));
}

const cases = {
  async parallaxUvTakesOneStepAlongUnitTangents() {
    const errors = await measured('parallax');
    assert.ok(errors.cotan < 0.5, 'the search ends within depth / 64 / 64, and half floats round');
    for (const stock of [errors.stock, errors['stock, tangents']]) assert.ok(stock > 20 * errors.cotan && stock > 5, `${stock} texels`);
    const row = (more = '') => ['cotan', 'stock', 'stock, tangents'].map(name => errors[name + more]);
    expectPage('parallax, sheared and mirrored', ...row());
    expectPage('parallax, square texels', ...row(', square'));
  },
  async decalsOfThreeCoverTheBumpsBelow() {
    const text = execFileSync(tool, ['shader', '--lang', 'essl', '--set', 'space,mapping,gradient', '--frame', 'gradient', '--form', 'total'], { encoding: 'utf8' });
    const errors = await measured('decal', { text });
    assert.ok(errors.cotan < 0.5);
    assert.ok(errors.stock > 5 * errors.cotan && errors['stock, to the decal alone'] < 1);
    expectPage('a decal over a seam, with the bumps below it', errors.cotan, errors.stock);
    expectPage('the decal alone', errors['stock, to the decal alone']);
  },
  async anisotropyOfThreeNeedsTangents() {
    const errors = await measured('grooves');
    for (const rotation of ['', ', rotation']) {
      assert.ok(errors[`cotan${rotation}`] < 1 && errors[`stock, tangents${rotation}`] < 1);
      assert.ok(errors[`stock${rotation}`] > 20);
      expectPage(rotation ? 'grooves, turned by `anisotropyRotation`' : 'grooves', ...['cotan', 'stock', 'stock, tangents'].map(name => errors[name + rotation]));
    }
  },
};
await runCases(cases, only);
await browser.close();
close();
