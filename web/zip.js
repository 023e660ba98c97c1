// Reads the files of a zip in memory. Nothing of it is trusted: every offset and size is checked before use, and no more
// is decompressed than the zip declares.
import { CotanError } from 'cotan/beside';

const kMaxFiles = 10000, kMaxBytes = 2 ** 30;
const kEnd = 0x06054b50, kEntry = 0x02014b50, kLocal = 0x04034b50; // signatures
const kEndBytes = 22, kEntryBytes = 46, kLocalBytes = 30, kMaxComment = 0xffff;
const kStored = 0, kDeflated = 8;

// Returns [{ name, path, bytes }] without folders and without macOS's own files. name: of the zip, for messages.
export async function unzip(name, bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const wrong = text => { throw new CotanError('input', `${name}: ${text}`); };
  const entries = entriesOf(view, bytes, wrong), files = [];
  for (const entry of entries) {
    if (entry.path.endsWith('/') || /^__MACOSX\/|(^|\/)\.DS_Store$/.test(entry.path)) continue;
    const packed = bytes.subarray(entry.from, entry.from + entry.packed), unpacked = entry.method === kStored ? packed : await inflated(packed, entry, wrong);
    if (checksum(unpacked) !== entry.sum) wrong(`${entry.path}: its checksum is wrong`);
    files.push({ name: entry.path.slice(entry.path.lastIndexOf('/') + 1), path: entry.path, bytes: unpacked });
  }
  return files;
}

// The entries of the central directory: { path, method, sum, packed, unpacked, from }, from: where the data begin.
function entriesOf(view, bytes, wrong) {
  const end = endOf(view);
  if (end < 0) wrong('expected the end of a zip, found none: the file is damaged or incomplete');
  const count = view.getUint16(end + 10, true), size = view.getUint32(end + 12, true), begin = view.getUint32(end + 16, true);
  if (count === 0xffff || size === 0xffffffff || begin === 0xffffffff) wrong('expected a zip below 4 GiB, found the format ZIP64');
  if ([view.getUint16(end + 4, true), view.getUint16(end + 6, true)].some(disk => disk !== 0) || view.getUint16(end + 8, true) !== count) wrong('expected a zip in one file, found one of several parts');
  if (count > kMaxFiles) wrong(`expected at most ${kMaxFiles} files, found ${count}`);
  if (begin + size > end) wrong('its list of files is not where the end of the zip says');
  const entries = [], paths = new Set();
  let at = begin, total = 0;
  for (let k = 0; k < count; ++k) {
    if (at + kEntryBytes > begin + size || view.getUint32(at, true) !== kEntry) wrong(`expected ${count} entries in its list of files, found ${k}`);
    const lengths = [28, 30, 32].map(offset => view.getUint16(at + offset, true)), next = at + kEntryBytes + lengths[0] + lengths[1] + lengths[2];
    if (next > begin + size) wrong(`entry ${k} of its list of files is too long`);
    const entry = { flags: view.getUint16(at + 8, true), method: view.getUint16(at + 10, true), sum: view.getUint32(at + 16, true), packed: view.getUint32(at + 20, true),
      unpacked: view.getUint32(at + 24, true), header: view.getUint32(at + 42, true), name: bytes.subarray(at + kEntryBytes, at + kEntryBytes + lengths[0]) };
    entry.path = pathOf(entry, wrong);
    if (paths.has(entry.path)) wrong(`${entry.path}: two files have this name`);
    paths.add(entry.path);
    checkEntry(entry, wrong);
    total += entry.unpacked;
    if (total > kMaxBytes) wrong(`expected files of at most 1 GiB in total, found more`);
    entry.from = dataOf(entry, view, bytes, begin, wrong);
    entries.push(entry);
    at = next;
  }
  const inOrder = [...entries].sort((a, b) => a.header - b.header);
  inOrder.forEach((entry, k) => { if (k > 0 && entry.header < inOrder[k - 1].from + inOrder[k - 1].packed) wrong(`${entry.path}: its data overlap those of ${inOrder[k - 1].path}`); });
  return entries;
}

// Where the end record begins, whose comment reaches to the end of the file; -1 if there is none.
function endOf(view) {
  for (let at = view.byteLength - kEndBytes; at >= Math.max(0, view.byteLength - kEndBytes - kMaxComment); --at)
    if (view.getUint32(at, true) === kEnd && at + kEndBytes + view.getUint16(at + 20, true) === view.byteLength) return at;
  return -1;
}

function checkEntry({ path, flags, method, packed, unpacked }, wrong) {
  if (flags & 1) wrong(`${path}: expected files without a password, found an encrypted one`);
  if (method !== kStored && method !== kDeflated) wrong(`${path}: expected compression by deflate or none, found method ${method}`);
  if (method === kStored && packed !== unpacked) wrong(`${path}: expected ${unpacked} bytes, found ${packed}`);
  if (unpacked > 1032 * packed + 64) wrong(`${path}: ${packed} bytes cannot become ${unpacked}`); // deflate's limit
}

// Checks the entry's local header, which lies before the list of files at `limit`. Returns where the data begin.
function dataOf({ path, flags, method, packed, unpacked, header, name }, view, bytes, limit, wrong) {
  if (header + kLocalBytes > limit || view.getUint32(header, true) !== kLocal) wrong(`${path}: there is no file at its offset`);
  const length = view.getUint16(header + 26, true), from = header + kLocalBytes + length + view.getUint16(header + 28, true);
  if (from + packed > limit) wrong(`${path}: its data end behind the zip's`);
  const same = length === name.length && name.every((byte, k) => bytes[header + kLocalBytes + k] === byte);
  const sizes = [view.getUint32(header + 18, true), view.getUint32(header + 22, true)], areLater = (flags & 8) !== 0; // behind the data
  if (!same || view.getUint16(header + 8, true) !== method || (!areLater && (sizes[0] !== packed || sizes[1] !== unpacked)))
    wrong(`${path}: the list of files and the file's own header contradict each other`);
  return from;
}

// The path with slashes. Names that leave the zip's folder are refused.
function pathOf({ flags, name }, wrong) {
  let path;
  try {
    path = new TextDecoder('utf-8', { fatal: true }).decode(name);
  } catch {
    if (flags & 0x800) wrong('the name of a file is no UTF-8, as it says');
    path = new TextDecoder('windows-1252').decode(name);
  }
  path = path.replaceAll('\\', '/');
  if (path === '' || /^\/|^[A-Za-z]:|[\0-\x1f]/.test(path) || path.split('/').includes('..')) wrong(`expected the name of a file inside the zip, found ${JSON.stringify(path.slice(0, 60))}`);
  return path;
}

// Exactly as many bytes as the entry declares.
async function inflated(packed, { path, unpacked }, wrong) {
  const made = new Uint8Array(unpacked), reader = new Blob([packed]).stream().pipeThrough(new DecompressionStream('deflate-raw')).getReader();
  let at = 0;
  try {
    for (;;) {
      const { done, value } = await reader.read();
      if (done) break;
      if (at + value.length > unpacked) { await reader.cancel(); at = Infinity; break; }
      made.set(value, at);
      at += value.length;
    }
  } catch {
    wrong(`${path}: it cannot be decompressed`);
  }
  if (at !== unpacked) wrong(`${path}: expected ${unpacked} bytes, found ${at < unpacked ? at : 'more'}`);
  return made;
}

const table = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n >>> 0;
});
function checksum(bytes) {
  let sum = 0xffffffff;
  for (let k = 0; k < bytes.length; ++k) sum = table[(sum ^ bytes[k]) & 255] ^ (sum >>> 8);
  return (sum ^ 0xffffffff) >>> 0;
}
