// lint and convert for models in the worker. Finds referenced files by URI and first unpacks compressed geometry.
import { convert, CotanError, lint } from 'cotan/beside';
import { besideModel, isGlb } from './files.js';

const kPacked = ['KHR_draco_mesh_compression', 'EXT_meshopt_compression', 'KHR_meshopt_compression'];

export async function lintModel(files, options) {
  try {
    const [model, more] = await given(files);
    return await lint(model, { ...more, ...options });
  } catch (error) {
    const missing = urisOf(jsonOf(files.model.bytes)).filter(uri => !besideModel(files, uri));
    if (!/there is no such file beside the model/.test(error.message) || missing.length === 0) throw error;
    throw new CotanError('input', `${files.model.name}: expected ${missing.join(', ')} beside it, found nothing: drop all files together, or a zip of them`);
  }
}

// unpacked in the result: whether the input had compressed geometry, which the output has uncompressed.
export async function convertModel(files, options) {
  const [model, more] = await given(files), made = await convert(model, { ...more, ...options }), unpacked = model !== files.model.bytes;
  if (unpacked) made.report.bytes.before = files.model.bytes.length + [...files.beside.values()].reduce((sum, bytes) => sum + bytes.length, 0);
  return { ...made, unpacked };
}

// The arguments for the library: [bytes, options].
async function given(files) {
  const { bytes } = files.model, json = jsonOf(bytes), beside = {};
  for (const uri of urisOf(json)) {
    const found = besideModel(files, uri);
    if (found) beside[uri] = found;
  }
  if (!kPacked.some(name => json?.extensionsUsed?.includes?.(name))) return [bytes, { files: beside }];
  const { unpack } = await import('./unpack.js');
  return [await unpack(files.model, isGlb(bytes) ? null : json, beside), {}];
}

// The files that a model references.
const urisOf = json => [json?.buffers, json?.images].flatMap(list => (Array.isArray(list) ? list : [])).map(one => one?.uri).filter(uri => typeof uri === 'string' && !uri.startsWith('data:'));

// The JSON of a model; undefined if it cannot be parsed, which the library reports.
function jsonOf(bytes) {
  try {
    const length = isGlb(bytes) ? new DataView(bytes.buffer, bytes.byteOffset).getUint32(12, true) : 0;
    return JSON.parse(new TextDecoder().decode(isGlb(bytes) ? bytes.subarray(20, 20 + length) : bytes));
  } catch {
    return undefined;
  }
}
