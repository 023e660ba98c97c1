// Normal mapping without tangents for three.js and its WebGPURenderer, on WebGPU and WebGL 2, in the node language.
import * as tsl from 'three/tsl';
import * as three from 'three/webgpu';
import { choice } from '../src/arrays.js';
import { CotanError, usage, wordsFor } from '../src/errors.js';
import { frameFor, kSupported } from './frames.js';
import { kCoatAlone, keepInClones, kTangents, replaceOptions, untangleMeshes, untangleOptions } from './meshes.js';
import { addToKey } from './node_keys.js';
import { essl, wgsl } from './shader_text.js';
import { kTriangleAttribute } from './triangles.js';

export { CotanError };

// Destructured instead of imported by name, so that an older three gives the error below instead of a missing import.
const {
  Fn, TBNViewMatrix, anisotropyB, anisotropyT, attribute, cameraViewMatrix, code, glslFn, materialAnisotropy, materialReference, modelNormalMatrix, modelViewMatrix, negateOnBackSide,
  normalViewGeometry, positionView, texture, uv, varying, vec2, vec4, wgslFn,
} = tsl;
const { InterpolationSamplingMode, InterpolationSamplingType, ObjectSpaceNormalMap, RED_GREEN_RGTC2_Format, RG11_EAC_Format, RGFormat } = three;
if (![negateOnBackSide, normalViewGeometry, anisotropyT, wgslFn, InterpolationSamplingMode, RG11_EAC_Format].every(name => name !== undefined))
  throw new CotanError('unavailable', `three: expected version 0.185 or later for cotan/three/tsl, found ${three.REVISION}`);

// Removes tangents of `target` where nobody can see it, and makes its materials use frames of Cotan. See tsl.d.ts.
export function untangle(target, options) {
  const { renderer, ...o } = untangleOptions(options, { renderer: undefined });
  if (o.frame === 'triangle' && !renderer?.backend)
    throw usage('options.renderer: expected a renderer, after `await renderer.init()`, for the frame triangle; found none');
  const provoking = renderer?.backend?.isWebGPUBackend ? 'first' : 'last';
  return untangleMeshes(target, o, { provoking, instances: false, deformed: false, triangles: !!renderer?.backend }, setFrame, restoreFrame);
}

// untangle() as a plugin: loader.register(untangled()).
export const untangled = options => {
  untangleOptions(options, { renderer: undefined });
  return () => ({ name: 'COTAN_untangled', async afterRoot(gltf) { (gltf.userData ??= {}).cotan = untangle(gltf, options); } });
};

const ours = new WeakSet();  // nodes that replaceFrame() made
const chosen = new WeakMap();  // by material: { frame, against, inverted }. frame: may be as kTangents

// Replaces the frame of one material and nothing else: removes no tangents, flips no scale, keeps nodes of the user.
export function replaceFrame(material, options) {
  const { frame, against } = replaceOptions(material, options, { from: undefined });
  return setFrame(material, { frame: frameFor(material, frame), against });
}

function setFrame(material, { frame, against, inverted = false }) {
  const { normalMap, clearcoatNormalMap } = material, coatAlone = frame === kCoatAlone, tangents = coatAlone || frame === kTangents;
  if (tangents) restoreFrame(material);
  const put = (name, map, scale) => {
    if (material[name] && !ours.has(material[name])) return;
    material[name] = perturbed(mapOfMaterial(map), materialReference(scale, 'vec2'), coatAlone ? 'orthonormal' : frame);
    ours.add(material[name]);
  };
  if (normalMap && !tangents && material.normalMapType !== ObjectSpaceNormalMap) put('normalNode', 'normalMap', 'normalScale');
  if (clearcoatNormalMap && frame !== kTangents) put('clearcoatNormalNode', 'clearcoatNormalMap', 'clearcoatNormalScale');
  if (inverted) material.setupVariants = variantsInverted;
  else if (material.anisotropy !== undefined && !tangents) material.setupVariants = variantsWith(frame, against);
  material.needsUpdate = true;
  chosen.set(material, { frame, against, inverted });
  addToKey(material, 'frame', keyOf);
  return keepInClones(material, (clone, source) => setFrame(clone, chosen.get(source)));
}

// Makes a material with a replaced frame draw three's own again.
function restoreFrame(material) {
  if (!chosen.has(material)) return;
  for (const name of ['normalNode', 'clearcoatNormalNode']) if (ours.has(material[name])) material[name] = null;
  delete material.setupVariants;
  Object.assign(chosen.get(material), { frame: 'mikktspace', inverted: false });
  material.needsUpdate = true;
  keepInClones(material, () => {});
}

// What three leaves out of the key: the nodes of a material that is no node material, and what ours and setupVariants
// depend on. Our nodes are equal for all maps of one kind.
function keyOf(material) {
  const { frame, against, inverted } = chosen.get(material);
  const nodes = material.isNodeMaterial ? [] : Object.entries(material).filter(([, value]) => value?.isNode)
    .flatMap(([name, node]) => [name, ours.has(node) ? '' : node.getCacheKey(true)]);
  const kinds = [material.normalMap, material.clearcoatNormalMap].map(map => map && hasTwoChannels(map));
  return [frame, against, inverted, ...kinds, ...nodes].join();
}

// The perturbed unit normal in view space. The tangent-space map is sampled with its own uv set and matrix.
// map: a Texture. scale: a vec2 node; after scaling, green must point along v.
export function perturbedNormal(map, scale = vec2(1), frame = 'orthonormal') {
  if (!map?.isTexture) throw usage(`map: expected a Texture, found ${wordsFor(map)}`);
  choice(frame, 'frame', kSupported);
  if (!scale?.isNode) throw usage(`scale: expected a vec2 node, found ${wordsFor(scale)}`);
  const sample = texture(map);
  return perturbed(() => ({ map, sample, node: sample }), scale, frame);
}

const hasTwoChannels = map => [RGFormat, RED_GREEN_RGTC2_Format, RG11_EAC_Format].includes(map.format);

// The map of the material that is drawn, by its name, so that materials with other maps can use the same nodes. Gives
// { map, sample, node } for a builder: sample: what to read, node: the texture's node within.
function mapOfMaterial(name) {
  const sample = materialReference(name, 'texture');
  return builder => {
    sample.updateReference(builder);
    sample.updateValue();
    return { map: builder.material[name], sample, node: sample.node };
  };
}

// source: gives the map, as mapOfMaterial().
function perturbed(source, scale, frame) {
  return Fn((_, builder) => {
    const read = source(builder), c = read.sample.mul(2).sub(1).xyz.toVar();
    if (hasTwoChannels(read.map)) c.z.assign(c.xy.dot(c.xy).oneMinus().saturate().sqrt());
    const { t, b, n } = frameOf(frame, read, builder);
    return t.mul(c.x.mul(scale.x)).add(b.mul(c.y.mul(scale.y))).add(n.mul(c.z)).normalize();
  })();
}

// The frame in three's convention: on back faces t, b and n are those of the front, negated. read: as from
// mapOfMaterial(), null without a map.
function frameOf(frame, read, builder) {
  const flat = builder.isFlatShading();
  const n = (flat ? normalViewGeometry : negateOnBackSide(normalViewGeometry)).toVar();
  const native = builder.renderer.backend.isWebGPUBackend ? inWgsl : inEssl;
  let f;
  if (frame === 'triangle') {
    const flatly = node => varying(node).setInterpolation(InterpolationSamplingType.FLAT, InterpolationSamplingMode.FIRST);
    const words = attribute(kTriangleAttribute, 'uvec3');
    const moved = native.moved;
    const u = flatly(moved({ words, matrix: modelViewMatrix, second: false })), v = flatly(moved({ words, matrix: modelViewMatrix, second: true }));
    // cotan_frame_of_triangle already negates t and b where n was flipped towards the eye.
    f = native.triangle({ n, u, v }).toVar();
    return { t: f[0], b: f[1], n };
  }
  if (frame === 'smooth') { // covectors are transformed like normals
    const moved = name => varying(cameraViewMatrix.mul(vec4(modelNormalMatrix.mul(attribute(name, 'vec3')), 0)).xyz);
    f = native.smooth({ n, u: moved('cotanU'), v: moved('cotanV') }).toVar();
    return { t: negateOnBackSide(f[0]), b: negateOnBackSide(f[1]), n };
  }
  const at = read ? read.node.getTransformedUV(uv(read.map.channel)) : uv();
  f = native[frame]({ n, dpdx: positionView.dFdx(), dpdy: positionView.dFdy(), duvdx: at.dFdx(), duvdy: at.dFdy() }).toVar();
  return { t: negateOnBackSide(f[0]), b: negateOnBackSide(f[1]), n };
}

// A setupVariants for MeshPhysicalNodeMaterial that inverts three's bitangents in the directions of anisotropy.
function variantsInverted(builder) {
  Object.getPrototypeOf(this).setupVariants.call(this, builder);
  if (!this.useAnisotropy || !builder.geometry.hasAttribute('tangent')) return;
  const t = TBNViewMatrix[0], b = TBNViewMatrix[1].negate(), v = directionOf(this);
  anisotropyT.assign(t.mul(v.x).add(b.mul(v.y)));
  anisotropyB.assign(b.mul(v.x).sub(t.mul(v.y)));
}

// The unit direction of anisotropy from u towards v.
function directionOf(material) {
  const v = (material.anisotropyNode ? vec2(material.anisotropyNode) : materialAnisotropy).toVar();
  v.assign(v.length().greaterThan(0).select(v.normalize(), vec2(1, 0)));
  return v;
}

// A setupVariants for MeshPhysicalNodeMaterial that sets orthonormal directions of anisotropy in the surface.
function variantsWith(frame, against) {
  return function setupVariants(builder) {
    Object.getPrototypeOf(this).setupVariants.call(this, builder);
    if (!this.useAnisotropy) return;
    const map = ['normalMap', 'anisotropyMap', 'clearcoatNormalMap'].find(name => builder.material[name]); // it may have gone meanwhile
    const read = map ? mapOfMaterial(map)(builder) : null;
    const { t, b, n } = frameOf(frame, read, builder);
    const along = t.dot(b.cross(n)).sign().mul(b.cross(n)).normalize().toVar();
    const across = n.cross(along).toVar();
    across.mulAssign(across.dot(b).sign().mul(against ? -1 : 1));
    const v = directionOf(this);
    anisotropyT.assign(along.mul(v.x).add(across.mul(v.y)));
    anisotropyB.assign(across.mul(v.x).sub(along.mul(v.y)));
  };
}

// The text of `cotan shader`, wrapped in functions with a single result, the only kind that the node language can call.
const kParameters = { wgsl: 'n: vec3f, dpdx: vec3f, dpdy: vec3f, duvdx: vec2f, duvdy: vec2f', glsl: 'vec3 n, vec3 dpdx, vec3 dpdy, vec2 duvdx, vec2 duvdy' };
const inWgsl = Object.fromEntries(['cotangent', 'orthonormal'].map(frame => [frame, wgslFn(`
fn cotanFrame_${frame}(${kParameters.wgsl}) -> mat3x3f {
  let f = cotan_frame_${frame}(n, dpdx, dpdy, duvdx, duvdy);
  return mat3x3f(f.t, f.b, f.n);
}`, [code(wgsl[frame], [], 'wgsl')])]));
const inEssl = Object.fromEntries(['cotangent', 'orthonormal'].map(frame => [frame, glslFn(`
mat3 cotanFrame_${frame}(${kParameters.glsl}) {
  cotan_frame f = cotan_frame_${frame}(n, dpdx, dpdy, duvdx, duvdy);
  return mat3(f.t, f.b, f.n);
}`, [code(essl[frame], [], 'glsl')])]));
// Frames of two vectors that the geometry gives.
for (const [frame, name] of [['smooth', 'cotan_frame_smooth'], ['triangle', 'cotan_frame_of_triangle']]) {
  inWgsl[frame] = wgslFn(`
fn cotanFrame_${frame}(n: vec3f, u: vec3f, v: vec3f) -> mat3x3f {
  let f = ${name}(n, u, v);
  return mat3x3f(f.t, f.b, f.n);
}`, [code(wgsl[frame], [], 'wgsl')]);
  inEssl[frame] = glslFn(`
mat3 cotanFrame_${frame}(vec3 n, vec3 u, vec3 v) {
  cotan_frame f = ${name}(n, u, v);
  return mat3(f.t, f.b, f.n);
}`, [code(essl[frame], [], 'glsl')]);
}
// Unpacks U or V and transforms it to view space.
inWgsl.moved = wgslFn(`
fn cotanMoved(words: vec3u, matrix: mat4x4f, second: bool) -> vec3f {
  let a = unpack2x16float(words.x);
  let b = unpack2x16float(words.y);
  let c = unpack2x16float(words.z);
  let m = mat3x3f(matrix[0].xyz, matrix[1].xyz, matrix[2].xyz);
  let f = cotan_triangle_unit(m * vec3f(a, b.x), m * vec3f(b.y, c), cotan_sign(determinant(m)));
  return select(f.u, f.v, second);
}`, [code(wgsl.triangle, [], 'wgsl')]);
inEssl.moved = glslFn(`
vec3 cotanMoved(uvec3 words, mat4 matrix, bool second) {
  vec2 a = unpackHalf2x16(words.x), b = unpackHalf2x16(words.y), c = unpackHalf2x16(words.z);
  mat3 m = mat3(matrix);
  cotan_triangle f = cotan_triangle_unit(m * vec3(a, b.x), m * vec3(b.y, c), cotan_sign(determinant(m)));
  return second ? f.v : f.u;
}`, [code(essl.triangle, [], 'glsl')]);
