// What the small WebGL 2 views of this page share.
export function context(canvas) {
  const gl = canvas.getContext('webgl2', { antialias: false, preserveDrawingBuffer: true });
  if (!gl) throw new Error('this browser has no WebGL 2, which the pictures need');
  return gl;
}

const kWholeCanvas = `#version 300 es
out vec2 place; // of the canvas, 0 to 1, from the bottom left
void main() { place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0; gl_Position = vec4(place * 2.0 - 1.0, 0.0, 1.0); }`;

// A program that runs `fragment` for each pixel of the canvas. Its inputs: place; what the fragment declares.
export function program(gl, fragment) {
  const made = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, kWholeCanvas], [gl.FRAGMENT_SHADER, `#version 300 es
precision highp float;
precision highp int;
in vec2 place;
out vec4 colour;
${fragment}`]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, text);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
    gl.attachShader(made, shader);
  }
  gl.linkProgram(made);
  if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
  return made;
}

// Floats, and lists of two or three, by name.
export function set(gl, made, values) {
  gl.useProgram(made);
  for (const [name, value] of Object.entries(values)) {
    const numbers = [value].flat();
    gl[`uniform${numbers.length}fv`](gl.getUniformLocation(made, name), numbers);
  }
}

// The texture that a sampler reads.
export function bind(gl, made, name, unit, texture) {
  gl.useProgram(made);
  gl.uniform1i(gl.getUniformLocation(made, name), unit);
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(gl.TEXTURE_2D, texture);
}

export function draw(gl) {
  gl.drawArrays(gl.TRIANGLES, 0, 3);
}

// A lit surface, for all of them: one light near the surface, a soft highlight.
// surface: position of the pixel, z up; n: its normal; light: position.
export const kLit = `
vec3 lit(vec3 surface, vec3 n, vec3 light, vec3 base) {
  vec3 to = normalize(light - surface), eye = vec3(0.0, 0.0, 1.0), half_way = normalize(to + eye);
  float diffuse = max(dot(n, to), 0.0), shine = pow(max(dot(n, half_way), 0.0), 40.0) * step(0.0, dot(n, to));
  vec3 sum = base * (0.12 + 0.95 * diffuse) + vec3(0.35) * shine;
  return pow(sum, vec3(1.0 / 2.2));
}
`;
