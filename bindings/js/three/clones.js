// What clones of a material keep.

const keeping = new WeakMap(); // by material whose clone() was replaced: functions by name

// Makes material.clone() call keep(clone, material). name: replaces the earlier function of that name. Does not affect copy().
export function keepInClones(material, name, keep) {
  const isNew = !keeping.has(material);
  if (isNew) keeping.set(material, new Map());
  keeping.get(material).set(name, keep);
  if (!isNew) return material;
  const { clone } = material;
  return Object.defineProperty(material, 'clone', { configurable: true, writable: true, value() {
    const made = clone.call(material);
    for (const keep of keeping.get(material).values()) keep(made, material);
    return made;
  } });
}
