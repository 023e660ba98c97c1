// Lets a Babylon.js material with a normal map (StandardMaterial, PBRMaterial) take its tangent-free frame from Cotan:
// the function cotangent_frame of its shader is replaced, everything around it stays (decoding, level, detail maps,
// two-sided lighting). cotan: the output of `cotan shader --lang essl --form total`. Call it before the first render.
export function useCotanFrame(BABYLON, material, cotan) {
  // Babylon leaves out its precision statement where any line has one, be it a comment.
  const functions = cotan.replace(/\/\/.*/g, '');
  class CotanFrame extends BABYLON.MaterialPluginBase {
    constructor() {
      super(material, 'CotanFrame', 200, { COTAN_FRAME: true }, true, true);  // Babylon keeps programs by their defines
      this.doNotSerialize = true;
    }
    // Babylon's frame is reversed in left-handed scenes, and who sets invertNormalMapX and Y (the glTF loader, say) counts
    // on it. Its own tangentSpaceParams also turn round in mirrors, which this frame does not want.
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
  if (!gl_FrontFacing) uv = -uv;  // Babylon turns it for its own frame, which is reversed on back faces
  cotan_frame f = cotan_frame_cotangent(normal, dFdx(p), dFdy(p), dFdx(uv), dFdy(uv));
  return mat3(f.t * cotanSigns.x, f.b * cotanSigns.y, normal);  // the normal's length is the map's level
}
`,
      };
    }
  }
  new CotanFrame();
  return material;
}
