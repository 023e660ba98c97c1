#version 330 core
// The vertex program of cotan_normal_map.material. OGRE sets all uniforms.
in vec4 vertex;
in vec3 normal;
in vec2 uv0;
uniform mat4 worldViewProj;
uniform mat4 world;
uniform mat4 worldOfNormals;
uniform vec3 eye;
out vec3 surfacePosition; // along the axes of the world, from the eye
out vec3 surfaceNormal;
out vec2 uv;

void main()
{
    surfacePosition = (world * vertex).xyz - eye;
    surfaceNormal = mat3(worldOfNormals) * normal;
    uv = uv0;
    gl_Position = worldViewProj * vertex;
}
