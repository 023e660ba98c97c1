#version 460
#extension GL_GOOGLE_include_directive : require
#include "common.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) in vec3 cotangent;
layout(location = 4) in vec3 cobitangent;
layout(location = 0) out vec4 color;

void main() { color = seen(cotan_perturb_smooth(normal, cotangent, cobitangent, domes(uv)), normal, position); }
