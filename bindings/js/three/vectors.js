// Vectors of three numbers within instances of Float64Array.

export const dot = (a, i, b, j) => a[i] * b[j] + a[i + 1] * b[j + 1] + a[i + 2] * b[j + 2];

// out[o..] = a[i..] x b[j..] * scale; out may not be a or b there.
export function cross(out, o, a, i, b, j, scale = 1) {
  out[o] = (a[i + 1] * b[j + 2] - a[i + 2] * b[j + 1]) * scale;
  out[o + 1] = (a[i + 2] * b[j] - a[i] * b[j + 2]) * scale;
  out[o + 2] = (a[i] * b[j + 1] - a[i + 1] * b[j]) * scale;
}

// out[o..] = a[i..] * p + b[j..] * q
export function combine(out, o, a, i, p, b, j, q) {
  out[o] = a[i] * p + b[j] * q;
  out[o + 1] = a[i + 1] * p + b[j + 1] * q;
  out[o + 2] = a[i + 2] * p + b[j + 2] * q;
}

// Removes the part of out[o..] along the unit vector n[i..].
export const flatten = (out, o, n, i) => combine(out, o, out, o, 1, n, i, -dot(out, o, n, i));

// out[o..] = m[j..] a[i..]; m: three columns
export function transform(out, o, m, j, a, i) {
  for (let k = 0; k < 3; ++k) out[o + k] = m[j + k] * a[i] + m[j + k + 3] * a[i + 1] + m[j + k + 6] * a[i + 2];
}

// Makes out[o..] a unit vector, or zeros; returns whether it has a direction.
export function normalise(out, o) {
  const length = Math.sqrt(dot(out, o, out, o)), usable = length > 1e-20 && length < Infinity;
  for (let k = o; k < o + 3; ++k) out[k] = usable ? out[k] / length : 0;
  return usable;
}

// Reads the edges of a triangle, from its corner c to the next and to the previous corner, then u and v along each.
export function readEdges(out, { corners, position, uv }, c) {
  const f = c - c % 3, a = corners[c], b = corners[f + (c + 1) % 3], d = corners[f + (c + 2) % 3];
  combine(out, 0, position, 3 * b, 1, position, 3 * a, -1);
  combine(out, 3, position, 3 * d, 1, position, 3 * a, -1);
  for (let i = 0; i < 2; ++i) {
    out[6 + i] = uv[2 * b + i] - uv[2 * a + i];
    out[8 + i] = uv[2 * d + i] - uv[2 * a + i];
  }
}

// Twice the area of the uv that readEdges() has read, positive if counterclockwise.
export const uvArea = e => e[6] * e[9] - e[7] * e[8];
