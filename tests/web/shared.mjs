// Shared by the tests of the npm package. Exit code 77: skipped, with a line that says why.
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

export const here = fileURLToPath(new URL('.', import.meta.url)); // this folder; Node.js 18 has no import.meta.dirname

class Skipped extends Error {}
let running = false;
/** Ends the running case, or the test if none runs. */
export function skip(why) {
  if (running) throw new Skipped(why);
  console.log(`skipped: ${why}`);
  process.exit(77);
}

/** Runs all cases, or the one named `only`. Sets the exit code: 1 if a case fails or none has that name, 77 if all are
 * skipped. */
export async function runCases(cases, only) {
  const names = Object.keys(cases).filter((name) => !only || name === only), count = { holds: 0, skipped: 0, FAILS: 0 };
  running = true;
  for (const name of names) {
    const began = performance.now();
    let found = 'holds', why;
    try {
      await cases[name]();
    } catch (error) {
      [found, why] = error instanceof Skipped ? ['skipped', error.message] : ['FAILS', error.stack ?? error];
    }
    ++count[found];
    console.log(found === 'skipped' ? `skipped: ${why} (${name})` : `${found}: ${name} (${((performance.now() - began) / 1000).toFixed(1)} s) ${why ?? ''}`);
  }
  running = false;
  process.exitCode = count.FAILS > 0 || names.length === 0 ? 1 : count.holds === 0 ? 77 : 0;
}

const left = [];
process.on('exit', () => left.forEach((folder) => fs.rmSync(folder, { recursive: true, force: true, maxRetries: 10, retryDelay: 100 })));

export function emptyFolder() {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), 'cotan-web-'));
  left.push(folder);
  return folder;
}

/** Creates an empty folder and installs the tarball in it as a user does; other packages are linked. */
export function installed(tarball, modules = null, others = []) {
  const folder = emptyFolder();
  fs.writeFileSync(path.join(folder, 'package.json'), '{"private": true, "type": "module"}');
  execFileSync('npm', ['install', '--offline', '--no-audit', '--no-fund', '--legacy-peer-deps', '--silent', tarball], { cwd: folder });
  for (const name of others) {
    const link = path.join(folder, 'node_modules', name);
    fs.mkdirSync(path.dirname(link), { recursive: true });
    fs.symlinkSync(path.join(modules, name), link);
  }
  return folder;
}

export const load = (folder, name = 'cotan') => import(path.join(folder, 'node_modules', 'cotan', `${name}.js`));

/** A grid of side * side * 2 triangles over a hilly surface with sheared uv. */
export function hills(side) {
  const n = side + 1, positions = new Float32Array(n * n * 3), normals = new Float32Array(n * n * 3), uvs = new Float32Array(n * n * 2);
  for (let y = 0; y < n; ++y)
    for (let x = 0; x < n; ++x) {
      const i = y * n + x, u = x / side, v = y / side;
      const dx = 0.7 * Math.cos(7 * u) * Math.cos(5 * v), dy = -0.5 * Math.sin(7 * u) * Math.sin(5 * v), length = Math.hypot(dx, dy, 1);
      positions.set([u, v, 0.1 * Math.sin(7 * u) * Math.cos(5 * v)], 3 * i);
      normals.set([-dx / length, -dy / length, 1 / length], 3 * i);
      uvs.set([u + 0.1 * v, 1 - v], 2 * i);
    }
  const indices = new Uint32Array(side * side * 6);
  for (let y = 0, k = 0; y < side; ++y)
    for (let x = 0; x < side; ++x, k += 6) {
      const a = y * n + x;
      indices.set([a, a + 1, a + n, a + 1, a + n + 1, a + n], k);
    }
  return { positions, normals, uvs, indices };
}

export function filesUnder(folder) {
  return fs.readdirSync(folder, { withFileTypes: true }).flatMap((entry) =>
    entry.isDirectory() ? filesUnder(path.join(folder, entry.name)) : [path.join(folder, entry.name)]);
}

/** Returns the JSON of a .glb and its binary chunk. */
export function parseGlb(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), length = view.getUint32(12, true);
  return {
    json: JSON.parse(new TextDecoder().decode(bytes.subarray(20, 20 + length))),
    bin: bytes.subarray(28 + length),
  };
}
export function imageOf({ json, bin }, image) {
  const view = json.bufferViews[json.images[image].bufferView];
  return bin.subarray(view.byteOffset ?? 0, (view.byteOffset ?? 0) + view.byteLength);
}
