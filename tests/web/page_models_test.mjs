// Models on the web page: its verdicts, renders, checks and fixes, in headless Chromium, used as a visitor uses it
// (page_visit.mjs documents the arguments).
import { existsSync, readFileSync, readdirSync, statSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { data, decode, domed, drawn, drop, end, fact, hasData, model, needsData, open, partsOfGlb, problem, run, same,
  saved, scratch, settled, texelsEqual, texture } from './page_visit.mjs';

await fact('modelsAreDrawnTwiceWithTheAngleBetween', async () => {
  const page = await open();
  await page.click('#sample-model');
  await settled(page);
  await page.waitForFunction(() => /differ by [\d.]+°/.test(document.querySelector('.view')?.textContent ?? ''));
  const apartNow = async () => Number(/differ by ([\d.]+)°/.exec(await page.textContent('.view'))[1]);
  if (!(await apartNow() < 0.5)) return `stored tangents and what the page advises are said to be apart by ${await apartNow()} degrees`;
  await page.locator('.view select').nth(1).selectOption('cotangent');
  await page.waitForFunction(() => document.querySelector('.view').dataset.shows === 'tangents cotangent');
  if (!(await apartNow() > 1 && await apartNow() < 30)) return `stored tangents and cotangents on a stretched texture are said to be apart by ${await apartNow()} degrees`;
  if (await drawn(page, '.view canvas') < 0.05) return 'the picture is blank';
  await page.screenshot({ path: join(scratch, 'page-model.png') });
  await page.check('text=Show the angle between them');
  const box = await page.locator('.view canvas').boundingBox();
  await page.mouse.move(box.x + box.width * 0.42, box.y + box.height * 0.5);
  await page.waitForFunction(() => /Under the pointer: [\d.]+°/.test(document.querySelector('.view').textContent));
  await page.screenshot({ path: join(scratch, 'page-angle.png') });
  await page.locator('.view select').nth(0).selectOption('cotangent');
  await page.waitForFunction(() => /differ by 0\.0\d°/.test(document.querySelector('.view').textContent));
  for (const frame of ['triangle', 'orthonormal', 'smooth']) {
    await page.locator('.view select').nth(1).selectOption(frame);
    const at = await page.waitForFunction(frame => document.querySelector('.view').dataset.shows === `cotangent ${frame}`, frame).then(() => page.textContent('.view'));
    const apart = Number(/differ by ([\d.]+)°/.exec(at)[1]), [least, most] = { triangle: [0, 1], orthonormal: [1, 30], smooth: [0, 1] }[frame];
    if (!(apart >= least && apart <= most)) return `cotangent and ${frame} are said to be apart by ${apart} degrees, ${least} to ${most} were expected`;
  }
  await page.context().close();
});

// The page once said "as they are" above "convert" about its own sample.
await fact('theViewShowsTheAdvisedConversion', async () => {
  const page = await open(), wrong = [];
  const cat = join(data, 'models/SketchfabCat'), beside = folder => readdirSync(folder).map(name => join(folder, name)).filter(path => statSync(path).isFile());
  const cases = [['the sample', null, /read as they are, with the frame orthonormal|remade for the frame/, 0.5]];
  if (hasData) cases.push(
    ['BoomBox', beside(join(data, 'models/BoomBox')), /read as they are, with the frame orthonormal/, 0.3],
    ['the cat', [...beside(cat), ...beside(join(cat, 'textures'))], /Green and the stored tangents are both reversed: together they cancel out/, 1],
    ['the chess set', [join(data, 'compressed/chess_board_draco.glb')], /./, 1],
  );
  for (const [name, files, words, most] of cases) {
    if (files) await drop(page, files);
    else await page.click('#sample-model').then(() => settled(page));
    if (await problem(page)) { wrong.push(`${name}: ${await problem(page)}`); continue; }
    await page.waitForFunction(() => /differ by [\d.]+°/.test(document.querySelector('.view')?.textContent ?? ''), undefined, { timeout: 120000 });
    const verdict = await page.textContent('.verdict'), advice = await page.textContent('.verdict + p'), shows = await page.getAttribute('.view', 'data-shows');
    const apart = Number(/differ by ([\d.]+)°/.exec(await page.textContent('.view'))[1]);
    if (process.env.VERBOSE) console.log(`${name}: ${apart} degrees; ${verdict} ${advice}`);
    if (!words.test(verdict)) wrong.push(`${name}: says ${verdict}`);
    const table = Number(/unchanged maps with orthonormal([\d.]+)°/.exec(await page.textContent('#result'))?.[1]); // 15.7 for the cat, whose green its tangents reverse
    if (['the cat', 'BoomBox'].includes(name) && !(table < 2)) wrong.push(`${name}: the table says ${table} degrees with orthonormal`);
    if (/as they are/.test(verdict) === /Convert /.test(advice) && !/reversed|contradict/.test(verdict)) wrong.push(`${name}: says "${verdict}" and "${advice}"`);
    if (shows !== 'tangents auto') wrong.push(`${name}: shows ${shows}`);
    if (!(apart < most)) wrong.push(`${name}: what is advised and what has tangents are apart by ${apart} degrees`);
    if (/SketchfabCat|the cat/.test(name) && !/TANGENT\.w contradicts .* green is flipped/.test(await page.textContent('.view'))) wrong.push(`${name}: does not say that green is flipped`);
    if (name === 'BoomBox' && !/MikkTSpace tangents, generated here/.test(await page.textContent('.view .labels'))) wrong.push(`${name}: is compared with ${await page.textContent('.view .labels')}`);
    await page.screenshot({ path: join(scratch, `page-advised-${name.replace(/\W/g, '')}.png`) });
  }
  await page.context().close();
  return wrong.join('\n');
});

await fact('theCheckAndItsReportMatchTheCommandLine', async () => {
  const page = await open(), wrong = [];
  let shown;
  for (const [file, limit] of [[model('NormalTangentMirrorTest'), 0.001], [model('NormalTangentMirrorTest'), 90], [model('TwoSidedPlane'), 2]]) {
    if (shown !== file) await drop(page, [shown = file]);
    await page.locator('.result input[type=number]').nth(0).fill(String(limit));
    await page.locator('.result input[type=number]').nth(1).fill('5');
    await page.locator('.result input[type=number]').nth(1).blur();
    await page.waitForFunction(() => /The check (passes|fails)/.test(document.querySelector('[data-check]').textContent));
    await page.waitForTimeout(300);
    const words = await page.textContent('[data-check]'), { name, bytes } = await saved(page, () => page.click('text=Download the report (JSON)')), ours = JSON.parse(bytes);
    if (name !== `${basename(file, '.glb')}_lint.json`) wrong.push(`the report is called ${name}`);
    try {
      run('lint', file, '--frame', 'orthonormal', '--limit', String(limit), '--limit-area', '5', '--json', 'lint.json', '--overwrite', '--quiet');
    } catch (error) {
      if (error.status !== 5) throw error;
    }
    const tools = JSON.parse(readFileSync(join(scratch, 'lint.json'), 'utf8')).over_limit;
    if (JSON.stringify(ours.over_limit) !== JSON.stringify(tools)) wrong.push(`${basename(file)}: ${JSON.stringify(ours.over_limit)}\n expected ${JSON.stringify(tools)}`);
    if (/fails/.test(words) !== tools.length > 0) wrong.push(`${basename(file)}: says ${words}`);
    if (ours.limits.limit !== limit || ours.limits.limitArea !== 5 || !(ours.primitives.length > 0)) wrong.push(`${basename(file)}: the report has ${JSON.stringify(ours).slice(0, 200)}`);
  }
  await page.context().close();
  return wrong.join('\n');
}, needsData);

// Such a model was once diagnosed and then saved unchanged.
await fact('aModelWithReversedGreenIsFixed', async () => {
  const page = await open();
  await drop(page, [await domed('green_down.glb', false, [0.3, 0.5, 0.7])]);
  const words = await page.textContent('.verdict'), lines = await page.textContent('[data-paste]');
  if (!/points opposite to what the model says/.test(words)) return `says: ${words} ${await problem(page)}`;
  if (!/untangle\(gltf, \{ convention: 'directx' \}\);[^]*material\.normalScale\.y \*= -1;/.test(lines)) return `is to be pasted: ${lines}`;
  const { name, bytes } = await saved(page, () => page.click('text=Fix green and download'));
  await page.waitForFunction(() => /Green of domes was reversed/.test(document.querySelector('.result').textContent));
  writeFileSync(join(scratch, name), bytes);
  await drop(page, [join(scratch, name)]);
  const again = await page.textContent('.verdict'), plain = await page.textContent('[data-paste]');
  await page.context().close();
  if (/opposite/.test(again)) return `of the fixed model: ${again}`;
  return /^import .*\nuntangle\(gltf\);$/.test(plain) ? '' : `of the fixed model is to be pasted: ${plain}`;
});

// Pure white was once 250 of 255 nearly everywhere.
await fact('whiteSurfacesShowTheirBumps', async () => {
  const page = await open();
  await drop(page, [await domed('white.glb', true, [1, 1, 1])]);
  await page.waitForFunction(() => /differ by [\d.]+°/.test(document.querySelector('.view')?.textContent ?? ''));
  const png = decode(await page.locator('.view canvas').screenshot({ path: join(scratch, 'page-white.png') })), seen = [];
  for (let k = 0; k < png.data.length; k += png.channels) if (Math.abs(png.data[k] - png.data[k + 2]) < 8 && png.data[k] > 60) seen.push(png.data[k]);
  await page.context().close();
  const sorted = seen.sort((a, b) => a - b), [low, high] = [0.1, 0.9].map(part => sorted[Math.floor(part * sorted.length)]), burnt = seen.filter(value => value > 250).length / seen.length;
  return seen.length > 10000 && high - low > 60 && burnt < 0.05 ? '' : `${seen.length} pixels from ${low} to ${high}, ${(100 * burnt).toFixed(0)} % burnt out`;
});

await fact('realModelsAreJudgedAndDrawn', async () => {
  const page = await open(), wrong = [];
  const gltf = join(data, 'models/TwoSidedPlane'), parts = existsSync(gltf) ? readdirSync(gltf).filter(name => /\.(gltf|bin|png|jpg)$/.test(name)).map(name => join(gltf, name)) : [];
  for (const files of [[model('NormalTangentMirrorTest')], parts, ...['chess_board_draco.glb', 'pirate_meshopt.glb'].map(name => [join(data, 'compressed', name)])]) {
    if (files.length === 0 || !existsSync(files[0])) continue;
    await drop(page, files);
    const words = await page.textContent('#result');
    if (!/primitives, normal maps/.test(words)) wrong.push(`${basename(files[0])}: ${words.slice(0, 200)} ${await problem(page)}`);
    else if (await drawn(page, '.view canvas') < 0.01) wrong.push(`${basename(files[0])}: the picture is blank`);
    await page.screenshot({ path: join(scratch, `page-${basename(files[0])}.png`) });
  }
  await page.context().close();
  return wrong.join('\n');
}, needsData);

await fact('convertedModelsEqualThoseOfTheCommandLine', async () => {
  const page = await open(), file = model('NormalTangentMirrorTest');
  await drop(page, [file]);
  await page.locator('.result select').first().selectOption('cotangent');
  const { bytes } = await saved(page, () => page.click('text=Convert and download'));
  run('convert', file, '--to-frame', 'cotangent', '-o', 'tool.glb', '--overwrite', '--quiet');
  const [ours, tools] = [partsOfGlb(bytes), partsOfGlb(readFileSync(join(scratch, 'tool.glb')))];
  await page.context().close();
  const shape = ({ json }) => JSON.stringify({ ...json, buffers: undefined, bufferViews: undefined, asset: { ...json.asset, generator: undefined } });
  if (shape(ours) !== shape(tools)) return `another model: ${shape(ours).slice(0, 600)}\n${shape(tools).slice(0, 600)}`;
  // Images are compared by texels, because the browser compresses PNG differently, and everything else by bytes.
  for (const [k, view] of ours.json.bufferViews.entries()) {
    const [a, b] = [[ours, view], [tools, tools.json.bufferViews[k]]].map(([{ binary }, { byteOffset = 0, byteLength }]) => binary.subarray(byteOffset, byteOffset + byteLength));
    if (same(a, b)) continue;
    if (!ours.json.images.some(image => image.bufferView === k && image.mimeType === 'image/png') || !texelsEqual(decode(a), decode(b))) return `bufferViews[${k}] differs`;
  }
}, needsData);

await fact('ktx2MapsAreReportedWithAdvice', async () => {
  const page = await open();
  await drop(page, [join(data, 'compressed/jet_fighter_draco_basisu.glb')]);
  await page.locator('.result select').first().selectOption('cotangent');
  await saved(page, () => page.click('text=Convert and download'));
  await page.waitForFunction(() => /bytes|KB|MB/.test(document.querySelector('.result').textContent) && !/Converting/.test(document.querySelector('.result').textContent));
  const words = await page.textContent('.result');
  await page.context().close();
  return / is in KTX2 with BasisU.*, which is not supported.*gltf-transform ktxdecompress/.test(words) ? '' : `says: ${words.slice(0, 1500)}`;
}, needsData);

await end();
