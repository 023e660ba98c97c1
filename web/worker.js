// The worker that runs the library. Receives { call, name, values }; answers { call, result } or { call, error }.
// error.unexpected: what failed may be damaged, such as a decoder, so that this worker should get no more calls.
import * as cotan from 'cotan/beside';
import { convertModel, lintModel } from './model_files.js';
import { unzip } from './zip.js';

const tasks = { ...cotan, lint: lintModel, convert: convertModel, unzip };

self.onmessage = async ({ data: { call, name, values } }) => {
  try {
    await cotan.ready;
    self.postMessage({ call, result: await tasks[name](...values) });
  } catch (error) {
    self.postMessage({ call, error: { name: error.name, message: error.message, code: error.code, unexpected: !(error instanceof cotan.CotanError) } });
  }
};
