// Calls functions with every argument, option and element replaced by bad values, one by one and two at a time, drawn at
// random by a seed.
import assert from 'node:assert/strict';

const detached = (made) => {
  structuredClone(made.buffer ?? made, { transfer: [made.buffer ?? made] });
  return made;
};
const outOfBounds = () => {
  const buffer = new ArrayBuffer(64, { maxByteLength: 64 }), view = new Float32Array(buffer, 32);
  buffer.resize?.(8);
  return view;
};
const sparse = (length, ...values) => Object.assign([], values, { length });

/** New ones at each use, because some can be used up. */
export const kBadValues = {
  undefined: () => undefined, null: () => null, NaN: () => NaN, Infinity: () => Infinity, negative: () => -1, fraction: () => 0.5, huge: () => 2 ** 53, bigint: () => 1n,
  true: () => true, symbol: () => Symbol('s'), 'empty text': () => '', text: () => 'text', 'text with NUL': () => 'gltf\0nonsense', 'long text': () => 'x'.repeat(1e5),
  'lone surrogate': () => '\ud800', 'text with a new line': () => 'a\nb', 'prototype name': () => 'constructor',
  'empty array': () => [], 'short array': () => [1], 'array of texts': () => ['a', 'b', 'c'], 'array of arrays': () => [[1], [2], [3]], 'array of bigints': () => [1n, 2n, 3n],
  'array of NaN': () => [NaN, NaN, NaN], 'sparse array': () => sparse(2 ** 32 - 1), 'sparse array with a beginning': () => sparse(3e9, 0, 0, 0), 'array with a hole': () => [0, , 1],
  'proxy of an array': () => new Proxy([], {}), object: () => ({}), 'object without prototype': () => Object.create(null), 'object like an array': () => ({ length: 3, 0: 1, 1: 2, 2: 3 }),
  'unfriendly object': () => ({ toString() { throw new Error('no text'); }, valueOf() { throw new Error('no value'); } }), function: () => () => 1, date: () => new Date(0), map: () => new Map(),
  promise: () => Promise.resolve(1), 'regular expression': () => /x/,
  bytes: () => new Uint8Array(3), 'no bytes': () => new Uint8Array(0), 'buffer': () => new ArrayBuffer(5), 'doubles': () => new Float64Array(9), 'bigint array': () => new BigInt64Array(3),
  'data view': () => new DataView(new ArrayBuffer(8)), 'detached buffer': () => detached(new ArrayBuffer(8)), 'detached bytes': () => detached(new Uint8Array(8)),
  'detached floats': () => detached(new Float32Array(9)), 'detached data view': () => detached(new DataView(new ArrayBuffer(8))), 'view beyond its buffer': outOfBounds,
  'shared bytes': () => new Uint8Array(new SharedArrayBuffer(8)), 'shared buffer': () => new SharedArrayBuffer(8),
};
/** Of these no function may take one as anything. */
export const kNeverFine = ['sparse array', 'sparse array with a beginning', 'array with a hole', 'symbol', 'detached buffer', 'detached bytes', 'detached floats', 'detached data view', 'text with NUL'];

/** Pseudo-random numbers from 0 to 1. */
function randomOf(seed) {
  return () => {
    seed = seed + 0x6d2b79f5 | 0;
    let t = Math.imul(seed ^ seed >>> 15, 1 | seed);
    t = t + Math.imul(t ^ t >>> 7, 61 | t) ^ t;
    return ((t ^ t >>> 14) >>> 0) / 2 ** 32;
  };
}

const isPlain = (value) => value !== null && typeof value === 'object' && (Object.getPrototypeOf(value) === Object.prototype || Array.isArray(value));

/** Paths to all arguments and to what is inside them: [[0], [0, 'positions'], ...]; of an array only its first element. */
function pathsOf(value, path = []) {
  const inside = isPlain(value) ? Array.isArray(value) && path.length > 0 ? [0] : Object.keys(value).map((key) => (path.length === 0 ? Number(key) : key)) : [];
  return [...(path.length > 0 ? [path] : []), ...inside.flatMap((key) => pathsOf(value[key], [...path, key]))];
}

function replaced(value, [key, ...rest], by) {
  const copy = Array.isArray(value) ? [...value] : { ...value };
  copy[key] = rest.length > 0 && isPlain(copy[key]) ? replaced(copy[key], rest, by) : by;
  return copy;
}

/** calls: by name, { call(...args), args(), names }: names of the arguments as errors give them;
 * depth: the length of paths that are tried. CotanError: the class that
 * is expected. Returns the number of calls. */
export async function walkBadValues(calls, CotanError, { seed = 1, draws = 40 } = {}) {
  const random = randomOf(seed), pick = (list) => list[Math.floor(random() * list.length)], kinds = Object.keys(kBadValues);
  let count = 0;
  async function attempt(name, { call, args, names, fine = () => false }, changes) {
    const given = [...changes].sort(([a], [b]) => b.length - a.length).reduce((list, [path, kind]) => replaced(list, path, kBadValues[kind]()), args());
    const what = `${name}, seed ${seed}: ${changes.map(([path, kind]) => `${[names[path[0]], ...path.slice(1)].join('.')} is ${kind}`).join(', ')}`;
    ++count;
    let error;
    try {
      await call(...given);
    } catch (thrown) {
      error = thrown;
    }
    if (!error) {
      const wrong = changes.length === 1 && kNeverFine.includes(changes[0][1]) && !fine(changes[0][0], changes[0][1]);
      return assert.ok(!wrong, `${what}: it was taken`);
    }
    assert.ok(error instanceof CotanError, `${what}: ${error.stack ?? error}`);
    assert.doesNotMatch(error.message, /\n|the library stopped|undefined is not|Cannot read|is not a function|texcoords|limit_area|scale_[xy]|expansion|index_count/, what);
    assert.ok(error.message.length < 400, `${what}: ${error.message.length} characters`);
    if (error.code === 'usage' && error.field !== undefined)
      assert.ok(names.some((known) => error.field === known || error.field.startsWith(`${known}.`) || error.field.startsWith(`${known}[`)), `${what}: it names ${error.field}: ${error.message}`);
  }
  for (const [name, one] of Object.entries(calls)) {
    await one.call(...one.args()); // works as it is
    const paths = pathsOf(one.args()).filter((path) => path.length <= (one.depth ?? Infinity)), began = Date.now(), before = count;
    for (const path of paths) for (const kind of kinds) await attempt(name, one, [[path, kind]]);
    for (let k = 0; k < draws; ++k) await attempt(name, one, [[pick(paths), pick(kinds)], [pick(paths), pick(kinds)]]);
    if (process.env.VERBOSE) console.log(`${name}: ${count - before} calls, ${Date.now() - began} ms`);
  }
  return count;
}
