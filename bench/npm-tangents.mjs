// Times npm's mikktspace and meshoptimizer on the mesh that tangents_time wrote:
// node npm-tangents.mjs NODE_MODULES MESH_FILE RUNS
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [modules, file, runs] = process.argv.slice(2);
const base = path.resolve(modules);
const mikktspace = createRequire(path.join(base, 'x.js'))(path.join(base, 'mikktspace'));
const { MeshoptTangents } = await import(pathToFileURL(path.join(base, 'meshoptimizer/index.js')));
await MeshoptTangents.ready;

const bytes = fs.readFileSync(file);
const [vertices, corners] = new Uint32Array(bytes.buffer, bytes.byteOffset, 2);
let at = bytes.byteOffset + 8;
const floats = (n) => { const a = new Float32Array(bytes.buffer.slice(at, at + 4 * n)); at += 4 * n; return a; };
const positions = floats(vertices * 3), normals = floats(vertices * 3), uvs = floats(vertices * 2);
const indices = new Uint32Array(bytes.buffer.slice(at, at + 4 * corners));
const loosen = (values, size) => {
  const out = new Float32Array(corners * size);
  for (let c = 0; c < corners; ++c)
    for (let k = 0; k < size; ++k) out[c * size + k] = values[indices[c] * size + k];
  return out;
};
const loose = [loosen(positions, 3), loosen(normals, 3), loosen(uvs, 2)];

function time(name, generate) {
  const seconds = [];
  let processor = Infinity; // user and system, all threads: the runtime's own little work included
  for (let i = 0; i < Number(runs); ++i) {
    const before = process.cpuUsage();
    const start = process.hrtime.bigint();
    generate();
    seconds.push(Number(process.hrtime.bigint() - start) * 1e-9);
    const used = process.cpuUsage(before);
    processor = Math.min(processor, used.user + used.system);
  }
  seconds.sort((a, b) => a - b);
  const median = seconds[Math.floor(seconds.length / 2)];
  console.log(`${name.padEnd(44)} ${(median * 1e3).toFixed(1).padStart(8)} ms median, ` +
    `${(seconds[0] * 1e3).toFixed(1).padStart(8)} ms best, processor ${(processor * 1e-3).toFixed(1).padStart(8)} ms, ${(corners / 3 / median * 1e-6).toFixed(2).padStart(6)} M triangles/s`);
}

const generate = (flags) => MeshoptTangents.generateTangents(indices, positions, 3, normals, 3, uvs, 2, flags);
time('npm meshoptimizer, indexed', () => generate([]));
time('npm meshoptimizer Compatible, indexed', () => generate(['Compatible']));
time('npm mikktspace, a vertex per corner', () => mikktspace.generateTangents(...loose));
