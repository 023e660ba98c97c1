#version 460
#extension GL_GOOGLE_include_directive : require
// The background, with the scene's shadow on the ground.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/frame.h"
#include "cotan/light.h"
#include "cotan/quantise.h"
#include "cotan/tone.h"
#include "cotan/environment.h"
#include "cotan/backdrop.h"
#include "bindings.glsl"
#include "constants.glsl"
#include "environment.glsl"
#include "levels.glsl"

#define BACKDROP_GRADIENT 0
#define BACKDROP_MAP 1
#define BACKDROP_PAPER 2
#define BACKDROP_NONE 3 // transparent

layout(location = 0) in vec3 inRay;
layout(location = 1) in vec3 inOrigin; // camera-relative origin of the ray
layout(location = 0) out vec4 outColor;

// The fraction of light that reaches the ground where the ray meets it; 1 outside the ground map.
float groundVisibility(vec3 ray)
{
    vec2 groundPoint = cotan_ground_point(inOrigin, ray, view.tone.z);
    vec2 uv = groundPoint * view.ground.xz + view.ground.yw;
    float visibility = textureLod(groundMap, clamp(uv, vec2(0.0), vec2(1.0)), 0.0).x;
    return uv == clamp(uv, vec2(0.0), vec2(1.0)) ? visibility : 1.0;
}

void main()
{
    vec3 ray = normalize(inRay);
    float visibility = GROUND ? groundVisibility(ray) : 1.0;
    if (BACKDROP == BACKDROP_NONE) {
        outColor = quantised(vec4(0.0, 0.0, 0.0, 1.0 - visibility));
        return;
    }
    vec3 radiance = BACKDROP == BACKDROP_MAP ? radianceAlong(ray, view.tone.y)
        : BACKDROP == BACKDROP_PAPER         ? cotan_paper(ray) / view.tone.x
                                             : cotan_environment(ray, 0.35);
    outColor = quantised(vec4(outputColor(radiance * visibility), 1.0));
}
