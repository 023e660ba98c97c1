// The panel with the shader text. The choice is kept in the URL: #shader?lang=wgsl&frame=cotangent&map=gltf
import { choice, download, el } from './elements.js';
import { library } from './library.js';

const kLanguages = { essl: 'WebGL 2 (GLSL ES 3.00)', wgsl: 'WebGPU (WGSL)', glsl: 'Vulkan, OpenGL (GLSL)', hlsl: 'Direct3D, Unity, Unreal (HLSL)', msl: 'Metal', godot: 'Godot 3 and 4', cpp: 'C++' };
const kFrames = {
  orthonormal: 'orthonormal: for maps baked for MikkTSpace, as most are', mikktspace: 'mikktspace: for the same maps, with stored tangents',
  smooth: 'smooth: for maps baked for it; cotangents at the vertices', cotangent: 'cotangent: for maps baked for it, or that tile; nothing stored',
  triangle: 'triangle: for maps baked for it; two vectors per triangle',
};
const kMaps = { gltf: 'glTF', opengl: 'OpenGL, green up', directx: 'DirectX, green down', unity: 'Unity', unreal: 'Unreal', godot: 'Godot', blender: 'Blender' };
const kStages = { '': 'all', fragment: 'pixel', vertex: 'vertex', mesh: 'mesh', compute: 'compute' };
const kEnds = { essl: 'glsl', glsl: 'glsl', wgsl: 'wgsl', hlsl: 'hlsl', msl: 'metal', cpp: 'hpp', godot: 'shader' };

export async function showShader(panel) {
  const words = new URLSearchParams(location.hash.startsWith('#shader?') ? location.hash.slice(8) : '');
  const word = (name, known, otherwise) => words.get(name) in known ? words.get(name) : otherwise;
  const state = { lang: word('lang', kLanguages, 'essl'), frame: word('frame', kFrames, 'orthonormal'), map: '', stage: word('stage', kStages, '') };
  state.map = word('map', kMaps, state.lang === 'godot' ? 'godot' : 'gltf');
  const text = el('code', {}), said = el('p', { role: 'status', class: 'small' }), how = el('div', {}), stages = el('div', {});
  const select = (label, known, name) => choice(label, known, state[name], value => { state[name] = value; chosen(true); });
  const stage = select('Stage', kStages, 'stage');
  stages.append(stage.element);

  panel.replaceChildren(
    el('div', { class: 'choices' }, select('Language', kLanguages, 'lang').element, select('Frame', kFrames, 'frame').element,
      select('The map is stored for', kMaps, 'map').element, stages,
      el('button', { type: 'button', class: 'main', onclick: copy }, 'Copy'),
      el('button', { type: 'button', class: 'link', onclick: () => download(text.textContent, `cotan.${kEnds[state.lang]}`, 'text/plain') }, 'Download')),
    said,
    el('div', { class: 'shader' }, el('pre', { tabindex: 0, 'aria-label': 'Text of the shader' }, text), how));
  await chosen(false);

  async function chosen(keep) {
    stages.hidden = state.frame !== 'triangle';
    try {
      text.textContent = await library.shader({ language: state.lang, frame: state.frame, convention: state.map,
        ...(state.frame === 'triangle' && state.stage ? { stage: state.stage } : {}) });
      said.textContent = '';
    } catch (error) {
      text.textContent = '';
      said.textContent = error.message;
    }
    how.replaceChildren(...instructions(state));
    if (keep) history.replaceState(null, '', `#shader?${new URLSearchParams(Object.entries(state).filter(([, value]) => value))}`);
  }
  async function copy() {
    try {
      await navigator.clipboard.writeText(text.textContent);
      said.textContent = 'Copied.';
    } catch {
      getSelection().selectAllChildren(text);
      said.textContent = 'The browser does not allow this page to copy. The text is selected: press Ctrl+C.';
    }
  }
}

function instructions({ lang, frame }) {
  if (lang === 'godot')
    return [el('h3', {}, 'Where it goes'), el('ol', {},
      el('li', {}, 'It is a complete spatial shader: assign it to a ShaderMaterial. In Godot 4, use the extension .gdshader.'),
      el('li', {}, 'Set its normal_map, imported without sRGB. Choose “The map is stored for Godot”, since the importer may drop blue.'),
      el('li', {}, frame === 'cotangent' || frame === 'orthonormal' ? 'Disable tangents in the import settings of meshes. In Godot 3, use the GLES3 driver.'
        : frame === 'mikktspace' ? 'Enable tangents in the import settings of meshes.' : 'The comment at the top says which arrays of the mesh it reads.')),
    el('p', { class: 'small' }, 'The address of this page stores your choice.')];
  const needs = {
    cotangent: 'Call cotan_perturb_normal once in the pixel stage, before any branch.', orthonormal: 'Call cotan_perturb_normal once in the pixel stage, before any branch.',
    triangle: 'Compute the two vectors of each triangle where triangles are available (at load, or in the vertex, mesh or compute stage), pass them on without interpolation, and call cotan_perturb_normal_on_triangle.',
    smooth: 'Compute the cotangents of the vertices once (npm cotan, or cotan tangents), interpolate them, and call cotan_perturb_normal_from_vertices.',
    mikktspace: 'Interpolate the normal and the tangent without normalising them, and call cotan_perturb_normal_from_gltf_tangent.',
  };
  const space = {
    essl: 'Put "precision highp float; precision highp int;" before it.', wgsl: 'Derivatives need uniform control flow: call it before any return or discard.',
    hlsl: 'In Unity and Unreal the texel is already decoded: use the text that cotan shader --unsigned signed prints.', glsl: 'Version 4.30 or higher, or Vulkan.',
    msl: 'Include <metal_stdlib> before it.', cpp: 'It is a self-contained header and includes nothing from Cotan.',
  };
  return [el('h3', {}, 'Where it goes'), el('ol', {},
    el('li', {}, 'Paste the text above your pixel shader.'), el('li', {}, needs[frame]),
    el('li', {}, 'Pass the position minus the eye’s, in the space of the normal; do not normalise it.'),
    el('li', {}, 'Pass the uv that the texture is sampled with.'),
    el('li', {}, space[lang])),
  el('p', { class: 'small' }, 'The address of this page stores your choice.')];
}
