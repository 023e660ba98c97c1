// The page in web/ in headless Chromium, tried as a visitor would: node page_test.mjs PAGE NODE_MODULES TOOL DATA [FACT]
// PAGE: the folder of the built page. NODE_MODULES: with playwright-core, axe-core, fast-png. TOOL: cotan. DATA: shared
// data, may be missing. Without a FACT all are tried. Pictures of what is shown are left beside PAGE. Exit code 77 where
// the fact needs what is missing.
import { execFileSync } from 'node:child_process';
import { createServer } from 'node:http';
import { existsSync, mkdirSync, readFileSync, readdirSync, statSync, writeFileSync } from 'node:fs';
import { basename, dirname, extname, join } from 'node:path';
import { createRequire } from 'node:module';

const [root, modules, tool, data, only] = process.argv.slice(2);
if (!existsSync(join(root, 'index.html'))) {
  console.error(`skipped: ${root} was not built`);
  process.exit(77);
}
const require = createRequire(join(modules, 'x.js'));
const { chromium } = require('playwright-core');
const { decode, encode } = await import(join(modules, 'fast-png/lib/index.js'));
const scratch = join(dirname(root), 'page-pictures'), errors = [], hasData = existsSync(join(data, 'textures'));
mkdirSync(scratch, { recursive: true });
let tried = 0, failed = 0, skipped = 0;

const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.wasm': 'application/wasm', '.png': 'image/png', '.svg': 'image/svg+xml' };
const server = createServer((request, response) => {
  const file = join(root, decodeURIComponent(request.url.split('?')[0]).replace(/\/$/, '/index.html'));
  if (!existsSync(file)) { response.writeHead(404).end(); return; }
  response.writeHead(200, { 'content-type': types[extname(file)] ?? 'application/octet-stream' }).end(readFileSync(file));
}).listen(0, '127.0.0.1');
await new Promise(done => server.once('listening', done));
const address = `http://127.0.0.1:${server.address().port}/`;
const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader',
    '--enable-features=Vulkan', '--use-vulkan=swiftshader', '--disable-quic', '--no-first-run', '--disable-background-networking',
    '--disable-component-update', '--disable-sync'],
});

// A dome with domes on it, as a GLB: green up the picture or down, base colour.
async function domed(name, up, colour) {
  const { Document, NodeIO } = await import(join(modules, '@gltf-transform/core/dist/index.js'));
  const document = new Document(), buffer = document.createBuffer(), side = 64, map = { width: side, height: side, depth: 8, channels: 3, data: new Uint8Array(3 * side * side) };
  for (let y = 0; y < side; ++y)
    for (let x = 0; x < side; ++x) {
      const [p, q] = [x, y].map(k => 4 * ((k + 0.5) / side) % 2 - 1), r = Math.hypot(p, q) < 0.8 ? 1 : 0;
      map.data.set([p * r, (up ? -1 : 1) * q * r, Math.sqrt(1 - r * (p * p + q * q))].map(c => Math.round(128 + 127 * c)), 3 * (y * side + x));
    }
  const n = 33, positions = [], uvs = [], indices = [];
  for (let y = 0; y < n; ++y)
    for (let x = 0; x < n; ++x) {
      const u = x / (n - 1), v = y / (n - 1), [a, b] = [(u - 0.5) * 2.2, (0.5 - v) * 2.2], k = y * n + x;
      positions.push(Math.sin(a) * Math.cos(b), Math.sin(b), Math.cos(a) * Math.cos(b));
      uvs.push(u, v);
      if (x < n - 1 && y < n - 1) indices.push(k, k + n, k + 1, k + 1, k + n, k + n + 1);
    }
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const material = document.createMaterial('m').setBaseColorFactor([...colour, 1]).setRoughnessFactor(0.6).setMetallicFactor(0)
    .setNormalTexture(document.createTexture('domes').setImage(encode(map)).setMimeType('image/png'));
  document.createScene().addChild(document.createNode().setMesh(document.createMesh('dome').addPrimitive(document.createPrimitive().setMaterial(material)
    .setIndices(accessor('SCALAR', Uint16Array.from(indices))).setAttribute('POSITION', accessor('VEC3', Float32Array.from(positions)))
    .setAttribute('NORMAL', accessor('VEC3', Float32Array.from(positions))).setAttribute('TEXCOORD_0', accessor('VEC2', Float32Array.from(uvs))))));
  writeFileSync(join(scratch, name), await new NodeIO().writeBinary(document));
  return join(scratch, name);
}

async function open(options = {}, hash = '') {
  const context = await browser.newContext({ viewport: { width: 1280, height: 900 }, acceptDownloads: true, serviceWorkers: 'block', ...options });
  const page = await context.newPage();
  page.setDefaultTimeout(30000);
  page.on('console', message => { if (['error', 'warning'].includes(message.type()) && !/GPU stall|GL Driver|blocked by Playwright/.test(message.text())) errors.push(message.text()); });
  page.on('pageerror', error => errors.push(error.message));
  page.on('request', request => { if (!/^(blob:|data:)/.test(request.url()) && !request.url().startsWith(address)) errors.push(`asked for ${request.url()}`); });
  await page.goto(address + hash);
  return page;
}

// Files dropped onto the page, as bytes by name; waits until the page has said something.
async function drop(page, files) {
  await dropOnly(page, files);
  await settled(page);
}

async function dropOnly(page, files, { keep = false } = {}) {
  const given = files.map(file => [basename(file), readFileSync(file).toString('base64')]);
  await page.evaluate(([given, keep]) => {
    if (!keep) document.getElementById('result').replaceChildren();
    const transfer = new DataTransfer();
    for (const [name, text] of given) transfer.items.add(new File([Uint8Array.from(atob(text), c => c.charCodeAt(0))], name));
    document.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
  }, [given, keep]);
}

const settled = page => page.waitForFunction(() => document.getElementById('status').textContent === ''
  && (document.getElementById('problem').textContent !== '' || document.getElementById('result').childNodes.length > 0), undefined, { timeout: 60000 });
const problem = page => page.textContent('#problem');

async function saved(page, click) {
  const [download] = await Promise.all([page.waitForEvent('download'), click()]);
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

function run(...words) {
  return execFileSync(tool, words, { cwd: scratch, encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });
}

const same = (a, b) => a.length === b.length && Buffer.compare(Buffer.from(a.buffer, a.byteOffset, a.byteLength), Buffer.from(b.buffer, b.byteOffset, b.byteLength)) === 0;
// Alpha that says nothing may be left out.
function texelsEqual(a, b) {
  if (a.width !== b.width || a.height !== b.height || a.depth !== b.depth) return false;
  const most = 2 ** a.depth - 1, at = ({ data, channels }, k, c) => c < channels ? data[k * channels + c] : most;
  for (let k = 0; k < a.width * a.height; ++k)
    for (let c = 0; c < 4; ++c) if (at(a, k, c) !== at(b, k, c)) return false;
  return true;
}

function partsOfGlb(bytes) {
  const length = bytes.readUInt32LE(12);
  return { json: JSON.parse(bytes.subarray(20, 20 + length)), binary: bytes.subarray(28 + length) };
}

// How many pixels of an element's picture differ from its first.
async function drawn(page, selector) {
  const png = decode(await page.locator(selector).screenshot());
  let count = 0;
  for (let k = 0; k < png.data.length; k += png.channels) if (Math.abs(png.data[k] - png.data[0]) + Math.abs(png.data[k + 1] - png.data[1]) > 24) ++count;
  return count / (png.width * png.height);
}

async function fact(name, check, { needsData = false } = {}) {
  if (only !== undefined && name !== only) return;
  if (needsData && !hasData) {
    console.error(`skipped ${name}: ${data} is not there`);
    ++skipped;
    return;
  }
  const before = errors.length, began = Date.now();
  let problem;
  try {
    problem = await check();
  } catch (error) {
    problem = error.message;
  }
  if (!problem && errors.length > before) problem = `the console says: ${errors.slice(before).join('; ')}`;
  ++tried;
  if (problem) ++failed;
  console.error(`${problem ? 'FAILS' : 'holds'} ${name} (${((Date.now() - began) / 1000).toFixed(1)} s) ${(problem ?? '').slice(0, 3000)}`);
}

const needsData = { needsData: true };
const texture = name => join(data, 'textures', name), model = name => join(data, 'models', name, `${name}.glb`);

await fact('firstViewIsBelow200KBWithoutTheLibrary', async () => {
  const context = await browser.newContext({ serviceWorkers: 'block' }), page = await context.newPage();
  const bodies = [];
  page.on('response', response => { if (!response.url().endsWith('.wasm')) bodies.push(response.body().catch(() => '')); });
  await page.goto(address, { waitUntil: 'networkidle' });
  const sum = (await Promise.all(bodies)).reduce((bytes, body) => bytes + body.length, 0);
  await context.close();
  return sum < 20000 ? `only ${sum} bytes came` : sum > 200000 ? `${sum} bytes` : '';
});

await fact('aMapWithGreenTurnedIsSaidToBeAndMended', async () => {
  const page = await open();
  await page.click('#sample-map');
  await settled(page);
  const words = await page.textContent('.verdict');
  if (!/wrong way for glTF/.test(words)) return `says: ${words} ${await problem(page)}`;
  if (await drawn(page, '.view canvas') < 0.05) return 'the picture is blank';
  const { name, bytes } = await saved(page, () => page.click('text=Download the mended map'));
  await drop(page, [join(scratch, writeFileSync(join(scratch, name), bytes) ?? name)]);
  await page.screenshot({ path: join(scratch, 'page-map.png') });
  const again = await page.textContent('.result');
  await page.context().close();
  return /Green points up/.test(again) ? '' : `the mended map is said to be: ${again}`;
});

await fact('verdictsOnPublishedMapsAreTheirs', async () => {
  const page = await open(), wrong = [];
  for (const line of readFileSync(texture('CONVENTIONS.tsv'), 'utf8').trim().split('\n').slice(1)) {
    const [file, way] = line.split('\t');
    await drop(page, [texture(file)]);
    const words = await page.textContent('#result');
    const wanted = way.startsWith('+Y') ? /Green points up/ : way.startsWith('-Y') ? /Green points down/ : /cannot be told/;
    if (!wanted.test(words)) wrong.push(`${file}: ${words.slice(0, 150)} ${await problem(page)}`);
  }
  await page.context().close();
  return wrong.join('\n');
}, needsData);

await fact('aMendedMapHasTheTexelsThatTheCommandLineWrites', async () => {
  const page = await open(), wrong = [];
  for (const file of ['scratched_gold_normal_dx.png', 'noise16_normal_gl.png']) {
    await drop(page, [texture(file)]);
    const { bytes } = await saved(page, () => page.click('text=Download the mended map'));
    const [, words] = /--from (\S+ --to \S+)/.exec(await page.textContent('.result code')), [from, , to] = words.split(' ');
    run('map', 'convert', texture(file), '--from', from, '--to', to, '-o', 'tool.png', '--overwrite', '--quiet');
    const [ours, tools] = [decode(bytes), decode(readFileSync(join(scratch, 'tool.png')))];
    if (!texelsEqual(ours, tools)) wrong.push(`${file}: ${ours.width} x ${ours.height} x ${ours.channels} of ${ours.depth} bits differ from ${tools.width} x ${tools.height} x ${tools.channels} of ${tools.depth}`);
  }
  await page.context().close();
  return wrong.join('\n');
}, needsData);

await fact('aModelIsDrawnTwiceAndTheAngleBetweenIsSaid', async () => {
  const page = await open();
  await page.click('#sample-model');
  await settled(page);
  await page.waitForFunction(() => /apart by [\d.]+°/.test(document.querySelector('.view')?.textContent ?? ''));
  const apartNow = async () => Number(/apart by ([\d.]+)°/.exec(await page.textContent('.view'))[1]);
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
  await page.waitForFunction(() => /apart by 0\.0\d°/.test(document.querySelector('.view').textContent));
  for (const frame of ['triangle', 'orthonormal', 'smooth']) {
    await page.locator('.view select').nth(1).selectOption(frame);
    const at = await page.waitForFunction(frame => document.querySelector('.view').dataset.shows === `cotangent ${frame}`, frame).then(() => page.textContent('.view'));
    const apart = Number(/apart by ([\d.]+)°/.exec(at)[1]), [least, most] = { triangle: [0, 1], orthonormal: [1, 30], smooth: [0, 1] }[frame];
    if (!(apart >= least && apart <= most)) return `cotangent and ${frame} are said to be apart by ${apart} degrees, ${least} to ${most} were expected`;
  }
  await page.context().close();
});

// "As they are" above "convert" is what the page said of its own sample.
await fact('whatThePageAdvisesIsWhatItShowsAndSaysOnce', async () => {
  const page = await open(), wrong = [];
  const cat = join(data, 'models/SketchfabCat'), beside = folder => readdirSync(folder).map(name => join(folder, name)).filter(path => statSync(path).isFile());
  const cases = [['the sample', null, /read as they are, with the frame orthonormal|made anew for the frame/, 0.5]];
  if (hasData) cases.push(
    ['BoomBox', beside(join(data, 'models/BoomBox')), /read as they are, with the frame orthonormal/, 0.3],
    ['the cat', [...beside(cat), ...beside(join(cat, 'textures'))], /Green and the stored tangents are both reversed: together they are right/, 1],
    ['the chess set', [join(data, 'compressed/chess_board_draco.glb')], /./, 1],
  );
  for (const [name, files, words, most] of cases) {
    if (files) await drop(page, files);
    else await page.click('#sample-model').then(() => settled(page));
    if (await problem(page)) { wrong.push(`${name}: ${await problem(page)}`); continue; }
    await page.waitForFunction(() => /apart by [\d.]+°/.test(document.querySelector('.view')?.textContent ?? ''), undefined, { timeout: 120000 });
    const verdict = await page.textContent('.verdict'), advice = await page.textContent('.verdict + p'), shows = await page.getAttribute('.view', 'data-shows');
    const apart = Number(/apart by ([\d.]+)°/.exec(await page.textContent('.view'))[1]);
    if (process.env.VERBOSE) console.log(`${name}: ${apart} degrees; ${verdict} ${advice}`);
    if (!words.test(verdict)) wrong.push(`${name}: says ${verdict}`);
    const table = Number(/read by orthonormal: off by([\d.]+)°/.exec(await page.textContent('#result'))?.[1]); // 15.7 for the cat, whose green its tangents reverse
    if (['the cat', 'BoomBox'].includes(name) && !(table < 2)) wrong.push(`${name}: the table says ${table} degrees with orthonormal`);
    if (/as they are/.test(verdict) === /Convert /.test(advice) && !/reversed|contradict/.test(verdict)) wrong.push(`${name}: says "${verdict}" and "${advice}"`);
    if (shows !== 'tangents auto') wrong.push(`${name}: shows ${shows}`);
    if (!(apart < most)) wrong.push(`${name}: what is advised and what has tangents are apart by ${apart} degrees`);
    if (/SketchfabCat|the cat/.test(name) && !/TANGENT\.w contradicts .* green is read the other way/.test(await page.textContent('.view'))) wrong.push(`${name}: does not say that green is read the other way`);
    if (name === 'BoomBox' && !/MikkTSpace tangents, made here/.test(await page.textContent('.view .labels'))) wrong.push(`${name}: is compared with ${await page.textContent('.view .labels')}`);
    await page.screenshot({ path: join(scratch, `page-advised-${name.replace(/\W/g, '')}.png`) });
  }
  await page.context().close();
  return wrong.join('\n');
});

await fact('theCheckIsTheCommandLinesWithItsReportAsAFile', async () => {
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
    const tools = JSON.parse(readFileSync(join(scratch, 'lint.json'), 'utf8')).over_limit.map(({ text }) => text);
    if (JSON.stringify(ours.over_limit) !== JSON.stringify(tools)) wrong.push(`${basename(file)}: ${ours.over_limit.join('; ')}\n expected ${tools.join('; ')}`);
    if (/fails/.test(words) !== tools.length > 0) wrong.push(`${basename(file)}: says ${words}`);
    if (ours.limits.limit !== limit || ours.limits.limitArea !== 5 || !(ours.primitives.length > 0)) wrong.push(`${basename(file)}: the report has ${JSON.stringify(ours).slice(0, 200)}`);
  }
  await page.context().close();
  return wrong.join('\n');
}, needsData);

// It was diagnosed and saved as it was.
await fact('aModelWithGreenReversedIsMended', async () => {
  const page = await open();
  await drop(page, [await domed('green_down.glb', false, [0.3, 0.5, 0.7])]);
  const words = await page.textContent('.verdict'), lines = await page.textContent('[data-paste]');
  if (!/points the other way than the model says/.test(words)) return `says: ${words} ${await problem(page)}`;
  if (!/untangle\(gltf, \{ convention: 'directx' \}\);[^]*material\.normalScale\.y \*= -1;/.test(lines)) return `is to be pasted: ${lines}`;
  const { name, bytes } = await saved(page, () => page.click('text=Mend green and download'));
  await page.waitForFunction(() => /Green of domes is turned/.test(document.querySelector('.result').textContent));
  writeFileSync(join(scratch, name), bytes);
  await drop(page, [join(scratch, name)]);
  const again = await page.textContent('.verdict'), plain = await page.textContent('[data-paste]');
  await page.context().close();
  if (/the other way/.test(again)) return `of the mended model: ${again}`;
  return /^import .*\nuntangle\(gltf\);$/.test(plain) ? '' : `of the mended model is to be pasted: ${plain}`;
});

await fact('anOldVerdictGoesWhenANewFileFails', async () => {
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

// Pure white was 250 of 255 nearly everywhere.
await fact('whiteKeepsItsBumps', async () => {
  const page = await open();
  await drop(page, [await domed('white.glb', true, [1, 1, 1])]);
  await page.waitForFunction(() => /apart by [\d.]+°/.test(document.querySelector('.view')?.textContent ?? ''));
  const png = decode(await page.locator('.view canvas').screenshot({ path: join(scratch, 'page-white.png') })), seen = [];
  for (let k = 0; k < png.data.length; k += png.channels) if (Math.abs(png.data[k] - png.data[k + 2]) < 8 && png.data[k] > 60) seen.push(png.data[k]);
  await page.context().close();
  const sorted = seen.sort((a, b) => a - b), [low, high] = [0.1, 0.9].map(part => sorted[Math.floor(part * sorted.length)]), burnt = seen.filter(value => value > 250).length / seen.length;
  return seen.length > 10000 && high - low > 60 && burnt < 0.05 ? '' : `${seen.length} pixels from ${low} to ${high}, ${(100 * burnt).toFixed(0)} % burnt out`;
});

// The policy that the page states, sent by a server for every file, threads among them.
await fact('itWorksUnderTheContentSecurityPolicyThatItStates', async () => {
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
    if (await drawn(page, '.view canvas') < 0.02) return `${name}: the picture is blank`;
  }
  await page.context().close();
});

await fact('aLibraryThatDoesNotLoadIsSaidEachTime', async () => {
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

await fact('whatTakesLongSaysSo', async () => {
  const page = await open();
  await page.route('**/*.wasm', () => {}); // never answered
  await page.reload();
  await page.click('#sample-map');
  await page.waitForFunction(() => / s so far/.test(document.getElementById('status').textContent), undefined, { timeout: 10000 });
  await page.context().close();
});

await fact('facetsAreAnswered', async () => {
  const page = await open(), text = await page.textContent('main');
  await page.context().close();
  return /faceted/.test(text) && /facets/.test(text) && /frame: 'smooth'/.test(text) ? '' : 'neither "faceted" nor "facets" is answered';
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

await fact('aConvertedModelIsTheOneThatTheCommandLineWrites', async () => {
  const page = await open(), file = model('NormalTangentMirrorTest');
  await drop(page, [file]);
  await page.locator('.result select').first().selectOption('cotangent');
  const { bytes } = await saved(page, () => page.click('text=Convert and download'));
  run('convert', file, '--to-frame', 'cotangent', '-o', 'tool.glb', '--overwrite', '--quiet');
  const [ours, tools] = [partsOfGlb(bytes), partsOfGlb(readFileSync(join(scratch, 'tool.glb')))];
  await page.context().close();
  const shape = ({ json }) => JSON.stringify({ ...json, buffers: undefined, bufferViews: undefined, asset: { ...json.asset, generator: undefined } });
  if (shape(ours) !== shape(tools)) return `another model: ${shape(ours).slice(0, 600)}\n${shape(tools).slice(0, 600)}`;
  // Pictures by their texels, since the browser packs PNGs another way; all else by its bytes.
  for (const [k, view] of ours.json.bufferViews.entries()) {
    const [a, b] = [[ours, view], [tools, tools.json.bufferViews[k]]].map(([{ binary }, { byteOffset = 0, byteLength }]) => binary.subarray(byteOffset, byteOffset + byteLength));
    if (same(a, b)) continue;
    if (!ours.json.images.some(image => image.bufferView === k && image.mimeType === 'image/png') || !texelsEqual(decode(a), decode(b))) return `bufferViews[${k}] differs`;
  }
}, needsData);

await fact('mapsInKtx2AreNamedWithWhatToDo', async () => {
  const page = await open();
  await drop(page, [join(data, 'compressed/jet_fighter_draco_basisu.glb')]);
  await page.locator('.result select').first().selectOption('cotangent');
  await saved(page, () => page.click('text=Convert and download'));
  await page.waitForFunction(() => /bytes|KB|MB/.test(document.querySelector('.result').textContent) && !/Converting/.test(document.querySelector('.result').textContent));
  const words = await page.textContent('.result');
  await page.context().close();
  return / is in KTX2 with BasisU.*, which is not read here.*gltf-transform ktxdecompress/.test(words) ? '' : `says: ${words.slice(0, 1500)}`;
}, needsData);

await fact('badFilesAreAnsweredInOneLineEach', async () => {
  const page = await open(), wrong = [], walk = folder => readdirSync(folder).flatMap(name => {
    const path = join(folder, name);
    return statSync(path).isDirectory() ? walk(path) : [path];
  });
  const files = walk(join(data, 'bad')).filter(path => /\.(glb|gltf|png)$/.test(path) && statSync(path).size < 1e6), before = errors.length;
  if (files.length < 10) return `only ${files.length} bad files are there`;
  for (const file of files.filter((_, k) => k % Math.ceil(files.length / 12) === 0)) { // all of them take minutes
    await drop(page, [file]).catch(() => wrong.push(`${basename(file)}: no answer`));
    const words = await problem(page);
    if (/\n/.test(words.trim()) || words.length > 400) wrong.push(`${basename(file)}: ${words.slice(0, 200)}`);
  }
  errors.splice(before, errors.length, ...errors.slice(before).filter(text => !/404|ERR_FAILED|THREE\.|Failed to load|WebGL/.test(text)));
  await page.context().close();
  return wrong.slice(0, 10).join('\n');
}, needsData);

await fact('theShaderIsTheCommandLinesAndTheAddressKeepsTheChoice', async () => {
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

await fact('theShaderOfTheFrameTriangleIsGivenByStage', async () => {
  for (const stage of ['fragment', 'mesh']) {
    const page = await open({}, `#shader?lang=wgsl&frame=triangle&map=gltf&stage=${stage}`);
    await page.waitForFunction(() => document.querySelector('#shader-panel pre code')?.textContent.length > 500 || document.querySelector('#shader-panel [role=status]')?.textContent);
    const text = await page.textContent('#shader-panel pre code'), tools = run('shader', '--lang', 'wgsl', '--frame', 'triangle', '--stage', stage, '--preset', 'gltf');
    if (text.trim() !== tools.trim()) return `the text for ${stage} differs from the tool's: ${text.slice(0, 200)} ${await page.textContent('#shader-panel [role=status]')}`;
    await page.context().close();
  }
});

// One thing drawn both ways. SwiftShader rasterises and samples for both, so what differs is how numbers are rounded: by one step of
// 8 bits. A map that is larger than the canvas is seen through its levels, whose texels are rounded too: there a step of a texel is up to
// 0.45 degrees, which the highlight, a power of 40, makes five steps of.
await fact('webGpuAndWebGlDrawTheSamePictures', async () => {
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

await fact('aLostDeviceLeavesThePicturesToWebGl', async () => {
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

await fact('thePatchAnswersKeysAndPointerWithRightDegrees', async () => {
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

await fact('documentsShowTheirPicturesAndTheirLinksLead', async () => {
  const wrong = [], rules = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
  const page = await open();
  const names = await page.evaluate(() => [...document.querySelectorAll('a[href$=".html"]')].map(link => new URL(link.href).pathname.slice(1)));
  if (new Set(names).size < 3) return `the page leads to ${names.join(', ')} only`;
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
  for (const colorScheme of ['light', 'dark'])
    for (const width of [360, 1280])
      for (const sample of ['#sample-map', '#sample-model']) {
        const page = await open({ colorScheme, viewport: { width, height: 800 } });
        await page.click(sample);
        await settled(page);
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

await fact('aPhoneShowsAllWithoutScrollingSideways', async () => {
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

await fact('itWorksWithoutANetworkOnceItWasSeen', async () => {
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

await browser.close();
server.close();
if (tried + skipped === 0) console.error(`there is no fact ${only}`);
process.exit(failed > 0 || tried + skipped === 0 ? 1 : tried === 0 ? 77 : 0);
