// Decodes and encodes image files: PNG here, other formats by the browser, or by sharp if it is installed.
import { CotanError, usage, wordsFor } from './errors.js';
import { builtin } from './node.js';
import { bytesOf } from './image_checks.js';
import { decodePng, isPng } from './png.js';

/** A package that the user may have installed, found from this file or the working directory; else undefined. */
async function optionalPackage(name) {
  const from = (await builtin('module'))?.createRequire;
  for (const base of from ? [import.meta.url, `${globalThis.process.cwd()}/`] : []) {
    try {
      return from(base)(name);
    } catch {
      // try the next base
    }
  }
  return undefined;
}

const kMaxPixels = 2 ** 26;

/** Whether bytes are a KTX2 file, which the library decodes and browsers do not. */
export const isKtx2 = (bytes) => wordAt(bytes, 1) === 'KTX ' && wordAt(bytes, 5) === '20\u00bb\r';

const kBlocks = { 141: 'bc5', 142: 'bc5-snorm', 145: 'bc7', 155: 'eac-rg11', 156: 'eac-rg11', 163: 'uastc', 166: 'uastc' };

/** How cotan/textures writes the blocks of a KTX2 file: { compress, levels }. ETC1S becomes UASTC, the other format of Basis
 * Universal. Null if it has no encoder for them. */
export function ktx2Blocks(bytes) {
  if (bytes.length < 80) return null;
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), described = view.getUint32(48, true);
  const compress = kBlocks[view.getUint32(12, true) || bytes[described + 12]]; // Vulkan's number, or the colour model
  return compress ? { compress, levels: view.getUint32(40, true) } : null;
}

/** The texels of an image that the browser decoded, as they are in its file. */
function texelsOf(bitmap, name) {
  const { width, height } = bitmap;
  if (width * height > kMaxPixels) throw new CotanError('input', `${name}: expected at most 67 million pixels, found ${width} x ${height}`);
  const context = new OffscreenCanvas(width, height).getContext('2d', { willReadFrequently: true });
  context.drawImage(bitmap, 0, 0);
  const { data } = context.getImageData(0, 0, width, height);
  for (let i = 3; i < data.length; i += 4) if (data[i] !== 255) return texelsByWebGl(bitmap, name);
  return new Uint8Array(data.buffer);
}

/** A canvas multiplies colours by alpha and divides them again, which loses them where alpha is small. Textures do not. */
function texelsByWebGl(bitmap, name) {
  const { width, height } = bitmap, gl = new OffscreenCanvas(1, 1).getContext('webgl2'), data = new Uint8Array(4 * width * height);
  const fail = () => { throw new CotanError('unavailable', `${name}: its colours under transparent alpha need WebGL 2 with textures of ${width} x ${height}, or options.decode`); };
  if (!gl || Math.max(width, height) > gl.getParameter(gl.MAX_TEXTURE_SIZE)) fail();
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, gl.getParameter(gl.TEXTURE_BINDING_2D), 0);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, data);
  const isFine = gl.getError() === gl.NO_ERROR;
  gl.getExtension('WEBGL_lose_context')?.loseContext(); // browsers keep only a few contexts
  return isFine ? data : fail();
}

/** Decodes to { width, height, bits, data } with four components per pixel: all formats but KTX2. */
export async function decodeImage(file, name = 'image') {
  const bytes = bytesOf(file, 'bytes');
  if (typeof name !== 'string') throw usage(`name: expected a string, found ${wordsFor(name)}`);
  if (isPng(bytes)) return decodePng(bytes);
  if (typeof createImageBitmap === 'function' && typeof OffscreenCanvas === 'function') {
    const bitmap = await createImageBitmap(new Blob([bytes]), { colorSpaceConversion: 'none', premultiplyAlpha: 'none' })
      .catch(() => { throw new CotanError('input', `${name}: the browser cannot decode it`); });
    try {
      return { width: bitmap.width, height: bitmap.height, bits: 8, data: texelsOf(bitmap, name) };
    } finally {
      bitmap.close();
    }
  }
  const sharp = await optionalPackage('sharp');
  if (!sharp) throw new CotanError('unavailable', `${name}: images other than PNG need the package sharp, or options.decode`);
  const { data, info } = await sharp(bytes, { limitInputPixels: kMaxPixels, ignoreIcc: true }).ensureAlpha().raw().toBuffer({ resolveWithObject: true })
    .catch((error) => { throw new CotanError('input', `${name}: ${error.message}`); });
  const texels = new Uint8Array(data.buffer, data.byteOffset, data.byteLength), isGrey = info.channels === 2;
  return { width: info.width, height: info.height, bits: 8,
    data: isGrey ? Uint8Array.from({ length: 2 * texels.length }, (_, i) => texels[(i >> 2) * 2 + (i % 4 === 3)]) : texels };
}

/** { mimeType, quality, halved } of a JPEG or WebP file, else null. quality: 1 to 100, undefined if lossless.
 * halved: whether chroma is subsampled. */
export function lossyFormat(bytes) {
  if (bytes[0] === 0xff && bytes[1] === 0xd8) return { mimeType: 'image/jpeg', ...jpegFormat(bytes) };
  if (wordAt(bytes, 0) === 'RIFF' && wordAt(bytes, 8) === 'WEBP') return { mimeType: 'image/webp', quality: isLosslessWebp(bytes) ? undefined : kWebpQuality };
  return null;
}

const wordAt = (bytes, at) => String.fromCharCode(...bytes.subarray(at, at + 4));

function isLosslessWebp(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  for (let at = 12; at + 8 <= bytes.length; at += 8 + view.getUint32(at + 4, true) + view.getUint32(at + 4, true) % 2)
    if (/^VP8[ L]$/.test(wordAt(bytes, at))) return wordAt(bytes, at) === 'VP8L';
  return false;
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
  const isOpaque = data.every((value, i) => i % 4 !== 3 || value === 255);
  if (mimeType === 'image/jpeg' && !isOpaque) return null;
  if (typeof OffscreenCanvas === 'function') {
    if (!isOpaque || (mimeType === 'image/jpeg' && !halved)) return null; // browsers subsample chroma
    const canvas = new OffscreenCanvas(width, height);
    canvas.getContext('2d').putImageData(new ImageData(new Uint8ClampedArray(data), width, height), 0, 0);
    const blob = await canvas.convertToBlob({ type: mimeType, quality: (quality ?? 100) / 100 });
    return blob.type === mimeType && quality !== undefined ? new Uint8Array(await blob.arrayBuffer()) : null;
  }
  const sharp = await optionalPackage('sharp'), whole = sharp?.(data, { raw: { width, height, channels: 4 } }), image = isOpaque ? whole?.removeAlpha() : whole;
  return image ? new Uint8Array(await (mimeType === 'image/jpeg' ? image.jpeg({ quality, chromaSubsampling: halved ? '4:2:0' : '4:4:4' }) : image.webp({ quality, lossless: quality === undefined })).toBuffer()) : null;
}
