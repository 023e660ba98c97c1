/** A built-in module of node; undefined elsewhere. Before Node.js 20.16 only an import gives it. Bundlers do not try to
 * resolve this one: its name is no plain text, and two have their comment. */
export async function builtin(name) {
  const { process } = globalThis;
  if (process?.getBuiltinModule) return process.getBuiltinModule(name);
  return process?.versions?.node ? import(/* webpackIgnore: true */ /* @vite-ignore */ `node:${name}`) : undefined;
}
