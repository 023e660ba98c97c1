// A normal map as relief under a light that follows the pointer: as it is on the left of the border, mended on the right.
import { bind, context, draw, kLit, program, set } from './gl.js';

const kFragment = `
uniform sampler2D before, after;
uniform vec3 light;
uniform float border, aspect, width; // aspect: height over width; width: of the canvas, pixels
uniform float green_down;            // 1: the engine reads green against v
${kLit}
void main() {
  bool right = place.x >= border;
  vec2 at = vec2(place.x, 1.0 - place.y);
  vec3 c = right ? texture(after, at).xyz : texture(before, at).xyz;
  vec3 n = (c * 255.0 - 128.0) / 127.0;
  if (green_down > 0.5) n.y = -n.y;
  n = dot(n, n) > 1e-4 ? normalize(n) : vec3(0.0, 0.0, 1.0);
  colour = vec4(lit(vec3(place * vec2(1.0, aspect), 0.0), n, light, vec3(0.42, 0.45, 0.52)), 1.0);
  if (abs(gl_FragCoord.x - border * width) < 1.0) colour = vec4(1.0);
}
`;

export function mapView(canvas) {
  const gl = context(canvas), made = program(gl, kFragment);
  const textures = [gl.createTexture(), gl.createTexture()];
  const state = { border: 0.5, light: [0.3, 0.75], greenDown: false, aspect: 1 };

  function show() {
    set(gl, made, { border: state.border, aspect: state.aspect, width: canvas.width, green_down: state.greenDown ? 1 : 0,
      light: [state.light[0], state.light[1] * state.aspect, 0.28] });
    bind(gl, made, 'before', 0, textures[0]);
    bind(gl, made, 'after', 1, textures[1]);
    gl.viewport(0, 0, canvas.width, canvas.height);
    draw(gl);
  }
  canvas.addEventListener('pointermove', event => {
    const box = canvas.getBoundingClientRect();
    state.light = [(event.clientX - box.left) / box.width, 1 - (event.clientY - box.top) / box.height];
    show();
  });
  return {
    show: border => { if (border !== undefined) state.border = border; show(); },
    set greenDown(value) { state.greenDown = value; },
    // which: 0 before, 1 after
    put(which, picture) {
      const { width, height, data } = inBytes(picture);
      state.aspect = height / width;
      canvas.width = Math.min(1024, Math.max(256, width));
      canvas.height = Math.max(1, Math.round(canvas.width * Math.min(state.aspect, 2)));
      gl.bindTexture(gl.TEXTURE_2D, textures[which]);
      gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, width, height, 0, gl.RGBA, gl.UNSIGNED_BYTE, data);
      gl.generateMipmap(gl.TEXTURE_2D);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
    },
  };
}

// Whatever its bits, in 8, for looking at.
function inBytes({ width, height, bits, data }) {
  return { width, height, data: bits === 8 ? data : Uint8Array.from(data, value => bits === 16 ? Math.round(value / 257) : 255 * Math.min(1, Math.max(0, value))) };
}
