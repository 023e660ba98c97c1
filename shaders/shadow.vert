#version 460
#extension GL_GOOGLE_include_directive : require
// Transforms vertices into the shadow map.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "bindings.glsl"

layout(location = 0) in vec3 inPosition;
layout(location = 2) in vec2 inTexcoord0;
layout(location = 3) in vec2 inTexcoord1;
layout(location = 4) in vec4 inColor;
layout(location = 8) in vec4 inTexcoordOrigin;
layout(location = 0) out vec4 outTexcoords;
layout(location = 1) out float outAlpha;

void main()
{
    outTexcoords = vec4(inTexcoord0, inTexcoord1) + inTexcoordOrigin;
    outAlpha = inColor.a;
    vec3 s = toShadowMap(cameraRelative(inPosition));
    bool usable = abs(s.x) + abs(s.y) + abs(s.z) <= COTAN_HUGE;
    gl_Position = usable ? vec4(s.xy * 2.0 - 1.0, s.z, 1.0) : vec4(0.0, 0.0, 2.0, 1.0);
}
