// What the caller gives, looked at before it is used.
import { usage, wordsFor } from './errors.js';

const isList = (value) => Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));

/** Numbers as floats, `size` each; as many as `count` where that is known. */
export function floats(value, name, size, count) {
  if (!isList(value)) throw usage(`${name}: expected an array of numbers, ${size} each, found ${wordsFor(value)}`);
  if (value.length % size !== 0) throw usage(`${name}: expected a multiple of ${size} numbers, found ${value.length}`);
  if (count !== undefined && value.length !== size * count)
    throw usage(`${name}: expected ${size * count} numbers, found ${value.length}`);
  return value instanceof Float32Array ? value : Float32Array.from(value, Number);
}

/** Whole numbers from 0. */
export function words(value, name) {
  if (value instanceof Uint32Array) return value;
  if (!isList(value)) throw usage(`${name}: expected an array of whole numbers, found ${wordsFor(value)}`);
  if (value instanceof Uint16Array || value instanceof Uint8Array) return Uint32Array.from(value);
  return Uint32Array.from(value, (number, i) => {
    if (!(Number.isInteger(number) && number >= 0 && number <= 0xffffffff))
      throw usage(`${name}[${i}]: expected a whole number of 32 bits, found ${wordsFor(number)}`);
    return number;
  });
}

/** Options with no name that is not known. */
export function options(given, known) {
  if (given === undefined || given === null) return known;
  if (typeof given !== 'object') throw usage(`options: expected an object, found ${wordsFor(given)}`);
  for (const name of Object.keys(given))
    if (!(name in known)) throw usage(`options.${name}: expected one of ${Object.keys(known).join(', ')}, found ${name}`);
  return { ...known, ...given };
}

/** One of some words. */
export function choice(value, name, known) {
  if (!known.includes(value)) throw usage(`${name}: expected ${known.join(', ')}, found ${wordsFor(value)}`);
  return value;
}
