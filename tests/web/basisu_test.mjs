// The tool draws and converts a model with BasisU textures as a copy of it with PNG textures, which the transcoder of
// Binomial in npm's three makes.
//   node basisu_test.mjs NODE_MODULES COTAN [PICTURES]
// PICTURES: a folder that receives the compared images. Exit code 77: skipped.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { basisFolder, texelsOf, transcoder } from './basis_transcoder.mjs';
import { dataFile } from './data.mjs';
import { emptyFolder, imageOf, parseGlb, skip } from './shared.mjs';

const [modules, cotan, pictures] = process.argv.slice(2), folder = emptyFolder();
const model = dataFile('compressed/jet_fighter_draco_basisu.glb');
if (!fs.existsSync(basisFolder(modules))) skip('three is not installed (see the test npm_packages)');
if (!fs.existsSync(model)) skip(`${path.basename(model)} is not there: run scripts/test-data`);
const { decode, encode } = await import(path.resolve(modules, 'fast-png/lib/index.js'));

// Returns the model with its images as PNG, appended to its binary chunk.
async function withPngTextures(file) {
  const glb = parseGlb(fs.readFileSync(file)), { json } = glb, basisu = 'KHR_texture_basisu', parts = [glb.bin], made = await transcoder(modules);
  let length = glb.bin.length;
  json.images.forEach((image, k) => {
    const texels = texelsOf(made, imageOf(glb, k));
    assert.ok(texels, `image ${k}`);
    const bytes = encode(texels), gap = -bytes.length & 3;
    json.bufferViews.push({ buffer: 0, byteOffset: length, byteLength: bytes.length });
    Object.assign(image, { mimeType: 'image/png', bufferView: json.bufferViews.length - 1 });
    parts.push(bytes, Buffer.alloc(gap));
    length += bytes.length + gap;
  });
  for (const texture of json.textures) {
    texture.source = texture.extensions[basisu].source;
    delete texture.extensions;
  }
  for (const list of ['extensionsUsed', 'extensionsRequired']) json[list] = json[list].filter(name => name !== basisu);
  json.buffers[0].byteLength = length;
  let text = Buffer.from(JSON.stringify(json));
  text = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]);
  const head = Buffer.alloc(20), binary = Buffer.alloc(8);
  [0x46546c67, 2, 28 + text.length + length, text.length, 0x4e4f534a].forEach((word, k) => head.writeUInt32LE(word, 4 * k));
  [length, 0x004e4942].forEach((word, k) => binary.writeUInt32LE(word, 4 * k));
  return Buffer.concat([head, text, binary, ...parts]);
}

function run(...words) {
  const done = spawnSync(path.resolve(cotan), words, { cwd: folder, encoding: 'utf8' });
  if (/libdraco/.test(done.stderr)) skip(done.stderr);
  assert.equal(done.status, 0, done.stderr);
  return done.stderr;
}
const report = name => JSON.parse(fs.readFileSync(path.join(folder, name), 'utf8'));
fs.copyFileSync(model, path.join(folder, 'basisu.glb'));
fs.writeFileSync(path.join(folder, 'png.glb'), await withPngTextures(model));

// Both are drawn alike, and lint finds the same in them.
const pixels = kind => {
  run('render', `${kind}.glb`, '-o', `${kind}.png`, '--size', '320x240');
  return decode(fs.readFileSync(path.join(folder, `${kind}.png`))).data;
};
assert.deepEqual(pixels('basisu'), pixels('png'));
const linted = ['basisu', 'png'].map(kind => {
  run('lint', `${kind}.glb`, '--json', `${kind}.json`, '--quiet');
  const { primitives, maps } = report(`${kind}.json`);
  return { primitives, maps };
});
assert.ok(linted[0].maps.length > 0);
assert.deepEqual(linted[0], linted[1]);

// Converted maps are PNG: KTX2 is not written into models.
const said = run('convert', 'basisu.glb', '--to', 'cotangent', '-o', 'converted.glb', '--json', 'converted.json');
assert.doesNotMatch(said, /is not supported|no primitive has a normal map/);
const { maps, unread_maps: unread } = report('converted.json');
assert.ok(maps.length > 0 && maps.every(({ format }) => format === 'PNG'), JSON.stringify(maps));
assert.deepEqual(unread ?? [], []);
run('lint', 'converted.glb', '--quiet');

// The stored tangents imply the opposite of the declared direction of green. Drawn without them as they imply, the
// model differs by below one degree, as MikkTSpace and `orthonormal` do on coarse models. The map is flat nearly
// everywhere: the mean is 0.01 degrees, and 0.7 with green as declared, which turns bumps into dents.
const compare = (...more) => {
  const heard = run('compare', 'basisu.glb', '-o', 'out', '--overwrite', '--size', '640x480', '--json', 'out.json', ...more);
  const { frames, normals } = report('out.json');
  console.log(`${frames}: ${normals.mean_degrees} degrees in the mean\n${heard}`);
  return { frames, mean: normals.mean_degrees, said: heard };
};
const drawn = compare('--frames', 'orthonormal,mikktspace');
if (pictures) fs.cpSync(path.join(folder, 'out'), pictures, { recursive: true });
assert.deepEqual(drawn.frames, ['orthonormal', 'mikktspace']);
assert.match(drawn.said, /green is flipped/);
assert.ok(drawn.mean < 1, `${drawn.mean} degrees`);
const declared = compare('--frames', 'orthonormal,mikktspace', '--convention', 'gltf');
assert.ok(declared.mean > 20 * drawn.mean, `${declared.mean} degrees with green as declared`);
