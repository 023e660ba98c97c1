// The slider of an image in two halves, which moves the border between them. Dragging near the border moves it too.
import { el } from './elements.js';

// draw(fraction): draws the canvas with the border at this fraction of its width.
export function divider(canvas, draw, [left, right]) {
  const range = el('input', { type: 'range', min: 0, max: 100, value: 50, step: 1, 'aria-label': `Border between ${left} and ${right}, % of the width`,
    oninput: () => draw(share()) });
  const share = () => Number(range.value) / 100;
  let dragged = false;
  canvas.addEventListener('pointerdown', event => {
    const box = canvas.getBoundingClientRect();
    dragged = Math.abs((event.clientX - box.left) / box.width - share()) < 0.03;
    if (!dragged) return;
    canvas.setPointerCapture(event.pointerId);
    event.stopImmediatePropagation(); // so that the camera does not move
  }, true);
  canvas.addEventListener('pointermove', event => {
    if (!dragged) return;
    const box = canvas.getBoundingClientRect();
    range.value = 100 * (event.clientX - box.left) / box.width;
    draw(share());
    event.stopImmediatePropagation();
  }, true);
  canvas.addEventListener('pointerup', () => { dragged = false; }, true);
  const labels = [el('span', {}, left), el('span', {}, right)];
  return {
    share,
    element: el('div', {}, range, el('div', { class: 'labels' }, ...labels)),
    rename(names) {
      labels.forEach((label, k) => { label.textContent = names[k]; });
      range.setAttribute('aria-label', `Border between ${names[0]} and ${names[1]}, % of the width`);
    },
  };
}
