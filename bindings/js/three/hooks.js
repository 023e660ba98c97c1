// The hooks of a material for WebGLRenderer: those of its user, and ours, which write into its shaders after them.
import { Material, REVISION } from 'three';
import { CotanError } from '../src/errors.js';

// By material: { hook, key, writers }. hook, key: the user's onBeforeCompile and customProgramCacheKey, set before or after our
// own; undefined if the user has set none. writers: by name: { key, write }.
const hooked = new WeakMap();
const kWriters = ['frame', 'relief']; // in the order in which they write
const written = new WeakSet(); // shaders that are done

// Makes write(shader, material) change the shaders of the material. name: one of kWriters; replaces the earlier writer of that
// name. key(material): text that differs where the shaders do. from: the material whose user's hooks are taken over.
export function writeWith(material, name, key, write, from = material) {
  const found = hooked.get(material), { hook, key: theirs } = hooked.get(from) ?? hooksOf(from);
  hooked.set(material, { hook, key: theirs, writers: { ...found?.writers, [name]: { key, write } } });
  material.needsUpdate = true;
  if (!found) installHooks(material);
}

const hooksOf = material => ({
  hook: material.onBeforeCompile === Material.prototype.onBeforeCompile ? undefined : material.onBeforeCompile,
  key: Object.hasOwn(material, 'customProgramCacheKey') ? material.customProgramCacheKey : undefined,
});

// Makes our hooks of the material call those that the user sets later, which also become part of the cache key.
function installHooks(material) {
  const proto = Object.getPrototypeOf(material);
  const wrapHook = (name, member, ours) => Object.defineProperty(material, name, {
    configurable: true, enumerable: true,
    get: () => ours(hooked.get(material)[member]),
    set: value => { hooked.get(material)[member] = value; },
  });
  // A new function for each hook. If the user's hook calls our earlier one, everything is still written only once.
  wrapHook('onBeforeCompile', 'hook', hook => Object.assign(function onBeforeCompile(shader, renderer) {
    hook?.call(material, shader, renderer);
    if (written.has(shader)) return;
    written.add(shader);
    for (const { write } of writersOf(material)) write(shader, material);
  }, { toString: () => keyOf(material, hook) }));
  wrapHook('customProgramCacheKey', 'key', key => () =>
    [keyOf(material, hooked.get(material).hook), key ? key.call(material) : proto.customProgramCacheKey === kKeyOfThree ? '' : proto.customProgramCacheKey.call(material)].join());
}

const kKeyOfThree = Material.prototype.customProgramCacheKey; // returns the source text of onBeforeCompile
const writersOf = material => kWriters.map(name => hooked.get(material).writers[name]).filter(Boolean);
const keyOf = (material, hook) => ['cotan', ...writersOf(material).map(({ key }) => key(material)), hook ?? ''].join();

// Replaces the match of `pattern` by `text`; throws if there is none.
export function put(shader, stage, pattern, text, material) {
  if (!shader[stage].match(pattern))
    throw new CotanError('unavailable', `the shader of ${material.type}: expected ${pattern}, as three 0.160 to 0.187 have it; found none in ${REVISION}`);
  shader[stage] = shader[stage].replace(pattern, () => text);
}
