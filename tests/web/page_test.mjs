// The web page itself: what it loads, answers to bad files, accessibility, small screens and offline use, in headless
// Chromium, used as a visitor uses it (page_visit.mjs documents the arguments).
import { readFileSync, readdirSync, statSync, writeFileSync } from 'node:fs';
import { basename, join } from 'node:path';
import { address, browser, data, drawn, drop, dropOnly, end, errors, fact, hasData, needsData, open, problem, require,
  scratch, settled, viewed } from './page_visit.mjs';

await fact('firstViewIsBelow200KBWithoutTheLibrary', async () => {
  const context = await browser.newContext({ serviceWorkers: 'block' }), page = await context.newPage();
  const bodies = [];
  page.on('response', response => { if (!response.url().endsWith('.wasm')) bodies.push(response.body().catch(() => '')); });
  await page.goto(address, { waitUntil: 'networkidle' });
  const sum = (await Promise.all(bodies)).reduce((bytes, body) => bytes + body.length, 0);
  await context.close();
  return sum < 20000 ? `only ${sum} bytes came` : sum > 200000 ? `${sum} bytes` : '';
});

await fact('aFailedFileClearsTheOldVerdict', async () => {
  const page = await open();
  await page.click('#sample-map');
  await settled(page);
  writeFileSync(join(scratch, 'broken.glb'), 'glTF, but no model');
  await dropOnly(page, [join(scratch, 'broken.glb')], { keep: true });
  await page.waitForFunction(() => document.getElementById('problem').textContent !== '');
  const left = await page.textContent('#result');
  await page.context().close();
  return left === '' ? '' : `still there: ${left.slice(0, 200)}`;
});

// The policy that the page declares, sent by a server with every file, workers included.
await fact('thePageWorksUnderItsContentSecurityPolicy', async () => {
  const page = await open(), policy = await page.getAttribute('meta[http-equiv="Content-Security-Policy"]', 'content');
  if (!/script-src 'self' 'wasm-unsafe-eval';/.test(policy) || /unsafe-inline|'unsafe-eval'|https?:/.test(policy)) return `states: ${policy}`;
  await page.route('**/*', async route => {
    const answer = await route.fetch();
    await route.fulfill({ response: answer, headers: { ...answer.headers(), 'content-security-policy': policy } });
  });
  await page.reload();
  for (const sample of ['#sample-map', '#sample-model']) {
    await page.click(sample);
    await page.waitForTimeout(200);
    await settled(page);
    if (await problem(page)) return `${sample}: ${await problem(page)}`;
  }
  if (hasData) for (const name of ['jet_fighter_draco_basisu.glb', 'pirate_meshopt.glb']) {
    await drop(page, [join(data, 'compressed', name)]);
    if (await problem(page)) return `${name}: ${await problem(page)}`;
    await viewed(page);
    if (await drawn(page, '.view canvas') < 0.02) return `${name}: the picture is blank`;
  }
  await page.context().close();
});

await fact('libraryLoadFailuresAreReportedEachTime', async () => {
  const page = await open(), before = errors.length;
  await page.route('**/worker.js', route => route.abort());
  await page.reload();
  for (let k = 0; k < 2; ++k) {
    await page.evaluate(() => { document.getElementById('problem').textContent = ''; });
    await page.click('#sample-map');
    await page.waitForFunction(() => document.getElementById('problem').textContent !== '', undefined, { timeout: 10000 });
    if (!/the library could not be loaded/.test(await problem(page))) return `says: ${await problem(page)}`;
  }
  errors.splice(before);
  await page.context().close();
});

// A decoder or the library may be damaged by what it could not read: the next file gets a new worker.
await fact('aFailedDecoderGivesTheNextFileAFreshWorker', async () => {
  const page = await open(), workers = [], before = errors.length;
  page.on('worker', worker => workers.push(worker.url()));
  await page.click('#sample-map');
  await settled(page);
  if (workers.length !== 1) return `${workers.length} workers`;
  // Meshopt data that are none: not an error of the library, but of its decoder.
  const json = { asset: { version: '2.0' }, extensionsUsed: ['EXT_meshopt_compression'], extensionsRequired: ['EXT_meshopt_compression'],
    buffers: [{ byteLength: 64, uri: `data:application/octet-stream;base64,${Buffer.alloc(64, 0xff).toString('base64')}` }, { byteLength: 36, extensions: { EXT_meshopt_compression: { fallback: true } } }],
    bufferViews: [{ buffer: 1, byteLength: 36, byteStride: 12, extensions: { EXT_meshopt_compression: { buffer: 0, byteLength: 64, byteStride: 12, count: 3, mode: 'ATTRIBUTES' } } }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 1] }], meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }], nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }], scene: 0 };
  writeFileSync(join(scratch, 'meshopt.gltf'), JSON.stringify(json));
  await drop(page, [join(scratch, 'meshopt.gltf')]);
  const words = await problem(page);
  if (!/expected geometry that can be decompressed/.test(words)) return `says: ${words}`;
  await page.click('#sample-map');
  await settled(page);
  if (await problem(page)) return `then: ${await problem(page)}`;
  errors.splice(before);
  await page.context().close();
  return workers.length === 2 ? '' : `${workers.length} workers`;
});

await fact('longWorkShowsItsDuration', async () => {
  const page = await open();
  await page.route('**/*.wasm', () => {}); // never answered
  await page.reload();
  await page.click('#sample-map');
  await page.waitForFunction(() => / s so far/.test(document.getElementById('status').textContent), undefined, { timeout: 10000 });
  await page.context().close();
});

await fact('facetsAreExplained', async () => {
  const page = await open(), text = await page.textContent('main');
  await page.context().close();
  return /faceted/.test(text) && /facets/.test(text) && /frame: 'smooth'/.test(text) ? '' : 'neither "faceted" nor "facets" is answered';
});

await fact('badFilesGiveOneLineEach', async () => {
  const page = await open(), wrong = [], walk = folder => readdirSync(folder).flatMap(name => {
    const path = join(folder, name);
    return statSync(path).isDirectory() ? walk(path) : [path];
  });
  const files = walk(join(data, 'bad')).filter(path => /\.(glb|gltf|png)$/.test(path) && statSync(path).size < 1e6), before = errors.length;
  if (files.length < 10) return `only ${files.length} bad files are there`;
  for (const file of files.filter((_, k) => k % Math.ceil(files.length / 12) === 0)) { // all of them would take minutes
    await drop(page, [file]).catch(() => wrong.push(`${basename(file)}: no answer`));
    const words = await problem(page);
    if (/\n/.test(words.trim()) || words.length > 400) wrong.push(`${basename(file)}: ${words.slice(0, 200)}`);
  }
  errors.splice(before, errors.length, ...errors.slice(before).filter(text => !/404|ERR_FAILED|THREE\.|Failed to load|WebGL/.test(text)));
  await page.context().close();
  return wrong.slice(0, 10).join('\n');
}, needsData);

await fact('documentsShowTheirImagesAndTheirLinksWork', async () => {
  const wrong = [], rules = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
  const page = await open();
  const names = await page.evaluate(() => [...document.querySelectorAll('a[href$=".html"]')].map(link => new URL(link.href).pathname.slice(1)));
  if (new Set(names).size < 3) return `the page leads to ${names.join(', ')} only`;
  names.push('mobile.html'); // to which a verdict leads
  for (const name of new Set(names)) {
    const visited = await page.goto(address + name);
    if (!visited.ok()) { wrong.push(`${name}: ${visited.status()}`); continue; }
    wrong.push(...await page.evaluate(async () => {
      const broken = [...document.images].filter(image => image.naturalWidth === 0).map(image => `no picture ${image.src}`);
      for (const { href } of document.querySelectorAll('a[href]')) {
        const { origin, pathname, hash } = new URL(href);
        if (origin !== location.origin) continue;
        const text = pathname === location.pathname ? document : new DOMParser().parseFromString(await (await fetch(pathname)).text(), 'text/html');
        if (hash && !text.getElementById(decodeURIComponent(hash.slice(1)))) broken.push(`${document.title}: no ${href}`);
      }
      return broken;
    }));
    await page.evaluate(rules);
    const { violations } = await page.evaluate(() => axe.run());
    wrong.push(...violations.map(({ id, nodes }) => `${name}: ${id} at ${nodes.map(node => node.target.join(' ')).slice(0, 3).join(', ')}`));
    await page.screenshot({ path: join(scratch, `page-${name.replace('.html', '')}.png`), fullPage: true });
    await page.setViewportSize({ width: 360, height: 740 });
    const width = await page.evaluate(() => document.documentElement.scrollWidth);
    if (width > 360) wrong.push(`${name}: ${width} pixels wide on a phone`);
    await page.setViewportSize({ width: 1280, height: 900 });
  }
  await page.context().close();
  return wrong.join('\n');
});

await fact('accessibilityRulesHoldInLightAndDark', async () => {
  const wrong = [], rules = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
  // Each pair of colours, width and sample.
  for (const [colorScheme, width, sample] of [['light', 360, 'map'], ['light', 1280, 'model'], ['dark', 360, 'model'], ['dark', 1280, 'map']]) {
    const page = await open({ colorScheme, viewport: { width, height: 800 } });
    await page.click(`#sample-${sample}`);
    await settled(page);
    if (sample === 'model') await viewed(page);
    await page.locator('#shader').scrollIntoViewIfNeeded();
    await page.waitForFunction(() => document.querySelector('#shader-panel pre code')?.textContent.length > 500);
    await page.evaluate(() => document.querySelectorAll('details').forEach(one => { one.open = true; }));
    await page.evaluate(rules);
    const { violations } = await page.evaluate(() => axe.run());
    wrong.push(...violations.map(({ id, nodes }) => `${colorScheme}, ${width} pixels, ${sample}: ${id} at ${nodes.map(node => node.target.join(' ')).slice(0, 4).join(', ')}`));
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    if (wide > width) wrong.push(`${width} pixels, ${sample}: ${wide} wide`);
    await page.context().close();
  }
  return wrong.join('\n');
});

await fact('phonesNeedNoSidewaysScrolling', async () => {
  const page = await open({ viewport: { width: 360, height: 740 } });
  await page.click('#sample-map');
  await settled(page);
  await page.locator('#shader').scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.querySelector('#shader-panel pre code')?.textContent.length > 500);
  await page.screenshot({ path: join(scratch, 'page-phone.png'), fullPage: true });
  const width = await page.evaluate(() => document.documentElement.scrollWidth);
  await page.context().close();
  return width > 360 ? `${width} pixels wide` : '';
});

await fact('thePageWorksOfflineAfterTheFirstVisit', async () => {
  const page = await open({ serviceWorkers: 'allow' });
  await page.evaluate(() => navigator.serviceWorker.ready);
  await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
  await page.context().setOffline(true);
  await page.reload();
  await page.click('#sample-map');
  await settled(page);
  const words = await page.textContent('.verdict');
  await page.context().close();
  return /wrong way/.test(words) ? '' : `says: ${words}`;
});

await end();
