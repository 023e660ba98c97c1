// cotan/react from the tarball in react-three-fiber: node react_test.mjs TARBALL NODE_MODULES [CASE]
// Exit code 77: skipped.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { kGpuArguments, launch, serve } from './chromium.mjs';
import { data, missing } from './data.mjs';
import { here, installed, runCases, skip } from './shared.mjs';

const [tarball, modules, only] = process.argv.slice(2);
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
for (const name of ['three', 'react', '@react-three/fiber', 'esbuild', 'playwright-core'])
  if (!fs.existsSync(path.join(modules, name))) skip(`${name} is not installed (see the test npm_packages)`);
if (!fs.existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium')) skip('no chromium');
if (missing) skip(missing);
const folder = installed(tarball, modules, ['three', 'react', '@react-three/fiber']);
fs.copyFileSync(path.join(here, 'react_page.jsx'), path.join(folder, 'page.jsx'));
execFileSync(path.join(modules, '.bin/esbuild'), ['page.jsx', '--bundle', '--format=esm', '--jsx=automatic', '--define:process.env.NODE_ENV="development"', '--outfile=page.js', '--log-level=error'], { cwd: folder });
fs.writeFileSync(path.join(folder, 'index.html'), '<!doctype html>');
const { address, close } = await serve({ app: folder, data });
const browser = await launch(modules, kGpuArguments), page = await browser.newPage(), said = [];
page.on('pageerror', error => said.push(error.message));
page.on('console', message => {
  if (process.env.VERBOSE) console.log(message.text());
  if (message.type() === 'error' && !/favicon/.test(message.location().url)) said.push(message.text());
});
await page.goto(`${address}app/index.html`);
const call = (name, ...given) => page.evaluate(async ([name, given]) => (await import('/app/page.js'))[name](...given), [name, given]);
const kMirror = '/data/models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb', kCat = '/data/models/SketchfabCat/scene.gltf';

const cases = {
  // The parent mirrors both models, which three alone draws with reversed bitangents where there are tangents.
  async theImageIsThatOfThreeWithCotan() {
    for (const [url, stay] of [[kMirror, false], [kCat, true]]) {
      const found = await call('beside', url);
      console.log(url, JSON.stringify(found));
      assert.ok(found.pixels > 10000, 'the model is drawn');
      assert.equal(found.fromOurs, 0, url);
      assert.ok(found.fromStock > 1000, `${url}: three alone differs by ${found.fromStock} bytes only`);
      assert.ok(found.before > 0 && (stay ? found.after > 0 && found.after < found.before : found.after === 0), url);
      assert.ok(found.decided.length > 0 && found.decided.every(count => count >= found.before), url);
    }
  },

  async itDrawsWithWebGPURendererToo() {
    for (const forceWebGL of [false, true]) {
      if (!forceWebGL && !await page.evaluate(async () => !!await navigator.gpu?.requestAdapter())) {
        console.log('no WebGPU in this Chromium: only its WebGL 2 backend is tested');
        continue;
      }
      const found = await call('besideNodes', kMirror, forceWebGL);
      console.log(JSON.stringify(found));
      assert.equal(found.webgpu, !forceWebGL);
      assert.ok(found.pixels > 10000, 'the model is drawn');
      assert.equal(found.fromOurs, 0);
      assert.ok(found.fromStock > 1000, `three alone differs by ${found.fromStock} bytes only`);
      assert.ok(found.before > 0 && found.after === 0 && found.decided[0] > 0);
    }
  },

  async unmountingFreesWhatTheRendererHolds() {
    const { held: [empty, drawn, after, again], apart } = await call('unmounted', kMirror);
    console.log(JSON.stringify({ empty, drawn, after }));
    assert.ok(drawn.geometries > empty.geometries && drawn.textures > empty.textures);
    assert.deepEqual(after, empty);
    assert.deepEqual(again, drawn);
    assert.equal(apart, 0, 'it is drawn again as before');
    const kept = await call('unmounted', kMirror, null);
    assert.deepEqual(kept.held[2], kept.held[1]);
  },

  async aHookFollowsItsOptionsAndErrorsReachTheBoundary() {
    assert.deepEqual(said, []);
    const { frames, once, calls, errors } = await call('hooks');
    assert.deepEqual([once, calls], [1, 2], 'a rendering without a change calls nothing');
    assert.equal(frames[0], '');
    assert.ok(frames.includes('orthonormal') && frames.indexOf('cotangent') > frames.indexOf('orthonormal') && frames.includes('missing 0'), frames.join(' | '));
    const fields = ['object', 'options.frame', 'options.maxDegrees', 'options.onDecided', 'options.untangle', 'target', 'target', 'target'];
    assert.equal(errors.length, fields.length, errors.join('\n'));
    for (const [k, field] of fields.entries()) assert.ok(errors[k].startsWith(`usage: ${field}: expected `), errors[k]);
  },
};
await runCases(cases, only);
await browser.close();
close();
