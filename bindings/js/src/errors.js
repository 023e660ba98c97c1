// The error class, usable without the library.

/** An error whose `code` is one of usage, input, unavailable, output, limit, stopped. */
export class CotanError extends Error {
  constructor(code, message) {
    super(message);
    this.name = 'CotanError';
    this.code = code;
    // "FILE: FIELD: expected THIS, found THAT"; FILE and FIELD are optional
    const parts = /^(?:(.*?\.(?:glb|gltf)): )?(?:(.*?): )?(?:.*\b)?expected (.*?)[,;] found (.*)$/s.exec(message);
    if (parts) [, this.file, this.field, this.expected, this.found] = parts;
  }
}

export const usage = (message) => new CotanError('usage', message);

/** Describes a value for an error message. */
export function wordsFor(value) {
  if (value === null || value === undefined) return String(value);
  if (typeof value === 'object') return value.constructor?.name ?? 'object';
  return typeof value === 'string' ? `'${value}'` : typeof value === 'number' ? String(value) : typeof value;
}
