// cotan/three: normal mapping without tangents for three.js and its WebGLRenderer.
import type { Material, Object3D, WebGLRenderer } from 'three';

export { CotanError } from '../tangents.js';

/**
 * How a normal map is read.
 * - `auto`: as the map was made. The frame that the material names (`material.userData.cotanFrame`: glTF's extras, as `convert`
 *   writes them); else `orthonormal` for maps of models, which mean MikkTSpace; else, for maps that the texture coordinates
 *   repeat on meshes that no GLTFLoader made, and on three's own shapes, `cotangent`.
 * - `orthonormal`: the nearest to MikkTSpace, which most models with tangents were baked for.
 * - `cotangent`: as three.js itself reads maps of meshes without tangents, from screen derivatives; exact on stretched and
 *   sheared texture coordinates for maps that were made so (`cotan bake --frame cotangent`).
 * - `smooth`: gradients of u and v at the vertices, made here, 24 bytes each; no steps at edges. Skins are followed. Meshes
 *   with morph targets and batches get `cotangent`, with a warning.
 * - `triangle`: the directions of `cotangent` from two vectors for each triangle, made here, 12 bytes at a vertex; no
 *   derivatives in the shader. Vertices come to be about as many as triangles. Meshes that deform, batches, and meshes with
 *   maps over different texture coordinates get `cotangent`, with a warning.
 * For `smooth` and `triangle` texture matrices are read once, now.
 */
export type Frame = 'auto' | 'cotangent' | 'orthonormal' | 'smooth' | 'triangle';

export interface UntangleOptions {
  /** Default: `auto`; materials that have a frame from an earlier call keep it, unless `auto` is said. */
  frame?: Frame;
  /** Which way green points, `gltf`: up the image; `directx`: down. Default: as stored tangents say where they contradict
   * the texture coordinates on at least 90 % of the area of a map; else as the model declares. */
  convention?: 'gltf' | 'directx';
  /** Gets lines that are worth knowing and no fault: green that is read the other way, a frame that is not the map's own.
   * Default: console.info. */
  note?: (line: string) => void;
}

/** What GLTFLoader gives, as far as it is needed here. */
export interface LoadedModel {
  scenes: Object3D[];
}

/**
 * Removes the tangents of all meshes, and lets every material with a `normalScale` take its frame from Cotan: for bumps, clear
 * coat and anisotropy, right in mirrored transforms, on both sides, and in targets with y down. `normalScale.y` gets the sign
 * that tangents meant: what was drawn with them is what is drawn without. Materials that meshes share but want different
 * things of are cloned. Call it again for meshes that come later; what is done stays. Hooks of your own (`onBeforeCompile`)
 * are kept, also those that you set later, and so is the frame by `material.clone()` (not by `copy()`). What the renderer holds
 * of tangents and of geometries that are replaced is freed; what replaces them is freed when they are disposed of.
 * Throws a CotanError with code `usage` on anything but an Object3D or a loaded model, on unknown frames and on unknown
 * options, and with code `unavailable` where this three, or the shader of a material when it is drawn, has no place for the
 * frame. three 0.160 and later.
 */
export function untangle<T extends Object3D | LoadedModel>(target: T, options?: UntangleOptions): T;

/** The same as a plugin: `new GLTFLoader().register(untangled())`. */
export function untangled(options?: UntangleOptions): (parser: unknown) => { name: string; afterRoot(model: LoadedModel): Promise<void> };

/**
 * Replaces the frame of one material and nothing else. `auto`, the default, is what the material names, else `orthonormal`;
 * `smooth` and `triangle` need geometries that untangle() has prepared. A mesh with tangents that is drawn with it does not use
 * the frame: that is said by console.warn. from: a material whose hooks and, without `frame`, whose frame it gets. against: the bitangents that anisotropy counts on run against increasing v, as in glTF.
 */
export function replaceFrame<T extends Material>(material: T, options?: { frame?: Frame; against?: boolean; from?: Material }): T;
