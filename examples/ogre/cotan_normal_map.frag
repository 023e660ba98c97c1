#version 330 core
// The fragment program of cotan_normal_map.material: one light, without specular.
// cotan.glsl is what cotan shader prints.
#include "cotan.glsl"
in vec3 surfacePosition;
in vec3 surfaceNormal;
in vec2 uv;
uniform sampler2D normalMap;
uniform sampler2D colorMap;
uniform vec4 light; // w: 0 for a directional light
uniform vec4 lightColor;
uniform vec4 ambient;
uniform vec3 eye;
out vec4 color;

void main()
{
    vec3 n = cotan_perturb_normal(surfaceNormal, surfacePosition, uv, texture(normalMap, uv).xyz);
    vec3 direction = normalize(light.xyz - light.w * (surfacePosition + eye));
    color = texture(colorMap, uv) * vec4(ambient.rgb + lightColor.rgb * max(dot(n, direction), 0.0), 1.0);
}
