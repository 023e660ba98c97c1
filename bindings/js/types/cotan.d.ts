import type { Split } from './tangents.js';
export * from './tangents.js';

/** Four components a pixel, rows from the top. 8, 16 or 32 (floats) bits by the type of data. */
export interface Picture {
  width: number;
  height: number;
  bits?: number;
  data: Uint8Array | Uint8ClampedArray | Uint16Array | Float32Array;
}

/** How a map is stored, in the words of the command line: "gltf", "directx", "unity,xy" and so on. */
export type Convention = string;
export type Bits = 8 | 16 | 32;

// ---- normal maps

/** Which way green points, from the map alone. */
export function detect(map: Picture): {
  green: 'up' | 'down' | 'unknown';
  /** Whether red and green are exchanged; null: unknown. */
  swapped: boolean | null;
  confidence: 'none' | 'likely' | 'certain';
  /** The correlation that the verdict rests on, -1 to 1. */
  agreement: number;
  reason: string;
};

/** Statistics of an image as a normal map. Fractions are 0 to 1, tilt is in degrees. */
export function info(map: Picture): {
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

/** The map stored another way; bits are the map's own where left out. */
export function convertMap(map: Picture, options?: { from?: Convention; to?: Convention; bits?: Bits }): Picture;

export function blend(base: Picture, detail: Picture, options?: {
  convention?: Convention;
  mode?: 'reoriented' | 'whiteout' | 'udn' | 'slopes' | 'linear';
  /** Factor on the detail's slopes. */
  strength?: number;
  bits?: Bits;
}): Picture;

/** The normal map of a height, whose red is read. scale: slope per unit of height and texel, one or [x, y]. */
export function fromHeight(height: Picture, options?: { scale?: number | [number, number]; to?: Convention; bits?: Bits }): Picture;

/** The height whose slopes are nearest to the map's, in widths of a texel, mean 0. */
export function toHeight(map: Picture, options?: { from?: Convention }): { width: number; height: number; data: Float32Array };

/** Levels of half the size each, filtered as vectors, with the roughness that makes up for it. */
export function mips(map: Picture, options?: { convention?: Convention; roughness?: number }): { normals: Picture; roughness: Picture }[];

// ---- frames

export interface Places {
  /** 3 each, unit. */
  normals: ArrayLike<number>;
  /** Differences of position (3) and uv (2) along any two directions. */
  dpdx: ArrayLike<number>;
  dpdy: ArrayLike<number>;
  duvdx: ArrayLike<number>;
  duvdy: ArrayLike<number>;
}
/** For "mikktspace" and "vertex" tangents (4 each), for "smooth" u and v (3 each), interpolated. */
export interface VertexPlaces {
  normals: ArrayLike<number>;
  tangents?: ArrayLike<number>;
  u?: ArrayLike<number>;
  v?: ArrayLike<number>;
}
/** Perturbed unit normals from decoded texels, 3 each; and the texels that a frame turns into these normals. */
export function apply(frame: string, places: Places | VertexPlaces, texels: ArrayLike<number>): Float32Array;
export function encode(frame: string, places: Places | VertexPlaces, normals: ArrayLike<number>): Float32Array;
export function frames(): string[];

/** The function that perturbs the normal with that frame, self-contained; for Godot a whole spatial shader. */
export function shader(options?: {
  language?: 'glsl' | 'essl' | 'hlsl' | 'wgsl' | 'msl' | 'cpp' | 'godot';
  frame?: string;
  convention?: Convention;
  /** Of the frame "triangle" only: the part for one stage; left out: all of them. */
  stage?: 'fragment' | 'vertex' | 'mesh' | 'compute';
}): string;

/** Vertices numbered so that vertex k provokes triangle k; corners: of the old vertices, the provoking one first. */
export function provoking(vertexCount: number, indices: ArrayLike<number>, options?: { vertex?: 'first' | 'last' }): Split & { corners: Uint32Array };

// ---- glTF

type Bytes = ArrayBuffer | ArrayBufferView;
export interface ModelOptions {
  /** Files beside a .gltf by their URI, as the model writes them but with %20 and the like undone. */
  files?: Record<string, Bytes>;
  /** Default: decodePicture. */
  decode?: (bytes: Uint8Array, name: string) => Promise<Picture & { bits: number }>;
  /** Gets 0 to 1; false stops (code "stopped"). */
  progress?: (done: number) => boolean | void;
}

/** The report of `cotan lint --json`. */
export interface LintReport {
  recommendation: string;
  /** The frame to read the maps with, once they are converted where `maps_converted` is not 0; empty: nothing was judged. */
  advice: string;
  warnings: string[];
  primitives: any[];
  /** The verdict on `limit` and `limitArea`; null where neither was set. A limit of 0 is 1e-9 here. */
  check: LintCheck | null;
  /** What failed: what is over `limit` or `limitArea`; with either also each map whose green points the other way than
   * the file says, and with `limit` maps that could not be judged. Empty: it passes, or no limit was set. */
  over_limit: OverLimit[];
  [more: string]: any;
}

export interface OverLimit {
  kind: 'reading' | 'rounding' | 'degenerate_uv' | 'mirrored_overlap' | 'reversed_w' | 'turned_tangents' | 'reversed_green' | 'not_judged';
  /** Names; null: none, or it is about no mesh. */
  mesh: string | null;
  material: string | null;
  /** Of `reversed_green`. */
  map: string | null;
  /** What was found: one of them; both null where no limit would allow it. Degrees: exceeded on 5 % of the primitive's area. */
  degrees: number | null;
  percent: number | null;
  /** In the same unit. */
  limit: number | null;
  /** All of it in one line. */
  text: string;
}

export interface LintCheck {
  passed: boolean;
  limit: number | null;
  limit_area: number | null;
  frame: LimitFrame;
  failures: {
    /** The last two have no value and no limit. */
    kind: OverLimit['kind'];
    /** A primitive or a map; empty: the whole model. */
    where: string;
    value: number | null;
    limit: number | null;
    text: string;
  }[];
}

export interface Limits {
  /** Degrees, 0 to 180, that the error with `frame` may exceed on 5 % of the area. */
  limit?: number;
  /** % of a primitive's area, 0 to 100: degenerate uv, uv overlapping mirrored, stored tangents against the uv. */
  limitArea?: number;
  /** That `limit` judges; default: "orthonormal". */
  frame?: LimitFrame;
}
export type LimitFrame = 'cotangent' | 'orthonormal' | 'smooth' | 'exact' | 'triangle' | 'stored';

/** What to expect of a model (.glb or .gltf) whose normal maps are read without stored tangents. */
export function lint(model: Bytes, options?: ModelOptions & Limits & {
  /** From eye to surface, units of the model; 0, the default: where the whole model fills the image. */
  distance?: number;
}): Promise<LintReport>;

/** over_limit of a report for other limits. */
export function overLimits(report: LintReport, limits?: Limits): OverLimit[];

/** A normal map that stays as it is, with the tangents that it needs, because its format is not read here. */
export interface UnreadMap {
  image: number;
  name: string;
  /** "KTX2 with BasisU (ETC1S)". */
  format: string;
  /** What to do. */
  advice: string;
}

/** The report of `cotan convert --json`. */
export interface ConvertReport {
  maps: {
    image: number;
    name: string;
    size: [number, number];
    /** It stays, because the new frame reads it as well as a new one. */
    kept: boolean;
    bytes_before: number;
    bytes_after: number;
    [more: string]: any;
  }[];
  unread_maps: UnreadMap[];
  /** What was done. keep: tangents stay, because they say how a map's green is read, and no new map could be made. */
  mode: 'drop' | 'convert' | 'keep';
  /** Of the model with the files that it names. */
  bytes: { before: number; after: number };
  /** Names of the maps whose green `fixGreen` has reversed. */
  green_fixed?: string[];
  tangents: { kept?: true; given_primitives?: number; dropped_primitives?: number; vertices?: number; bytes?: number; [more: string]: any };
  /** What the user should know, one line each; unread maps are among it. */
  notes: string[];
}

/** The model without stored tangents. mode:
 * - `auto`, the default: what lint advises. Maps stay byte for byte, read with the frame `orthonormal` or MikkTSpace, where
 *   that is near enough, and where new ones would make the file larger by more than 2 %; else new ones, for the frame
 *   that it advises. Tangents stay only where a map's green is to be read the other way, as they say, and no new map can be made.
 * - `drop`: maps as they are, not even decoded. Nobody asks what the tangents mean: see `lint`.
 * - `convert`: as `cotan convert` does; the default with one of the options after `mode`. New maps are in the format of the old
 *   ones: JPEG and WebP with their quality where sharp, or in browsers the canvas, encodes them; else PNG, and a note says so. */
export function convert(model: Bytes, options?: ModelOptions & {
  mode?: 'auto' | 'drop' | 'convert';
  /** Default: the frame that the materials name in their extras (`cotanFrame`), else "mikktspace". */
  from?: string;
  /** With mode `convert` by default "cotangent". */
  to?: string;
  /** Of the new maps, 8 or 16; 0: as the old ones, which stay where they fit. */
  bits?: 0 | 8 | 16;
  keepTangents?: boolean;
  generateTangents?: boolean;
  /** First reverses green of maps in which it points the other way than the model says, by the map itself (`lint`). */
  fixGreen?: boolean;
  /** How engines take the numbers of the maps: "biased" (2c - 1, as stock engines do; the default) or "exact". */
  unsigned?: 'biased' | 'exact';
  /** The PNG file of an image; default: encodePng. */
  encode?: (picture: Picture) => Promise<Bytes>;
}): Promise<{ glb: Uint8Array; report: ConvertReport }>;

// ---- images

/** A PNG file of 8 or 16 bits, without loss. */
export function decodePng(bytes: Uint8Array): Promise<Picture & { bits: 8 | 16 }>;
export function encodePng(picture: Picture & { bits: number }): Promise<Uint8Array>;
/** Any image that is read here: PNG; others by the browser, or by the package sharp in node. */
export function decodePicture(bytes: Uint8Array, name?: string): Promise<Picture & { bits: number }>;
