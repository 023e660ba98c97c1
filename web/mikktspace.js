// Generates MikkTSpace tangents with three.js for meshes without stored tangents.
import { Float32BufferAttribute, Vector2 } from 'three';

// Adds tangents to the meshes below `object`, which must own their materials. Skips meshes without normals or uv.
export async function giveMikkTSpace(object) {
  const meshes = [], unflipped = new Set(), given = new Map();
  object.traverse(child => { if (child.isMesh && mapOf(child) && !child.geometry.attributes.tangent) meshes.push(child); });
  if (meshes.length === 0) return;
  const [maker, { computeMikkTSpaceTangents }] = await Promise.all([import('three/addons/libs/mikktspace.module.js'), import('three/addons/utils/BufferGeometryUtils.js')]);
  await maker.ready;
  for (const mesh of meshes) {
    const map = mapOf(mesh), { geometry } = mesh, name = map.channel ? `uv${map.channel}` : 'uv';
    if (!geometry.attributes.normal || !geometry.attributes[name]) continue;
    if (!given.has(geometry)) given.set(geometry, withTangents(geometry, name, map, made => computeMikkTSpaceTangents(made, maker)));
    mesh.geometry = given.get(geometry);
    for (const material of [mesh.material].flat()) { // undo GLTFLoader's flip for meshes without tangents
      if (!unflipped.has(material)) for (const scale of ['normalScale', 'clearcoatNormalScale']) if (material[scale]) material[scale].y *= -1;
      unflipped.add(material);
    }
  }
}

const mapOf = mesh => [mesh.material].flat().map(material => material.normalMap ?? material.clearcoatNormalMap).find(map => map);

// A geometry with tangents for the uv set and matrix of the map.
function withTangents(geometry, name, map, compute) {
  const made = geometry.index ? geometry.toNonIndexed() : geometry.clone(), { [name]: uv, uv: first } = made.attributes, point = new Vector2();
  if (map.matrixAutoUpdate) map.updateMatrix();
  const transformed = Array.from({ length: uv.count }, (_, k) => point.fromBufferAttribute(uv, k).applyMatrix3(map.matrix).toArray()).flat();
  compute(made.setAttribute('uv', new Float32BufferAttribute(transformed, 2)));
  return first ? made.setAttribute('uv', first) : made.deleteAttribute('uv');
}
