// The key by which three's WebGPURenderer shares programs between materials.

const keyed = new WeakMap(); // by material: { key, parts }. key: the user's customProgramCacheKey, if any

// Adds part(material), a text, to the key of the material. name: replaces the earlier part of that name. A key that the user
// sets, before or later, stays a part, too.
export function addToKey(material, name, part) {
  const found = keyed.get(material);
  if (found) {
    found.parts[name] = part;
    return;
  }
  const key = Object.hasOwn(material, 'customProgramCacheKey') ? material.customProgramCacheKey : undefined;
  keyed.set(material, { key, parts: { [name]: part } });
  Object.defineProperty(material, 'customProgramCacheKey', {
    configurable: true,
    get: () => () => {
      const { key, parts } = keyed.get(material), proto = Object.getPrototypeOf(material).customProgramCacheKey;
      return ['cotan', ...Object.values(parts).map(one => one(material)), (key ?? proto).call(material)].join();
    },
    set: key => { keyed.get(material).key = key; },
  });
}
