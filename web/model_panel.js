// What is found of a model, the two halves of its picture, and the converted file.
import { choice, degrees, download, el, size, table } from './elements.js';
import { cotan } from './library.js';
import { divider } from './divider.js';
import { loadModel } from './model_load.js';
import { modelView } from './model_view.js';

const kFrames = {
  tangents: 'stored tangents', auto: 'auto: as the maps were made', orthonormal: 'orthonormal (nothing stored)', cotangent: 'cotangent (nothing stored)',
  smooth: 'smooth (cotangents at the vertices)', triangle: 'triangle (two vectors a triangle)',
};
const kMapsAfter = { '': 'as they are where that is near enough', orthonormal: 'made again for orthonormal', cotangent: 'made again for cotangent', smooth: 'made again for smooth' };
const kScales = { 2: '0 to 2°', 10: '0 to 10°', 45: '0 to 45°' };
let open; // the view on screen: there is one at a time

export async function showModel(result, files) {
  const { name } = files.model, library = await cotan();
  const [gltf, lint] = await Promise.all([loadModel(files), library.lint(files).catch(error => ({ error }))]);
  open?.close();
  const canvas = el('canvas', { tabindex: 0, 'aria-label': `${name}, drawn with two frames. Drag to turn it.` });
  const view = open = modelView(canvas);
  let stored = false;
  gltf.scene.traverse(object => { stored ||= object.isMesh && object.geometry.attributes.tangent !== undefined; });
  const names = stored ? kFrames : { ...kFrames, tangents: 'MikkTSpace tangents, made here' };
  const chosen = { left: 'tangents', right: 'auto' };
  const halves = divider(canvas, share => { view.share = share; }, [names.tangents, names.auto]);
  const under = el('p', { role: 'status', class: 'small' }), figures = el('p', {}), notes = el('p', { class: 'small' });
  const pick = (label, side) => choice(label, names, chosen[side], value => { chosen[side] = value; changed(); });
  const mode = el('input', { type: 'checkbox', onchange: () => { view.angle = mode.checked; scale.hidden = !mode.checked; } });
  const scaleChoice = choice('Colours', kScales, '10', value => { view.most = Number(value); });
  const scale = el('div', { hidden: true }, el('div', { class: 'scale' }), scaleChoice.element);
  const saved = el('p', { role: 'status' }), button = el('button', { type: 'button', class: 'main', onclick: convert }, wrongGreen(lint).length > 0 ? 'Fix green and download' : 'Convert and download');
  const to = choice('Its normal maps', kMapsAfter, '', () => {});

  result.replaceChildren(el('div', { class: 'result' },
    el('div', {}, ...verdictOf(lint, name),
      el('h2', { class: 'part' }, 'The file without tangents'), el('div', { class: 'choices' }, to.element, button), saved,
      ...(lint.maps?.length > 0 ? linesFor(lint) : []),
      ...(lint.error ? [] : checkOf(lint, name, library))),
    el('figure', { class: 'view' }, canvas, halves.element,
      el('div', { class: 'choices' }, pick('Left', 'left').element, pick('Right', 'right').element, el('label', { class: 'tick' }, mode, 'Show the angle between them')),
      scale, figures, notes, under,
      el('figcaption', {}, 'Drag turns, the wheel comes nearer. The number under the pointer is the angle between the normals of both halves.'))));
  view.open(gltf);
  await changed();
  let resting;
  canvas.addEventListener('pointermove', event => {
    clearTimeout(resting);
    if (event.buttons) return;
    const box = canvas.getBoundingClientRect(), place = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    resting = setTimeout(() => {
      const angle = view.at(...place);
      under.textContent = angle === undefined ? 'Beside the model.' : `Under the pointer: ${degrees(angle)} between both normals.`;
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
    if (!canvas.isConnected) { requestAnimationFrame(measure); return; }
    const found = view.statistics();
    figures.textContent = found ? `Over what is visible, the two are apart by ${degrees(found.mean)} in the mean, by ${degrees(found.most)} or less on 95 % of it.` : '';
    canvas.parentElement.dataset.shows = view.names.join(' ');
    view.show();
  }
  async function convert() {
    button.disabled = true;
    saved.textContent = 'Converting …';
    try {
      const made = await library.convert(files, { to: to.select.value || undefined, fixGreen: wrongGreen(lint).length > 0 });
      download(made.glb, `${name.replace(/\.[^.]*$/, '')}_${to.select.value || 'free'}.glb`, 'model/gltf-binary');
      saved.textContent = savedWords(made);
    } catch (error) {
      saved.textContent = error.message;
    }
    button.disabled = false;
  }
}

// Maps whose green points the other way than the model says, with no tangents that mean it so.
function wrongGreen(lint) {
  const meant = new Set((lint.primitives ?? []).filter(({ stored_tangents: stored }) => stored?.reversed_w > 0.5).map(({ normal_map: image }) => image));
  return (lint.maps ?? []).filter(map => map.decided && !map.as_declared && !meant.has(map.image));
}

// The lines for a program in three.js that needs no new file.
function linesFor(lint) {
  const wrong = wrongGreen(lint).length > 0, all = wrong && wrongGreen(lint).length === lint.maps.length;
  return [el('h2', { class: 'part' }, 'Without a new file'), el('p', {}, 'In three.js, after the model is loaded:'), el('pre', { tabindex: 0 }, el('code', { 'data-paste': '' },
    `import { untangle } from 'cotan/three';\nuntangle(gltf${all ? ", { convention: 'directx' }" : ''});${wrong ? '\n\n// or, with three alone, of each material once:\nmaterial.normalScale.y *= -1;' : ''}`))];
}

// The verdict of the library in a few words, and its own.
function verdictOf(lint, name) {
  if (lint.error) return [el('p', { class: 'verdict' }, 'The model is drawn, but it could not be judged.'), el('p', {}, lint.error.message)];
  const green = lint.maps.some(map => map.decided && !map.as_declared), changes = lint.maps_converted > 0, empty = lint.maps.length === 0;
  const reversed = lint.primitives.some(({ stored_tangents: stored }) => stored?.reversed_w > 0.5), distrusted = lint.distrust_stored;
  const words = empty ? 'It has no normal map: there is nothing to judge.'
    : green && reversed ? 'Green and the stored tangents are both reversed: together they are right, each alone is not.'
      : green ? 'Green of a normal map points the other way than the model says: bumps look like dents.'
        : distrusted ? `Its stored tangents contradict its texture coordinates${reversed ? ': without them green is read as they mean it' : ''}.`
          : changes ? `Without stored tangents its maps have to be made again for the frame ${lint.advice}.`
            : lint.advice ? `It needs no stored tangents: its maps are read as they are, with the frame ${lint.advice}.`
              : 'None of its normal maps was judged as a whole.';
  const off = frame => {
    const means = lint.fits.map(fit => fit[frame].mean).filter(mean => typeof mean === 'number');
    return means.length > 0 ? degrees(Math.max(...means)) : undefined;
  };
  return [el('p', { class: `verdict ${green || distrusted ? 'bad' : empty || changes || !lint.advice ? '' : 'good'}` }, words),
    el('p', {}, lint.recommendation),
    table(`What is found in ${name}`, [
      ['file', name], ['primitives, normal maps', `${lint.primitives.length}, ${lint.maps.length}`],
      ['maps as they are, read by orthonormal: off by', off('orthonormal')], ['by cotangent', off('cotangent')], ['by smooth', off('smooth')],
    ]),
    el('p', { class: 'small' }, 'Degrees: mean over the surface, of the worst of the maps, where they were made for MikkTSpace.')];
}

// The same check that the command line makes: a limit, whether the model keeps it, and the report as a file.
function checkOf(lint, name, library) {
  const verdict = el('p', { role: 'status', 'data-check': '' }), lines = el('ul', { class: 'small' });
  const field = (label, unit, value, max) => {
    const input = el('input', { type: 'number', min: 0, max, step: 'any', value, onchange: judge });
    return { element: el('label', {}, label, el('span', { class: 'unit' }, input, unit)), value: () => input.value === '' || !input.validity.valid ? undefined : Number(input.value) };
  };
  const limit = field('At most off by, on 95 % of the area', ' °', 2, 180), area = field('At most contradictory', ' % of the area', undefined, 100);
  const limits = () => ({ limit: limit.value(), limitArea: area.value() });
  let over = [];
  async function judge() {
    over = await library.overLimits(lint, limits());
    const none = Object.values(limits()).every(value => value === undefined);
    verdict.textContent = none ? 'No limit is set.' : over.length === 0 ? 'The check passes.' : `The check fails: ${over.length === 1 ? 'one thing is' : `${over.length} things are`} over the limit.`;
    lines.replaceChildren(...over.slice(0, 5).map(({ text }) => el('li', {}, text)), ...(over.length > 5 ? [el('li', {}, `and ${over.length - 5} more`)] : []));
  }
  judge();
  const save = () => download(new TextEncoder().encode(`${JSON.stringify({ model: name, ...lint, limits: limits(), over_limit: over }, null, 2)}\n`), `${name.replace(/\.[^.]*$/, '')}_lint.json`, 'application/json');
  return [el('h2', { class: 'part' }, 'A check'), el('div', { class: 'choices' }, limit.element, area.element), verdict, lines,
    el('button', { type: 'button', onclick: save }, 'Download the report (JSON)')];
}

function savedWords({ report, unpacked }) {
  const made = report.maps.filter(map => !map.kept), off = made.map(map => map.degrees_after_rounding?.mean).filter(mean => typeof mean === 'number');
  const { before, after } = report.bytes, fixed = report.green_fixed ?? [];
  return `${fixed.length > 0 ? `Green of ${fixed.join(', ')} is reversed; ` : ''}${made.length} ${made.length === 1 ? 'map' : 'maps'} made again, ${report.maps.length - made.length} kept, `
    + `${report.mode === 'keep' ? 'tangents kept' : `${size(report.tangents.bytes)} of tangents dropped`}; the file: ${size(before)} before, ${size(after)} after.${unpacked ? ' Its geometry is not compressed any more: glTF-Transform\u2019s untangent keeps that.' : ''}`
    + `${off.length > 0 ? ` With the new maps normals are off by ${degrees(Math.max(...off))}.` : ''}`
    + report.unread_maps.map(({ name, format, advice }) => ` ${name} is in ${format}, which is not read here, and stays with its tangents: ${advice}.`).join('')
    + (report.mode === 'convert' ? '' : report.notes.map(line => ` ${line}.`).join(''));
}
