// The library as WebAssembly: its memory, calls of include/cotan.h, errors.

import { CotanError, usage, wordsFor } from './errors.js';

export { CotanError, usage, wordsFor };

const kCodes = ['ok', 'usage', 'input', 'unavailable', 'output', 'limit', 'stopped'];
const kMessageBytes = 1024;
const kNoSystem = 52; // ENOSYS of WASI; of other calls any number but 0 is a failure

/** Memory of one call, given back when it ends. */
class Scratch {
  #owned = [];

  constructor(wasm) {
    this.wasm = wasm;
  }

  get buffer() {
    return this.wasm.memory.buffer; // another one whenever it grows
  }

  room(bytes) {
    const at = bytes < 0xffff0000 ? this.wasm.malloc(Math.max(bytes, 16)) >>> 0 : 0;
    if (at === 0) throw new CotanError('unavailable', `not enough memory: ${bytes} bytes more are needed`);
    this.#owned.push(at);
    return at;
  }

  /** A copy of a typed array. */
  put(array) {
    const at = this.room(array.byteLength);
    new Uint8Array(this.buffer, at, array.byteLength)
      .set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    return at;
  }

  /** A text with a zero at its end; undefined and null are a null pointer. */
  text(value, name) {
    if (value === undefined || value === null) return 0;
    if (typeof value !== 'string') throw usage(`${name}: expected a text, found ${wordsFor(value)}`);
    return this.put(new TextEncoder().encode(value + '\0'));
  }

  /** A struct of numbers of 32 bits that begins with its size. */
  struct(...members) {
    return this.put(Uint32Array.of(4 * (members.length + 1), ...members));
  }

  view(Type, at, count) {
    return new Type(this.buffer, at, count);
  }

  /** A copy of what is there now. */
  take(Type, at, count) {
    return this.view(Type, at, count).slice();
  }

  textAt(at, limit = Infinity) {
    const bytes = new Uint8Array(this.buffer, at);
    let end = 0;
    while (end < limit && bytes[end] !== 0) ++end;
    return new TextDecoder().decode(bytes.subarray(0, end));
  }

  /** Calls a function that returns a cotan_status. */
  call(name, ...args) {
    const message = this.room(kMessageBytes);
    const status = this.wasm[name](...args, message, kMessageBytes);
    if (status !== 0) throw new CotanError(kCodes[status] ?? 'unavailable', this.textAt(message, kMessageBytes));
  }

  free() {
    for (const at of this.#owned) this.wasm.free(at);
  }
}

/** The library, once its bytes are there. */
export class Library {
  #module;
  #imports;
  #instance;
  generation = 0; // what is held over calls is gone when it changes

  async load(bytes, imports = {}) {
    const found = await bytes; // an answer of a server is compiled while it arrives
    this.#module = await WebAssembly[found.headers ? 'compileStreaming' : 'compile'](found);
    this.#imports = { ...imports };
    for (const { module, name } of WebAssembly.Module.imports(this.#module)) // of the system: there is none
      (this.#imports[module] ??= {})[name] ??= name === 'proc_exit' ? () => { throw new Error('the library ended'); }
        : name === 'emscripten_notify_memory_growth' ? () => {} : () => kNoSystem;
    await this.#start();
  }

  async #start() {
    this.#instance = await WebAssembly.instantiate(this.#module, this.#imports);
    this.#instance.exports._initialize();
  }

  /** Runs work(scratch). After a trap, such as the end of the memory, there is a new instance. */
  run(work) {
    if (!this.#instance) throw usage('ready: await it before the first call');
    const scratch = new Scratch(this.#instance.exports);
    try {
      const result = work(scratch);
      scratch.free();
      return result;
    } catch (error) {
      if (error instanceof WebAssembly.RuntimeError || error instanceof WebAssembly.Exception) {
        ++this.generation;
        this.#instance = new WebAssembly.Instance(this.#module, this.#imports);
        this.#instance.exports._initialize();
        throw new CotanError('unavailable', `the library stopped: ${error.message}`);
      }
      scratch.free();
      throw error;
    }
  }

  get version() {
    return this.run((s) => s.textAt(s.wasm.cotan_version()));
  }
}
