// What the library decided for each part of a model, in plain words.
import { degrees, el } from './elements.js';

const kRows = 8; // shown; the worst first
const kMade = {
  orthonormal: 'no tangents', triangle: 'two vectors for each triangle, made when it is loaded', smooth: 'two vectors at each vertex, made when it is loaded',
  mikktspace: 'tangents that are made when it is loaded',
};

// Elements with the decisions of a lint report; none if nothing reads a normal map.
export function partsOf({ decisions = [], primitives = [] }) {
  const names = primitives.filter(({ placing }) => placing === 0).map(({ mesh, material }) => mesh || material);
  const rows = decisions.filter(({ reason }) => reason !== 'no_map').map(decision => rowOf(decision, names[decision.mesh]));
  if (rows.length === 0) return [];
  rows.sort((a, b) => b.stays - a.stays || b.off - a.off);
  const cells = (tag, texts) => el('tr', {}, ...texts.map((text, k) => el(k === 0 ? 'th' : tag, { scope: k === 0 && tag === 'td' ? 'row' : tag === 'th' && 'col' }, text)));
  const caption = 'What each part needs to look as with its tangents';
  return [el('h3', {}, caption), el('div', { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': caption }, el('table', { 'data-parts': '' },
    el('thead', {}, cells('th', ['part', 'needs', 'off on average', 'off on 1 % of the area'])),
    el('tbody', {}, ...rows.slice(0, kRows).map(({ texts }) => cells('td', texts))))),
  ...(rows.length > kRows ? [el('p', { class: 'small' }, `and ${rows.length - kRows} more, which are nearer`)] : [])];
}

function rowOf({ mesh, reason, frame, tangents_stay: stays, candidates, not_judged: why }, name) {
  const chosen = candidates.find(one => one.frame === frame && one.stored === stays);
  const needs = reason === 'not_judged' ? `${stays ? 'its tangents' : 'unknown'}: not judged, ${why}`
    : reason === 'named' ? `the frame ${frame}, which the file names`
      : stays ? `its tangents: without them it is off by ${offOf(nearest(candidates))}`
        : reason === 'keeps' ? `more than can be made: drawn with ${frame}` : `${kMade[frame]} (${frame})`;
  const shown = value => (typeof value === 'number' ? degrees(value) : '');
  return { stays, off: chosen?.mean ?? 0, texts: [name || `part ${mesh + 1}`, needs, shown(chosen?.mean), shown(chosen?.percentile99)] };
}

const offOf = ({ mean, percentile99 }) => `${degrees(mean)} on average and ${degrees(percentile99)} on 1 % of the area`;
const nearest = candidates => candidates.filter(one => !one.stored).reduce((best, one) => (one.mean < best.mean ? one : best));
