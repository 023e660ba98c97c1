// glTF files as JSON and their binary chunk.
const kMagic = 0x46546c67, kJson = 0x4e4f534a;
/** { json, rest }: rest is what follows the JSON in a GLB, null for a .gltf. Returns null if bytes are neither. */
export function parsedModel(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength), isGlb = bytes.length >= 20 && view.getUint32(0, true) === kMagic;
  const length = isGlb ? view.getUint32(12, true) : bytes.length;
  if (isGlb && (view.getUint32(16, true) !== kJson || 20 + length > bytes.length)) return null;
  try {
    const json = JSON.parse(new TextDecoder().decode(isGlb ? bytes.subarray(20, 20 + length) : bytes));
    return json && typeof json === 'object' ? { json, rest: isGlb ? bytes.subarray(20 + length) : null } : null;
  } catch {
    return null;
  }
}

/** The file contents of what parsedModel() returns. */
export function modelBytes({ json, rest }) {
  const text = new TextEncoder().encode(JSON.stringify(json));
  if (!rest) return text;
  const length = Math.ceil(text.length / 4) * 4, bytes = new Uint8Array(20 + length + rest.length), view = new DataView(bytes.buffer);
  [kMagic, 2, bytes.length, length, kJson].forEach((word, k) => view.setUint32(4 * k, word, true));
  bytes.fill(0x20, 20, 20 + length);
  bytes.set(text, 20);
  bytes.set(rest, 20 + length);
  return bytes;
}

const list = (value) => (Array.isArray(value) ? value : []);
const named = (uri) => typeof uri === 'string' && !uri.startsWith('data:');
const found = (files, uri) => (Object.hasOwn(files, uri) ? files[uri] : Object.hasOwn(files, decodedUri(uri)) ? files[decodedUri(uri)] : null);
export function decodedUri(uri) {
  try {
    return decodeURIComponent(uri);
  } catch {
    return uri;
  }
}

/** Total size in bytes of a model and the external files that it references. */
export function sizeOf(bytes, json, files) {
  const uris = new Set([...list(json.buffers), ...list(json.images)].map((one) => one?.uri).filter(named));
  return [...uris].reduce((sum, uri) => sum + (found(files, uri)?.byteLength ?? 0), bytes.length);
}

/** Size in bytes of an image's encoded file. */
export function imageSize({ bufferView, uri } = {}, json, files) {
  if (bufferView !== undefined) return list(json.bufferViews)[bufferView]?.byteLength ?? 0;
  if (named(uri)) return found(files, uri)?.byteLength ?? 0;
  const text = /^data:[^,]*;base64,(.*)$/s.exec(uri ?? '')?.[1];
  return text ? Math.floor(text.replace(/=+$/, '').length * 3 / 4) : 0;
}

/** The encoded file of an image, from the GLB or from `files`; empty if found in neither. */
export function imageFile({ json, rest }, image, files) {
  const { bufferView, uri } = json.images?.[image] ?? {};
  if (bufferView !== undefined && rest && (list(json.bufferViews)[bufferView]?.buffer ?? 0) === 0 && !json.buffers?.[0]?.uri) return imageIn({ json, rest }, image);
  const bytes = named(uri) ? found(files, uri) : null;
  return bytes ? new Uint8Array(bytes.buffer ?? bytes, bytes.byteOffset ?? 0, bytes.byteLength) : new Uint8Array(0);
}

/** The image that a texture of the JSON shows. */
export const imageOfTexture = ({ source, extensions } = {}) =>
  extensions?.KHR_texture_basisu?.source ?? extensions?.EXT_texture_webp?.source ?? extensions?.EXT_texture_avif?.source ?? source;

/** Sorted indices of the images that materials use as normal maps. */
export function normalImages(json) {
  const textures = list(json.textures), images = new Set();
  for (const material of list(json.materials))
    for (const info of [material?.normalTexture, material?.extensions?.KHR_materials_clearcoat?.clearcoatNormalTexture]) {
      const image = imageOfTexture(textures[info?.index]);
      if (Number.isInteger(image)) images.add(image);
    }
  return [...images].sort((a, b) => a - b);
}

/** The encoded file of an image that is embedded in a GLB. */
export function imageIn({ json, rest }, image) {
  const { byteOffset = 0, byteLength } = json.bufferViews[json.images[image].bufferView];
  return rest.subarray(8 + byteOffset, 8 + byteOffset + byteLength);
}

const kWebp = 'EXT_texture_webp', kBasisu = 'KHR_texture_basisu', kExtensionOf = { 'image/webp': kWebp, 'image/ktx2': kBasisu };
/** The types of images, beyond PNG and JPEG, that every reader of the model must support. */
export const requiredTypes = (json) => Object.keys(kExtensionOf).filter((type) => list(json.extensionsRequired).includes(kExtensionOf[type]));

/** The textures after some images were replaced, which WebP and KTX2 need an extension for and PNG does not. */
function textureOf({ source, extensions, ...rest }, files) {
  const { [kWebp]: webp, [kBasisu]: basisu, ...others } = extensions ?? {}, image = basisu?.source ?? webp?.source ?? source, file = files.get(image);
  if (!file) return { ...rest, ...(source !== undefined && { source }), ...(extensions && { extensions }) };
  const extension = kExtensionOf[file.mimeType];
  if (extension) return { ...rest, extensions: { ...others, [extension]: { source: image } } };
  return { ...rest, source: image, ...(Object.keys(others).length > 0 && { extensions: others }) };
}

/** json with an extension for images listed if a texture has it: as required if one has no fallback. */
function withListed(json, name) {
  const { extensionsUsed, extensionsRequired, ...rest } = json, users = list(json.textures).filter(({ extensions }) => extensions?.[name]);
  const listed = (names, yes) => [...list(names).filter((one) => one !== name), ...(yes ? [name] : [])];
  const used = listed(extensionsUsed, users.length > 0), wasRequired = list(extensionsRequired).includes(name);
  const required = listed(extensionsRequired, users.some(({ source }) => source === undefined) || (users.length > 0 && wasRequired));
  return { ...rest, ...(used.length > 0 && { extensionsUsed: used }), ...(required.length > 0 && { extensionsRequired: required }) };
}

/** A self-contained GLB with some of its images replaced. files: Map from image index to { bytes, mimeType }. */
export function withImages({ json, rest }, files) {
  const owners = new Map([...files].map(([image, file]) => [json.images[image].bufferView, file]));
  const pieces = [], at = { length: 0 }, views = (json.bufferViews ?? []).map((view, k) => {
    const { byteOffset = 0, byteLength } = view, bytes = owners.get(k)?.bytes ?? rest.subarray(8 + byteOffset, 8 + byteOffset + byteLength), offset = at.length;
    pieces.push([offset, bytes]);
    at.length = Math.ceil((offset + bytes.length) / 4) * 4;
    return { ...view, byteOffset: offset, byteLength: bytes.length };
  });
  const whole = new Uint8Array(8 + at.length), view = new DataView(whole.buffer);
  view.setUint32(0, at.length, true);
  view.setUint32(4, 0x004e4942, true);
  for (const [offset, bytes] of pieces) whole.set(bytes, 8 + offset);
  const images = json.images.map((image, k) => (files.has(k) ? { ...image, mimeType: files.get(k).mimeType } : image));
  const named = Object.values(kExtensionOf).reduce(withListed, { ...json, textures: json.textures.map((one) => textureOf(one, files)) });
  return modelBytes({ json: { ...named, images, bufferViews: views, buffers: [{ ...json.buffers[0], byteLength: at.length }] }, rest: whole });
}
