#version 460
#extension GL_GOOGLE_include_directive : require
// The layers of a pixel over what is opaque, for one sample, from the nearest on. Each step looks for the
// next layer in the whole list: any number of them needs no memory. Compiled a second time with
// COTAN_MULTISAMPLED; with one sample the depth test has already left out what opaque surfaces hide.
#include "gpu_structs.glsl"
#include "layers.glsl"
#include "sample_places.glsl"

layout(push_constant) uniform SampleBlock { uint sampleIndex; };
layout(location = 0, index = 0) out vec4 outColor;   // multiplied by alpha
layout(location = 0, index = 1) out vec4 outThrough; // factors of what is there

#ifdef COTAN_MULTISAMPLED
layout(set = 0, binding = 2) uniform sampler2DMS opaqueDepth;
#endif

// Of two places in the order, the one nearer to the eye. Equally far layers: the later drawn is in front.
struct Place {
    float depth; // 1 near, 0 far
    uint instance;
    uint triangle;
    uint name;
};

bool nearer(Place a, Place b)
{
    if (a.depth != b.depth)
        return a.depth > b.depth;
    if (a.instance != b.instance)
        return a.instance > b.instance;
    if (a.triangle != b.triangle)
        return a.triangle > b.triangle;
    return a.name > b.name;
}

vec2 toSample()
{
#ifdef COTAN_MULTISAMPLED
    return kSamplePlaces[sampleIndex];
#else
    return vec2(0.0);
#endif
}

void main()
{
    uint first = outsideBand() ? 0u : newest[pixelInBand()];
    vec2 offset = toSample();
    float hidden = -1.0; // what is not nearer is behind an opaque surface
#ifdef COTAN_MULTISAMPLED
    hidden = texelFetch(opaqueDepth, ivec2(gl_FragCoord.xy), int(sampleIndex)).x;
#endif
    Place last = Place(1e30, 0u, 0u, 0u);
    vec3 color = vec3(0.0);
    vec3 through = vec3(1.0);
    while (max(max(through.r, through.g), through.b) > 1e-6) {
        Place next = Place(hidden, 0u, 0u, 0u);
        for (uint i = first; i != 0u; i = layers[i - 1u].before) {
            CotanLayer layer = layers[i - 1u];
            float depth = layer.light.w + layer.through.w * offset.x + layer.depthY * offset.y;
            Place here = Place(depth, layer.place >> 4, layer.triangle, i);
            bool covered = (layer.place >> sampleIndex & 1u) != 0u;
            if (covered && depth > hidden && nearer(last, here) && (next.name == 0u || nearer(here, next)))
                next = here;
        }
        if (next.name == 0u)
            break;
        color += layers[next.name - 1u].light.rgb * through;
        through *= layers[next.name - 1u].through.rgb;
        last = next;
    }
    // Alpha has no colour: it counts what passes of white light.
    float passing = (through.r + through.g + through.b) / 3.0;
    outColor = vec4(color, 1.0 - passing);
    outThrough = vec4(through, passing);
#ifdef COTAN_MULTISAMPLED
    gl_SampleMask[0] = 1 << int(sampleIndex);
#endif
    if (first == 0u)
        discard;
}
