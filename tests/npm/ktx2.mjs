// A KTX2 file as ktx-parse of the npm package three reads it: node ktx2.mjs NODE_MODULES FILE
// Writes FILE.json, and the concatenated levels, the largest first, as FILE.levels.
import fs from 'node:fs';
import path from 'node:path';
import { pathToFileURL } from 'node:url';

const [modules, file] = process.argv.slice(2);
const { read } = await import(pathToFileURL(path.resolve(modules, 'three/examples/jsm/libs/ktx-parse.module.js')));
const k = read(new Uint8Array(fs.readFileSync(file)));
const text = (v) => (v instanceof Uint8Array ? Buffer.from(v).toString() : v);
const found = {
  format: k.vkFormat,
  typeSize: k.typeSize,
  size: [k.pixelWidth, k.pixelHeight, k.pixelDepth],
  layers: k.layerCount,
  faces: k.faceCount,
  packing: k.supercompressionScheme,
  keys: Object.fromEntries(Object.entries(k.keyValue).map(([key, value]) => [key, text(value)])),
  descriptor: k.dataFormatDescriptor,
  levels: k.levels.map((l) => ({
    bytes: l.levelData.byteLength,
    plain: l.uncompressedByteLength,
    from: l.levelData.byteOffset,
  })),
};
const plain = (key, value) => (ArrayBuffer.isView(value) ? Array.from(value) : value);
fs.writeFileSync(file + '.json', JSON.stringify(found, plain));
fs.writeFileSync(file + '.levels', Buffer.concat(k.levels.map((l) => l.levelData)));
