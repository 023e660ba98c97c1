// The page as a release carries it, one zip, opened from disk without a server: by file:// in headless Chromium, from a
// folder whose name has a space and letters that are not ASCII (page_visit.mjs documents the arguments).
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { data, decode, domed, drawn, drop, encode, end, fact, needsData, open, problem, root, run, saved, scratch, settled,
  texelsEqual, viewed } from './page_visit.mjs';

const zips = readdirSync(dirname(root)).filter(name => /^cotan-[\d.]+-page\.zip$/.test(name));
const folder = mkdtempSync(join(tmpdir(), 'Äöü 地図 '));
process.on('exit', () => rmSync(folder, { recursive: true }));
execFileSync('python3', ['-m', 'zipfile', '-e', join(dirname(root), zips[0]), folder]);
const [unpacked] = readdirSync(folder), address = `${pathToFileURL(join(folder, unpacked))}/`;
const opened = () => open({}, 'index.html', address);

await fact('oneZipHasThePageAndItsLicences', () => {
  if (zips.length !== 1) return `${zips.length} zips: ${zips}`;
  const listed = readdirSync(join(folder, unpacked, 'licences')).sort().join(' ');
  return unpacked === zips[0].replace('.zip', '') && /cotan.*draco.*emscripten.*fmt.*three/.test(listed) ? '' : `${unpacked} has licences ${listed}`;
});

await fact('fromDiskAMapIsFixedAsByTheCommandLine', async () => {
  const page = await opened();
  await page.click('#sample-map');
  await settled(page);
  if (!/wrong way for glTF/.test(await page.textContent('#result'))) return `says: ${await page.textContent('#result')} ${await problem(page)}`;
  if (await drawn(page, '.view canvas') < 0.05) return 'the image is blank';
  const size = 64, map = { width: size, height: size, depth: 8, channels: 3, data: Uint8Array.from({ length: 3 * size * size }, (_, k) => {
    const [x, y] = [k / 3 % size, k / 3 / size].map(at => (Math.floor(at) + 0.5) / size * 2 - 1), inside = Math.hypot(x, y) < 0.8 ? 1 : 0;
    return Math.round(128 + 127 * [x * inside, y * inside, Math.sqrt(1 - inside * (x * x + y * y))][k % 3]);
  }) };
  writeFileSync(join(scratch, 'dome of disk.png'), encode(map));
  await drop(page, [join(scratch, 'dome of disk.png')]);
  const { bytes } = await saved(page, () => page.click('text=Download the fixed map'));
  const [, words] = /--from (\S+ --to \S+)/.exec(await page.textContent('.result code')), [from, , to] = words.split(' ');
  run('map', 'convert', 'dome of disk.png', '--from', from, '--to', to, '-o', 'tool.png', '--overwrite', '--quiet');
  return texelsEqual(decode(bytes), decode(readFileSync(join(scratch, 'tool.png')))) ? '' : 'the texels differ from those of the command line';
});

await fact('fromDiskAModelIsCheckedDrawnAndSaved', async () => {
  const page = await opened(), file = await domed('disk.glb', false, [0.3, 0.5, 0.7]);
  await drop(page, [file]);
  if (await problem(page)) return await problem(page);
  if (!/Green of a normal map points opposite/.test(await page.textContent('.verdict'))) return `says: ${await page.textContent('.verdict')}`;
  run('lint', 'disk.glb', '--json', 'lint.json', '--quiet');
  const { recommendation } = JSON.parse(readFileSync(join(scratch, 'lint.json'), 'utf8')), advice = await page.textContent('.verdict + p');
  if (advice !== recommendation) return `says "${advice}", the command line "${recommendation}"`;
  await viewed(page);
  if (await drawn(page, '.view canvas') < 0.02) return 'the image is blank';
  const { name, bytes } = await saved(page, () => page.click('#result button.main'));
  writeFileSync(join(scratch, `saved_${name}`), bytes);
  run('lint', `saved_${name}`, '--json', 'lint.json', '--quiet');
  const { maps } = JSON.parse(readFileSync(join(scratch, 'lint.json'), 'utf8'));
  return maps.length === 1 && maps[0].as_declared ? '' : 'the green of the saved model still points the wrong way';
});

await fact('fromDiskCompressedModelsAreReadByTheirDecoders', async () => {
  const page = await opened();
  for (const name of ['jet_fighter_draco_basisu.glb', 'pirate_meshopt.glb']) {
    await drop(page, [join(data, 'compressed', name)]);
    if (await problem(page)) return `${name}: ${await problem(page)}`;
    await viewed(page);
    if (await drawn(page, '.view canvas') < 0.02) return `${name}: the image is blank`;
  }
}, needsData);

await fact('fromDiskTheShaderAndTheDocumentsAreThere', async () => {
  const page = await open({}, 'index.html#shader?lang=wgsl&frame=orthonormal&map=directx', address);
  await page.waitForFunction(() => document.querySelector('#shader-panel pre code')?.textContent.length > 500);
  if ((await page.textContent('#shader-panel pre code')).trim() !== run('shader', '--lang', 'wgsl', '--frame', 'orthonormal', '--preset', 'directx').trim()) return 'the shader is not that of the tool';
  await page.locator('#shader select').first().selectOption('hlsl');
  await page.waitForFunction(() => /float3/.test(document.querySelector('#shader-panel pre code').textContent));
  if (!/lang=hlsl&frame=orthonormal/.test(page.url())) return `the address is ${page.url()}`;
  for (const name of ['Theory', 'The figures', 'Cost']) {
    await page.click(`nav >> text=${name}`);
    await page.waitForFunction(() => [...document.images].every(image => image.complete));
    const broken = await page.evaluate(() => [...document.images].filter(image => image.naturalWidth === 0).map(image => image.src));
    if (broken.length > 0 || (await page.textContent('main')).length < 1000) return `${name}: ${broken}`;
  }
});

await end();
