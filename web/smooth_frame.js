// The frame `smooth` for materials of three.js: cotangents that the library makes at the vertices, interpolated.
import { BufferAttribute } from 'three';
import { cotan } from './library.js';

// Gives the meshes below `object`, whose materials untangle() has replaced the frame of, their cotangents. Those that cannot
// have any keep their frame.
export async function useSmooth(object) {
  const meshes = [];
  object.traverse(child => { if (child.isMesh && mapOf(child)) meshes.push(child); });
  if (meshes.length === 0) return;
  const library = await cotan(), text = await library.shader({ language: 'essl', frame: 'smooth', convention: 'gltf' });
  await Promise.all(meshes.map(async mesh => {
    const { position, normal, [mapOf(mesh).channel ? `uv${mapOf(mesh).channel}` : 'uv']: uv } = mesh.geometry.attributes;
    if (!position || !normal || !uv) return;
    const { u, v } = await library.smooth({ positions: floats(position), normals: floats(normal), uvs: floats(uv), ...indicesOf(mesh.geometry) });
    mesh.geometry.setAttribute('cotanU', new BufferAttribute(u, 3));
    mesh.geometry.setAttribute('cotanV', new BufferAttribute(v, 3));
    for (const material of [mesh.material].flat()) replace(material, text.replaceAll('cotan_', 'cotan_smooth_'));
  }));
}

const mapOf = mesh => [mesh.material].flat().find(material => material.normalMap)?.normalMap;

function floats(attribute) {
  const values = new Float32Array(attribute.count * attribute.itemSize);
  for (let k = 0; k < values.length; ++k) values[k] = attribute.getComponent(Math.floor(k / attribute.itemSize), k % attribute.itemSize);
  return values;
}

const indicesOf = ({ index }) => index ? { indices: Uint32Array.from(index.array) } : {};

function replace(material, text) {
  const before = material.onBeforeCompile, key = material.customProgramCacheKey();
  material.onBeforeCompile = (shader, renderer) => {
    before.call(material, shader, renderer);
    const varyings = way => `${way} vec3 vCotanU;\n${way} vec3 vCotanV;\n`;
    shader.vertexShader = `attribute vec3 cotanU;\nattribute vec3 cotanV;\n${varyings('varying')}${shader.vertexShader}`
      .replace('#include <defaultnormal_vertex>', '$&\nvCotanU = normalMatrix * cotanU;\nvCotanV = normalMatrix * cotanV;\n');
    shader.fragmentShader = `${varyings('varying')}${shader.fragmentShader}`.replace(/mat3 getTangentFrame\([^{]*\{[^}]*\}/, `${text}
mat3 getTangentFrame( vec3 position, vec3 n, vec2 uv ) {
	cotan_smooth_frame f = cotan_smooth_frame_smooth( n, vCotanU, vCotanV );
	return mat3( f.t, f.b, f.n );
}`);
  };
  material.customProgramCacheKey = () => `${key},smooth`;
  material.needsUpdate = true;
}
