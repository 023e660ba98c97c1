#version 460
#extension GL_GOOGLE_include_directive : require
// The environment behind the scene, a little out of focus.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "cotan/frame.h"
#include "cotan/light.h"
#include "bindings.glsl"
#include "constants.glsl"

layout(location = 0) in vec3 inRay;
layout(location = 0) out vec4 outColor;

void main() { outColor = vec4(finished(cotan_environment(normalize(inRay), 0.35)), 1.0); }
