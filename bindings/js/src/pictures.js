// Decodes and encodes image files: PNG here, other formats by the browser, or by sharp if it is installed.
import { CotanError } from './errors.js';
import { builtin } from './node.js';
import { bytesOf } from './picture.js';
import { decodePng, isPng } from './png.js';

/** A package that the user may have installed, found from this file or the working directory; else undefined. */
function optionalPackage(name) {
  const from = builtin('module')?.createRequire;
  for (const base of from ? [import.meta.url, `${globalThis.process.cwd()}/`] : []) {
    try {
      return from(base)(name);
    } catch {
      // try the next base
    }
  }
  return undefined;
}

/** Decodes to { width, height, bits, data } with four components per pixel; the default of options.decode. */
export async function decodePicture(file, name = 'image') {
  const bytes = bytesOf(file, 'bytes');
  if (isPng(bytes)) return decodePng(bytes);
  if (typeof createImageBitmap === 'function' && typeof OffscreenCanvas === 'function') {
    const bitmap = await createImageBitmap(new Blob([bytes]), { colorSpaceConversion: 'none', premultiplyAlpha: 'none' })
      .catch(() => { throw new CotanError('input', `${name}: the browser cannot decode it`); });
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d', { willReadFrequently: true });
    context.drawImage(bitmap, 0, 0);
    const { width, height, data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    bitmap.close();
    return { width, height, bits: 8, data: new Uint8Array(data.buffer) };
  }
  const sharp = optionalPackage('sharp');
  if (!sharp) throw new CotanError('unavailable', `${name}: images other than PNG need the package sharp, or options.decode`);
  const { data, info } = await sharp(bytes, { limitInputPixels: 2 ** 26 }).ensureAlpha().raw().toBuffer({ resolveWithObject: true })
    .catch((error) => { throw new CotanError('input', `${name}: ${error.message}`); });
  return { width: info.width, height: info.height, bits: 8, data: new Uint8Array(data.buffer, data.byteOffset, data.byteLength) };
}

/** { mimeType, quality, halved } of a JPEG or WebP file, else null. quality: 1 to 100, undefined if lossless.
 * halved: whether chroma is subsampled. */
export function lossyFormat(bytes) {
  if (bytes[0] === 0xff && bytes[1] === 0xd8) return { mimeType: 'image/jpeg', ...jpegFormat(bytes) };
  const word = (at) => String.fromCharCode(...bytes.subarray(at, at + 4));
  if (word(0) === 'RIFF' && word(8) === 'WEBP') return { mimeType: 'image/webp', quality: word(12) === 'VP8L' ? undefined : kWebpQuality };
  return null;
}

const kWebpQuality = 90; // assumed, since a WebP file does not store its quality
const kQuantized = 3688; // sum of the luminance quantization table at quality 50, annex K of the JPEG standard

function jpegFormat(bytes) {
  const found = { quality: kWebpQuality, halved: false };
  for (let at = 2; at + 12 < bytes.length && bytes[at] === 0xff && bytes[at + 1] !== 0xda; at += 2 + (bytes[at + 2] << 8 | bytes[at + 3])) {
    const kind = bytes[at + 1];
    if (kind === 0xdb && bytes[at + 4] === 0) {
      const percent = 100 * bytes.subarray(at + 5, at + 69).reduce((sum, x) => sum + x, 0) / kQuantized;
      found.quality = Math.max(1, Math.min(98, Math.round(percent <= 100 ? 100 - percent / 2 : 5000 / percent)));
    }
    if (kind >= 0xc0 && kind <= 0xc2) found.halved = bytes[at + 11] !== 0x11;
  }
  return found;
}

/** Encodes an 8-bit image in a format of lossyFormat(), by the browser or by sharp; null if neither can. */
export async function encodeLossy({ width, height, data }, { mimeType, quality, halved }) {
  if (typeof OffscreenCanvas === 'function') {
    if (mimeType === 'image/jpeg' && !halved) return null; // browsers subsample chroma, which would damage normals
    const canvas = new OffscreenCanvas(width, height);
    canvas.getContext('2d').putImageData(new ImageData(new Uint8ClampedArray(data), width, height), 0, 0);
    const blob = await canvas.convertToBlob({ type: mimeType, quality: (quality ?? 100) / 100 });
    return blob.type === mimeType && quality !== undefined ? new Uint8Array(await blob.arrayBuffer()) : null;
  }
  const picture = optionalPackage('sharp')?.(data, { raw: { width, height, channels: 4 } }).removeAlpha();
  return picture ? new Uint8Array(await (mimeType === 'image/jpeg' ? picture.jpeg({ quality, chromaSubsampling: halved ? '4:2:0' : '4:4:4' }) : picture.webp({ quality, lossless: quality === undefined })).toBuffer()) : null;
}
