// The library in a worker, so that it never blocks the page: (await cotan()).lint(...).
// Errors keep their message and code.
let library;

export function cotan() {
  library ??= start();
  return library;
}

async function start() {
  const worker = new Worker(new URL('worker.js', document.baseURI), { type: 'module' });
  const waiting = new Map();
  let calls = 0, broken;
  worker.onmessage = ({ data: { call, result, error } }) => {
    const { done, failed } = waiting.get(call);
    waiting.delete(call);
    if (error) failed(Object.assign(new Error(error.message), error)); else done(result);
  };
  worker.onerror = worker.onmessageerror = event => { // also rejects all later calls
    broken = new Error(`the library could not be loaded${event.message ? `: ${event.message}` : ': are all files of the page served, and do the server and the browser allow workers and WebAssembly?'}`);
    for (const { failed } of waiting.values()) failed(broken);
    waiting.clear();
  };
  const ask = name => (...values) => new Promise((done, failed) => {
    if (broken) { failed(broken); return; }
    waiting.set(++calls, { done, failed });
    worker.postMessage({ call: calls, name, values });
  });
  return Object.fromEntries(['decodePicture', 'encodePng', 'detect', 'info', 'convertMap', 'shader', 'lint', 'overLimits', 'convert'].map(name => [name, ask(name)]));
}
