#version 460
// The mean of the samples of a pixel, which are linear here whatever the target's format. What a device does itself at
// the end of a pass is the same; Mesa's CPU driver compiles 40 ms for it in every process.
layout(set = 0, binding = 5) uniform sampler2DMS samples;
layout(location = 0) out vec4 outColor;

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec4 sum = texelFetch(samples, at, 0) + texelFetch(samples, at, 1);
    sum += texelFetch(samples, at, 2);
    sum += texelFetch(samples, at, 3);
    outColor = sum * 0.25;
}
