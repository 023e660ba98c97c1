// Loads the WebAssembly module from the file beside it, in a browser, a worker or node.
import { CotanError } from './errors.js';
import { builtin } from './node.js';

export async function bytesAt(url) {
  const wrong = (found) => new CotanError('unavailable', `${url}: expected the package's wasm file, found ${found}. The entry point without /beside embeds it`);
  const files = url.protocol === 'file:' && await builtin('fs');
  if (files) return files.promises.readFile(url).catch((error) => { throw wrong(error.code); });
  const answer = await fetch(url).catch((error) => { throw wrong(error.message); });
  const kind = answer.ok ? answer.headers.get('content-type') : answer.status;
  if (kind === 'application/wasm') return answer;
  const bytes = await answer.arrayBuffer();
  if (!answer.ok || new Uint8Array(bytes)[1] !== 0x61) throw wrong(kind); // "\0asm"
  return bytes;
}
