// Stands for the modules of Bevy 0.19 that the crate imports, where its sources are not there. The names and types are
// Bevy's; the bodies do nothing.

#define_import_path bevy_pbr::mesh_types
const MESH_FLAGS_SIGN_DETERMINANT_MODEL_3X3_BIT: u32 = 0x80000000u;

#define_import_path bevy_pbr::mesh_view_bindings
struct View {
    world_position: vec3<f32>,
    mip_bias: f32,
}
@group(0) @binding(0) var<uniform> view: View;

#define_import_path bevy_pbr::pbr_types
const STANDARD_MATERIAL_FLAGS_DOUBLE_SIDED_BIT: u32 = 16u;
const STANDARD_MATERIAL_FLAGS_UNLIT_BIT: u32 = 32u;
const STANDARD_MATERIAL_FLAGS_TWO_COMPONENT_NORMAL_MAP: u32 = 64u;
const STANDARD_MATERIAL_FLAGS_FLIP_NORMAL_MAP_Y: u32 = 128u;
struct StandardMaterial {
    base_color: vec4<f32>,
    uv_transform: mat3x3<f32>,
    flags: u32,
}
struct PbrInput {
    material: StandardMaterial,
    world_position: vec4<f32>,
    world_normal: vec3<f32>,
    N: vec3<f32>,
    clearcoat_N: vec3<f32>,
    flags: u32,
}

#define_import_path bevy_pbr::pbr_bindings
#import bevy_pbr::pbr_types::StandardMaterial
@group(#{MATERIAL_BIND_GROUP}) @binding(0) var<uniform> material: StandardMaterial;
@group(#{MATERIAL_BIND_GROUP}) @binding(9) var normal_map_texture: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(10) var normal_map_sampler: sampler;
#ifdef PBR_MULTI_LAYER_MATERIAL_TEXTURES_SUPPORTED
@group(#{MATERIAL_BIND_GROUP}) @binding(25) var clearcoat_normal_texture: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(26) var clearcoat_normal_sampler: sampler;
#endif

#define_import_path bevy_pbr::forward_io
struct VertexOutput {
    @builtin(position) position: vec4<f32>,
    @location(0) world_position: vec4<f32>,
    @location(1) world_normal: vec3<f32>,
#ifdef VERTEX_UVS_A
    @location(2) uv: vec2<f32>,
#endif
#ifdef VERTEX_UVS_B
    @location(3) uv_b: vec2<f32>,
#endif
#ifdef VERTEX_TANGENTS
    @location(4) world_tangent: vec4<f32>,
#endif
#ifdef VISIBILITY_RANGE_DITHER
    @location(7) @interpolate(flat) visibility_range_dither: i32,
#endif
}
struct FragmentOutput {
    @location(0) color: vec4<f32>,
}

#define_import_path bevy_pbr::prepass_io
struct VertexOutput {
    @builtin(position) position: vec4<f32>,
#ifdef VERTEX_UVS_A
    @location(0) uv: vec2<f32>,
#endif
#ifdef VERTEX_UVS_B
    @location(1) uv_b: vec2<f32>,
#endif
    @location(2) world_normal: vec3<f32>,
    @location(4) world_position: vec4<f32>,
#ifdef VISIBILITY_RANGE_DITHER
    @location(9) @interpolate(flat) visibility_range_dither: i32,
#endif
}
struct FragmentOutput {
    @location(2) deferred: vec4<u32>,
    @location(3) deferred_lighting_pass_id: u32,
}

#define_import_path bevy_pbr::pbr_fragment
#import bevy_pbr::pbr_types::PbrInput
#ifdef PREPASS_PIPELINE
#import bevy_pbr::prepass_io::VertexOutput
#else
#import bevy_pbr::forward_io::VertexOutput
#endif
fn pbr_input_from_standard_material(in: VertexOutput, is_front: bool) -> PbrInput {
    var pbr_input: PbrInput;
    pbr_input.world_position = in.world_position;
    pbr_input.world_normal = in.world_normal;
    pbr_input.flags = 0x80000000u;
    return pbr_input;
}

#define_import_path bevy_pbr::pbr_functions
#import bevy_pbr::pbr_types::{PbrInput, StandardMaterial}
fn alpha_discard(material: StandardMaterial, output_color: vec4<f32>) -> vec4<f32> {
    return output_color;
}
fn apply_pbr_lighting(in: PbrInput) -> vec4<f32> {
    return in.material.base_color;
}
fn main_pass_post_lighting_processing(pbr_input: PbrInput, input_color: vec4<f32>) -> vec4<f32> {
    return input_color;
}
#ifdef VISIBILITY_RANGE_DITHER
fn visibility_range_dither(frag_coord: vec4<f32>, dither: i32) {
}
#endif

#define_import_path bevy_pbr::decal::clustered
#import bevy_pbr::pbr_types::PbrInput
fn apply_decals(pbr_input: ptr<function, PbrInput>) {
}

#define_import_path bevy_pbr::pbr_deferred_functions
#import bevy_pbr::pbr_types::PbrInput
#import bevy_pbr::prepass_io::{FragmentOutput, VertexOutput}
fn deferred_output(in: VertexOutput, pbr_input: PbrInput) -> FragmentOutput {
    var out: FragmentOutput;
    out.deferred = bitcast<vec4<u32>>(vec4<f32>(pbr_input.N, 1.0));
    return out;
}
