// Vertex attributes for split vertices.
import { BufferAttribute } from 'three';

// A copy of the attribute: new vertex k has the value of old vertex sources[k]. Instanced attributes are just cloned.
export function gathered(attribute, sources) {
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
