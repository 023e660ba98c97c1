// What is thrown, without the library.

/** What went wrong: `code` is one of usage, input, unavailable, output, limit, stopped. */
export class CotanError extends Error {
  constructor(code, message) {
    super(message);
    this.name = 'CotanError';
    this.code = code;
    // "FILE: FIELD: expected THIS, found THAT", each of it where there is one
    const parts = /^(?:(.*?\.(?:glb|gltf)): )?(?:(.*?): )?(?:.*\b)?expected (.*?)[,;] found (.*)$/s.exec(message);
    if (parts) [, this.file, this.field, this.expected, this.found] = parts;
  }
}

export const usage = (message) => new CotanError('usage', message);

/** What a value is, in a few words. */
export function wordsFor(value) {
  if (value === null || value === undefined) return String(value);
  if (typeof value === 'object') return value.constructor?.name ?? 'object';
  return typeof value === 'string' ? `'${value}'` : typeof value === 'number' ? String(value) : typeof value;
}
