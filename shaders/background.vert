#version 460
#extension GL_GOOGLE_include_directive : require
// One triangle that covers the image, at the far end of the reversed depth range.
#define COTAN_LANG_GLSL
#include "cotan/lang.h"
#include "bindings.glsl"

#ifndef COTAN_NO_RAY
layout(location = 0) out vec3 outRay;
layout(location = 1) out vec3 outOrigin;
#endif

void main()
{
    vec2 corner = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
#ifndef COTAN_NO_RAY
    outRay = view.forward.xyz + view.right.xyz * corner.x + view.up.xyz * corner.y;
    // Perspective rays start at the eye, orthographic rays side by side.
    vec2 across = corner - vec2(view.clipX.w, view.clipY.w);
    outOrigin = view.forward.w > 0.5 ? vec3(0.0)
                                     : view.clipX.xyz * (across.x / dot(view.clipX.xyz, view.clipX.xyz))
            + view.clipY.xyz * (across.y / dot(view.clipY.xyz, view.clipY.xyz));
#endif
    gl_Position = vec4(corner, 0.0, 1.0);
}
