// Lets the materials with normal maps (MeshStandardMaterial and its kin) of `object`, a mesh or all that is below it, take
// their tangent-free frame from Cotan: three's own function getTangentFrame is replaced, everything around it stays
// (normalScale, both sides, clear coat). cotan: the output of `cotan shader --lang essl --form total`.
// Tangents are removed from the geometries, since three does not call the function where there are any. What three draws
// with such a material from then on is an error where the function has no place in its shader.
export function useCotanFrame(object, cotan) {
  const meshes = [];
  object.traverse(child => { if (child.isMesh) meshes.push(child); });
  const materials = new Set(meshes.flatMap(mesh => mesh.material).filter(material => material.normalScale));
  // Where v runs down, as in glTF, stored bitangents run against it, and green with them. Without tangents it is
  // normalScale that says so, which is what GLTFLoader does for models that have none.
  const turned = new Set(meshes.filter(mesh => bitangentsRunAgainstV(mesh.geometry)).flatMap(mesh => mesh.material));
  for (const mesh of meshes) mesh.geometry.deleteAttribute('tangent');
  for (const material of materials) {
    if (turned.has(material))
      for (const scale of [material.normalScale, material.clearcoatNormalScale]) if (scale) scale.y = -scale.y;
    replaceFrame(material, cotan);
  }
  return object;
}

function replaceFrame(material, cotan) {
  const place = '#include <normalmap_pars_fragment>';
  material.onBeforeCompile = shader => {
    if (!shader.fragmentShader.includes(place)) throw new Error(`no ${place} in the shader of ${material.type}`);
    shader.fragmentShader = shader.fragmentShader.replace(place, `
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
  material.needsUpdate = true;
}

// Whether cross(normal, tangent) * tangent.w points against increasing v, by most triangles.
function bitangentsRunAgainstV({ attributes: { position, normal, uv, tangent }, index }) {
  if (!position || !normal || !uv || !tangent) return false;
  const edge = (attribute, from, to) =>
    ['getX', 'getY', 'getZ'].slice(0, attribute.itemSize).map(get => attribute[get](to) - attribute[get](from));
  let sum = 0;
  const count = index ? index.count : position.count;
  for (let k = 0; k + 2 < count; k += 3) {
    const [a, b, c] = [k, k + 1, k + 2].map(i => index ? index.getX(i) : i);
    const [x, y, z] = edge(position, a, b), [p, q, r] = edge(position, a, c), [u, v] = edge(uv, a, b), [s, t] = edge(uv, a, c);
    const facing = (y * r - z * q) * normal.getX(a) + (z * p - x * r) * normal.getY(a) + (x * q - y * p) * normal.getZ(a);
    sum += Math.sign((u * t - v * s) * facing * tangent.getW(a));
  }
  return sum < 0;
}
