// Lossless PNG files of 8 and 16 bits, by the platform's deflate in node, browsers and workers.
import { CotanError, usage } from './errors.js';
import { bytesOf, checkedImage } from './image_checks.js';
import { through } from './streams.js';

const kMaxPixels = 2 ** 26;
const kSignature = [137, 80, 78, 71, 13, 10, 26, 10];
const bad = (message) => new CotanError('input', `PNG: ${message}`);

const table = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});
function checksum(bytes) {
  let sum = 0xffffffff;
  for (const byte of bytes) sum = table[(sum ^ byte) & 255] ^ (sum >>> 8);
  return (sum ^ 0xffffffff) >>> 0;
}

export const isPng = (bytes) => kSignature.every((byte, i) => bytes[i] === byte);

/** Undoes the row filters of one pass in place. stride: bytes per row; unit: bytes per pixel, at least 1. */
function unfilter(data, from, rows, stride, unit) {
  for (let y = 0; y < rows; ++y) {
    const row = from + y * (stride + 1) + 1;
    const above = y === 0 ? -1 : row - stride - 1;
    const filter = data[row - 1];
    if (filter > 4) throw bad(`row ${y}: expected a filter of 0 to 4, found ${filter}`);
    for (let x = 0; filter !== 0 && x < stride; ++x) {
      const a = x >= unit ? data[row + x - unit] : 0;
      const b = above < 0 ? 0 : data[above + x];
      const c = above < 0 || x < unit ? 0 : data[above + x - unit];
      let predicted = filter === 1 ? a : filter === 2 ? b : (a + b) >> 1;
      if (filter === 4) {
        const p = a + b - c, pa = Math.abs(p - a), pb = Math.abs(p - b), pc = Math.abs(p - c);
        predicted = pa <= pb && pa <= pc ? a : pb <= pc ? b : c;
      }
      data[row + x] += predicted;
    }
  }
}

const kPasses = [[0, 0, 8, 8], [4, 0, 8, 8], [0, 4, 4, 8], [2, 0, 4, 4], [0, 2, 2, 4], [1, 0, 2, 2], [0, 1, 1, 2]];

/** { width, height, bits: 8 or 16, data } with four components per pixel. */
export async function decodePng(file) {
  const bytes = bytesOf(file, 'bytes');
  if (!isPng(bytes)) throw bad('expected its signature, found other data');
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  let head = null, palette = null, clear = null;
  const parts = [];
  for (let at = 8; at + 12 <= bytes.length;) {
    const size = view.getUint32(at), end = at + 8 + size;
    const kind = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
    if (end + 4 > bytes.length) throw bad(`${kind}: expected ${size} bytes, found ${bytes.length - at - 12}`);
    if (checksum(bytes.subarray(at + 4, end)) !== view.getUint32(end)) throw bad(`${kind}: its checksum is wrong`);
    const body = bytes.subarray(at + 8, end);
    if (kind === 'IHDR' && size === 13) head = new DataView(body.buffer, body.byteOffset, size);
    else if (kind === 'PLTE') palette = body;
    else if (kind === 'tRNS') clear = body;
    else if (kind === 'IDAT') parts.push(body);
    else if (kind === 'IEND') break;
    at = end + 4;
  }
  if (!head || parts.length === 0) throw bad('expected a header and pixel data');
  const width = head.getUint32(0), height = head.getUint32(4), depth = head.getUint8(8), type = head.getUint8(9);
  const interlaced = head.getUint8(12) !== 0;
  const channels = { 0: 1, 2: 3, 3: 1, 4: 2, 6: 4 }[type];
  if (!channels || ![1, 2, 4, 8, 16].includes(depth) || (depth < 8 && channels > 1) || (type === 3 && depth > 8))
    throw bad(`expected a valid colour type and bit depth, found type ${type} with ${depth} bits`);
  if (type === 3 && !palette) throw bad('expected a palette');
  if (width < 1 || height < 1 || width > 65536 || height > 65536 || width * height > kMaxPixels)
    throw bad(`expected 1 to 65536 pixels per side and at most 67 million in total, found ${width} x ${height}`);

  const passes = (interlaced ? kPasses : [[0, 0, 1, 1]]).map(([x, y, dx, dy]) => ({
    x, y, dx, dy, columns: Math.max(0, Math.ceil((width - x) / dx)), rows: Math.max(0, Math.ceil((height - y) / dy)),
  })).filter((pass) => pass.columns > 0 && pass.rows > 0);
  const strideOf = (columns) => Math.ceil(columns * channels * depth / 8);
  const expected = passes.reduce((sum, pass) => sum + pass.rows * (strideOf(pass.columns) + 1), 0);
  let data;
  try {
    const packed = parts.length === 1 ? parts[0] : new Uint8Array(await new Blob(parts).arrayBuffer());
    data = await through(new DecompressionStream('deflate'), packed, expected);
  } catch {
    throw bad('its pixel data cannot be decompressed');
  }
  if (data.length < expected) throw bad(`expected ${expected} bytes of pixel data, found ${data.length}`);

  const bits = depth === 16 ? 16 : 8, maxValue = bits === 16 ? 65535 : 255;
  const out = bits === 16 ? new Uint16Array(width * height * 4) : new Uint8Array(width * height * 4);
  const scale = type === 3 ? 1 : depth < 8 ? 255 / (2 ** depth - 1) : 1;
  const keys = clear && type !== 3 ? Array.from({ length: clear.length >> 1 }, (_, i) => clear[2 * i] << 8 | clear[2 * i + 1]) : null;
  const unit = Math.max(1, channels * depth / 8);
  const sample = new Uint16Array(4);
  let from = 0;
  for (const pass of passes) {
    const stride = strideOf(pass.columns);
    unfilter(data, from, pass.rows, stride, unit);
    for (let y = 0; y < pass.rows; ++y) {
      const row = from + y * (stride + 1) + 1;
      for (let x = 0; x < pass.columns; ++x) {
        for (let k = 0; k < channels; ++k) {
          const i = x * channels + k;
          sample[k] = depth === 16 ? data[row + 2 * i] << 8 | data[row + 2 * i + 1]
            : depth === 8 ? data[row + i] : data[row + (i * depth >> 3)] >> (8 - depth - i * depth % 8) & (2 ** depth - 1);
        }
        const to = 4 * ((pass.y + y * pass.dy) * width + pass.x + x * pass.dx);
        if (type === 3) {
          const entry = sample[0];
          if (3 * entry + 3 > palette.length) throw bad(`expected a palette of more than ${entry} colours`);
          for (let k = 0; k < 3; ++k) out[to + k] = palette[3 * entry + k];
          out[to + 3] = clear && entry < clear.length ? clear[entry] : 255;
          continue;
        }
        const grey = channels < 3;
        for (let k = 0; k < 3; ++k) out[to + k] = sample[grey ? 0 : k] * scale;
        const isClear = keys && keys.every((key, k) => key === sample[k]);
        out[to + 3] = channels === 2 || channels === 4 ? sample[channels - 1] : isClear ? 0 : maxValue;
      }
    }
    from += pass.rows * (stride + 1);
  }
  return { width, height, bits, data: out };
}

/** Encodes an image of 8 or 16 bits as a PNG file; RGB if every pixel is opaque, else RGBA. */
export async function encodePng(image) {
  const { width, height, bits, data } = checkedImage(image, 'image', [8, 16]);
  if (width * height > kMaxPixels) throw usage(`image: expected at most 67 million pixels, found ${width} x ${height}`);
  const maxValue = bits === 16 ? 65535 : 255;
  let channels = 3;
  for (let i = 3; i < data.length && channels === 3; i += 4) if (data[i] !== maxValue) channels = 4;
  const unit = channels * bits / 8, stride = width * unit;
  const rows = new Uint8Array(height * (stride + 1));
  let above = new Uint8Array(stride), line = new Uint8Array(stride);
  const filtered = Array.from({ length: 5 }, () => new Uint8Array(stride));
  for (let y = 0; y < height; ++y) {
    for (let x = 0, at = 0; x < width; ++x)
      for (let k = 0; k < channels; ++k) {
        const value = data[4 * (y * width + x) + k];
        if (bits === 16) line[at++] = value >> 8;
        line[at++] = value;
      }
    let best = 0, least = Infinity;
    const sums = [0, 0, 0, 0, 0];
    for (let x = 0; x < stride; ++x) {
      const a = x >= unit ? line[x - unit] : 0, b = above[x], c = x >= unit ? above[x - unit] : 0;
      const p = a + b - c, pa = Math.abs(p - a), pb = Math.abs(p - b), pc = Math.abs(p - c);
      const predictions = [0, a, b, (a + b) >> 1, pa <= pb && pa <= pc ? a : pb <= pc ? b : c];
      for (let f = 0; f < 5; ++f) {
        const rest = filtered[f][x] = line[x] - predictions[f];
        const byte = rest & 255;
        sums[f] += byte < 128 ? byte : 256 - byte;
      }
    }
    for (let f = 0; f < 5; ++f) if (sums[f] < least) [best, least] = [f, sums[f]];
    rows[y * (stride + 1)] = best;
    rows.set(filtered[best], y * (stride + 1) + 1);
    [above, line] = [line, above];
  }
  const header = new Uint8Array(13), view = new DataView(header.buffer);
  view.setUint32(0, width);
  view.setUint32(4, height);
  header.set([bits, channels === 3 ? 2 : 6, 0, 0, 0], 8);
  const chunk = (kind, body) => {
    const bytes = new Uint8Array(12 + body.length), at = new DataView(bytes.buffer);
    at.setUint32(0, body.length);
    bytes.set([...kind].map((letter) => letter.charCodeAt(0)), 4);
    bytes.set(body, 8);
    at.setUint32(8 + body.length, checksum(bytes.subarray(4, 8 + body.length)));
    return bytes;
  };
  const packed = await through(new CompressionStream('deflate'), rows);
  const file = [Uint8Array.from(kSignature), chunk('IHDR', header), chunk('IDAT', packed), chunk('IEND', new Uint8Array(0))];
  const whole = new Uint8Array(file.reduce((sum, part) => sum + part.length, 0));
  let at = 0;
  for (const part of file) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}
