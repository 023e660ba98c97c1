// Times tangents of the npm package against npm meshoptimizer and mikktspace in one run of node, in turn:
// node web-tangents.mjs PACKAGE_FOLDER NODE_MODULES [SIDE] [ROUNDS]; 2 * SIDE^2 triangles.
import { createRequire } from 'node:module';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

import { hills } from '../tests/web/shared.mjs';

const [place, modules, side = '400', rounds = '15'] = process.argv.slice(2);
const cotan = await import(pathToFileURL(path.resolve(place, 'tangents.js')));
const { MeshoptTangents } = await import(pathToFileURL(path.resolve(modules, 'meshoptimizer/index.js')));
const mikktspace = createRequire(path.resolve(modules, 'x.js'))(path.resolve(modules, 'mikktspace'));
await Promise.all([cotan.ready, MeshoptTangents.ready]);

const mesh = hills(Number(side)), { positions, normals, uvs, indices } = mesh;
const loosen = (values, size) => Float32Array.from({ length: indices.length * size }, (_, i) => values[indices[Math.floor(i / size)] * size + i % size]);
const loose = [loosen(positions, 3), loosen(normals, 3), loosen(uvs, 2)];
const ways = {
  'cotan': () => cotan.tangents(mesh),
  'meshoptimizer': () => MeshoptTangents.generateTangents(indices, positions, 3, normals, 3, uvs, 2, []),
  'meshoptimizer Compatible': () => MeshoptTangents.generateTangents(indices, positions, 3, normals, 3, uvs, 2, ['Compatible']),
  'mikktspace': () => mikktspace.generateTangents(...loose),
};
const times = Object.fromEntries(Object.keys(ways).map((name) => [name, []]));
for (let round = 0; round < Number(rounds); ++round)
  for (const [name, work] of Object.entries(ways)) {
    const start = performance.now();
    work();
    times[name].push(performance.now() - start);
  }
for (const [name, list] of Object.entries(times)) {
  list.sort((a, b) => a - b);
  console.log(`${name.padEnd(26)} ${list[0].toFixed(1).padStart(8)} ms best, ${list[list.length >> 1].toFixed(1).padStart(8)} ms median`);
}
