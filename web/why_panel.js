// An interactive explanation: a patch with arrows for its tangents and cotangents, and images drawn with four frames.
import { degrees, el } from './elements.js';
import { kLit } from './lit.js';
import { frameOf, gradients, kFrames, kRelief, meanError, patch } from './patch.js';
import { pictureOf } from './picture.js';

// gu, gv: gradients of u and v; t, b: the frame.
const kShader = {
  values: ['gu', 'gv', 't', 'b'], maps: [],
  essl: `${kRelief.essl}${kLit.essl}
vec4 colour_at(vec2 place) {
  vec2 p = (place - 0.5) * 3.2, h = slopes(vec2(dot(p, v.gu.xy), dot(p, v.gv.xy)));
  vec3 n = normalize(vec3(-h.x * v.t.xy - h.y * v.b.xy, 1.0));
  return vec4(lit(vec3(p, 0.0), n, vec3(-2.2, 2.6, 2.4), vec3(0.10, 0.24, 0.42)), 1.0);
}`,
  wgsl: `${kRelief.wgsl}${kLit.wgsl}
fn colour_at(place: vec2f) -> vec4f {
  let p = (place - 0.5) * 3.2;
  let h = slopes(vec2f(dot(p, v.gu.xy), dot(p, v.gv.xy)));
  let n = normalize(vec3f(-h.x * v.t.xy - h.y * v.b.xy, 1.0));
  return vec4f(lit(vec3f(p, 0.0), n, vec3f(-2.2, 2.6, 2.4), vec3f(0.10, 0.24, 0.42)), 1.0);
}`,
};

export function showWhy(panel) {
  const state = { stretch: 2, shear: 25, mirrored: false, rowsDown: true };
  const drawing = el('canvas', { class: 'patch', width: 720, height: 480, role: 'img', 'aria-label': 'The patch with its grid of texture coordinates, tangents and cotangents' });
  const pictures = Object.entries(kFrames).map(([name, { name: shown, text }]) => {
    const picture = pictureOf(kShader, { 'aria-label': `Embossed dots, ${shown}` }, 300, 300), figure = el('b', {});
    return { name, picture, figure, element: el('figure', {}, picture.element, el('figcaption', {}, figure, ` ${shown}: ${text}.`)) };
  });
  const stretch = slider('Stretch along u', 0.5, 3, 0.05, 'stretch', value => `${value.toFixed(2)} : 1`);
  const shear = slider('Shear', -60, 60, 1, 'shear', value => `${value.toFixed(0)}°`);
  const box = (label, name) => el('label', {}, el('input', { type: 'checkbox', checked: state[name], onchange: event => { state[name] = event.target.checked; show(); } }), ` ${label}`);

  panel.append(el('div', { class: 'why' },
    el('div', {}, drawing,
      el('div', { class: 'sliders' }, ...stretch.elements, ...shear.elements),
      el('p', {}, box('Mirrored', 'mirrored'), ' ', box('Rows run down, as in Vulkan, Direct3D and WebGPU', 'rowsDown')),
      el('p', { class: 'small' }, 'Filled arrows: gradients of ', el('span', { class: 'u' }, 'u'), ' and ', el('span', { class: 'v' }, 'v'),
        ', at right angles to the lines of the grid. Hollow arrows: tangents, along the lines.')),
    el('div', { class: 'patches two' }, ...pictures.map(({ element }) => element))),
  el('p', {}, 'Degrees are the mean error over the dots, compared with a relief that is stretched with the surface. The gradients need no stored data: in the pixel shader, the differences of position ',
    'and uv between neighbouring pixels give them (2006, 2013). Only the sign needs care: the differences depend on which way rows run on the screen, which is not a property of the surface. One ',
    'more product makes the sign right on every backend. ', el('a', { href: 'theory.html' }, 'The derivation'), ' has the details.'),
  papers());

  pull(drawing, state, () => { stretch.follow(); shear.follow(); show(); });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', show);
  show();

  function show() {
    const lies = patch(state), g = gradients(lies);
    for (const { name, picture, figure } of pictures) {
      const frame = frameOf(name, lies, state.rowsDown);
      picture.draw({ gu: g.u, gv: g.v, t: frame.t, b: frame.b });
      figure.textContent = degrees(meanError(name, lies, state.rowsDown));
    }
    drawPatch(drawing, lies, g);
  }

  function slider(label, min, max, step, name, words) {
    const id = `why-${name}`, said = el('output', { for: id });
    const range = el('input', { id, type: 'range', min, max, step, value: state[name], oninput: () => { state[name] = Number(range.value); say(); show(); } });
    const say = () => { said.textContent = words(state[name]); range.setAttribute('aria-valuetext', words(state[name])); };
    say();
    return { elements: [el('label', { for: id }, label), range, said], follow: () => { range.value = state[name]; say(); } };
  }
}

const kUnit = 105; // pixels per unit of the plane
const toCanvas = (canvas, [x, y]) => [canvas.width / 2 + kUnit * x, canvas.height / 2 - kUnit * y];

function drawPatch(canvas, lies, g) {
  const c = canvas.getContext('2d'), style = getComputedStyle(document.documentElement), colour = name => style.getPropertyValue(name).trim();
  c.clearRect(0, 0, canvas.width, canvas.height);
  const at = (u, v) => toCanvas(canvas, [u * lies.u[0] + v * lies.v[0], u * lies.u[1] + v * lies.v[1]]);
  c.lineWidth = 1.5;
  for (let k = -4; k <= 4; ++k)
    for (const [from, to, name] of [[at(k / 4, -1), at(k / 4, 1), '--u'], [at(-1, k / 4), at(1, k / 4), '--v']]) {
      c.strokeStyle = colour(name);
      c.globalAlpha = k % 4 === 0 ? 0.55 : 0.22;
      c.beginPath();
      c.moveTo(...from);
      c.lineTo(...to);
      c.stroke();
    }
  c.globalAlpha = 1;
  const longest = Math.max(Math.hypot(...g.u), Math.hypot(...g.v));
  arrow(c, canvas, lies.u, colour('--u'), false, 'dP/du');
  arrow(c, canvas, lies.v, colour('--v'), false, 'dP/dv');
  arrow(c, canvas, g.u.map(x => 1.3 * x / longest), colour('--u'), true, 'grad u');
  arrow(c, canvas, g.v.map(x => 1.3 * x / longest), colour('--v'), true, 'grad v');
}

function arrow(c, canvas, to, colour, filled, text) {
  const [x0, y0] = toCanvas(canvas, [0, 0]), [x1, y1] = toCanvas(canvas, to), long = Math.hypot(x1 - x0, y1 - y0) || 1;
  const [dx, dy] = [(x1 - x0) / long, (y1 - y0) / long], wide = filled ? 5 : 7, head = 22;
  const corners = [[0, -wide], [long - head, -wide], [long - head, -wide - 7], [long, 0], [long - head, wide + 7], [long - head, wide], [0, wide]];
  c.beginPath();
  corners.forEach(([a, b], k) => c[k ? 'lineTo' : 'moveTo'](x0 + a * dx - b * dy, y0 + a * dy + b * dx));
  c.closePath();
  c.lineWidth = 2.5;
  c.strokeStyle = c.fillStyle = colour;
  if (filled) c.fill(); else c.stroke();
  c.font = '600 20px system-ui, sans-serif';
  c.textAlign = dx < -0.3 ? 'right' : 'left';
  c.fillText(text, x1 + 12 * dx + 4, y1 + 24 * dy + 6 - (filled ? 0 : 20 * Math.abs(dx)));
}

// Makes the ends of dP/du and dP/dv handles that follow the pointer.
function pull(canvas, state, changed) {
  let held = null;
  const where = event => {
    const box = canvas.getBoundingClientRect();
    return [((event.clientX - box.left) / box.width * canvas.width - canvas.width / 2) / kUnit,
      (canvas.height / 2 - (event.clientY - box.top) / box.height * canvas.height) / kUnit];
  };
  canvas.addEventListener('pointerdown', event => {
    const p = where(event), lies = patch(state), far = a => Math.hypot(p[0] - a[0], p[1] - a[1]);
    held = far(lies.u) < far(lies.v) ? 'u' : 'v';
    canvas.setPointerCapture(event.pointerId);
    canvas.style.cursor = 'grabbing';
  });
  canvas.addEventListener('pointermove', event => {
    if (!held) return;
    const [x, y] = where(event);
    if (held === 'u') {
      state.stretch = Math.min(3, Math.max(0.5, Math.abs(x)));
    } else {
      state.shear = Math.min(60, Math.max(-60, Math.atan2(x, Math.max(y, 0.05)) * 180 / Math.PI));
    }
    changed();
  });
  canvas.addEventListener('pointerup', () => { held = null; canvas.style.cursor = ''; });
}

// The figures of the chapter with their measured errors (docs/explanation/figures.md).
function papers() {
  const rows = [
    ['Embossed dots, stretched 2 : 1', '9.5°', '0.02°', '9.5°'], ['Sheared by 45°', '16.2°', '0.02°', '5.3°'], ['Both', '13.6°', '0.02°', '5.3°'],
  ];
  const picture = el('img', { width: 990, height: 378, class: 'figure',
    alt: 'Four pairs: the teapot’s nozzle, embossed dots, a plane in perspective, mirrored texture coordinates' });
  const near = new IntersectionObserver(entries => { // loading="lazy" would fetch it with the first view
    if (!entries.some(entry => entry.isIntersecting)) return;
    near.disconnect();
    picture.src = 'pictures/figures.jpg';
  }, { rootMargin: '200px' });
  near.observe(picture);
  return el('div', {}, el('h3', {}, 'The figures of the chapter, measured'),
    el('div', { class: 'scroll', tabindex: 0, role: 'group', 'aria-label': 'The figures of the chapter, measured' }, el('table', {}, el('thead', {}, el('tr', {}, ...['Figure 2.6.4', 'orthonormal', 'cotangent', 'unit lengths'].map(name => el('th', { scope: 'col' }, name)))),
      el('tbody', {}, ...rows.map(([name, ...values]) => el('tr', {}, el('th', { scope: 'row' }, name), ...values.map(value => el('td', {}, value))))))),
    el('figure', { class: 'view' }, picture,
    el('figcaption', {}, 'Pairs: orthonormal vertex frames and cotangents on the teapot; orthonormal and cotangents on a stretched and sheared patch; two short forms of 2006 on a plane; tangents without their sign and cotangents.')),
    el('p', {}, el('a', { href: 'figures.html' }, 'All figures of the four articles with their errors'), ', and ', el('a', { href: 'cost.html' }, 'what each frame costs'), ' in instructions.'));
}
