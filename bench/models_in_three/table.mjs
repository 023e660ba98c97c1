// The table of measured models: node table.mjs RESULT [PAGE]. RESULT: the JSON file that measure.mjs writes. PAGE: a
// page whose table between the lines of kMarks is replaced; without it, the table is printed. Exit code 1 and a line
// for each bar that does not hold.
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

export const kMarks = ['<!-- table: bench/models-in-three writes it -->', '<!-- end of table -->'];
const kMean = 0.3, kP99 = 3, kKept = 5, kModels = 30, kStored = 15;
const kFactor = 1.3, kApart = 0.05; // of predictions
const kReversed = 0.02; // degrees by which reversed green must be nearer: below, the map has no green to speak of

const degrees = (value) => (value < 0.005 ? '0' : value < 10 ? value.toFixed(2) : value.toFixed(1));
const kibibytes = (value) => `${Math.round(value / 1024)}`;

// "orthonormal 5, tangents 2": the number of primitives for each frame.
function framesOf({ primitives }) {
  const counts = new Map(), seen = new Set();
  for (const { primitive, frame } of primitives) {
    if (seen.has(primitive)) continue;
    seen.add(primitive);
    counts.set(frame, (counts.get(frame) ?? 0) + 1);
  }
  return counts;
}

export const keepsTangents = (row) => framesOf(row).has('tangents');

// { predicted, measured } means over the whole surface, weighted by area; undefined if nothing is left. Of a primitive with
// two maps the one that is further off counts, as in the prediction. of: the prediction for a primitive. judged: which
// primitives count.
function surfaceMeans({ primitives }, of, judged = () => true) {
  const found = new Map();
  for (const one of primitives) {
    if (!judged(one)) continue;
    const { area, surface } = one, before = found.get(one.primitive);
    if (!(before?.measured >= surface)) found.set(one.primitive, { predicted: of(one), measured: surface, area });
  }
  const all = [...found.values()], area = all.reduce((sum, one) => sum + one.area, 0), mean = (name) => all.reduce((sum, one) => sum + one[name] * one.area, 0) / area;
  return area > 0 ? { predicted: mean('predicted'), measured: mean('measured') } : undefined;
}

const ofRule = ({ predicted }) => predicted;
const apart = (a, b) => Math.max(a, b) > kFactor * Math.min(a, b) && Math.abs(a - b) > kApart;

const kChoices = ['model', 'tangents', 'traits', 'what the rule took'];
const kNumbers = ['model', 'predicted', 'surface', 'mean', '95 %', '99 %', 'maximum', 'KiB saved', 'ms'];

const choiceOf = (row) => [row.name, row.stored ? 'stored' : 'MikkTSpace', row.traits.join(', '), [...framesOf(row)].map(([frame, count]) => `${frame} ${count}`).join(', ')];

function numbersOf(row) {
  const { predicted, measured } = surfaceMeans(row, ofRule);
  return [row.name, Number.isFinite(predicted) ? degrees(predicted) : '', degrees(measured), degrees(row.mean), degrees(row.p95), degrees(row.p99), degrees(row.max), kibibytes(row.savedBytes),
    row.milliseconds.toFixed(0)];
}

const lines = (header, rows, numbers) => [header, header.map((_, k) => (numbers && k ? '--:' : '---')), ...rows].map((cells) => `| ${cells.join(' | ')} |`).join('\n');

/** Two tables of the rows of `models`, without those that are extra: what was chosen, and what was measured. */
export function tableOf({ models }, extra = false) {
  const rows = models.filter((row) => !!row.extra === extra);
  return `${lines(kChoices, rows.map(choiceOf), false)}\n\nDegrees, memory and time:\n\n${lines(kNumbers, rows.map(numbersOf), true)}`;
}

/** A line for each bar that does not hold. */
export function brokenBars({ models }) {
  const rows = models.filter(({ extra }) => !extra), broken = [];
  if (rows.length !== kModels) broken.push(`expected ${kModels} models, found ${rows.length}`);
  const stored = rows.filter((row) => row.stored > 0).length, kept = rows.filter(keepsTangents).map(({ name }) => name);
  if (stored < kStored) broken.push(`expected at least ${kStored} models with stored tangents, found ${stored}`);
  if (kept.length > kKept) broken.push(`tangents are kept on ${kept.length} models, at most ${kKept} expected: ${kept.join('; ')}`);
  for (const { name, mean, p99, byArea, primitives } of rows) {
    if (!(mean < kMean && byArea.mean < kMean)) broken.push(`${name}: mean ${mean} degrees, by area ${byArea.mean}; less than ${kMean} expected`);
    if (!(p99 < kP99 && byArea.p99 < kP99)) broken.push(`${name}: ${p99} degrees at 99 %, by area ${byArea.p99}; less than ${kP99} expected`);
    for (const { primitive, kind, mean: own, reversedMean } of primitives)
      if (reversedMean < own - kReversed) broken.push(`${name}, mesh and primitive ${primitive}, ${kind}: ${own} degrees, ${reversedMean} with green reversed`);
  }
  otherwiseInViews({ models: rows }).farther.forEach((name) => broken.push(`${name}: farther from its reference in the six views than predicted`));
  return broken;
}

/** A line for each model whose predicted mean is not the one measured on its whole surface: by more than 0.05 degrees and
 * a factor of 1.3. lint: whether to take the predictions of `cotan lint`, where the result has them for the same frame.
 * Loaded tangents that are drawn are left out. */
export function wrongPredictions({ models }, { lint = false } = {}) {
  return models.flatMap((row) => {
    const of = (one) => (lint ? row.lint?.find(({ primitive, frame }) => primitive === one.primitive && frame === one.frame) : one)?.predicted;
    const found = surfaceMeans(row, of, (one) => !one.drawsLoaded && Number.isFinite(of(one)));
    return found && apart(found.predicted, found.measured) ? [`${row.name}: ${found.predicted.toPrecision(3)} degrees predicted${lint ? ' by lint' : ''}, ${found.measured.toPrecision(3)} measured`] : [];
  });
}

/** The names of models that the six views show nearer to their reference than predicted, by more than these margins; and of
 * those that they show farther from it. */
export function otherwiseInViews({ models }) {
  const of = (sign) => models.filter(({ extra }) => !extra).filter((row) => {
    const { predicted } = surfaceMeans(row, ofRule) ?? {};
    return Math.sign(row.byArea.mean - predicted) === sign && apart(row.byArea.mean, predicted);
  }).map(({ name }) => name);
  return { nearer: of(-1), farther: of(1) };
}

// In lines of at most 120 columns.
const folded = (text) => text.split(' ').reduce((lines, word) => (`${lines.at(-1)} ${word}`.length > 120 ? [...lines, word] : [...lines.slice(0, -1), `${lines.at(-1)} ${word}`.trim()]), ['']).join('\n');

function sentencesOf(result) {
  const kept = result.models.filter((row) => !row.extra && keepsTangents(row)).map(({ name }) => name), { nearer } = otherwiseInViews(result);
  const list = (names) => (names.length ? names.join('; ') : 'none');
  return folded(`Models with a primitive whose tangents stay: ${list(kept)}. Models that the six views show nearer to their reference than predicted, by more than ${kApart} degrees and a factor of ${kFactor}: ${list(nearer)}.`);
}

/** The page with the table in it. */
export function withTable(page, result) {
  const [before, rest] = page.split(kMarks[0]), after = rest?.split(kMarks[1])[1];
  if (after === undefined) throw Error(`the page lacks the lines ${kMarks.join(' and ')}`);
  return `${before}${kMarks[0]}\n${tableOf(result)}\n\n${sentencesOf(result)}\n${kMarks[1]}${after}`;
}

if (process.argv[1] && path.resolve(process.argv[1]) === fileURLToPath(import.meta.url)) {
  const [file, page] = process.argv.slice(2), result = JSON.parse(fs.readFileSync(file));
  if (page) fs.writeFileSync(page, withTable(fs.readFileSync(page, 'utf8'), result));
  else console.log(tableOf(result), result.models.some(({ extra }) => extra) ? `\n\nFurther models:\n\n${tableOf(result, true)}` : '');
  const broken = [...brokenBars(result), ...wrongPredictions(result), ...wrongPredictions(result, { lint: true })];
  broken.forEach((line) => console.error(line));
  process.exitCode = broken.length ? 1 : 0;
}
