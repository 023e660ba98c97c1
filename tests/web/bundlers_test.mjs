// The package in bundlers, without special settings and without sharp:
//   node bundlers_test.mjs TARBALL NODE_MODULES [CASE]
// The bundles are opened in Chromium or run by node. Exit code 77: skipped.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { launch, serve } from './chromium.mjs';
import { emptyFolder, installed, runCases, skip } from './shared.mjs';

const [tarball, modules, only] = process.argv.slice(2);
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
for (const name of ['vite', 'vite6', 'webpack', 'esbuild', 'playwright-core'])
  if (!fs.existsSync(path.join(modules, name))) skip(`${name} is not installed (see the test npm_packages)`);
if (!fs.existsSync(process.env.CHROMIUM ?? '/usr/bin/chromium')) skip('no chromium');
const require = createRequire(path.join(path.resolve(modules), 'x.js'));
const load = async (name) => {
  const found = await import(pathToFileURL(path.join(modules, name)));
  return found.default ?? found;
};
const vites = { 'vite 8': 'vite/dist/node/index.js', 'vite 6': 'vite6/dist/node/index.js' };

/** A program whose function `found` returns tangents and the version as text. */
const program = (entry, more = '') => `
import { ready, tangents, version } from '${entry}';
${more}
export async function found() {
  await ready;
  return [...tangents({ positions: [0,0,0, 1,0,0, 0,1,0], normals: [0,0,1, 0,0,1, 0,0,1], uvs: [0,1, 1,1, 0,0] })].join(' ') + ' ' + version();
}`;
const kExpected = /^1 0 0 1 1 0 0 1 1 0 0 1 \d+\.\d+\.\d+$/;
const kDecode = `import { decodeImage } from 'cotan';
export const jpeg = () => decodeImage(Uint8Array.of(0xff, 0xd8, 0xff), 'a.jpg').catch((error) => error.message);`;

/** Creates a folder with the package installed as users install it, a program and a page. */
function project(entry) {
  const folder = installed(tarball);
  const put = (name, text) => fs.writeFileSync(path.join(folder, name), text);
  put('work.js', program(entry, entry === 'cotan' ? kDecode : ''));
  put('main.js', "import { found } from './work.js';\nfound().then((text) => { document.title = text; }, (error) => { document.title = `failed: ${error.message}`; });\n");
  put('index.html', '<!doctype html><title>waiting</title><script type="module" src="/main.js"></script>');
  return folder;
}

let browser;
async function titleAt(address) {
  browser ??= await launch(modules);
  const page = await browser.newPage(), errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  await page.goto(address);
  await page.waitForFunction(() => document.title !== 'waiting', undefined, { timeout: 60000 }).catch(() => {});
  const title = await page.title();
  await page.close();
  return [title, ...errors].join('; ');
}
async function titleOf(folder) {
  const { address, close } = await serve({ app: folder });
  const html = path.join(folder, 'index.html');
  fs.writeFileSync(html, fs.readFileSync(html, 'utf8').replaceAll('src="/', 'src="').replaceAll('href="/', 'href="'));
  const title = await titleAt(`${address}app/index.html`);
  close();
  return title;
}

const kEntries = ['cotan', 'cotan/beside', 'cotan/tangents', 'cotan/tangents/beside'];
const cases = {
  async viteServesThePackage() {
    for (const [name, file] of Object.entries(vites))
      for (const entry of kEntries) {
        const root = project(entry), server = await (await load(file)).createServer({ root, configFile: false, logLevel: 'error', server: { port: 0, host: '127.0.0.1' }, cacheDir: path.join(root, '.vite') });
        await server.listen();
        const said = await titleAt(`http://127.0.0.1:${server.httpServer.address().port}/`);
        await server.close();
        assert.match(said, kExpected, `${name}, dev, ${entry}: ${said}`);
      }
  },

  async viteBundlesForTheBrowser() {
    for (const [name, file] of Object.entries(vites))
      for (const entry of kEntries) {
        const root = project(entry), said = [];
        const logger = { hasWarned: false, info() {}, warn: (line) => said.push(line), warnOnce: (line) => said.push(line), error: (line) => said.push(line), clearScreen() {}, hasErrorLogged: () => false };
        await (await load(file)).build({ root, base: './', configFile: false, customLogger: logger, build: { chunkSizeWarningLimit: 1e6 } });
        assert.deepEqual(said, [], `${name}, build, ${entry}`);
        assert.match(await titleOf(path.join(root, 'dist')), kExpected, `${name}, build, ${entry}`);
      }
  },

  async viteBundlesForNode() {
    for (const [name, file] of Object.entries(vites)) {
      const root = project('cotan');
      await (await load(file)).build({ root, configFile: false, logLevel: 'error', ssr: { noExternal: true }, build: { ssr: 'work.js', outDir: 'out' } });
      await runs(path.join(root, 'out/work.js'), name);
    }
  },

  async webpackBundlesForTheBrowser() {
    for (const mode of ['development', 'production'])
      for (const entry of kEntries) {
        const root = project(entry), stats = await packed({ mode, context: root, entry: './main.js', output: { path: path.join(root, 'out'), publicPath: 'auto' }, performance: { hints: false } });
        assert.deepEqual(stats, [], `webpack, ${mode}, ${entry}`);
        fs.writeFileSync(path.join(root, 'out/index.html'), '<!doctype html><title>waiting</title><script src="main.js"></script>');
        assert.match(await titleOf(path.join(root, 'out')), kExpected, `webpack, ${mode}, ${entry}`);
      }
  },

  async webpackBundlesForNode() {
    const root = project('cotan');
    assert.deepEqual(await packed({ mode: 'production', target: 'node20', context: root, entry: './work.js', experiments: { outputModule: true },
      output: { path: path.join(root, 'out'), module: true, library: { type: 'module' }, filename: 'work.mjs' }, performance: { hints: false } }), []);
    await runs(path.join(root, 'out/work.mjs'), 'webpack');
  },

  async esbuildBundlesForTheBrowser() {
    const { build } = await load('esbuild/lib/main.js');
    for (const entry of kEntries) {
      const root = project(entry), { warnings } = await build({ absWorkingDir: root, entryPoints: ['main.js'], bundle: true, format: 'esm', outdir: path.join(root, 'out'), logLevel: 'silent' });
      assert.deepEqual(warnings, []);
      fs.writeFileSync(path.join(root, 'out/index.html'), '<!doctype html><title>waiting</title><script type="module" src="main.js"></script>');
      // esbuild copies no files: the error says so, and the file is copied by hand.
      if (entry.endsWith('beside')) assert.match(await titleOf(path.join(root, 'out')), /^failed: .*\.wasm: expected the package's wasm file, found 404/, entry);
      const file = entry.includes('tangents') ? 'tangents.wasm' : 'cotan.wasm';
      fs.copyFileSync(path.join(root, 'node_modules/cotan/wasm', file), path.join(root, 'out', file));
      assert.match(await titleOf(path.join(root, 'out')), kExpected, `esbuild, ${entry}`);
    }
  },

  async esbuildBundlesForNode() {
    const { build } = await load('esbuild/lib/main.js');
    for (const format of ['esm', 'cjs']) {
      const root = project('cotan'), outfile = path.join(root, format === 'esm' ? 'out.mjs' : 'out.cjs');
      await build({ absWorkingDir: root, entryPoints: ['work.js'], bundle: true, platform: 'node', format, outfile, logLevel: 'silent' });
      await runs(outfile, `esbuild, ${format}`);
    }
  },

  // Vite 6 builds for browsers without top-level await, which its bundles therefore must not have.
  async bundlersLoadTheNodesOfThreeDirectly() {
    if (!fs.existsSync(path.join(modules, 'three'))) skip('three is not installed (see the test npm_packages)');
    const text = "import { untangle, CotanError } from 'cotan/three/tsl';\nlet said;\ntry { untangle(); } catch (error) { said = `${error instanceof CotanError} ${error.message}`; }\ndocument.title = said;\n";
    const made = (bundle) => {
      const root = installed(tarball, path.resolve(modules), ['three']);
      fs.writeFileSync(path.join(root, 'main.js'), text);
      fs.writeFileSync(path.join(root, 'index.html'), '<!doctype html><title>waiting</title><script type="module" src="/main.js"></script>');
      return bundle(root);
    };
    const kSaid = /^true target: expected an Object3D/, page = '<!doctype html><title>waiting</title><script type="module" src="main.js"></script>';
    for (const [name, file] of Object.entries(vites))
      await made(async (root) => {
        await (await load(file)).build({ root, base: './', configFile: false, logLevel: 'error', build: { chunkSizeWarningLimit: 1e6 } });
        assert.match(await titleOf(path.join(root, 'dist')), kSaid, name);
      });
    await made(async (root) => {
      const { build } = await load('esbuild/lib/main.js');
      await build({ absWorkingDir: root, entryPoints: ['main.js'], bundle: true, format: 'esm', outdir: path.join(root, 'out'), logLevel: 'silent' });
      fs.writeFileSync(path.join(root, 'out/index.html'), page);
      assert.match(await titleOf(path.join(root, 'out')), kSaid, 'esbuild');
    });
    await made(async (root) => {
      assert.deepEqual(await packed({ mode: 'development', context: root, entry: './main.js', output: { path: path.join(root, 'out'), publicPath: 'auto' }, performance: { hints: false } }), []);
      fs.writeFileSync(path.join(root, 'out/index.html'), page.replace('type="module" ', ''));
      assert.match(await titleOf(path.join(root, 'out')), kSaid, 'webpack');
    });
  },

  // Without a bundler: the file that unpkg and jsdelivr serve.
  async browsersLoadTheFileOfUnpkg() {
    const root = project('cotan'), folder = path.join(root, 'node_modules/cotan'), { unpkg, jsdelivr } = JSON.parse(fs.readFileSync(path.join(folder, 'package.json'), 'utf8'));
    assert.equal(unpkg, jsdelivr);
    fs.writeFileSync(path.join(root, 'index.html'), `<!doctype html><title>waiting</title><script type="module">${program(`./${path.join('node_modules/cotan', unpkg)}`)}
found().then((text) => { document.title = text; }, (error) => { document.title = 'failed: ' + error.message; });</script>`);
    assert.match(await titleOf(root), kExpected);
  },
};

async function packed(config) {
  const webpack = require('webpack'), stats = await new Promise((done, failed) => webpack(config, (error, found) => (error ? failed(error) : done(found))));
  const { errors, warnings } = stats.toJson({ all: false, errors: true, warnings: true });
  return [...errors, ...warnings].map(({ message }) => message);
}

/** Runs a bundle where neither the package nor sharp is installed, and where sharp is. */
async function runs(file, name) {
  for (const sharp of [false, true]) {
    const folder = emptyFolder(), target = path.join(folder, path.basename(file));
    fs.cpSync(path.dirname(file), folder, { recursive: true, filter: (from) => !from.includes('node_modules') });
    if (sharp) {
      fs.mkdirSync(path.join(folder, 'node_modules'));
      fs.symlinkSync(path.join(path.resolve(modules), 'sharp'), path.join(folder, 'node_modules/sharp'));
    }
    const said = execFileSync(process.execPath, ['-e', `import(${JSON.stringify(target)}).then(async (m) => console.log(await (m.found ?? m.default.found)() + '|' + await (m.jpeg ?? m.default.jpeg)()))`],
      { cwd: folder, encoding: 'utf8' }).trim().split('|');
    assert.match(said[0], kExpected, `${name}, node`);
    if (sharp) assert.doesNotMatch(said[1], /need the package sharp/, `${name}, node, with sharp`);
    else assert.equal(said[1], 'a.jpg: images other than PNG need the package sharp, or options.decode', `${name}, node`);
  }
}

await runCases(cases, only);
await browser?.close();
process.exit();
