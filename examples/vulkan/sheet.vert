#version 450

layout(location = 0) in vec3 vertex_position; // relative to the eye, which looks along -z
layout(location = 1) in vec3 vertex_normal;
layout(location = 2) in vec2 vertex_uv;

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec2 uv;

void main()
{
    const float zoom = 2.2, aspect = 2.0;
    position = vertex_position;
    normal = vertex_normal;
    uv = vertex_uv;
    // Vulkan's y runs down. The frame does not depend on that, since it computes its own sign.
    gl_Position = vec4(position.x * zoom / aspect, -position.y * zoom, -0.5 * position.z, -position.z);
}
