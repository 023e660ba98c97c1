// The functions above are printed by cotan shader. raylib sets all uniforms; light is of your own.
in vec3 fragPosition;
in vec2 fragTexCoord;
in vec3 fragNormal;
uniform sampler2D texture0; // MATERIAL_MAP_ALBEDO
uniform sampler2D texture2; // MATERIAL_MAP_NORMAL
uniform vec4 colDiffuse;
out vec4 finalColor;

const vec3 light = vec3(-0.5, 0.6, 0.6);

void main()
{
    vec3 n = cotan_perturb_normal(fragNormal, fragPosition, fragTexCoord, texture(texture2, fragTexCoord).xyz);
    vec4 color = texture(texture0, fragTexCoord) * colDiffuse;
    finalColor = vec4(color.rgb * (0.1 + 0.8 * max(dot(n, normalize(light)), 0.0)), color.a);
}
