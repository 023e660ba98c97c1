import type { Transform } from '@gltf-transform/core';
import type { ConvertReport, Limits, LintReport, Picture } from '../cotan.js';

/** Generates tangents for every primitive, indexed or not. A vertex is duplicated where the tangents of its corners
 * differ. Existing tangents are kept unless `overwrite` is true. Primitives without triangles, normals or uv get a
 * warning instead. */
export function tangents(options?: { kind?: 'mikktspace' | 'vertex'; overwrite?: boolean }): Transform;

/** Drops TANGENT. `mode` is as in `convert` of the package cotan. By default each primitive
 * gets the frame that is near enough to its tangents, which its extras name, and maps stay byte for byte, but for green
 * where the tangents reverse it; tangents stay where no frame is near enough. Compressed geometry and KTX2 maps need no decoding to drop tangents. New maps
 * keep the format of the old ones; JPEG and WebP become PNG if their encoder is missing or loses too much, as with
 * `convert`. Tangents that glTF requires stay, with a note, and so do tangents that reverse green of a map which cannot
 * be changed. Materials with new maps name the frame in their extras, as `cotanFrame`, which is also the default of
 * `from`. Generates tangents if the frame `to` reads them. New maps cannot be made from KTX2: such a map
 * stays as it is with the tangents that it needs, and is listed in the report as unread_maps. */
export function untangent(options?: {
  mode?: 'auto' | 'drop' | 'convert';
  from?: string;
  to?: string;
  bits?: 0 | 8 | 16;
  keepTangents?: boolean;
  generateTangents?: boolean;
  unsigned?: 'biased' | 'exact';
  maxDegrees?: number;
  decode?: (bytes: Uint8Array, name: string) => Promise<Picture & { bits: number }>;
  /** Receives the report of the conversion. Its `bytes` count normal maps and uncompressed tangents only. Its notes are
   * also logged as warnings by the document's logger. */
  report?: (report: ConvertReport) => void;
}): Transform;

/** Reports what to expect of the model when its maps are read without stored tangents; changes nothing. If a limit is
 * exceeded, rejects with a CotanError with code `limit`, after calling `report`. See `lint` of the package cotan. */
export function lintNormals(options?: Limits & {
  distance?: number;
  decode?: (bytes: Uint8Array, name: string) => Promise<Picture & { bits: number }>;
  report?: (report: LintReport) => void;
}): Transform;

/** Renumbers vertices so that vertex k is the provoking vertex of triangle k: see `provoking` of the package cotan. */
export function provoking(options?: { vertex?: 'first' | 'last' }): Transform;

/** The frame names that `from` and `to` accept. */
export function frames(): string[];
