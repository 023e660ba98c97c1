// Shared by the passes: buffers of the mesh and its adjacency, and the corners of triangles.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/frame.h"
#include "cotan/triangle.h"
#include "cotan/pack.h"
#include "cotan/corner.h"
layout(local_size_x = 64) in;

layout(buffer_reference, std430, buffer_reference_align = 4) buffer Floats { float at[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Words { uint at[]; };

layout(push_constant, std430) uniform Derive {
    Floats positions; // three per vertex, new for every image
    Floats normals;   // three per vertex, unit, new for every image
    Floats texcoords;
    Words indices;
    Words vertexBegin; // this and the next three: the arrays of cotan::Adjacency, made at load
    Words vertices;
    Words cornerBegin;
    Words corners;
    Words frames;    // output: two words per vertex, SNORM16x4
    Words triangles; // output: three words per triangle, six halfs
    uint count;      // number of groups or triangles
    uint firstMirrored;
}
derive;

vec3 vectorAt(Floats list, uint v) { return vec3(list.at[3u * v], list.at[3u * v + 1u], list.at[3u * v + 2u]); }
vec3 positionOf(uint v) { return vectorAt(derive.positions, v); }
vec3 normalOf(uint v) { return vectorAt(derive.normals, v); }
vec2 texcoordOf(uint v) { return vec2(derive.texcoords.at[2u * v], derive.texcoords.at[2u * v + 1u]); }

// Index of the invocation. Large dispatches have several rows of work groups.
uint invocation()
{
    return gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x) + gl_GlobalInvocationID.x;
}

// The edges from a corner to the next and to the previous one.
struct Corner {
    vec3 dp1, dp2;
    vec2 duv1, duv2;
};

Corner cornerAt(uint c)
{
    uint k = c % 3u, first = c - k;
    uint v0 = derive.indices.at[c];
    uint v1 = derive.indices.at[first + (k == 2u ? 0u : k + 1u)];
    uint v2 = derive.indices.at[first + (k == 0u ? 2u : k - 1u)];
    vec3 p = positionOf(v0);
    vec2 uv = texcoordOf(v0);
    return Corner(positionOf(v1) - p, positionOf(v2) - p, texcoordOf(v1) - uv, texcoordOf(v2) - uv);
}

// Writes four numbers in [-1, 1] to all vertices of a group.
void writeToGroup(uint group, vec4 q)
{
    for (uint i = derive.vertexBegin.at[group]; i < derive.vertexBegin.at[group + 1u]; ++i) {
        uint v = derive.vertices.at[i];
        derive.frames.at[2u * v] = packSnorm2x16(q.xy);
        derive.frames.at[2u * v + 1u] = packSnorm2x16(q.zw);
    }
}
