#version 460
#extension GL_GOOGLE_include_directive : require
// 2b. Interpolates the frame `smooth`, computed when the mesh was loaded, 8 bytes per vertex. This example reads the
// four SNORM16 from a buffer; as a vertex attribute of that format they are unpacked for free.
#include "common.glsl"
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec2 uv;
layout(location = 3) out vec3 cotangent;
layout(location = 4) out vec3 cobitangent;

void main()
{
    uint v = uint(gl_VertexIndex);
    position = positionOf(v);
    normal = normalOf(v);
    uv = texcoordOf(v);
    vec4 q = vec4(unpackSnorm2x16(draw.sources.at[2u * v]), unpackSnorm2x16(draw.sources.at[2u * v + 1u]));
    cotan_covectors c = cotan_unpack_smooth8(normal, q);
    cotangent = c.t;
    cobitangent = c.b;
    gl_Position = projected(position);
}
