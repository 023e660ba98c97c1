// The page of bench/models-in-three: node models_table_test.mjs [CASE]
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';
import { here, runCases } from './shared.mjs';
import { brokenBars, kMarks, otherwiseInViews, tableOf, withTable, wrongPredictions } from '../../bench/models_in_three/table.mjs';

const root = path.join(here, '../..'), [only] = process.argv.slice(2);

/** Thirty models that keep every bar; each with the changes that `change` makes in its row. */
function thirty(change = () => {}) {
  const models = Array.from({ length: 30 }, (_, k) => {
    const primitives = [{ primitive: '0, 0', kind: 'normal', frame: k < 5 ? 'tangents' : 'smooth', predicted: 0.1, surface: 0.12, area: 3, mean: 0.2, reversedMean: 9 },
      { primitive: '1, 0', kind: 'normal', frame: 'orthonormal', predicted: 0.2, surface: 0.2, area: 1, mean: 0.2, reversedMean: 9 }];
    const row = { name: `model ${k}`, traits: ['skin', 'Draco'], stored: k < 15 ? 2 : 0, generated: k < 15 ? 0 : 2, savedBytes: 2048, milliseconds: 12.4, mean: 0.2, p95: 1, p99: 2.5, max: 20,
      byArea: { mean: 0.15, p99: 2.5 }, primitives };
    change(row, k);
    return row;
  });
  return { models };
}

const cases = {
  everyBrokenBarIsNamed() {
    assert.deepEqual(brokenBars(thirty()), []);
    assert.equal(brokenBars({ models: thirty().models.slice(1) }).length, 2, 'one model less, one with stored tangents less');
    const last = (change) => brokenBars(thirty((row, k) => { if (k === 29) change(row); }));
    for (const [change, expected] of [
      [(row) => { row.mean = 0.3; }, /^model 29: mean 0.3 degrees/],
      [(row) => { row.byArea.mean = 0.31; row.primitives.forEach((one) => { one.predicted = 0.29; }); }, /^model 29: mean 0.2 degrees, by area 0.31/],
      [(row) => { row.byArea.mean = 0.19; }, /^model 29: farther from its reference in the six views than predicted/],
      [(row) => { row.p99 = 3; }, /^model 29: 3 degrees at 99 %/],
      [(row) => { row.primitives[1].frame = 'tangents'; }, /^tangents are kept on 6 models, at most 5 expected: .*model 29/],
      [(row) => { row.primitives[1].reversedMean = 0.1; }, /^model 29, mesh and primitive 1, 0, normal: 0.2 degrees, 0.1 with green reversed/],
    ]) {
      const broken = last(change);
      assert.equal(broken.length, 1);
      assert.match(broken[0], expected);
    }
  },

  predictionsThatDifferFromTheMeasuredDegreesAreNamed() {
    const primitives = (predicted, surface) => ({ models: [{ name: 'one', primitives: [{ primitive: '0, 0', predicted, surface, area: 3 }, { primitive: '1, 0', predicted: 1, surface: 1, area: 1 }] }] });
    assert.deepEqual(wrongPredictions(primitives(0.2, 0.26)), [], 'by 1.1 with the second primitive');
    assert.deepEqual(wrongPredictions({ models: [{ name: 'one', primitives: [{ predicted: 0.01, surface: 0.05, area: 1 }] }] }), [], 'by less than 0.05 degrees');
    assert.deepEqual(wrongPredictions(primitives(1, 2)), ['one: 1.00 degrees predicted, 1.75 measured']);
    // Two maps of one primitive: the one that is further off counts, and once.
    const coats = { models: [{ name: 'one', primitives: [{ primitive: '0, 0', predicted: 0.2, surface: 0.1, area: 1 }, { primitive: '0, 0', predicted: 0.2, surface: 0.2, area: 1 }] }] };
    assert.deepEqual(wrongPredictions(coats), []);
    const lint = { models: [{ name: 'one', primitives: [{ primitive: '0, 0', frame: 'smooth', surface: 1, area: 1 }], lint: [{ primitive: '0, 0', frame: 'smooth', predicted: 0.5 }] }] };
    assert.deepEqual(wrongPredictions(lint), []);
    assert.deepEqual(wrongPredictions(lint, { lint: true }), ['one: 0.500 degrees predicted by lint, 1.00 measured']);
  },

  viewsMayBeNearerThanPredictedAndAreNamed() {
    const { models } = thirty((row, k) => { row.byArea.mean = [0.06, 0.08, 0.15, 0.19][k] ?? 0.125; }); // 0.125 predicted
    assert.deepEqual(otherwiseInViews({ models }), { nearer: ['model 0'], farther: ['model 3'] });
  },

  furtherModelsAreNotCounted() {
    const { models } = thirty(), more = { ...models[0], name: 'further', extra: true, mean: 9 };
    assert.deepEqual(brokenBars({ models: [...models, more] }), []);
    assert.ok(!tableOf({ models: [...models, more] }).includes('further'));
    assert.ok(tableOf({ models: [...models, more] }, true).includes('further'));
  },

  aRowHasWhatWasMeasured() {
    const [row] = thirty().models; // predicted: (0.1 * 3 + 0.2) / 4; surface: (0.12 * 3 + 0.2) / 4
    const lines = tableOf({ models: [row] }).split('\n');
    assert.equal(lines[2], '| model 0 | stored | skin, Draco | tangents 1, orthonormal 1 |');
    assert.equal(lines.at(-1), '| model 0 | 0.13 | 0.14 | 0.20 | 1.00 | 2.50 | 20.0 | 2 | 12 |');
    const page = withTable(`a\n${kMarks[0]}\nold\n${kMarks[1]}\nb\n`, { models: [row] });
    assert.ok(page.startsWith(`a\n${kMarks[0]}\n${tableOf({ models: [row] })}\n`) && page.endsWith(`\n${kMarks[1]}\nb\n`) && !page.includes('old'));
    assert.match(page, /Models with a primitive whose tangents stay: model 0\./);
    assert.throws(() => withTable('no marks', { models: [row] }), /lacks the lines/);
  },

  thePageShowsItsNumbersAndAllBarsHold() {
    const result = JSON.parse(fs.readFileSync(path.join(root, 'docs/explanation/models.json'), 'utf8'));
    const page = fs.readFileSync(path.join(root, 'docs/explanation/models.md'), 'utf8');
    assert.equal(withTable(page, result), page);
    assert.deepEqual([...brokenBars(result), ...wrongPredictions(result), ...wrongPredictions(result, { lint: true })], []);
    assert.ok(result.models.every(({ lint }) => lint?.length), 'measure with COTAN, so that predictions of lint are compared, too');
    const list = JSON.parse(fs.readFileSync(path.join(root, 'bench/models_in_three/models.json'), 'utf8')).models;
    assert.deepEqual(result.models.filter(({ extra }) => !extra).map(({ name }) => name), list.map(({ name }) => name));
  },
};
await runCases(cases, only);
