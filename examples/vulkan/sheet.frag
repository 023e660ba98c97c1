#version 450
#extension GL_GOOGLE_include_directive : require
#include "cotan.glsl" // the output of `cotan shader --lang glsl --frame cotangent`

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 0) out vec4 result;

// A texel of a glTF normal map of four domes: red along +u, green up the image.
vec3 sample_domes(vec2 at)
{
    vec2 p = mod(at * 4.0, 2.0) - 1.0;
    float z2 = 1.0 - dot(p, p);
    vec3 m = z2 > 0.36 ? vec3(p.x, -p.y, sqrt(z2)) : vec3(0.0, 0.0, 1.0);
    return (127.0 * m + 128.0) / 255.0;
}

void main()
{
    vec3 n = cotan_perturb_normal(normal, position, uv, sample_domes(uv));
    // For a thin sheet a bump in front is a dent behind.
    result = vec4(dot(normal, position) > 0.0 ? -n : n, 1.0);
}
