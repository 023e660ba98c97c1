// Makes a Babylon.js material with a normal map (StandardMaterial, PBRMaterial) use a frame of Cotan without tangents.
// Replaces the function cotangent_frame of its shader and leaves the rest (decoding, level, detail maps, two-sided
// lighting). cotan: the output of `cotan shader --lang essl --frame cotangent --form total`. Call this before the first render.
export function useCotanFrame(BABYLON, material, cotan) {
  // Comments are removed: Babylon omits its precision statement if any line contains one, even in a comment.
  const functions = cotan.replace(/\/\/.*/g, '');
  class CotanFrame extends BABYLON.MaterialPluginBase {
    constructor() {
      super(material, 'CotanFrame', 200, { COTAN_FRAME: true }, true, true);  // Babylon caches programs by defines
      this.doNotSerialize = true;
    }
    // Babylon's frame is reversed in left-handed scenes, and code that sets invertNormalMapX and Y, such as the glTF
    // loader, relies on it. Its tangentSpaceParams also flip in mirrored transforms, which is wrong for this frame.
    getUniforms() {
      return {
        ubo: [{ name: 'cotanSigns', size: 2, type: 'vec2' }],
        fragment: 'uniform vec2 cotanSigns;',
      };
    }
    bindForSubMesh(uniforms, scene) {
      const handed = scene.useRightHandedSystem ? 1 : -1;
      uniforms.updateFloat2('cotanSigns', material.invertNormalMapX ? -handed : handed,
                            material.invertNormalMapY ? -handed : handed);
    }
    getCustomCode(type) {
      return type !== 'fragment' ? null : {
        '!mat3 cotangent_frame\\([^{]*\\{[^}]*\\}': `${functions}
mat3 cotangent_frame(vec3 normal, vec3 p, vec2 uv, vec2 tangentSpaceParams) {
  if (!gl_FrontFacing) uv = -uv;  // undoes Babylon's negation, which is for its own frame
  cotan_frame f = cotan_frame_cotangent(normal, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv));
  return mat3(f.t * cotanSigns.x, f.b * cotanSigns.y, normal);  // the length of normal scales the map
}
`,
      };
    }
  }
  new CotanFrame();
  return material;
}
