#version 460
#extension GL_GOOGLE_include_directive : require
// The surroundings behind the scene, or a gradient.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/frame.h"
#include "cotan/light.h"
#include "cotan/tone.h"
#include "cotan/environment.h"
#include "bindings.glsl"
#include "constants.glsl"
#include "environment.glsl"

layout(location = 0) in vec3 inRay;
layout(location = 0) out vec4 outColor;

void main()
{
    vec3 ray = normalize(inRay);
    vec3 radiance = ENVIRONMENT_MAP ? radianceAlong(ray, view.tone.y) : cotan_environment(ray, 0.35);
    outColor = vec4(finished(radiance), 1.0);
}
