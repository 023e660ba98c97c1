// Shared by all methods: buffers of the mesh, projection, and the normal map.
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_buffer_reference : require
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/frame.h"
#include "cotan/fused.h"
#include "cotan/triangle.h"
#include "cotan/pack.h"

layout(buffer_reference, std430, buffer_reference_align = 4) buffer Floats { float at[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) buffer Words { uint at[]; };

layout(push_constant, std430) uniform Draw {
    Floats positions; // three per vertex, relative to the eye, which looks along -z
    Floats normals;
    Floats texcoords;
    Words corners;   // three vertex indices per triangle
    Words sources;   // provoking: for each new vertex the old one; smooth: the frame, two words per vertex
    Words packed;    // three words per triangle: U and V as halfs
    Words ids;       // visibility: the triangle index plus one of each pixel
    Floats result;   // visibility: the colour of each pixel
    Words meshlets;  // the arrays of cotan::RingMeshlets (mesh-smooth, ring)
    Words meshletVertices;
    Words meshletTriangles;
    Words ringBegin;
    Words ring;
    uint triangles;
    uint width;
    uint height;
}
draw;

vec3 positionOf(uint v)
{
    return vec3(draw.positions.at[3u * v], draw.positions.at[3u * v + 1u], draw.positions.at[3u * v + 2u]);
}
vec3 normalOf(uint v)
{
    return vec3(draw.normals.at[3u * v], draw.normals.at[3u * v + 1u], draw.normals.at[3u * v + 2u]);
}
vec2 texcoordOf(uint v) { return vec2(draw.texcoords.at[2u * v], draw.texcoords.at[2u * v + 1u]); }

// The border of the view is at |x|/2 = depth/2.2 and |y| = depth/2.2. y runs down the render target.
const float kZoom = 2.2;
vec4 projected(vec3 p) { return vec4(0.5 * kZoom * p.x, -kZoom * p.y, -p.z - 0.5, -p.z); }

// The decoded texel of a normal map of four domes: along +u, +v, outwards.
vec3 domes(vec2 uv)
{
    vec2 p = mod(uv * 4.0, 2.0) - 1.0;
    float z2 = 1.0 - dot(p, p);
    return z2 > 0.36 ? vec3(p, sqrt(z2)) : vec3(0.0, 0.0, 1.0);
}

// For a thin sheet a bump in front is a dent behind. So the frame uses the interpolated n, the side that U and V were
// computed for, and on back faces the result is negated.
vec4 seen(vec3 perturbed, vec3 n, vec3 position)
{
    return vec4(dot(n, position) > 0.0 ? -perturbed : perturbed, 1.0);
}
