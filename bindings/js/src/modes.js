// The modes of dropping tangents: with the maps as they are, or with new ones.
import { choice } from './arrays.js';
import { usage, wordsFor } from './errors.js';
import { imageFile, imageSize, normalImages, parsedModel, requiredTypes, withImages } from './glb.js';
import { encodedLike, kVisible } from './encoded.js';

export const kGrowth = 1.02; // file size after over before: the maximum in mode auto

/** The mode that the caller chose, by `mode` or by an option for new maps only; undefined for auto. */
export function modeOf(given) {
  const first = (...names) => names.find((name) => given?.[name] !== undefined), converts = first('to', 'bits', 'keepTangents');
  const more = converts ?? first('from', 'generateTangents', 'unsigned', 'maxDegrees');
  const mode = choice(given?.mode ?? 'auto', 'options.mode', ['auto', 'drop', 'convert']);
  if (mode === 'drop' && more) throw usage(`options.${more}: expected none with mode drop, which measures nothing and makes no maps; found ${wordsFor(given[more])}`);
  return mode === 'auto' ? (converts ? 'convert' : undefined) : mode;
}

/** Degrees on average that a format may lose of a new map: what the library's own encoders may. */
function allowedLoss({ green_reversed: greenReversed, degrees_after_rounding: after, degrees_unconverted: before }) {
  return greenReversed ? kVisible : Math.max(kVisible, 0.5 * (before?.mean ?? 0)) - (after?.mean ?? 0);
}

/** The conversion's result with new maps in the format of the old ones, as encodedLike makes them. texture: of cotan/textures, if given. */
export async function inOriginalFormats(parsed, { files, texture }, { glb, report, made: pngs }) {
  const made = parsedModel(glb), other = new Map(), notes = [], maps = report.maps.map((map) => ({ ...map })), remade = maps.filter((map) => !map.kept);
  for (const [k, map] of remade.entries()) {
    const { image, ...png } = pngs[k], old = imageFile(parsed, map.image, files);
    const { bytes, mimeType, note, ...found } = map.kept_elsewhere ? png : await encodedLike(image, old, png, map.name,
      { required: requiredTypes(parsed.json), texture, loss: allowedLoss(map) });
    if (note) notes.push(note);
    if (mimeType !== png.mimeType) other.set(map.image, { bytes, mimeType });
    Object.assign(map, { bytes_after: bytes.length, degrees_of_encoding: found.degrees, ...(found.format && { format: found.format, quality: found.quality }) });
  }
  const whole = other.size > 0 && made.json.buffers?.length === 1 ? withImages(made, other) : glb;
  return { glb: whole, report: { ...report, maps, notes: [...report.notes, ...notes] } };
}

/** The maps of a report on a model whose maps stay as they are. */
export const keptMaps = (json, files) => normalImages(json).map((image) => {
  const bytes = imageSize(json.images?.[image], json, files), { name, uri } = json.images?.[image] ?? {};
  return { image, name: name ?? (uri && !uri.startsWith('data:') ? uri : `image ${image}`), kept: true, bytes_before: bytes, bytes_after: bytes };
});

const amount = (bytes) => `${bytes} bytes`;

/** Bytes by which new maps and dropped tangents enlarge a file. weight: of a byte of tangents. */
export const grownBy = ({ maps, tangents }, weight = 1) => maps.reduce((sum, map) => sum + map.bytes_after - map.bytes_before, 0) - weight * (tangents.bytes ?? 0);

/** The note for maps with their green reversed that would enlarge the file too much. */
export const tooLarge = (before, after) => `maps with their green reversed would change the file from ${amount(before)} to ${amount(after)}: maps and tangents are kept`;
