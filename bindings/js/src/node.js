// A built-in module of node; undefined elsewhere. There is no import that a bundler could try to resolve.
export const builtin = (name) => globalThis.process?.getBuiltinModule?.(name);
