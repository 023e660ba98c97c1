#version 460
#extension GL_GOOGLE_include_directive : require
// Holes of masked materials in the shadow map. Opaque ones need no fragment stage.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "bindings.glsl"

layout(location = 0) in vec4 inTexcoords;
layout(location = 1) in float inAlpha;

void main()
{
    float alpha = material.baseColor.a * inAlpha;
    if (material.baseColorMap.vRow.w > 0.5)
        alpha *= texture(baseColorMap, finiteUv(transformed(material.baseColorMap, inTexcoords))).a;
    if (alpha < material.emissive.w)
        discard;
}
