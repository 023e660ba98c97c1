// Assembles and packs the npm package: node build.mjs WASM_FOLDER OUT_FOLDER VERSION [REPOSITORY] [--tool=FOLDER]. Writes
// package/, the contents of the tarball, and the tarball cotan-VERSION.tgz to OUT_FOLDER. --tool: cli.js, cli.wasm and
// licences.txt, which scripts/npm-package makes for the command; without them the package has no command.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { deflateSync } from 'node:zlib';

import { oneFile } from './one_file.mjs';

const tool = process.argv.find((word) => word.startsWith('--tool='))?.slice('--tool='.length);
const [wasmFolder, out, version, repository] = process.argv.slice(2).filter((word) => !word.startsWith('--tool='));
if (!version) {
  console.error('usage: node build.mjs WASM_FOLDER OUT_FOLDER VERSION');
  process.exit(1);
}
const here = path.dirname(fileURLToPath(import.meta.url));
const packageFolder = path.join(out, 'package');
fs.rmSync(packageFolder, { recursive: true, force: true });
fs.mkdirSync(path.join(packageFolder, 'wasm'), { recursive: true });

// Strips comment lines and indentation, since the typings document the package for its users. Valid only because no
// source file has a multi-line string.
const slim = (text) => text.split('\n').map((line) => line.trim()).filter((line) => !/^(\/\/.*|\/\*\*.*\*\/|\/\*\*.*|\* .*|)$/.test(line)).join('\n') + '\n';
const put = (name, text) => {
  const file = path.join(packageFolder, name);
  fs.mkdirSync(path.dirname(file), { recursive: true });
  fs.writeFileSync(file, text);
};
for (const file of fs.readdirSync(path.join(here, 'src')).filter((name) => name.endsWith('.js')))
  put(`src/${file}`, slim(fs.readFileSync(path.join(here, 'src', file), 'utf8')));

for (const [name, built] of [['cotan', 'cotan_js_whole.wasm'], ['tangents', 'cotan_js_tangents.wasm'], ['textures', 'cotan_js_textures.wasm']]) {
  const bytes = fs.readFileSync(path.join(wasmFolder, built));
  fs.writeFileSync(path.join(packageFolder, `wasm/${name}.wasm`), bytes);
  const text = deflateSync(bytes, { level: 9, memLevel: 7 }).toString('base64'); // memLevel: shorter blocks suit code
  put(`wasm/${name}_inside.js`, `import { through } from '../src/streams.js';
const text = '${text}';
export const bytes = () => through(new DecompressionStream('deflate'), Uint8Array.from(atob(text), (c) => c.charCodeAt(0)));
`);
  put(`wasm/${name}_beside.js`, `import { bytesAt } from '../src/bytes_beside.js';
export const bytes = () => bytesAt(new URL('./${name}.wasm', import.meta.url));
`);
}

const entries = {
  tangents: (way) => `import { CotanError, Library } from './src/instance.js';
import { tangentFunctions } from './src/tangents.js';
import { bytes } from './wasm/tangents_${way}.js';
const library = new Library();
export const ready = library.load(bytes());
ready.catch(() => {});
export const { tangents, smooth, triangles, split, splitMirrored, packTriangles, packSmooth, packTangents } = tangentFunctions(library);
export const version = () => library.version;
export { CotanError };
`,
  textures: (way) => `import { CotanError, Library } from './src/instance.js';
import { textureFunction } from './src/textures.js';
import { bytes } from './wasm/textures_${way}.js';
const library = new Library();
export const ready = library.load(bytes());
ready.catch(() => {});
export const texture = textureFunction(library);
export const version = () => library.version;
export { CotanError };
`,
  cotan: (way) => `import { frameFunctions } from './src/frames.js';
import { hostImports } from './src/host.js';
import { CotanError, Library } from './src/instance.js';
import { mapFunctions } from './src/maps.js';
import { modelFunctions } from './src/models.js';
import { oldNames } from './src/old_names.js';
import { provokingFunction } from './src/provoking.js';
import { tangentFunctions } from './src/tangents.js';
import { bytes } from './wasm/cotan_${way}.js';
const library = new Library(), host = hostImports();
export const ready = library.load(bytes(), { cotan: host.imports });
ready.catch(() => {});
export const { tangents, smooth, triangles, split, splitMirrored, packTriangles, packSmooth, packTangents } = tangentFunctions(library);
export const provoking = provokingFunction(library);
export const { detect, info, convertMap, blend, fromHeight, toHeight, mips } = mapFunctions(library, host);
export const { apply, encode, frames, shader } = frameFunctions(library);
export const { lint, convert, decodeImage } = modelFunctions(library, host, (map) => convertMap(map, { from: 'directx', to: 'opengl' }));
export const version = () => library.version;
export { overLimits } from './src/verdict.js';
export { decodePng, encodePng } from './src/png.js';
export const { decodePicture } = oldNames(decodeImage);
export { CotanError };
`,
};
for (const [name, text] of Object.entries(entries)) {
  put(`${name}.js`, text('inside'));
  put(`${name}_beside.js`, text('beside'));
  fs.copyFileSync(path.join(here, `types/${name}.d.ts`), path.join(packageFolder, `${name}.d.ts`));
}
fs.copyFileSync(path.join(here, 'types/old_names.d.ts'), path.join(packageFolder, 'old_names.d.ts'));
for (const folder of ['three', 'gltf-transform'])
  if (fs.existsSync(path.join(here, folder))) fs.cpSync(path.join(here, folder), path.join(packageFolder, folder), { recursive: true });

// Single files for pages without a bundler.
const singles = { three: ['index', 'relief'], 'three-tsl': ['tsl_nodes', 'relief_nodes'] }, types = { three: ['index', 'relief'], 'three-tsl': ['tsl', 'relief'] };
for (const [name, modules] of Object.entries(singles)) {
  put(`dist/${name}.js`, `// Cotan ${version}, MIT licence. Imports three.\n${oneFile(modules.map((module) => path.join(here, 'three', `${module}.js`)), slim)}`);
  put(`dist/${name}.d.ts`, types[name].map((module) => `export * from '../three/${module}.js';\n`).join(''));
}

const manifest = JSON.parse(fs.readFileSync(path.join(here, 'package.json'), 'utf8'));
manifest.version = version;
if (repository) manifest.repository = repository;
if (tool) {
  put('cli.mjs', fs.readFileSync(path.join(here, 'cli.mjs'), 'utf8'));
  fs.chmodSync(path.join(packageFolder, 'cli.mjs'), 0o755);
  for (const [from, to] of [['cli.js', 'wasm/cli.cjs'], ['cli.wasm', 'wasm/cli.wasm'], ['licences.txt', 'wasm/cli.licences.txt']]) fs.copyFileSync(path.join(tool, from), path.join(packageFolder, to));
} else {
  delete manifest.bin;
}
delete manifest.private;
for (const [name, target] of Object.entries(manifest.exports))
  if (!fs.existsSync(path.join(packageFolder, typeof target === 'string' ? target : target.default))) delete manifest.exports[name];
put('package.json', JSON.stringify(manifest, null, 2) + '\n');
fs.copyFileSync(path.join(here, 'README.md'), path.join(packageFolder, 'README.md'));
fs.copyFileSync(path.join(here, '../../LICENSE'), path.join(packageFolder, 'LICENSE'));
execFileSync('npm', ['pack', '--silent', '--offline', '--pack-destination', path.resolve(out)], { cwd: packageFolder, stdio: ['ignore', 'ignore', 'inherit'] });
