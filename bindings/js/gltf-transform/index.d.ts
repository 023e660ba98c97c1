import type { Transform } from '@gltf-transform/core';
import type { ConvertReport, Limits, LintReport, Picture } from '../cotan.js';

/** Gives every primitive tangents, indexed ones too: vertices are copied where the corners that share one differ.
 * Primitives that have some keep them, unless overwrite is true. What cannot have any is left, with a warning. */
export function tangents(options?: { kind?: 'mikktspace' | 'vertex'; overwrite?: boolean }): Transform;

/** Drops TANGENT: see convert of the package cotan for `mode`, whose default is what lint advises: the maps byte for byte as they
 * are, for readers that take `orthonormal` or MikkTSpace; or new ones. Compressed geometry and maps in KTX2 are dropped from
 * without being decoded. New maps are in the format of the old ones, JPEG and WebP where their encoder is there, else PNG. With
 * them materials name the frame in their extras, as `cotanFrame`; `from` is by default the frame that they name. Gives new
 * tangents where `to` reads some. New maps cannot be made from KTX2: such a map stays as it is, and so do the tangents that it
 * needs; the report has it as unread_maps. */
export function untangent(options?: {
  mode?: 'auto' | 'drop' | 'convert';
  from?: string;
  to?: string;
  bits?: 0 | 8 | 16;
  keepTangents?: boolean;
  generateTangents?: boolean;
  unsigned?: 'biased' | 'exact';
  decode?: (bytes: Uint8Array, name: string) => Promise<Picture & { bits: number }>;
  /** Gets the report of the conversion; `bytes` of it are of normal maps and tangents, uncompressed. Its notes are warnings of the
   * document's logger too. */
  report?: (report: ConvertReport) => void;
}): Transform;

/** Says what to expect of the model when its maps are read without stored tangents; changes nothing. With a limit it is a
 * check: what is over it rejects with a CotanError whose code is `limit`, after `report` was called; see lint of the package
 * cotan. */
export function lintNormals(options?: Limits & {
  distance?: number;
  decode?: (bytes: Uint8Array, name: string) => Promise<Picture & { bits: number }>;
  report?: (report: LintReport) => void;
}): Transform;

/** Numbers the vertices so that vertex k provokes triangle k: see provoking of the package cotan. */
export function provoking(options?: { vertex?: 'first' | 'last' }): Transform;

/** The names that `from` and `to` know. */
export function frames(): string[];
