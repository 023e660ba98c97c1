# Draws the jobs of --folder=FOLDER/jobs.json, made by tests/engines/godot.py, and writes FOLDER/sizes.json.
# A job: model (an imported scene, which is scaled to radius 1), kind (below), out (a file), size, basis (three columns),
# eye (distance), map (a file; default: the map of the model).
#   imported   as it was imported, lit: one RGB image
#   normals    the imported material of Cotan; engine: Godot's NORMAL_MAP with the tangents of the mesh; material: the
#              ready material; visual: the visual shader of the example. Six RGB images: x, y, z of the normal in view
#              space, u, v, and 1/4, each as 3 x 7 bits from 100
extends Node

const ENGINE := "shader_type spatial;
render_mode CULL;
uniform sampler2D normal_map : hint_normal, filter_linear_mipmap_anisotropic, repeat_enable;
void fragment() { NORMAL_MAP = texture(normal_map, UV).rgb; }
"
# Colours pass through light(), which reads the normal that the engine lights with.
const LIGHT := "
uniform float part;
void light()
{
	float x = part < 0.5 ? NORMAL.x : part < 1.5 ? NORMAL.y : part < 2.5 ? NORMAL.z : part < 3.5 ? UV.x : part < 4.5 ? UV.y : 0.25;
	float number = floor((clamp(x, -1.0, 1.0) * 0.5 + 0.5) * 2097151.0 + 0.5);
	float high = floor(number / 16384.0);
	float middle = floor((number - high * 16384.0) / 128.0);
	vec3 bytes = vec3(high, middle, number - high * 16384.0 - middle * 128.0) + 100.0;
	DIFFUSE_LIGHT = vec3(0.0);
	SPECULAR_LIGHT = pow((bytes / 255.0 + 0.055) / 1.055, vec3(2.4));
}
"

var viewport := SubViewport.new()
var camera := Camera3D.new()
var maps := {}


func _ready() -> void:
	var folder := ""
	for argument in OS.get_cmdline_user_args():
		if argument.begins_with("--folder="):
			folder = argument.substr(9)
	viewport.own_world_3d = true
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	add_child(viewport)
	camera.environment = Environment.new()
	camera.environment.background_mode = Environment.BG_COLOR
	camera.environment.background_color = Color.BLACK
	camera.environment.ambient_light_source = Environment.AMBIENT_SOURCE_DISABLED
	camera.environment.reflected_light_source = Environment.REFLECTION_SOURCE_DISABLED
	camera.fov = 30
	viewport.add_child(camera)
	var light := DirectionalLight3D.new()
	light.basis = Basis.looking_at(Vector3(0.5, -0.7, -1))
	viewport.add_child(light)
	var sizes := {}
	for job in JSON.parse_string(FileAccess.get_file_as_string(folder + "/jobs.json")):
		await draw(job, sizes)
	FileAccess.open(folder + "/sizes.json", FileAccess.WRITE).store_string(JSON.stringify(sizes))
	print("DONE")
	get_tree().quit()


func draw(job: Dictionary, sizes: Dictionary) -> void:
	viewport.size = Vector2i(job.size, job.size)
	camera.position = Vector3(0, 0, job.eye)
	var scene: Node3D = load(job.model).instantiate()
	var columns: Array = job.basis
	var turned := Node3D.new()
	turned.basis = Basis(vector(columns[0]), vector(columns[1]), vector(columns[2]))
	turned.add_child(scene)
	viewport.add_child(turned)
	var nodes := scene.find_children("*", "MeshInstance3D", true, false)
	if scene is MeshInstance3D:
		nodes.append(scene)
	var inverse := turned.basis.inverse()
	var box := AABB()
	for node: MeshInstance3D in nodes:
		var own := Transform3D(inverse) * node.global_transform * node.get_aabb()
		box = own if node == nodes[0] else box.merge(own)
	var unit := 2 / box.size.length()
	turned.basis = turned.basis.scaled_local(Vector3(unit, unit, unit))
	turned.position = turned.basis * -box.get_center()
	var materials := []
	var size := {"vertices": 0, "bytes": 0, "tangents": 0, "surfaces": 0, "kept": 0}
	for node: MeshInstance3D in nodes:
		for i in node.mesh.get_surface_count():
			measure(node.mesh, i, size)
			if job.kind != "imported":
				var material := material_of(job.kind, node.mesh.surface_get_material(i))
				if job.has("map"):
					material.set_shader_parameter("normal_map", map_of(job.map))
				node.set_surface_override_material(i, material)
				materials.append(material)
	sizes[job.model] = size
	var file := FileAccess.open(job.out, FileAccess.WRITE)
	for part in (1 if job.kind == "imported" else 6):
		for material: ShaderMaterial in materials:
			material.set_shader_parameter("part", float(part))
		await RenderingServer.frame_post_draw
		await RenderingServer.frame_post_draw
		var image := viewport.get_texture().get_image()
		image.convert(Image.FORMAT_RGB8)
		file.store_buffer(image.get_data())
		if part == 0:
			image.save_png(job.out + ".png")
	file.close()
	turned.free()


# Adds what a surface takes on the GPU, without its indices.
func measure(mesh: Mesh, i: int, size: Dictionary) -> void:
	var stored := RenderingServer.mesh_get_surface(mesh.get_rid(), i)
	size.vertices += stored.vertex_count
	size.bytes += stored.vertex_data.size() + stored.get("attribute_data", PackedByteArray()).size()
	size.tangents += int((stored.format & Mesh.ARRAY_FORMAT_TANGENT) != 0)
	size.surfaces += 1
	size.kept += int(mesh.surface_get_material(i) is StandardMaterial3D)


# All with the same filter, opaque, and without emission.
func material_of(kind: String, imported: Material) -> ShaderMaterial:
	var material := ShaderMaterial.new()
	var code := ENGINE.replace("CULL", "cull_back")
	if imported is StandardMaterial3D:
		code = ENGINE.replace("CULL", ["cull_back", "cull_front", "cull_disabled"][imported.cull_mode])
		material.set_shader_parameter("normal_map", imported.normal_texture)
	elif kind == "normals":
		material = imported.duplicate()
		code = imported.shader.code.replace("#define COTAN_ALPHA\n", "").replace("filter_linear_mipmap,", "filter_linear_mipmap_anisotropic,")
		material.set_shader_parameter("emission_energy", 0)
	match kind:
		"material":
			code = load("res://addons/cotan/material.tres").shader.code.replace("\"material", "\"res://addons/cotan/material")
		"visual":
			code = load("res://addons/cotan/example/example.gd").visual_shader(Vector2(1, 1)).code
	material.shader = Shader.new()
	material.shader.code = code + LIGHT
	return material


func map_of(file: String) -> ImageTexture:
	if not maps.has(file):
		var image := Image.load_from_file(file)
		image.generate_mipmaps(true)
		maps[file] = ImageTexture.create_from_image(image)
	return maps[file]


func vector(numbers: Array) -> Vector3:
	return Vector3(numbers[0], numbers[1], numbers[2])
