// Names of files of Windows in the command of the npm package: node file_names_test.mjs FOLDER [CASE]. FOLDER: that of the
// package's sources, bindings/js. Node's path module of Windows is the judge of what a name means.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { runCases } from './shared.mjs';

const [folder, only] = process.argv.slice(2);
const namesOf = new Function(`${fs.readFileSync(path.join(folder, 'tool/names.js'), 'utf8')}; return namesOfFiles;`)();
const names = namesOf(path.win32);
const same = (name, word) => assert.equal(path.win32.resolve(name), path.win32.resolve(word), word);

const kWords = ['C:\\maps\\a.png', 'c:/maps\\a.png', '..\\maps\\a.png', '.\\a.png', 'maps\\sub/a.png', 'a.png', '\\\\server\\share\\a.png',
  '//server/share/a.png', '\\root\\a.png', 'C:\\', 'D:', 'D:a.png', 'D:maps\\', 'D:..\\a.png', 'C:\\x\\..\\a.png', 'C:\\ü 日本\\a b.png'];

await runCases({
  filesOfWordsAreThoseThatWindowsMeans() {
    for (const word of kWords) {
      const file = names.fileOf(word);
      assert.ok(!file.includes('\\'), file);
      same(names.outside(file), word);
      assert.equal(file.endsWith('/'), /[\\/]$/.test(word), 'folders stay folders');
    }
    assert.equal(names.fileOf('\\\\?\\C:\\long\\a.png'), 'C:/long/a.png');
    assert.equal(names.fileOf('\\\\?\\UNC\\server\\share\\a.png'), '//server/share/a.png');
  },

  wholeNamesComeBackAsTheyWent() {
    for (const name of ['C:\\', 'C:\\maps', 'C:\\maps\\a.png', '\\\\server\\share\\maps\\a.png']) {
      assert.ok(names.inside(name).startsWith('/'), 'C++ takes it for a whole name');
      same(names.outside(names.inside(name)), name);
    }
    same(names.outside(names.inside('\\\\?\\C:\\target\\')), 'C:\\target');
  },

  aDriveAfterAFolderIsALinkToIt() {
    assert.equal(names.linkOf('/C:/work/D:'), '/D:');
    assert.equal(names.linkOf('D:'), '/D:');
    for (const name of ['/D:', '/C:/D:x', '/C:/work', 'ab:', '//server/share']) assert.equal(names.linkOf(name), undefined, name);
    same(names.outside('/C:/work/D:/a.png'), 'D:\\a.png');
    same(names.outside('/C:/work/D:'), 'D:\\');
    assert.equal(names.outside('/C:/work/x:y'), 'C:/work/x:y', 'a stream of a file is no drive');
  },

  rootsAreNoLinks() {
    for (const name of ['/C:', '//server', '//server/share']) assert.ok(names.isRoot(name), name);
    for (const name of ['/C:/a', 'C:', '//server/share/a', '/a']) assert.ok(!names.isRoot(name), name);
  },

  otherSystemsKeepAllNames() {
    const posix = namesOf(path.posix);
    for (const word of [...kWords, '/C:/a', 'a\\b'])
      for (const given of [posix.fileOf(word), posix.inside(word), posix.outside(word)]) assert.equal(given, word);
    assert.ok(!posix.linkOf('C:') && !posix.isRoot('/C:'));
  },
}, only);
