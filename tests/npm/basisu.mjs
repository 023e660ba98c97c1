// Files of Basis Universal, written by its encoder and decoded by its transcoder: node basisu.mjs NODE_MODULES FOLDER
// FOLDER/jobs.json: a list of { name, width, height, options }, whose texels are in FOLDER/NAME.raw as RGBA; written as
// FOLDER/NAME.ktx2. Then the largest level of each .ktx2 there is written as .rgba, unless the transcoder refuses it.
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';
import { texelsOf, transcoder } from '../web/basis_transcoder.mjs';

const [modules, folder] = process.argv.slice(2);
const { encodeToKTX2 } = await import(pathToFileURL(path.resolve(modules, 'ktx2-encoder/dist/node/index.js')));
for (const { name, width, height, options } of JSON.parse(fs.readFileSync(path.join(folder, 'jobs.json')))) {
  const data = new Uint8Array(fs.readFileSync(path.join(folder, `${name}.raw`)));
  const made = await encodeToKTX2(data, { isPerceptual: false, isSetKTX2SRGBTransferFunc: false, ...options, imageDecoder: async () => ({ width, height, data }) });
  fs.writeFileSync(path.join(folder, `${name}.ktx2`), made);
}
const made = await transcoder(modules);
for (const file of fs.readdirSync(folder).filter((name) => name.endsWith('.ktx2'))) {
  const found = texelsOf(made, fs.readFileSync(path.join(folder, file)));
  if (found) fs.writeFileSync(path.join(folder, file.replace(/ktx2$/, 'rgba')), found.data);
}
