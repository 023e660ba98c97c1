// Reads the texels of normal maps back from three's textures.
import { ClampToEdgeWrapping, DataUtils, HalfFloatType, MirroredRepeatWrapping, RGBAFormat, RGFormat } from 'three';

const kSide = 512;        // of the copy that is read, at most
const kTransparent = 16;  // alpha, of 255, from which a canvas no longer keeps the other channels

const known = new WeakMap(); // by image: what texelsOf() returns

// { width, height, data, channels, scale } of the first level: stored components, where `scale` stands for 1; or { why }, a
// reason in words. Large images are reduced to at most 512 x 512 texels, without filtering.
export function texelsOf(map) {
  const image = map.image;
  if (!image) return { why: 'its map is not loaded' };
  if (!known.has(image)) {
    const found = map.isCompressedTexture ? { why: 'its map is compressed' } : image.data ? ofArray(map, image) : ofPicture(image);
    if (found.why === 'its map is not loaded') return found;
    known.set(image, found);
  }
  return known.get(image);
}

function ofArray({ format, type, isDataTexture }, { data, width, height }) {
  const channels = format === RGFormat ? 2 : format === RGBAFormat ? 4 : 0, half = isDataTexture && type === HalfFloatType;
  if (!channels || data.length < width * height * channels || !/^(Uint|Float32)/.test(data.constructor.name)) return { why: 'its map has a format that is not read' };
  const values = half ? Float32Array.from(data, DataUtils.fromHalfFloat) : data;
  return { width, height, channels, data: values, scale: values instanceof Float32Array ? 1 : 2 ** (8 * data.BYTES_PER_ELEMENT) - 1 };
}

function ofPicture(image) {
  const width = image.naturalWidth ?? image.width, height = image.naturalHeight ?? image.height;
  if (!(width > 0 && height > 0)) return { why: 'its map is not loaded' };
  const w = Math.min(width, kSide), h = Math.min(height, kSide);
  try {
    const context = new OffscreenCanvas(w, h).getContext('2d', { willReadFrequently: true });
    context.imageSmoothingEnabled = false;
    context.drawImage(image, 0, 0, w, h);
    const { data } = context.getImageData(0, 0, w, h);
    for (let k = 3; k < data.length; k += 4) if (data[k] < kTransparent) return { why: 'its map is transparent, which a canvas does not read' };
    return { width: w, height: h, data, channels: 4, scale: 255 };
  } catch (error) {
    return { why: `its map cannot be read (${error.message})` };
  }
}

const kFarthest = 1e8;

function wrapped(coordinate, size, wrap) {
  if (!(Math.abs(coordinate) <= kFarthest)) return 0;
  const i = Math.floor(coordinate * size);
  if (i >= 0 && i < size) return i;
  if (wrap === ClampToEdgeWrapping) return i < 0 ? 0 : size - 1;
  const period = wrap === MirroredRepeatWrapping ? 2 * size : size, k = ((i % period) + period) % period;
  return k < size ? k : period - 1 - k;
}

// Writes the decoded texel at (u, v), as three reads it, to out[at], out[at + 1] and out[at + 2]: the nearest one.
export function decodeAt(map, { width, height, data, channels, scale }, u, v, out, at) {
  // Browsers ignore flipY of an ImageBitmap.
  const flipped = map.flipY && !(typeof ImageBitmap !== 'undefined' && map.image instanceof ImageBitmap);
  const k = channels * (wrapped(flipped ? 1 - v : v, height, map.wrapT) * width + wrapped(u, width, map.wrapS));
  const x = data[k] / scale * 2 - 1, y = data[k + 1] / scale * 2 - 1;
  out[at] = x;
  out[at + 1] = y;
  out[at + 2] = map.format === RGFormat ? Math.sqrt(Math.max(0, 1 - x * x - y * y)) : data[k + 2] / scale * 2 - 1;
}
