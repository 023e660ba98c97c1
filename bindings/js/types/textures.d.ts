import type { Convention, Image } from './cotan.js';
export { CotanError } from './tangents.js';
export type { Convention, Image };

/** Await this before the first call. Rejects if WebAssembly is missing. */
export const ready: Promise<void>;

/** The version of the library, "0.2.0". */
export function version(): string;

/** The formats of `cotan map convert --compress`. This library has no ASTC. */
export type Compress = 'none' | 'bc3' | 'bc5' | 'bc5-snorm' | 'bc7' | 'uastc' | 'eac-rg11';

/** Makes a texture for GPUs: the file that `cotan map convert` writes with the same words, byte for byte. */
export function texture(map: Image, options?: {
  /** Conventions of the map and of the texture. Defaults: "gltf,exact", and that of the map. */
  from?: Convention;
  to?: Convention;
  /** Default: "none", pixels of 8 bits. */
  compress?: Compress;
  /** Where a map of two channels has x and y. Default: "auto", where engines expect them. */
  swizzle?: 'auto' | 'rg' | 'ra' | 'ag' | 'rrrg';
  /** Default: "ktx2". DDS has BC formats and pixels. */
  container?: 'ktx2' | 'dds';
  /** The frame that the map was made for, which KTX2 stores. */
  frame?: string;
  /** All levels to 1 x 1, filtered as vectors (the default), or the largest only. */
  mips?: boolean;
}): {
  bytes: Uint8Array;
  levels: number;
  /** Angles between the map and the largest level as it is read; 99 % of the texels are within the second. null: DDS,
   * which this library does not read. */
  degrees: { mean: number; percentile99: number } | null;
};
