#version 450
// The vertex stage of `cotan cost`: position, normal and uv; with COST_TANGENT also a stored tangent,
// with COST_COTANGENTS two derived cotangents. Each is fetched, taken to the space of the frame
// and handed on to be interpolated.
layout(location = 0) in vec3 inPosition;
layout(location = 1) in vec3 inNormal;
layout(location = 2) in vec2 inUv;
layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec2 uv;
#ifdef COST_TANGENT
layout(location = 3) in vec4 inTangent;
layout(location = 3) out vec4 tangent;
#endif
#ifdef COST_COTANGENTS
layout(location = 3) in vec3 inCotangentU;
layout(location = 4) in vec3 inCotangentV;
layout(location = 3) out vec3 cotangentU;
layout(location = 4) out vec3 cotangentV;
#endif

layout(std140, set = 0, binding = 0) uniform Draw {
    mat4 projection;   // camera-relative to clip
    vec4 model[3];     // rows: object to camera-relative
    vec4 covectors[3]; // rows: the inverse transpose of model's 3x3
};

void main()
{
    vec4 p = vec4(inPosition, 1.0);
    position = vec3(dot(model[0], p), dot(model[1], p), dot(model[2], p));
    normal = vec3(dot(covectors[0].xyz, inNormal), dot(covectors[1].xyz, inNormal),
        dot(covectors[2].xyz, inNormal));
    uv = inUv;
#ifdef COST_TANGENT
    vec3 t = inTangent.xyz;
    tangent =
        vec4(dot(model[0].xyz, t), dot(model[1].xyz, t), dot(model[2].xyz, t), inTangent.w);
#endif
#ifdef COST_COTANGENTS
    cotangentU = vec3(dot(covectors[0].xyz, inCotangentU), dot(covectors[1].xyz, inCotangentU),
        dot(covectors[2].xyz, inCotangentU));
    cotangentV = vec3(dot(covectors[0].xyz, inCotangentV), dot(covectors[1].xyz, inCotangentV),
        dot(covectors[2].xyz, inCotangentV));
#endif
    gl_Position = projection * vec4(position, 1.0);
}
