// Transforms for glTF-Transform 4, documented in index.d.ts.
import { Primitive, WebIO } from '@gltf-transform/core';
import { convert, CotanError, decodeImage, encodePng, frames, lint, provoking as provokingOf, ready, split, tangents as tangentsOf } from '../cotan.js';
import { checkTypes, choice, options as checked } from '../src/arrays.js';
import { imageIn, imageOfTexture, parsedModel } from '../src/glb.js';
import { grownBy, kGrowth, modeOf, tooLarge } from '../src/modes.js';

const named = (name, transform) => Object.defineProperty(transform, 'name', { value: name });
const kTangentFrames = ['mikktspace', 'area-weighted', 'vertex'];

function* primitivesOf(document) {
  for (const mesh of document.getRoot().listMeshes())
    for (const [number, primitive] of mesh.listPrimitives().entries())
      yield { primitive, name: `${mesh.getName() || 'mesh'}/${number}` };
}

/** The first `size` components of all elements, decoded to floats from any component type. */
function floatsOf(accessor, size) {
  const out = new Float32Array(accessor.getCount() * size), element = [];
  for (let i = 0; i < accessor.getCount(); ++i) out.set(accessor.getElement(i, element).slice(0, size), i * size);
  return out;
}

/** The uv that a primitive's normal map is sampled at, with KHR_texture_transform applied. Null if missing. */
function uvsOf(primitive) {
  const info = primitive.getMaterial()?.getNormalTexture() ? primitive.getMaterial().getNormalTextureInfo() : null;
  const transform = info?.getExtension('KHR_texture_transform');
  const uv = primitive.getAttribute(`TEXCOORD_${transform?.getTexCoord() ?? info?.getTexCoord() ?? 0}`);
  if (!uv) return null;
  const uvs = floatsOf(uv, 2);
  if (transform) {
    const [x, y] = transform.getOffset(), [sx, sy] = transform.getScale(), angle = transform.getRotation();
    const c = Math.cos(angle), s = Math.sin(angle);
    for (let i = 0; i < uvs.length; i += 2) {
      const u = uvs[i] * sx, v = uvs[i + 1] * sy;
      [uvs[i], uvs[i + 1]] = [x + c * u + s * v, y - s * u + c * v];
    }
  }
  return uvs;
}

const indicesOf = (primitive) => {
  const indices = primitive.getIndices();
  return indices ? Uint32Array.from(indices.getArray()) : Uint32Array.from({ length: primitive.getAttribute('POSITION').getCount() }, (_, i) => i);
};

const disposeIfUnused = (property) => {
  if (property && property.listParents().every((parent) => parent.propertyType === 'Root')) property.dispose();
};

/** Replaces the primitive's vertices by copies: new vertex k is a copy of old vertex sources[k]. */
function renumber(document, primitive, { sources, indices }) {
  const gathered = (accessor) => {
    const old = accessor.getArray(), size = accessor.getElementSize(), array = new old.constructor(sources.length * size);
    sources.forEach((source, i) => array.set(old.subarray(source * size, (source + 1) * size), i * size));
    return document.createAccessor(accessor.getName()).setType(accessor.getType()).setNormalized(accessor.getNormalized())
      .setBuffer(accessor.getBuffer()).setArray(array);
  };
  for (const holder of [primitive, ...primitive.listTargets()])
    for (const semantic of holder.listSemantics()) {
      const old = holder.getAttribute(semantic);
      holder.setAttribute(semantic, gathered(old));
      disposeIfUnused(old);
    }
  const old = primitive.getIndices();
  const Type = sources.length <= 65535 ? Uint16Array : Uint32Array;
  primitive.setIndices(document.createAccessor().setType('SCALAR').setArray(Type.from(indices))
    .setBuffer(primitive.getAttribute('POSITION').getBuffer()));
  disposeIfUnused(old);
}

function dropTangents(primitive) {
  for (const holder of [primitive, ...primitive.listTargets()]) {
    const old = holder.getAttribute('TANGENT');
    if (!old) continue;
    holder.setAttribute('TANGENT', null);
    disposeIfUnused(old);
  }
}

/** The reason why a primitive cannot have tangents, or null if it can. */
function whyNoTangents(primitive, uvs) {
  if (primitive.getMode() !== Primitive.Mode.TRIANGLES) return 'is not a triangle list';
  for (const semantic of ['POSITION', 'NORMAL']) if (!primitive.getAttribute(semantic)) return `has no ${semantic}`;
  return uvs ? null : 'has no uv';
}

function giveTangents(document, primitive, uvs, kind) {
  const position = primitive.getAttribute('POSITION'), indices = indicesOf(primitive), mesh = {
    positions: floatsOf(position, 3), normals: floatsOf(primitive.getAttribute('NORMAL'), 3), uvs, indices,
  };
  const corners = tangentsOf(mesh, { kind });
  for (let i = 0; i < corners.length; i += 4) // glTF requires unit length
    if (corners[i] === 0 && corners[i + 1] === 0 && corners[i + 2] === 0) corners[i] = 1;
  const splitMesh = split(position.getCount(), indices, corners);
  dropTangents(primitive);
  renumber(document, primitive, splitMesh);
  const values = new Float32Array(splitMesh.sources.length * 4).fill(0);
  for (let i = 3; i < values.length; i += 4) values[i] = 1;
  for (let i = 0; i < values.length; i += 4) values[i] = 1; // for vertices that no triangle uses
  splitMesh.indices.forEach((vertex, i) => values.set(corners.subarray(4 * i, 4 * i + 4), 4 * vertex));
  primitive.setAttribute('TANGENT', document.createAccessor().setType('VEC4').setArray(values)
    .setBuffer(primitive.getAttribute('POSITION').getBuffer()));
}

export function tangents(given) {
  const o = checked(given, { kind: 'mikktspace', overwrite: false }), { kind, overwrite } = o;
  checkTypes(o, 'boolean', 'overwrite');
  choice(kind, 'options.kind', kTangentFrames);
  return named('tangents', async (document) => {
    await ready;
    const logger = document.getLogger();
    let count = 0;
    for (const { primitive, name } of primitivesOf(document)) {
      if (primitive.getAttribute('TANGENT') && !overwrite) continue;
      const uvs = uvsOf(primitive), why = whyNoTangents(primitive, uvs);
      if (why) {
        logger.warn(`tangents: ${name} ${why}`);
        continue;
      }
      giveTangents(document, primitive, uvs, kind);
      ++count;
    }
    logger.debug(`tangents: ${count} primitives`);
  });
}

export function provoking(given) {
  const { vertex } = checked(given, { vertex: 'first' });
  choice(vertex, 'options.vertex', ['first', 'last']);
  return named('provoking', async (document) => {
    await ready;
    for (const { primitive, name } of primitivesOf(document)) {
      if (primitive.getMode() !== Primitive.Mode.TRIANGLES) {
        document.getLogger().warn(`provoking: ${name} is not a triangle list`);
        continue;
      }
      renumber(document, primitive, provokingOf(primitive.getAttribute('POSITION').getCount(), indicesOf(primitive), { vertex }));
    }
  });
}

const kCompressions = ['KHR_draco_mesh_compression', 'EXT_meshopt_compression', 'KHR_meshopt_compression'];

/** The document as plain glTF in memory. Geometry compression extensions are removed meanwhile, since they would need
 * encoders. AVIF normal maps, which the library does not know, are written as PNG, unless decode is null. */
async function asPlainGltf(document, decode) {
  const aside = document.getRoot().listExtensionsUsed().filter((extension) => kCompressions.includes(extension.extensionName))
    .map((extension) => ({ Type: extension.constructor, required: extension.isRequired(), options: extension._encoderOptions }));
  const pictures = new Map();
  for (const texture of decode ? normalMapsOf(document) : [])
    if (texture.getMimeType() === 'image/avif' && texture.getImage())
      pictures.set(texture, { image: texture.getImage(), mimeType: texture.getMimeType(), uri: texture.getURI(),
        png: await encodePng(await decode(texture.getImage(), texture.getName())) });
  for (const [texture, { png, uri }] of pictures) texture.setImage(png).setMimeType('image/png').setURI(uri && `${uri}.png`);
  for (const extension of document.getRoot().listExtensionsUsed())
    if (kCompressions.includes(extension.extensionName)) extension.dispose();
  try {
    const { json, resources } = await new WebIO().registerExtensions(document.getRoot().listExtensionsUsed().map((e) => e.constructor))
      .writeJSON(document);
    return { model: new TextEncoder().encode(JSON.stringify(json)), files: resources };
  } finally {
    for (const { Type, required, options } of aside) {
      const extension = document.createExtension(Type).setRequired(required);
      if (options) extension._encoderOptions = options;
    }
    for (const [texture, { image, mimeType, uri }] of pictures) texture.setImage(image).setMimeType(mimeType).setURI(uri);
  }
}

function replaceMap(document, map, { bytes, mimeType }) {
  const old = document.getRoot().listTextures()[map.image];
  const readers = [];
  for (const material of document.getRoot().listMaterials()) {
    const coat = material.getExtension('KHR_materials_clearcoat');
    if (material.getNormalTexture() === old) readers.push((texture) => material.setNormalTexture(texture));
    if (coat?.getClearcoatNormalTexture() === old) readers.push((texture) => coat.setClearcoatNormalTexture(texture));
  }
  const elsewhere = document.getGraph().listParentEdges(old).filter((edge) => edge.getParent().propertyType !== 'Root').length > readers.length;
  const texture = elsewhere ? old.clone() : old;
  if (elsewhere) readers.forEach((read) => read(texture));
  const uri = texture.getURI();
  const ending = { 'image/png': 'png', 'image/jpeg': 'jpg', 'image/webp': 'webp', 'image/ktx2': 'ktx2' }[mimeType];
  texture.setImage(bytes).setMimeType(mimeType).setURI(uri && `${uri.replace(/\.[^./]*$/, '')}${elsewhere ? '-normal' : ''}.${ending}`);
}

/** Replaces the extras of a material or primitive that begin with "cotan" (cotanFrame, cotanUnsigned) by those of the
 * conversion. */
function takeExtras(owner, extras = {}) {
  const ours = (entries, yes) => Object.fromEntries(Object.entries(entries).filter(([name]) => name.startsWith('cotan') === yes));
  owner.setExtras({ ...ours(owner.getExtras(), false), ...ours(extras, true) });
}

// The textures of a document that materials use as normal maps.
const normalMapsOf = (document) => [...new Set(document.getRoot().listMaterials().flatMap((material) =>
  [material.getNormalTexture(), material.getExtension('KHR_materials_clearcoat')?.getClearcoatNormalTexture()]).filter(Boolean))];
const imageBytes = (texture) => texture.getImage()?.byteLength ?? 0;
const arrayBytes = (accessors) => accessors.reduce((sum, accessor) => sum + (accessor.getArray()?.byteLength ?? 0), 0);

const tangentBytes = (document) => arrayBytes([...new Set([...primitivesOf(document)].flatMap(({ primitive }) =>
  [primitive, ...primitive.listTargets()].map((holder) => holder.getAttribute('TANGENT')).filter(Boolean)))]);

const kPackedFraction = 0.2; // file size of compressed geometry as a fraction of its size in memory

/** Estimated file size of the document, and the factor from bytes of geometry in memory to bytes in the file. */
function estimatedSize(document) {
  const root = document.getRoot(), packed = root.listExtensionsUsed().some((extension) => kCompressions.includes(extension.extensionName));
  const weight = packed ? kPackedFraction : 1;
  return { whole: root.listTextures().reduce((sum, texture) => sum + imageBytes(texture), 0) + weight * arrayBytes(root.listAccessors()), weight };
}

/** Removes the tangents that the converted model, as JSON, does not have. */
function dropTangentsAs(document, { meshes }) {
  document.getRoot().listMeshes().forEach((mesh, m) => mesh.listPrimitives().forEach((primitive, p) => {
    if (!('TANGENT' in (meshes?.[m]?.primitives[p]?.attributes ?? {}))) dropTangents(primitive);
  }));
}

/** texture() of cotan/textures, which is loaded when it is first needed. */
async function textureLoaded(...args) {
  const { ready: loaded, texture } = await import('../textures.js');
  await loaded;
  return texture(...args);
}

/** Converts the document, which is not changed: { report, made }. model: the document as plain glTF. made: the converted
 * model, parsed. */
async function converted(document, { model, files }, o) {
  const { glb, report } = await convert(model, { ...o, files, texture: textureLoaded }), textures = document.getRoot().listTextures();
  const maps = report.maps.map((map) => ({ ...map, bytes_before: imageBytes(textures[map.image]), ...(map.kept && { bytes_after: imageBytes(textures[map.image]) }) }));
  return { made: parsedModel(glb), report: { ...report, maps } };
}

function applyMaps(document, { made, report }, to) {
  const { json } = made, mapsOf = (material) => [material.normalTexture, material.extensions?.KHR_materials_clearcoat?.clearcoatNormalTexture];
  const remade = new Map(); // by texture of the document: the new file
  document.getRoot().listMaterials().forEach((material, m) => {
    const theirs = mapsOf(json.materials[m]);
    [material.getNormalTexture(), material.getExtension('KHR_materials_clearcoat')?.getClearcoatNormalTexture()].forEach((texture, k) => {
      const image = theirs[k] && imageOfTexture(json.textures[theirs[k].index]);
      if (texture && json.images?.[image]?.bufferView !== undefined) remade.set(texture, { bytes: imageIn(made, image).slice(), mimeType: json.images[image].mimeType });
    });
  });
  const textures = document.getRoot().listTextures(), files = report.maps.filter((map) => !map.kept).map((map) => [map, remade.get(textures[map.image])]);
  for (const [map, file] of files) replaceMap(document, map, file);
  dropTangentsAs(document, json);
  if (kTangentFrames.includes(to))
    document.getRoot().listMeshes().forEach((mesh, m) => mesh.listPrimitives().forEach((primitive, p) => {
      if ('TANGENT' in (json.meshes?.[m]?.primitives[p]?.attributes ?? {}) && !whyNoTangents(primitive, uvsOf(primitive))) giveTangents(document, primitive, uvsOf(primitive), to);
    }));
  document.getRoot().listMaterials().forEach((material, m) => takeExtras(material, json.materials?.[m]?.extras));
  document.getRoot().listMeshes().forEach((mesh, m) => mesh.listPrimitives().forEach((primitive, p) => takeExtras(primitive, json.meshes?.[m]?.primitives[p]?.extras)));
  return report;
}

/** Converts as `convert` does by default, but leaves the document as it is if maps with their green reversed would enlarge
 * the file by more than kGrowth allows. */
async function convertedByDefault(document, o) {
  const unlessUnavailable = (error) => { if (error.code !== 'unavailable') throw error; return asPlainGltf(document, null); };
  const model = await asPlainGltf(document, o.decode).catch(unlessUnavailable), found = await converted(document, model, o), { report } = found;
  const { whole, weight } = estimatedSize(document), grown = grownBy(report, weight);
  if (report.maps.every((map) => map.kept) || grown <= (kGrowth - 1) * whole) return found;
  const maps = report.maps.map(({ image, name, bytes_before: bytes }) => ({ image, name, kept: true, bytes_before: bytes, bytes_after: bytes }));
  return { made: parsedModel(model.model), report: { ...report, mode: 'keep', maps, decisions: [], tangents: { kept: true }, notes: [tooLarge(Math.round(whole), Math.round(whole + grown))] } };
}

function withFunctions(options) {
  checkTypes(options, 'function', 'decode', 'report');
  return options;
}

const kUntangent = { mode: undefined, from: undefined, to: undefined, bits: undefined, keepTangents: undefined, generateTangents: undefined, unsigned: undefined, maxDegrees: undefined, decode: decodeImage, report: undefined };

export function untangent(given) {
  const { mode: _, report, decode, ...o } = withFunctions(checked(given, kUntangent)), mode = modeOf(given);
  return named('untangent', async (document) => {
    await ready;
    const before = normalMapsOf(document).reduce((sum, texture) => sum + imageBytes(texture), 0) + tangentBytes(document);
    const requested = Object.fromEntries(Object.entries({ ...o, decode }).filter(([, value]) => value !== undefined));
    const made = mode === 'drop' ? await converted(document, await asPlainGltf(document, null), { mode }) : mode === 'convert'
      ? await converted(document, await asPlainGltf(document, decode), { ...requested, mode }) : await convertedByDefault(document, requested);
    const found = applyMaps(document, made, o.to);
    found.bytes = { before, after: normalMapsOf(document).reduce((sum, texture) => sum + imageBytes(texture), 0) + tangentBytes(document) };
    const remade = found.maps.filter((map) => !map.kept).length;
    for (const note of found.notes) document.getLogger().warn(`untangent: ${note}`);
    document.getLogger().info(`untangent: ${found.mode}: ${remade} maps remade, ${found.maps.length - remade} kept; normal maps and tangents ${found.bytes.before} bytes before, ${found.bytes.after} after`);
    report?.(found);
  });
}

export function lintNormals(given) {
  const { distance, limit, limitArea, frame, maxDegrees, decode, report } = withFunctions(checked(given, { distance: 0, limit: undefined, limitArea: undefined, frame: 'orthonormal', maxDegrees: undefined, decode: decodeImage, report: undefined }));
  return named('lintNormals', async (document) => {
    await ready;
    const { model, files } = await asPlainGltf(document, decode);
    const found = await lint(model, { files, distance, limit, limitArea, frame, maxDegrees, decode });
    document.getLogger().info(`lintNormals: ${found.recommendation}`);
    for (const warning of found.warnings) document.getLogger().warn(`lintNormals: ${warning}`);
    report?.(found);
    const [first, ...more] = found.over_limit;
    if (first) throw new CotanError('limit', more.length > 0 ? `${first.text} and ${more.length} more` : first.text);
  });
}

export { frames };
