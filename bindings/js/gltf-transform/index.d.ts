import type { Transform } from '@gltf-transform/core';
import type { ConvertReport, Limits, LintReport, Image } from '../cotan.js';

/** Generates tangents for every primitive, indexed or not. A vertex is duplicated where the tangents of its corners
 * differ. Existing tangents are kept unless `overwrite` is true. Primitives without triangles, normals or uv get a
 * warning instead. */
export function tangents(options?: { kind?: 'mikktspace' | 'area-weighted' | 'vertex'; overwrite?: boolean }): Transform;

/** Drops TANGENT where nobody can see it. `mode` is as in `convert` of the package cotan. By default each primitive gets
 * the frame that is near enough to its tangents, which its extras name (`cotanFrame`), and maps stay byte for byte, but
 * for green where the tangents reverse it. Tangents stay, with a note, where no frame is near enough, where a map cannot
 * be decoded, such as ASTC (listed in the report as unread_maps), and where glTF requires them. Geometry stays
 * compressed as it was.
 * With mode `convert`, new maps keep the format of the old ones. KTX2 keeps its blocks too, but all of Basis Universal
 * becomes UASTC. Maps become PNG if their encoder is missing or JPEG or WebP lose too much, as with `convert`. Materials with new maps name the frame in their extras, which is also the default
 * of `from`. Tangents are generated if the frame `to` reads them. */
export function untangent(options?: {
  mode?: 'auto' | 'drop' | 'convert';
  from?: string;
  to?: string;
  bits?: 0 | 8 | 16;
  keepTangents?: boolean;
  generateTangents?: boolean;
  unsigned?: 'biased' | 'exact';
  maxDegrees?: number;
  decode?: (bytes: Uint8Array, name: string) => Promise<Image & { bits: number }>;
  /** Receives the report of the conversion. Its `bytes` count normal maps and uncompressed tangents only. Its notes are
   * also logged as warnings by the document's logger. */
  report?: (report: ConvertReport) => void;
}): Transform;

/** Reports what to expect of the model when its maps are read without stored tangents; changes nothing. If a limit is
 * exceeded, rejects with a CotanError with code `limit`, after calling `report`. See `lint` of the package cotan. */
export function lintNormals(options?: Limits & {
  distance?: number;
  maxDegrees?: number;
  decode?: (bytes: Uint8Array, name: string) => Promise<Image & { bits: number }>;
  report?: (report: LintReport) => void;
}): Transform;

/** Renumbers vertices so that vertex k is the provoking vertex of triangle k: see `provoking` of the package cotan. */
export function provoking(options?: { vertex?: 'first' | 'last' }): Transform;

/** The frame names that `from` and `to` accept. */
export function frames(): string[];
