// Pictures as files: PNG here, others by the browser or by sharp where it is installed.
import { CotanError } from './errors.js';
import { builtin } from './node.js';
import { bytesOf } from './picture.js';
import { decodePng, isPng } from './png.js';

/** A package of the user's, beside this file or where the program was started; undefined where there is none. */
function optionalPackage(name) {
  const from = builtin('module')?.createRequire;
  for (const place of from ? [import.meta.url, `${globalThis.process.cwd()}/`] : []) {
    try {
      return from(place)(name);
    } catch {
      // the next place
    }
  }
  return undefined;
}

/** { width, height, bits, data }, four components a pixel; the default of options.decode. */
export async function decodePicture(file, name = 'picture') {
  const bytes = bytesOf(file, 'bytes');
  if (isPng(bytes)) return decodePng(bytes);
  if (typeof createImageBitmap === 'function' && typeof OffscreenCanvas === 'function') {
    const bitmap = await createImageBitmap(new Blob([bytes]), { colorSpaceConversion: 'none', premultiplyAlpha: 'none' })
      .catch(() => { throw new CotanError('input', `${name}: the browser does not decode it`); });
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d', { willReadFrequently: true });
    context.drawImage(bitmap, 0, 0);
    const { width, height, data } = context.getImageData(0, 0, bitmap.width, bitmap.height);
    bitmap.close();
    return { width, height, bits: 8, data: new Uint8Array(data.buffer) };
  }
  const sharp = optionalPackage('sharp');
  if (!sharp) throw new CotanError('unavailable', `${name}: pictures other than PNG need the package sharp, or options.decode`);
  const { data, info } = await sharp(bytes, { limitInputPixels: 2 ** 26 }).ensureAlpha().raw().toBuffer({ resolveWithObject: true })
    .catch((error) => { throw new CotanError('input', `${name}: ${error.message}`); });
  return { width: info.width, height: info.height, bits: 8, data: new Uint8Array(data.buffer, data.byteOffset, data.byteLength) };
}
