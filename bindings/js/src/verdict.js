// The findings of a lint report that exceed given limits: `over_limit` of `cotan lint --json`
// (src/bake/lint/lint_limits.cpp), for limits other than those that the report was made with.
import { choice, options } from './arrays.js';
import { usage, wordsFor } from './errors.js';
import { rotatedOf } from './old_names.js';

const kFrames = ['cotangent', 'orthonormal', 'smooth', 'exact', 'triangle', 'stored'];

/** Formats a number like printf's %.3g. */
export function threeDigits(value) {
  const [mantissa, exponent] = value.toExponential(2).split('e');
  if (Number(exponent) >= -4 && Number(exponent) < 3) return String(Number(value.toPrecision(3)));
  return `${Number(mantissa)}e${exponent[0]}${exponent.slice(1).padStart(2, '0')}`;
}

function nameOf({ mesh, material, placing, placings }, index) {
  const name = `${mesh || `primitive ${index}`}${material ? `, material ${material}` : ''}`;
  return placings > 1 ? `${name}, node scaling ${placing + 1} of ${placings}` : name;
}

/** Limits that a caller passes, documented in types/cotan.d.ts. */
export const kLimits = { limit: undefined, limitArea: undefined, frame: 'orthonormal' };
export function limitsOf({ limit, limitArea, frame }) {
  for (const [value, name, maxValue] of [[limit, 'limit', 180], [limitArea, 'limitArea', 100]])
    if (value !== undefined && !(typeof value === 'number' && value >= 0 && value <= maxValue)) throw usage(`options.${name}: expected a number from 0 to ${maxValue}, found ${wordsFor(value)}`);
  return { limit, limitArea, frame: choice(frame, 'options.frame', kFrames) };
}

/** One object for each finding. A map whose green points the other way than the file says exceeds any limit. */
export function overLimits(report, given) {
  const { limit, limitArea, frame } = limitsOf(options(given, kLimits));
  const { primitives, maps: images } = report ?? {};
  if (!Array.isArray(primitives) || !Array.isArray(images) || primitives.findIndex((p) => !p?.uv) >= 0 || images.findIndex((map) => !map) >= 0) throw usage(`report: expected a report of lint, found ${wordsFor(report)}`);
  const over = [];
  const add = (kind, text, { mesh, material, map, degrees = null, percent = null, limit: maxValue = null }) =>
    over.push({ kind, mesh: mesh || null, material: material || null, map: map || null, degrees, percent, limit: maxValue, text });
  if (limit === undefined && limitArea === undefined) return over;
  primitives.forEach((p, index) => {
    const name = nameOf(p, index), mapped = p.normal_map >= 0;
    if (limit !== undefined && mapped && / not read$/.test(p.not_judged)) add('not_judged', `${name}: not judged, ${p.not_judged}`, { mesh: p.mesh, material: p.material });
    const check = (kind, value, maxValue, what, unit, words) => {
      if (maxValue !== undefined && typeof value === 'number' && value > maxValue)
        add(kind, `${name}: ${what} ${threeDigits(value)} ${words}, limit ${threeDigits(maxValue)}`, { mesh: p.mesh, material: p.material, [unit]: value, limit: maxValue });
    };
    check('reading', p.read_with?.[frame]?.percentile95, limit, `95th percentile of the error with ${frame}`, 'degrees', 'degrees');
    if (mapped) check('rounding', p.rounding_degrees, limit, 'rounding', 'degrees', 'degrees');
    for (const [kind, fraction, what] of [['degenerate_uv', p.uv.degenerate, 'degenerate uv on'],
      ['mirrored_overlap', p.uv.overlapping_mirrored, 'uv overlapping in both orientations on'],
      ['reversed_w', p.stored_tangents?.reversed_w, 'TANGENT.w contradicting the uv on'], ['rotated_tangents', rotatedOf(p.stored_tangents), 'stored tangents rotated on']])
      check(kind, typeof fraction === 'number' ? 100 * fraction : undefined, limitArea, what, 'percent', '% of the area');
  });
  for (const { name, image, confidence } of images.filter((map) => map.decided && !map.as_declared)) {
    const map = name || `image ${image}`;
    add('reversed_green', `normal map ${map}: green points opposite to what the file says (${confidence})`, { map });
  }
  const maps = primitives.filter((p) => p.normal_map >= 0);
  if (limit !== undefined && maps.length > 0 && maps.every((p) => p.not_judged) && over.length === 0)
    add('not_judged', 'no normal map could be judged', {});
  return over;
}
