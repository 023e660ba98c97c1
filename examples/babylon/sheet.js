// A sheet of two by two units whose left half has mirrored texture coordinates, and a normal map for it: v up, green
// along v. It faces the eye, which is towards +z in a right-handed scene and towards -z in Babylon's left-handed ones.
export function mirroredSheet(BABYLON, scene) {
  const toEye = scene.useRightHandedSystem ? 1 : -1;
  const data = new BABYLON.VertexData();
  data.positions = [];
  data.uvs = [];
  data.normals = [];
  for (const x of [-1, 0, 1])
    for (const y of [1, -1]) {
      data.positions.push(x, y, 0);
      data.uvs.push(Math.abs(x), y + 1);
      data.normals.push(0, 0, toEye);
    }
  data.indices = [0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5];
  const mesh = new BABYLON.Mesh('sheet', scene);
  data.applyToMesh(mesh);
  mesh.sideOrientation = BABYLON.Material.CounterClockWiseSideOrientation;  // the front by the order of the indices
  return mesh;
}

export function domes(BABYLON, scene, size = 256, sampling = BABYLON.Texture.TRILINEAR_SAMPLINGMODE) {
  const texels = new Uint8Array(size * size * 4);
  for (let row = 0; row < size; ++row)
    for (let column = 0; column < size; ++column) {
      const x = (column + 0.5) / size * 4 % 2 - 1, y = (row + 0.5) / size * 4 % 2 - 1;
      const n = Math.hypot(x, y) < 0.8 ? [x, y, Math.sqrt(1 - x * x - y * y)] : [0, 0, 1];
      texels.set([...n.map(c => Math.round(127.5 * c + 127.5)), 255], (row * size + column) * 4); // Babylon reads 2c - 1
    }
  const map = BABYLON.RawTexture.CreateRGBATexture(texels, size, size, scene, true, false, sampling);
  map.wrapU = map.wrapV = BABYLON.Texture.WRAP_ADDRESSMODE;
  return { map, texels };
}
