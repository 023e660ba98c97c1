// After anything is thrown out of WebAssembly, the next call gets a new instance: node instance_test.mjs TARBALL [CASE]
import assert from 'node:assert/strict';
import fs from 'node:fs';
import path from 'node:path';

import { hills, installed, load, runCases, skip } from './shared.mjs';

const [tarball, only] = process.argv.slice(2);
if (!fs.existsSync(tarball)) skip('the package has not been built (emscripten, npm)');
const folder = installed(tarball);
const { CotanError, Library } = await import(path.join(folder, 'node_modules/cotan/src/instance.js'));

let made = 0; // instances that replace another one
const { Instance } = WebAssembly;
WebAssembly.Instance = class extends Instance {
  constructor(...args) {
    super(...args);
    ++made;
  }
};

// A module by hand. Each function adds 1 to a global when it begins and subtracts it when it ends, as compiled code moves
// its stack pointer: `level` tells what earlier calls left behind.
function moduleOf() {
  const text = (word) => [word.length, ...Buffer.from(word)], list = (items) => [items.length, ...items.flat()];
  const sized = (bytes) => [...(bytes.length < 128 ? [bytes.length] : [128 | bytes.length % 128, bytes.length >> 7]), ...bytes]; // LEB128
  const section = (id, items) => [id, ...sized(list(items))];
  const [nothing, number, one] = [0, 1, 2], imports = ['proc_exit', 'fail'];
  const enter = [0x23, 0, 0x41, 1, 0x6a, 0x24, 0], leave = [0x23, 0, 0x41, 1, 0x6b, 0x24, 0];
  const functions = { // name: [type, instructions]
    _initialize: [nothing, []], level: [number, [0x23, 0]], malloc: [one, [0x41, 0x80, 8]], free: [one, [0x41, 0]],
    works: [nothing, [...enter, ...leave]],
    traps: [nothing, [...enter, 0x00, ...leave]], // unreachable
    exits: [nothing, [...enter, 0x10, 0, ...leave]], // calls an import
    fails: [nothing, [...enter, 0x10, 1, ...leave]],
    throws: [nothing, [...enter, 0x08, 0, ...leave]],
    reads: [nothing, [...enter, 0x41, 0x7f, 0x28, 2, 0, 0x1a, ...leave]], // beyond the memory
  };
  functions.recurses = [nothing, [...enter, 0x10, imports.length + Object.keys(functions).length, ...leave]]; // calls itself
  return Uint8Array.from([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0,
    ...section(1, [[0x60, 0, 0], [0x60, 0, 1, 0x7f], [0x60, 1, 0x7f, 1, 0x7f]]),
    ...section(2, imports.map((name) => [...text('host'), ...text(name), 0, nothing])),
    ...section(3, Object.values(functions).map(([type]) => [type])),
    ...section(5, [[0, 1]]),
    ...section(13, [[0, nothing]]),
    ...section(6, [[0x7f, 1, 0x41, 0, 0x0b]]),
    ...section(7, [[...text('memory'), 2, 0], ...Object.keys(functions).map((name, k) => [...text(name), 0, imports.length + k])]),
    ...section(10, Object.values(functions).map(([, code]) => sized([0, ...code, 0x0b])))]);
}

const kRounds = 3;

/** Calls work() in one of `step` frames of a stack that is full, from the deepest on, until it succeeds: the calls end at
 * different depths of the library's functions. */
function withFullStack(work, step) {
  const errors = [];
  let done = false;
  const deeper = (depth = 0) => {
    try {
      deeper(depth + 1);
    } catch (full) {
      if (done) return;
      if (depth % step !== 0) throw full;
      try {
        work();
        done = true;
      } catch (error) {
        errors.push(error);
        throw error;
      }
    }
  };
  try {
    deeper();
  } catch {
    // the stack was full to its first frame
  }
  return { done, errors };
}

const cases = {
  async everyKindOfThrowGivesAFreshInstance() {
    const library = new Library(), level = () => library.run((s) => s.wasm.level());
    await library.load(moduleOf(), { host: { proc_exit: () => { throw new Error('it exited'); }, fail: () => { throw 'no Error'; } } });
    library.run((s) => s.wasm.works());
    assert.deepEqual([level(), made], [0, 0]);
    for (const [name, found] of [['traps', /unreachable/], ['exits', /it exited/], ['fails', /no Error/], ['throws', /./], ['recurses', /stack/], ['reads', /out of bounds/]]) {
      made = 0;
      assert.throws(() => library.run((s) => s.wasm[name]()), (error) => error instanceof CotanError && error.code === 'unavailable'
        && /^the library stopped: /.test(error.message) && found.test(error.message), name);
      assert.deepEqual([level(), made], [0, 1], name);
    }
    // An error that does not come out of WebAssembly changes nothing.
    made = 0;
    assert.throws(() => library.run(() => { throw new TypeError('of the caller'); }), TypeError);
    assert.deepEqual([level(), made], [0, 0]);
  },

  // A callback of the library may call the library. If that damages the instance, the outer call must not go on with it.
  async aNestedFaultEndsTheOuterCallToo() {
    const library = new Library();
    await library.load(moduleOf(), { host: { proc_exit: () => { try { library.run((s) => s.wasm.traps()); } catch { /* as user code may */ } }, fail: () => {} } });
    made = 0;
    assert.throws(() => library.run((s) => s.wasm.exits()), (error) => error instanceof CotanError && /the library stopped/.test(error.message));
    assert.throws(() => library.run((s) => { try { s.wasm.traps(); } catch { /* goes on */ } s.wasm.works(); }), CotanError);
    assert.equal(library.run((s) => s.wasm.level()), 0);
    assert.equal(made, 2);
  },

  // If no new instance can be made, a call says so, and a later one tries again.
  async aFailedRestartIsReportedAndTriedAgain() {
    const library = new Library(), counting = WebAssembly.Instance;
    await library.load(moduleOf(), { host: { proc_exit: () => {}, fail: () => {} } });
    assert.throws(() => library.run((s) => s.wasm.traps()), CotanError);
    WebAssembly.Instance = class { constructor() { throw new RangeError('no memory'); } };
    try {
      assert.throws(() => library.run((s) => s.wasm.level()), (error) => error.code === 'unavailable' && /a new instance cannot be made: no memory/.test(error.message));
    } finally {
      WebAssembly.Instance = counting;
    }
    assert.equal(library.run((s) => s.wasm.level()), 0);
  },

  async fullStacksLeaveNothingBehindInBothModules() {
    const [cotan, small] = [await load(folder), await load(folder, 'tangents')], mesh = hills(4);
    await Promise.all([cotan.ready, small.ready]);
    for (const [name, module, work, step] of [['cotan', cotan, () => cotan.tangents(mesh), 1], ['tangents', small, () => small.tangents(mesh), 1],
      ['shader', cotan, () => cotan.shader({ language: 'wgsl', frame: 'orthonormal' }), 100],
      ['maps', cotan, () => cotan.info({ width: 2, height: 2, data: new Uint8Array(16).fill(128) }), 3]]) {
      const expected = work();
      made = 0;
      let stopped = 0;
      for (let round = 0; round < kRounds; ++round) {
        const { errors } = withFullStack(work, step);
        stopped += errors.filter((error) => error instanceof module.CotanError && /the library stopped: /.test(error.message)).length;
        assert.ok(errors.every((error) => error instanceof module.CotanError || error instanceof RangeError), `${name}: ${errors.map(String)}`);
        assert.deepEqual(work(), expected, name);
      }
      console.log(`${name}: ${stopped} calls stopped with a full stack, ${made} new instances`);
      // Where little stack is left, as in Node 20, making the error fails too: then the caller gets a RangeError.
      assert.ok(made > 0, `${name}: ${stopped} stopped, ${made} new instances`);
    }
  },

  // Callbacks that throw unwind the library as any result does: nothing is replaced.
  async errorsOfCallbacksAreNoFaults() {
    const cotan = await load(folder);
    await cotan.ready;
    made = 0;
    const glb = oneTriangle();
    for (const options of [{ progress: () => { throw new TypeError('mine'); } }, { decode: () => { throw new TypeError('mine'); } }]) {
      await cotan.lint(glb, options).catch((error) => assert.match(error.message, /mine/));
      await cotan.lint(glb);
    }
    assert.equal(made, 0);
  },
};

function oneTriangle() {
  const bytes = Float32Array.of(0, 0, 0, 1, 0, 0, 0, 1, 0);
  return new TextEncoder().encode(JSON.stringify({
    asset: { version: '2.0' }, buffers: [{ byteLength: 36, uri: `data:;base64,${Buffer.from(bytes.buffer).toString('base64')}` }], bufferViews: [{ buffer: 0, byteLength: 36 }],
    accessors: [{ bufferView: 0, componentType: 5126, count: 3, type: 'VEC3', min: [0, 0, 0], max: [1, 1, 0] }],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 } }] }], nodes: [{ mesh: 0 }], scenes: [{ nodes: [0] }], scene: 0,
  }));
}

await runCases(cases, only);
