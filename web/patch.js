// A flat patch with stretched, sheared and mirrored texture coordinates, and how frames read a normal map on it. Angles
// are in degrees. The patch is in the plane z = 0, its normal is (0, 0, 1).

export const kFrames = {
  cotangent: { name: 'Cotangents', text: 'the gradients of u and v, scaled so that the longer has length one' },
  printed: { name: 'As printed in 2013', text: 'the same without the sign: reversed where rows run down' },
  unit: { name: 'Tangents, each of unit length', text: 'dP/du and dP/dv used as gradients' },
  orthonormal: { name: 'Tangents at right angles', text: 'as stored per vertex, for example by MikkTSpace' },
};

// dP/du and dP/dv, the columns of the matrix from uv to the plane.
export function patch({ stretch, shear, mirrored }) {
  const lean = shear * Math.PI / 180;
  return { u: [(mirrored ? -1 : 1) * stretch, 0], v: [Math.sin(lean), Math.cos(lean)] };
}

export function gradients({ u, v }) {
  const determinant = u[0] * v[1] - u[1] * v[0];
  return { u: [v[1] / determinant, -v[0] / determinant], v: [-u[1] / determinant, u[0] / determinant] };
}

const length = a => Math.hypot(a[0], a[1]);
const times = (a, s) => [a[0] * s, a[1] * s];

// The two vectors by which the frame multiplies the texel's x and y. rowsDown: whether rows of the target run down.
export function frameOf(name, lies, rowsDown) {
  const g = gradients(lies);
  if (name === 'cotangent' || name === 'printed') {
    const scale = (name === 'printed' && rowsDown ? -1 : 1) / Math.max(length(g.u), length(g.v));
    return { t: times(g.u, scale), b: times(g.v, scale) };
  }
  const t = times(lies.u, 1 / length(lies.u));
  if (name === 'unit') return { t, b: times(lies.v, 1 / length(lies.v)) };
  const side = Math.sign(lies.u[0] * lies.v[1] - lies.u[1] * lies.v[0]);
  return { t, b: [-t[1] * side, t[0] * side] };
}

// dh/du and dh/dv of the relief, four round domes per unit square of uv. The same in shaders and in JavaScript.
export const kRelief = {
  essl: `
vec2 slopes(vec2 uv) { // dh/du, dh/dv
  vec2 d = fract(uv * 2.0) - 0.5;
  return -d * 4.2 * max(1.0 - dot(d, d) / 0.14, 0.0);
}`,
  wgsl: `
fn slopes(uv: vec2f) -> vec2f {
  let d = fract(uv * 2.0) - 0.5;
  return -d * 4.2 * max(1.0 - dot(d, d) / 0.14, 0.0);
}`,
};
export function slopes(u, v) {
  const d = [2 * u - Math.floor(2 * u) - 0.5, 2 * v - Math.floor(2 * v) - 0.5], r2 = (d[0] * d[0] + d[1] * d[1]) / 0.14;
  return r2 < 1 ? times(d, -4.2 * (1 - r2)) : [0, 0];
}

// Mean angle over the domes between the normals of a frame and those of the relief that is stretched with the surface.
// Reference: normal minus h_u grad u + h_v grad v, with the gradients scaled so that the longer has length one.
export function meanError(name, lies, rowsDown) {
  const right = frameOf('cotangent', lies, false), frame = frameOf(name, lies, rowsDown), steps = 64;
  let sum = 0, count = 0;
  for (let i = 0; i < steps; ++i)
    for (let j = 0; j < steps; ++j) {
      const [hu, hv] = slopes((i + 0.5) / steps / 2, (j + 0.5) / steps / 2);
      if (hu === 0 && hv === 0) continue;
      const [a, b] = [right, frame].map(({ t, b }) => [-hu * t[0] - hv * b[0], -hu * t[1] - hv * b[1], 1]);
      const cross = Math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]);
      sum += Math.atan2(cross, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
      ++count;
    }
  return sum / count * 180 / Math.PI;
}
