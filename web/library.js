// The library in a worker, so that it never blocks the page: await library.lint(...). Errors keep their message and code.
// After a failure that is no message for the user the next call gets a new worker.
import { startWorker } from './page_files.js';

const kCalls = ['decodeImage', 'encodePng', 'detect', 'info', 'convertMap', 'tangents', 'shader', 'lint', 'overLimits', 'convert', 'unzip'];
export const library = Object.fromEntries(kCalls.map(name => [name, (...values) => ask(name, values)]));

let current; // { worker, waiting }, waiting: by number of the call
let calls = 0;

function ask(name, values) {
  current ??= start();
  const { worker, waiting } = current;
  return new Promise((done, failed) => {
    waiting.set(++calls, { done, failed });
    worker.postMessage({ call: calls, name, values });
  });
}

function start() {
  const worker = startWorker(), waiting = new Map(), started = { worker, waiting };
  const leave = () => { if (current === started) current = undefined; };
  worker.onmessage = ({ data: { call, result, error } }) => {
    const { done, failed } = waiting.get(call);
    waiting.delete(call);
    if (error?.unexpected) leave();
    if (current !== started && waiting.size === 0) worker.terminate();
    if (error) failed(Object.assign(new Error(error.message), error)); else done(result);
  };
  worker.onerror = worker.onmessageerror = event => {
    leave();
    worker.terminate();
    const broken = new Error(`the library could not be loaded${event.message ? `: ${event.message}` : ': are all files of the page served, and do the server and the browser allow workers and WebAssembly?'}`);
    for (const { failed } of waiting.values()) failed(broken);
  };
  return started;
}
