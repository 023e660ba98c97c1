# Draws materials of Godot and what the add-on makes of them, and prints how far the images differ, in steps of 255.
extends Node

const SIZE := 128

var viewport := SubViewport.new()
var ball := MeshInstance3D.new()
var converter := preload("res://addons/cotan/without_tangents.gd").new()


func _ready() -> void:
	viewport.size = Vector2i(SIZE, SIZE)
	viewport.own_world_3d = true
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	add_child(viewport)
	var camera := Camera3D.new()
	camera.position.z = 2
	camera.environment = Environment.new()
	camera.environment.background_mode = Environment.BG_COLOR
	camera.environment.background_color = Color(0.3, 0.1, 0.2)
	camera.environment.ambient_light_source = Environment.AMBIENT_SOURCE_COLOR
	camera.environment.ambient_light_color = Color(0.4, 0.5, 0.6)
	camera.environment.ambient_light_energy = 0.5
	viewport.add_child(camera)
	var light := DirectionalLight3D.new()
	light.basis = Basis.looking_at(Vector3(0.5, -0.7, -1))
	viewport.add_child(light)
	ball.mesh = colored_sphere()
	viewport.add_child(ball)
	var colors := texture(func(x, y): return Color(x, y, 1 - x, 0.25 + 0.75 * y))
	var bumps := texture(func(x, y): return Color(0.5 + 0.2 * sin(20 * x), 0.5 + 0.2 * sin(20 * y), 0.9))
	var settings := {
		"plain": {},
		"colors": {"albedo_color": Color(0.9, 0.6, 0.3), "albedo_texture": colors},
		"vertex colors": {"vertex_color_use_as_albedo": true},
		"vertex colors in sRGB": {"vertex_color_use_as_albedo": true, "vertex_color_is_srgb": true},
		"metal": {"metallic": 0.8, "metallic_texture": colors, "metallic_texture_channel": 2, "roughness": 0.5},
		"gray": {"metallic": 0.8, "metallic_texture": colors, "metallic_texture_channel": 4},
		"rough": {"roughness": 0.9, "roughness_texture": colors, "roughness_texture_channel": 1, "metallic_specular": 0.9},
		"glow": {"emission_enabled": true, "emission": Color(0.3, 0.1, 0.2), "emission_energy_multiplier": 1.5},
		"glowing image": {"emission_enabled": true, "emission": Color(0.1, 0.1, 0.2), "emission_texture": colors},
		"multiplied": {"emission_enabled": true, "emission": Color(0.9, 0.1, 0.2), "emission_operator": 1},
		"multiplied image": {"emission_enabled": true, "emission": Color(0.9, 0.5, 0.2), "emission_operator": 1, "emission_texture": colors},
		"occlusion": {"ao_enabled": true, "ao_texture": colors, "ao_light_affect": 0.5, "ao_texture_channel": 1},
		"no image of occlusion": {"ao_enabled": true},
		"translucent": {"albedo_texture": colors, "transparency": 1, "cull_mode": 2},
		"masked": {"albedo_texture": colors, "transparency": 2, "alpha_scissor_threshold": 0.6, "cull_mode": 2},
		"prepass": {"albedo_texture": colors, "transparency": 4, "depth_draw_mode": 1},
		"behind": {"albedo_texture": colors, "cull_mode": 1},
		"moved": {"albedo_texture": colors, "uv1_scale": Vector3(3, 2, 1), "uv1_offset": Vector3(0.2, 0.1, 0)},
		"strong": {"normal_scale": 2.0},
		"inverted": {"normal_scale": -0.5},
		"two-sided": {"cull_mode": 2},
	}
	for filter in 6:
		settings["filter %d" % filter] = {"albedo_texture": colors, "texture_filter": filter, "uv1_scale": Vector3(9, 9, 1)}
	settings["clamped"] = {"albedo_texture": colors, "texture_repeat": false, "uv1_scale": Vector3(3, 2, 1)}
	for name: String in settings:
		var material := StandardMaterial3D.new()
		material.normal_enabled = true
		material.normal_texture = bumps
		for property: String in settings[name]:
			material.set(property, settings[name][property])
		if converter.obstacle(material):
			print("REFUSED %s: %s" % [name, converter.obstacle(material)])
			continue
		var theirs := await drawn(material)
		var ours := await drawn(converter.converted(material))
		var sum := 0
		for i in theirs.size():
			sum += absi(theirs[i] - ours[i])
		print("PAIR %.3f %s" % [float(sum) / theirs.size(), name])
	for property in ["anisotropy_enabled", "heightmap_enabled", "detail_enabled", "clearcoat_enabled", "uv1_triplanar", "no_depth_test"]:
		var material := StandardMaterial3D.new()
		material.normal_enabled = true
		material.set(property, true)
		print("OBSTACLE %s: %s" % [property, converter.obstacle(material)])
	print("DONE")
	get_tree().quit()


func drawn(material: Material) -> PackedByteArray:
	ball.material_override = material
	await RenderingServer.frame_post_draw
	await RenderingServer.frame_post_draw
	var image := viewport.get_texture().get_image()
	image.convert(Image.FORMAT_RGB8)
	return image.get_data()


# A texture of 32 x 32: red to alpha of each texel.
func texture(color: Callable) -> ImageTexture:
	var image := Image.create(32, 32, false, Image.FORMAT_RGBA8)
	for y in 32:
		for x in 32:
			image.set_pixel(x, y, color.call(x / 31.0, y / 31.0))
	image.generate_mipmaps()
	return ImageTexture.create_from_image(image)


func colored_sphere() -> ArrayMesh:
	var arrays := SphereMesh.new().get_mesh_arrays()
	var colors := PackedColorArray()
	for position: Vector3 in arrays[Mesh.ARRAY_VERTEX]:
		colors.append(Color(0.5 + position.x, 0.5 + position.y, 0.5 + position.z))
	arrays[Mesh.ARRAY_COLOR] = colors
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	return mesh
