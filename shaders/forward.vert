#version 460
#extension GL_GOOGLE_include_directive : require
// Scene vertices: transforms all inputs of the fragment stage to camera-relative world space. Compiled again with
// COTAN_POSITION_ONLY, for the same positions without these inputs.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/frame.h"
#include "bindings.glsl"

layout(location = 0) in vec3 inPosition;
#ifndef COTAN_POSITION_ONLY
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec2 inTexcoord0;
layout(location = 3) in vec2 inTexcoord1;
layout(location = 4) in vec4 inColor;
layout(location = 5) in vec4 inTangent;
layout(location = 6) in vec3 inCotangentU;
layout(location = 7) in vec3 inCotangentV;
layout(location = 8) in vec4 inTexcoordOrigin; // the same for the whole mesh

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec4 outTexcoords;
layout(location = 3) out vec4 outColor;
layout(location = 4) out vec4 outTangent;
layout(location = 5) out vec3 outCotangentU;
layout(location = 6) out vec3 outCotangentV;
layout(location = 7) flat out vec4 outTexcoordOrigin;
#endif

void main()
{
    vec3 p = cameraRelative(inPosition);
#ifndef COTAN_POSITION_ONLY
    outPosition = p;
    outNormal = cotan_normalize_or(covectorToWorld(inNormal), vec3(0.0));
    outTexcoords = vec4(inTexcoord0, inTexcoord1);
    outTexcoordOrigin = inTexcoordOrigin;
    outColor = inColor;
    vec3 tangent = cotan_normalize_or(directionToWorld(inTangent.xyz), vec3(0.0));
    outTangent = vec4(tangent, inTangent.w * draw.normalX.w);
    outCotangentU = covectorToWorld(inCotangentU);
    outCotangentV = covectorToWorld(inCotangentV);
#endif

    vec4 q = vec4(p, 1.0);
    vec4 clip =
        vec4(dot(view.clipX, q), dot(view.clipY, q), dot(view.clipZ, q), dot(view.clipW, q));
    // Positions beyond the range of float are moved to where they are clipped.
    bool usable = abs(clip.x) + abs(clip.y) + abs(clip.w) <= COTAN_HUGE;
    gl_Position = usable ? clip : vec4(0.0, 0.0, 2.0, 1.0);
}
