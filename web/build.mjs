// Builds the page into a folder: node web/build.mjs FOLDER NODE_MODULES COTAN_PACKAGE
// NODE_MODULES: of the packages that package.json names. COTAN_PACKAGE: the folder of the npm package `cotan`.
import { cpSync, mkdirSync, mkdtempSync, readdirSync, readFileSync, rmSync, statSync, symlinkSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join, relative, resolve } from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const [out, modules, cotan] = process.argv.slice(2).map(path => resolve(path));
if (!cotan) {
  console.error('usage: node build.mjs FOLDER NODE_MODULES COTAN_PACKAGE');
  process.exit(1);
}
const here = dirname(fileURLToPath(import.meta.url)), root = dirname(here);
const load = name => import(pathToFileURL(join(modules, name)));
const { build } = await load('esbuild/lib/main.js'), { marked } = await load('marked/lib/marked.esm.js');

rmSync(out, { recursive: true, force: true });
mkdirSync(out, { recursive: true });
const named = mkdtempSync(join(tmpdir(), 'cotan-page-')); // where the package is found by its name
symlinkSync(cotan, join(named, 'cotan'));
await build({
  entryPoints: ['main.js', 'worker.js'].map(name => join(here, name)), outdir: out, bundle: true, splitting: true, format: 'esm', minify: true, target: 'es2022',
  chunkNames: 'parts/[name]-[hash]', nodePaths: [modules, named], external: ['fs', 'path', 'node:fs', 'node:path'], logLevel: 'warning',
});
rmSync(named, { recursive: true });
for (const name of ['index.html', 'style.css']) cpSync(join(here, name), join(out, name));
cpSync(join(cotan, 'wasm/cotan.wasm'), join(out, 'cotan.wasm')); // beside worker.js, which the package ends up in
cpSync(join(root, 'docs/pictures/figures.png'), join(out, 'figures.png'));
cpSync(join(modules, 'draco3dgltf/draco_decoder_gltf.wasm'), join(out, 'draco/gltf.wasm'));
const libs = join(modules, 'three/examples/jsm/libs');
for (const name of ['draco_decoder.js', 'draco_decoder.wasm', 'draco_wasm_wrapper.js']) cpSync(join(libs, 'draco/gltf', name), join(out, 'draco', name));
for (const name of ['basis_transcoder.js', 'basis_transcoder.wasm']) cpSync(join(libs, 'basis', name), join(out, 'basis', name));

// Links of the document to others lead nowhere here, and stay words.
const theory = marked.parse(readFileSync(join(root, 'docs/theory.md'), 'utf8')).replace(/<a href="(?!#|https?:)[^"]*">(.*?)<\/a>/gs, '$1')
  .replaceAll('<table>', '<div class="scroll"><table>').replaceAll('</table>', '</table></div>');
writeFileSync(join(out, 'theory.html'), `<!doctype html><html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark"><link rel="icon" href="data:,"><title>Cotan: theory</title><link rel="stylesheet" href="style.css"></head>
<body><header><a class="name" href="index.html">Cotan</a></header><main>${theory}</main></body></html>\n`);

// All files are kept by the browser, so that the page works without a network.
const files = (folder) => readdirSync(folder).flatMap(name => statSync(join(folder, name)).isDirectory() ? files(join(folder, name)) : [relative(out, join(folder, name))]);
writeFileSync(join(out, 'offline.js'), readFileSync(join(here, 'offline.js'), 'utf8').replace('[/* files */]', JSON.stringify(['./', ...files(out)])).replace('/* version */', String(Date.now())));
