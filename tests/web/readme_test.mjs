// Follows the package's README in an empty folder: node readme_test.mjs TARBALL NODE_MODULES [MODEL [IMAGE]]
// MODEL: a GLB with a normal map; default: one of the test data. IMAGE: a .png for a screenshot of the page at the end, such as
// docs/pictures/tutorial-web-page.png for vase-lost-sign.glb.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import { createRequire } from 'node:module';
import path from 'node:path';

import { dataFile } from './data.mjs';
import { installed, parseGlb, skip } from './shared.mjs';

const [tarball, modules, given, image] = process.argv.slice(2), model = given?.endsWith('.glb') ? given : dataFile('models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb');
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
if (!fs.existsSync(path.join(modules, 'playwright-core'))) skip('playwright-core is not installed');
if (!fs.existsSync(model)) skip(`${path.basename(model)} is not there: run scripts/test-data`);
if (!fs.existsSync('/usr/bin/chromium')) skip('there is no chromium');

const folder = installed(tarball, modules, ['three', 'esbuild', '@esbuild']);
const readme = fs.readFileSync(path.join(folder, 'node_modules/cotan/README.md'), 'utf8');
for (const name of ['untangle.js', 'main.js']) {
  const [, text] = new RegExp(`\`${name}\` [^]*?\`\`\`js\\n([^]*?)\`\`\``).exec(readme) ?? assert.fail(`the README has no ${name}`);
  fs.writeFileSync(path.join(folder, name), text);
}
fs.copyFileSync(model, path.join(folder, 'model.glb'));
const [, page] = /echo '(.*)' > index.html/.exec(readme);
fs.writeFileSync(path.join(folder, 'index.html'), page);
const said = execFileSync('node', ['untangle.js'], { cwd: folder, encoding: 'utf8' });
const [, before, after] = /^drop: (\d+) bytes before, (\d+) after$/m.exec(said) ?? assert.fail(said);
assert.equal(Number(before), fs.statSync(model).size);
assert.ok(Number(after) < Number(before));
assert.equal(fs.statSync(path.join(folder, 'free.glb')).size, Number(after));
const { json } = parseGlb(fs.readFileSync(path.join(folder, 'free.glb')));
assert.ok(json.meshes.every((mesh) => mesh.primitives.every((primitive) => !('TANGENT' in primitive.attributes))));
execFileSync(path.join(modules, '.bin/esbuild'), ['main.js', '--bundle', '--format=esm', '--outfile=bundle.js', '--log-level=error'], { cwd: folder });

const server = http.createServer((request, answer) => {
  const file = path.join(folder, request.url === '/' ? 'index.html' : request.url);
  if (!fs.existsSync(file)) return answer.writeHead(404).end();
  answer.writeHead(200, { 'content-type': { '.html': 'text/html', '.js': 'text/javascript' }[path.extname(file)] ?? 'model/gltf-binary' }).end(fs.readFileSync(file));
}).listen(0, '127.0.0.1');
await new Promise((done) => { server.once('listening', done); });
const require = createRequire(path.join(path.resolve(modules), 'x.js'));
const browser = await require('playwright-core').chromium.launch({
  executablePath: '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-quic', '--no-first-run', '--disable-background-networking'],
});
const shown = await browser.newPage({ viewport: { width: 400, height: 300 } }), errors = [];
shown.on('pageerror', (error) => errors.push(error.message));
shown.on('console', (message) => { if (message.type() === 'error' && !/favicon|404/.test(message.text())) errors.push(message.text()); });
await shown.goto(`http://127.0.0.1:${server.address().port}/`);
const { decode } = await import(path.join(path.resolve(modules), 'fast-png/lib/index.js'));
let lit = 0;
for (let tries = 0; tries < 60 && lit < 0.03; ++tries) {
  await shown.waitForTimeout(500);
  const { data, channels, width, height } = decode(await shown.locator('canvas').screenshot());
  lit = 0;
  for (let k = 0; k < data.length; k += channels) if (data[k] > 60) lit += 1 / (width * height);
}
if (image?.endsWith('.png')) await shown.screenshot({ path: image });
await browser.close();
server.close();
assert.deepEqual(errors, []);
assert.ok(lit >= 0.03, `${100 * lit} % of the picture shows something`);
console.log('holds: theReadmeShowsAModelWithoutTangents');
process.exit(0);
