// Relief from height maps for three.js and its WebGLRenderer. For WebGPURenderer: relief_nodes.js.
import { Matrix3, ShaderChunk } from 'three';
import { CotanError } from '../src/errors.js';
import { put, writeWith } from './hooks.js';
import { kHalvings, keyOfRelief, renamed, withRelief } from './relief_options.js';
import { essl } from './relief_text.js';

export { CotanError };

// Moves all lookups of a material on one uv set to where the line of sight meets a height map. See relief.d.ts.
export const addRelief = (material, options) => withRelief(material, options, add);

const add = material => writeWith(material, 'relief', keyOfRelief, writeRelief);

function writeRelief(shader, material) {
  if (!material.heightMap) return;
  const set = uvName(material.heightMap.channel), moved = mapsOn(shader, set);
  Object.assign(shader.uniforms, {
    cotanHeightMap: { get value() { return material.heightMap; } },
    cotanHeightDepth: { get value() { return material.heightMap ? material.heightDepth : 0; } },
    cotanHeightTransform: { get value() { return matrixOf(material); } },
    ...Object.fromEntries(moved.map(name => [transformOf(name), shader.uniforms[`${name}Transform`]])),
  });
  const begin = /void main\(\)\s*\{/, uv = '#include <uv_vertex>', normal = '#include <normal_fragment_begin>';
  put(shader, 'vertexShader', begin, `${set === 'uv' ? '' : `#ifndef USE_${set.toUpperCase()}
	attribute vec2 ${set};
#endif
`}varying vec2 vCotanHeightUv;
void main() {
	vCotanHeightUv = ${set};
`, material);
  // The frame for the normal map is that of the coordinates that are not moved.
  put(shader, 'fragmentShader', normal, `${moved.map(name => `#undef ${varyingOf(name)}\n`).join('')}${normal}\n${defines(moved)}`, material);
  put(shader, 'fragmentShader', begin, `${renamed(essl)}${reliefText(moved, material)}${defines(moved)}
#undef texture2D
#define texture2D cotanTexture
void main() {
	cotanFindRelief();
`, material);
  if (material.selfShadow && !material.isMeshMatcapMaterial) shadeLights(shader, material);
}

const uvName = channel => (channel ? `uv${channel}` : 'uv');

// The matrix of the texture, which three updates only for maps that it knows.
function matrixOf({ heightMap }) {
  if (heightMap?.matrixAutoUpdate) heightMap.updateMatrix();
  return heightMap?.matrix ?? kNone;
}
const kNone = new Matrix3();

// The maps that three looks up in the fragment shader at texture coordinates of this set. A bumpMap takes differences of
// neighbours, and stays.
const mapsOn = (shader, set) => Object.keys(shader)
  .filter(key => key.endsWith('apUv') && shader[key] === set && !['bumpMapUv', 'displacementMapUv'].includes(key)).map(key => key.slice(0, -2));
const capital = name => name[0].toUpperCase() + name.slice(1);
const varyingOf = name => `v${capital(name)}Uv`, placeOf = name => `cotan${capital(name)}At`, transformOf = name => `cotan${capital(name)}Transform`;
const defines = moved => moved.map(name => `#define ${varyingOf(name)} ${placeOf(name)}\n`).join('');

// three writes texture2D( map, vMapUv ). Where vMapUv is a CotanAt, that reads with the differences from before the offset.
const reliefText = (moved, { heightSteps, selfShadow }) => `
varying vec2 vCotanHeightUv;
uniform highp sampler2D cotanHeightMap;
uniform mat3 cotanHeightTransform;
uniform float cotanHeightDepth;
struct CotanAt { vec2 uv; vec2 dx; vec2 dy; };
vec4 cotanTexture( highp sampler2D map, CotanAt at ) { return textureGrad( map, at.uv, at.dx, at.dy ); }
vec4 cotanTexture( highp sampler2D map, vec2 at ) { return texture( map, at ); }
vec4 cotanTexture( highp sampler2D map, vec2 at, float bias ) { return texture( map, at, bias ); }
${moved.map(name => `uniform mat3 ${transformOf(name)};\nCotanAt ${placeOf(name)};\n`).join('')}
cotanr_frame cotanReliefFrame;
CotanAt cotanReliefAt;
float cotanReliefHeight;
CotanAt cotanMoved( mat3 m ) {
	return CotanAt( ( m * vec3( cotanReliefAt.uv, 1.0 ) ).xy, mat2( m ) * cotanReliefAt.dx, mat2( m ) * cotanReliefAt.dy );
}
float cotanHeightAt( vec2 uv ) {
	cotanReliefAt.uv = uv;
	return cotanTexture( cotanHeightMap, cotanMoved( cotanHeightTransform ) ).x;
}
void cotanFindRelief() {
	#ifdef FLAT_SHADED
		vec3 n = normalize( cross( dFdx( vViewPosition ), dFdy( vViewPosition ) ) );
		n = ( dot( n, vViewPosition ) < 0.0 ) == gl_FrontFacing ? - n : n;
	#else
		vec3 n = vNormal;
	#endif
	cotanReliefAt = CotanAt( vCotanHeightUv, dFdx( vCotanHeightUv ), dFdy( vCotanHeightUv ) );
	cotanReliefFrame = cotanr_frame_gradient( n, dFdx( - vViewPosition ), dFdy( - vViewPosition ), cotanReliefAt.dx, cotanReliefAt.dy );
	vec3 toEye = isOrthographic ? vec3( 0.0, 0.0, 1.0 ) : vViewPosition;
	cotanr_relief r = cotanr_relief_start( cotanReliefFrame, toEye, vCotanHeightUv, cotanHeightDepth, ${heightSteps}.0 );
	for ( int i = 0; i < ${heightSteps + kHalvings}; ++ i ) r = cotanr_relief_next( r, cotanHeightAt( r.uv ) );
	cotanReliefHeight = cotanHeightAt( r.uv );
${moved.map(name => `	${placeOf(name)} = cotanMoved( ${transformOf(name)} );\n`).join('')}}
${selfShadow ? `float cotanReliefLight( vec3 toLight ) {
	CotanAt at = cotanReliefAt;
	cotanr_relief r = cotanr_relief_shadow( cotanReliefFrame, toLight, at.uv, cotanReliefHeight, cotanHeightDepth, ${heightSteps}.0 );
	for ( int i = 0; i < ${heightSteps}; ++ i ) r = cotanr_relief_next( r, cotanHeightAt( r.uv ) );
	cotanReliefAt = at;
	return 1.0 - r.found;
}
` : ''}`;

// Darkens each light that has a direction where the relief is in its way.
function shadeLights(shader, material) {
  const lights = '#include <lights_fragment_begin>';
  if (shader.fragmentShader.includes(lights)) put(shader, 'fragmentShader', lights, ShaderChunk.lights_fragment_begin, material);
  put(shader, 'fragmentShader', /RE_Direct\( directLight,/g, 'directLight.color *= cotanReliefLight( directLight.direction );\nRE_Direct( directLight,', material);
}
