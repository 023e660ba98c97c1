// MikkTSpace tangents, made by three.js, for meshes that have none stored.
import { Float32BufferAttribute, Vector2 } from 'three';

// Of the meshes below `object`, whose materials and geometries are its own. What cannot have any stays as it is.
export async function giveMikkTSpace(object) {
  const meshes = [], turned = new Set(), given = new Map();
  object.traverse(child => { if (child.isMesh && mapOf(child) && !child.geometry.attributes.tangent) meshes.push(child); });
  if (meshes.length === 0) return;
  const [maker, { computeMikkTSpaceTangents }] = await Promise.all([import('three/addons/libs/mikktspace.module.js'), import('three/addons/utils/BufferGeometryUtils.js')]);
  await maker.ready;
  for (const mesh of meshes) {
    const map = mapOf(mesh), { geometry } = mesh, name = map.channel ? `uv${map.channel}` : 'uv';
    if (!geometry.attributes.normal || !geometry.attributes[name]) continue;
    if (!given.has(geometry)) given.set(geometry, withTangents(geometry, name, map, made => computeMikkTSpaceTangents(made, maker)));
    mesh.geometry = given.get(geometry);
    for (const material of [mesh.material].flat()) { // three's loader has turned green for want of tangents
      if (!turned.has(material)) for (const scale of ['normalScale', 'clearcoatNormalScale']) if (material[scale]) material[scale].y *= -1;
      turned.add(material);
    }
  }
}

const mapOf = mesh => [mesh.material].flat().map(material => material.normalMap ?? material.clearcoatNormalMap).find(map => map);

// Over the texture coordinates as the map has them, set and matrix.
function withTangents(geometry, name, map, compute) {
  const made = geometry.index ? geometry.toNonIndexed() : geometry.clone(), { [name]: uv, uv: first } = made.attributes, place = new Vector2();
  if (map.matrixAutoUpdate) map.updateMatrix();
  const moved = Array.from({ length: uv.count }, (_, k) => place.fromBufferAttribute(uv, k).applyMatrix3(map.matrix).toArray()).flat();
  compute(made.setAttribute('uv', new Float32BufferAttribute(moved, 2)));
  return first ? made.setAttribute('uv', first) : made.deleteAttribute('uv');
}
