// Geometries of three.js as plain numbers.

// The first `width` components of all elements of an attribute of any type.
export function numbersOf(attribute, width) {
  const values = new Float64Array(attribute.count * width);
  for (let k = 0; k < attribute.count; ++k)
    for (let i = 0; i < width; ++i) values[k * width + i] = attribute.getComponent(k, i);
  return values;
}

// The vertex indices of all triangles, three for each; the index buffer's or 0, 1, 2, ...
export function cornersOf({ index, attributes: { position } }) {
  const count = index ? index.count : position.count;
  return Uint32Array.from({ length: count - count % 3 }, index ? (_, k) => index.getX(k) : (_, k) => k);
}

// [m00, m01, m10, m11], the linear part of a texture's matrix; the identity without a texture.
export function uvMatrixOf(map) {
  if (map?.matrixAutoUpdate) map.updateMatrix();
  const [a, b, , c, d] = map?.matrix.elements ?? [1, 0, 0, 0, 1];
  return [a, c, b, d];
}

export const uvNameOf = map => (map?.channel ? `uv${map.channel}` : 'uv');

// A key that is equal for two maps that transform the same uv set by the same matrix, up to an offset.
export const readingOf = map => [map?.channel ?? 0, ...uvMatrixOf(map)].join();

// The uv at which a map with this matrix is sampled, up to an offset.
export function transformedUv(attribute, [m00, m01, m10, m11]) {
  const uv = numbersOf(attribute, 2);
  for (let k = 0; k < uv.length; k += 2) {
    const u = uv[k], v = uv[k + 1];
    uv[k] = m00 * u + m01 * v;
    uv[k + 1] = m10 * u + m11 * v;
  }
  return uv;
}
