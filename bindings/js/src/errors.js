// The error class, usable without the library.

/** An error whose `code` is one of usage, input, unavailable, output, limit, stopped. */
export class CotanError extends Error {
  constructor(code, message) {
    super(message);
    this.name = 'CotanError';
    this.code = code;
  }

  // Made only when asked for: V8 ends the process if it compiles a regular expression while the stack is full, which may
  // be why this error is thrown.
  get file() { return partsOf(this.message)[1]; }
  get field() { return partsOf(this.message)[2]; }
  get expected() { return partsOf(this.message)[3]; }
  get found() { return partsOf(this.message)[4]; }
}

// "FILE: FIELD: expected THIS, found THAT"; FILE and FIELD are optional
const partsOf = (message) => /^(?:(.*?\.(?:glb|gltf)): )?(?:(.*?): )?(?:.*\b)?expected (.*?)[,;] found (.*)$/s.exec(message) ?? [];

export const usage = (message) => new CotanError('usage', message);

const kLongText = 60;

/** Describes a value for an error message, in one line. */
export function wordsFor(value) {
  if (value === null || value === undefined) return String(value);
  if (typeof value === 'object') return typeof value.constructor?.name === 'string' ? value.constructor.name : 'object';
  if (typeof value === 'number') return String(value);
  if (typeof value !== 'string') return typeof value;
  const text = value.slice(0, kLongText).replace(/[\0-\x1f\x7f]/g, (c) => `\\x${c.charCodeAt(0).toString(16).padStart(2, '0')}`);
  return value.length > kLongText ? `'${text} ...', ${value.length} characters` : `'${text}'`;
}
