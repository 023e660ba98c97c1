#define_import_path bevy_cotan

// The normal maps of StandardMaterial in a frame that is computed in each pixel. Call these in uniform control flow:
// they take screen derivatives.

#import bevy_pbr::{
    mesh_types::MESH_FLAGS_SIGN_DETERMINANT_MODEL_3X3_BIT,
    mesh_view_bindings::view,
    pbr_bindings,
    pbr_types::{
        STANDARD_MATERIAL_FLAGS_DOUBLE_SIDED_BIT,
        STANDARD_MATERIAL_FLAGS_FLIP_NORMAL_MAP_Y,
        STANDARD_MATERIAL_FLAGS_TWO_COMPONENT_NORMAL_MAP,
    },
}
#import cotan::cotan_perturb_normal

// The factor of normals for the side that is seen: -1 on the back of a double-sided material, where a bump of the front
// is a dent. mesh_flags: PbrInput.flags; they say that a transform mirrors, which exchanges the sides.
fn side_of(flags: u32, mesh_flags: u32, is_front: bool) -> f32 {
    let mirrored = (mesh_flags & MESH_FLAGS_SIGN_DETERMINANT_MODEL_3X3_BIT) == 0u;
    let double_sided = (flags & STANDARD_MATERIAL_FLAGS_DOUBLE_SIDED_BIT) != 0u;
    return select(1.0, -1.0, double_sided && is_front == mirrored);
}

// The texel as signed numbers, in which 128 of 255 is zero. stored: as sampled. flags: of the StandardMaterial.
fn signed_texel(stored: vec3<f32>, flags: u32) -> vec3<f32> {
    var m = max(stored * (255.0 / 127.0) - 128.0 / 127.0, vec3<f32>(-1.0));
    let two_components = (flags & STANDARD_MATERIAL_FLAGS_TWO_COMPONENT_NORMAL_MAP) != 0u;
    m.z = select(m.z, sqrt(max(1.0 - dot(m.xy, m.xy), 0.0)), two_components);
    m.y = select(m.y, -m.y, (flags & STANDARD_MATERIAL_FLAGS_FLIP_NORMAL_MAP_Y) != 0u);
    return m;
}

// The perturbed normal, unit, in world space.
// world_normal, world_position: of VertexOutput. uv: those that `stored` was sampled at. stored: as sampled.
fn perturbed_normal(world_normal: vec3<f32>, world_position: vec3<f32>, uv: vec2<f32>, stored: vec3<f32>, flags: u32) -> vec3<f32> {
    return cotan_perturb_normal(world_normal, world_position - view.world_position, uv, signed_texel(stored, flags));
}

#ifdef STANDARD_MATERIAL_NORMAL_MAP
// The normal of the material's normal map. uv: of the mesh, without the material's transform.
fn base_normal(world_normal: vec3<f32>, world_position: vec3<f32>, uv: vec2<f32>) -> vec3<f32> {
    let at = (pbr_bindings::material.uv_transform * vec3<f32>(uv, 1.0)).xy;
    let stored = textureSampleBias(pbr_bindings::normal_map_texture, pbr_bindings::normal_map_sampler, at, view.mip_bias).xyz;
    return perturbed_normal(world_normal, world_position, at, stored, pbr_bindings::material.flags);
}
#endif

#ifdef STANDARD_MATERIAL_CLEARCOAT_NORMAL_MAP
// The same for the map of the clear coat, in a frame of its own coordinates.
fn clearcoat_normal(world_normal: vec3<f32>, world_position: vec3<f32>, uv: vec2<f32>) -> vec3<f32> {
    let at = (pbr_bindings::material.uv_transform * vec3<f32>(uv, 1.0)).xy;
    let stored = textureSampleBias(pbr_bindings::clearcoat_normal_texture, pbr_bindings::clearcoat_normal_sampler, at, view.mip_bias).xyz;
    return perturbed_normal(world_normal, world_position, at, stored, pbr_bindings::material.flags);
}
#endif
