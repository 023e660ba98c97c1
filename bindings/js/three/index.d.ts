// cotan/three: normal mapping without tangents for three.js and its WebGLRenderer.
import type { Material, Object3D, WebGLRenderer } from 'three';

export { CotanError } from '../tangents.js';

/**
 * The frame that a normal map is read with.
 * - `auto`: the frame that the map was made for. If the material names one (`material.userData.cotanFrame`, from glTF extras
 *   that `convert` writes), that frame. Else `cotangent` for maps that GLTFLoader did not load, on meshes without tangents
 *   that are one of three's own shapes or repeat the map. Else `orthonormal`, since maps of models mean MikkTSpace.
 * - `orthonormal`: the nearest to MikkTSpace, for which most models with tangents were baked.
 * - `cotangent`: from screen derivatives, as three.js itself reads maps of meshes without tangents. Exact on stretched and
 *   sheared texture coordinates for maps that were made for it (`cotan bake --frame cotangent`).
 * - `smooth`: from gradients of u and v that are computed here and stored at the vertices, 24 bytes each. No steps at edges.
 *   Follows skinning. Batches and meshes with morph targets get `cotangent`, with a warning.
 * - `triangle`: the directions of `cotangent` from two vectors per triangle, computed here and stored in 12 bytes per vertex.
 *   Needs no derivatives in the shader. Vertices are split to about as many as triangles. Deforming meshes, batches, and
 *   meshes with maps over different texture coordinates get `cotangent`, with a warning.
 * For `smooth` and `triangle` texture matrices are read only once, by this call.
 */
export type Frame = 'auto' | 'cotangent' | 'orthonormal' | 'smooth' | 'triangle';

export interface UntangleOptions {
  /** Default: the frame of an earlier call for materials that have one, else `auto`. */
  frame?: Frame;
  /** Which way green points: up the image (`gltf`) or down (`directx`). Default: as the stored tangents say, if they
   * contradict the texture coordinates on at least 90 % of a map's area; else as the model declares. */
  convention?: 'gltf' | 'directx';
  /** Receives notes that are not warnings: green that is read reversed, a frame that is not the map's own.
   * Default: console.info. */
  note?: (line: string) => void;
}

/** The part of GLTFLoader's result that is needed here. */
export interface LoadedModel {
  scenes: Object3D[];
}

/**
 * Removes the tangents of all meshes and makes every material with a `normalScale` use a frame of Cotan for bumps, clear coat
 * and anisotropy. Correct for mirrored transforms, for both sides of faces, and for render targets with y down. Sets the sign
 * of `normalScale.y` so that the render stays as it was with tangents. A material is cloned if its meshes need different
 * settings. Call this again for meshes that are added later. Your own hooks (`onBeforeCompile`) are kept, even if set later.
 * `material.clone()` keeps the frame, `copy()` does not. GPU memory of removed tangents and of replaced geometries is freed;
 * a new geometry is disposed of with the one that it replaces.
 * Throws a CotanError with code `usage` on anything but an Object3D or a loaded model, on unknown frames and on unknown
 * options; with code `unavailable` if this version of three, or a material's shader when it is compiled, cannot take the
 * frame. Needs three 0.160 or later.
 */
export function untangle<T extends Object3D | LoadedModel>(target: T, options?: UntangleOptions): T;

/** untangle() as a plugin of GLTFLoader: `new GLTFLoader().register(untangled())`. */
export function untangled(options?: UntangleOptions): (parser: unknown) => { name: string; afterRoot(model: LoadedModel): Promise<void> };

/**
 * Replaces the frame of one material and changes nothing else. `auto`, the default, is the frame that the material names, else
 * `orthonormal`. `smooth` and `triangle` need geometries prepared by untangle(). Meshes with tangents ignore the frame, with a
 * console.warn. against: whether the bitangents of anisotropy run against increasing v, as in glTF. from: a material whose
 * hooks are taken over, and also its frame if `frame` is missing.
 */
export function replaceFrame<T extends Material>(material: T, options?: { frame?: Frame; against?: boolean; from?: Material }): T;
