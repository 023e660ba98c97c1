#version 460
#extension GL_GOOGLE_include_directive : require
// Cuts the holes of masked materials into the shadow map, and thins out translucent ones. Opaque materials need no
// fragment stage.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/frame.h"
#include "cotan/light.h"
#include "cotan/quantise.h"
#include "cotan/shadow.h"
#include "bindings.glsl"

layout(constant_id = 3) const int ALPHA_MODE = 0; // as in constants.glsl

layout(location = 0) in vec4 inTexcoords;
layout(location = 1) in float inAlpha;

void main()
{
    float alpha = material.baseColor.a * inAlpha;
    if (material.baseColorMap.vRow.w > 0.5)
        alpha *= texture(baseColorMap, finiteUv(transformed(material.baseColorMap, inTexcoords))).a;
    if (ALPHA_MODE == 2) {
        uint layer = (gl_FrontFacing ? 0u : 1u) + 2u * (draw.order & 1u);
        if (!(alpha > cotan_shadow_threshold(uint(gl_FragCoord.x), uint(gl_FragCoord.y), layer)))
            discard;
    } else if (alpha < material.emissive.w) {
        discard;
    }
}
