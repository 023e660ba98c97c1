// The library, which works in a thread of its own so that the page never waits for it: (await cotan()).lint(...) and so on.
// Errors come back with their message, and with their code where they have one.
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
  worker.onerror = worker.onmessageerror = event => { // for ever: what is asked later is answered, too
    broken = new Error(`the library could not be loaded${event.message ? `: ${event.message}` : ': is the page served whole, and do its server and browser allow workers and WebAssembly?'}`);
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
