// Shared by the tests of the page in web/, which run in headless Chromium:
//   node page_..._test.mjs PAGE NODE_MODULES TOOL [FACT]
// PAGE: folder of the built page. NODE_MODULES: has playwright-core, axe-core, fast-png. TOOL: cotan. FACT: the only one to run. Screenshots are written beside PAGE. Exit code 77: what a fact needs is missing.
import { execFileSync } from 'node:child_process';
import { createServer } from 'node:http';
import { existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from 'node:fs';
import { basename, dirname, extname, join } from 'node:path';
import { createRequire } from 'node:module';
import { data, hasZstandard, missing } from './data.mjs';

export { data, hasZstandard };

export const [root, modules, tool, only] = process.argv.slice(2);
if (!existsSync(join(root, 'index.html'))) {
  console.error(`skipped: ${root} was not built`);
  process.exit(77);
}
export const require = createRequire(join(modules, 'x.js'));
const { chromium } = require('playwright-core');
export const { decode, encode } = await import(join(modules, 'fast-png/lib/index.js'));
export const scratch = join(dirname(root), 'page-pictures'), errors = [], hasData = missing === '';
mkdirSync(scratch, { recursive: true });
let tried = 0, failed = 0, skipped = 0;

const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.png': 'image/png', '.svg': 'image/svg+xml' };
const server = createServer((request, response) => {
  const file = join(root, decodeURIComponent(request.url.split('?')[0]).replace(/\/$/, '/index.html'));
  if (!existsSync(file)) { response.writeHead(404).end(); return; }
  response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' }).end(readFileSync(file));
}).listen(0, '127.0.0.1');
await new Promise(done => server.once('listening', done));
export const address = `http://127.0.0.1:${server.address().port}/`;
export const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader',
    '--enable-features=Vulkan', '--use-vulkan=swiftshader', '--disable-quic', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync'],
});

// Writes a GLB of a dome with smaller domes in its normal map. up: green points up in the image. Returns the path.
export async function domed(name, up, colour) {
  const { Document, NodeIO } = await import(join(modules, '@gltf-transform/core/dist/index.js'));
  const document = new Document(), buffer = document.createBuffer(), side = 64, map = { width: side, height: side, depth: 8, channels: 3, data: new Uint8Array(3 * side * side) };
  for (let y = 0; y < side; ++y)
    for (let x = 0; x < side; ++x) {
      const [p, q] = [x, y].map(k => 4 * ((k + 0.5) / side) % 2 - 1), r = Math.hypot(p, q) < 0.8 ? 1 : 0;
      map.data.set([p * r, (up ? -1 : 1) * q * r, Math.sqrt(1 - r * (p * p + q * q))].map(c => Math.round(128 + 127 * c)), 3 * (y * side + x));
    }
  const n = 33, positions = [], uvs = [], indices = [];
  for (let y = 0; y < n; ++y)
    for (let x = 0; x < n; ++x) {
      const u = x / (n - 1), v = y / (n - 1), [a, b] = [(u - 0.5) * 2.2, (0.5 - v) * 2.2], k = y * n + x;
      positions.push(Math.sin(a) * Math.cos(b), Math.sin(b), Math.cos(a) * Math.cos(b));
      uvs.push(u, v);
      if (x < n - 1 && y < n - 1) indices.push(k, k + n, k + 1, k + 1, k + n, k + n + 1);
    }
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const material = document.createMaterial('m').setBaseColorFactor([...colour, 1]).setRoughnessFactor(0.6).setMetallicFactor(0)
    .setNormalTexture(document.createTexture('domes').setImage(encode(map)).setMimeType('image/png'));
  document.createScene().addChild(document.createNode().setMesh(document.createMesh('dome').addPrimitive(document.createPrimitive().setMaterial(material)
    .setIndices(accessor('SCALAR', Uint16Array.from(indices))).setAttribute('POSITION', accessor('VEC3', Float32Array.from(positions)))
    .setAttribute('NORMAL', accessor('VEC3', Float32Array.from(positions))).setAttribute('TEXCOORD_0', accessor('VEC2', Float32Array.from(uvs))))));
  writeFileSync(join(scratch, name), await new NodeIO().writeBinary(document));
  return join(scratch, name);
}

// at: the folder of the page, as an address.
export async function open(options = {}, hash = '', at = address) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true, serviceWorkers: 'block', ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(30000);
  page.on('console', message => { if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver|blocked by Playwright/.test(message.text())) errors.push(message.text()); });
  page.on('pageerror', error => errors.push(error.message));
  page.on('request', request => { if (!/^(blob:|data:)/.test(request.url()) && !request.url().startsWith(at)) errors.push(`asked for ${request.url()}`); });
  await page.goto(at + hash);
  return page;
}

// Drops files onto the page and waits for its answer.
export async function drop(page, files) {
  await dropOnly(page, files);
  await settled(page);
}

export async function dropOnly(page, files, { keep = false } = {}) {
  const given = files.map(file => [basename(file), readFileSync(file).toString('base64')]);
  await page.evaluate(([given, keep]) => {
    if (!keep) document.getElementById('result').replaceChildren();
    const transfer = new DataTransfer();
    for (const [name, text] of given) transfer.items.add(new File([Uint8Array.from(atob(text), c => c.charCodeAt(0))], name));
    document.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
  }, [given, keep]);
}

export const settled = page => page.waitForFunction(() => document.getElementById('status').textContent === ''
  && (document.getElementById('problem').textContent !== '' || document.getElementById('result').childNodes.length > 0), undefined, { timeout: 60000 });
// Waits for the view of a model, which comes after the verdict.
export const viewed = page => page.waitForSelector('.view[data-shows]', { state: 'attached', timeout: 120000 });
export const problem = page => page.textContent('#problem');

export async function saved(page, click) {
  const [download] = await Promise.all([page.waitForEvent('download'), click()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

export function run(...words) {
  return execFileSync(tool, words, { cwd: scratch, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });
}

export const same = (a, b) => a.length === b.length && Buffer.compare(Buffer.from(a.buffer, a.byteOffset, a.byteLength), Buffer.from(b.buffer, b.byteOffset, b.byteLength)) === 0;
// A missing alpha channel equals an opaque one.
export function texelsEqual(a, b) {
  if (a.width !== b.width || a.height !== b.height || a.depth !== b.depth) return false;
  const most = 2 ** a.depth - 1, at = ({ data, channels }, k, c) => c < channels ? data[k * channels + c] : most;
  for (let k = 0; k < a.width * a.height; ++k)
    for (let c = 0; c < 4; ++c) if (at(a, k, c) !== at(b, k, c)) return false;
  return true;
}

export function partsOfGlb(bytes) {
  const length = bytes.readUInt32LE(12);
  return { json: JSON.parse(bytes.subarray(20, 20 + length)), binary: bytes.subarray(28 + length) };
}

// Returns the fraction of pixels in an element's screenshot that differ from the first pixel.
export async function drawn(page, selector) {
  const png = decode(await page.locator(selector).screenshot());
  let count = 0;
  for (let k = 0; k < png.data.length; k += png.channels) if (Math.abs(png.data[k] - png.data[0]) + Math.abs(png.data[k + 1] - png.data[1]) > 24) ++count;
  return count / (png.width * png.height);
}

export async function fact(name, check, { needsData = false } = {}) {
  if (only !== undefined && name !== only) return;
  if (needsData && !hasData) {
    console.error(`skipped: ${data} is not there (${name})`);
    ++skipped;
    return;
  }
  const before = errors.length, began = Date.now();
  let problem;
  try {
    problem = await check();
  } catch (error) {
    problem = error.message;
  }
  await Promise.all(browser.contexts().map(context => context.close())); // a fact that fails leaves its page open
  if (!problem && errors.length > before) problem = `the console says: ${errors.slice(before).join('; ')}`;
  ++tried;
  if (problem) ++failed;
  console.error(`${problem ? 'FAILS' : 'holds'} ${name} (${((Date.now() - began) / 1000).toFixed(1)} s) ${(problem ?? '').slice(0, 3000)}`);
}

export const needsData = { needsData: true };
export const texture = name => join(data, 'textures', name), model = name => join(data, 'models', name, `${name}.glb`);

// Every test file calls this at its end.
export async function end() {
  await browser.close();
  server.close();
  if (tried + skipped === 0) console.error(`there is no fact ${only}`);
  process.exit(failed > 0 || tried + skipped === 0 ? 1 : tried === 0 ? 77 : 0);
}
