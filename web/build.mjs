// Builds the page into a folder: node web/build.mjs FOLDER NODE_MODULES COTAN_PACKAGE
// NODE_MODULES: has the packages that package.json names. COTAN_PACKAGE: the folder of the npm package `cotan`.
import { createHash } from 'node:crypto';
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
const named = mkdtempSync(join(tmpdir(), 'cotan-page-')); // lets esbuild find the package by its name
symlinkSync(cotan, join(named, 'cotan'));
const common = { bundle: true, minify: true, target: 'es2022', nodePaths: [modules, named], external: ['fs', 'path', 'node:fs', 'node:path'], logLevel: 'warning' };
await build({ ...common, entryPoints: ['main.js', 'worker.js'].map(name => join(here, name)), outdir: out, splitting: true, format: 'esm', chunkNames: 'parts/[name]-[hash]' });
for (const name of ['index.html', 'start.js', 'style.css']) cpSync(join(here, name), join(out, name));
cpSync(join(cotan, 'wasm/cotan.wasm'), join(out, 'cotan.wasm')); // beside worker.js, into which the package is bundled
cpSync(join(modules, 'draco3dgltf/draco_decoder_gltf.wasm'), join(out, 'draco/gltf.wasm'));
const libs = join(modules, 'three/examples/jsm/libs');
for (const name of ['draco_decoder.js', 'draco_decoder.wasm', 'draco_wasm_wrapper.js']) cpSync(join(libs, 'draco/gltf', name), join(out, 'draco', name));
cpSync(join(libs, 'basis/basis_transcoder.wasm'), join(out, 'basis/basis_transcoder.wasm'));
writeFileSync(join(out, 'basis/basis_transcoder.js'), withoutEval(readFileSync(join(libs, 'basis/basis_transcoder.js'), 'utf8')));

// The page in one script, for a browser that opens it from disk: worker, WebAssembly and decoders are inside of it.
const bytesOf = (...names) => Object.fromEntries(names.map(name => [name, readFileSync(join(out, name))]));
const worker = await bundled('worker.js', bytesOf('draco/gltf.wasm'), { alias: { 'cotan/beside': join(cotan, 'cotan.js') } });
const decoders = ['draco/draco_decoder.js', 'draco/draco_decoder.wasm', 'draco/draco_wasm_wrapper.js', 'basis/basis_transcoder.js', 'basis/basis_transcoder.wasm'];
writeFileSync(join(out, 'disk.js'), await bundled('main.js', { 'worker.js': worker, ...bytesOf(...decoders) }));
rmSync(named, { recursive: true });

// Returns one classic script as bytes. files: bytes by name, which page_files_inside.js gives to it.
async function bundled(entry, files, more = {}) {
  const inside = { name: 'files-inside', setup({ onResolve, onLoad }) {
    onResolve({ filter: /^\.\/page_files\.js$/ }, () => ({ path: join(here, 'page_files_inside.js') }));
    onResolve({ filter: /^files-inside(:.*)?$/ }, ({ path }) => ({ path, namespace: 'inside' }));
    onLoad({ filter: /:/, namespace: 'inside' }, ({ path }) => ({ contents: files[path.slice(path.indexOf(':') + 1)], loader: 'binary' }));
    onLoad({ filter: /^files-inside$/, namespace: 'inside' }, () => ({ contents: `
${Object.keys(files).map((name, k) => `import file${k} from 'files-inside:${name}';`).join('\n')}
export const files = { ${Object.keys(files).map((name, k) => `'${name}': file${k}`).join(', ')} };`, loader: 'js' }));
  } };
  const { outputFiles: [{ contents }] } = await build({ ...common, ...more, entryPoints: [join(here, entry)], define: { 'import.meta.url': 'location.href' }, format: 'iife', write: false, plugins: [inside] });
  return contents;
}

// Documents of the repository that become pages, with their images. Links between them are kept; links to other files
// become plain text.
const documents = { theory: ['explanation', 'Theory'], figures: ['explanation', 'The figures'], cost: ['explanation', 'Cost'], mobile: ['how-to', 'Phones'] };
mkdirSync(join(out, 'pictures'));
const [policy] = /<meta http-equiv="Content-Security-Policy"[^>]*>/.exec(readFileSync(join(here, 'index.html'), 'utf8'));
for (const [name, [folder, title]] of Object.entries(documents)) {
  const headings = new Map(), text = marked.parse(readFileSync(join(root, 'docs', folder, `${name}.md`), 'utf8'))
    .replace(/<h(\d)>(.*?)<\/h\1>/gs, (_, level, words) => `<h${level} id="${anchor(words, headings)}">${words}</h${level}>`)
    .replace(new RegExp(`href="(${Object.keys(documents).join('|')})\\.md(#[^"]*)?"`, 'g'), 'href="$1.html$2"')
    .replace(/<a href="(?!#|https?:|[a-z]+\.html)[^"]*">(.*?)<\/a>/gs, '$1')
    .replace(/src="((?:\.\.\/pictures\/)?([^"/]+))"/g, (_, path, file) => {
      cpSync(join(root, 'docs/explanation', path), join(out, 'pictures', file));
      return `src="pictures/${file}"`;
    })
    .replaceAll('<pre>', '<pre tabindex="0">').replaceAll('<table>', '<div class="scroll" tabindex="0"><table>').replaceAll('</table>', '</table></div>');
  writeFileSync(join(out, `${name}.html`), `<!doctype html><html lang="en"><head><meta charset="utf-8">${policy}<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark"><link rel="icon" href="data:,"><title>Cotan: ${title.toLowerCase()}</title><link rel="stylesheet" href="style.css"></head>
<body><header><a class="name" href="index.html">Cotan</a><nav>${Object.entries(documents).map(([page, [, words]]) => `<a href="${page}.html"${page === name ? ' aria-current="page"' : ''}>${words}</a>`).join('')}</nav></header><main class="document">${text}</main></body></html>\n`);
}

// Replaces the code of the transcoder that compiles functions from strings, which the page's Content-Security-Policy
// forbids, by what emscripten generates with DYNAMIC_EXECUTION=0.
function withoutEval(text) {
  const replaced = [[/let\[args,invokerFnBody\]=createJsInvoker\(.*?var invokerFn=newFunc\(Function,args\)\(\.\.\.closureArgs\);/s, `
var count=argCount-2;
var invokerFn=function(...given){
  var destructors=[],self=isClassMethodFunc?argTypes[1].toWireType(destructors,this):null,wired=[];
  for(var i=0;i<count;++i)wired.push(argTypes[i+2].toWireType(destructors,given[i]));
  var rv=isClassMethodFunc?cppInvokerFunc(cppTargetFunc,self,...wired):cppInvokerFunc(cppTargetFunc,...wired);
  if(needsDestructorStack)runDestructors(destructors);
  else for(var i=isClassMethodFunc?1:2;i<argTypes.length;++i)if(argTypes[i].destructorFunction!==null)argTypes[i].destructorFunction(i===1?self:wired[i-2]);
  if(returns)return argTypes[0].fromWireType(rv);
};`], [/var invokerFunction=newFunc\(Function,params\)\(\.\.\.args\);/, `
var invokerFunction=(obj,func,destructorsRef,given)=>{
  var at=0,list=types.map(type=>{var value=type.readValueFromPointer(given+at);at+=type.argPackAdvance;return value});
  var rv=kind===1?new func(...list):kind===0?func.call(obj,...list):func.call(...list);
  if(!retType.isVoid)return emval_returnValue(retType,destructorsRef,rv);
};`]];
  return replaced.reduce((some, [pattern, by]) => {
    if (!pattern.test(some)) throw new Error(`basis_transcoder.js: expected ${pattern}, as in three 0.187, found none`);
    return some.replace(pattern, () => by);
  }, text);
}

// The anchor of a heading, as GitHub makes it.
function anchor(words, known) {
  const name = words.replace(/<[^>]*>|&[a-z#0-9]+;/g, '').toLowerCase().replace(/[^\p{L}\p{N} _-]/gu, '').replaceAll(' ', '-'), before = known.get(name) ?? 0;
  known.set(name, before + 1);
  return before === 0 ? name : `${name}-${before}`;
}

// Lists the files that a server's visitor needs for the cache, so that the page works without a network. Other contents
// have another version.
const files = (folder) => readdirSync(folder).flatMap(name => statSync(join(folder, name)).isDirectory() ? files(join(folder, name)) : [relative(out, join(folder, name))]);
const cached = files(out).filter(name => name !== 'disk.js').sort(), version = createHash('sha256');
for (const name of cached) version.update(readFileSync(join(out, name)));
writeFileSync(join(out, 'offline.js'), readFileSync(join(here, 'offline.js'), 'utf8').replace('[/* files */]', JSON.stringify(['./', ...cached])).replace('/* version */', version.digest('hex').slice(0, 16)));
