// The frame `triangle` in HLSL for Direct3D, where a triangle's first vertex is the provoking one and rows run down.
// Four methods to provide U and V to the pixel shader:
//   provokingVertex and shadeFlat   computed by the vertex shader at the provoking vertex of each triangle
//   meshlet and shadeFlat           computed by the mesh shader for each primitive (shader model 6.5; -D MESH)
//   pack, then shadeRead            computed once, 12 bytes per triangle, read by SV_PrimitiveID
//   pack, then resolve              computed once, read when a visibility buffer is resolved
// Tests compile it by DXC, and all but the mesh shader by FXC and glslangValidator.
#define COTAN_LANG_HLSL
#include "cotan/lang.h"
#include "cotan/normal.h"
#include "cotan/frame.h"
#include "cotan/fused.h"
#include "cotan/triangle.h"
#include "cotan/pack.h"

StructuredBuffer<float3> positions : register(t0); // relative to the eye, which looks along -z
StructuredBuffer<float3> normals : register(t1);
StructuredBuffer<float2> texcoords : register(t2); // v runs down
StructuredBuffer<uint> corners : register(t3);     // the index buffer
StructuredBuffer<uint3> packed : register(t4);     // U and V, written by `pack`
Texture2D<float4> normalMap : register(t5);
Texture2D<uint> numbers : register(t6);            // visibility buffer: triangle index plus one; 0: none
SamplerState mapSampler : register(s0);
RWStructuredBuffer<uint3> packedOut : register(u0);
RWTexture2D<float4> picture : register(u1);
cbuffer View : register(b0)
{
    float4x4 projection;
    float2 tangents; // of half the field of view, horizontal and vertical
    uint triangleCount;
}

// The format of glTF normal maps: three channels, exact, green against increasing v.
static const cotan_normal_format kFormat = { COTAN_EXPAND_EXACT, COTAN_CHANNELS_XYZ, -1.0, 1.0 };

cotan_packed_triangle made(uint k)
{
    uint a = corners[3 * k], b = corners[3 * k + 1], c = corners[3 * k + 2];
    // For a skinned mesh, transform the three positions and normals here.
    float3 p0 = positions[a];
    float2 uv0 = texcoords[a];
    cotan_triangle t = cotan_triangle_of_sound_edges(positions[b] - p0, positions[c] - p0, texcoords[b] - uv0,
                                                     texcoords[c] - uv0, normals[a] + normals[b] + normals[c]);
    return cotan_pack_triangle(t.u, t.v);
}

cotan_packed_triangle unpacked(uint3 words)
{
    cotan_packed_triangle p;
    p.a = words.x;
    p.b = words.y;
    p.c = words.z;
    return p;
}

uint3 words(cotan_packed_triangle p) { return uint3(p.a, p.b, p.c); }

// For a thin sheet: n stays as interpolated, and the result is negated on back faces.
float3 perturbed(float3 n, float3 position, cotan_packed_triangle p, float3 texel)
{
    float3 r = cotan_perturb_triangle(n, cotan_unpack_triangle_u(p), cotan_unpack_triangle_v(p),
                                      cotan_decode(texel, kFormat));
    return dot(n, position) > 0.0 ? -r : r;
}

struct Handed {
    float4 at : SV_Position;
    float3 position : POSITION;
    float3 normal : NORMAL;
    float2 uv : TEXCOORD0;
    nointerpolation uint3 words : TEXCOORD1; // U and V, from the provoking vertex
};

Handed placed(uint v)
{
    Handed o;
    o.position = positions[v];
    o.at = mul(projection, float4(o.position, 1.0));
    o.normal = normals[v];
    o.uv = texcoords[v];
    o.words = uint3(0, 0, 0);
    return o;
}

// ---- at the provoking vertex ------------------------------------------------------------------------
// Requires that vertex k is the provoking vertex of triangle k: see `cotan convert --provoking first` or provokingMesh.
Handed provokingVertex(uint v : SV_VertexID)
{
    Handed o = placed(v);
    if (v < triangleCount)
        o.words = words(made(v));
    return o;
}

float4 shadeFlat(Handed i) : SV_Target
{
    return float4(perturbed(i.normal, i.position, unpacked(i.words), normalMap.Sample(mapSampler, i.uv).xyz), 1.0);
}

// ---- in a mesh shader -----------------------------------------------------------------------------------
#ifdef MESH
struct OfPrimitive {
    uint3 words : TEXCOORD1; // U and V, read by shadeFlat
};
struct OfVertex {
    float4 at : SV_Position;
    float3 position : POSITION;
    float3 normal : NORMAL;
    float2 uv : TEXCOORD0;
};

// The simplest meshlets: 32 triangles per group, each with three vertices of its own.
[outputtopology("triangle")]
[numthreads(32, 1, 1)]
void meshlet(uint thread : SV_GroupIndex, uint group : SV_GroupID, out vertices OfVertex vertex[96],
             out indices uint3 triangleCorners[32], out primitives OfPrimitive primitive[32])
{
    uint first = 32 * group, count = min(32, triangleCount - first);
    SetMeshOutputCounts(3 * count, count);
    if (thread >= count)
        return;
    for (uint corner = 0; corner < 3; ++corner) {
        Handed o = placed(corners[3 * (first + thread) + corner]);
        vertex[3 * thread + corner].at = o.at;
        vertex[3 * thread + corner].position = o.position;
        vertex[3 * thread + corner].normal = o.normal;
        vertex[3 * thread + corner].uv = o.uv;
    }
    triangleCorners[thread] = uint3(3 * thread, 3 * thread + 1, 3 * thread + 2);
    primitive[thread].words = words(made(first + thread));
}
#endif

// ---- read by the number of the triangle ---------------------------------------------------------------
[numthreads(64, 1, 1)]
void pack(uint3 id : SV_DispatchThreadID)
{
    if (id.x < triangleCount)
        packedOut[id.x] = words(made(id.x));
}

Handed plainVertex(uint v : SV_VertexID) { return placed(v); }

float4 shadeRead(Handed i, uint k : SV_PrimitiveID) : SV_Target
{
    return float4(perturbed(i.normal, i.position, unpacked(packed[k]), normalMap.Sample(mapSampler, i.uv).xyz), 1.0);
}

// ---- where a visibility buffer is shaded --------------------------------------------------------------
// Solves p0 + x e1 + y e2 = depth * ray for x and y by Cramer's rule.
float2 barycentrics(float3 ray, float3 p0, float3 e1, float3 e2)
{
    return float2(dot(ray, cross(e2, p0)), dot(ray, cross(p0, e1))) / dot(ray, cross(e1, e2));
}

[numthreads(8, 8, 1)]
void resolve(uint3 id : SV_DispatchThreadID)
{
    uint2 size;
    numbers.GetDimensions(size.x, size.y);
    if (any(id.xy >= size))
        return;
    uint number = numbers[id.xy];
    if (number == 0)
        return;
    uint k = number - 1;
    uint a = corners[3 * k], b = corners[3 * k + 1], c = corners[3 * k + 2];
    float3 p0 = positions[a], e1 = positions[b] - p0, e2 = positions[c] - p0;
    float2 step = 2.0 / float2(size), ndc = (float2(id.xy) + 0.5) * step - 1.0;
    float3 ray = float3(ndc.x * tangents.x, -ndc.y * tangents.y, -1.0);
    float3 rayX = ray + float3(step.x * tangents.x, 0.0, 0.0), rayY = ray - float3(0.0, step.y * tangents.y, 0.0);
    float2 at = barycentrics(ray, p0, e1, e2);
    float2 atX = barycentrics(rayX, p0, e1, e2) - at, atY = barycentrics(rayY, p0, e1, e2) - at;
    float2 uv0 = texcoords[a], d1 = texcoords[b] - uv0, d2 = texcoords[c] - uv0;
    float3 normal = normals[a] * (1.0 - at.x - at.y) + normals[b] * at.x + normals[c] * at.y;
    float3 texel = normalMap.SampleGrad(mapSampler, uv0 + d1 * at.x + d2 * at.y, d1 * atX.x + d2 * atX.y,
                                        d1 * atY.x + d2 * atY.y).xyz;
    picture[id.xy] = float4(perturbed(normal, ray, unpacked(packed[k]), texel), 1.0);
}
