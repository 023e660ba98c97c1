// How long untangle() of cotan/three takes to decide about a mesh of 100,352 triangles, in Chromium:
//   node bench/three-choice.mjs NODE_MODULES
// For each case and run: milliseconds of processor time of the page's thread, and what was decided. The first run of a case is
// the first in a new browser. The last case also makes the tangents. NODE_MODULES: with three and playwright-core.
import path from 'node:path';
import { fileURLToPath } from 'node:url';

const home = fileURLToPath(new URL('..', import.meta.url)), modules = process.argv[2] && path.resolve(process.argv[2]);
if (!modules) {
  console.error('usage: node bench/three-choice.mjs NODE_MODULES');
  process.exit(1);
}
const { launch, serve } = await import(path.join(home, 'tests/web/chromium.mjs'));
const { address, close } = await serve({ package: path.join(home, 'bindings/js'), modules });
const kCases = [['stored tangents', {}, true], ['no tangents', {}, false], ['stored tangents, four candidates', { maxDegrees: 0.005 }, true], ['no tangents, four candidates', { maxDegrees: 0.005 }, false]];

async function measured(options, stored) {
  const browser = await launch(modules), page = await browser.newPage(), devtools = await page.context().newCDPSession(page);
  await page.route(address, route => route.fulfill({ contentType: 'text/html', body: '<!doctype html><script type="importmap">{"imports": {"three": "/modules/three/build/three.module.js"}}</script>' }));
  await page.goto(address);
  await devtools.send('Performance.enable', { timeDomain: 'threadTicks' });
  await page.exposeFunction('threadTime', async () => (await devtools.send('Performance.getMetrics')).metrics.find(({ name }) => name === 'ThreadTime').value);
  const runs = await page.evaluate(runCase, [options, stored]);
  await browser.close();
  return runs;
}

// In the browser.
async function runCase([options, stored]) {
  const THREE = await import('three'), { untangle } = await import('/package/three/index.js');
  const grid = () => {
    const geometry = new THREE.PlaneGeometry(1, 1, 224, 224), { position, normal } = geometry.attributes;
    for (let k = 0; k < position.count; ++k) {
      const u = position.getX(k), v = position.getY(k), dx = 0.7 * Math.cos(7 * u) * Math.cos(5 * v), dy = -0.5 * Math.sin(7 * u) * Math.sin(5 * v), length = Math.hypot(dx, dy, 1);
      position.setZ(k, 0.1 * Math.sin(7 * u) * Math.cos(5 * v));
      normal.setXYZ(k, -dx / length, -dy / length, 1 / length);
    }
    return new THREE.BufferGeometry().copy(geometry); // three's own shapes are no models
  };
  // dP/du of the grid as floats, without code of the package, which stays cold.
  const tangentsOf = ({ attributes: { position, normal } }) => {
    const made = new THREE.BufferAttribute(new Float32Array(4 * position.count), 4), t = new THREE.Vector3(), n = new THREE.Vector3();
    for (let k = 0; k < position.count; ++k) {
      const u = position.getX(k), v = position.getY(k);
      n.fromBufferAttribute(normal, k);
      t.set(1, 0, 0.7 * Math.cos(7 * u) * Math.cos(5 * v)).addScaledVector(n, -t.dot(n)).normalize();
      made.setXYZW(k, t.x, t.y, t.z, -1);
    }
    return made;
  };
  const canvas = new OffscreenCanvas(2048, 2048), context = canvas.getContext('2d');
  for (let k = 0; k < 2048; ++k) {
    context.fillStyle = `rgb(${Math.round(128 + 60 * Math.sin(k / 9))}, ${Math.round(128 + 40 * Math.cos(k / 13))}, 240)`;
    context.fillRect(k, 0, 1, 2048);
  }
  const image = await createImageBitmap(canvas), runs = [];
  const map = () => Object.assign(new THREE.Texture(image), { userData: { mimeType: 'image/png' }, flipY: false });
  for (let run = 0; run < 6; ++run) {
    const geometry = grid(), mesh = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ normalMap: map() }));
    if (stored) geometry.setAttribute('tangent', tangentsOf(geometry));
    const before = await window.threadTime(), [{ frame, reason }] = untangle(mesh, { note() {}, ...options });
    runs.push(`${Math.round(1000 * (await window.threadTime() - before))} ms, ${frame} ${reason}`);
  }
  return runs;
}

for (const [name, options, stored] of kCases) console.log(`${name}: ${(await measured(options, stored)).join('; ')}`);
close();
