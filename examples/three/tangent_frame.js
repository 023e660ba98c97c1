// Lets a three.js material with a normal map (MeshStandardMaterial and its kin) take its tangent-free frame from Cotan:
// three's own function getTangentFrame is replaced, everything around it stays (normalScale, both sides, clear coat).
// cotan: the output of `cotan shader --lang essl --form total`.
export function useCotanFrame(material, cotan) {
  material.onBeforeCompile = shader => {
    shader.fragmentShader = shader.fragmentShader.replace('#include <normalmap_pars_fragment>', `
#ifdef USE_NORMALMAP
uniform sampler2D normalMap;
uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
uniform mat3 normalMatrix;
#endif
${cotan}
mat3 getTangentFrame(vec3 position, vec3 n, vec2 uv) {  // three passes -vViewPosition, which points from the eye
  cotan_frame f = cotan_frame_cotangent(n, dFdx(position), dFdy(position), dFdx(uv), dFdy(uv));
  return mat3(f.t, f.b, f.n);
}
`);
  };
  material.customProgramCacheKey = () => 'cotan';
  return material;
}
