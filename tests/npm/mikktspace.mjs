// Tangents by three.js, by npm's mikktspace, and by meshoptimizer with its own weights: node mikktspace.mjs NODE_MODULES MESHES OUT
// MESHES: for each mesh the number of corners as uint32, then positions, normals and texcoords of all corners as
// float32.
// OUT: for each mesh the tangents of three.js, then those of mikktspace (zeros if it throws), then those of meshoptimizer,
// four float32 per corner.
import fs from 'node:fs';
import path from 'node:path';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const [modules, file, out] = process.argv.slice(2);
const base = path.resolve(modules);
const mikktspace = createRequire(path.join(base, 'x.js'))(path.join(base, 'mikktspace'));
const three = await import(pathToFileURL(path.join(base, 'three/examples/jsm/libs/mikktspace.module.js')));

const { MeshoptTangents } = await import(pathToFileURL(path.join(base, 'meshoptimizer/meshopt_tangents.js')));
await MeshoptTangents.ready;

const bytes = fs.readFileSync(file);
const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
const written = [];
for (let at = 0; at < buffer.byteLength;) {
  const corners = new Uint32Array(buffer, at, 1)[0];
  at += 4;
  const floats = (n) => { const a = new Float32Array(buffer.slice(at, at + 4 * n)); at += 4 * n; return a; };
  const mesh = [floats(3 * corners), floats(3 * corners), floats(2 * corners)];
  written.push(Buffer.from(three.generateTangents(...mesh).buffer));
  let reference = new Float32Array(4 * corners);
  try { reference = mikktspace.generateTangents(...mesh); } catch { /* zeros */ }
  written.push(Buffer.from(reference.slice().buffer));
  const [positions, normals, texcoords] = mesh;
  written.push(Buffer.from(MeshoptTangents.generateTangents(null, positions, 3, normals, 3, texcoords, 2, []).slice().buffer));
}
fs.writeFileSync(out, Buffer.concat(written));
