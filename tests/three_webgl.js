// Draws with WebGLRenderer, as floats, the vectors that a material passes to lighting.
function webglSheets(THREE) {
  const size = 256, gl = document.createElement('canvas').getContext('webgl2');
  // A target with y down reverses the winding. Three.js has no option for it, so gl.frontFace is overridden.
  let up = 1;
  const frontFace = gl.frontFace.bind(gl);
  gl.frontFace = mode => frontFace(up > 0 ? mode : gl.CW + gl.CCW - mode);
  const renderer = new THREE.WebGLRenderer({ canvas: gl.canvas, context: gl });
  const target = new THREE.WebGLRenderTarget(size, size, { type: THREE.FloatType });
  renderer.setClearColor(0, 0);
  // Expressions that the fragment shader writes after lighting.
  const written = { normal: 'normal', coat: 'clearcoatNormal', t: 'material.anisotropyT', b: 'material.anisotropyB' };
  const draw = (scene, camera, direction, width = size, height = size) => {
    up = direction;
    renderer.resetState();
    camera.projectionMatrix.elements[5] *= up;
    target.setSize(width, height);
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(scene, camera);
    const pixels = new Float32Array(width * height * 4);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, pixels);
    return pixels;
  };
  const write = (material, what, broken) => { // broken: u reversed
    const before = material.onBeforeCompile;
    material.onBeforeCompile = (shader, renderer) => {
      before.call(material, shader, renderer);
      shader.fragmentShader = shader.fragmentShader.replace('#include <dithering_fragment>', `gl_FragColor = vec4(${written[what]}, 1.0);`);
      if (broken) shader.fragmentShader = shader.fragmentShader.replace('return mat3( f.t,', 'return mat3( - f.t,');
    };
    const key = material.customProgramCacheKey;
    material.customProgramCacheKey = () => what + broken + (Object.hasOwn(material, 'customProgramCacheKey') ? key.call(material) : '');
  };
  return { size, draw, write };
}
