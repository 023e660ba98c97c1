#version 460
#extension GL_GOOGLE_include_directive : require
// The frame `cotangent` from screen derivatives, for comparison.
#include "common.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 0) out vec4 color;

void main()
{
    vec3 dpdx = dFdx(position), dpdy = dFdy(position);
    vec2 duvdx = dFdx(uv), duvdy = dFdy(uv);
    color = seen(cotan_perturb_cotangent(normal, dpdx, dpdy, duvdx, duvdy, domes(uv)), normal, position);
}
