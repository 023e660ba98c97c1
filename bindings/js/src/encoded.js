// Files of new maps: in the format of the old file, unless its losses would show.
import { usage } from './errors.js';
import { bytesOf } from './image_checks.js';
import { decodeImage, encodeLossy, isKtx2, ktx2Blocks, lossyFormat } from './image_files.js';
import { decodePng, encodePng, isPng } from './png.js';

export const kVisible = 0.5; // degrees on average over a map; the library has the same threshold

/** Mean angle in degrees between the directions of two maps of one size, texel by texel, read as 2c - 1. */
export function degreesBetween(a, b) {
  const [p, q] = [a, b].map(({ bits, data }) => ({ data, half: bits === 16 ? 32767.5 : 127.5 }));
  const at = ({ data, half }, i) => data[i] / half - 1;
  let sum = 0;
  for (let i = 0; i < p.data.length; i += 4) {
    const [ax, ay, az, bx, by, bz] = [at(p, i), at(p, i + 1), at(p, i + 2), at(q, i), at(q, i + 1), at(q, i + 2)];
    sum += Math.atan2(Math.hypot(ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx), ax * bx + ay * by + az * bz);
  }
  return sum * 180 / Math.PI / (a.width * a.height);
}

/** { bytes, mimeType, degrees }: the PNG file that the caller's function makes of an image, decoded again and compared.
 * degrees: 0 for the package's own function, which loses nothing. */
export async function encodedByCaller(image, encode) {
  const name = 'options.encode', bytes = bytesOf(await encode(image), name), made = { bytes, mimeType: 'image/png', degrees: 0 };
  if (encode === encodePng) return made;
  if (!isPng(bytes)) throw usage(`${name}: expected a PNG file, found other data`);
  const stored = await decodePng(bytes).catch((error) => { throw usage(`${name}: ${error.message}`); });
  const sizeOf = ({ width, height }) => `${width} x ${height}`;
  if (sizeOf(stored) !== sizeOf(image)) throw usage(`${name}: expected an image of ${sizeOf(image)}, found ${sizeOf(stored)}`);
  return { ...made, degrees: degreesBetween(image, stored) };
}

// As encodedLike, for KTX2.
async function inBlocks(image, old, name, { texture, loss, otherwise }) {
  const blocks = ktx2Blocks(old), word = blocks?.compress, two = ['bc5', 'bc5-snorm', 'eac-rg11'].includes(word);
  if (!texture) return otherwise('KTX2 is written by options.texture, the function texture of cotan/textures');
  if (!blocks) return otherwise('there is no encoder for the blocks of its KTX2 file');
  if (image.width % 4 || image.height % 4) return otherwise(`KTX2 in glTF needs sides that are multiples of 4, found ${image.width} x ${image.height}`);
  const { bytes, degrees } = await texture(image, { from: 'gltf,biased', to: two ? 'gltf,biased,xy' : 'gltf,biased', compress: word, mips: blocks.levels !== 1 });
  const note = degrees?.mean > loss ? `${name}: stays KTX2 with ${word}, which has an error of ${degrees.mean.toFixed(2)} degrees on average` : undefined;
  return { bytes, mimeType: 'image/ktx2', degrees: degrees?.mean ?? null, format: `KTX2 with ${word}`, quality: null, note };
}

/** The file of a map in the format of the file `old`, but png if JPEG or WebP are not smaller and accurate enough; KTX2
 * stays, since it is chosen for memory. Adds `format` and `quality` in the first case, and else a `note` where the reader should know why. name: of the map.
 * more: required: types of images that all readers of the model support; texture: that of cotan/textures; loss: degrees on
 * average that the format may lose. */
export async function encodedLike(image, old, png, name, { required, texture, loss = kVisible }) {
  if (isKtx2(old)) {
    const otherwise = (why) => ({ ...png, note: `${name}: ${why}, so the new map is PNG: ${png.bytes.length} bytes, before ${old.length}` });
    return required.includes('image/ktx2') ? inBlocks(image, old, name, { texture, loss, otherwise }) : otherwise('the model does not require its readers to support KTX2');
  }
  const format = image.bits === 8 ? lossyFormat(old) : null, sizes = `the new map is PNG: ${png.bytes.length} bytes, before ${old.length}`;
  if (!format) return png;
  if (format.mimeType === 'image/webp' && !required.includes('image/webp')) return { ...png, note: `${name}: the model does not require its readers to support WebP, so ${sizes}` };
  const bytes = await encodeLossy(image, format);
  if (!bytes) return { ...png, note: `${name}: no encoder for ${format.mimeType} is available (in Node.js: the package sharp), so ${sizes}` };
  if (bytes.length >= png.bytes.length) return png;
  const degrees = degreesBetween(image, await decodeImage(bytes, name)), word = format.mimeType === 'image/webp' ? 'WebP' : 'JPEG';
  if (degrees > loss)
    return { ...png, note: `${name}: ${word} of quality ${format.quality} would have an error of ${degrees.toFixed(2)} degrees on average, so ${sizes}` };
  return { bytes, mimeType: format.mimeType, degrees, format: word, quality: format.quality ?? null };
}
