#!/usr/bin/env node
// The command `cotan`: the tool as WebAssembly. It runs on a second thread, so that a signal ends it at once; unfinished
// files are then removed, and the program ends by that signal, as the native tool does.
import fs from 'node:fs';
import { isatty } from 'node:tty';
import { Worker } from 'node:worker_threads';

const unfinished = new Set();
const removeUnfinished = () => {
  for (const name of unfinished) fs.rmSync(name, { force: true });
};
const worker = new Worker(new URL('./wasm/cli.cjs', import.meta.url), {
  argv: process.argv.slice(2),
  workerData: { columns: isatty(2) ? process.stderr.columns : 0 },
  resourceLimits: { stackSizeMb: 16 },
});
worker.on('message', (name) => unfinished.add(name));
worker.on('error', (error) => {
  removeUnfinished();
  console.error(`cotan: error: unexpected: ${error.message}`);
  process.exitCode = 3;
});
let ending = false;
worker.on('exit', (code) => {
  if (!ending) process.exitCode ??= code;
});
for (const signal of ['SIGINT', 'SIGTERM', 'SIGHUP'])
  process.once(signal, async () => {
    ending = true;
    await worker.terminate();
    removeUnfinished();
    process.kill(process.pid, signal);
  });
