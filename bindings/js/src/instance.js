// The WebAssembly library: its memory, calls of the functions of include/cotan.h, errors.

import { CotanError, usage, wordsFor } from './errors.js';

export { CotanError, usage, wordsFor };

const kCodes = ['ok', 'usage', 'input', 'unavailable', 'output', 'limit', 'stopped'];
const kMessageBytes = 1024;
const kOptions = 'options.';
const kLongName = 200; // no name of the library is as long
// Names of fields in messages of the library, where the caller's are other ones.
const kNames = {
  'mesh.texcoords': 'mesh.uvs', shader: 'options.stage', roughness: 'options.roughness', strength: 'options.strength', 'options.expansion': 'options.unsigned',
};
const kNoSystem = 52; // ENOSYS of WASI; for functions outside WASI any number but 0 means failure

/** Memory that is allocated for one call and freed when it ends. */
class Scratch {
  #owned = [];
  #names = { ...kNames }; // of arguments of C functions: the caller's

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
    if (typeof value !== 'string' || value.length > kLongName || [...value].some((letter) => letter < ' ')) throw usage(`${name}: expected a string, found ${wordsFor(value)}`);
    if (name?.startsWith(kOptions)) this.#names[name.slice(kOptions.length)] = name;
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
    if (status === 0) return;
    const text = this.textAt(message, kMessageBytes), [end] = [text.indexOf(':'), text.indexOf('[')].filter((at) => at >= 0).sort((a, b) => a - b);
    const field = text.slice(0, end ?? 0), known = Object.hasOwn(this.#names, field) ? this.#names[field] : field;
    throw new CotanError(kCodes[status] ?? 'unavailable', known + text.slice(end ?? 0));
  }

  free() {
    for (const at of this.#owned) this.wasm.free(at);
  }
}

/** An instance with its functions. `fault` is what was first thrown out of one of them, which left its stack and its
 * memory in an unknown state: from then on each of them throws it. */
function started(instance) {
  const live = { wasm: {}, fault: undefined };
  for (const [name, value] of Object.entries(instance.exports))
    live.wasm[name] = typeof value !== 'function' ? value : (...args) => {
      try {
        const result = live.fault ? undefined : value(...args);
        if (!live.fault) return result;
      } catch (error) {
        live.fault ??= error ?? new Error('unknown');
      }
      throw live.fault;
    };
  live.wasm._initialize();
  return live;
}

/** The library; usable after load(). */
export class Library {
  #module;
  #imports;
  #live;

  async load(bytes, imports = {}) {
    const found = await bytes; // a Response is compiled while it downloads
    this.#module = await WebAssembly[found.headers ? 'compileStreaming' : 'compile'](found);
    this.#imports = { ...imports };
    for (const { module, name } of WebAssembly.Module.imports(this.#module)) // stubs for system calls
      (this.#imports[module] ??= {})[name] ??= name === 'proc_exit' ? () => { throw new Error('it exited'); }
        : name === 'emscripten_notify_memory_growth' ? () => {} : () => kNoSystem;
    this.#live = started(await WebAssembly.instantiate(this.#module, this.#imports));
  }

  /** Runs work(scratch). Whatever is thrown out of WebAssembly becomes a CotanError, for example when stack or memory are
   * exhausted, and the next call gets a new instance: addresses are valid only while scratch.wasm is the same. */
  run(work) {
    if (!this.#live) throw usage('ready: await it before the first call');
    if (this.#live.fault) this.#restart();
    const live = this.#live, scratch = new Scratch(live.wasm);
    let result, thrown;
    try {
      result = work(scratch);
    } catch (error) {
      thrown = { error };
    }
    try {
      if (!live.fault) scratch.free();
    } catch (error) {
      live.fault ??= error;
    }
    if (live.fault) throw new CotanError('unavailable', `the library stopped: ${live.fault.message ?? live.fault}`);
    if (thrown) throw thrown.error;
    return result;
  }

  #restart() {
    try {
      this.#live = started(new WebAssembly.Instance(this.#module, this.#imports));
    } catch (error) {
      throw new CotanError('unavailable', `the library stopped, and a new instance cannot be made: ${error.message}`);
    }
  }

  get version() {
    return this.run((s) => s.textAt(s.wasm.cotan_version()));
  }
}
