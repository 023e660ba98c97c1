// The package, bundled by esbuild, in a page and a worker of headless Chromium; and the entry with a separate wasm:
//   node browser_test.mjs TARBALL NODE_MODULES
import assert from 'node:assert/strict';
import { execFile, execFileSync } from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import path from 'node:path';

import { installed, skip } from './shared.mjs';

const [tarball, modules] = process.argv.slice(2);
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
const esbuild = path.join(modules, '.bin/esbuild');
if (!fs.existsSync(esbuild)) skip('esbuild is not installed');
try {
  execFileSync('chromium', ['--version'], { stdio: 'ignore' });
} catch {
  skip('there is no chromium');
}
const folder = installed(tarball);
const put = (name, text) => fs.writeFileSync(path.join(folder, name), text);
put('work.js', `
import * as small from 'cotan/tangents';
import * as cotan from 'cotan';
const mesh = { positions: [0,0,0, 1,0,0, 0,1,0], normals: [0,0,1, 0,0,1, 0,0,1], uvs: [0,1, 1,1, 0,0] };
export async function work() {
  await Promise.all([small.ready, cotan.ready]);
  const made = [small, cotan].map((module) => [...module.tangents(mesh)].join(' '));
  const picture = { width: 2, height: 1, bits: 16, data: Uint16Array.of(1, 2, 3, 65535, 4, 5, 6, 65535) };
  const png = await cotan.encodePng(picture), again = await cotan.decodePng(png);
  const canvas = new OffscreenCanvas(2, 1), context = canvas.getContext('2d');
  context.fillStyle = 'rgb(10, 20, 30)';
  context.fillRect(0, 0, 2, 1);
  const jpeg = new Uint8Array(await (await canvas.convertToBlob({ type: 'image/jpeg', quality: 1 })).arrayBuffer());
  const decoded = await cotan.decodeImage(jpeg);
  const error = await cotan.lint(new Uint8Array(3)).catch((e) => e.code);
  return { made, again: [...again.data], decoded: [...decoded.data.slice(0, 4)], error };
}
`);
put('worker.js', "import { work } from './work.js'; work().then((found) => postMessage(found), (e) => postMessage(String(e.stack)));");
put('page.js', `
import { work } from './work.js';
const worker = new Worker('worker_bundle.js');
const inWorker = new Promise((take) => { worker.onmessage = (e) => take(e.data); worker.onerror = (e) => take(e.message); });
const beside = async () => {
  const module = await import('/node_modules/cotan/tangents_beside.js');
  await module.ready;
  return module.version();
};
const found = { page: await work().catch((e) => String(e.stack)), worker: await inWorker, beside: await beside().catch((e) => String(e.stack)) };
await fetch('/result', { method: 'POST', body: JSON.stringify(found) });
`);
put('index.html', '<!doctype html><script type="module" src="page_bundle.js"></script>');
execFileSync(esbuild, ['page.js', '--bundle', '--format=esm', '--outfile=page_bundle.js', '--log-level=error', '--minify',
  '--external:/node_modules/*'], { cwd: folder, stdio: 'inherit' });
execFileSync(esbuild, ['worker.js', '--bundle', '--outfile=worker_bundle.js', '--log-level=error'], { cwd: folder, stdio: 'inherit' });

const kTypes = { '.html': 'text/html', '.js': 'text/javascript', '.wasm': 'application/wasm' };
let chromium;
const found = await new Promise((take, fail) => {
  const server = http.createServer((request, answer) => {
    if (request.url === '/result') {
      let body = '';
      request.on('data', (part) => { body += part; }).on('end', () => {
        answer.end();
        server.close();
        take(JSON.parse(body));
      });
      return;
    }
    const file = path.join(folder, request.url === '/' ? 'index.html' : request.url);
    if (!fs.existsSync(file)) return answer.writeHead(404).end();
    answer.writeHead(200, { 'content-type': kTypes[path.extname(file)] ?? 'text/plain' }).end(fs.readFileSync(file));
  }).listen(0, '127.0.0.1', () => {
    chromium = execFile('chromium', ['--headless', '--no-sandbox', '--disable-gpu', `--user-data-dir=${folder}/profile`,
      `http://127.0.0.1:${server.address().port}/`], () => {});
    setTimeout(() => fail(new Error('chromium reported nothing in 90 s')), 90000).unref();
  });
});
chromium.kill();
for (const where of ['page', 'worker']) {
  assert.deepEqual(found[where].made, Array(2).fill('1 0 0 1 1 0 0 1 1 0 0 1'), JSON.stringify(found));
  assert.deepEqual(found[where].again, [1, 2, 3, 65535, 4, 5, 6, 65535]);
  found[where].decoded.forEach((value, i) => assert.ok(Math.abs(value - [10, 20, 30, 255][i]) <= 2, JSON.stringify(found)));
  assert.equal(found[where].error, 'input');
}
assert.match(found.beside, /^\d+\.\d+\.\d+$/);
console.log('holds: bundleWorksInABrowserAndAWorker');
process.exit(0);
