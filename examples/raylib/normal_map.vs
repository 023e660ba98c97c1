#version 330
// The vertex shader of normal_map.fs. raylib sets all uniforms.
in vec3 vertexPosition;
in vec2 vertexTexCoord;
in vec3 vertexNormal;
uniform mat4 mvp;
uniform mat4 matModel;
uniform mat4 matNormal;
uniform mat4 matView;
out vec3 fragPosition; // along the axes of the world, from the eye
out vec2 fragTexCoord;
out vec3 fragNormal;

void main()
{
    fragPosition = transpose(mat3(matView)) * (matView * matModel * vec4(vertexPosition, 1.0)).xyz;
    fragTexCoord = vertexTexCoord;
    fragNormal = mat3(matNormal) * vertexNormal;
    gl_Position = mvp * vec4(vertexPosition, 1.0);
}
