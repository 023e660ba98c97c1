// What of a lint report is over the limits that a caller sets: the texts of `check` in the report (src/lint/limits.cpp),
// for other limits than it was made with.
import { choice, options } from './arrays.js';
import { usage, wordsFor } from './errors.js';

const kFrames = ['cotangent', 'orthonormal', 'smooth', 'exact', 'triangle', 'stored'];

/** Three digits, as printf's %.3g writes them. */
export function threeDigits(value) {
  const [mantissa, exponent] = value.toExponential(2).split('e');
  if (Number(exponent) >= -4 && Number(exponent) < 3) return String(Number(value.toPrecision(3)));
  return `${Number(mantissa)}e${exponent[0]}${exponent.slice(1).padStart(2, '0')}`;
}

function nameOf({ mesh, material, placing, placings }, index) {
  const name = `${mesh || `primitive ${index}`}${material ? `, material ${material}` : ''}`;
  return placings === 1 ? name : `${name}, stretched by its nodes in ${placings} ways, number ${placing + 1}`;
}

/** Limits as a caller gives them: see types/cotan.d.ts. */
export const kLimits = { limit: undefined, limitArea: undefined, frame: 'orthonormal' };
export function limitsOf({ limit, limitArea, frame }) {
  for (const [value, name, most] of [[limit, 'limit', 180], [limitArea, 'limitArea', 100]])
    if (value !== undefined && !(value >= 0 && value <= most)) throw usage(`options.${name}: expected a number from 0 to ${most}, found ${wordsFor(value)}`);
  return { limit, limitArea, frame: choice(frame, 'options.frame', kFrames) };
}

/** One line each; a map whose green points the other way than the file says is over any limit. */
export function overLimits(report, given) {
  const { limit, limitArea, frame } = limitsOf(options(given, kLimits));
  const { primitives, maps: images } = report ?? {};
  if (!Array.isArray(primitives) || !Array.isArray(images) || !primitives.every((p) => p?.uv)) throw usage(`report: expected what lint gives, found ${wordsFor(report)}`);
  const lines = [];
  const check = (name, value, most, what, unit) => {
    if (most !== undefined && typeof value === 'number' && value > most) lines.push(`${name}: ${what} ${threeDigits(value)} ${unit}, limit ${threeDigits(most)}`);
  };
  if (limit === undefined && limitArea === undefined) return lines;
  primitives.forEach((p, index) => {
    const name = nameOf(p, index), mapped = p.normal_map >= 0;
    if (limit !== undefined && mapped && / not read$/.test(p.not_judged)) lines.push(`${name}: not judged, ${p.not_judged}`);
    check(name, p.read_with?.[frame]?.percentile95, limit, `95 % of the error of reading with ${frame}`, 'degrees');
    if (mapped) check(name, p.rounding_degrees, limit, 'rounding', 'degrees');
    for (const [share, what] of [[p.uv.degenerate, 'degenerate uv on'], [p.uv.overlapping_mirrored, 'uv overlapping in both orientations on'],
      [p.stored_tangents?.reversed_w, 'TANGENT.w against the uv on'], [p.stored_tangents?.turned, 'stored tangents turned on']])
      check(name, typeof share === 'number' ? 100 * share : undefined, limitArea, what, '% of the area');
  });
  for (const map of images.filter((map) => map.decided && !map.as_declared))
    lines.push(`normal map ${map.name || `image ${map.image}`}: green points the other way than the file says (${map.confidence})`);
  const maps = primitives.filter((p) => p.normal_map >= 0);
  if (limit !== undefined && maps.length > 0 && maps.every((p) => p.not_judged) && lines.length === 0)
    lines.push('no normal map could be judged');
  return lines;
}
