// Runs examples/triangle-web/webgpu.html in Dawn without a browser, by npm's webgpu. If the driver supports it, this
// also tests the index of the primitive (@builtin(primitive_index)), which Chromium lacks on CPU devices.
//   node triangle_dawn.mjs NODE_MODULES FOLDER
// FOLDER: map.bytes, the files that tests/examples_triangle_web.js fetches, and names.json: { modelNames, oddCount }.
// Prints the findings as JSON. Exit code 77 and a line with the reason: skipped.
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { here, skip } from './shared.mjs';

const [modules, folder] = process.argv.slice(2), root = path.resolve(here, '../..');
const package_ = path.resolve(modules, 'webgpu/index.js');
if (!fs.existsSync(package_)) skip("npm's webgpu is not installed");
const { create, globals } = await import(pathToFileURL(package_));
Object.assign(globalThis, globals);
const gpu = create([]);
const adapter = await gpu.requestAdapter().catch(() => null);
if (!adapter) skip('Dawn takes no Vulkan device here: it wants Mesa 24 or newer');
Object.defineProperty(globalThis, 'navigator', { value: { gpu: Object.assign(Object.create(gpu), {
  requestAdapter: () => gpu.requestAdapter(), getPreferredCanvasFormat: () => 'bgra8unorm' }) } });

const html = fs.readFileSync(path.join(root, 'examples/triangle-web/webgpu.html'), 'utf8');
const pasted = id => html.match(new RegExp(`id="${id}">\n([^]*?)</script>`))[1];
const code = html.match(/<script>\n([^]*?)<\/script>/)[1];
const read = name => fs.readFileSync(path.join(root, name), 'utf8');
let configured;
const context = {
  configure: wanted => { configured = wanted; },
  getCurrentTexture: () => configured.device.createTexture({ size: [canvas.width, canvas.height], format: configured.format,
    usage: configured.usage ?? GPUTextureUsage.RENDER_ATTACHMENT }),
};
const canvas = { width: 960, height: 480, getContext: () => context };
const elements = { make: { textContent: pasted('make') }, perturb: { textContent: pasted('perturb') }, model: {}, said: {} };
class Request {
  open(_, name) { this.name = name; }
  send() { const b = fs.readFileSync(path.join(folder, this.name));
    this.response = b.buffer.slice(b.byteOffset, b.byteOffset + b.byteLength); this.onload(); }
}
const { modelNames, oddCount } = JSON.parse(fs.readFileSync(path.join(folder, 'names.json'), 'utf8'));
const found = await new Promise(done => new Function('document', 'location', 'XMLHttpRequest', 'parent', 'measuredPage', 'modelNames',
  'oddCount', read('examples/triangle-web/model.js') + code + read('tests/examples_triangle_web.js'))(
  { getElementById: id => elements[id], querySelector: () => canvas }, { search: '' }, Request,
  { postMessage: message => done(message.found) }, 'webgpu', modelNames, oddCount));
found.device = adapter.info.description;
console.log(JSON.stringify(found));
process.exit(0);
