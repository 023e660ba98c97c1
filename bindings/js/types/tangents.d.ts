/** Await this before the first call. Rejects if WebAssembly is missing. */
export const ready: Promise<void>;

/** The version of the library, "0.2.0". */
export function version(): string;

/** Thrown by every function on bad input. The library stays usable. */
export class CotanError extends Error {
  readonly code: 'usage' | 'input' | 'unavailable' | 'output' | 'limit' | 'stopped';
  /** Parts of the message, if it has them: the file, its field or the argument, what was expected, what was found. */
  readonly file?: string;
  readonly field?: string;
  readonly expected?: string;
  readonly found?: string;
}

type Numbers = ArrayLike<number>;

/** A triangle mesh. uvs as in glTF, v downwards in the image. */
export interface Mesh {
  /** 3 numbers each. */
  positions: Numbers;
  /** Unit normals, 3 numbers each. */
  normals: Numbers;
  /** 2 numbers each. */
  uvs: Numbers;
  /** Three per triangle. Default: vertices in their order. */
  indices?: Numbers | null;
}

/** Tangents, 4 floats per corner in the order of the indices: x, y, z along increasing u, w as in glTF's TANGENT. The
 * default kind is "mikktspace"; "area-weighted" is that of meshoptimizer. Corners that share a vertex may have different tangents: see `split`. x, y, z are unit,
 * but zero where "mikktspace" and "area-weighted" find directions that cancel at a vertex. glTF requires unit length: replace such a
 * tangent by (1, 0, 0) before you write a file, as the transforms for glTF-Transform do. */
export function tangents(mesh: Mesh, options?: { kind?: 'mikktspace' | 'area-weighted' | 'vertex' }): Float32Array;

/** Cotangents of the frame "smooth", 3 floats per vertex each. Split vertices with `splitMirrored` first. */
export function smooth(mesh: Mesh): { u: Float32Array; v: Float32Array };

/** U and V of the frame "triangle", 3 floats per triangle each: t = cross(n, u), b = cross(n, v). */
export function triangles(mesh: Mesh): { u: Float32Array; v: Float32Array };

/** The same triangles over more vertices. sources: for each new vertex the old one that it is a copy of. */
export interface Split {
  indices: Uint32Array;
  sources: Uint32Array;
}

/** Duplicates vertices so that all corners of a vertex have the same tangent, which can then be stored at the vertex:
 * the tangent of vertex indices[i] is corners[4 * i ...]. */
export function split(vertexCount: number, indices: Numbers, corners: Numbers): Split;

/** Duplicates the vertices that mirrored and unmirrored triangles share. */
export function splitMirrored(mesh: Mesh): Split;

/** Packs U and V of the frame "triangle" in 3 words per triangle: six half floats. */
export function packTriangles(u: Numbers, v: Numbers): Uint32Array;

/** Packs vectors of the frame "smooth" in 8 bytes per vertex (four SNORM16) or in 4 (one word). */
export function packSmooth(normals: Numbers, u: Numbers, v: Numbers, options?: { bytes?: 8 }): Int16Array;
export function packSmooth(normals: Numbers, u: Numbers, v: Numbers, options: { bytes: 4 }): Uint32Array;

/** Packs tangents (4 floats each) in 2 bytes per vertex. */
export function packTangents(normals: Numbers, tangents: Numbers): Uint16Array;
