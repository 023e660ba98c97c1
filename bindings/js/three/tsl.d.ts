// cotan/three/tsl: normal mapping without tangents for three.js and its WebGPURenderer, on WebGPU and WebGL 2. Needs
// three 0.185 or later; with an older version the import rejects with a CotanError, code `unavailable`. Bundlers report by
// themselves that three before 0.167 has no `three/tsl`.
import type { Material, Object3D, Texture } from 'three';
import type { Node, Renderer } from 'three/webgpu';
export { CotanError } from '../tangents.js';
import type { Decision, Frame, LoadedModel, UntangleOptions } from './index.js';

export interface UntangleNodesOptions extends UntangleOptions {
  /** The renderer, after `await renderer.init()`. Required for the frame `triangle`, since WebGPU takes flat values
   * from the first vertex and WebGL from the last. Without it, `triangle` is no candidate. Instanced meshes get `cotangent`
   * instead of `triangle` or `smooth`; skinned meshes also instead of `smooth`. */
  renderer?: Renderer;
}

/** Like `untangle` of cotan/three. Sets `normalNode` and `clearcoatNormalNode`, unless you have set them, and how the
 * directions of anisotropy are computed. Call it again after adding a map to a material that had none. */
export function untangle(target: Object3D | LoadedModel, options?: UntangleNodesOptions): Decision[];

/** untangle() as a plugin of GLTFLoader: `new GLTFLoader().register(untangled())`. The decisions are in the result's
 * `userData.cotan`. */
export function untangled(options?: UntangleNodesOptions): (parser: unknown) => { name: string; afterRoot(model: LoadedModel): Promise<void> };

/** Replaces the frame of one material and changes nothing else. */
export function replaceFrame<T extends Material>(material: T, options?: { frame?: Frame; against?: boolean }): T;

/** The perturbed unit normal in view space, for your own node materials: `material.normalNode = perturbedNormal(map)`.
 * The tangent-space map is sampled with its own texture coordinates and matrix. scale: a vec2 node; after scaling,
 * green must point along v. frame: the one that the map was baked for; default: `orthonormal`, which reads maps for
 * MikkTSpace, as most are. */
export function perturbedNormal(map: Texture, scale?: Node, frame?: Exclude<Frame, 'auto'>): Node;
