// Draws the whole surface of a mesh: its triangles side by side, at one scale, instead of as a camera sees them. Nothing is
// hidden, and nothing is small because it is seen at a grazing angle. The shaders are three's own and untangle()'s: they get
// positions, normals and uv as always, so that their derivatives are those of each triangle.
import * as THREE from 'three';

const kSide = 512;    // of the image
const kFilled = 0.9;  // of the image, at most
const kLayer = 7;     // of the mesh that is drawn

// The corners of all triangles in the scene, three Vector3 for each, for one instance of the mesh.
function cornersOf(mesh, instance) {
  const { index, attributes: { position } } = mesh.geometry, matrix = mesh.matrixWorld.clone(), own = new THREE.Matrix4(), found = [];
  if (mesh.isInstancedMesh) {
    mesh.getMatrixAt(instance, own);
    matrix.multiply(own);
  }
  for (let k = 0; k < (index ?? position).count; ++k) found.push(mesh.getVertexPosition(index ? index.getX(k) : k, new THREE.Vector3()).applyMatrix4(matrix));
  return found;
}

// { corners, at } for a mesh: at: x and y of each corner in clip space. Triangles without area are at one point. Corners are
// counterclockwise, or clockwise if the matrix mirrors, as three expects front faces.
export function layoutOf(mesh, instance) {
  const corners = cornersOf(mesh, instance), count = Math.floor(corners.length / 3), boxes = [], side = new THREE.Vector3(), other = new THREE.Vector3();
  for (let k = 0; k < count; ++k) {
    let first = 0;
    const lengths = [0, 1, 2].map(c => corners[3 * k + c].distanceTo(corners[3 * k + (c + 1) % 3]));
    for (let c = 1; c < 3; ++c) if (lengths[c] > lengths[first]) first = c;
    const [a, b, c] = [0, 1, 2].map(i => corners[3 * k + (first + i) % 3]), wide = lengths[first];
    side.subVectors(b, a).normalize();
    other.subVectors(c, a);
    const along = other.dot(side), high = Math.sqrt(Math.max(other.lengthSq() - along * along, 0));
    if (wide > 0 && high > 0 && wide < Infinity) boxes.push({ k, first, wide, high, along });
  }
  boxes.sort((p, q) => q.high - p.high);
  const total = boxes.reduce((sum, { wide, high }) => sum + wide * high, 0), at = new Float32Array(2 * corners.length), mirrors = mesh.matrixWorld.determinant() < 0 ? -1 : 1;
  let scale = kSide * Math.sqrt(kFilled / total);
  const fits = () => {
    let x = 0, y = 0, shelf = 0;
    for (const box of boxes) {
      if (x + box.wide * scale > kSide) {
        y += shelf;
        x = shelf = 0;
      }
      shelf ||= box.high * scale;
      Object.assign(box, { x, y });
      x += box.wide * scale;
    }
    return y + shelf <= kSide && boxes.every(({ wide }) => wide * scale <= kSide);
  };
  while (!fits()) scale *= 0.97;
  for (const { k, first, wide, high, along, x, y } of boxes)
    [[0, 0], [wide, 0], [along, high]].forEach(([u, v], i) => {
      const corner = 2 * (3 * k + (first + i) % 3);
      at[corner] = ((x + u * scale) / kSide * 2 - 1) * mirrors;
      at[corner + 1] = (y + v * scale) / kSide * 2 - 1;
    });
  return { corners, at };
}

// x and y of each corner of a mesh with the same triangles as the layout's, whose corners may start elsewhere.
function placesOf(mesh, instance, layout) {
  const own = cornersOf(mesh, instance), at = new Float32Array(layout.at.length);
  for (let k = 0; k + 2 < own.length; k += 3) {
    const distances = [0, 1, 2].map(turn => [0, 1, 2].reduce((sum, c) => sum + own[k + c].distanceTo(layout.corners[k + (c + turn) % 3]), 0)), turn = distances.indexOf(Math.min(...distances));
    for (let c = 0; c < 3; ++c) at.set(layout.at.subarray(2 * (k + (c + turn) % 3), 2 * (k + (c + turn) % 3) + 2), 2 * (k + c));
  }
  return at;
}

function nonIndexed(geometry) {
  const made = geometry.index ? geometry.toNonIndexed() : geometry.clone();
  for (const [name, { gpuType }] of Object.entries(geometry.attributes)) if (gpuType !== undefined && made.attributes[name]) made.attributes[name].gpuType = gpuType;
  return made;
}

// Makes a material that writes normals (write() of three_judge.js) draw triangles where the layout has them, with the
// texels that its maps store: no mipmaps, and no blends of neighbours.
export function unfold(material) {
  const { onBeforeCompile: before, customProgramCacheKey: key } = material;
  for (const map of [material.normalMap, material.clearcoatNormalMap])
    if (map) Object.assign(map, { minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, generateMipmaps: false, needsUpdate: true });
  material.onBeforeCompile = (shader, given) => {
    before.call(material, shader, given);
    shader.vertexShader = `attribute vec2 unfoldedAt;\n${shader.vertexShader.replace('#include <project_vertex>', '#include <project_vertex>\ngl_Position = vec4( unfoldedAt, 0.0, 1.0 );')}`;
  };
  material.customProgramCacheKey = () => `unfolded ${key.call(material)}`;
  material.needsUpdate = true;
}

// RGBA of the image of one instance of a mesh, in a scene with the mesh.
export function drawUnfolded(renderer, scene, mesh, instance, layout, middle) {
  const target = new THREE.WebGLRenderTarget(kSide, kSide, { type: THREE.FloatType, depthBuffer: false }), camera = new THREE.OrthographicCamera();
  camera.position.copy(middle); // small coordinates have precise derivatives
  camera.layers.set(kLayer);
  const { geometry, instanceMatrix, count } = mesh, first = new THREE.Matrix4();
  mesh.geometry = nonIndexed(geometry).setAttribute('unfoldedAt', new THREE.BufferAttribute(placesOf(mesh, instance, layout), 2));
  mesh.layers.enable(kLayer);
  if (instanceMatrix) {
    mesh.getMatrixAt(instance, first);
    mesh.instanceMatrix = new THREE.InstancedBufferAttribute(Float32Array.from(first.elements), 16);
    mesh.count = 1;
  }
  renderer.setRenderTarget(target);
  renderer.clear();
  renderer.render(scene, camera);
  const pixels = new Float32Array(kSide * kSide * 4);
  renderer.readRenderTargetPixels(target, 0, 0, kSide, kSide, pixels);
  target.dispose();
  mesh.geometry.dispose();
  mesh.layers.disable(kLayer);
  Object.assign(mesh, { geometry }, instanceMatrix ? { instanceMatrix, count } : {});
  return pixels;
}
