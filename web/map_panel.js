// The panel for a normal map: the findings, a preview and the fixed file.
import { choice, degrees, download, el, percent, smallFiles, table } from './elements.js';
import { library } from './library.js';
import { divider } from './divider.js';
import { mapView } from './map_view.js';

// Names of the programs for each convention of the command line.
const kEngines = {
  gltf: 'glTF, three.js, Babylon.js', opengl: 'OpenGL (green up)', directx: 'DirectX (green down)', unity: 'Unity', unreal: 'Unreal Engine',
  blender: 'Blender', godot: 'Godot', maya: 'Maya', '3dsmax': '3ds Max', source: 'Source',
};
const kGreenDown = new Set(['directx', 'unreal', '3dsmax', 'source']);

export async function showMap(result, name, image) {
  const text = language => library.shader({ language, frame: 'cotangent', convention: 'gltf,exact' });
  const canFix = library.convertMap(image, { from: 'auto', to: 'gltf' }).then(() => true, error => { if (error.code !== 'input') throw error; return false; });
  const [green, info, essl, wgsl, known] = await Promise.all([library.detect(image), library.info(image), text('essl'), text('wgsl'), canFix]);
  const preview = mapView({ essl, wgsl }, { 'aria-label': 'The map as a relief, lit from the position of the pointer' });
  preview.put('before', image);
  const words = greenWords(green, info), verdict = el('p', {}), advice = el('p', {});
  const button = el('button', { type: 'button', class: 'main', onclick: save }, 'Download the fixed map');
  const command = el('code', {});
  const inThree = el('p', { class: 'small', hidden: true }, 'Without a new file, in three.js: ', el('code', { 'data-paste': '' }, 'material.normalScale.y *= -1;'));
  const isDown = green.green === 'down', isBroken = green.green === 'unknown' || green.swapped === true || info.transfer !== 'linear';
  let target = isDown ? 'gltf' : 'unreal', fixed;
  const engine = choice('Your engine or format', kEngines, target, value => { target = value; fix(); });
  const halves = divider(preview.element, share => preview.show(share), ['original', 'fixed']);

  const newName = () => `${name.replace(/\.[^.]*$/, '')}_${target}.png`;
  async function fix() {
    const wanted = target, down = kGreenDown.has(target), fits = !known || (down === isDown && !isBroken);
    const made = !known ? image : await library.convertMap(image, { from: 'auto', to: wanted });
    if (wanted !== target) return;
    fixed = made;
    preview.greenDown = down;
    preview.put('after', fixed);
    preview.show(halves.share());
    verdict.className = `verdict ${!known ? '' : fits ? 'good' : 'bad'}`;
    verdict.textContent = !known ? words
      : fits ? `Green is right for ${kEngines[target]}.` : isBroken ? `The map is broken; the fixed one is right for ${kEngines[target]}.` : `Green points the wrong way for ${kEngines[target]}: bumps look like dents.`;
    advice.textContent = words;
    advice.hidden = button.disabled = !known;
    inThree.hidden = !(target === 'gltf' && isDown);
    command.textContent = `cotan map convert ${quoted(name)} --from auto --to ${target} -o ${quoted(newName())}`;
  }
  async function save() {
    download(await library.encodePng(fixed), newName(), 'image/png');
  }

  result.replaceChildren(el('div', { class: 'result' },
    el('div', {}, verdict, advice, el('div', { class: 'choices' }, engine.element, button),
      table('Statistics of the map', rows(name, image, green, info)),
      !known ? undefined : el('p', { class: 'small' }, 'On the command line: ', command), inThree, smallFiles()),
    el('figure', { class: 'view' }, preview.element, halves.element,
      el('figcaption', {}, 'Move the pointer over the image to move the light. Left: the original map as your engine reads it.'))));
  await Promise.all([fix(), preview.ready]);
}

// A name of a file as a word of a command line.
const quoted = name => (/^[\w.][\w.-]*$/.test(name) ? name : `"${name.replace(/^-/, './-').replace(/["\\$`]/g, '\\$&')}"`);

function greenWords({ green, confidence, swapped, reason }, info) {
  if (green === 'unknown') return `Nothing in this map shows which way green points${reason ? `: ${reason}` : ''}.`;
  const way = green === 'up' ? 'up (OpenGL, glTF, Unity, Blender, Godot)' : 'down (DirectX, Unreal, 3ds Max, Source)';
  return `Green points ${way}; ${confidence}.${swapped ? ' Red and green are exchanged.' : ''}${info.transfer !== 'linear'
    ? ' The values look as if the map was stored as a colour (sRGB): export it as data ("non-colour").' : ''}`;
}

function rows(name, { width, height, bits, data }, { agreement, green }, info) {
  return [
    ['file', `${name}, ${width} x ${height}, ${bits} bits`],
    ['content', info.content],
    ['agreement of green with the verdict', green !== 'unknown' ? Math.abs(agreement).toFixed(2) : undefined],
    ['blue', hasBlue(data) ? 'three channels: z is stored' : 'two channels: z is computed from x and y'],
    ['code for zero', info.zero === 128 ? '128 of 255' : info.zero === 127 ? '127.5 of 255 (2c − 1)' : 'unknown'],
    ['colour or data', info.transfer === 'srgb' ? 'encoded as a colour (sRGB)' : info.transfer === 'linearised' ? 'decoded as if it were a colour' : 'data'],
    ['mean tilt', degrees(info.meanTilt)],
    ['background', info.background > 0 ? percent(info.background) : undefined],
    ['no valid direction', info.invalid > 0 ? percent(info.invalid) : undefined],
    ['below the horizon', info.belowHorizon > 0 ? percent(info.belowHorizon) : undefined],
  ];
}

// Whether blue holds z: it varies, or has a constant value other than zero or full.
function hasBlue(data) {
  const first = data[2];
  for (let k = 2; k < data.length; k += 4) if (data[k] !== first) return true;
  return first !== 0 && first !== 255 && first !== 65535;
}
