// The fragment shader of CotanMaterial: StandardMaterial, forward and deferred, with normals that need no tangents.

#import bevy_pbr::{
    decal::clustered::apply_decals,
    pbr_bindings,
    pbr_fragment::pbr_input_from_standard_material,
    pbr_functions::alpha_discard,
}
#import bevy_cotan::side_of

#ifdef PREPASS_PIPELINE
#import bevy_pbr::{
    pbr_deferred_functions::deferred_output,
    prepass_io::{FragmentOutput, VertexOutput},
}
#else
#import bevy_pbr::{
    forward_io::{FragmentOutput, VertexOutput},
    pbr_functions::{apply_pbr_lighting, main_pass_post_lighting_processing},
    pbr_types::STANDARD_MATERIAL_FLAGS_UNLIT_BIT,
}
#endif

#ifdef STANDARD_MATERIAL_NORMAL_MAP
#import bevy_cotan::base_normal
#endif
#ifdef STANDARD_MATERIAL_CLEARCOAT_NORMAL_MAP
#import bevy_cotan::clearcoat_normal
#endif
#ifdef VISIBILITY_RANGE_DITHER
#import bevy_pbr::pbr_functions::visibility_range_dither
#endif

@fragment
fn fragment(in: VertexOutput, @builtin(front_facing) is_front: bool) -> FragmentOutput {
    var pbr_input = pbr_input_from_standard_material(in, is_front);

#ifdef VERTEX_UVS
    let side = side_of(pbr_bindings::material.flags, pbr_input.flags, is_front);
#ifdef STANDARD_MATERIAL_NORMAL_MAP
#ifdef STANDARD_MATERIAL_NORMAL_MAP_UV_B
    pbr_input.N = side * base_normal(in.world_normal, in.world_position.xyz, in.uv_b);
#else
    pbr_input.N = side * base_normal(in.world_normal, in.world_position.xyz, in.uv);
#endif
    // Without a map of its own a clear coat has the mesh's normal.
    pbr_input.clearcoat_N = side * normalize(in.world_normal);
#endif
#ifdef STANDARD_MATERIAL_CLEARCOAT_NORMAL_MAP
#ifdef STANDARD_MATERIAL_CLEARCOAT_NORMAL_UV_B
    pbr_input.clearcoat_N = side * clearcoat_normal(in.world_normal, in.world_position.xyz, in.uv_b);
#else
    pbr_input.clearcoat_N = side * clearcoat_normal(in.world_normal, in.world_position.xyz, in.uv);
#endif
#endif
#endif

    // What discards follows the screen derivatives.
#ifdef VISIBILITY_RANGE_DITHER
    visibility_range_dither(in.position, in.visibility_range_dither);
#endif
    pbr_input.material.base_color = alpha_discard(pbr_input.material, pbr_input.material.base_color);
    apply_decals(&pbr_input);

#ifdef PREPASS_PIPELINE
    return deferred_output(in, pbr_input);
#else
    var out: FragmentOutput;
    if (pbr_bindings::material.flags & STANDARD_MATERIAL_FLAGS_UNLIT_BIT) == 0u {
        out.color = apply_pbr_lighting(pbr_input);
    } else {
        out.color = pbr_input.material.base_color;
    }
    out.color = main_pass_post_lighting_processing(pbr_input, out.color);
    return out;
#endif
}
