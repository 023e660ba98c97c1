// Checks the typings of the package with the TypeScript compiler: node types_test.mjs TARBALL NODE_MODULES [CASE]
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { here, installed, runCases, skip } from './shared.mjs';

const [tarball, modules, only] = process.argv.slice(2);
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
const compiler = path.join(modules, 'typescript/lib/tsc.js');
if (!fs.existsSync(compiler) || !fs.existsSync(path.join(modules, '@types/three'))) skip('typescript and @types/three are not installed');
const folder = installed(tarball, modules, ['@gltf-transform', 'property-graph', 'three', 'react', '@react-three', '@types', 'csstype']);

const program = (name) => fs.readFileSync(path.join(here, 'types', name), 'utf8');

/** A program that names the exports of each entry of the package. */
async function namesOfExports() {
  fs.writeFileSync(path.join(folder, 'from.js'), 'export const from = (name) => import(name);\n');
  const { from } = await import(pathToFileURL(path.join(folder, 'from.js')));
  let text = '';
  for (const [k, entry] of ['cotan', 'cotan/beside', 'cotan/tangents', 'cotan/tangents/beside', 'cotan/gltf-transform', 'cotan/three', 'cotan/three/tsl', 'cotan/three/relief', 'cotan/three/tsl/relief', 'cotan/react'].entries()) {
    const names = Object.keys(await from(entry));
    assert.ok(names.length > 1, entry);
    for (const name of names) assert.match(program('right.ts'), new RegExp(`\\b${name}\\b`), `right.ts does not use ${name} of ${entry}`);
    text += `import * as entry${k} from '${entry}';\nexport const names${k}: Record<keyof typeof entry${k}, true> = { ${names.map((name) => `${name}: true`).join(', ')} };\n`;
  }
  return text;
}

/** Returns the compiler's errors for programs and for the typings of the package. One run, since the typings of three take most of it. */
function compiled(programs) {
  for (const [name, text] of Object.entries(programs)) fs.writeFileSync(path.join(folder, name), text);
  fs.writeFileSync(path.join(folder, 'tsconfig.json'), JSON.stringify({ files: Object.keys(programs), compilerOptions: {
    noEmit: true, strict: true, noUncheckedIndexedAccess: true, target: 'es2022', lib: ['es2022', 'dom', 'dom.iterable'], module: 'nodenext', types: [],
  } }));
  const { stdout, stderr, error } = spawnSync(process.execPath, [compiler, '--pretty', 'false'], { cwd: folder, encoding: 'utf8' });
  if (error || stderr) throw error ?? new Error(stderr);
  // Errors in other packages are ignored. Their typings are checked because skipLibCheck would exclude ours as well.
  return stdout.split('\n').filter((line) => /error TS/.test(line) && !/^node_modules\/(?!cotan\/)|^\.\.\//.test(line));
}
const errors = compiled({ 'right.ts': program('right.ts'), 'wrong.ts': program('wrong.ts'), 'names.ts': await namesOfExports() });
const isWrong = (line) => line.startsWith('wrong.ts(');

const cases = {
  typingsMatchTheExportsAndAcceptEachInStrictMode() {
    assert.deepEqual(errors.filter((line) => !isWrong(line)), []);
  },

  everyWrongCallIsATypeError() {
    const refused = new Set(errors.filter(isWrong).map((line) => Number(/^wrong\.ts\((\d+),/.exec(line)?.[1])));
    const wrong = program('wrong.ts').split('\n').flatMap((line, k) => (line === '' || /^(\/\/|import )/.test(line) ? [] : [k + 1]));
    assert.ok(wrong.length > 10);
    assert.deepEqual([...refused].sort((a, b) => a - b), wrong);
  },
};
await runCases(cases, only);
