// web/zip.js on zips of Python's zipfile, and on damaged and hostile ones: node zip_test.mjs TARBALL [CASE]
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { crc32, deflateRawSync } from 'node:zlib';

import { here, installed, runCases, skip } from './shared.mjs';

const [tarball, only] = process.argv.slice(2);
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
const folder = installed(tarball); // where zip.js finds the package
fs.copyFileSync(path.join(here, '../../web/zip.js'), path.join(folder, 'zip.js'));
fs.writeFileSync(path.join(folder, 'error.js'), "export { CotanError } from 'cotan/beside';\n");
const { unzip } = await import(pathToFileURL(path.join(folder, 'zip.js'))), { CotanError } = await import(pathToFileURL(path.join(folder, 'error.js')));

/** A zip as Python writes it. files: { path: text }. */
function pythonZip(files, { stored = false } = {}) {
  const place = path.join(folder, 'made.zip');
  execFileSync('python3', ['-c', `import json, sys, zipfile
with zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_${stored ? 'STORED' : 'DEFLATED'}) as made:
    for name, text in json.loads(sys.argv[2]).items(): made.writestr(name, text)`, place, JSON.stringify(files)]);
  return new Uint8Array(fs.readFileSync(place));
}
const textsOf = (files) => Object.fromEntries(files.map(({ path: name, bytes }) => [name, Buffer.from(bytes).toString()]));

/** A zip by hand. entries: { name, data, and fields of the two headers to be changed: method, sum, packed, unpacked, flags, offset, local: {...} }. */
function madeZip(entries, { count, comment = '', tail = {} } = {}) {
  const parts = [], directory = [];
  let at = 0;
  const push = (list, bytes) => { list.push(bytes); return bytes.length; };
  const numbers = (layout) => Buffer.concat(layout.map(([size, value]) => { const b = Buffer.alloc(size); b.writeUIntLE(value, 0, size); return b; }));
  for (const entry of entries) {
    const data = Buffer.from(entry.data ?? 'data'), method = entry.method ?? 8, body = entry.body ?? (method === 8 ? deflateRawSync(data) : data), name = Buffer.from(entry.name ?? 'a.txt');
    const now = { flags: 0x800, method, sum: crc32(data), packed: body.length, unpacked: data.length, offset: at, name, ...entry.fields }, local = { ...now, ...entry.local };
    at += push(parts, numbers([[4, 0x04034b50], [2, 20], [2, local.flags], [2, local.method], [4, 0], [4, local.sum], [4, local.packed], [4, local.unpacked], [2, local.name.length], [2, 0]]));
    at += push(parts, local.name);
    at += push(parts, body);
    directory.push(numbers([[4, 0x02014b50], [2, 20], [2, 20], [2, now.flags], [2, now.method], [4, 0], [4, now.sum], [4, now.packed], [4, now.unpacked], [2, now.name.length], [2, 0], [2, 0], [2, 0], [2, 0], [4, 0], [4, now.offset]]), now.name);
  }
  const list = Buffer.concat(directory), n = count ?? entries.length, end = { disk: 0, n, size: list.length, begin: at, ...tail };
  return new Uint8Array(Buffer.concat([...parts, list, numbers([[4, 0x06054b50], [2, end.disk], [2, 0], [2, end.n], [2, end.n], [4, end.size], [4, end.begin], [2, comment.length]]), Buffer.from(comment)]));
}

/** The body of the first entry contains the second one, with its header. */
function overlapping() {
  const inner = madeZip([{ name: 'b', data: 'inner', method: 0 }]), header = inner.subarray(0, 30 + 1 + 5);
  const whole = madeZip([{ name: 'a', data: Buffer.from(header), method: 0 }, { name: 'b', data: 'inner', method: 0, fields: { offset: 31 } }]);
  return whole;
}

const refused = (bytes, words, what) => assert.rejects(unzip('x.zip', bytes), (error) => {
  assert.ok(error instanceof CotanError, `${what}: ${error.stack}`);
  assert.match(error.message, /^x\.zip: [^\n]{1,300}$/, what);
  assert.match(error.message, words, what);
  return error.code === 'input';
}, what);

const cases = {
  async zipsOfOtherProgramsAreRead() {
    const files = { 'scene.gltf': '{}'.repeat(5000), 'textures/a b.png': 'x', 'ünïcode/日本.bin': 'y'.repeat(70000), 'empty.txt': '' };
    for (const stored of [false, true]) assert.deepEqual(textsOf(await unzip('x.zip', pythonZip(files, { stored }))), files);
    assert.deepEqual(textsOf(await unzip('x.zip', pythonZip({ 'a/': '', 'a/b.txt': '1', '__MACOSX/._b': '2', '.DS_Store': '3' }))), { 'a/b.txt': '1' });
    assert.deepEqual(textsOf(await unzip('x.zip', madeZip([{ name: 'a\\b.txt' }], { comment: 'written on Windows' }))), { 'a/b.txt': 'data' });
    // Sizes behind the data, as writers of streams store them.
    assert.deepEqual(textsOf(await unzip('x.zip', madeZip([{ fields: { flags: 0x808 }, local: { sum: 0, packed: 0, unpacked: 0 } }]))), { 'a.txt': 'data' });
    assert.deepEqual(await unzip('x.zip', madeZip([])), []);
  },

  async hostileZipsAreRefused() {
    const bomb = Buffer.alloc(5e6);
    for (const [what, bytes, words] of [
      ['a path upwards', madeZip([{ name: '../a.txt' }]), /expected the name of a file inside the zip, found "\.\.\/a\.txt"/],
      ['a path upwards in the middle', madeZip([{ name: 'a/../../b' }]), /inside the zip/],
      ['a path upwards on Windows', madeZip([{ name: 'a\\..\\..\\b' }]), /inside the zip/],
      ['an absolute path', madeZip([{ name: '/etc/passwd' }]), /inside the zip/],
      ['a drive', madeZip([{ name: 'C:/x' }]), /inside the zip/],
      ['a name with NUL', madeZip([{ name: 'a.png\0.exe' }]), /inside the zip/],
      ['an empty name', madeZip([{ name: '' }]), /inside the zip/],
      ['two files of one name', madeZip([{}, {}]), /a\.txt: two files have this name/],
      ['more bytes than declared', madeZip([{ data: bomb, fields: { unpacked: 1000 } }]), /expected 1000 bytes, found more/],
      ['fewer bytes than declared', madeZip([{ fields: { unpacked: 5 } }]), /expected 5 bytes, found 4/],
      ['a size that deflate cannot reach', madeZip([{ fields: { unpacked: 1e9 } }]), /cannot become 1000000000/],
      ['4 GiB in one entry', madeZip([{ fields: { unpacked: 0xfffffffe } }]), /cannot become/],
      ['1.1 GiB in many entries', madeZip(Array.from({ length: 11 }, (_, k) => ({ name: `${k}`, body: deflateRawSync(Buffer.alloc(1e8 + k)), fields: { sum: 0, unpacked: 1e8 } }))), /at most 1 GiB/],
      ['overlapping entries', overlapping(), /b: its data overlap those of a/],
      ['one body for two entries', madeZip([{ name: 'aa' }, { name: 'ab', fields: { offset: 0 } }]), /ab: /],
      ['a wrong checksum', madeZip([{ fields: { sum: 1 }, local: { sum: 1 } }]), /its checksum is wrong/],
      ['a size in the file that differs', madeZip([{ local: { packed: 1 } }]), /contradict/],
      ['a name in the file that differs', madeZip([{ local: { name: Buffer.from('b.txt') } }]), /contradict/],
      ['a method in the file that differs', madeZip([{ local: { method: 0 } }]), /contradict/],
      ['data behind the list of files', madeZip([{ fields: { packed: 1e6, unpacked: 1e6 } }]), /its data end behind/],
      ['an offset behind the list of files', madeZip([{ fields: { offset: 1e6 } }]), /no file at its offset/],
      ['encryption', madeZip([{ fields: { flags: 1 } }]), /password/],
      ['another method', madeZip([{ fields: { method: 14 } }]), /method 14/],
      ['deflate that is none', madeZip([{ body: Buffer.from([0xff, 0xff, 0xff, 0xff]) }]), /cannot be decompressed/],
      ['a count that is too high', madeZip([{}], { count: 2 }), /expected 2 entries/],
      ['65,535 files', madeZip([{}], { count: 65535 }), /ZIP64/],
      ['20,000 files', madeZip([{}], { count: 20000 }), /at most 10000 files/],
      ['a list of files elsewhere', madeZip([{}], { tail: { begin: 1e6 } }), /not where/],
      ['a list of 4 GiB', madeZip([{}], { tail: { size: 0xfffffffe } }), /not where/],
      ['a part of several', madeZip([{}], { tail: { disk: 1 } }), /one of several parts/],
      ['no zip', new Uint8Array(100), /expected the end of a zip, found none/],
      ['a cut zip', madeZip([{ data: 'x'.repeat(100) }]).subarray(0, 60), /incomplete/],
      ['nothing', new Uint8Array(0), /found none/],
    ]) await refused(bytes, words, what);
  },

  // Any byte changed, removed or added: the same files, or one line.
  async damagedZipsGiveTheirFilesOrOneLine() {
    const whole = pythonZip({ 'scene.gltf': '{"asset":{}}'.repeat(20), 'b/c.bin': 'q'.repeat(300) }), expected = textsOf(await unzip('x.zip', whole));
    let seed = 7, read = 0, wrong = 0;
    const random = (below) => { seed = Math.imul(seed, 1103515245) + 12345 >>> 0; return (seed >>> 8) % below; };
    for (let k = 0; k < 3000; ++k) {
      let bytes = whole.slice();
      for (let n = 1 + random(3); n > 0; --n) {
        const at = random(bytes.length), how = random(4);
        if (how < 2) bytes[at] = random(256);
        else if (how === 2) bytes = bytes.slice(0, at);
        else bytes = Uint8Array.from([...bytes.subarray(0, at), random(256), ...bytes.subarray(at)]);
        if (bytes.length === 0) break;
      }
      try {
        const found = textsOf(await unzip('x.zip', bytes));
        for (const [name, text] of Object.entries(found)) if (name in expected) assert.equal(text, expected[name]);
        ++read;
      } catch (error) {
        assert.ok(error instanceof CotanError, error.stack);
        ++wrong;
      }
    }
    console.log(`${read} read, ${wrong} refused`);
    assert.ok(read > 50 && wrong > 1000);
  },
};
await runCases(cases, only);
