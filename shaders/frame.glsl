// The frame of a fragment: an adapter between interpolated attributes and cotan/frame.h.

// Screen-space differences of position and texture coordinates to the next pixel in x and in y.
struct Differences {
    vec3 dpdx;
    vec3 dpdy;
    vec2 duvdx;
    vec2 duvdy;
};

Differences screenDifferences(vec3 position, vec2 uv)
{
    return Differences(dFdxFine(position), dFdyFine(position), dFdxFine(uv), dFdyFine(uv));
}

#ifdef COTAN_EXACT
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Floats { float at[]; };
layout(buffer_reference, std430, buffer_reference_align = 4) readonly buffer Words { uint at[]; };

vec3 positionOf(uint vertex)
{
    Floats f = Floats(draw.positions);
    return vec3(f.at[3u * vertex], f.at[3u * vertex + 1u], f.at[3u * vertex + 2u]);
}

vec2 texcoordOf(uint first, uint vertex)
{
    Floats f = Floats(draw.positions);
    return vec2(f.at[first + 2u * vertex], f.at[first + 2u * vertex + 1u]);
}

// Edges of the fragment's triangle, used instead of screen-space differences.
Differences triangleEdges(CotanTextureUse use)
{
    Words words = Words(draw.indices);
    uint corner = 3u * uint(gl_PrimitiveID);
    uint i0 = words.at[corner];
    uint i1 = words.at[corner + 1u];
    uint i2 = words.at[corner + 2u];
    Differences d;
    vec3 p0 = positionOf(i0);
    d.dpdx = directionToWorld(positionOf(i1) - p0);
    d.dpdy = directionToWorld(positionOf(i2) - p0);
    d.duvdx = vec2(0.0);
    d.duvdy = vec2(0.0);
    if (hasTexcoords(use)) {
        uint first = use.uRow.w > 0.5 ? draw.texcoords.y : draw.texcoords.x;
        vec2 uv0 = texcoordOf(first, i0);
        vec2 edge1 = texcoordOf(first, i1) - uv0;
        vec2 edge2 = texcoordOf(first, i2) - uv0;
        d.duvdx = vec2(dot(use.uRow.xy, edge1), dot(use.vRow.xy, edge1));
        d.duvdy = vec2(dot(use.uRow.xy, edge2), dot(use.vRow.xy, edge2));
    }
    return d;
}
#endif

// The numbers of the frames.
#define COTAN_FRAME_ROW(number, enumerator, word, source, total, dependsOnView, normal, fused, after, name, summary) \
    const int COTAN_NUMBER_##word = number;
#include "cotan/frames.inc"

cotan_frame noFrame(vec3 n) { return cotan_frame(vec3(0.0), vec3(0.0), n); }

// The frame COTAN_FRAME. The switch has a case for each row of the table of frames, chosen by the row's source.
// n: safe unit normal. inNormal and the other attributes are as interpolated; a mesh without uv has none. use: the map
// that d belongs to. base: whether `use` has the uv of the normal map, for which vertex tangents and cotangents are
// made.
cotan_frame frameOf(vec3 n, Differences d, CotanTextureUse use, bool base)
{
#ifdef COTAN_EXACT
#define COTAN_FROM_triangle(word)        \
    {                                    \
        Differences e = triangleEdges(use); \
        return cotan_frame_##word(n, e.dpdx, e.dpdy, e.duvdx, e.duvdy); \
    }
#else
#define COTAN_FROM_triangle(word) break;
#endif
    bool hasTangents = (draw.flags & COTAN_DRAW_HAS_TANGENTS) != 0u;
    bool hasCotangents = (draw.flags & COTAN_DRAW_HAS_COTANGENTS) != 0u;
    // A glTF tangent's w makes cross(n, t) * w point along a map's green, against increasing v, which runs down the
    // image. Our b points along increasing v: hence -w.
    float alongV = -inTangent.w;
#define COTAN_FROM_differences(word) return cotan_frame_##word(n, d.dpdx, d.dpdy, d.duvdx, d.duvdy);
#define COTAN_FROM_cotangents(word) \
    if (!base) return cotan_frame_cotangent(n, d.dpdx, d.dpdy, d.duvdx, d.duvdy); \
    if (hasCotangents) return cotan_frame_##word(n, inCotangentU, inCotangentV); break;
#define COTAN_FROM_tangents(word) \
    if (!base) return cotan_frame_orthonormal(n, d.dpdx, d.dpdy, d.duvdx, d.duvdy); \
    if (hasTangents) return cotan_frame_##word(inNormal, inTangent.xyz, alongV); break;
    if (COTAN_FRAME == int(COTAN_FRAME_OF_MESH)) { // only these, because CPU drivers execute every case
        switch (int(draw.flags >> COTAN_DRAW_FRAME_BIT)) {
        case COTAN_NUMBER_cotangent: COTAN_FROM_differences(cotangent)
        case COTAN_NUMBER_orthonormal: COTAN_FROM_differences(orthonormal)
        case COTAN_NUMBER_smooth: COTAN_FROM_cotangents(smooth)
        case COTAN_NUMBER_mikktspace: COTAN_FROM_tangents(mikktspace)
        }
        return noFrame(n);
    }
#define COTAN_FRAME_ROW(number, enumerator, word, source, total, dependsOnView, normal, fused, after, name, summary) \
    case number: COTAN_FROM_##source(word)
    switch (COTAN_FRAME) {
#include "cotan/frames.inc"
    }
    return noFrame(n);
}
