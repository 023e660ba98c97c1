// A view of a model in two halves, each with its own frame, or of the angle between their normals in false colours.
// Drawn by three.js with the frames of cotan/three.
import * as three from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { RoomEnvironment } from 'three/addons/environments/RoomEnvironment.js';
import { clone as cloneScene } from 'three/addons/utils/SkeletonUtils.js';
import { untangle } from 'cotan/three';
import { giveMikkTSpace } from './mikktspace.js';

const kLinearMax = 0.7; // three's neutral tone curve is linear up to 0.76

// The view on a canvas, whose resolution follows its size on the page.
export function modelView(canvas) {
  const renderer = new three.WebGLRenderer({ canvas, antialias: true });
  renderer.toneMapping = three.NeutralToneMapping;
  renderer.autoClear = false;
  const world = new three.Scene(), camera = new three.PerspectiveCamera(40, 1, 0.01, 100), controls = new OrbitControls(camera, canvas);
  const light = new three.DirectionalLight(0xffffff, 2.2);
  world.background = new three.Color(0x23262f);
  world.environment = new three.PMREMGenerator(renderer).fromScene(new RoomEnvironment(), 0.03).texture;
  world.environmentIntensity = 0.55;
  world.add(light, light.target);
  const what = { value: 0 }; // 0: shaded; 1: normals in view space
  const targets = [0, 1].map(() => new three.WebGLRenderTarget(1, 1, { type: three.FloatType, minFilter: three.NearestFilter, magFilter: three.NearestFilter }));
  const angles = angleQuad(targets);
  const state = { gltf: null, variants: new Map(), notes: new Set(), names: ['tangents', 'auto'], share: 0.5, angle: false, most: 10, maxDegrees: undefined };
  let asked = 0;
  controls.addEventListener('change', show);
  new ResizeObserver(show).observe(canvas);

  const variant = name => state.variants.get(name);

  // Compiles the shaders for shading and for normals asynchronously, if the browser supports that.
  async function compiled(model) {
    if (!renderer.getContext().getExtension('KHR_parallel_shader_compile')) return;
    await Promise.all([null, targets[0]].map(target => {
      renderer.setRenderTarget(target);
      const compiling = renderer.compileAsync(model, camera, world);
      renderer.setRenderTarget(null);
      return compiling;
    }));
  }

  function show() {
    if (asked === 0) asked = requestAnimationFrame(() => { asked = 0; drawNow(); });
  }

  function drawNow() {
    if (!state.names.every(variant)) return;
    const width = Math.max(1, Math.round(canvas.clientWidth * Math.min(devicePixelRatio, 2))), height = Math.round(width * 9 / 16);
    if (canvas.width !== width || canvas.height !== height) renderer.setSize(width, height, false);
    camera.aspect = width / height;
    camera.updateProjectionMatrix();
    placeLight();
    const pair = state.names.map(variant);
    renderer.setRenderTarget(null);
    renderer.setScissorTest(false);
    renderer.clear();
    if (state.angle) {
      drawNormals(pair, width, height);
      angles.draw(renderer, state.most);
    } else {
      const border = Math.round(state.share * width / renderer.getPixelRatio());
      renderer.setScissorTest(true);
      pair.forEach((model, k) => {
        renderer.setScissor(k === 0 ? 0 : border, 0, k === 0 ? border : width - border, height);
        drawOne(model);
      });
      renderer.setScissor(border - 1, 0, 2, height);
      renderer.setClearColor(0xffffff, 1);
      renderer.clear();
      renderer.setScissorTest(false);
    }
  }

  function drawOne(model) {
    world.add(model);
    renderer.render(world, camera);
    world.remove(model);
  }

  // Sets the exposure so that all but highlights stay in the linear range of the tone curve and white keeps its bumps.
  function expose() {
    const small = [240, 135];
    placeLight();
    drawInto([variant(state.names[0])], 0, ...small);
    const values = new Float32Array(small[0] * small[1] * 4), found = [];
    renderer.readRenderTargetPixels(targets[0], 0, 0, ...small, values);
    for (let k = 0; k < values.length; k += 4) if (values[k + 3] > 0.5) found.push(Math.max(values[k], values[k + 1], values[k + 2]));
    const bright = found.sort((a, b) => a - b)[Math.floor(0.9 * found.length)];
    renderer.toneMappingExposure = bright > 0 ? Math.min(1, kLinearMax / bright) : 1;
  }

  function placeLight() {
    light.position.copy(camera.position).add(new three.Vector3(-1, 1.4, 0.6).applyQuaternion(camera.quaternion).multiplyScalar(camera.position.distanceTo(controls.target)));
    light.target.position.copy(controls.target);
  }

  const drawNormals = (pair, width, height) => drawInto(pair, 1, width, height);

  function drawInto(pair, mode, width, height) {
    what.value = mode;
    const background = world.background;
    world.background = null;
    pair.forEach((model, k) => {
      targets[k].setSize(width, height);
      renderer.setRenderTarget(targets[k]);
      renderer.setClearColor(0, 0);
      renderer.clear();
      drawOne(model);
    });
    what.value = 0;
    world.background = background;
    renderer.setRenderTarget(null);
  }

  // Angles in degrees between both halves' normals in a rectangle, for the pixels where both show a surface.
  function degreesOver(x, y, width, height) {
    const pixels = targets.map(target => {
      const values = new Float32Array(width * height * 4);
      renderer.readRenderTargetPixels(target, x, y, width, height, values);
      return values;
    });
    const found = [];
    for (let k = 0; k < width * height * 4; k += 4) {
      const [a, b] = pixels.map(values => values.subarray(k, k + 4));
      if (a[3] < 0.5 || b[3] < 0.5) continue;
      const cross = Math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
      found.push(Math.atan2(cross, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) * 180 / Math.PI);
    }
    return found;
  }

  return {
    show,
    drawNow,
    open(gltf) {
      state.gltf = gltf;
      state.exposed = false;
      state.variants.clear();
      state.notes.clear();
      frameAll(gltf.scene, camera, controls);
      show();
    },
    // Copies the model when a frame is chosen for the first time.
    async choose(left, right) {
      const { gltf } = state;
      for (const name of [left, right])
        if (!variant(name)) {
          const { maxDegrees } = state, made = await makeVariant(gltf.scene, name, what, state.notes, maxDegrees);
          await compiled(made);
          if (gltf !== state.gltf || maxDegrees !== state.maxDegrees) return;
          state.variants.set(name, made);
        }
      state.names = [left, right];
      if (!state.exposed) expose();
      state.exposed = true;
      show();
    },
    get names() { return state.names; },
    // Notes of cotan/three on the model.
    get notes() { return [...state.notes]; },
    set share(value) { state.share = value; show(); },
    set angle(value) { state.angle = value; show(); },
    set most(value) { state.most = value; show(); },
    // What `auto` may be off; choose() draws it.
    set maxDegrees(value) {
      state.maxDegrees = value;
      state.variants.delete('auto');
      state.notes.clear();
    },
    // Mean and 95th percentile of the angle over the visible surface; undefined if nothing is visible.
    statistics() {
      if (!state.names.every(variant)) return undefined;
      const small = [480, 270];
      drawNormals(state.names.map(variant), ...small);
      const found = degreesOver(0, 0, ...small).sort((a, b) => a - b);
      return found.length === 0 ? undefined : { mean: found.reduce((sum, value) => sum + value, 0) / found.length, most: found[Math.floor(0.95 * (found.length - 1))] };
    },
    // Angle in degrees at (u, v), fractions of width and height from the top left; undefined beside the model.
    at(u, v) {
      if (!state.names.every(variant)) return undefined;
      const [width, height] = [canvas.width, canvas.height];
      drawNormals(state.names.map(variant), width, height);
      return degreesOver(Math.min(width - 1, Math.floor(u * width)), Math.min(height - 1, Math.floor((1 - v) * height)), 1, 1)[0];
    },
    close() { renderer.dispose(); targets.forEach(target => target.dispose()); },
  };
}

// A copy of the scene with a frame. name: 'tangents' (stored, else MikkTSpace's) or a frame of cotan/three.
async function makeVariant(scene, name, what, notes, maxDegrees) {
  const copy = cloneScene(scene), materials = new Map(), geometries = new Map();
  const once = (known, source) => known.get(source) ?? known.set(source, source.clone()).get(source);
  copy.traverse(object => {
    if (!object.isMesh) return;
    object.geometry = once(geometries, object.geometry);
    object.material = Array.isArray(object.material) ? object.material.map(material => once(materials, material)) : once(materials, object.material);
  });
  for (const material of materials.values()) showNormals(material, what);
  if (name === 'tangents') await giveMikkTSpace(copy);
  else untangle(copy, { frame: name, note: line => notes.add(line), ...(maxDegrees && { maxDegrees }) });
  return copy;
}

// Makes a material write its normal instead of its colour while `what` is 1.
function showNormals(material, what) {
  const text = material.isMeshStandardMaterial ? 'vec4( normalize( normal ), 1.0 )' : 'vec4( 0.0 )';
  material.onBeforeCompile = shader => {
    shader.uniforms.cotanWhat = what;
    shader.fragmentShader = `uniform int cotanWhat;\n${shader.fragmentShader}`.replace(/\}\s*$/, `if ( cotanWhat == 1 ) gl_FragColor = ${text};\n}`);
  };
  material.customProgramCacheKey = () => text;
}

function frameAll(scene, camera, controls) {
  const box = new three.Box3().setFromObject(scene), middle = box.getCenter(new three.Vector3()), radius = box.getSize(new three.Vector3()).length() / 2 || 1;
  const distance = 0.85 * radius / Math.sin(camera.fov * Math.PI / 360);
  camera.near = radius / 100;
  camera.far = distance + 20 * radius;
  camera.position.copy(middle).add(new three.Vector3(0.5, 0.35, 1).normalize().multiplyScalar(distance));
  controls.target.copy(middle);
  controls.update();
}

// Draws the angle between two images of normals, from black at 0 to yellow at `most` degrees.
function angleQuad(targets) {
  const material = new three.ShaderMaterial({
    uniforms: { a: { value: targets[0].texture }, b: { value: targets[1].texture }, most: { value: 10 } },
    vertexShader: 'out vec2 at; void main() { at = uv; gl_Position = vec4( position.xy, 0.0, 1.0 ); }',
    fragmentShader: `
      uniform sampler2D a, b; uniform float most; in vec2 at;
      void main() {
        vec4 m = texture( a, at ), n = texture( b, at );
        float x = clamp( degrees( atan( length( cross( m.xyz, n.xyz ) ), dot( m.xyz, n.xyz ) ) ) / most, 0.0, 1.0 ) * 4.0;
        vec3 c = mix( vec3( 0.0 ), vec3( 0.21, 0.06, 0.54 ), clamp( x, 0.0, 1.0 ) );
        c = mix( c, vec3( 0.76, 0.18, 0.37 ), clamp( x - 1.0, 0.0, 1.0 ) );
        c = mix( c, vec3( 0.98, 0.56, 0.17 ), clamp( x - 2.0, 0.0, 1.0 ) );
        c = mix( c, vec3( 0.99, 0.99, 0.69 ), clamp( x - 3.0, 0.0, 1.0 ) );
        gl_FragColor = m.a > 0.5 && n.a > 0.5 ? vec4( c, 1.0 ) : vec4( 0.14, 0.15, 0.18, 1.0 );
      }`,
    depthTest: false, depthWrite: false, glslVersion: null,
  });
  const scene = new three.Scene(), camera = new three.Camera(), quad = new three.Mesh(new three.PlaneGeometry(2, 2), material);
  quad.frustumCulled = false;
  scene.add(quad);
  return { draw(renderer, most) { material.uniforms.most.value = most; renderer.render(scene, camera); } };
}
