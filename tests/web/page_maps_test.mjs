// Normal maps on the web page: its verdicts, fixes and renders, its shader and its patch, in headless Chromium, used as
// a visitor uses it (page_visit.mjs documents the arguments).
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { address, decode, drawn, drop, encode, end, fact, needsData, open, problem, run, saved, scratch, settled,
  texelsEqual, texture } from './page_visit.mjs';
import { here } from './shared.mjs';

await fact('aMapWithReversedGreenIsFoundAndFixed', async () => {
  const page = await open();
  await page.click('#sample-map');
  await settled(page);
  const words = await page.textContent('.verdict');
  if (!/wrong way for glTF/.test(words)) return `says: ${words} ${await problem(page)}`;
  if (await drawn(page, '.view canvas') < 0.05) return 'the picture is blank';
  // For docs/pictures/web-page.jpg.
  await page.locator('.result').screenshot({ path: join(scratch, 'web-page.jpg'), type: 'jpeg', quality: 88 });
  const { name, bytes } = await saved(page, () => page.click('text=Download the fixed map'));
  await drop(page, [join(scratch, writeFileSync(join(scratch, name), bytes) ?? name)]);
  const again = await page.textContent('.result');
  await page.context().close();
  return /Green points up/.test(again) ? '' : `the fixed map is said to be: ${again}`;
});

await fact('publishedMapsGetTheirVerdicts', async () => {
  const page = await open(), wrong = [];
  for (const line of readFileSync(texture('CONVENTIONS.tsv'), 'utf8').trim().split('\n').slice(1)) {
    const [file, way] = line.split('\t');
    await drop(page, [texture(file)]);
    const words = await page.textContent('#result');
    const wanted = way.startsWith('+Y') ? /Green points up/ : way.startsWith('-Y') ? /Green points down/ : /Nothing in this map shows/;
    if (!wanted.test(words)) wrong.push(`${file}: ${words.slice(0, 150)} ${await problem(page)}`);
  }
  await page.context().close();
  return wrong.join('\n');
}, needsData);

await fact('fixedMapsEqualThoseOfTheCommandLine', async () => {
  const page = await open(), wrong = [];
  for (const file of ['scratched_gold_normal_dx.png', 'noise16_normal_gl.png']) {
    await drop(page, [texture(file)]);
    const { bytes } = await saved(page, () => page.click('text=Download the fixed map'));
    const [, words] = /--from (\S+ --to \S+)/.exec(await page.textContent('.result code')), [from, , to] = words.split(' ');
    run('map', 'convert', texture(file), '--from', from, '--to', to, '-o', 'tool.png', '--overwrite', '--quiet');
    const [ours, tools] = [decode(bytes), decode(readFileSync(join(scratch, 'tool.png')))];
    if (!texelsEqual(ours, tools)) wrong.push(`${file}: ${ours.width} x ${ours.height} x ${ours.channels} of ${ours.depth} bits differ from ${tools.width} x ${tools.height} x ${tools.channels} of ${tools.depth}`);
  }
  await page.context().close();
  return wrong.join('\n');
}, needsData);

// Maps with red and blue exchanged, and of two channels.
await fact('brokenMapsAreFixedAsByTheCommandLine', async () => {
  const page = await open(), wrong = [], map = decode(readFileSync(texture('scratched_gold_normal_dx.png')));
  const changed = texel => ({ ...map, data: map.data.map((_, i, all) => texel(all.subarray(i - i % map.channels, i - i % map.channels + 3))[i % map.channels] ?? 255) });
  for (const [name, texel] of [['red and blue.png', ([x, y, z]) => [z, y, x]], ['two channels.png', ([x, y]) => [x, y, 128]]]) {
    writeFileSync(join(scratch, name), encode(changed(texel)));
    await drop(page, [join(scratch, name)]);
    const { bytes } = await saved(page, () => page.click('text=Download the fixed map'));
    const [, named, to] = /map convert "(.*?)" --from auto --to (\S+)/.exec(await page.textContent('.result code')) ?? [];
    if (named !== name) { wrong.push(`${name}: ${await page.textContent('#result')}`); continue; }
    run('map', 'convert', join(scratch, name), '--from', 'auto', '--to', to, '-o', 'tool.png', '--overwrite', '--quiet');
    if (!texelsEqual(decode(bytes), decode(readFileSync(join(scratch, 'tool.png'))))) wrong.push(`${name}: the fixed map differs from the tool's`);
  }
  await page.context().close();
  return wrong.join('\n');
}, needsData);

await fact('mapsOfBasisUniversalAreRead', async () => {
  const page = await open(), wrong = [], seed = name => join(here, `../../fuzz/corpus/image/${name}.ktx2`);
  for (const name of ['uastc_map', 'etc1s', 'etc1s_alpha']) {
    await drop(page, [seed(name)]);
    if (await problem(page) || await drawn(page, '.view canvas') < 0.02) wrong.push(`${name}: ${await problem(page) || 'the image is blank'}`);
  }
  await drop(page, [seed('uastc_zstd')]);
  if (!/KTX2 with Zstandard is read by the command line/.test(await problem(page))) wrong.push(`uastc_zstd: ${await problem(page)}`);
  await page.context().close();
  return wrong.join('\n');
});

await fact('shadersEqualTheCommandLinesAndTheAddressKeepsTheChoice', async () => {
  const page = await open({ permissions: ['clipboard-read', 'clipboard-write'] }, '#shader?lang=wgsl&frame=orthonormal&map=directx');
  await page.waitForFunction(() => document.querySelector('#shader-panel pre code')?.textContent.length > 500);
  const text = await page.textContent('#shader-panel pre code'), tools = run('shader', '--lang', 'wgsl', '--frame', 'orthonormal', '--preset', 'directx');
  if (text.trim() !== tools.trim()) return `the text differs from the tool's: ${text.slice(0, 200)}`;
  await page.locator('#shader select').first().selectOption('hlsl');
  await page.waitForFunction(() => /for HLSL|float3/.test(document.querySelector('#shader-panel pre code').textContent));
  if (!/lang=hlsl&frame=orthonormal/.test(page.url())) return `the address is ${page.url()}`;
  await page.click('#shader button.main');
  await page.waitForFunction(() => document.querySelector('#shader-panel [role=status]').textContent === 'Copied.');
  const copied = await page.evaluate(() => navigator.clipboard.readText()), shown = await page.textContent('#shader-panel pre code');
  await page.screenshot({ path: join(scratch, 'page-shader.png') });
  await page.context().close();
  return copied === shown ? '' : 'what was copied is not what is shown';
});

// The wrong frame for most maps must not be the one that is shown first.
await fact('theFirstShaderIsForMapsThatWereBakedForMikkTSpace', async () => {
  const page = await open({}, '#shader');
  await page.waitForFunction(() => document.querySelector('#shader-panel pre code')?.textContent.length > 500);
  const text = await page.textContent('#shader-panel pre code'), tools = run('shader', '--lang', 'essl', '--frame', 'orthonormal', '--preset', 'gltf');
  await page.context().close();
  return text.trim() === tools.trim() ? '' : `the page begins with ${text.slice(0, 300)}`;
});

await fact('shadersOfTheFrameTriangleAreGivenByStage', async () => {
  for (const stage of ['fragment', 'mesh']) {
    const page = await open({}, `#shader?lang=wgsl&frame=triangle&map=gltf&stage=${stage}`);
    await page.waitForFunction(() => document.querySelector('#shader-panel pre code')?.textContent.length > 500 || document.querySelector('#shader-panel [role=status]')?.textContent);
    const text = await page.textContent('#shader-panel pre code'), tools = run('shader', '--lang', 'wgsl', '--frame', 'triangle', '--stage', stage, '--preset', 'gltf');
    if (text.trim() !== tools.trim()) return `the text for ${stage} differs from the tool's: ${text.slice(0, 200)} ${await page.textContent('#shader-panel [role=status]')}`;
    await page.context().close();
  }
});

// The same content drawn by both APIs. SwiftShader rasterises and samples for both, so that only rounding differs, by an
// 8-bit step. A map larger than the canvas is read through mip levels with rounded texels: a step of a texel is up to
// 0.45 degrees there, which the highlight, with an exponent of 40, amplifies to five steps.
await fact('webGpuAndWebGlDrawTheSameImages', async () => {
  const large = { width: 1536, height: 1100, depth: 8, channels: 3, data: new Uint8Array(1536 * 1100 * 3) };
  for (let k = 0; k < 1536 * 1100; ++k) {
    const [x, y] = [0.6 * Math.sin((k % 1536) / 40), 0.6 * Math.cos(Math.floor(k / 1536) / 25)];
    large.data.set([x, y, Math.sqrt(1 - x * x - y * y)].map(c => Math.round(128 + 127 * c)), 3 * k);
  }
  writeFileSync(join(scratch, 'large.png'), encode(large));
  const patches = [1, 2, 3, 4].map(k => `.patches figure:nth-child(${k}) canvas`);
  async function pictures(way) {
    const page = await open();
    if (way !== 'WebGPU') await page.addInitScript(() => Object.defineProperty(Navigator.prototype, 'gpu', { value: undefined }));
    if (way !== 'WebGPU') await page.reload();
    const taken = [];
    for (const [map, places] of [['sample', ['.view canvas', ...patches]], ['large', ['.view canvas']]]) {
      if (map === 'sample') await page.click('#sample-map'); else await drop(page, [join(scratch, 'large.png')]);
      await settled(page);
      await page.waitForFunction(way => document.querySelectorAll(`[data-drawn-with="${way}"] canvas`).length === 5, way);
      for (const place of places) {
        await page.locator(place).scrollIntoViewIfNeeded();
        await page.waitForTimeout(300);
        const path = join(scratch, `page-${way.replace(' ', '')}-${map}-${Math.max(0, patches.indexOf(place) + 1)}.png`);
        taken.push({ name: `${map}: ${place}`, limit: map === 'large' ? 5 : 1, ...decode(await page.locator(place).screenshot({ path })) });
      }
    }
    await page.context().close();
    return taken;
  }
  const [gpu, gl] = [await pictures('WebGPU'), await pictures('WebGL 2')];
  const wrong = gpu.flatMap((a, k) => {
    const b = gl[k];
    if (a.width !== b.width || a.height !== b.height) return [`${a.name}: ${a.width} x ${a.height} and ${b.width} x ${b.height}`];
    let most = 0, several = 0, shown = 0;
    for (let i = 0; i < a.data.length; i += a.channels) {
      const step = Math.max(...[0, 1, 2].map(c => Math.abs(a.data[i + c] - b.data[i + c])));
      most = Math.max(most, step);
      several += step > 1;
      shown += Math.abs(a.data[i] - a.data[0]) > 24;
    }
    const pixels = a.width * a.height, said = `${a.name}: ${most} steps at the most, ${several} of ${pixels} pixels differ by more than one, ${shown} show something`;
    if (process.env.VERBOSE) console.log(said);
    return most <= a.limit && shown > 0.05 * pixels ? [] : [said];
  });
  return wrong.join('\n');
});

await fact('webGlReplacesALostDevice', async () => {
  const page = await open();
  await page.addInitScript(() => {
    const ask = GPUAdapter.prototype.requestDevice;
    GPUAdapter.prototype.requestDevice = async function (...values) { return window.device = await ask.apply(this, values); };
  });
  await page.reload();
  await page.click('#sample-map');
  await settled(page);
  await page.waitForFunction(() => document.querySelectorAll('[data-drawn-with="WebGPU"] canvas').length === 5);
  const before = decode(await page.locator('.view canvas').screenshot());
  await page.evaluate(() => window.device.destroy());
  await page.waitForFunction(() => document.querySelectorAll('[data-drawn-with="WebGL 2"] canvas').length === 5);
  const after = decode(await page.locator('.view canvas').screenshot());
  if (await drawn(page, '.view canvas') < 0.05) return 'the picture is blank';
  let differ = 0;
  for (let k = 0; k < before.data.length; ++k) differ += Math.abs(before.data[k] - after.data[k]) > 4;
  if (differ > 0) return `${differ} numbers of the picture are others afterwards`;
  const box = await page.locator('.view canvas').boundingBox(); // the light still follows
  await page.mouse.move(box.x + box.width * 0.9, box.y + box.height * 0.9);
  const moved = decode(await page.locator('.view canvas').screenshot());
  await page.context().close();
  return Buffer.compare(Buffer.from(moved.data), Buffer.from(after.data)) === 0 ? 'the light stays where it was' : '';
});

await fact('thePatchFollowsKeysAndPointerWithRightDegrees', async () => {
  const page = await open(), figure = k => page.locator('.patches b').nth(k).textContent();
  await page.locator('#why-stretch').focus();
  await page.keyboard.press('Home'); // 0.5 : 1
  await page.locator('#why-shear').evaluate(range => { range.value = 0; range.dispatchEvent(new Event('input')); });
  await page.locator('#why-stretch').evaluate(range => { range.value = 1; range.dispatchEvent(new Event('input')); });
  for (const k of [0, 2, 3]) if (await figure(k) !== '0.00°') return `a square patch gives ${await figure(k)} with picture ${k}`;
  const box = await page.locator('.patch').boundingBox(), middle = [box.x + box.width / 2, box.y + box.height / 2], unit = 105 * box.width / 720;
  await page.mouse.move(middle[0] + unit, middle[1]);
  await page.mouse.down();
  await page.mouse.move(middle[0] + 2 * unit, middle[1], { steps: 4 });
  await page.mouse.up();
  const stretched = Number.parseFloat(await figure(3));
  if (!(stretched > 3)) return `pulled to 2 : 1, tangents at right angles are off by ${stretched} degrees`;
  if (await figure(0) !== '0.00°') return `cotangents are off by ${await figure(0)}`;
  await page.screenshot({ path: join(scratch, 'page-why.png'), fullPage: true });
  await page.context().close();
});

await end();
