// The functions above are printed by cotan shader. The rest sets what CotanMaterial.qml names;
// Qt Quick 3D does the lighting.
void MAIN()
{
    // Qt flips the normal on back faces; the frame needs the surface's own.
    float side = gl_FrontFacing ? 1.0 : -1.0;
    vec3 position = VAR_WORLD_POSITION - CAMERA_POSITION;
    NORMAL = side * cotan_perturb_normal(side * NORMAL, position, UV0, texture(normalTexture, UV0).xyz);
    vec4 color = baseColor;
    if (hasBaseColorMap)
        color *= texture(baseColorTexture, UV0);
    BASE_COLOR = vec4(pow(color.rgb, vec3(2.2)), color.a);
    METALNESS = metalness;
    ROUGHNESS = roughness;
}
