// cotan/three: normal mapping without tangents for three.js and its WebGLRenderer.
import type { Material, Mesh, Object3D } from 'three';

export { CotanError } from '../tangents.js';

/**
 * The frame that a normal map is read with.
 * - `auto`: the frame that the file names for the map (`userData.cotanFrame` of the geometry or the material, from glTF extras
 *   that `convert` writes). Else `cotangent` for maps that GLTFLoader did not load, on meshes without tangents that are one of
 *   three's own shapes or repeat the map. Else what measurement decides, see `untangle`.
 * - `orthonormal`: the nearest to MikkTSpace, for which most models with tangents were baked, that needs no vectors.
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
  /** Default: the frame of an earlier call for materials that have one, else `auto`. Another one is obeyed without measuring,
   * and no tangents stay. */
  frame?: Frame;
  /** Degrees that perturbed normals may be off on average without the tangents of the file, and ten times as much on 99 % of
   * the area. Above 0; default: 0.3. */
  maxDegrees?: number;
  /** Which way green points: up the image (`gltf`) or down (`directx`). Default: as the stored tangents say, if they
   * contradict the texture coordinates on more than half of a primitive's area; else as the model declares. */
  convention?: 'gltf' | 'directx';
  /** Receives notes that are not warnings: tangents that stay, green that is read reversed, a frame that is not the map's
   * own. Default: console.info. */
  note?: (line: string) => void;
}

/** How well a frame reads a map: degrees between perturbed normals, at `points` points spread evenly over the surface: 4096,
 * or 512 of them if their mean is below half of the limit and their maximum below that of 99 %, or their mean above four times
 * the limit; fewer in a scene of many meshes. mikktspace: tangents that are made when the model is loaded. If `why` says why the mesh cannot have the frame, points is 0
 * and the rest is NaN. */
export interface Candidate {
  frame: 'orthonormal' | 'triangle' | 'smooth' | 'mikktspace';
  points: number;
  mean: number;
  /** The smallest value that 95 % of the area does not exceed. */
  percentile95: number;
  percentile99: number;
  /** At the points. */
  maximum: number;
  why?: string;
}

/** What was decided about a mesh and one of its materials. */
export interface Decision {
  mesh: Mesh;
  /** As it is drawn now; a copy if meshes with the same material needed different settings. */
  material: Material;
  /** mikktspace: three.js draws it with its own frame, from tangents of the geometry, which are made here, or the loaded ones. */
  frame: Exclude<Frame, 'auto'> | 'mikktspace';
  /** Whether the tangents that came with the mesh are needed: a file without them would look different. */
  keepsTangents: boolean;
  /** What the map is taken to mean: `named`: the frame that the file or the caller names; `stored`: what the tangents of the
   * mesh show; `mikktspace`: MikkTSpace over its texture coordinates, as glTF says; `painted`: nothing that depends on a
   * model; `none`: there is no map, and no anisotropy. */
  meaning: 'named' | 'stored' | 'mikktspace' | 'painted' | 'none';
  /** `fits`: the first candidate within the limits; `keeps`: no candidate is, so that what is there stays; `notJudged`: the
   * same, because nothing could be compared (`why`); `shared`: as another material of the mesh needs; `named`: as the file
   * says; `requested`: as the caller says; `earlier`: as in an earlier call; `painted`, `noMap`: see `meaning`. */
  reason: 'fits' | 'keeps' | 'notJudged' | 'shared' | 'named' | 'requested' | 'earlier' | 'painted' | 'noMap';
  /** In the order of cost, up to the chosen one. Empty if nothing was measured. */
  candidates: Candidate[];
  why?: string;
}

/** The part of GLTFLoader's result that is needed here. */
export interface LoadedModel {
  scenes: Object3D[];
  /** The plugin leaves its decisions in `userData.cotan`. */
  userData?: Record<string, any>;
}

/**
 * Removes tangents where nobody can see it, and makes materials with a `normalScale` use a frame of Cotan for bumps, clear coat
 * and anisotropy. Returns one decision for each mesh and material.
 *
 * For each mesh, frames are compared with what its map means (`Decision.meaning`) by the angle between perturbed normals, with
 * the texels of the map, and by the angle between directions of anisotropy: `orthonormal`, `triangle`, `smooth`, then MikkTSpace tangents made here, in 8 bytes a vertex. The
 * first one within `maxDegrees` is taken. If none is, the tangents of the mesh stay as they are, and a note says what they
 * cost. Loaded tangents that MikkTSpace makes, too, are drawn, in 8 bytes. Tangents also stay if the map cannot be read:
 * compressed textures, and images where there is no OffscreenCanvas. Meshes without tangents then get `orthonormal`. Images
 * are read once, with at most 512 x 512 texels. Skinned meshes are judged as they are posed now, and instances by the worst of
 * the first eight that are stretched differently.
 *
 * Each map is read with its own texture coordinates. The direction of anisotropy follows those of the normal map, else those of
 * the anisotropy map. Tangents belong to the same ones: a coat whose map has others gets `orthonormal`, also where they stay.
 *
 * The same file always gives the same decisions, and a second call changes nothing. Correct for mirrored meshes and both sides
 * of faces, and without tangents also for mirrored instances and render targets with y down. Sets the sign of `normalScale.y`
 * so that the render is that of the file with its tangents; three.js alone inverts bitangents of mirrored meshes. A material
 * is cloned if its meshes need different settings. Call this again for meshes that are added later. Your own hooks
 * (`onBeforeCompile`) are kept, even if set later. `material.clone()` keeps the frame, `copy()` does not. GPU memory of removed
 * tangents and of replaced geometries is freed; a new geometry is disposed of with the one that it replaces. A buffer that
 * interleaves tangents with other attributes keeps its size.
 *
 * Throws a CotanError with code `usage` on anything but an Object3D or a loaded model, on unknown frames and on unknown
 * options; with code `unavailable` if this version of three, or a material's shader when it is compiled, cannot take the
 * frame. Needs three 0.160 or later.
 */
export function untangle(target: Object3D | LoadedModel, options?: UntangleOptions): Decision[];

/** untangle() as a plugin of GLTFLoader: `new GLTFLoader().register(untangled())`. The decisions are in the result's
 * `userData.cotan`. */
export function untangled(options?: UntangleOptions): (parser: unknown) => { name: string; afterRoot(model: LoadedModel): Promise<void> };

/**
 * Replaces the frame of one material and changes nothing else. `auto`, the default, is the frame that the material names, else
 * `orthonormal`. `smooth` and `triangle` need geometries prepared by untangle(). Meshes with tangents ignore the frame, with a
 * console.warn. against: whether the bitangents of anisotropy run against increasing v, as in glTF. from: a material whose
 * hooks are taken over, and also its frame if `frame` is missing.
 */
export function replaceFrame<T extends Material>(material: T, options?: { frame?: Frame; against?: boolean; from?: Material }): T;
