// The modes of dropping tangents: with the maps as they are, or with new ones.
import { choice } from './arrays.js';
import { usage, wordsFor } from './errors.js';
import { imageFile, imageSize, modelBytes, normalImages, parsedModel, withImages } from './glb.js';
import { encodeLossy, lossyFormat } from './pictures.js';

export const kGrowth = 1.02; // file size after over before: the maximum in mode auto
const kReversed = 0.9; // fraction of a map's area; the library has the same threshold

/** The mode that the caller chose, by `mode` or by an option that implies new maps; undefined for auto. */
export function modeOf(given) {
  const more = ['from', 'to', 'bits', 'keepTangents', 'generateTangents', 'unsigned'].find((name) => given?.[name] !== undefined);
  const mode = choice(given?.mode ?? 'auto', 'options.mode', ['auto', 'drop', 'convert']);
  if (mode === 'drop' && more) throw usage(`options.${more}: expected none with mode drop, which makes no maps; found ${wordsFor(given[more])}`);
  return mode === 'auto' ? (more ? 'convert' : undefined) : mode;
}

/** Indices of the images whose stored tangents contradict the uv on at least 90 % of their area, from a lint report. */
export function reversedImages({ primitives }) {
  const areas = new Map(); // by image: [area with tangents, area with reversed tangents]
  for (const { normal_map: image, stored_tangents: stored, uv } of primitives) {
    if (!stored || !(uv?.area > 0)) continue;
    const [all, reversed] = areas.get(image) ?? [0, 0];
    areas.set(image, [all + uv.area, reversed + uv.area * stored.reversed_w]);
  }
  return [...areas].filter(([, [all, reversed]]) => reversed >= kReversed * all).map(([image]) => image);
}

/** What a lint report advises: { mode, to, green, degrees }. green: names of maps that show dents without the stored
 * tangents, which contradict the uv on at least 90 % of the area. degrees: maximum mean error of `orthonormal`. */
export function advised(report) {
  const { maps, maps_converted: toConvert, advice, fits } = report, mapOf = (image) => maps.find((one) => one.image === image);
  const green = reversedImages(report).filter((image) => !(mapOf(image)?.decided && mapOf(image).as_declared)).map((image) => mapOf(image)?.name ?? `image ${image}`);
  const degrees = fits.map((fit) => fit.orthonormal?.mean).filter((mean) => typeof mean === 'number');
  return { mode: toConvert > 0 || green.length > 0 ? 'convert' : 'drop', to: toConvert > 0 ? advice : 'orthonormal', green, degrees: Math.max(0, ...degrees) };
}

const withoutMaps = ({ normalTexture, extensions, ...rest }) => {
  const { KHR_materials_clearcoat: coat, ...others } = extensions ?? {}, { clearcoatNormalTexture, ...coatRest } = coat ?? {};
  return { ...rest, ...(extensions && { extensions: { ...others, ...(coat && { KHR_materials_clearcoat: coatRest }) } }) };
};

/** The model with its maps unchanged, without tangents unless keepTangents is set. convert: the library's conversion,
 * which gets the model without normal maps, so that it decodes none. */
export async function dropped(parsed, files, convert, keepTangents = false) {
  const { json } = parsed, { materials } = json;
  const plain = Array.isArray(materials) ? { ...parsed, json: { ...json, materials: materials.map((one) => (one && typeof one === 'object' ? withoutMaps(one) : one)) } } : parsed;
  const { glb, report } = await convert(modelBytes(plain), { files, from: 'orthonormal', to: 'orthonormal', keepTangents });
  const made = parsedModel(glb);
  if (materials) made.json.materials = materials;
  const notes = report.notes.filter((line) => !/^(no primitive has a normal map|TANGENT is kept)/.test(line));
  return { mode: keepTangents ? 'keep' : 'drop', glb: modelBytes(made), report: { ...report, notes, maps: keptMaps(json, files) } };
}

/** The conversion's result with new maps in the format of the old ones, JPEG or WebP, if that is smaller than PNG. */
export async function inOriginalFormats(parsed, files, { glb, report, pictures }) {
  const made = parsedModel(glb), other = new Map(), notes = [], maps = report.maps.map((map) => ({ ...map })), remade = maps.filter((map) => !map.kept);
  for (const [k, map] of remade.entries()) {
    const format = pictures[k].bits === 8 ? lossyFormat(imageFile(parsed, map.image, files)) : null;
    if (!format || map.kept_elsewhere) continue;
    const bytes = await encodeLossy(pictures[k], format);
    if (!bytes) notes.push(`${map.name}: no encoder for ${format.mimeType} is available (in Node.js: the package sharp), so the new map is PNG: ${map.bytes_after} bytes, before ${map.bytes_before}`);
    if (!bytes || bytes.length >= map.bytes_after) continue;
    other.set(map.image, { bytes, mimeType: format.mimeType });
    Object.assign(map, { bytes_after: bytes.length, format: format.mimeType === 'image/webp' ? 'WebP' : 'JPEG', quality: format.quality ?? null });
  }
  const whole = other.size > 0 && made.json.buffers?.length === 1 ? withImages(made, other) : glb;
  return { mode: 'convert', glb: whole, report: { ...report, maps, notes: [...report.notes, ...notes] } };
}

const keptMaps = (json, files) => normalImages(json).map((image) => {
  const bytes = imageSize(json.images?.[image], json, files), { name, uri } = json.images?.[image] ?? {};
  return { image, name: name ?? (uri && !uri.startsWith('data:') ? uri : `image ${image}`), kept: true, bytes_before: bytes, bytes_after: bytes };
});

const amount = (bytes) => `${bytes} bytes`;

/** The note for new maps that would enlarge the file too much. */
export const notWorthIt = (to, degrees, before, after) =>
  `maps remade for the frame ${to} would reduce the error by ${degrees.toFixed(1)} degrees and change the file from ${amount(before)} to ${amount(after)}: the maps are kept and read with orthonormal; mode 'convert' remakes them`;
/** The note for tangents that stay. */
export const needsTangents = (green, why) =>
  `tangents are kept: they reverse green of ${green.join(', ')}, and without them bumps would look like dents; ${why}`;
