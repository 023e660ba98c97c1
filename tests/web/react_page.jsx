// Models in react-three-fiber with cotan/react, and in three.js alone with cotan/three: for react_test.mjs, which bundles it.
import { createRoot, extend } from '@react-three/fiber';
import { act, Component, StrictMode, useRef } from 'react';
import * as THREE from 'three';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { RenderTarget, WebGPURenderer } from 'three/webgpu';
import { untangle } from 'cotan/three';
import { untangle as untangleNodes } from 'cotan/three/tsl';
import { Untangled, useUntangled } from 'cotan/react';

globalThis.IS_REACT_ACT_ENVIRONMENT = true;
extend(THREE);
const kSize = 256, kMirrored = [-1, 1, 1];
const load = url => new GLTFLoader().loadAsync(url);

function camera() {
  const made = new THREE.PerspectiveCamera(30, 1, 0.1, 100);
  made.position.set(0.5, 0.8, 4);
  made.lookAt(0, 0, 0);
  return made;
}

function rendererOn(canvas) {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: false, preserveDrawingBuffer: true });
  renderer.setSize(kSize, kSize, false);
  return renderer;
}

function pixelsOf(renderer, scene, view) {
  renderer.render(scene, view);
  const gl = renderer.getContext(), pixels = new Uint8Array(4 * kSize * kSize);
  gl.readPixels(0, 0, kSize, kSize, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  return pixels;
}

// The factor that makes a model's radius 1.
function factorOf({ scene }) {
  scene.updateMatrixWorld(true);
  return 1 / new THREE.Box3().setFromObject(scene).getBoundingSphere(new THREE.Sphere()).radius;
}

// A root of react-three-fiber without a loop of frames. Returns functions that render elements, draw them, and tell what
// the renderer holds.
async function rootOf() {
  const canvas = document.createElement('canvas'), root = createRoot(canvas);
  await root.configure({ gl: () => rendererOn(canvas), frameloop: 'never', flat: true, dpr: 1, size: { width: kSize, height: kSize, top: 0, left: 0 }, camera: camera() });
  let state;
  return {
    async show(elements) { await act(async () => { state = root.render(elements).getState(); }); },
    draw: () => pixelsOf(state.gl, state.scene, state.camera),
    held: () => ({ ...state.gl.info.memory }),
    async close() { await act(async () => root.unmount()); },
  };
}

const lights = <><ambientLight intensity={0.3} /><directionalLight position={[1, 2, 3]} intensity={3} /></>;
function plainScene(...objects) {
  const light = new THREE.DirectionalLight('white', 3);
  light.position.set(1, 2, 3);
  return new THREE.Scene().add(new THREE.AmbientLight('white', 0.3), light, ...objects);
}

const bytesApart = (a, b) => a.filter((value, k) => value !== b[k]).length;
const tangentsIn = ({ scene }) => {
  let count = 0;
  scene.traverse(({ geometry }) => { if (geometry?.attributes.tangent) ++count; });
  return count;
};

// Bytes of the image that differ between cotan/react and cotan/three, and between cotan/react and three alone; a parent mirrors
// the model. The number of drawn pixels, tangents before and after, and what `onDecided` was told.
export async function beside(url) {
  const view = await rootOf(), decided = [], mine = await load(url), factor = factorOf(mine), before = tangentsIn(mine);
  await view.show(<StrictMode>{lights}<group scale={kMirrored}><Untangled object={mine} scale={factor} note={() => {}} onDecided={all => decided.push(all.length)} /></group></StrictMode>);
  const drawn = view.draw(), after = tangentsIn(mine);
  await view.close();
  const renderer = rendererOn(document.createElement('canvas'));
  const alone = async prepare => {
    const gltf = await load(url), parent = new THREE.Group();
    parent.scale.set(...kMirrored);
    gltf.scene.scale.setScalar(factor);
    const scene = plainScene(parent.add(gltf.scene));
    scene.updateMatrixWorld(true);
    prepare(gltf);
    return pixelsOf(renderer, scene, camera());
  };
  const ours = await alone(gltf => untangle(gltf, { note() {} })), stock = await alone(() => {});
  renderer.dispose();
  return { pixels: drawn.filter((value, k) => k % 4 !== 3 && value > 20).length, fromOurs: bytesApart(drawn, ours), fromStock: bytesApart(drawn, stock), before, after, decided };
}

// The same with WebGPURenderer, which react-three-fiber takes from a function of the page. forceWebGL: on WebGL 2.
export async function besideNodes(url, forceWebGL) {
  const made = async canvas => {
    const renderer = new WebGPURenderer({ canvas, antialias: false, forceWebGL });
    await renderer.init();
    renderer.setSize(kSize, kSize, false);
    return renderer;
  };
  const drawn = async (renderer, scene, view) => {
    const target = new RenderTarget(kSize, kSize);
    renderer.setRenderTarget(target);
    renderer.render(scene, view);
    const pixels = await renderer.readRenderTargetPixelsAsync(target, 0, 0, kSize, kSize);
    renderer.setRenderTarget(null);
    return pixels;
  };
  const canvas = document.createElement('canvas'), root = createRoot(canvas), mine = await load(url), factor = factorOf(mine), before = tangentsIn(mine), decided = [];
  await root.configure({ gl: () => made(canvas), frameloop: 'never', flat: true, dpr: 1, size: { width: kSize, height: kSize, top: 0, left: 0 }, camera: camera() });
  let state;
  await act(async () => {
    state = root.render(<StrictMode>{lights}<group scale={kMirrored}><Untangled object={mine} scale={factor} untangle={untangleNodes} note={() => {}} onDecided={all => decided.push(all.length)} /></group></StrictMode>).getState();
  });
  const image = await drawn(state.gl, state.scene, state.camera), after = tangentsIn(mine), webgpu = !!state.gl.backend.isWebGPUBackend;
  await act(async () => root.unmount());
  const renderer = await made(document.createElement('canvas'));
  const alone = async prepare => {
    const gltf = await load(url), parent = new THREE.Group();
    parent.scale.set(...kMirrored);
    gltf.scene.scale.setScalar(factor);
    const scene = plainScene(parent.add(gltf.scene));
    scene.updateMatrixWorld(true);
    prepare(gltf);
    return drawn(renderer, scene, camera());
  };
  const ours = await alone(gltf => untangleNodes(gltf, { note() {} })), stock = await alone(() => {});
  renderer.dispose();
  return { webgpu, pixels: image.filter((value, k) => k % 4 !== 3 && value > 20).length, fromOurs: bytesApart(image, ours), fromStock: bytesApart(image, stock), before, after, decided };
}

// What the renderer holds before a model is drawn, with it, and after it is unmounted; and the bytes in which the image
// differs when it is drawn again. dispose: of <Untangled>. A small sphere keeps what three.js holds for all materials.
export async function unmounted(url, dispose) {
  const view = await rootOf(), model = await load(url), factor = factorOf(model), held = [];
  const small = <mesh scale={0.01} position={[0.9, 0.9, 0]}><sphereGeometry /><meshStandardMaterial /></mesh>;
  const mounted = <Untangled object={model} scale={factor} note={() => {}} dispose={dispose} />, images = [];
  for (const element of [null, mounted, null, mounted]) {
    await view.show(<>{lights}{small}{element}</>);
    images.push(view.draw());
    held.push(view.held());
  }
  await view.close();
  return { held, apart: bytesApart(images[1], images[3]) };
}

class Boundary extends Component {
  state = {};
  static getDerivedStateFromError(error) { return { error }; }
  render() {
    if (this.state.error) this.props.caught(this.state.error);
    return this.state.error ? null : this.props.children;
  }
}

// A hook with a ref to meshes of the page's own: frames that were decided after each rendering, and errors of wrong arguments.
export async function hooks() {
  const view = await rootOf(), frames = [], errors = [], calls = [], map = new THREE.DataTexture(Uint8Array.of(128, 128, 255, 255), 1, 1);
  map.needsUpdate = true;
  const count = (...given) => { calls.push(given.length); return untangle(...given); };
  let key = 0;
  const caught = element => <Boundary key={++key} caught={error => { errors.push(`${error.code}: ${error.message}`); }}>{element}</Boundary>;
  const Own = ({ frame }) => {
    const group = useRef(null), decisions = useUntangled(group, { frame, untangle: count });
    frames.push(decisions.map(decision => decision.frame).join());
    return <group ref={group}><mesh><sphereGeometry args={[1, 16, 8]} /><meshStandardMaterial normalMap={map} /></mesh></group>;
  };
  await view.show(<Own frame="orthonormal" />);
  await view.show(<Own frame="orthonormal" />);
  const once = calls.length;
  await view.show(<Own frame="cotangent" />);
  for (const properties of [{ object: 7 }, { object: new THREE.Group(), frame: 'round' }, { object: new THREE.Group(), maxDegrees: -1 },
    { object: new THREE.Group(), onDecided: 'log' }, { object: new THREE.Group(), untangle: true }])
    await view.show(caught(<Untangled {...properties} />));
  const Wrong = ({ given }) => useUntangled(given).length;
  for (const given of [7, 'model.glb', {}]) await view.show(caught(<Wrong given={given} />));
  const Missing = () => { frames.push(`missing ${useUntangled(null).length}`); return null; };
  await view.show(<Missing />);
  await view.close();
  return { frames, once, calls: calls.length, errors: [...new Set(errors)] };
}
