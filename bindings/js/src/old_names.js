// Names of version 0.2, which work once more. The next version deletes this file and types/old_names.d.ts.
export const oldNames = (decodeImage) => ({ decodePicture: decodeImage });

/** The fraction of a lint report's stored tangents that are rotated; reports of version 0.2 call it `turned`. */
export const rotatedOf = (stored) => stored?.rotated ?? stored?.turned;
