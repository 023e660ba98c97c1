// A picture whose pixels come from one shader: drawn with WebGPU where the browser has an adapter, otherwise, and once the
// device is lost, with WebGL 2.
import { el } from './elements.js';
import { glPainter } from './gl.js';
import { gpuDevice, gpuPainter } from './gpu.js';

// shader: { essl, wgsl, values, maps }. In both languages the text has a function colour_at(place), place of the canvas 0 to 1
// from the bottom left, that reads v.NAME, a vec4 for each name of `values`, and textures by the names of `maps`.
// The element says in data-drawn-with what draws; it is drawn as soon as that is known.
export function pictureOf(shader, attributes, width, height) {
  const element = el('div', { role: 'img', ...attributes }), held = { size: [], maps: {}, values: undefined };
  let canvas, painter;

  function draw() {
    if (!painter || !held.values) return;
    [canvas.width, canvas.height] = held.size;
    painter.draw(held.values);
  }

  // A canvas keeps its first way of drawing for life, so every way begins with a new one.
  async function begin(name, makePainter) {
    const fresh = el('canvas');
    painter = await makePainter(fresh);
    element.replaceChildren(canvas = fresh);
    element.dataset.drawnWith = name;
    for (const [map, picture] of Object.entries(held.maps)) painter.put(map, picture);
    draw();
  }

  const withGl = () => begin('WebGL 2', fresh => glPainter(fresh, shader));
  const ready = gpuDevice().then(async device => {
    if (!device) return withGl();
    try {
      await begin('WebGPU', fresh => gpuPainter(device, fresh, shader));
    } catch {
      return withGl();
    }
    device.lost.then(withGl).catch(said);
  }).catch(said);

  function said(error) {
    element.replaceChildren(el('p', { class: 'small' }, `This picture needs WebGPU or WebGL 2: ${error.message}`));
  }
  new ResizeObserver(draw).observe(element); // what was drawn before the element was shown may not be kept

  function resize(wide, high) {
    held.size = [wide, high];
    element.style.aspectRatio = `${wide} / ${high}`; // its place, until there is a canvas
  }
  resize(width, height);

  return {
    element, ready, resize,
    // picture: { width, height, data }, four bytes a texel
    put(map, picture) { held.maps[map] = picture; painter?.put(map, picture); },
    // numbers, or lists of up to four, by name
    draw(values) { held.values = values; draw(); },
  };
}
