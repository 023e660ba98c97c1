// cotan/react: normal mapping without tangents for react-three-fiber.
import type { ReactElement, RefObject } from 'react';
import type { Object3D } from 'three';
import type { Decision, LoadedModel, UntangleOptions } from './index.js';

export interface UseUntangledOptions extends UntangleOptions {
  /** The function to call. Default: that of `cotan/three`. For WebGPURenderer: that of `cotan/three/tsl`. Give the same function
   * each time: another one is called again. */
  untangle?: (target: Object3D | LoadedModel, options?: UntangleOptions) => Decision[];
}

/**
 * Calls `untangle` for a model when the component is mounted, before it is drawn, and again when `object`, `frame`, `maxDegrees`
 * or `convention` change. Returns the decisions: none before the first call. object: the result of GLTFLoader, an Object3D, or
 * a ref to one, such as a `<group>` around your own meshes; nothing happens while it is missing. The model is changed itself,
 * so that each component that draws it shows the same. Errors of `untangle` go to the nearest error boundary.
 */
export function useUntangled(object: Object3D | LoadedModel | RefObject<Object3D | null> | null | undefined, options?: UseUntangledOptions): Decision[];

export interface UntangledProps extends UseUntangledOptions {
  object: Object3D | (LoadedModel & { scene: Object3D });
  /** Is called with the decisions, if there are any, after each call of `untangle`. */
  onDecided?: (decisions: Decision[]) => void;
  /** By default geometries, materials and textures of the model are disposed of when the component is unmounted; three.js uploads
   * them again if the model is drawn again. null: nothing is. */
  dispose?: null;
  /** Other properties are those of `<primitive>`: position, scale, onClick. */
  [property: string]: unknown;
}

/** `<primitive>` with `useUntangled`: `<Untangled object={useLoader(GLTFLoader, url)} />`. Throws a CotanError with code `usage`
 * if `object` is neither an Object3D nor a loaded model. */
export function Untangled(properties: UntangledProps): ReactElement;
