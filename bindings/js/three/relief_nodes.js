// Relief from height maps for three.js and its WebGPURenderer, on WebGPU and WebGL 2, in the node language.
import * as tsl from 'three/tsl';
import * as three from 'three/webgpu';
import { CotanError } from '../src/errors.js';
import { addToKey } from './node_keys.js';
import { kHalvings, keyOfRelief, renamed, withRelief } from './relief_options.js';
import { essl, wgsl } from './relief_text.js';

export { CotanError };

const { Fn, Loop, code, context, faceDirection, glslFn, normalViewGeometry, positionView, positionViewDirection, property, texture, uniform, uv, vec2, wgslFn } = tsl;
if (parseInt(three.REVISION) < 187) // earlier ones have no getTextureGradient
  throw new CotanError('unavailable', `three: expected version 0.187 or later for cotan/three/tsl/relief, found ${three.REVISION}`);

// Moves all lookups of a material on one uv set to where the line of sight meets a height map. See relief.d.ts.
export const addRelief = (material, options) => withRelief(material, options, add);

const ours = new WeakSet(); // nodes that add() made

function add(material) {
  if (!ours.has(material.contextNode)) {
    const { getUV, getTextureGradient, ...given } = material.contextNode?.getFlowContextData() ?? {};
    material.contextNode = context({
      ...given,
      getUV: (node, builder) => (isMoved(node, builder) ? at : getUV?.(node, builder)),
      getTextureGradient: (node, builder) => (isMoved(node, builder) ? [dx, dy] : getTextureGradient?.(node, builder)),
    });
    ours.add(material.contextNode);
  }
  Object.assign(material, { setupDiffuseColor, setupLightingModel, setupNormal: lookedUp('setupNormal') });
  if (material.clearcoat !== undefined) material.setupClearcoatNormal = lookedUp('setupClearcoatNormal');
  addToKey(material, 'relief', keyOfRelief);
}

// What a pixel finds: texture coordinates, their differences from before the offset, the stored height there, the frame.
const at = property('vec2', 'cotanReliefUv'), dx = property('vec2', 'cotanReliefDx'), dy = property('vec2', 'cotanReliefDy');
const height = property('float', 'cotanReliefHeight'), frame = property('mat3', 'cotanReliefVectors');

// Whether a texture node reads a map of the material on the uv set of the height map, in its fragment shader.
function isMoved(node, { material, shaderStage }) {
  return shaderStage === 'fragment' && material.heightMap && !material.fragmentNode && !node.isCubeTextureNode && !node.isTexture3DNode
    && node.value?.channel === material.heightMap.channel;
}

// Of the material that is drawn: materials with other maps can have the same program.
const depth = uniform(0).onObjectUpdate(({ material }) => (material.heightMap ? material.heightDepth : 0));

function heightAt(builder, uvNode) {
  const map = texture(builder.material.heightMap).onObjectUpdate(({ material }) => material.heightMap ?? undefined);
  // A node with a gradient of its own does not apply the matrix of the texture.
  const origin = map.getTransformedUV(vec2(0)), differences = [dx, dy].map(d => map.getTransformedUV(d).sub(origin));
  return map.sample(map.getTransformedUV(uvNode)).grad(...differences).x;
}

// Runs before anything reads a map.
function setupDiffuseColor(builder) {
  if (this.heightMap) findRelief(builder, this);
  Object.getPrototypeOf(this).setupDiffuseColor.call(this, builder);
}

function findRelief(builder, { heightMap, heightSteps }) {
  const native = nativeOf(builder), flat = builder.isFlatShading(), isBack = builder.material.side === three.BackSide;
  const given = uv(heightMap.channel), n = (flat && builder.material.side === three.DoubleSide ? normalViewGeometry.mul(faceDirection) : isBack && !flat ? normalViewGeometry.negate() : normalViewGeometry);
  dx.assign(given.dFdx());
  dy.assign(given.dFdy());
  frame.assign(native.frame({ n, dpdx: positionView.dFdx(), dpdy: positionView.dFdy(), duvdx: dx, duvdy: dy }));
  at.assign(Fn(() => {
    const r = native.start({ f: frame, toEye: positionViewDirection, uv: given, depth, steps: heightSteps }).toVar();
    Loop(heightSteps + kHalvings, () => { r.assign(native.next({ r, height: heightAt(builder, r[0].xy) })); });
    return r[0].xy;
  })());
  height.assign(heightAt(builder, at));
}

// A function of a material whose result looks up maps as the others do, although three resets that for normals.
const lookedUp = name => function (builder) {
  const { getUV, getTextureGradient } = this.contextNode.getFlowContextData();
  return Object.getPrototypeOf(this)[name].call(this, builder).context({ getUV, getTextureGradient });
};

// Darkens each light that has a direction where the relief is in its way.
function setupLightingModel(builder) {
  const model = Object.getPrototypeOf(this).setupLightingModel.call(this, builder), { heightMap, heightSteps, selfShadow } = this;
  if (!heightMap || !selfShadow) return model;
  const { direct } = model, native = nativeOf(builder);
  model.direct = function (data, given) {
    const lit = Fn(() => {
      const r = native.shadow({ f: frame, toLight: data.lightDirection, uv: at, height, depth, steps: heightSteps }).toVar();
      Loop(heightSteps, () => { r.assign(native.next({ r, height: heightAt(builder, r[0].xy) })); });
      return r[2].z.oneMinus();
    })();
    return direct.call(this, { ...data, lightColor: data.lightColor.mul(lit) }, given);
  };
  return model;
}

const nativeOf = builder => (builder.renderer.backend.isWebGPUBackend ? inWgsl : inEssl);

// Functions with a single result, the only kind that the node language can call: a search is packed into a matrix.
const inWgsl = of(wgslFn, code(`${renamed(wgsl)}
fn cotanPacked(r: cotanr_relief) -> mat4x4f {
  return mat4x4f(vec4f(r.uv, r.origin), vec4f(r.travel, r.at, r.step), vec4f(r.begin, r.climb, r.found, 0.0), vec4f());
}
fn cotanUnpacked(m: mat4x4f) -> cotanr_relief {
  return cotanr_relief(m[0].xy, m[0].zw, m[1].xy, m[1].z, m[1].w, m[2].x, m[2].y, m[2].z);
}`, [], 'wgsl'), {
  frame: `fn cotanReliefFrame(n: vec3f, dpdx: vec3f, dpdy: vec3f, duvdx: vec2f, duvdy: vec2f) -> mat3x3f {
  let f = cotanr_frame_gradient(n, dpdx, dpdy, duvdx, duvdy);
  return mat3x3f(f.t, f.b, f.n);
}`,
  start: `fn cotanReliefStart(f: mat3x3f, toEye: vec3f, uv: vec2f, depth: f32, steps: f32) -> mat4x4f {
  return cotanPacked(cotanr_relief_start(cotanr_frame(f[0], f[1], f[2]), toEye, uv, depth, steps));
}`,
  next: `fn cotanReliefNext(r: mat4x4f, height: f32) -> mat4x4f {
  return cotanPacked(cotanr_relief_next(cotanUnpacked(r), height));
}`,
  shadow: `fn cotanReliefShadow(f: mat3x3f, toLight: vec3f, uv: vec2f, height: f32, depth: f32, steps: f32) -> mat4x4f {
  return cotanPacked(cotanr_relief_shadow(cotanr_frame(f[0], f[1], f[2]), toLight, uv, height, depth, steps));
}`,
});
const inEssl = of(glslFn, code(`${renamed(essl)}
mat4 cotanPacked(cotanr_relief r) {
  return mat4(vec4(r.uv, r.origin), vec4(r.travel, r.at, r.step), vec4(r.begin, r.climb, r.found, 0.0), vec4(0.0));
}
cotanr_relief cotanUnpacked(mat4 m) {
  return cotanr_relief(m[0].xy, m[0].zw, m[1].xy, m[1].z, m[1].w, m[2].x, m[2].y, m[2].z);
}`, [], 'glsl'), {
  frame: `mat3 cotanReliefFrame(vec3 n, vec3 dpdx, vec3 dpdy, vec2 duvdx, vec2 duvdy) {
  cotanr_frame f = cotanr_frame_gradient(n, dpdx, dpdy, duvdx, duvdy);
  return mat3(f.t, f.b, f.n);
}`,
  start: `mat4 cotanReliefStart(mat3 f, vec3 toEye, vec2 uv, float depth, float steps) {
  return cotanPacked(cotanr_relief_start(cotanr_frame(f[0], f[1], f[2]), toEye, uv, depth, steps));
}`,
  next: `mat4 cotanReliefNext(mat4 r, float height) {
  return cotanPacked(cotanr_relief_next(cotanUnpacked(r), height));
}`,
  shadow: `mat4 cotanReliefShadow(mat3 f, vec3 toLight, vec2 uv, float height, float depth, float steps) {
  return cotanPacked(cotanr_relief_shadow(cotanr_frame(f[0], f[1], f[2]), toLight, uv, height, depth, steps));
}`,
});
function of(make, shared, texts) {
  return Object.fromEntries(Object.entries(texts).map(([name, text]) => [name, make(text, [shared])]));
}
