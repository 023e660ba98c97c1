// Generates MikkTSpace tangents for meshes without stored tangents.
import { Float32BufferAttribute, Vector2 } from 'three';
import { library } from './library.js';

// Adds tangents to the meshes below `object`, which must own their materials. Skips meshes without normals or uv.
export async function giveMikkTSpace(object) {
  const meshes = [], unflipped = new Set(), given = new Map();
  object.traverse(child => { if (child.isMesh && mapOf(child) && !child.geometry.attributes.tangent) meshes.push(child); });
  for (const mesh of meshes) {
    const map = mapOf(mesh), { geometry } = mesh, name = map.channel ? `uv${map.channel}` : 'uv';
    if (!geometry.attributes.normal || !geometry.attributes[name]) continue;
    if (!given.has(geometry)) given.set(geometry, await withTangents(geometry, name, map));
    mesh.geometry = given.get(geometry);
    for (const material of [mesh.material].flat()) { // undo GLTFLoader's flip for meshes without tangents
      if (!unflipped.has(material)) for (const scale of ['normalScale', 'clearcoatNormalScale']) if (material[scale]) material[scale].y *= -1;
      unflipped.add(material);
    }
  }
}

const mapOf = mesh => [mesh.material].flat().map(material => material.normalMap ?? material.clearcoatNormalMap).find(map => map);

// A geometry with tangents for the uv set and matrix of the map.
async function withTangents(geometry, name, map) {
  const made = geometry.index ? geometry.toNonIndexed() : geometry.clone(), { position, normal, [name]: uv } = made.attributes, point = new Vector2();
  if (map.matrixAutoUpdate) map.updateMatrix();
  const uvs = Float32Array.from({ length: 2 * uv.count }, (_, k) => point.fromBufferAttribute(uv, k >> 1).applyMatrix3(map.matrix).getComponent(k % 2));
  const corners = await library.tangents({ positions: numbersOf(position), normals: numbersOf(normal), uvs });
  return made.setAttribute('tangent', new Float32BufferAttribute(corners, 4));
}

const numbersOf = attribute => Float32Array.from({ length: 3 * attribute.count }, (_, k) => attribute.getComponent(Math.floor(k / 3), k % 3));
