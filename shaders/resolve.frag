#version 460
#extension GL_GOOGLE_include_directive : require
// Averages the samples of a pixel in linear light and, for 8-bit images, quantises the mean. Compiled a second time
// with COTAN_MULTISAMPLED. A built-in resolve at the end of a pass gives the same mean, but Mesa's CPU driver compiles
// it anew in every process, which takes 40 ms.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/frame.h"
#include "cotan/light.h"
#include "cotan/quantise.h"
#include "gpu_structs.glsl"

layout(set = 0, binding = 0, std140) uniform ViewBlock { CotanView view; };
layout(constant_id = 16) const bool LEVELS = false; // as in constants.glsl
#include "levels.glsl"

#ifdef COTAN_MULTISAMPLED
layout(set = 0, binding = 5) uniform sampler2DMS samples;
#else
layout(set = 0, binding = 5) uniform sampler2D samples;
#endif
layout(location = 0) out vec4 outColor;

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
#ifdef COTAN_MULTISAMPLED
    vec4 sum = texelFetch(samples, at, 0) + texelFetch(samples, at, 1);
    sum += texelFetch(samples, at, 2);
    sum += texelFetch(samples, at, 3);
    outColor = quantised(sum * 0.25);
#else
    outColor = quantised(texelFetch(samples, at, 0));
#endif
}
