// WebGPURenderer as the reference: degrees between the normals that it draws of a model with its stored tangents and
// after untangle() of cotan/three/tsl, on its WebGL 2 backend. Stock nodes read stored tangents as WebGLRenderer does.
import * as THREE from 'three/webgpu';
import * as TSL from 'three/tsl';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { untangle } from '/package/three/tsl.js';

const kSize = 320, kViews = [[0.1, 0.15, 1], [-0.2, 0.25, -1], [1, 0.1, 0.2], [-1, 0.3, -0.1]];

export async function measure(url) {
  const renderer = new THREE.WebGPURenderer({ forceWebGL: true }), target = new THREE.RenderTarget(kSize, kSize, { type: THREE.FloatType }), drawn = [];
  await renderer.init();
  renderer.setClearColor(0, 0);
  let maps = 0;
  for (const change of [() => {}, gltf => untangle(gltf, { note() {} })]) {
    const gltf = await new GLTFLoader().loadAsync(url), scene = new THREE.Scene(), materials = new Set();
    change(gltf);
    gltf.scene.traverse(child => { if (child.isMesh) materials.add(child.material); });
    for (const material of materials) {
      Object.assign(material, { transparent: false, transmission: 0 });
      material.outputNode = material.normalMap ? TSL.vec4(TSL.normalView, 1) : TSL.vec4(0);
    }
    maps = new Set([...materials].map(({ normalMap }) => normalMap).filter(Boolean)).size;
    scene.add(gltf.scene, new THREE.AmbientLight('white', 1));
    const box = new THREE.Box3().setFromObject(gltf.scene), middle = box.getCenter(new THREE.Vector3()), radius = box.getSize(new THREE.Vector3()).length() / 2;
    const camera = new THREE.PerspectiveCamera(30, 1, radius / 100, radius * 20), views = [];
    for (const view of kViews) {
      camera.position.copy(middle).add(new THREE.Vector3(...view).normalize().multiplyScalar(radius / Math.sin(Math.PI / 12)));
      camera.lookAt(middle);
      renderer.setRenderTarget(target);
      renderer.render(scene, camera);
      views.push(await renderer.readRenderTargetPixelsAsync(target, 0, 0, kSize, kSize));
    }
    drawn.push(views);
  }
  let sum = 0, count = 0;
  drawn[0].forEach((a, view) => {
    const b = drawn[1][view];
    for (let i = 0; i < a.length; i += 4) {
      if (a[i + 3] < 0.5 || b[i + 3] < 0.5) continue;
      const cross = Math.hypot(a[i + 1] * b[i + 2] - a[i + 2] * b[i + 1], a[i + 2] * b[i] - a[i] * b[i + 2], a[i] * b[i + 1] - a[i + 1] * b[i]);
      sum += Math.atan2(cross, a[i] * b[i] + a[i + 1] * b[i + 1] + a[i + 2] * b[i + 2]) * 180 / Math.PI;
      ++count;
    }
  });
  return { maps, count, mean: sum / count };
}
