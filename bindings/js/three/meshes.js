// What both renderers of three.js need before a frame is replaced: meshes without tangents, materials that mean the same
// without them, and, for the frame `triangle`, geometries that carry it.
import { kTriangleAttribute, withTriangles } from './triangles.js';

// Which frame a material has from us, and whether bitangents run against v there.
const known = new WeakMap();

// Removes the tangents of all meshes of `target`, an Object3D or what GLTFLoader gives, and calls replace(material, found)
// for every material with a normal map's scale. found.frame: 'cotangent', 'orthonormal' or 'triangle';
// found.against: bitangents, as the anisotropy of the material means them, run against increasing v.
export function untangleMeshes(target, { frame, provoking = 'last', instances = true }, replace) {
  const names = ['cotangent', 'orthonormal', 'triangle'];
  if (frame !== undefined && !names.includes(frame)) throw new Error(`Cotan: frame: expected ${names.join(', ')}, found ${frame}`);
  const roots = target?.isObject3D ? [target] : target?.scenes;
  if (!roots) throw new Error('Cotan: untangle: expected an Object3D or what GLTFLoader gives');
  const meshes = new Set();
  for (const root of roots) root.traverse(child => { if (child.isMesh) meshes.add(child); });
  const stored = new Map();
  for (const { geometry } of meshes)
    if (geometry.attributes.tangent && !stored.has(geometry)) stored.set(geometry, bitangentsRunAgainstV(geometry));
  const copies = new Map();     // of materials, by what their meshes want
  const earlier = new Map();    // what is known of materials before this
  const triangles = new Map();  // geometries with triangle vectors
  for (const mesh of meshes) {
    const had = stored.has(mesh.geometry), against = stored.get(mesh.geometry);
    const all = Array.isArray(mesh.material) ? mesh.material : [mesh.material];
    if (!all.some(material => material.normalScale)) continue;
    // A material that has triangles already needs them in every mesh.
    const missing = !mesh.geometry.attributes[kTriangleAttribute] && all.some(material => known.get(material)?.frame === 'triangle');
    const wished = frame === 'triangle' || frame === undefined && missing ? onTriangles(mesh, all, provoking, instances, triangles) : frame;
    const materials = all.map(material => {
      if (!material.normalScale) return material;
      if (!earlier.has(material)) earlier.set(material, known.get(material));
      const before = earlier.get(material);
      const found = {
        frame: wished ?? (had ? 'orthonormal' : before?.frame ?? 'cotangent'),
        against: had ? against : before?.against ?? !target.isObject3D,
      };
      // Green along the bitangent becomes green along v, which is how three reads it without tangents.
      const turned = had && against !== (before?.against ?? false);
      return copyFor(material, found, turned, copies, replace);
    });
    mesh.material = Array.isArray(mesh.material) ? materials : materials[0];
  }
  for (const geometry of stored.keys()) geometry.deleteAttribute('tangent');
  return target;
}

// The material for meshes that want the same of it: itself for the first of them, copies for others.
function copyFor(material, found, turned, copies, replace) {
  const scales = ['normalScale', 'clearcoatNormalScale'].filter(name => material[name]);
  if (!copies.has(material)) copies.set(material, { made: new Map(), scales: scales.map(name => material[name].clone()) });
  const { made, scales: asFound } = copies.get(material);
  const wants = [found.frame, found.against, turned].join();
  if (!made.has(wants)) {
    const copy = made.size === 0 ? material : material.clone();
    made.set(wants, copy);
    scales.forEach((name, k) => {
      copy[name].copy(asFound[k]);
      if (turned) copy[name].y = -copy[name].y;
    });
    known.set(copy, found);
    replace(copy, { ...found, from: material });
  }
  return made.get(wants);
}

// Gives the mesh a geometry with the vectors of its triangles where that can be; the frame that it gets.
function onTriangles(mesh, materials, provoking, instances, made) {
  const why = !instances && mesh.isInstancedMesh ? 'has instances, whose transforms nodes do not tell' : cannot(mesh, materials);
  if (why) {
    console.warn(`Cotan: mesh "${mesh.name}" ${why}: its frame is cotangent, not triangle`);
    return 'cotangent';
  }
  const map = materials[0].normalMap ?? materials[0].clearcoatNormalMap;
  if (map?.matrixAutoUpdate) map.updateMatrix();
  const channel = map?.channel ?? 0, [a, b, , c, d] = map?.matrix.elements ?? [1, 0, 0, 0, 1];
  const key = [mesh.geometry.uuid, channel, a, b, c, d, provoking].join();
  if (!made.has(key)) made.set(key, withTriangles(mesh.geometry, channel ? `uv${channel}` : 'uv', [a, c, b, d], provoking));
  mesh.geometry = made.get(key);
  return 'triangle';
}

function cannot(mesh, materials) {
  if (mesh.isSkinnedMesh || Object.keys(mesh.geometry.morphAttributes).length) return 'deforms';
  if (mesh.isBatchedMesh) return 'is a batch, whose geometry is not ours to renumber';
  const ways = materials.flatMap(({ normalMap, clearcoatNormalMap }) => [normalMap, clearcoatNormalMap].filter(Boolean))
    .map(({ channel, rotation, repeat, matrix, matrixAutoUpdate }) =>
      [channel, ...matrixAutoUpdate ? [rotation, repeat.x, repeat.y] : matrix.elements.slice(0, 5)].join());
  if (new Set(ways).size > 1) return 'has normal maps over different texture coordinates';
  const channel = materials.map(material => material.normalMap ?? material.clearcoatNormalMap).find(Boolean)?.channel ?? 0;
  const { position, [channel ? `uv${channel}` : 'uv']: uv } = mesh.geometry.attributes;
  return position && uv ? '' : 'has no texture coordinates';
}

// Whether cross(normal, tangent) * tangent.w points against increasing v, by most triangles.
function bitangentsRunAgainstV({ attributes: { position, normal, uv, tangent }, index }) {
  if (!position || !normal || !uv || !tangent) return false;
  const edge = (attribute, from, to) =>
    ['getX', 'getY', 'getZ'].slice(0, attribute.itemSize).map(get => attribute[get](to) - attribute[get](from));
  let sum = 0;
  const count = index ? index.count : position.count;
  for (let k = 0; k + 2 < count; k += 3) {
    const [a, b, c] = [k, k + 1, k + 2].map(i => index ? index.getX(i) : i);
    const [x, y, z] = edge(position, a, b), [p, q, r] = edge(position, a, c), [u, v] = edge(uv, a, b), [s, t] = edge(uv, a, c);
    const facing = (y * r - z * q) * normal.getX(a) + (z * p - x * r) * normal.getY(a) + (x * q - y * p) * normal.getZ(a);
    sum += Math.sign((u * t - v * s) * facing * tangent.getW(a));
  }
  return sum < 0;
}
