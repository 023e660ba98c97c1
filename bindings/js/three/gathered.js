// Copies of geometries with vectors at their vertices.
import { BufferAttribute, BufferGeometry } from 'three';

// A copy of the attribute: new vertex k has the value of old vertex sources[k]. Instanced attributes are just cloned.
function gathered(attribute, sources) {
  if (attribute.isInstancedBufferAttribute) return attribute.clone();
  const { itemSize, normalized, gpuType } = attribute;
  const [array, stride, offset] = attribute.isInterleavedBufferAttribute
    ? [attribute.data.array, attribute.data.stride, attribute.offset] : [attribute.array, itemSize, 0];
  const values = new array.constructor(sources.length * itemSize);
  sources.forEach((source, k) => {
    for (let i = 0; i < itemSize; ++i) values[k * itemSize + i] = array[source * stride + offset + i];
  });
  const made = new BufferAttribute(values, itemSize, normalized);
  if (gpuType !== undefined) made.gpuType = gpuType;
  return made;
}

// A copy of the geometry without tangents. Its vertex k is the old vertex sources[k]: the old ones, then copies of some.
// corners: the new indices; false if the old ones stay.
export function withVertices(geometry, sources, corners) {
  const made = new BufferGeometry().copy(geometry).deleteAttribute('tangent');
  if (sources.length > geometry.attributes.position.count) {
    for (const name of Object.keys(made.attributes)) made.setAttribute(name, gathered(geometry.attributes[name], sources));
    for (const [name, targets] of Object.entries(geometry.morphAttributes)) made.morphAttributes[name] = targets.map(target => gathered(target, sources));
  }
  return corners ? made.setIndex(new BufferAttribute(sources.length > 65535 ? corners : Uint16Array.from(corners), 1)) : made;
}
