// A geometry of three.js as plain numbers.

// All components, whatever the attribute is stored as.
export function numbersOf(attribute, width) {
  const values = new Float64Array(attribute.count * width);
  for (let k = 0; k < attribute.count; ++k)
    for (let i = 0; i < width; ++i) values[k * width + i] = attribute.getComponent(k, i);
  return values;
}

// Three vertices for each triangle.
export function cornersOf({ index, attributes: { position } }) {
  const count = index ? index.count : position.count;
  return Uint32Array.from({ length: count - count % 3 }, index ? (_, k) => index.getX(k) : (_, k) => k);
}

// [m00, m01, m10, m11] of a texture's matrix: how it turns differences of uv. The identity without a texture.
export function turnOf(map) {
  if (map?.matrixAutoUpdate) map.updateMatrix();
  const [a, b, , c, d] = map?.matrix.elements ?? [1, 0, 0, 0, 1];
  return [a, c, b, d];
}

export const uvNameOf = map => (map?.channel ? `uv${map.channel}` : 'uv');

// What is the same for two maps that read a geometry the same way.
export const readingOf = map => [map?.channel ?? 0, ...turnOf(map)].join();

// uv as the map reads them, up to an offset.
export function turnedUv(attribute, [m00, m01, m10, m11]) {
  const uv = numbersOf(attribute, 2);
  for (let k = 0; k < uv.length; k += 2) {
    const u = uv[k], v = uv[k + 1];
    uv[k] = m00 * u + m01 * v;
    uv[k + 1] = m10 * u + m11 * v;
  }
  return uv;
}
