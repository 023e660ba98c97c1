// cotan/three/tsl: normal mapping without tangents for three.js and its WebGPURenderer, on WebGPU and WebGL 2. three 0.185 and
// later; with an older one the import rejects with a CotanError, code `unavailable`.
import type { Material, Object3D, Texture } from 'three';
import type { Node, Renderer } from 'three/webgpu';
export { CotanError } from '../tangents.js';
import type { Frame, LoadedModel, UntangleOptions } from './index.js';

export interface UntangleNodesOptions extends UntangleOptions {
  /** Needed for the frame `triangle`, after `await renderer.init()`: WebGPU takes flat values from the first vertex, WebGL from
   * the last. Instanced meshes get `cotangent` here instead of `triangle` and `smooth`, skins instead of `smooth`. */
  renderer?: Renderer;
}

/** As `untangle` of cotan/three; sets `normalNode` and `clearcoatNormalNode`, unless they are yours, and how directions of
 * anisotropy are made. Maps are read when this is called: call it again if they are replaced. */
export function untangle<T extends Object3D | LoadedModel>(target: T, options?: UntangleNodesOptions): T;

/** The same as a plugin: `new GLTFLoader().register(untangled())`. */
export function untangled(options?: UntangleNodesOptions): (parser: unknown) => { name: string; afterRoot(model: LoadedModel): Promise<void> };

/** Replaces the frame of one material and nothing else. */
export function replaceFrame<T extends Material>(material: T, options?: { frame?: Frame; against?: boolean }): T;

/** The normal of a tangent-space map over its own texture coordinates, set and matrix, for node materials of your own:
 * `material.normalNode = perturbedNormal(map)`. View space, unit. scale: a node of two numbers; green along v after it. Default of frame:
 * `cotangent`. */
export function perturbedNormal(map: Texture, scale?: Node, frame?: Exclude<Frame, 'auto'>): Node;
