// lint and convert for models in the worker. Finds referenced files by URI and first unpacks compressed geometry.
import { convert, lint } from 'cotan/beside';
import { besideModel, isGlb } from './files.js';

const kPacked = ['KHR_draco_mesh_compression', 'EXT_meshopt_compression', 'KHR_meshopt_compression'];

export const lintModel = async files => lint(...await given(files));

// unpacked in the result: whether the input had compressed geometry, which the output has uncompressed.
export async function convertModel(files, options) {
  const [model, more] = await given(files), made = await convert(model, { ...more, ...options }), unpacked = model !== files.model.bytes;
  if (unpacked) made.report.bytes.before = files.model.bytes.length + [...files.beside.values()].reduce((sum, bytes) => sum + bytes.length, 0);
  return { ...made, unpacked };
}

// The arguments for the library: [bytes, options].
async function given(files) {
  const { bytes } = files.model, json = jsonOf(bytes), beside = {};
  for (const { uri } of [...json?.buffers ?? [], ...json?.images ?? []]) {
    const found = typeof uri === 'string' && !uri.startsWith('data:') ? besideModel(files, uri) : undefined;
    if (found) beside[uri] = found;
  }
  if (!kPacked.some(name => json?.extensionsUsed?.includes?.(name))) return [bytes, { files: beside }];
  const { unpack } = await import('./unpack.js');
  return [await unpack(files.model, isGlb(bytes) ? null : json, beside), {}];
}

// The JSON of a model; undefined if it cannot be parsed, which the library reports.
function jsonOf(bytes) {
  try {
    const length = isGlb(bytes) ? new DataView(bytes.buffer, bytes.byteOffset).getUint32(12, true) : 0;
    return JSON.parse(new TextDecoder().decode(isGlb(bytes) ? bytes.subarray(20, 20 + length) : bytes));
  } catch {
    return undefined;
  }
}
