// A normal map as a relief lit from the pointer's position: the original left of the border, the fixed map right of it.
import { kLit } from './lit.js';
import { pictureOf } from './picture.js';

// The map is a flat rectangle, in units of its width, with v down. Green is reversed by negating v instead.
const kEssl = `
vec4 colour_at(vec2 place) {
  vec2 at = vec2(place.x, 1.0 - place.y);
  vec3 surface = vec3(place.x, place.y * v.aspect.x, 0.0), texel = place.x < v.border.x ? texture(before, at).xyz : texture(after, at).xyz;
  vec3 n = cotan_perturb_normal(vec3(0.0, 0.0, 1.0), surface, vec2(surface.x, surface.y * v.along_v.x), texel);
  bool edge = abs(place.x - v.border.x) * v.width.x < 1.0;
  return vec4(edge ? vec3(1.0) : lit(surface, n, v.light.xyz, vec3(0.42, 0.45, 0.52)), 1.0);
}`;
const kWgsl = `
fn colour_at(place: vec2f) -> vec4f {
  let at = vec2f(place.x, 1.0 - place.y);
  let surface = vec3f(place.x, place.y * v.aspect.x, 0.0);
  let texel = select(textureSample(after, smoothly, at).xyz, textureSample(before, smoothly, at).xyz, place.x < v.border.x);
  let n = cotan_perturb_normal(vec3f(0.0, 0.0, 1.0), surface, vec2f(surface.x, surface.y * v.along_v.x), texel);
  let edge = abs(place.x - v.border.x) * v.width.x < 1.0;
  return vec4f(select(lit(surface, n, v.light.xyz, vec3f(0.42, 0.45, 0.52)), vec3f(1.0), edge), 1.0);
}`;

// texts: { essl, wgsl }, the library's shader text for glTF maps.
export function mapView(texts, attributes) {
  const shader = { essl: texts.essl + kLit.essl + kEssl, wgsl: texts.wgsl + kLit.wgsl + kWgsl,
    values: ['light', 'border', 'aspect', 'width', 'along_v'], maps: ['before', 'after'] };
  const picture = pictureOf(shader, attributes, 256, 256);
  const state = { border: 0.5, light: [0.3, 0.75], greenDown: false, aspect: 1, width: 256 };

  function show() {
    picture.draw({ border: state.border, aspect: state.aspect, width: state.width, along_v: state.greenDown ? 1 : -1,
      light: [state.light[0], state.light[1] * state.aspect, 0.28] });
  }
  picture.element.addEventListener('pointermove', event => {
    const box = picture.element.getBoundingClientRect();
    state.light = [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
    show();
  });
  return {
    element: picture.element,
    ready: picture.ready,
    show: border => { if (border !== undefined) state.border = border; show(); },
    set greenDown(value) { state.greenDown = value; },
    // which: 'before' or 'after'
    put(which, given) {
      const { width, height, data } = inBytes(given);
      state.aspect = height / width;
      state.width = Math.min(1024, Math.max(256, width));
      picture.resize(state.width, Math.max(1, Math.round(state.width * Math.min(state.aspect, 2))));
      picture.put(which, { width, height, data });
    },
  };
}

// The image with 8 bits, for display.
function inBytes({ width, height, bits, data }) {
  return { width, height, data: bits === 8 ? data : Uint8Array.from(data, value => bits === 16 ? Math.round(value / 257) : 255 * Math.min(1, Math.max(0, value))) };
}
