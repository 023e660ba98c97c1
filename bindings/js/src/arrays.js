// Checks and converts the arguments that callers pass.
import { usage, wordsFor } from './errors.js';

const isList = (value) => Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));

/** Whether the value is an object with members, not a list, a map, a date or other memory. */
export const isRecord = (value) => Object.prototype.toString.call(value) === '[object Object]';

/** Throws if the memory of a buffer or a view was given away, for example by postMessage, or cut off. */
export function checkMemory(value, name) {
  try {
    if (!ArrayBuffer.isView(value)) new Uint8Array(value);
    else if (value instanceof DataView) value.getInt8(value.byteLength); // throws a RangeError if there is memory
    else Uint8Array.prototype.keys.call(value);
  } catch (error) {
    if (!(error instanceof RangeError)) throw usage(`${name}: expected memory that is still here, found a detached or cut ArrayBuffer`);
  }
}

/** A list of the given type, of numbers that `fits` accepts. Holes of an array are no numbers, so that a sparse one is
 * refused before memory is allocated for its length. */
function listOf(Type, value, name, expected, fits) {
  if (!isList(value)) throw usage(`${name}: expected ${expected}, found ${wordsFor(value)}`);
  if (ArrayBuffer.isView(value)) checkMemory(value, name);
  if (value instanceof Type) return value;
  for (let i = 0; i < value.length; ++i)
    if (!fits(value[i])) throw usage(`${name}[${i}]: expected ${fits.expected}, found ${wordsFor(value[i])}`);
  return new Type(value);
}

const isNumber = /* @__PURE__ */ Object.assign((value) => typeof value === 'number', { expected: 'a number' });
const isUnsigned = /* @__PURE__ */ Object.assign((value) => Number.isInteger(value) && value >= 0 && value <= 0xffffffff, { expected: 'a 32-bit unsigned integer' });

/** Numbers as a Float32Array of elements with `size` components; exactly `count` elements if count is given. */
export function floats(value, name, size, count) {
  const list = listOf(Float32Array, value, name, `an array of numbers, ${size} per element`, isNumber);
  if (list.length % size !== 0) throw usage(`${name}: expected a multiple of ${size} numbers, found ${list.length}`);
  if (count !== undefined && list.length !== size * count)
    throw usage(`${name}: expected ${size * count} numbers, found ${list.length}`);
  return list;
}

/** Unsigned 32-bit integers as a Uint32Array. */
export const unsignedIntegers = (value, name) => listOf(Uint32Array, value, name, 'an array of integers', isUnsigned);

/** The given options over the defaults in `known`, which also apply to undefined and null; refuses names that `known` does
 * not have. */
export function options(given, known) {
  if (given === undefined || given === null) return { ...known };
  if (!isRecord(given)) throw usage(`options: expected an object, found ${wordsFor(given)}`);
  const made = { ...known };
  for (const [name, value] of Object.entries(given)) {
    if (!Object.hasOwn(known, name)) throw usage(`options.${name}: expected one of ${Object.keys(known).join(', ')}, found ${name}`);
    if (value !== undefined && value !== null) made[name] = value;
  }
  return made;
}

/** Throws unless the options of these names are of this type or missing. */
export function checkTypes(options, type, ...names) {
  const expected = { function: 'a function', boolean: 'true or false' }[type];
  for (const name of names)
    if (options[name] !== undefined && typeof options[name] !== type) throw usage(`options.${name}: expected ${expected}, found ${wordsFor(options[name])}`);
}

/** Three vertices for each triangle as a Uint32Array. */
export function triangleIndices(value, name) {
  const list = unsignedIntegers(value, name);
  if (list.length % 3 !== 0) throw usage(`${name}: expected a multiple of 3, found ${list.length}`);
  return list;
}

/** Returns value if it is one of `known`. */
export function choice(value, name, known) {
  if (!known.includes(value)) throw usage(`${name}: expected ${known.join(', ')}, found ${wordsFor(value)}`);
  return value;
}
