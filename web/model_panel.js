// The panel for a model: the findings, a view in two halves, and the converted file.
import { choice, degrees, download, el, numberField, size, smallFiles, table } from './elements.js';
import { library } from './library.js';
import { partsOf } from './parts_table.js';
import { divider } from './divider.js';

const kFrames = {
  tangents: 'stored tangents', auto: 'without tangents where nobody can see it', orthonormal: 'orthonormal (nothing stored)', cotangent: 'cotangent (nothing stored)',
  smooth: 'smooth (cotangents at the vertices)', triangle: 'triangle (two vectors per triangle)',
};
const kMapsAfter = { '': 'kept, with a frame for each part', orthonormal: 'remade for orthonormal', cotangent: 'remade for cotangent', smooth: 'remade for smooth' };
const kMaxDegrees = 0.3; // on average: the default of the library
const kScales = { 2: '0 to 2°', 10: '0 to 10°', 45: '0 to 45°' };
let open; // { view }: what belongs to the model on screen, at most one; view: undefined until it is loaded

// Shows the verdict. The view follows when it is loaded, which may take many times as long.
export async function showModel(result, files) {
  const { name } = files.model, lint = await library.lint(files).catch(error => {
    if (!['unavailable', 'limit'].includes(error.code)) throw error; // others may still be drawn
    return { error };
  });
  open?.view?.close();
  open = {};
  const saved = el('p', { role: 'status' }), button = el('button', { type: 'button', class: 'main', onclick: convert }, wrongGreen(lint).length > 0 ? 'Fix green and download' : 'Convert and download');
  const to = choice('Normal maps', kMapsAfter, '', () => {}), parts = el('div', {}, ...partsOf(lint));
  const limit = numberField('A part may be off on average by', ' °', kMaxDegrees, { min: 0.001, max: 180 }, decideAgain), figure = el('figure', { class: 'view' }, el('p', { role: 'status', class: 'small' }, 'The view is loading …'));
  result.replaceChildren(el('div', { class: 'result' },
    el('div', {}, ...verdictOf(lint, name),
      el('h2', { class: 'part' }, 'The file without tangents'), el('div', { class: 'choices' }, limit.element, to.element, button), saved, parts,
      ...(lint.maps?.length > 0 ? linesFor(lint) : []),
      ...(lint.error ? [] : checkOf(lint, name))),
    figure));
  showView(figure, files, open).catch(error => {
    figure.replaceChildren(el('p', { class: 'small' }, `The view could not be drawn: ${error.message}`));
    if (!['CotanError', 'Error'].includes(error.name)) console.error(error);
  });

  // The library decides; the view follows.
  async function decideAgain() {
    const mine = open, maxDegrees = limit.value();
    if (lint.error) return;
    try {
      const found = await library.lint(files, { maxDegrees });
      if (open !== mine || limit.value() !== maxDegrees) return;
      parts.replaceChildren(...partsOf(found));
      await mine.decide?.(maxDegrees);
    } catch (error) {
      parts.replaceChildren(el('p', {}, error.message));
    }
  }

  async function convert() {
    button.disabled = true;
    saved.textContent = 'Converting …';
    try {
      const made = await library.convert(files, { ...(to.select.value ? { to: to.select.value } : { maxDegrees: limit.value() }), fixGreen: wrongGreen(lint).length > 0 });
      download(made.glb, `${name.replace(/\.[^.]*$/, '')}_${to.select.value || 'free'}.glb`, 'model/gltf-binary');
      saved.textContent = savedWords(made);
    } catch (error) {
      saved.textContent = error.message;
    }
    button.disabled = false;
  }
}

// Fills the figure with the view in two halves. mine: as `open`, which is another object when another model is shown.
async function showView(figure, files, mine) {
  const { name } = files.model, [{ loadModel }, { modelView }] = await Promise.all([import('./model_load.js'), import('./model_view.js')]);
  const gltf = await loadModel(files);
  if (open !== mine) return;
  const canvas = el('canvas', { tabindex: 0, 'aria-label': `${name}, drawn with two frames. Drag to rotate it.` });
  const view = mine.view = modelView(canvas);
  let isStored = false, isMapped = false;
  gltf.scene.traverse(({ isMesh, geometry, material }) => {
    isStored ||= isMesh && geometry.attributes.tangent !== undefined;
    isMapped ||= isMesh && [material].flat().some(one => one.normalMap || one.clearcoatNormalMap);
  });
  const names = isStored ? kFrames : { ...kFrames, tangents: 'MikkTSpace tangents, generated here' };
  const chosen = { left: 'tangents', right: 'auto' };
  const halves = divider(canvas, share => { view.share = share; }, [names.tangents, names.auto]);
  const under = el('p', { role: 'status', class: 'small' }), figures = el('p', {}), notes = el('p', { class: 'small' });
  const pick = (label, side) => choice(label, names, chosen[side], value => { chosen[side] = value; changed(); });
  const mode = el('input', { type: 'checkbox', onchange: () => { view.angle = mode.checked; scale.hidden = !mode.checked; } });
  const scaleChoice = choice('Colours', kScales, '10', value => { view.most = Number(value); });
  const scale = el('div', { hidden: true }, el('div', { class: 'scale' }), scaleChoice.element);

  view.open(gltf);
  mine.decide = maxDegrees => { view.maxDegrees = maxDegrees; return changed(); };
  await changed();
  if (open !== mine) return;
  figure.replaceChildren(canvas, halves.element,
    el('div', { class: 'choices' }, pick('Left', 'left').element, pick('Right', 'right').element, el('label', { class: 'tick' }, mode, 'Show the angle between them')),
    scale, figures, notes, under,
    el('figcaption', {}, 'Drag to rotate, use the wheel to zoom. Rest the pointer on the model to see the angle between the normals of the two halves.'));
  let resting;
  canvas.addEventListener('pointermove', event => {
    clearTimeout(resting);
    if (event.buttons) return;
    const box = canvas.getBoundingClientRect(), place = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    resting = setTimeout(() => {
      const angle = view.at(...place);
      under.textContent = angle === undefined ? 'The pointer is not on the model.' : `Under the pointer: ${degrees(angle)} between the two normals.`;
    }, 60);
  });
  canvas.addEventListener('pointerup', () => setTimeout(measure, 100));

  async function changed() {
    await view.choose(chosen.left, chosen.right);
    halves.rename([names[chosen.left], names[chosen.right]]);
    notes.textContent = view.notes.join('. ');
    setTimeout(measure, 0);
  }
  function measure() {
    if (open !== mine) return;
    if (!canvas.isConnected) { requestAnimationFrame(measure); return; }
    const found = isMapped ? view.statistics() : undefined;
    figures.textContent = found ? `Over the visible surface, the normals of the two halves differ by ${degrees(found.mean)} on average, by at most ${degrees(found.most)} on 95 % of it.`
      : isMapped ? '' : 'No normal map is drawn: both halves are the same.';
    figure.dataset.shows = view.names.join(' ');
    view.show();
  }
}

// Maps whose green points the other way than the model says, unless stored tangents reverse it too.
const wrongGreen = lint => (lint.maps ?? []).filter(map => map.decided && !map.as_declared && !map.reversed_by_tangents);

// Code for three.js that works without a new file.
function linesFor(lint) {
  const wrong = wrongGreen(lint).length > 0, all = wrong && wrongGreen(lint).length === lint.maps.length;
  return [el('h2', { class: 'part' }, 'Without a new file'), el('p', {}, 'In three.js, after the model is loaded:'), el('pre', { tabindex: 0 }, el('code', { 'data-paste': '' },
    `import { untangle } from 'cotan/three';\nuntangle(gltf${all ? ", { convention: 'directx' }" : ''});${wrong ? '\n\n// or, with three alone, of each material once:\nmaterial.normalScale.y *= -1;' : ''}`))];
}

// A short verdict, the library's recommendation and a table of figures.
function verdictOf(lint, name) {
  if (lint.error) return [el('p', { class: 'verdict' }, 'The model could not be checked.'), el('p', {}, lint.error.message)];
  const green = lint.maps.some(map => map.decided && !map.as_declared), stay = lint.primitives_keeping, empty = lint.maps.length === 0;
  const reversed = lint.primitives.some(({ stored_tangents: stored }) => stored?.reversed_w > 0.5), distrusted = lint.distrust_stored;
  const mapped = lint.decisions.filter(({ reason }) => reason !== 'no_map').length;
  const words = empty ? 'It has no normal map: there is nothing to judge.'
    : wrongGreen(lint).length > 0 ? 'Green of a normal map points opposite to what the model says: bumps look like dents.'
      : green ? 'Green and the stored tangents are both reversed: together they cancel out, each alone is wrong.'
        : distrusted ? `Its stored tangents contradict its texture coordinates${reversed ? ': without them green is read as they imply' : ''}.`
          : stay > 0 ? `Without stored tangents ${stay} of its ${mapped} parts would look different: ${stay === 1 ? 'it keeps' : 'those keep'} them.`
            : lint.advice ? 'It needs no stored tangents: its maps are read as they are.'
              : 'None of its normal maps was judged as a whole.';
  const off = frame => {
    const means = lint.fits.map(fit => fit[frame].mean).filter(mean => typeof mean === 'number');
    return means.length > 0 ? degrees(Math.max(...means)) : undefined;
  };
  return [el('p', { class: `verdict ${green || distrusted ? 'bad' : empty || stay > 0 || !lint.advice ? '' : 'good'}` }, words),
    el('p', {}, lint.recommendation),
    table(`Findings for ${name}`, [
      ['file', name], ['primitives, normal maps', `${lint.primitives.length}, ${lint.maps.length}`],
      ['error of unchanged maps with orthonormal', off('orthonormal')], ['with cotangent', off('cotangent')], ['with smooth', off('smooth')],
    ]),
    el('p', { class: 'small' }, 'Degrees: mean over the surface, of the worst map, if the maps were made for MikkTSpace.'),
    ...(empty ? [] : [smallFiles()])];
}

// The check of the command line: fields for the limits, the verdict, and the report as a file.
function checkOf(lint, name) {
  const verdict = el('p', { role: 'status', 'data-check': '' }), lines = el('ul', { class: 'small' });
  const limit = numberField('Maximum error on 95 % of the area', ' °', 2, { max: 180 }, judge), area = numberField('Maximum area with bad uv or tangents', ' %', undefined, { max: 100 }, judge);
  const limits = () => ({ limit: limit.value(), limitArea: area.value() });
  let over = [];
  async function judge() {
    over = await library.overLimits(lint, limits());
    const none = Object.values(limits()).every(value => value === undefined);
    verdict.textContent = none ? 'No limit is set.' : over.length === 0 ? 'The check passes.' : `The check fails: ${over.length === 1 ? 'one finding is' : `${over.length} findings are`} over the limit.`;
    lines.replaceChildren(...over.slice(0, 5).map(({ text }) => el('li', {}, text)), ...(over.length > 5 ? [el('li', {}, `and ${over.length - 5} more`)] : []));
  }
  judge();
  const save = () => download(new TextEncoder().encode(`${JSON.stringify({ model: name, ...lint, limits: limits(), over_limit: over }, null, 2)}\n`), `${name.replace(/\.[^.]*$/, '')}_lint.json`, 'application/json');
  return [el('h2', { class: 'part' }, 'Check'), el('div', { class: 'choices' }, limit.element, area.element), verdict, lines,
    el('button', { type: 'button', onclick: save }, 'Download the report (JSON)')];
}

function savedWords({ report, unpacked }) {
  const made = report.maps.filter(map => !map.kept), off = made.filter(map => typeof map.degrees_after_rounding?.mean === 'number')
    .map(map => map.degrees_after_rounding.mean + map.degrees_of_encoding);
  const { before, after } = report.bytes, fixed = report.green_fixed ?? [];
  return `${fixed.length > 0 ? `Green of ${fixed.join(', ')} was reversed; ` : ''}${made.length} ${made.length === 1 ? 'map' : 'maps'} remade, ${report.maps.length - made.length} kept, `
    + `${report.mode === 'keep' ? 'tangents kept' : `${size(report.tangents.bytes)} of tangents dropped`}; the file: ${size(before)} before, ${size(after)} after.${unpacked ? ' Its geometry is no longer compressed; glTF-Transform\u2019s untangent keeps the compression.' : ''}`
    + `${off.length > 0 ? ` With the new maps the error of the normals is ${degrees(Math.max(...off))} on average.` : ''}`
    + report.unread_maps.map(({ name, format, advice }) => ` ${name} is in ${format}, which is not supported; it and its tangents are unchanged: ${advice}.`).join('')
    + (report.mode === 'convert' ? '' : report.notes.map(line => ` ${line}.`).join(''));
}
