// cotan/three: normal mapping without tangents for three.js and its WebGLRenderer.
import type { Material, Object3D, WebGLRenderer } from 'three';

/**
 * How a normal map is read.
 * - `cotangent`: as three.js itself reads maps of meshes without tangents, from screen derivatives; exact on stretched and
 *   sheared texture coordinates for maps that were made so (`cotan bake --frame cotangent`).
 * - `orthonormal`: the nearest to MikkTSpace, which most models with tangents were baked for.
 * - `triangle`: the directions of `cotangent` from two vectors for each triangle, made here, 12 bytes at a vertex; no
 *   derivatives in the shader. Vertices come to be about as many as triangles. Texture matrices are read once, now. Meshes that
 *   deform, batches, and meshes with maps over different texture coordinates get `cotangent`, with a warning.
 */
export type Frame = 'cotangent' | 'orthonormal' | 'triangle';

export interface UntangleOptions {
  /** Default: `orthonormal` for meshes that had tangents, `cotangent` for others, as three.js reads them. */
  frame?: Frame;
}

/** What GLTFLoader gives, as far as it is needed here. */
export interface LoadedModel {
  scenes: Object3D[];
}

/**
 * Removes the tangents of all meshes, and lets every material with a `normalScale` take its frame from Cotan: for bumps, clear
 * coat and anisotropy, right in mirrored transforms, on both sides, and in targets with y down. `normalScale.y` gets the sign
 * that tangents stood for. Materials that meshes share but want different things of are cloned. Call it again for meshes that
 * come later; what is done stays. Hooks of your own (`onBeforeCompile`) are kept, clones of materials that you make lose ours.
 * Throws an Error on anything but an Object3D or a loaded model, and on unknown frames; drawing throws where the shader of a
 * material has no place for the frame.
 */
export function untangle<T extends Object3D | LoadedModel>(target: T, options?: UntangleOptions): T;

/** The same as a plugin: `new GLTFLoader().register(untangled())`. */
export function untangled(options?: UntangleOptions): (parser: unknown) => { name: string; afterRoot(model: LoadedModel): Promise<void> };

/**
 * Replaces the frame of one material and nothing else. A mesh with tangents that is drawn with it does not use the frame: that
 * is said by console.warn. against: the bitangents that anisotropy counts on run against increasing v, as in glTF.
 */
export function replaceFrame<T extends Material>(material: T, options?: { frame?: Frame; against?: boolean; from?: Material }): T;
