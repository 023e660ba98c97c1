// The WebGL 2 backend of picture.js.
import { packed } from './gpu.js';

const kWholeCanvas = `#version 300 es
out vec2 place;
void main() { place = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0; gl_Position = vec4(place * 2.0 - 1.0, 0.0, 1.0); }`;

const pixels = ({ essl, values, maps }) => `#version 300 es
precision highp float;
precision highp int;
layout(std140) uniform Values { vec4 ${values.join(', ')}; } v;
${maps.map(name => `uniform sampler2D ${name};`).join('\n')}
in vec2 place;
out vec4 colour;
${essl}
void main() { colour = colour_at(place); }`;

export function glPainter(canvas, shader) {
  const gl = canvas.getContext('webgl2', { antialias: false, preserveDrawingBuffer: true });
  if (!gl) throw new Error('this browser supports neither');
  const program = gl.createProgram();
  for (const [type, text] of [[gl.VERTEX_SHADER, kWholeCanvas], [gl.FRAGMENT_SHADER, pixels(shader)]]) {
    const stage = gl.createShader(type);
    gl.shaderSource(stage, text);
    gl.compileShader(stage);
    if (!gl.getShaderParameter(stage, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(stage));
    gl.attachShader(program, stage);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(program));
  gl.useProgram(program);
  gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, gl.createBuffer());
  gl.uniformBlockBinding(program, gl.getUniformBlockIndex(program, 'Values'), 0);
  shader.maps.forEach((name, unit) => {
    gl.uniform1i(gl.getUniformLocation(program, name), unit);
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  });
  return {
    put(map, { width, height, data }) {
      gl.activeTexture(gl.TEXTURE0 + shader.maps.indexOf(map));
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, data);
      gl.generateMipmap(gl.TEXTURE_2D);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    },
    draw(values) {
      gl.bufferData(gl.UNIFORM_BUFFER, packed(shader.values, values), gl.DYNAMIC_DRAW);
      gl.viewport(0, 0, canvas.width, canvas.height);
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    },
  };
}
