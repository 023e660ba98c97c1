// node measure.mjs MODULES RESULT: reads what to do from the environment, see bench/models-in-three.
// MODULES: node_modules with three and playwright-core. RESULT: a JSON file, which keeps what it has of other models.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { launch, serve } from '../../tests/web/chromium.mjs';

const here = fileURLToPath(new URL('.', import.meta.url)), root = path.join(here, '../..');
const [modules, result] = process.argv.slice(2);
const { ONLY = '', PACKAGE = path.join(root, 'bindings/js'), IMAGES, COTAN, OPTIONS } = process.env;
const build = path.join(root, 'build'), shared = path.join(root, '../shared/data');
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
  try {
    return await page.evaluate(async ([url, options]) => (await import('/bench/judge.js')).measure(url, options),
      [`/${folder === 'package' ? 'npm' : folder}/${file.split('/').map(encodeURIComponent).join('/')}`, { posed: !!model.posed, image: !!IMAGES, options: OPTIONS ? JSON.parse(OPTIONS) : undefined }]);
  } catch (error) {
    throw Error(`${model.name}: ${[String(error.message ?? error), ...failures].join('\n')}`);
  } finally {
    await page.close();
  }
}

// The field `decisions` of the report of `cotan lint`; undefined if this version has none.
function lintOf(model) {
  const { folder, file } = fileOf(model);
  try {
    return JSON.parse(execFileSync(COTAN, ['lint', '--json', path.join(folders[folder], file)], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'], maxBuffer: 1 << 28 })).decisions;
  } catch (error) { // exit code 1: warnings
    try { return JSON.parse(error.stdout).decisions; } catch { return undefined; }
  }
}

// A model that covers nothing, or whose normals do not vary, has not been measured.
function check({ name }, { pixels, primitives, notFinite }) {
  if (!(pixels > 2000)) throw Error(`${name}: expected more than 2000 pixels with a normal map, found ${pixels}`);
  if (!primitives.some(({ range }) => range > 0.1)) throw Error(`${name}: expected normals that vary, found one colour: the images are blank`);
  if (notFinite) throw Error(`${name}: ${notFinite} pixels are not finite`);
}

const known = fs.existsSync(result) ? JSON.parse(fs.readFileSync(result)).models : [], rows = new Map(known.map((row) => [row.name, row]));
const order = [...models, ...extra].map(({ name }) => name), failed = [];
for (const model of chosen) {
  try {
    const { image, ...found } = await measured(model);
    if (IMAGES) {
      fs.mkdirSync(IMAGES, { recursive: true });
      fs.writeFileSync(path.join(IMAGES, `${model.name}.png`), Buffer.from(image.split('base64,')[1], 'base64'));
    }
    check(model, found);
    const { folder } = fileOf(model);
    rows.set(model.name, { name: model.name, source: folder, ...(model.extra ? { extra: true } : {}), traits: model.traits, ...found,
      ...(COTAN ? { lint: lintOf(model) } : {}) });
    console.log(`${model.name}: mean ${found.mean}, 99 % ${found.p99}, ${[...new Set(found.primitives.map(({ frame }) => frame))]}, ${found.milliseconds} ms`);
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
if (failed.length) process.exit(1);
