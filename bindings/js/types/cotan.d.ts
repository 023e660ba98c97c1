import type { Split } from './tangents.js';
import type { texture } from './textures.js';
export * from './old_names.js';
export * from './tangents.js';

/** An image with four components per pixel, rows from the top. Bit depth by the type of data: 8, 16 or 32 (floats). */
export interface Image {
  width: number;
  height: number;
  bits?: number;
  data: Uint8Array | Uint8ClampedArray | Uint16Array | Float32Array;
}

/** How a map is stored, in the words of the command line: "gltf", "directx", "unity,xy" and so on. */
export type Convention = string;
export type Bits = 8 | 16 | 32;

// ---- normal maps

/** Detects which way green points, from the map alone. */
export function detect(map: Image): {
  green: 'up' | 'down' | 'unknown';
  /** Whether red and green are swapped; null: unknown. */
  swapped: boolean | null;
  confidence: 'none' | 'likely' | 'certain';
  /** The correlation on which the verdict is based, -1 to 1. */
  agreement: number;
  reason: string;
};

/** Statistics of an image, read as a normal map. Fractions are 0 to 1, tilt is in degrees. */
export function info(map: Image): {
  content: string;
  /** The code of 255 that stands for zero: 128; 127 for 127.5; null: unknown. */
  zero: 127 | 128 | null;
  transfer: 'linear' | 'srgb' | 'linearised';
  background: number;
  invalid: number;
  belowHorizon: number;
  meanLength: number;
  meanTilt: number;
  mean: [number, number, number];
};

/** Converts a map from one convention to another. from: default "gltf,exact"; with the words for broken maps ("gltf,srgb")
 * the map is repaired; "auto" finds the convention, and repairs the map, as `cotan map convert` does, or throws a
 * CotanError with code `input` if green cannot be told. Default of bits: those of the map. */
export function convertMap(map: Image, options?: { from?: Convention; to?: Convention; bits?: Bits }): Image;

export function blend(base: Image, detail: Image, options?: {
  convention?: Convention;
  mode?: 'reoriented' | 'whiteout' | 'udn' | 'slopes' | 'linear';
  /** Factor on the detail's slopes. */
  strength?: number;
  bits?: Bits;
}): Image;

/** Makes a normal map from red of a height map. scale: slope per unit of height and texel, one or [x, y]. */
export function fromHeight(height: Image, options?: { scale?: number | [number, number]; to?: Convention; bits?: Bits }): Image;

/** The height map, in texel widths and with mean 0, whose slopes are nearest to those of the normal map. */
export function toHeight(map: Image, options?: { from?: Convention }): { width: number; height: number; data: Float32Array };

/** Mip levels, filtered as vectors, with the roughness that compensates for the lost variance of normals. roughness: of the
 * material, 0 to 1; default: 0.3. */
export function mips(map: Image, options?: { convention?: Convention; roughness?: number }): { normals: Image; roughness: Image }[];

// ---- frames

export interface SurfacePoints {
  /** Unit normals, 3 numbers each. */
  normals: ArrayLike<number>;
  /** Differences of position (3 numbers each) and uv (2 each) along any two directions. */
  dpdx: ArrayLike<number>;
  dpdy: ArrayLike<number>;
  duvdx: ArrayLike<number>;
  duvdy: ArrayLike<number>;
}
/** Interpolated attributes: tangents (4 numbers each) for "mikktspace", "area-weighted" and "vertex", u and v (3 each) for "smooth". */
export interface InterpolatedPoints {
  normals: ArrayLike<number>;
  tangents?: ArrayLike<number>;
  u?: ArrayLike<number>;
  v?: ArrayLike<number>;
}
/** apply: perturbed unit normals from decoded texels. encode, its inverse: texels from normals. 3 numbers each. */
export function apply(frame: string, points: SurfacePoints | InterpolatedPoints, texels: ArrayLike<number>): Float32Array;
export function encode(frame: string, points: SurfacePoints | InterpolatedPoints, normals: ArrayLike<number>): Float32Array;
export function frames(): string[];

/** Self-contained source of the function that perturbs the normal with the given frame; for Godot a whole spatial
 * shader. */
export function shader(options?: {
  language?: 'glsl' | 'essl' | 'hlsl' | 'wgsl' | 'msl' | 'cpp' | 'godot';
  /** The one that the map was baked for: 'orthonormal' reads maps for MikkTSpace, as most are, 'smooth' and 'cotangent'
   * those that you bake for this shader. Required, except for 'godot', whose default is 'orthonormal'. */
  frame?: string;
  convention?: Convention;
  /** For the frame "triangle" only: emits the part for one stage. Default: all stages. */
  stage?: 'fragment' | 'vertex' | 'mesh' | 'compute';
}): string;

/** Renumbers vertices so that vertex k is the provoking vertex of triangle k. corners: for each triangle its three old
 * vertices, the provoking one first. */
export function provoking(vertexCount: number, indices: ArrayLike<number>, options?: { vertex?: 'first' | 'last' }): Split & { corners: Uint32Array };

// ---- glTF

type Bytes = ArrayBuffer | ArrayBufferView;
export interface ModelOptions {
  /** External files of a .gltf by URI: as the model writes it, or percent-decoded. */
  files?: Record<string, Bytes>;
  /** Decodes the normal maps, of any format but KTX2, which the library decodes. Default: decodeImage. */
  decode?: (bytes: Uint8Array, name: string) => Promise<Image & { bits: number }>;
  /** Called with the fraction done, 0 to 1. Returning false stops the work (code "stopped"). */
  progress?: (done: number) => boolean | void;
}

/** The report of `cotan lint --json`. */
export interface LintReport {
  recommendation: string;
  /** The frame to read the maps with, of chosen ones that of most primitives; empty: nothing was judged. */
  advice: string;
  warnings: string[];
  primitives: any[];
  /** One for each primitive that is drawn; `mesh` is its number among these. */
  decisions: Omit<Decision, 'primitive'>[];
  /** Primitives whose stored tangents `convert` would drop and keep. */
  primitives_dropping: number;
  primitives_keeping: number;
  /** The verdict on `limit` and `limitArea`; null if neither was set. A limit of 0 appears as 1e-9. */
  check: LintCheck | null;
  /** The failures: findings over `limit` or `limitArea`; with either limit also each map whose green points the other
   * way than the file says; with `limit` also maps that could not be judged. Empty if the check passes or no limit was
   * set. */
  over_limit: OverLimit[];
  [more: string]: any;
}

export interface OverLimit {
  kind: 'reading' | 'rounding' | 'degenerate_uv' | 'mirrored_overlap' | 'reversed_w' | 'rotated_tangents' | 'reversed_green' | 'not_judged';
  /** Names of the mesh and its material; null: unnamed, or the finding concerns no mesh. */
  mesh: string | null;
  material: string | null;
  /** The map of `reversed_green`; else null. */
  map: string | null;
  /** The value found: one of the two, or both null for findings that no limit allows. degrees: exceeded on 5 % of the
   * primitive's area. */
  degrees: number | null;
  percent: number | null;
  /** The exceeded limit, in the same unit. */
  limit: number | null;
  /** The finding in one line. */
  text: string;
}

export interface LintCheck {
  passed: boolean;
  limit: number | null;
  limit_area: number | null;
  frame: LimitFrame;
  failures: {
    /** `reversed_green` and `not_judged` have no value and no limit. */
    kind: OverLimit['kind'];
    /** The primitive or map concerned; empty: the whole model. */
    where: string;
    value: number | null;
    limit: number | null;
    text: string;
  }[];
}

export interface Limits {
  /** Maximum error with `frame` in degrees, 0 to 180, on 95 % of the area. */
  limit?: number;
  /** Maximum percent of a primitive's area, 0 to 100, with degenerate uv, mirrored overlapping uv, or stored tangents
   * that contradict the uv. */
  limitArea?: number;
  /** The frame that `limit` judges; default: "orthonormal". */
  frame?: LimitFrame;
}
export type LimitFrame = 'cotangent' | 'orthonormal' | 'smooth' | 'exact' | 'triangle' | 'stored';

/** Reports what to expect of a model (.glb or .gltf) whose normal maps are read without stored tangents. */
export function lint(model: Bytes, options?: ModelOptions & Limits & {
  /** Distance from eye to surface in units of the model; 0, the default: where the whole model fills the image. */
  distance?: number;
  /** As for `convert`, for `decisions`. */
  maxDegrees?: number;
}): Promise<LintReport>;

/** `over_limit` of a report, evaluated for other limits. */
export function overLimits(report: LintReport, limits?: Limits): OverLimit[];

/** A normal map that stays as it is, with the tangents that it needs, because its format cannot be read here. */
export interface UnreadMap {
  image: number;
  name: string;
  /** For example "AVIF". */
  format: string;
  /** What the user can do. */
  advice: string;
}

/** How the map of a primitive is read without stored tangents. */
export interface Decision {
  /** Indices in the file. */
  mesh: number;
  primitive: number;
  /** What the map means: the frame that the file names, its tangents, or MikkTSpace as glTF says. */
  meaning: 'named' | 'stored' | 'mikktspace';
  /** fits: the first candidate within the limits. keeps: no candidate is, so that what is there stays. not_judged: the
   * same, because nothing could be compared (`not_judged` says why). */
  reason: 'no_map' | 'named' | 'fits' | 'keeps' | 'not_judged';
  frame: string;
  tangents_stay: boolean;
  /** Degrees between the normals of each way to read the map and what it means, in the order of cost. */
  candidates: { frame: string; stored: boolean; points: number; mean: number | null; percentile95: number | null; percentile99: number | null; maximum: number | null }[];
  not_judged: string;
  text: string;
}

/** The report of `cotan convert --json`. */
export interface ConvertReport {
  maps: {
    image: number;
    name: string;
    size: [number, number];
    /** The map stays, because the new frame reads it as well as a new map. */
    kept: boolean;
    /** Only green of the map was reversed, as the tangents that were dropped showed it. */
    green_reversed?: boolean;
    bytes_before: number;
    bytes_after: number;
    /** For a new map: the mean angle in degrees between its texels before it was encoded and in its file. */
    degrees_of_encoding?: number;
    [more: string]: any;
  }[];
  unread_maps: UnreadMap[];
  /** The frame of each primitive, and what was measured. Empty if new maps were made, or no map was read. */
  decisions: Decision[];
  /** The mode that was used. keep: all tangents stay, as those that reverse green of a map that could not be changed. */
  mode: 'drop' | 'convert' | 'keep';
  /** Size of the model with the files that it references. */
  bytes: { before: number; after: number };
  /** Names of the maps whose green `fixGreen` reversed. */
  green_fixed?: string[];
  tangents: { kept?: true; given_primitives?: number; dropped_primitives?: number; vertices?: number; bytes?: number; [more: string]: any };
  /** Notes for the user, one line each, including one for each unread map. */
  notes: string[];
}

/** Removes stored tangents from a model. mode:
 * - `auto`, the default: drops them where nobody can see it. Each primitive gets the first frame, in the order of cost,
 *   that reads its map within `maxDegrees` of its tangents; its extras name it (`cotanFrame`). Tangents stay, with a note,
 *   where no frame does, where a map cannot be decoded, and where the file would grow by more than 2 %. Maps stay byte
 *   for byte, but for green that the tangents reverse, which is reversed in the map instead.
 * - `drop`: leaves maps as they are, not even decoded, and measures nothing: the maps are read with `orthonormal`.
 *   Tangents that reverse green of a map stay.
 * - `convert`: makes new maps as `cotan convert --to-frame` does; the default with `to`, `bits` or `keepTangents`. These
 *   keep the format of the old ones: JPEG and WebP at the same quality if sharp, or the canvas in browsers, encodes
 *   them, and if that costs no more than half a degree, or half of what the conversion gains; KTX2 with the option
 *   `texture`. Else they are PNG, with a note.
 * Tangents that glTF requires stay, with a note: those of materials with anisotropy, or with a normal map of the clear coat,
 * without normalTexture. */
export function convert(model: Bytes, options?: ModelOptions & {
  mode?: 'auto' | 'drop' | 'convert';
  /** Default: the frame that the materials name in their extras (`cotanFrame`), else "mikktspace". */
  from?: string;
  /** The frame to convert to; default with mode `convert`: "cotangent". */
  to?: string;
  /** Bit depth of the new maps, 8 or 16. 0: that of the old maps, which are kept if they fit. */
  bits?: 0 | 8 | 16;
  keepTangents?: boolean;
  generateTangents?: boolean;
  /** First reverses green of maps in which it points the other way than the model says, judged by the map itself
   * (`lint`). */
  fixGreen?: boolean;
  /** Without new maps: the mean error of normals, in degrees, that a frame may have on a primitive, and ten times as much
   * on 1 % of its area. Default: 0.3. */
  maxDegrees?: number;
  /** How engines decode the maps: "biased" (2c - 1, as stock engines do; the default) or "exact", where 128 is zero. */
  unsigned?: 'biased' | 'exact';
  /** Encodes an image as a PNG file; default: encodePng. The file is decoded again to measure its losses. */
  encode?: (image: Image) => Promise<Bytes>;
  /** The function of cotan/textures, which encodes new maps in place of KTX2. Without it they become PNG. */
  texture?: (...words: Parameters<typeof texture>) => ReturnType<typeof texture> | Promise<ReturnType<typeof texture>>;
}): Promise<{ glb: Uint8Array; report: ConvertReport }>;

// ---- images

/** Lossless PNG files of 8 or 16 bits. */
export function decodePng(bytes: Uint8Array): Promise<Image & { bits: 8 | 16 }>;
export function encodePng(image: Image & { bits: number }): Promise<Uint8Array>;
/** Decodes PNG and KTX2; other formats by the browser, or by the package sharp in node. The values are those of the file: no
 * colour profile is applied, and colours under transparent alpha are kept. */
export function decodeImage(bytes: Uint8Array, name?: string): Promise<Image & { bits: number }>;
