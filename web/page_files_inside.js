// The same as page_files.js, with the files inside of the bundle.
import { files } from 'files-inside'; // bytes by name; web/build.mjs lists them

const addresses = new Map(), kTypes = { js: 'text/javascript', wasm: 'application/wasm' };

export function fileAddress(name) {
  if (!addresses.has(name)) addresses.set(name, URL.createObjectURL(new Blob([files[name]], { type: kTypes[name.split('.').at(-1)] })));
  return addresses.get(name);
}

export const startWorker = () => new Worker(fileAddress('worker.js')); // browsers start no modules there
