// lint and convert for glTF models in memory.
import { checkTypes, isRecord, options } from './arrays.js';
import { CotanError, usage, wordsFor } from './instance.js';
import { kFunction } from './host.js';
import { bytesOf, checkedImage } from './image_checks.js';
import { encodedByCaller, encodedLike } from './encoded.js';
import { decodeImage as decodeOther, isKtx2 } from './image_files.js';
import { encodePng } from './png.js';
import { decodedUri, imageIn, parsedModel, requiredTypes, sizeOf, withImages } from './glb.js';
import { grownBy, inOriginalFormats, keptMaps, kGrowth, modeOf, tooLarge } from './modes.js';
import { kLimits, limitsOf, overLimits } from './verdict.js';

const same = (a, b) => a.length === b.length && a.every((byte, i) => byte === b[i]);
const kMapsRead = 1, kMapsUnread = 2; // keep_maps of cotan.h
// Placeholder for images that are not normal maps, whose pixels are never read.
const kUnread = { width: 1, height: 1, bits: 8, data: Uint8Array.of(255, 255, 255, 255) };
const kCommon = { files: {}, decode: decodeOther, progress: undefined };
const kConvert = {
  ...kCommon, mode: undefined, from: undefined, to: undefined, bits: 0, keepTangents: false, generateTangents: false, encode: encodePng, texture: undefined, unsigned: 'biased', fixGreen: false, maxDegrees: undefined,
};

// Replaces an error whose advice is to rebuild the library by one with advice for users of the npm package.
function withNpmAdvice(error) {
  const lacks = /^(.*?: )?not built with (Draco|meshoptimizer): /.exec(error.message);
  return lacks ? new CotanError('unavailable', `${lacks[1] ?? ''}expected uncompressed geometry, found ${lacks[2]} compression: use lintNormals and untangent `
    + "of cotan/gltf-transform, which decompress it with glTF-Transform's decoders") : error;
}

const kPackings = { libzstd: 'Zstandard', zlib: 'zlib', libastcenc: 'ASTC' }; // what the library's messages name

// Options with defaults filled in and types checked.
function modelOptions(given, known) {
  const o = options(given, known), refuse = (name, expected) => { throw usage(`options.${name}: expected ${expected}, found ${wordsFor(o[name])}`); };
  if (!isRecord(o.files)) refuse('files', 'an object that maps URIs to bytes');
  const files = Object.entries(o.files).map(([uri, bytes]) => [uri, bytesOf(bytes, `options.files['${uri}']`)]);
  o.files = Object.fromEntries([...files.map(([uri, bytes]) => [decodedUri(uri), bytes]), ...files]); // the library asks for decoded ones
  checkTypes(o, 'function', 'decode', 'encode', 'progress', 'texture');
  checkTypes(o, 'boolean', 'keepTangents', 'generateTangents', 'fixGreen');
  if (o.bits !== undefined && ![0, 8, 16].includes(o.bits)) refuse('bits', '0, 8 or 16');
  if (o.maxDegrees !== undefined && !(typeof o.maxDegrees === 'number' && o.maxDegrees > 0 && o.maxDegrees <= 180)) refuse('maxDegrees', 'a number of degrees above 0, at most 180');
  if (o.distance !== undefined && !Number.isFinite(o.distance)) refuse('distance', 'a number');
  return o;
}

export function modelFunctions(library, host, flipGreen) {
  /** Runs work(scratch, address of the model's bytes, address of the callbacks). more: further callbacks of `host`. */
  const withModel = (model, files, known, more, work) => library.run((s) => {
    const decode = (name, bytes) => {
      const found = known.find((image) => same(image.bytes, bytes));
      if (found?.error) throw found.error;
      return found?.image ?? kUnread;
    };
    const read = (uri) => (Object.hasOwn(files, uri) ? files[uri] : null);
    const f = s.wasm.cotan_js_function;
    try {
      return host.during({ scratch: s, read, decode, ...more }, () =>
        work(s, s.put(model), s.struct(0, f(kFunction.read), f(kFunction.decode), 0, f(kFunction.done))));
    } catch (error) {
      throw withNpmAdvice(error);
    }
  });

  const decodeKtx2 = (bytes, name) => library.run((s) => {
    const image = s.struct(0, 0, 0, 0);
    s.call('cotan_js_ktx2', s.put(new TextEncoder().encode(`${name}\0`)), s.put(bytes), bytes.length, image);
    const [, width, height, bits, pixels] = s.view(Uint32Array, image, 5), Type = { 8: Uint8Array, 16: Uint16Array, 32: Float32Array }[bits];
    try {
      return { width, height, bits, data: s.take(Type, pixels, 4 * width * height) };
    } finally {
      s.wasm.free(pixels);
    }
  });
  const decodeBy = (decode, bytes, name) => {
    try {
      return isKtx2(bytes) ? decodeKtx2(bytes, name) : decode(bytes, name);
    } catch (error) {
      const lacks = /not built with (\w+)/.exec(error.message)?.[1];
      throw lacks ? new CotanError('unavailable', `${name}: KTX2 with ${kPackings[lacks] ?? 'BC6H'} is read by the command line, not here`) : error;
    }
  };
  const decodeImage = async (bytes, name = 'image') => decodeBy(decodeOther, bytesOf(bytes, 'bytes'), name);

  /** The normal maps of a model, decoded by options.decode; the library decodes KTX2 itself. A failure is thrown only when
   * the library needs the map. */
  async function decoded(model, o) {
    const known = [];
    const takeFile = (name, bytes) => { known.push({ name, bytes }); };
    withModel(model, o.files, known, { takeFile }, (s, at, files) =>
      s.call('cotan_gltf_images', at, model.length, files, 1, s.wasm.cotan_js_function(kFunction.takeFile), 0));
    for (const image of known.filter(({ bytes }) => !isKtx2(bytes))) {
      try {
        image.image = checkedImage(await o.decode(image.bytes, image.name), 'options.decode', [8, 16]);
      } catch (error) {
        image.error = error instanceof CotanError ? error : new CotanError('input', `${image.name}: ${error?.message ?? error}`);
      }
    }
    return known;
  }

  const takeBytes = (s, slot) => {
    const at = s.view(Uint32Array, slot, 1)[0];
    if (at === 0) return null;
    const bytes = s.take(Uint8Array, s.wasm.cotan_bytes_data(at) >>> 0, s.wasm.cotan_bytes_size(at) >>> 0);
    s.wasm.cotan_bytes_free(at);
    return bytes;
  };
  const json = (bytes) => JSON.parse(new TextDecoder().decode(bytes));
  const progressOf = (s, progress) => (progress ? s.wasm.cotan_js_function(kFunction.progress) : 0);

  // The library takes 0 for no limit, so a limit of 0 becomes a tiny positive one.
  const limitOf = (limit) => (limit === undefined ? 0 : Math.max(limit, 1e-9));

  async function lint(given, more) {
    const model = bytesOf(given, 'model');
    const o = modelOptions(more, { ...kCommon, distance: 0, maxDegrees: undefined, ...kLimits });
    const limits = limitsOf(o);
    const known = await decoded(model, o);
    return withModel(model, o.files, known, { progress: o.progress }, (s, at, files) => {
      const report = s.put(new Uint32Array(1)), settings = s.allocate(56), frame = s.text(limits.frame, 'options.frame');
      s.view(Uint32Array, settings, 12).set([56, 0, 0, 0, progressOf(s, o.progress), 0, 0, 0, 0, 0, frame, 0]);
      s.view(Float64Array, settings + 8, 1)[0] = o.distance;
      s.view(Float64Array, settings + 24, 2).set([limits.limit, limits.limitArea].map(limitOf));
      s.view(Float64Array, settings + 48, 1)[0] = o.maxDegrees ?? 0;
      s.call('cotan_lint_gltf', at, model.length, files, settings, 0, report);
      const found = json(takeBytes(s, report));
      return { ...found, over_limit: overLimits(found, limits) };
    });
  }

  async function convert(given, more) {
    const model = bytesOf(given, 'model'), o = modelOptions(more, kConvert), mode = modeOf(more), parsed = parsedModel(model);
    if (!parsed) return convertMaps(model, o); // throws an error that says what is wrong
    if (o.fixGreen) return withFixedGreen(model, parsed, o, { ...more, fixGreen: undefined });
    const before = sizeOf(model, parsed.json, o.files), convertTo = (to) => convertMaps(model, { ...o, to }).then((made) => inOriginalFormats(parsed, o, made));
    const found = mode === 'convert' ? await convertTo(o.to ?? 'cotangent') : mode === 'drop' ? await withMapsKept(model, parsed, o, kMapsUnread) : await byDefault(model, parsed, o, before);
    return { glb: found.glb, report: { mode: 'convert', ...found.report, bytes: { before, after: found.glb.length } } };
  }

  /** Keeps the maps. Where tangents reverse green of one, the library reverses the map's green or keeps the tangents.
   * keepMaps: kMapsRead or kMapsUnread, which decodes no map and reverses none. */
  async function withMapsKept(model, parsed, o, keepMaps, more) {
    const made = await convertMaps(model, { ...o, to: undefined, bits: 0, keepMaps, ...more });
    const { glb, report } = keepMaps === kMapsRead ? await inOriginalFormats(parsed, o, made) : { ...made, report: { ...made.report, maps: keptMaps(parsed.json, o.files) } };
    const given = (parsed.json.meshes ?? []).some((mesh) => mesh.primitives?.some(({ attributes }) => attributes && 'TANGENT' in attributes));
    return { glb, report: { ...report, mode: given && !report.tangents.dropped_primitives ? 'keep' : 'drop' } };
  }

  // Flips green of the maps in which, by their own evidence, it points the other way than the model says; then converts.
  async function withFixedGreen(model, parsed, o, more) {
    const report = await lint(model, { files: o.files, decode: o.decode });
    const wrong = report.maps.filter((map) => map.decided && !map.as_declared && !map.reversed_by_tangents); // others are right with their tangents
    if (wrong.length === 0) return convert(model, more);
    const { glb: whole } = await withMapsKept(model, parsed, o, kMapsUnread, { keepTangents: true }), inside = parsedModel(whole), flipped = new Map(), notes = [];
    for (const { image, name } of wrong) {
      const file = imageIn(inside, image), pixels = checkedImage(await decodeBy(o.decode, file, name), 'options.decode', [8, 16]);
      const right = flipGreen(pixels), found = await encodedLike(right, file, await encodedByCaller(right, o.encode), name, { required: requiredTypes(inside.json), texture: o.texture });
      flipped.set(image, found);
      if (found.note) notes.push(found.note);
    }
    const made = await convert(withImages(inside, flipped), { ...more, files: undefined }), { glb } = made;
    return { glb, report: { ...made.report, bytes: { before: sizeOf(model, parsed.json, o.files), after: glb.length }, green_fixed: wrong.map(({ name }) => name),
      notes: [...wrong.map(({ name }) => `${name}: its green pointed opposite to what the model says and was reversed`), ...notes, ...made.report.notes] } };
  }

  // Drops the tangents that nobody misses, and keeps the maps. All tangents stay if a map cannot be decoded, since it is
  // not judged then, or if the file would grow by more than kGrowth.
  async function byDefault(model, parsed, o, before) {
    const unchanged = async (note) => {
      const { glb, report } = await withMapsKept(model, parsed, o, kMapsUnread, { keepTangents: true, from: undefined });
      return { glb, report: { ...report, notes: [note, ...report.notes] } };
    };
    const found = await withMapsKept(model, parsed, o, kMapsRead).catch((error) => { if (error.code !== 'unavailable') throw error; return error; });
    if (found instanceof CotanError) return unchanged(`${found.message}; its maps are not judged and its tangents stay`);
    const grown = grownBy(found.report);
    return grown <= (kGrowth - 1) * before ? found : unchanged(tooLarge(before, before + grown));
  }

  async function convertMaps(model, o) {
    const known = o.keepMaps === kMapsUnread ? [] : await decoded(model, o);
    let conversion = 0, wasm;
    const images = withModel(model, o.files, known, { progress: o.progress }, (s, at, files) => {
      wasm = s.wasm;
      const settings = s.allocate(56);
      s.view(Uint32Array, settings, 11).set([56, s.text(o.from, 'options.from'), s.text(o.to, 'options.to'), o.bits, o.keepTangents ? 1 : 0,
        o.generateTangents ? 1 : 0, 1, progressOf(s, o.progress), 0, s.text(o.unsigned, 'options.unsigned'), o.keepMaps ?? 0]);
      s.view(Float64Array, settings + 48, 1)[0] = o.maxDegrees ?? 0;
      const slot = s.put(new Uint32Array(1));
      s.call('cotan_convert_begin', at, model.length, files, settings, 0, slot);
      conversion = s.view(Uint32Array, slot, 1)[0];
      return Array.from({ length: s.wasm.cotan_conversion_count(conversion) }, (_, i) => {
        const image = s.struct(0, 0, 0, 0);
        s.call('cotan_conversion_image', conversion, i, image);
        const [, width, height, bits, pixels] = s.view(Uint32Array, image, 5);
        return { width, height, bits, data: s.take(bits === 16 ? Uint16Array : Uint8Array, pixels, 4 * width * height) };
      });
    });
    try {
      const made = [];
      for (const image of images) made.push({ image, ...await encodedByCaller(image, o.encode) });
      return library.run((s) => {
        if (s.wasm !== wasm) throw new CotanError('unavailable', 'the library was restarted during the conversion; convert again');
        made.forEach(({ bytes }, i) => s.call('cotan_conversion_set', conversion, i, s.put(bytes), bytes.length));
        const glb = s.put(new Uint32Array(1)), report = s.put(new Uint32Array(1));
        s.call('cotan_convert_end', conversion, glb, report);
        return { glb: takeBytes(s, glb), report: json(takeBytes(s, report)), made };
      });
    } finally {
      library.run((s) => { if (s.wasm === wasm) wasm.cotan_conversion_free(conversion); });
    }
  }

  return { lint, convert, decodeImage };
}
