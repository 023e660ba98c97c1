// Geometries of three.js as plain numbers.

// The first `width` components of all elements of an attribute of any type. All vectors are in Float64Array, so that the
// functions of vectors.js are compiled for one type.
export function numbersOf(attribute, width) {
  const { array, itemSize, normalized, count } = attribute;
  if (itemSize === width && !normalized && !attribute.isInterleavedBufferAttribute && !attribute.isFloat16BufferAttribute) return new Float64Array(array);
  const values = new Float64Array(count * width);
  for (let k = 0; k < count; ++k)
    for (let i = 0; i < width; ++i) values[k * width + i] = attribute.getComponent(k, i);
  return values;
}

// The vertex indices of all triangles, three for each; the index buffer's or 0, 1, 2, ...
export function cornersOf({ index, attributes: { position } }) {
  const count = index ? index.count : position.count, length = count - count % 3;
  return index ? new Uint32Array(index.array.subarray(0, length)) : Uint32Array.from({ length }, (_, k) => k);
}

// The rows [a, b, c] and [d, e, f] of a texture's matrix: u' = a u + b v + c; the identity without a texture.
function rowsOf(map) {
  if (map?.matrixAutoUpdate) map.updateMatrix();
  const [a, d, , b, e, , c, f] = map?.matrix.elements ?? [1, 0, 0, 0, 1, 0, 0, 0];
  return [[a, b, c], [d, e, f]];
}

// [m00, m01, m10, m11], the linear part of a texture's matrix.
export const uvMatrixOf = map => rowsOf(map).flatMap(row => row.slice(0, 2));

// Whether this part turns or mirrors uv, so that tangents for uv without it do not fit.
export const turns = map => { const [a, b, c, d] = uvMatrixOf(map); return b !== 0 || c !== 0 || !(a > 0 && d > 0); };

export const uvNameOf = map => (map?.channel ? `uv${map.channel}` : 'uv');

// A key that is equal for two maps that transform the same uv set by the same matrix, up to an offset.
export const readingOf = map => [map?.channel ?? 0, ...uvMatrixOf(map)].join();

// The uv at which the map is sampled, rounded to float. Those that are not finite are 0.
export function transformedUv(attribute, map) {
  const uv = numbersOf(attribute, 2), [[a, b, c], [d, e, f]] = rowsOf(map), finite = x => (Math.abs(x) <= 1e30 ? Math.fround(x) : 0);
  for (let k = 0; k < uv.length; k += 2) {
    const u = uv[k], v = uv[k + 1];
    uv[k] = finite(a * u + b * v + c);
    uv[k + 1] = finite(d * u + e * v + f);
  }
  return uv;
}

// { corners, position, normal, uv } of a geometry as its map sees it. normal is null if there are none.
export function meshOf(geometry, map) {
  const { position, normal, [uvNameOf(map)]: uv } = geometry.attributes;
  return { corners: cornersOf(geometry), position: numbersOf(position, 3), normal: normal ? numbersOf(normal, 3) : null, uv: transformedUv(uv, map) };
}
