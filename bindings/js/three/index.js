// Cotan for three.js and its WebGLRenderer: normal mapping without tangents. For WebGPURenderer: tsl.js.
import { REVISION, ShaderChunk } from 'three';
import { CotanError } from '../src/errors.js';
import { frameFor } from './frames.js';
import { put, writeWith } from './hooks.js';
import { kCoatAlone, keepInClones, kTangents, replaceOptions, untangleMeshes, untangleOptions } from './meshes.js';
import { essl } from './shader_text.js';
import { kTriangleAttribute } from './triangles.js';

export { CotanError };

// Removes tangents of `target` where nobody can see it, and makes its materials use frames of Cotan. See index.d.ts.
export function untangle(target, options) {
  return untangleMeshes(target, untangleOptions(options), { provoking: 'last' }, setFrame, restoreFrame);
}

// untangle() as a plugin: loader.register(untangled()).
export const untangled = options => {
  untangleOptions(options);
  return () => ({ name: 'COTAN_untangled', async afterRoot(gltf) { (gltf.userData ??= {}).cotan = untangle(gltf, options); } });
};

const frames = new WeakMap(); // by material: { frame, against, inverted }. frame: `mikktspace` where three's own is drawn again, or as kTangents

// Replaces the frame of one material and nothing else: removes no tangents and flips no scale. The user's hooks stay,
// even if set later, and clone() keeps the frame.
// from: the material whose hooks are taken over, and whose frame if none is requested.
export function replaceFrame(material, options) {
  const { frame: requested, against, from } = replaceOptions(material, options, { from: material });
  const taken = requested === undefined && from !== material && frames.get(from)?.frame;
  return setFrame(material, { frame: taken || frameFor(material, requested), against, from });
}

function setFrame(material, { frame, against, inverted = false, from }) {
  checkThree();
  frames.set(material, { frame, against, inverted });
  writeWith(material, 'frame', keyOf, writeFrame, from);
  return keepInClones(material, (clone, source) => setFrame(clone, frames.get(source)));
}

// Makes a material with a replaced frame draw three's own again.
function restoreFrame(material) {
  if (!frames.has(material)) return;
  Object.assign(frames.get(material), { frame: 'mikktspace', inverted: false });
  material.needsUpdate = true;
  keepInClones(material, () => {});
}

const keyOf = material => Object.values(frames.get(material)).join();

function writeFrame(shader, material) {
  const { frame, against, inverted } = frames.get(material);
  if (frame === kCoatAlone) patchCoat(shader, material);
  if (inverted) put(shader, 'fragmentShader', kMaps, `${kMaps}\n#if defined( USE_ANISOTROPY ) && defined( USE_TANGENT )\ntbn[ 1 ] = - tbn[ 1 ];\n#endif\n`, material);
  if (['mikktspace', kCoatAlone, kTangents].includes(frame)) return;
  if (shader.vertexTangents)
    console.warn(`Cotan: a mesh with the material "${material.name || material.type}" has tangents, so three does not use Cotan's `
      + 'frame: call untangle() on it');
  patchFragment(shader, material, { frame, against });
  if (kStoredFrames[frame]) patchVertex(shader, material, kStoredFrames[frame]);
}

// Throws if this version of three lacks the function to replace, so that the error comes before anything is drawn.
function checkThree() {
  if (!kFunction.test(ShaderChunk.normalmap_pars_fragment ?? ''))
    throw new CotanError('unavailable', `three: expected version 0.160 or later with getTangentFrame in its shaders, found ${REVISION}`);
}

const kMaps = '#include <normal_fragment_maps>'; // after this chunk three uses its frame only for anisotropy
const kInclude = '#include <normalmap_pars_fragment>', kFunction = /mat3 getTangentFrame\([^{]*\{[^}]*\}/;

function patchFragment(shader, material, { frame, against }) {
  const chunk = { text: ShaderChunk.normalmap_pars_fragment }, stored = kStoredFrames[frame];
  put(chunk, 'text', kFunction, `${essl[frame]}\n${stored ? stored.frame : frameOf(frame)}`, material);
  put(shader, 'fragmentShader', kInclude, (stored ? stored.varyings('in') : '') + chunk.text + kAnisotropyFrame, material);
  put(shader, 'fragmentShader', kMaps, `${kMaps}
#if defined( USE_ANISOTROPY ) && ! defined( USE_TANGENT )
#if defined( USE_ANISOTROPYMAP ) && ! defined( USE_NORMALMAP )
tbn = getTangentFrame( - vViewPosition, nonPerturbedNormal, vAnisotropyMapUv );
${kBothSides('tbn')}
#endif
tbn = cotanAnisotropyFrame( tbn, nonPerturbedNormal, ${against ? '-1.0' : '1.0'} );
#endif
`, material);
}

// Makes three, which has the tangents of another map, use a frame for the coat.
function patchCoat(shader, material) {
  const begin = '#include <normal_fragment_begin>';
  put(shader, 'fragmentShader', kInclude, `${kInclude}\n${essl.orthonormal}\n${frameOf('orthonormal').replace('getTangentFrame', 'cotanCoatFrame')}\n`, material);
  put(shader, 'fragmentShader', begin, `${begin}
#if defined( USE_CLEARCOAT_NORMALMAP ) && defined( USE_TANGENT )
tbn2 = cotanCoatFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
${kBothSides('tbn2')}
#endif
`, material);
}

// What three does with every frame.
const kBothSides = name => `#ifdef DOUBLE_SIDED
${name}[ 0 ] *= faceDirection;
${name}[ 1 ] *= faceDirection;
#endif`;

// three passes -vViewPosition, the position relative to the eye.
const frameOf = name => `mat3 getTangentFrame( vec3 position, vec3 n, vec2 uv ) {
	cotan_frame f = cotan_frame_${name}( n, dFdx( position ), dFdy( position ), dFdx( uv ), dFdy( uv ) );
	return mat3( f.t, f.b, f.n );
}`;

// cotan_frame_of_triangle reverses t and b where n was flipped towards the eye. `side` undoes it: three does so later.
const kTriangleFrame = `mat3 getTangentFrame( vec3 position, vec3 n, vec2 uv ) {
	cotan_frame f = cotan_frame_of_triangle( n, vCotanU, vCotanV );
	#ifdef FLIP_SIDED
		float side = - 1.0;
	#else
		float side = gl_FrontFacing ? 1.0 : - 1.0;
	#endif
	return mat3( f.t * side, f.b * side, f.n );
}`;

// Anisotropy needs orthonormal directions in the surface instead of cotangents. t: along increasing u, perpendicular to the
// gradient of v.
const kAnisotropyFrame = `
#if defined( USE_ANISOTROPY ) && ! defined( USE_TANGENT )
mat3 cotanAnisotropyFrame( mat3 f, vec3 n, float side ) {
	vec3 t = cross( f[ 1 ], n );
	t = dot( t, f[ 0 ] ) < 0.0 ? - t : t;
	t = cotan_normalize_or( t, cotan_normalize_or( f[ 0 ], vec3( 0.0 ) ) );
	vec3 b = cross( n, t );
	return mat3( t, dot( b, f[ 1 ] ) < 0.0 ? - side * b : side * b, n );
}
#endif
`;

const kSmoothFrame = `mat3 getTangentFrame( vec3 position, vec3 n, vec2 uv ) {
	cotan_frame f = cotan_frame_smooth( n, vCotanU, vCotanV );
	return mat3( f.t, f.b, f.n );
}`;

// Frames stored in the geometry: shader text for the vertex attributes, the varyings and the fragment's frame.
const kStoredFrames = {
  triangle: {
    frame: kTriangleFrame,
    varyings: way => `\nflat ${way} vec3 vCotanU;\nflat ${way} vec3 vCotanV;\n`,
    attributes: `attribute uvec3 ${kTriangleAttribute};\n${essl.triangle}`,
    moved: `{
	vec2 a = unpackHalf2x16( ${kTriangleAttribute}.x ), b = unpackHalf2x16( ${kTriangleAttribute}.y ), c = unpackHalf2x16( ${kTriangleAttribute}.z );
	mat3 move = mat3( modelViewMatrix );
	#ifdef USE_INSTANCING
		move = move * mat3( instanceMatrix );
	#endif
	cotan_triangle moved = cotan_triangle_unit( move * vec3( a, b.x ), move * vec3( b.y, c ), cotan_sign( determinant( move ) ) );
	vCotanU = moved.u;
	vCotanV = moved.v;
}`,
  },
  smooth: {
    frame: kSmoothFrame,
    varyings: way => `\n${way} vec3 vCotanU;\n${way} vec3 vCotanV;\n`,
    attributes: 'attribute vec3 cotanU;\nattribute vec3 cotanV;',
    // Covectors are transformed in the same way as three transforms normals.
    moved: `{
	mat2x3 moved = mat2x3( cotanU, cotanV );
	#ifdef USE_SKINNING
		moved = mat3( skinMatrix ) * moved;
	#endif
	#ifdef USE_INSTANCING
		mat3 each = mat3( instanceMatrix );
		vec3 squares = vec3( dot( each[ 0 ], each[ 0 ] ), dot( each[ 1 ], each[ 1 ] ), dot( each[ 2 ], each[ 2 ] ) );
		moved = each * mat2x3( moved[ 0 ] / squares, moved[ 1 ] / squares );
	#endif
	vCotanU = normalMatrix * moved[ 0 ];
	vCotanV = normalMatrix * moved[ 1 ];
}`,
  },
};

function patchVertex(shader, material, { varyings, attributes, moved }) {
  const begin = '#include <common>', normal = '#include <defaultnormal_vertex>';
  put(shader, 'vertexShader', begin, `${begin}\n${varyings('out')}${attributes}\n`, material);
  put(shader, 'vertexShader', normal, `${normal}\n${moved}\n`, material);
}
