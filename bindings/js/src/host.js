// The callbacks that host.cpp imports. Only one call of the library may run at a time.

export const kFunction = { read: 0, decode: 1, done: 2, progress: 3, takeLevel: 4, takeFile: 5 };

/** { imports, now, during }. The imports call the functions of `now`: { read(uri), decode(name, bytes), progress(done),
 * takeLevel, takeFile, scratch }. The first exception ends the call and is kept in now.error. */
export function hostImports() {
  const host = { now: null };
  const guarded = (work) => (...args) => {
    try {
      return work(host.now, ...args);
    } catch (error) {
      host.now.error ??= error;
      return 1;
    }
  };
  const give = (s, bytes, bytesOut, sizeOut) => {
    const at = s.wasm.malloc(Math.max(bytes.byteLength, 1)) >>> 0;
    if (at === 0) return 1;
    (host.now.held ??= []).push(at);
    new Uint8Array(s.buffer, at, bytes.byteLength).set(bytes);
    if (bytesOut !== null) s.view(Uint32Array, bytesOut, 1)[0] = at;
    if (sizeOut !== null) s.view(Uint32Array, sizeOut, 1)[0] = bytes.byteLength;
    return at;
  };
  const asBytes = (array) => new Uint8Array(array.buffer, array.byteOffset, array.byteLength);
  /** work() with other functions, for the time of the call. */
  host.during = (functions, work) => {
    const before = host.now;
    host.now = functions;
    try {
      return work();
    } catch (error) {
      throw functions.error ?? error;
    } finally {
      host.now = before;
    }
  };
  host.imports = {
    read: guarded((h, user, uri, bytesOut, sizeOut) => {
      const bytes = h.read?.(h.scratch.textAt(uri >>> 0));
      if (!bytes) return 1;
      return give(h.scratch, bytes, bytesOut >>> 0, sizeOut >>> 0) === 1 ? 1 : 0;
    }),
    decode: guarded((h, user, name, bytes, size, image) => {
      const s = h.scratch;
      const found = h.decode?.(s.textAt(name >>> 0), new Uint8Array(s.buffer, bytes >>> 0, size >>> 0));
      if (!found) return 1;
      const at = give(s, asBytes(found.data), null, null);
      if (at === 1) return 1;
      s.view(Uint32Array, (image >>> 0) + 4, 4).set([found.width, found.height, found.bits, at]);
      return 0;
    }),
    done: () => {
      for (const at of host.now.held ?? []) host.now.scratch.wasm.free(at);
      host.now.held = [];
    },
    progress: guarded((h, user, done) => (h.progress(done) === false ? 1 : 0)),
    take_level: guarded((h, user, level, map, roughness) => h.takeLevel(level, map >>> 0, roughness >>> 0) ?? 0),
    take_file: guarded((h, user, name, bytes, size) =>
      h.takeFile(h.scratch.textAt(name >>> 0), h.scratch.take(Uint8Array, bytes >>> 0, size >>> 0)) ?? 0),
  };
  return host;
}
