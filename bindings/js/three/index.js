// Cotan for three.js and its WebGLRenderer: normal mapping without tangents. For WebGPURenderer: tsl.js.
import { ShaderChunk } from 'three';
import { options as checked } from '../src/arrays.js';
import { frameFor } from './frames.js';
import { untangleMeshes, untangleOptions } from './meshes.js';
import { essl } from './shader_text.js';
import { kTriangleAttribute } from './triangles.js';

export { CotanError } from '../src/errors.js';

// Removes the tangents of `target` and lets its materials take their frame from Cotan. See index.d.ts.
export function untangle(target, options) {
  return untangleMeshes(target, untangleOptions(options), { provoking: 'last' }, replaceFrame);
}

// The same as a plugin: loader.register(untangled()).
export const untangled = options => {
  untangleOptions(options);
  return () => ({ name: 'COTAN_untangled', async afterRoot(gltf) { untangle(gltf, options); } });
};

const patched = new WeakMap();  // frame and hooks of the materials that are

// Replaces the frame of one material, and nothing else: no tangents are removed and no scale is turned.
// from: the material that this is a clone of, since clones have no hooks.
export function replaceFrame(material, options) {
  const { frame: wished, against, from } = checked(options, { frame: undefined, against: false, from: material });
  const frame = frameFor(material, wished);
  const { before, key } = patched.get(material) ?? patched.get(from) ?? { before: from.onBeforeCompile, key: from.customProgramCacheKey };
  patched.set(material, { frame, against, before, key });
  material.needsUpdate = true;
  material.onBeforeCompile = (shader, renderer) => {
    before.call(material, shader, renderer);
    if (shader.vertexTangents)
      console.warn(`Cotan: a mesh with the material "${material.name || material.type}" has tangents, so three does not use Cotan's `
        + 'frame: call untangle() on it');
    patchFragment(shader, material, { frame, against });
    if (kCarried[frame]) patchVertex(shader, material, kCarried[frame]);
  };
  // three's own key is the text of onBeforeCompile, which is ours now.
  const own = key !== Object.getPrototypeOf(material).customProgramCacheKey;
  material.customProgramCacheKey = () => ['cotan', frame, against, before, own ? key.call(material) : ''].join();
  return material;
}

// Puts `text` in the place of what `pattern` finds, or says that it is not there.
function put(shader, stage, pattern, text, material) {
  if (!shader[stage].match(pattern))
    throw new Error(`Cotan: no ${pattern} in the shader of ${material.type}; three.js 0.187 has it`);
  shader[stage] = shader[stage].replace(pattern, () => text);
}

const kInclude = '#include <normalmap_pars_fragment>', kFunction = /mat3 getTangentFrame\([^{]*\{[^}]*\}/;

function patchFragment(shader, material, { frame, against }) {
  const chunk = { text: ShaderChunk.normalmap_pars_fragment }, carried = kCarried[frame];
  put(chunk, 'text', kFunction, `${essl[frame]}\n${carried ? carried.frame : frameOf(frame)}`, material);
  put(shader, 'fragmentShader', kInclude, (carried ? carried.varyings('in') : '') + chunk.text + kAnisotropyFrame, material);
  // From here on three needs its frame for anisotropy only.
  const maps = '#include <normal_fragment_maps>';
  put(shader, 'fragmentShader', maps, `${maps}
#if defined( USE_ANISOTROPY ) && ! defined( USE_TANGENT )
tbn = cotanAnisotropyFrame( tbn, nonPerturbedNormal, ${against ? '-1.0' : '1.0'} );
#endif
`, material);
}

// three passes -vViewPosition, which points from the eye.
const frameOf = name => `mat3 getTangentFrame( vec3 position, vec3 n, vec2 uv ) {
	cotan_frame f = cotan_frame_${name}( n, dFdx( position ), dFdy( position ), dFdx( uv ), dFdy( uv ) );
	return mat3( f.t, f.b, f.n );
}`;

// t and b come out reversed where n is turned to the eye; three turns them itself where it means that.
const kTriangleFrame = `mat3 getTangentFrame( vec3 position, vec3 n, vec2 uv ) {
	cotan_frame f = cotan_frame_of_triangle( n, vCotanU, vCotanV );
	#ifdef FLIP_SIDED
		float side = - 1.0;
	#else
		float side = gl_FrontFacing ? 1.0 : - 1.0;
	#endif
	return mat3( f.t * side, f.b * side, f.n );
}`;

// Anisotropy means directions on the surface, at right angles and of unit length, not how bumps lean.
const kAnisotropyFrame = `
#if defined( USE_ANISOTROPY ) && ! defined( USE_TANGENT )
mat3 cotanAnisotropyFrame( mat3 f, vec3 n, float side ) {
	vec3 t = cross( f[ 1 ], n );  // along increasing u, at right angles to the gradient of v
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

// Frames that geometries carry: what the vertex shader reads and hands on.
const kCarried = {
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
    // Covectors move as three moves normals.
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
