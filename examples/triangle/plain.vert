#version 460
#extension GL_GOOGLE_include_directive : require
// An ordinary vertex shader, for the methods that do not compute U and V in the vertex stage.
#include "common.glsl"
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec2 uv;

void main()
{
    uint v = uint(gl_VertexIndex);
    position = positionOf(v);
    normal = normalOf(v);
    uv = texcoordOf(v);
    gl_Position = projected(position);
}
