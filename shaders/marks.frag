#version 460
#extension GL_GOOGLE_include_directive : require
// Marks the triangles of which a sample passes the depth test.
#include "gpu_structs.glsl"

layout(early_fragment_tests) in;
layout(set = 0, binding = 3, std430) writeonly buffer MarkBlock { uint marks[]; };
layout(push_constant, std430) uniform DrawBlock { CotanDraw draw; };

void main() { marks[draw.order + uint(gl_PrimitiveID)] = 1u; }
