// Dropping tangents: with the maps as they are, or with new ones.
import { choice } from './arrays.js';
import { usage, wordsFor } from './errors.js';
import { imageFile, imageSize, modelBytes, normalImages, parsedModel, withImages } from './glb.js';
import { encodeLossy, lossyFormat } from './pictures.js';

export const kGrowth = 1.02; // of the file: what new maps may cost where nobody asked for them
const kReversed = 0.9; // of a map's area: as the library has it

/** The mode that a caller has chosen, by itself or by what only new maps have; undefined: the model decides. */
export function modeOf(given) {
  const more = ['from', 'to', 'bits', 'keepTangents', 'generateTangents', 'unsigned'].find((name) => given?.[name] !== undefined);
  const mode = choice(given?.mode ?? 'auto', 'options.mode', ['auto', 'drop', 'convert']);
  if (mode === 'drop' && more) throw usage(`options.${more}: expected none with mode drop, which makes no maps; found ${wordsFor(given[more])}`);
  return mode === 'auto' ? (more ? 'convert' : undefined) : mode;
}

/** Images whose stored tangents contradict the uv on nine tenths of their area, by a report of lint. */
export function reversedImages({ primitives }) {
  const areas = new Map(); // all with tangents, and reversed
  for (const { normal_map: image, stored_tangents: stored, uv } of primitives) {
    if (!stored || !(uv?.area > 0)) continue;
    const [all, reversed] = areas.get(image) ?? [0, 0];
    areas.set(image, [all + uv.area, reversed + uv.area * stored.reversed_w]);
  }
  return [...areas].filter(([, [all, reversed]]) => reversed >= kReversed * all).map(([image]) => image);
}

/** What a report of lint asks for: { mode, to, green }. green: names of maps that mean the other green than the file says, by
 * tangents that contradict the uv on nine tenths of their area: without them they show dents. */
export function advised(report) {
  const { maps, maps_converted: toConvert, advice, fits } = report, mapOf = (image) => maps.find((one) => one.image === image);
  const green = reversedImages(report).filter((image) => !(mapOf(image)?.decided && mapOf(image).as_declared)).map((image) => mapOf(image)?.name ?? `image ${image}`);
  const off = fits.map((fit) => fit.orthonormal?.mean).filter((mean) => typeof mean === 'number');
  return { mode: toConvert > 0 || green.length > 0 ? 'convert' : 'drop', to: toConvert > 0 ? advice : 'orthonormal', green, off: Math.max(0, ...off) };
}

const withoutMaps = ({ normalTexture, extensions, ...rest }) => {
  const { KHR_materials_clearcoat: coat, ...others } = extensions ?? {}, { clearcoatNormalTexture, ...coatRest } = coat ?? {};
  return { ...rest, ...(extensions && { extensions: { ...others, ...(coat && { KHR_materials_clearcoat: coatRest }) } }) };
};

/** The model without tangents, or with them, all else as it is. convert: of the library, which is shown a model without normal
 * maps, so that it decodes none. */
export async function dropped(parsed, files, convert, keepTangents = false) {
  const { json } = parsed, { materials } = json;
  const plain = Array.isArray(materials) ? { ...parsed, json: { ...json, materials: materials.map((one) => (one && typeof one === 'object' ? withoutMaps(one) : one)) } } : parsed;
  const { glb, report } = await convert(modelBytes(plain), { files, from: 'orthonormal', to: 'orthonormal', keepTangents });
  const made = parsedModel(glb);
  if (materials) made.json.materials = materials;
  const notes = report.notes.filter((line) => !/^(no primitive has a normal map|TANGENT stays)/.test(line));
  return { mode: keepTangents ? 'keep' : 'drop', glb: modelBytes(made), report: { ...report, notes, maps: keptMaps(json, files) } };
}

/** What convert made, with maps in the format that they had where that is smaller: JPEG and WebP with their quality. */
export async function inOldFormats(parsed, files, { glb, report, pictures }) {
  const made = parsedModel(glb), other = new Map(), notes = [], maps = report.maps.map((map) => ({ ...map })), remade = maps.filter((map) => !map.kept);
  for (const [k, map] of remade.entries()) {
    const format = pictures[k].bits === 8 ? lossyFormat(imageFile(parsed, map.image, files)) : null;
    if (!format || map.kept_elsewhere) continue;
    const bytes = await encodeLossy(pictures[k], format);
    if (!bytes) notes.push(`${map.name}: stays PNG, ${map.bytes_after} bytes for ${map.bytes_before}: there is no encoder for ${format.mimeType} here (in node the package sharp)`);
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

/** Said where new maps would cost more than they gain. */
export const notWorthIt = (to, off, before, after) =>
  `maps made anew for the frame ${to} would gain ${off.toFixed(1)} degrees and make the file ${amount(after)} of ${amount(before)}: they stay as they are, read with orthonormal; mode 'convert' makes them`;
/** Said where tangents stay. */
export const needsTangents = (green, why) =>
  `tangents stay: they reverse green of ${green.join(', ')}, and without them bumps would be dents; ${why}`;
