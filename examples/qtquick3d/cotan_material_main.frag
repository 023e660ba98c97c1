// The functions above are printed by cotan shader. The rest sets what CotanMaterial.qml names; Qt Quick 3D does the lighting.
void MAIN()
{
    NORMAL = cotan_perturb_normal(NORMAL, VAR_WORLD_POSITION - CAMERA_POSITION, UV0, texture(normalTexture, UV0).xyz);
    vec4 color = baseColor;
    if (hasBaseColorMap)
        color *= texture(baseColorTexture, UV0);
    BASE_COLOR = vec4(pow(color.rgb, vec3(2.2)), color.a);
    METALNESS = metalness;
    ROUGHNESS = roughness;
}
