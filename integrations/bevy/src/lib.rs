//! Normal maps without stored tangents, for the `StandardMaterial` of Bevy 0.19. The shader computes the frame of each
//! pixel from its screen derivatives. Add [`CotanPlugin`], and use [`CotanMaterial`] where a material has a normal map;
//! [`convert_materials`] does that for loaded scenes. Shaders of your own say `#import cotan::cotan_perturb_normal`.

use bevy::asset::{AssetId, embedded_asset};
use bevy::pbr::{ExtendedMaterial, MaterialExtension, MaterialPlugin};
use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy::render::render_resource::AsBindGroup;
use bevy::shader::{ShaderRef, load_shader_library};

const MATERIAL: &str = "embedded://bevy_cotan/material.wgsl";

/// A `StandardMaterial` whose normal maps need no tangents of the mesh.
pub type CotanMaterial = ExtendedMaterial<StandardMaterial, CotanNormalMap>;

/// The extension: it has no settings. Those of the normal map are the `StandardMaterial`'s.
#[derive(Asset, AsBindGroup, Reflect, Clone, Debug, Default)]
pub struct CotanNormalMap {}

impl MaterialExtension for CotanNormalMap {
    fn fragment_shader() -> ShaderRef {
        MATERIAL.into()
    }

    fn deferred_fragment_shader() -> ShaderRef {
        MATERIAL.into()
    }
}

/// Registers the shaders and [`CotanMaterial`].
pub struct CotanPlugin;

impl Plugin for CotanPlugin {
    fn build(&self, app: &mut App) {
        load_shader_library!(app, "cotan.wgsl");
        load_shader_library!(app, "normal_map.wgsl");
        embedded_asset!(app, "material.wgsl");
        app.add_plugins(MaterialPlugin::<CotanMaterial>::default());
    }
}

/// A system that replaces each new `StandardMaterial` that has a normal map by a [`CotanMaterial`] with the same
/// settings. Entities that shared a material share the new one. Later changes to the old one are not followed.
pub fn convert_materials(
    mut commands: Commands,
    entities: Query<
        (Entity, &MeshMaterial3d<StandardMaterial>),
        Added<MeshMaterial3d<StandardMaterial>>,
    >,
    standard: Res<Assets<StandardMaterial>>,
    mut converted: ResMut<Assets<CotanMaterial>>,
    mut made: Local<HashMap<AssetId<StandardMaterial>, Handle<CotanMaterial>>>,
) {
    for (entity, material) in &entities {
        let Some(base) = standard.get(&material.0) else {
            continue;
        };
        if base.normal_map_texture.is_none() {
            continue;
        }
        let handle = made.entry(material.0.id()).or_insert_with(|| {
            converted.add(CotanMaterial {
                base: base.clone(),
                extension: CotanNormalMap {},
            })
        });
        commands
            .entity(entity)
            .remove::<MeshMaterial3d<StandardMaterial>>()
            .insert(MeshMaterial3d(handle.clone()));
    }
}
