// Reads files that were chosen or dropped, including those in folders, as [{ name, path, bytes }].
const kMaxBytes = 2 ** 30;

export async function readChosen(list) {
  return read([...list].map(file => ({ path: file.webkitRelativePath || file.name, file })));
}

export async function readDropped(transfer) {
  const entries = [...transfer.items].map(item => item.webkitGetAsEntry?.()).filter(entry => entry);
  if (entries.length === 0) return readChosen(transfer.files);
  const found = [];
  for (const entry of entries) await walk(entry, found);
  return read(found);
}

async function walk(entry, found) {
  if (entry.isFile) {
    const file = await new Promise((done, failed) => entry.file(done, failed));
    found.push({ path: entry.fullPath.replace(/^\//, ''), file });
    return;
  }
  const reader = entry.createReader();
  for (;;) { // a call returns only some of the entries
    const some = await new Promise((done, failed) => reader.readEntries(done, failed));
    if (some.length === 0) return;
    for (const inner of some) await walk(inner, found);
  }
}

async function read(found) {
  const total = found.reduce((sum, { file }) => sum + file.size, 0);
  if (total > kMaxBytes) throw new Error(`expected files of at most 1 GiB in total, found ${(total / 2 ** 30).toFixed(1)} GiB`);
  return Promise.all(found.map(async ({ path, file }) => ({ name: file.name, path, bytes: new Uint8Array(await file.arrayBuffer()) })));
}

export const isZip = bytes => bytes.length >= 4 && bytes[0] === 0x50 && bytes[1] === 0x4b && (bytes[2] === 3 && bytes[3] === 4 || bytes[2] === 5 && bytes[3] === 6);

export const isGlb = bytes => bytes.length >= 4 && bytes[0] === 0x67 && bytes[1] === 0x6c && bytes[2] === 0x54 && bytes[3] === 0x46;

// The model among the files: { model, beside }, where beside maps paths to bytes of the other files; undefined if none.
export function modelAmong(files) {
  const model = files.find(file => isGlb(file.bytes)) ?? files.find(file => /\.gltf$/i.test(file.name));
  return model && { model, beside: new Map(files.filter(file => file !== model).map(file => [file.path, file.bytes])) };
}

// The image to show if there is no model: by its name, else the first file; undefined if there is none.
export const mapAmong = files => files.find(({ name }) => /\.(png|jpe?g|webp|bmp|gif|avif|ktx2)$/i.test(name)) ?? files[0];

// The bytes of a file that a model references by URI; undefined if missing.
export function besideModel({ model, beside }, uri) {
  let path = uri;
  try { path = decodeURIComponent(uri); } catch { /* keep it undecoded */ }
  const parts = [], name = path.slice(path.lastIndexOf('/') + 1);
  for (const part of [...model.path.split('/').slice(0, -1), ...path.split('/')])
    if (part === '..') parts.pop(); else if (part !== '.' && part !== '') parts.push(part);
  // Files that were chosen one by one have lost their folders.
  return beside.get(parts.join('/')) ?? [...beside].find(([known]) => known.slice(known.lastIndexOf('/') + 1) === name)?.[1];
}
