// An image drawn by one fragment shader: with WebGPU if the browser has an adapter, otherwise, or after the device was
// lost, with WebGL 2.
import { el } from './elements.js';
import { glPainter } from './gl.js';
import { gpuDevice, gpuPainter } from './gpu.js';

// shader: { essl, wgsl, values, maps }. Both texts define colour_at(place); place is the position on the canvas, 0 to 1
// from the bottom left. They read v.NAME, a vec4 for each name in `values`, and textures by the names in `maps`. The
// element's data-drawn-with names the backend, which is chosen asynchronously.
export function pictureOf(shader, attributes, width, height) {
  const element = el('div', { role: 'img', ...attributes }), held = { size: [], maps: {}, values: undefined };
  let canvas, painter;

  function draw() {
    if (!painter || !held.values) return;
    [canvas.width, canvas.height] = held.size;
    painter.draw(held.values);
  }

  // A canvas cannot change its context type, so each backend starts with a new canvas.
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
    element.replaceChildren(el('p', { class: 'small' }, `This image needs WebGPU or WebGL 2: ${error.message}`));
  }
  new ResizeObserver(draw).observe(element); // what was drawn while the element was hidden may be lost

  function resize(wide, high) {
    held.size = [wide, high];
    element.style.aspectRatio = `${wide} / ${high}`; // reserves the space until there is a canvas
  }
  resize(width, height);

  return {
    element, ready, resize,
    // picture: { width, height, data }, four bytes per texel
    put(map, picture) { held.maps[map] = picture; painter?.put(map, picture); },
    // numbers, or lists of up to four, by name
    draw(values) { held.values = values; draw(); },
  };
}
