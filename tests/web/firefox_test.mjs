// The page in stock Firefox, on an X server with Mesa's CPU driver, since Firefox has no WebGL without one:
//   node firefox_test.mjs PAGE PUPPETEER NODE_MODULES TOOL [CASE]
// PAGE: folder of the built page. PUPPETEER: a node_modules folder with puppeteer-core. NODE_MODULES: has fast-png. TOOL:
// cotan. scripts/try-firefox runs it, because tests/npm does not have puppeteer-core. Exit code 77: skipped.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, readdirSync } from 'node:fs';
import { createRequire } from 'node:module';
import { basename, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { serve } from './chromium.mjs';
import { data, missing } from './data.mjs';
import { emptyFolder, runCases, skip } from './shared.mjs';

const [root, drivers, modules, tool, only] = process.argv.slice(2);
if (missing) skip(missing);
const { default: puppeteer } = await import(createRequire(join(drivers, 'x.js')).resolve('puppeteer-core'));
const { decode } = await import(join(modules, 'fast-png/lib/index.js'));
const { address, close } = await serve({ page: root }), scratch = emptyFolder();
const browser = await puppeteer.launch({ browser: 'firefox', executablePath: process.env.FIREFOX ?? '/usr/bin/firefox-esr', headless: false });
console.log(await browser.version());
const run = (...words) => execFileSync(tool, words, { cwd: scratch, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });

async function open(at = `${address}page/index.html`) {
  const page = await browser.newPage();
  page.errors = [];
  page.on('pageerror', error => page.errors.push(error.message));
  await page.setViewport({ width: 1280, height: 900 });
  await page.goto(at);
  return page;
}
const textOf = (page, selector) => page.evaluate(selector => document.querySelector(selector)?.textContent ?? '', selector);

// Drops files onto the page and waits for its answer.
async function drop(page, files) {
  const given = files.map(file => [basename(file), readFileSync(file).toString('base64')]);
  await page.evaluate(given => {
    document.getElementById('result').replaceChildren();
    const transfer = new DataTransfer();
    for (const [name, text] of given) transfer.items.add(new File([Uint8Array.from(atob(text), c => c.charCodeAt(0))], name));
    document.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
  }, given);
  await page.waitForFunction(() => document.getElementById('status').textContent === ''
    && (document.getElementById('problem').textContent !== '' || document.getElementById('result').childNodes.length > 0), { timeout: 60000 });
  assert.equal(await textOf(page, '#problem'), '', files.join(' '));
}

// The fraction of the pixels of a canvas that differ from the first one.
async function drawn(page, selector) {
  const png = decode(await (await page.$(selector)).screenshot());
  let count = 0;
  for (let k = 0; k < png.data.length; k += png.channels) if (Math.abs(png.data[k] - png.data[0]) + Math.abs(png.data[k + 1] - png.data[1]) > 24) ++count;
  return count / (png.width * png.height);
}

// Clicks a link or a button and returns the bytes of the file that the page gives.
async function saved(page, words) {
  const bytes = await page.evaluate(words => new Promise(done => {
    const plain = URL.createObjectURL;
    URL.createObjectURL = blob => {
      URL.createObjectURL = plain;
      blob.arrayBuffer().then(buffer => done([...new Uint8Array(buffer)]));
      return plain(blob);
    };
    [...document.querySelectorAll('a, button')].find(one => one.textContent.includes(words)).click();
  }), words);
  return Buffer.from(bytes);
}

await runCases({
  async mapsAreFixedAsByTheCommandLine() {
    const page = await open();
    for (const name of ['scratched_gold_normal_dx.png', 'noise16_normal_gl.png']) {
      const file = join(data, 'textures', name);
      await drop(page, [file]);
      assert.ok(await drawn(page, '.view canvas') > 0.05, `${name}: the image is blank`);
      const bytes = await saved(page, 'Download the fixed map');
      const [, from, to] = /--from (\S+) --to (\S+)/.exec(await textOf(page, '.result code'));
      run('map', 'convert', file, '--from', from, '--to', to, '-o', 'tool.png', '--overwrite', '--quiet');
      const [ours, tools] = [decode(bytes), decode(readFileSync(join(scratch, 'tool.png')))];
      assert.deepEqual([ours.width, ours.height, ours.depth], [tools.width, tools.height, tools.depth]);
      const channels = ({ data: values, channels }, c) => values.filter((_, k) => k % channels === c);
      for (const c of [0, 1, 2]) assert.ok(Buffer.from(channels(ours, c).buffer).equals(Buffer.from(channels(tools, c).buffer)), `${name}, channel ${c}`);
    }
    assert.deepEqual(page.errors, []);
    await page.close();
  },

  // The advice is that of the command line; both halves of the view are the same surface, and cotangents on stretched
  // texture coordinates are degrees off.
  async modelsAreJudgedAndDrawn() {
    const page = await open();
    for (const files of [['models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb'], readdirSync(join(data, 'models/BoomBox')).map(name => `models/BoomBox/${name}`)]) {
      const paths = files.map(name => join(data, name)), main = paths.find(path => /\.gl(b|tf)$/.test(path));
      await drop(page, paths);
      run('lint', main, '--json', 'lint.json', '--overwrite', '--quiet');
      assert.equal(await textOf(page, '.verdict + p'), JSON.parse(readFileSync(join(scratch, 'lint.json'), 'utf8')).recommendation, main);
      await page.waitForFunction(() => /differ by [\d.]+°/.test(document.querySelector('.view')?.textContent ?? ''), { timeout: 120000 });
      const apart = Number(/differ by ([\d.]+)°/.exec(await textOf(page, '.view'))[1]);
      console.log(`${basename(main)}: ${apart} degrees`);
      assert.ok(apart < 0.5, `${main}: ${apart} degrees`);
      assert.ok(await drawn(page, '.view canvas') > 0.02, `${main}: the image is blank`);
    }
    assert.deepEqual(page.errors, []);
    await page.close();
  },

  async thePageOpensFromDisk() {
    const [zip] = readdirSync(join(root, '..')).filter(name => /-page\.zip$/.test(name)), folder = emptyFolder();
    execFileSync('python3', ['-m', 'zipfile', '-e', join(root, '..', zip), folder]);
    const page = await open(String(pathToFileURL(join(folder, readdirSync(folder)[0], 'index.html'))));
    await page.click('#sample-map');
    await page.waitForFunction(() => document.querySelector('.verdict') !== null, { timeout: 60000 });
    assert.match(await textOf(page, '.verdict'), /wrong way for glTF/);
    assert.deepEqual(page.errors, []);
    await page.close();
  },
}, only);
await browser.close();
close();
