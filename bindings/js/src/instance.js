// The WebAssembly library: its memory, calls of the functions of include/cotan.h, errors.

import { CotanError, usage, wordsFor } from './errors.js';

export { CotanError, usage, wordsFor };

const kCodes = ['ok', 'usage', 'input', 'unavailable', 'output', 'limit', 'stopped'];
const kMessageBytes = 1024;
const kNoSystem = 52; // ENOSYS of WASI; for functions outside WASI any number but 0 means failure

/** Memory that is allocated for one call and freed when it ends. */
class Scratch {
  #owned = [];

  constructor(wasm) {
    this.wasm = wasm;
  }

  get buffer() {
    return this.wasm.memory.buffer; // replaced whenever the memory grows
  }

  allocate(bytes) {
    const at = bytes < 0xffff0000 ? this.wasm.malloc(Math.max(bytes, 16)) >>> 0 : 0;
    if (at === 0) throw new CotanError('unavailable', `not enough memory: ${bytes} bytes more are needed`);
    this.#owned.push(at);
    return at;
  }

  /** Copies a typed array to library memory and returns its address. */
  put(array) {
    const at = this.allocate(array.byteLength);
    new Uint8Array(this.buffer, at, array.byteLength)
      .set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength));
    return at;
  }

  /** Copies a string as zero-terminated UTF-8 and returns its address; 0 for undefined and null. */
  text(value, name) {
    if (value === undefined || value === null) return 0;
    if (typeof value !== 'string') throw usage(`${name}: expected a string, found ${wordsFor(value)}`);
    return this.put(new TextEncoder().encode(value + '\0'));
  }

  /** Address of a new struct of 32-bit members, which begins with its size in bytes. */
  struct(...members) {
    return this.put(Uint32Array.of(4 * (members.length + 1), ...members));
  }

  view(Type, at, count) {
    return new Type(this.buffer, at, count);
  }

  /** Copies count elements out of library memory. */
  take(Type, at, count) {
    return this.view(Type, at, count).slice();
  }

  textAt(at, limit = Infinity) {
    const bytes = new Uint8Array(this.buffer, at);
    let end = 0;
    while (end < limit && bytes[end] !== 0) ++end;
    return new TextDecoder().decode(bytes.subarray(0, end));
  }

  /** Calls a function that returns a cotan_status; throws its message unless the status is 0. */
  call(name, ...args) {
    const message = this.allocate(kMessageBytes);
    const status = this.wasm[name](...args, message, kMessageBytes);
    if (status !== 0) throw new CotanError(kCodes[status] ?? 'unavailable', this.textAt(message, kMessageBytes));
  }

  free() {
    for (const at of this.#owned) this.wasm.free(at);
  }
}

/** The library; usable after load(). */
export class Library {
  #module;
  #imports;
  #instance;
  generation = 0; // incremented when a new instance replaces the old one, whose addresses become invalid

  async load(bytes, imports = {}) {
    const found = await bytes; // a Response is compiled while it downloads
    this.#module = await WebAssembly[found.headers ? 'compileStreaming' : 'compile'](found);
    this.#imports = { ...imports };
    for (const { module, name } of WebAssembly.Module.imports(this.#module)) // stubs for system calls
      (this.#imports[module] ??= {})[name] ??= name === 'proc_exit' ? () => { throw new Error('the library exited'); }
        : name === 'emscripten_notify_memory_growth' ? () => {} : () => kNoSystem;
    await this.#start();
  }

  async #start() {
    this.#instance = await WebAssembly.instantiate(this.#module, this.#imports);
    this.#instance.exports._initialize();
  }

  /** Runs work(scratch). A trap, for example on exhausted memory, replaces the instance and throws. */
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
