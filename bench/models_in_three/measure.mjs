// node measure.mjs MODULES RESULT: reads what to do from the environment, see bench/models-in-three.
// MODULES: node_modules with three and playwright-core. RESULT: a JSON file, which keeps what it has of other models.
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { launch, serve } from '../../tests/web/chromium.mjs';
import { parseGlb } from '../../tests/web/shared.mjs';

const here = fileURLToPath(new URL('.', import.meta.url)), root = path.join(here, '../..');
const [modules, result] = process.argv.slice(2);
const { ONLY = '', PACKAGE = path.join(root, 'bindings/js'), IMAGES, COTAN, OPTIONS, SIZE = '512', SHARP, TIMES } = process.env;
const scratch = fs.mkdtempSync(path.join(os.tmpdir(), 'cotan-models-')), build = path.join(root, 'build'), shared = path.join(root, '../shared/data');
const { models, extra } = JSON.parse(fs.readFileSync(path.join(here, 'models.json')));
const folders = { made: path.join(build, 'models-made'), package: path.join(build, 'models-npm/node_modules'), data: path.join(build, 'data'), shared };

// The folder and the path in it of a model's file.
function fileOf(model) {
  const folder = ['made', 'package', 'data', 'shared'].find((name) => model[name]);
  return { folder, file: folder === 'made' ? `${model.name}.glb` : model[folder] };
}

const chosen = [...models, ...extra.map((model) => ({ ...model, extra: true }))].filter(({ name }) => new RegExp(ONLY).test(name))
  .filter((model) => !model.extra || fs.existsSync(path.join(shared, model.shared)));
for (const model of chosen) {
  const { folder, file } = fileOf(model);
  if (!fs.existsSync(path.join(folders[folder], file))) throw Error(`${model.name}: ${path.join(folders[folder], file)} is missing`);
}

const { address, close } = await serve({ ...folders, npm: folders.package, package: path.resolve(PACKAGE), modules: path.resolve(modules), tests: path.join(root, 'tests/web'), bench: here });
const browser = await launch(modules);

// A new page for each model, so that none inherits memory or programs of another one.
async function measured(model) {
  const page = await browser.newPage(), failures = [], { folder, file } = fileOf(model);
  page.on('pageerror', (error) => failures.push(String(error)));
  page.on('console', (message) => { if (message.type() === 'error' || process.env.VERBOSE) failures.push(message.text()); });
  await page.route(address, (route) => route.fulfill({ contentType: 'text/html', body: `<!doctype html><script type="importmap">${JSON.stringify({ imports: {
    three: '/modules/three/build/three.module.js', 'three/addons/': '/modules/three/examples/jsm/' } })}</script>` }));
  await page.goto(address);
  const devtools = await page.context().newCDPSession(page);
  await devtools.send('Performance.enable', { timeDomain: 'threadTicks' });
  await page.exposeFunction('threadTime', async () => (await devtools.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'ThreadTime').value);
  try {
    return await page.evaluate(async ([work, url, options]) => (await import('/bench/judge.js'))[work](url, options),
      [TIMES ? 'time' : 'measure', `/${folder === 'package' ? 'npm' : folder}/${file.split('/').map(encodeURIComponent).join('/')}`, { size: Number(SIZE), sharp: !!SHARP, posed: !!model.posed, image: !!IMAGES, options: OPTIONS ? JSON.parse(OPTIONS) : undefined }]);
  } catch (error) {
    throw Error(`${model.name}: ${[String(error.message ?? error), ...failures].join('\n')}`);
  } finally {
    await page.close();
  }
}

// "mesh, primitive" of each primitive of a file, in the order of `cotan lint`: as nodes of the scene come to them.
function primitivesOf(file) {
  const bytes = fs.readFileSync(file), { meshes, nodes, scenes, scene = 0 } = file.endsWith('.glb') ? parseGlb(bytes).json : JSON.parse(bytes), found = new Set();
  const visit = (k) => {
    const { mesh, children = [] } = nodes[k];
    if (mesh !== undefined) found.add(mesh);
    children.forEach(visit);
  };
  scenes[scene].nodes.forEach(visit);
  return [...found].flatMap((mesh) => meshes[mesh].primitives.map((_, primitive) => `${mesh}, ${primitive}`));
}

// What `cotan lint` decides for each primitive. Exit code 1 means warnings.
function lintOf(model) {
  const { folder, file } = fileOf(model), report = path.join(scratch, 'report.json');
  const { status, stderr } = spawnSync(COTAN, ['lint', path.join(folders[folder], file), '--json', report, '--overwrite'], { encoding: 'utf8' });
  if (status > 1 || !fs.existsSync(report)) throw Error(`${model.name}: ${stderr}`);
  const { decisions = [] } = JSON.parse(fs.readFileSync(report, 'utf8')), keys = primitivesOf(path.join(folders[folder], file));
  if (decisions.length !== keys.length) throw Error(`${model.name}: lint decided about ${decisions.length} primitives of ${keys.length}`);
  return decisions.map(({ frame, tangents_stay: stay, candidates, reason }, k) => ({ primitive: keys[k], frame: stay ? 'tangents' : frame, reason,
    predicted: stay ? 0 : candidates.find((one) => one.frame === frame)?.mean }));
}

// A model that covers nothing, or whose normals do not vary, has not been measured.
function check({ name }, { pixels, primitives, notFinite }) {
  if (!(pixels > 2000)) throw Error(`${name}: expected more than 2000 pixels with a normal map, found ${pixels}`);
  if (!primitives.some(({ range }) => range > 0.1)) throw Error(`${name}: expected normals that vary, found one colour: the images are blank`);
  if (notFinite) throw Error(`${name}: ${notFinite} pixels are not finite`);
}

const known = fs.existsSync(result) ? JSON.parse(fs.readFileSync(result)).models : [], rows = new Map(known.map((row) => [row.name, row]));
const order = [...models, ...extra].map(({ name }) => name), failed = [];

async function rowOf(model) {
  if (TIMES) return { ...rows.get(model.name), milliseconds: await measured(model) };
  const { image, ...found } = await measured(model);
  if (IMAGES) {
    fs.mkdirSync(IMAGES, { recursive: true });
    fs.writeFileSync(path.join(IMAGES, `${model.name}.png`), Buffer.from(image.split('base64,')[1], 'base64'));
  }
  check(model, found);
  const { folder } = fileOf(model);
  return { name: model.name, source: folder, ...(model.extra ? { extra: true } : {}), traits: model.traits, ...found, ...(COTAN ? { lint: lintOf(model) } : {}) };
}

for (const model of chosen) {
  if (TIMES && !rows.has(model.name)) continue;
  try {
    const row = await rowOf(model);
    rows.set(model.name, row);
    console.log(`${model.name}: mean ${row.mean}, 99 % ${row.p99}, ${[...new Set(row.primitives.map(({ frame }) => frame))]}, ${row.milliseconds} ms`);
  } catch (error) {
    failed.push(error.message);
    console.error(error.message);
  }
  const sorted = [...rows.values()].filter(({ name }) => order.includes(name)).sort((a, b) => order.indexOf(a.name) - order.indexOf(b.name));
  const text = sorted.map((row) => JSON.stringify(row)).join(',\n');
  fs.writeFileSync(result, `{"three": "${JSON.parse(fs.readFileSync(path.join(modules, 'three/package.json'))).version}", "models": [\n${text}\n]}\n`);
}
await browser.close();
close();
fs.rmSync(scratch, { recursive: true });
if (failed.length) process.exit(1);
