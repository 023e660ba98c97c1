// What all ways share: where the mesh lies in memory, how a point is projected, and the texel.
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
    Floats positions; // three a vertex, relative to the eye, which looks along -z
    Floats normals;
    Floats texcoords;
    Words corners;   // three a triangle: vertices of the mesh
    Words sources;   // per new vertex the vertex of the mesh (provoking); two words a vertex (smooth)
    Words packed;    // three words a triangle: U and V as halfs
    Words ids;       // per pixel the number of the triangle plus one (visibility)
    Floats result;   // per pixel (visibility)
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

// Half the field of view is where x/2 or y is 1/2.2 of the depth. y runs down the target.
const float kZoom = 2.2;
vec4 projected(vec3 p) { return vec4(0.5 * kZoom * p.x, -kZoom * p.y, -p.z - 0.5, -p.z); }

// Of a map with four domes, decoded: along +u, +v, outwards.
vec3 domes(vec2 uv)
{
    vec2 p = mod(uv * 4.0, 2.0) - 1.0;
    float z2 = 1.0 - dot(p, p);
    return z2 > 0.36 ? vec3(p, sqrt(z2)) : vec3(0.0, 0.0, 1.0);
}

// The model is a thin sheet: a bump in front is a dent behind. n stays as interpolated, for that is the
// side that U and V were made for, and the whole result is turned.
vec4 seen(vec3 perturbed, vec3 n, vec3 position)
{
    return vec4(dot(n, position) > 0.0 ? -perturbed : perturbed, 1.0);
}
