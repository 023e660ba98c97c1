/** Await it before the first call; it rejects where WebAssembly is missing. */
export const ready: Promise<void>;

/** The version of the library, "0.2.0". */
export function version(): string;

/** What every function throws on bad input; nothing is lost then. */
export class CotanError extends Error {
  readonly code: 'usage' | 'input' | 'unavailable' | 'output' | 'limit' | 'stopped';
  /** Where the message says so: the file, its field or the argument, what was expected and what was found. */
  readonly file?: string;
  readonly field?: string;
  readonly expected?: string;
  readonly found?: string;
}

type Numbers = ArrayLike<number>;

/** Triangles. uvs as in glTF, v downwards in the image. */
export interface Mesh {
  /** 3 each. */
  positions: Numbers;
  /** 3 each, unit. */
  normals: Numbers;
  /** 2 each. */
  uvs: Numbers;
  /** Three a triangle; left out: vertices in their order. */
  indices?: Numbers | null;
}

/** Tangents, 4 floats a corner, in the order of the indices: x, y, z along increasing u, w as glTF's TANGENT. The
 * default kind is "mikktspace". Corners that share a vertex may differ: see split. */
export function tangents(mesh: Mesh, options?: { kind?: 'mikktspace' | 'vertex' }): Float32Array;

/** Cotangents of the frame "smooth", 3 floats a vertex each. Split vertices with splitMirrored before. */
export function smooth(mesh: Mesh): { u: Float32Array; v: Float32Array };

/** U and V of the frame "triangle", 3 floats a triangle each: t = cross(n, u), b = cross(n, v). */
export function triangles(mesh: Mesh): { u: Float32Array; v: Float32Array };

/** The same triangles over more vertices: sources has for each new vertex the old one that it is a copy of. */
export interface Split {
  indices: Uint32Array;
  sources: Uint32Array;
}

/** Copies vertices until all corners that share one have the same tangent, so that it can be stored at the vertex:
 * tangent of vertex indices[i] = corners[4 * i ...]. */
export function split(vertexCount: number, indices: Numbers, corners: Numbers): Split;

/** Copies the vertices that mirrored and unmirrored triangles share. */
export function splitMirrored(mesh: Mesh): Split;

/** 3 words a triangle: six halfs. */
export function packTriangles(u: Numbers, v: Numbers): Uint32Array;

/** `smooth` in 8 bytes a vertex (four SNORM16) or in 4 (one word). */
export function packSmooth(normals: Numbers, u: Numbers, v: Numbers, options?: { bytes?: 8 }): Int16Array;
export function packSmooth(normals: Numbers, u: Numbers, v: Numbers, options: { bytes: 4 }): Uint32Array;

/** Tangents (4 floats each) in 2 bytes a vertex. */
export function packTangents(normals: Numbers, tangents: Numbers): Uint16Array;
