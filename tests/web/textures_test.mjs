// The textures of blocks of the npm package, compared with those of the tool byte for byte:
//   node textures_test.mjs TARBALL WHOLE_TARBALL COTAN MODULES [CASE]
// WHOLE_TARBALL has the libraries of scripts/web-libraries.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';

import { basisFolder, texelsOf, transcoder } from './basis_transcoder.mjs';
import { emptyFolder, here, installed, load, runCases, skip } from './shared.mjs';

const [tarball, whole, tool, modules, only] = process.argv.slice(2);
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');

// Waves of unit normals, no multiple of four texels wide or high.
const width = 62, height = 37, data = new Uint16Array(4 * width * height);
for (let y = 0; y < height; ++y)
  for (let x = 0; x < width; ++x) {
    const a = 0.9 * Math.sin(x / 3) * Math.cos(y / 5), b = 0.8 * Math.cos(x / 7 + y / 2), l = Math.hypot(a, b, 1);
    data.set([a / l, b / l, 1 / l].map((c) => Math.round(32768 + 32767 * c)).concat(65535), 4 * (y * width + x));
  }
const map = { width, height, data };

async function sameAsTheTool(folder, formats) {
  const { ready, texture } = await load(folder, 'textures'), cotan = await load(folder), place = emptyFolder();
  await Promise.all([ready, cotan.ready]);
  fs.writeFileSync(path.join(place, 'map.png'), await cotan.encodePng(map));
  for (const [compress, to, swizzle, container, mips] of formats) {
    const file = path.join(place, `${compress}.${container}`), words = ['--from', 'gltf,exact', '--to', to, '--compress', compress, '--swizzle', swizzle];
    execFileSync(tool, ['map', 'convert', path.join(place, 'map.png'), ...words, ...(mips ? ['--mips'] : []), '--overwrite', '--json', path.join(place, 'a.json'), '-o', file]);
    const made = texture(map, { from: 'gltf,exact', to, compress, swizzle, container, mips }), report = JSON.parse(fs.readFileSync(path.join(place, 'a.json')));
    assert.ok(Buffer.from(made.bytes).equals(fs.readFileSync(file)), `${compress} ${container}`);
    assert.equal(made.levels, mips ? 6 : 1);
    if (container === 'dds') assert.equal(made.degrees, null, 'DDS is not read here');
    if (compress === 'none' || container === 'dds') continue;
    assert.ok(Math.abs(made.degrees.mean - report.mean_degrees) < 0.01 && made.degrees.percentile99 > made.degrees.mean, `${compress}: ${JSON.stringify(made.degrees)}`);
  }
}

const cases = {
  async blocksHaveTheBytesOfTheTool() {
    await sameAsTheTool(installed(tarball), [
      ['none', 'gltf', 'auto', 'ktx2', true], ['none', 'unity,xy', 'ag', 'dds', false], ['bc3', 'gltf,xy', 'auto', 'dds', true],
      ['bc5', 'gltf,xy', 'auto', 'ktx2', true], ['bc5-snorm', 'gltf,xy', 'auto', 'dds', true], ['bc7', 'directx', 'auto', 'ktx2', true],
      ['eac-rg11', 'gltf,exact,xy', 'auto', 'ktx2', true]]);
  },

  async badWordsAreRefusedByName() {
    const { ready, texture } = await load(installed(tarball), 'textures');
    await ready;
    for (const [options, message] of [[{ compress: 'astc-4x4' }, /libastcenc/], [{ compress: 'bc6' }, /^options\.compress: expected one of none, /],
      [{ container: 'png' }, /^options\.container: expected ktx2 or dds, found 'png'/], [{ mips: 1 }, /^options\.mips: expected true or false/],
      [{ levels: 3 }, /levels/], [{ compress: 'bc7', to: 'gltf,xy' }, /^options\.to: bc7 holds x, y and z/]])
      assert.throws(() => texture(map, options), (error) => error.name !== 'TypeError' && message.test(error.message), JSON.stringify(options));
    assert.ok(texture(map).bytes.length > 0); // the library stays usable
  },

  // Zstandard is in the package that has the libraries.
  async packedBlocksAreWrittenAndRead() {
    if (!fs.existsSync(whole)) skip('the package with the command has not been built (scripts/npm-package build/npm build/web-libraries)');
    const folder = installed(whole);
    await sameAsTheTool(folder, [['uastc', 'gltf', 'auto', 'ktx2', true], ['uastc', 'gltf,exact', 'auto', 'ktx2', false]]);
    const cotan = await load(folder), bytes = fs.readFileSync(path.join(here, '../../fuzz/corpus/image/uastc_zstd.ktx2'));
    await cotan.ready;
    const found = await cotan.decodeImage(bytes, 'map.ktx2');
    if (!fs.existsSync(basisFolder(modules))) return;
    const wanted = texelsOf(await transcoder(modules), bytes);
    assert.ok(Buffer.from(found.data).equals(Buffer.from(wanted.data)));
  },
};
await runCases(cases, only);
