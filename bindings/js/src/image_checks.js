// Checks the images and bytes that callers pass.
import { checkMemory } from './arrays.js';
import { usage, wordsFor } from './errors.js';

const kTypes = [[8, Uint8Array], [16, Uint16Array], [32, Float32Array]];

/** { width, height, bits, data } with four components per pixel. known: the accepted bit depths. */
export function checkedImage(image, name, known = [8, 16, 32]) {
  if (image === null || typeof image !== 'object') throw usage(`${name}: expected an image, found ${wordsFor(image)}`);
  const { width, height } = image;
  let { data } = image;
  if (ArrayBuffer.isView(data)) checkMemory(data, `${name}.data`);
  if (data instanceof Uint8ClampedArray) data = new Uint8Array(data.buffer, data.byteOffset, data.length);
  const bits = kTypes.find(([, Type]) => data instanceof Type)?.[0];
  if (!known.includes(bits)) throw usage(`${name}.data: expected numbers of ${known.join(' or ')} bits, found ${wordsFor(data)}`);
  if (image.bits !== undefined && image.bits !== bits) throw usage(`${name}.bits: expected ${bits}, the bit depth of its data; found ${wordsFor(image.bits)}`);
  for (const [side, value] of [['width', width], ['height', height]])
    if (!(Number.isInteger(value) && value >= 1 && value <= 65536))
      throw usage(`${name}.${side}: expected 1 to 65536 pixels, found ${wordsFor(value)}`);
  if (data.length !== 4 * width * height)
    throw usage(`${name}.data: expected ${4 * width * height} numbers, found ${data.length}`);
  return { width, height, bits, data };
}

/** The bytes of an ArrayBuffer or a view of one; a copy if threads share them, which decoders refuse. */
export function bytesOf(value, name) {
  const buffer = ArrayBuffer.isView(value) ? value.buffer : value;
  const isShared = typeof SharedArrayBuffer === 'function' && buffer instanceof SharedArrayBuffer;
  if (!(buffer instanceof ArrayBuffer || isShared)) throw usage(`${name}: expected bytes, found ${wordsFor(value)}`);
  checkMemory(value, name);
  const bytes = buffer === value ? new Uint8Array(value) : new Uint8Array(buffer, value.byteOffset, value.byteLength);
  return isShared ? bytes.slice() : bytes;
}
