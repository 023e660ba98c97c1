// The page: reads files and shows panels with the results.
import { el } from './elements.js';
import { library } from './library.js';
import { isZip, mapAmong, modelAmong, readChosen, readDropped } from './files.js';
import { showShader } from './shader_panel.js';
import { showWhy } from './why_panel.js';

const [status, problem, result] = ['status', 'problem', 'result'].map(id => document.getElementById(id));
let latest = 0; // number of the newest call of show(); results of earlier calls are dropped

async function show(reading) {
  const turn = ++latest;
  problem.textContent = '';
  const waits = waiting();
  waits.on('Reading …');
  try {
    const files = (await Promise.all((await reading).map(file => isZip(file.bytes) ? library.unzip(file.name, file.bytes) : [file]))).flat();
    const model = modelAmong(files), map = mapAmong(files);
    if (!model && !map) throw new Error('expected a file, found none');
    if (turn !== latest) return;
    const scratch = el('div');
    waits.on(`Checking ${(model?.model ?? map).name} …`);
    if (model) {
      const { showModel } = await import('./model_panel.js');
      await showModel(scratch, model);
    } else {
      const { showMap } = await import('./map_panel.js');
      await showMap(scratch, map.name, await library.decodeImage(map.bytes, map.name));
    }
    if (turn !== latest) return;
    result.replaceChildren(...scratch.childNodes);
    status.textContent = '';
    result.focus({ preventScroll: true });
    if (result.getBoundingClientRect().top > 0.6 * innerHeight) result.scrollIntoView({ behavior: 'smooth', block: 'start' });
  } catch (error) {
    if (turn !== latest) return;
    result.replaceChildren(); // the old result belongs to another file
    status.textContent = '';
    problem.textContent = error.message;
    if (!['CotanError', 'Error'].includes(error.name)) console.error(error);
  } finally {
    waits.over();
  }
}

// Shows the current activity and, after 5 seconds, the elapsed time.
function waiting() {
  let words = '', timer;
  const began = performance.now();
  const say = () => {
    status.textContent = `${words} ${Math.round((performance.now() - began) / 1000)} s so far`;
    timer = setTimeout(say, 10000);
  };
  return {
    on(now) {
      words = status.textContent = now;
      clearTimeout(timer);
      timer = setTimeout(say, 5000);
    },
    over() { clearTimeout(timer); },
  };
}

document.getElementById('choose').addEventListener('change', event => {
  show(readChosen(event.target.files));
  event.target.value = '';
});
for (const [name, dragging] of [['dragover', true], ['dragleave', false], ['drop', false]])
  document.addEventListener(name, event => {
    event.preventDefault();
    document.body.classList.toggle('dragging', dragging);
    if (name === 'drop') show(readDropped(event.dataTransfer));
  });
document.addEventListener('paste', event => {
  if (event.clipboardData.files.length > 0) show(readChosen(event.clipboardData.files));
});
for (const name of ['map', 'model'])
  document.getElementById(`sample-${name}`).addEventListener('click', () => show(import('./samples.js').then(samples => samples[name]())));

showWhy(document.getElementById('why-panel'));
const panel = document.getElementById('shader-panel');
const whenSeen = new IntersectionObserver(entries => {
  if (!entries.some(entry => entry.isIntersecting)) return;
  whenSeen.disconnect();
  showShader(panel).catch(error => panel.replaceChildren(el('p', { role: 'alert' }, error.message)));
}, { rootMargin: '400px' });
whenSeen.observe(panel);
if (location.hash.startsWith('#shader')) document.getElementById('shader').scrollIntoView();
addEventListener('hashchange', () => { if (location.hash.startsWith('#shader?')) showShader(panel); });
if (isSecureContext && location.protocol !== 'file:' && 'serviceWorker' in navigator) navigator.serviceWorker.register('offline.js');
