#version 460
#extension GL_GOOGLE_include_directive : require
// Composes one sample of a pixel's translucent layers over the opaque surfaces, front to back. Each step searches the
// whole list for the next layer, so any number of layers needs no extra memory. Compiled a second time with
// COTAN_MULTISAMPLED; with one sample per pixel, the depth test has already rejected layers behind opaque surfaces.
#include "gpu_structs.glsl"
#include "layers.glsl"
#include "sample_positions.glsl"

layout(push_constant) uniform SampleBlock { uint sampleIndex; };
layout(location = 0, index = 0) out vec4 outColor;   // premultiplied by alpha
layout(location = 0, index = 1) out vec4 outTransmittance; // factors of the colours behind

#ifdef COTAN_MULTISAMPLED
layout(set = 0, binding = 2) uniform sampler2DMS opaqueDepth;
#endif

// The sort key of a layer. Of layers at equal depth the one drawn later is in front.
struct LayerKey {
    float depth; // reversed depth: 1 near, 0 far
    uint instance;
    uint triangle;
    uint name;
};

bool nearer(LayerKey a, LayerKey b)
{
    if (a.depth != b.depth)
        return a.depth > b.depth;
    if (a.instance != b.instance)
        return a.instance > b.instance;
    if (a.triangle != b.triangle)
        return a.triangle > b.triangle;
    return a.name > b.name;
}

vec2 sampleOffset()
{
#ifdef COTAN_MULTISAMPLED
    return kSampleOffsets[sampleIndex];
#else
    return vec2(0.0);
#endif
}

void main()
{
    uint first = outsideBand() ? 0u : newest[pixelInBand()];
    vec2 offset = sampleOffset();
    float nearestOpaque = -1.0; // depth of the opaque surface, which hides layers that are not nearer
#ifdef COTAN_MULTISAMPLED
    nearestOpaque = texelFetch(opaqueDepth, ivec2(gl_FragCoord.xy), int(sampleIndex)).x;
#endif
    LayerKey last = LayerKey(1e30, 0u, 0u, 0u);
    vec3 color = vec3(0.0);
    vec3 transmittance = vec3(1.0);
    while (max(max(transmittance.r, transmittance.g), transmittance.b) > 1e-6) {
        LayerKey next = LayerKey(nearestOpaque, 0u, 0u, 0u);
        for (uint i = first; i != 0u; i = layers[i - 1u].previous) {
            CotanLayer layer = layers[i - 1u];
            float depth = layer.light.w + layer.transmittance.w * offset.x + layer.depthY * offset.y;
            LayerKey here = LayerKey(depth, layer.orderAndCoverage >> 4, layer.triangle, i);
            bool covered = (layer.orderAndCoverage >> sampleIndex & 1u) != 0u;
            if (covered && depth > nearestOpaque && nearer(last, here) && (next.name == 0u || nearer(here, next)))
                next = here;
        }
        if (next.name == 0u)
            break;
        color += layers[next.name - 1u].light.rgb * transmittance;
        transmittance *= layers[next.name - 1u].transmittance.rgb;
        last = next;
    }
    // Alpha has a single channel: the transmittance is averaged over the colours.
    float meanTransmittance = (transmittance.r + transmittance.g + transmittance.b) / 3.0;
    outColor = vec4(color, 1.0 - meanTransmittance);
    outTransmittance = vec4(transmittance, meanTransmittance);
#ifdef COTAN_MULTISAMPLED
    gl_SampleMask[0] = 1 << int(sampleIndex);
#endif
    if (first == 0u)
        discard;
}
