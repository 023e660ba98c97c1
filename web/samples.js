// Generates sample files for visitors who have none at hand.
import { library } from './library.js';
import { slopes } from './patch.js';

// A normal map of domes. Green points down as in DirectX, unless greenUp.
function domes(size, greenUp) {
  const data = new Uint8Array(size * size * 4);
  for (let y = 0; y < size; ++y)
    for (let x = 0; x < size; ++x) {
      const [hu, hv] = slopes(2 * (x + 0.5) / size, 2 * (size - y - 0.5) / size), long = Math.hypot(hu, hv, 1);
      data.set([-hu, (greenUp ? -1 : 1) * hv, 1].map(value => Math.round(128 + 127 * value / long)), 4 * (y * size + x));
      data[4 * (y * size + x) + 3] = 255;
    }
  return { width: size, height: size, bits: 8, data };
}

export async function map() {
  return [{ name: 'domes.png', path: 'domes.png', bytes: await library.encodePng(domes(512, false)) }];
}

// A ring with a stretched texture and stored tangents.
export async function model() {
  const [three, { GLTFExporter }] = await Promise.all([import('three'), import('three/addons/exporters/GLTFExporter.js')]);
  const geometry = new three.TorusGeometry(1, 0.42, 48, 96), { width, height, data } = domes(512, true);
  const uv = geometry.attributes.uv;
  for (let k = 0; k < uv.count; ++k) uv.setXY(k, uv.getX(k) * 4, 4 - uv.getY(k) * 4); // glTF's v runs down
  geometry.computeTangents();
  const { tangent } = geometry.attributes;
  for (let k = 0; k < tangent.count; ++k) tangent.setW(k, -tangent.getW(k)); // computeTangents has bitangents along v, glTF against it
  const canvas = new OffscreenCanvas(width, height);
  canvas.getContext('2d').putImageData(new ImageData(new Uint8ClampedArray(data.buffer), width, height), 0, 0);
  const texture = new three.CanvasTexture(canvas);
  texture.wrapS = texture.wrapT = three.RepeatWrapping;
  texture.flipY = false;
  const material = new three.MeshStandardMaterial({ color: 0x3b6ea8, roughness: 0.38, metalness: 0, normalMap: texture });
  const scene = new three.Scene();
  scene.add(new three.Mesh(geometry, material));
  const bytes = new Uint8Array(await new GLTFExporter().parseAsync(scene, { binary: true }));
  return [{ name: 'ring.glb', path: 'ring.glb', bytes }];
}
