// Inputs of the stages of `cotan cost`: transforms, and the mesh in buffers.

layout(std140, set = 0, binding = 0) uniform Draw {
    mat4 projection;   // camera-relative to clip
    vec4 model[3];     // rows: object to camera-relative
    vec4 covectors[3]; // rows: the inverse transpose of model's 3x3
};
layout(std430, set = 0, binding = 2) readonly buffer Positions { float positions[]; };
layout(std430, set = 0, binding = 3) readonly buffer Texcoords { float texcoords[]; };
layout(std430, set = 0, binding = 4) readonly buffer Indices { uint indices[]; };
layout(std430, set = 0, binding = 5) readonly buffer Normals { float normals[]; };
layout(std430, set = 0, binding = 6) readonly buffer Extra { float extra[]; }; // per-row data

vec3 positionOf(uint v) { return vec3(positions[3u * v], positions[3u * v + 1u], positions[3u * v + 2u]); }
vec3 normalOf(uint v) { return vec3(normals[3u * v], normals[3u * v + 1u], normals[3u * v + 2u]); }
vec2 texcoordOf(uint v) { return vec2(texcoords[2u * v], texcoords[2u * v + 1u]); }
vec3 covectorOf(vec3 c) { return vec3(dot(covectors[0].xyz, c), dot(covectors[1].xyz, c), dot(covectors[2].xyz, c)); }
vec3 directionOf(vec3 d) { return vec3(dot(model[0].xyz, d), dot(model[1].xyz, d), dot(model[2].xyz, d)); }
vec3 extraOf(uint v) { return vec3(extra[3u * v], extra[3u * v + 1u], extra[3u * v + 2u]); }
vec4 tangentOf(uint v) { return vec4(extra[4u * v], extra[4u * v + 1u], extra[4u * v + 2u], extra[4u * v + 3u]); }
