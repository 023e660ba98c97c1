// A sheet of two by two units whose left half has mirrored texture coordinates, and a normal map for it, as three.js
// expects it in an unflipped texture: v up, green along v.
export function mirroredSheet(THREE) {
  const geometry = new THREE.BufferGeometry();
  const position = [], uv = [], normal = [];
  for (const x of [-1, 0, 1])
    for (const y of [1, -1]) {
      position.push(x, y, 0);
      uv.push(Math.abs(x), y + 1);
      normal.push(0, 0, 1);
    }
  geometry.setAttribute('position', new THREE.Float32BufferAttribute(position, 3));
  geometry.setAttribute('uv', new THREE.Float32BufferAttribute(uv, 2));
  geometry.setAttribute('normal', new THREE.Float32BufferAttribute(normal, 3));
  geometry.setIndex([0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5]);
  return geometry;
}

export function domes(THREE, size = 256) {
  const texels = new Uint8Array(size * size * 4);
  for (let row = 0; row < size; ++row)
    for (let column = 0; column < size; ++column) {
      const x = (column + 0.5) / size * 4 % 2 - 1, y = (row + 0.5) / size * 4 % 2 - 1;
      const n = Math.hypot(x, y) < 0.8 ? [x, y, Math.sqrt(1 - x * x - y * y)] : [0, 0, 1];
      texels.set([...n.map(c => Math.round(127.5 * c + 127.5)), 255], (row * size + column) * 4); // three reads 2c - 1
    }
  const map = new THREE.DataTexture(texels, size, size);
  map.wrapS = map.wrapT = THREE.RepeatWrapping;
  map.magFilter = THREE.LinearFilter;
  map.minFilter = THREE.LinearMipmapLinearFilter;
  map.generateMipmaps = true;
  map.needsUpdate = true;
  return map;
}
