// Checks and converts the arguments that callers pass.
import { usage, wordsFor } from './errors.js';

const isList = (value) => Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));

/** Numbers as a Float32Array of elements with `size` components; exactly `count` elements if count is given. */
export function floats(value, name, size, count) {
  if (!isList(value)) throw usage(`${name}: expected an array of numbers, ${size} per element, found ${wordsFor(value)}`);
  if (value.length % size !== 0) throw usage(`${name}: expected a multiple of ${size} numbers, found ${value.length}`);
  if (count !== undefined && value.length !== size * count)
    throw usage(`${name}: expected ${size * count} numbers, found ${value.length}`);
  return value instanceof Float32Array ? value : Float32Array.from(value, Number);
}

/** Unsigned 32-bit integers as a Uint32Array. */
export function unsignedIntegers(value, name) {
  if (value instanceof Uint32Array) return value;
  if (!isList(value)) throw usage(`${name}: expected an array of integers, found ${wordsFor(value)}`);
  if (value instanceof Uint16Array || value instanceof Uint8Array) return Uint32Array.from(value);
  return Uint32Array.from(value, (number, i) => {
    if (!(Number.isInteger(number) && number >= 0 && number <= 0xffffffff))
      throw usage(`${name}[${i}]: expected a 32-bit unsigned integer, found ${wordsFor(number)}`);
    return number;
  });
}

/** The given options over the defaults in `known`; refuses names that `known` does not have. */
export function options(given, known) {
  if (given === undefined || given === null) return known;
  if (typeof given !== 'object') throw usage(`options: expected an object, found ${wordsFor(given)}`);
  for (const name of Object.keys(given))
    if (!(name in known)) throw usage(`options.${name}: expected one of ${Object.keys(known).join(', ')}, found ${name}`);
  return { ...known, ...given };
}

/** Returns value if it is one of `known`. */
export function choice(value, name, known) {
  if (!known.includes(value)) throw usage(`${name}: expected ${known.join(', ')}, found ${wordsFor(value)}`);
  return value;
}
