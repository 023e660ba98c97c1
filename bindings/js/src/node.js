// What only node has; undefined elsewhere. Nothing here is a name that a bundler could look for.
export const builtin = (name) => globalThis.process?.getBuiltinModule?.(name);
