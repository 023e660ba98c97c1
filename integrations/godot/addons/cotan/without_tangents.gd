# Converts the materials and meshes of an imported scene, before Godot makes LODs and compresses vertices.
@tool
extends RefCounted

const DEFINES := {
	BaseMaterial3D.TRANSPARENCY_DISABLED: "",
	BaseMaterial3D.TRANSPARENCY_ALPHA: "#define COTAN_ALPHA\n",
	BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR: "#define COTAN_ALPHA\n#define COTAN_ALPHA_SCISSOR\n",
	BaseMaterial3D.TRANSPARENCY_ALPHA_DEPTH_PRE_PASS: "#define COTAN_ALPHA\n",
}
const FILTERS := {
	BaseMaterial3D.TEXTURE_FILTER_NEAREST: "filter_nearest",
	BaseMaterial3D.TEXTURE_FILTER_LINEAR: "filter_linear",
	BaseMaterial3D.TEXTURE_FILTER_NEAREST_WITH_MIPMAPS: "filter_nearest_mipmap",
	BaseMaterial3D.TEXTURE_FILTER_LINEAR_WITH_MIPMAPS: "filter_linear_mipmap",
	BaseMaterial3D.TEXTURE_FILTER_NEAREST_WITH_MIPMAPS_ANISOTROPIC: "filter_nearest_mipmap_anisotropic",
	BaseMaterial3D.TEXTURE_FILTER_LINEAR_WITH_MIPMAPS_ANISOTROPIC: "filter_linear_mipmap_anisotropic",
}
const CULLS := {
	BaseMaterial3D.CULL_BACK: "cull_back",
	BaseMaterial3D.CULL_FRONT: "cull_front",
	BaseMaterial3D.CULL_DISABLED: "cull_disabled",
}
const DEPTHS := {
	BaseMaterial3D.DEPTH_DRAW_OPAQUE_ONLY: "depth_draw_opaque",
	BaseMaterial3D.DEPTH_DRAW_ALWAYS: "depth_draw_always",
	BaseMaterial3D.DEPTH_DRAW_DISABLED: "depth_draw_never",
}
# Properties that the converted material keeps. A material in which another one differs from its default is not converted.
const CARRIED: Array[String] = [
	"albedo_color", "albedo_texture", "vertex_color_use_as_albedo", "vertex_color_is_srgb", "metallic",
	"metallic_specular", "metallic_texture", "metallic_texture_channel", "roughness", "roughness_texture",
	"roughness_texture_channel", "emission_enabled", "emission", "emission_energy_multiplier", "emission_operator",
	"emission_texture", "normal_enabled", "normal_scale", "normal_texture", "ao_enabled", "ao_light_affect", "ao_texture",
	"ao_texture_channel", "transparency", "alpha_scissor_threshold", "depth_draw_mode", "cull_mode", "uv1_scale",
	"uv1_offset", "texture_filter", "texture_repeat", "render_priority", "resource_name", "resource_local_to_scene",
	"resource_path", "resource_scene_unique_id", "script",
]

var _converted := {} # materials, by what they were made of
var _shaders := {} # by their text
var _plain := StandardMaterial3D.new()


func convert_scene(scene: Node) -> void:
	var nodes: Array[Node] = [scene]
	while not nodes.is_empty():
		var node: Node = nodes.pop_back()
		nodes.append_array(node.get_children())
		if node is ImporterMeshInstance3D and node.mesh:
			_convert_mesh(node.mesh)


# Returns why the material cannot be converted; empty if it can.
func obstacle(material: Material) -> String:
	if material.next_pass:
		return "it has a next pass"
	if not material is StandardMaterial3D:
		return "it is no StandardMaterial3D"
	for property in material.get_property_list():
		var name: String = property.name
		if property.usage & PROPERTY_USAGE_STORAGE and not name in CARRIED and material.get(name) != _plain.get(name):
			return "%s is %s" % [name, material.get(name)]
	if not DEFINES.has(material.transparency):
		return "transparency is %d" % material.transparency
	return ""


# Returns the material of Cotan that looks like the given one, which has no obstacle.
func converted(from: StandardMaterial3D) -> ShaderMaterial:
	if _converted.has(from):
		return _converted[from]
	var material := ShaderMaterial.new()
	material.resource_name = from.resource_name
	material.render_priority = from.render_priority
	material.shader = _shader_for(from)
	var values := {
		"albedo": from.albedo_color,
		"texture_albedo": from.albedo_texture,
		"vertex_color": from.vertex_color_use_as_albedo,
		"vertex_color_srgb": from.vertex_color_is_srgb,
		"metallic": from.metallic,
		"specular": from.metallic_specular,
		"texture_metallic": from.metallic_texture,
		"metallic_channel": _channel(from.metallic_texture_channel),
		"roughness": from.roughness,
		"texture_roughness": from.roughness_texture,
		"roughness_channel": _channel(from.roughness_texture_channel),
		"normal_scale": from.normal_scale,
		"normal_map": from.normal_texture,
		"uv_scale": Vector2(from.uv1_scale.x, from.uv1_scale.y),
		"uv_offset": Vector2(from.uv1_offset.x, from.uv1_offset.y),
	}
	if from.emission_enabled:
		values["emission"] = from.emission
		values["emission_energy"] = from.emission_energy_multiplier
		values["emission_multiplies"] = from.emission_operator == BaseMaterial3D.EMISSION_OP_MULTIPLY
		values["texture_emission"] = from.emission_texture
	if from.ao_enabled:
		values["ao_light_affect"] = from.ao_light_affect
		values["texture_ao"] = from.ao_texture
		values["ao_channel"] = _channel(from.ao_texture_channel)
	if from.transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR:
		values["alpha_scissor_threshold"] = from.alpha_scissor_threshold
	for name in values:
		if values[name] != null:
			material.set_shader_parameter(name, values[name])
	_converted[from] = material
	return material


func _shader_for(from: StandardMaterial3D) -> Shader:
	var modes: Array[String] = ["diffuse_burley", DEPTHS[from.depth_draw_mode], CULLS[from.cull_mode]]
	if from.transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_DEPTH_PRE_PASS:
		modes.append("depth_prepass_alpha")
	var code := "shader_type spatial;\nrender_mode %s;\n%s#define COTAN_SAMPLER %s, %s\n#include \"%s\"\n" % [
		", ".join(modes), DEFINES[from.transparency], FILTERS[from.texture_filter],
		"repeat_enable" if from.texture_repeat else "repeat_disable",
		get_script().resource_path.get_base_dir().path_join("material.gdshaderinc"),
	]
	if not _shaders.has(code):
		_shaders[code] = Shader.new()
		_shaders[code].code = code
	return _shaders[code]


func _channel(channel: BaseMaterial3D.TextureChannel) -> Vector4:
	if channel == BaseMaterial3D.TEXTURE_CHANNEL_GRAYSCALE:
		return Vector4(1, 1, 1, 0) / 3.0
	var weights := Vector4()
	weights[channel] = 1
	return weights


# Whether Godot reads tangents where it draws the material.
func _needs_tangents(material: Material) -> bool:
	if material == null:
		return false
	if material is BaseMaterial3D:
		return material.normal_enabled or material.anisotropy_enabled or material.heightmap_enabled \
			or material.clearcoat_enabled or material.detail_enabled or material.next_pass != null
	return not material in _converted.values()


func _convert_mesh(mesh: ImporterMesh) -> void:
	var surfaces := []
	for i in mesh.get_surface_count():
		var material := mesh.get_surface_material(i)
		if material is BaseMaterial3D and material.normal_enabled:
			var why := obstacle(material)
			if why:
				push_warning("Cotan: %s keeps its tangents: %s" % [material.resource_name, why])
			else:
				material = converted(material)
		var arrays := mesh.get_surface_arrays(i)
		var shapes: Array[Array] = []
		for k in mesh.get_blend_shape_count():
			shapes.append(mesh.get_surface_blend_shape_arrays(i, k))
		if not _needs_tangents(material):
			for list in [arrays] + shapes:
				list[Mesh.ARRAY_TANGENT] = null
		surfaces.append([mesh.get_surface_primitive_type(i), arrays, shapes, {}, material, mesh.get_surface_name(i),
			mesh.get_surface_format(i)])
	var names: Array[String] = []
	for k in mesh.get_blend_shape_count():
		names.append(mesh.get_blend_shape_name(k))
	var mode := mesh.get_blend_shape_mode()
	mesh.clear()
	for name in names:
		mesh.add_blend_shape(name)
	mesh.set_blend_shape_mode(mode)
	for surface in surfaces:
		mesh.callv("add_surface", surface)
