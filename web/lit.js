// Shading for all small images: one point light near the surface, with a soft highlight.
// surface: position of the pixel, z up; n: its normal; light: position of the light; base: colour of the surface.
export const kLit = {
  essl: `
vec3 lit(vec3 surface, vec3 n, vec3 light, vec3 base) {
  vec3 to = normalize(light - surface), half_way = normalize(to + vec3(0.0, 0.0, 1.0));
  float diffuse = max(dot(n, to), 0.0), shine = pow(max(dot(n, half_way), 0.0), 40.0) * step(0.0, dot(n, to));
  return pow(base * (0.12 + 0.95 * diffuse) + vec3(0.35) * shine, vec3(1.0 / 2.2));
}`,
  wgsl: `
fn lit(surface: vec3f, n: vec3f, light: vec3f, base: vec3f) -> vec3f {
  let to = normalize(light - surface);
  let half_way = normalize(to + vec3f(0.0, 0.0, 1.0));
  let diffuse = max(dot(n, to), 0.0);
  let shine = pow(max(dot(n, half_way), 0.0), 40.0) * step(0.0, dot(n, to));
  return pow(base * (0.12 + 0.95 * diffuse) + vec3f(0.35) * shine, vec3f(1.0 / 2.2));
}`,
};
