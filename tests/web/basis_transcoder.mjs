// Binomial's transcoder of Basis Universal, in npm's three. It judges what Cotan decodes.
import fs from 'node:fs';
import path from 'node:path';
import vm from 'node:vm';

/** The folder of the transcoder. */
export const basisFolder = (modules) => path.join(modules, 'three/examples/jsm/libs/basis');

export async function transcoder(modules) {
  const basis = basisFolder(modules);
  const scope = vm.createContext({ module: { exports: {} }, __filename: basis, console, WebAssembly, require: () => ({}), process: {} });
  vm.runInContext(fs.readFileSync(path.join(basis, 'basis_transcoder.js'), 'utf8'), scope);
  const made = await scope.BASIS({ wasmBinary: fs.readFileSync(path.join(basis, 'basis_transcoder.wasm')) });
  made.initializeBasis();
  return made;
}

const rgba32 = 13; // cTFRGBA32

/** { width, height, data } of the largest level of a KTX2 file; null if the transcoder refuses it. */
export function texelsOf({ KTX2File }, bytes) {
  const file = new KTX2File(new Uint8Array(bytes));
  try {
    if (!file.isValid() || !file.startTranscoding()) return null;
    const data = new Uint8Array(file.getImageTranscodedSizeInBytes(0, 0, 0, rgba32));
    return file.transcodeImage(data, 0, 0, 0, rgba32, 0, -1, -1) ? { width: file.getWidth(), height: file.getHeight(), data } : null;
  } finally {
    file.close();
    file.delete();
  }
}
