// cotan/three/relief, for WebGLRenderer, and cotan/three/tsl/relief, for WebGPURenderer: height maps.
import type { Material, Texture } from 'three';

export { CotanError } from '../tangents.js';

export interface ReliefOptions {
  /** Heights in red: 1 is the surface, and 0 lies `heightDepth` below it. With its own uv set (`channel`) and matrix. Its
   * colorSpace must be NoColorSpace. */
  heightMap: Texture;
  /** In units of the scene, 0 or more. 0 leaves the surface as it is. */
  heightDepth: number;
  /** Readings before the search halves its step, from 1 to 256; 6 more follow. Relief that is thinner than heightDepth /
   * heightSteps along the line of sight can be missed. Default: 16. */
  heightSteps?: number;
  /** Whether the relief shadows itself, with heightSteps readings for each light that has a direction. Default: true. */
  selfShadow?: boolean;
}

/** A material with a relief has its options as properties. heightDepth can be changed at any time, heightMap for one on the
 * same uv set. After other changes, and after `heightMap = null`, which removes the relief, set `needsUpdate`. */
export type WithRelief<T extends Material> = T & { heightMap: Texture | null; heightDepth: number; heightSteps: number; selfShadow: boolean };

/**
 * Makes all maps of a material on the uv set of heightMap appear where the line of sight meets the relief. Stretched, sheared
 * and mirrored texture coordinates need nothing else: the offset comes from the gradients of u and v, and is exact on a plane.
 * On a curved surface it is off by about heightDepth over the radius. Mips are those of the surface, also at steps of the
 * relief. Silhouettes, and the shadows and depth that other objects see, stay those of the surface. A bumpMap stays, too.
 *
 * Where there is no relief the surface stays as it is: seen from behind, at the horizon, for texture coordinates that are
 * constant, and for a depth that is not a number.
 *
 * Use it before or after `untangle`. Your own `onBeforeCompile` (WebGLRenderer) is kept, and so is your `contextNode`
 * (WebGPURenderer) if it is set before. `material.clone()` keeps the relief, `copy()` does not.
 *
 * Throws a CotanError with code `usage` on materials without a normalMap, such as MeshBasicMaterial, and on wrong options.
 * cotan/three/relief needs three 0.160 or later, and cotan/three/tsl/relief 0.187. With an older version a CotanError with code
 * `unavailable` is thrown, by the first when a shader is compiled, by the second when it is imported.
 */
export function addRelief<T extends Material>(material: T, options: ReliefOptions): WithRelief<T>;
