# Draws the jobs of --folder=FOLDER/jobs.json like tests/godot/draw.gd, in Godot 4. Only sheets, without lights; a
# sheet's `tangents` and `colors` become CUSTOM0 and CUSTOM1.
extends Node

var viewport := SubViewport.new()
var folder := ""

func _ready():
	for argument in OS.get_cmdline_user_args():
		if argument.begins_with("--folder="):
			folder = argument.substr(9)
	viewport.own_world_3d = true
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	add_child(viewport)
	var camera := Camera3D.new()
	# 2 * atan(1 / 2.2), as in tests/examples_sheets.hpp
	camera.set_perspective(rad_to_deg(2 * atan(1 / 2.2)), 0.1, 100)
	camera.position = Vector3(0, 0, 4)
	viewport.add_child(camera)
	for job in JSON.parse_string(FileAccess.get_file_as_string(folder + "/jobs.json")):
		await draw(job)
	print("DONE")
	get_tree().quit()

func draw(job):
	viewport.size = Vector2i(job.size[0], job.size[1])
	var material := ShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = FileAccess.get_file_as_string(job.shader)
	for key in job.textures:
		var given = job.textures[key]
		var bytes := FileAccess.get_file_as_bytes(given.file)
		var image := Image.create_from_data(int(given.width), int(given.height), false, Image.FORMAT_RGBA8, bytes)
		material.set_shader_parameter(key, ImageTexture.create_from_image(image))
	var nodes := []
	for side in [[-1.2, 0.4], [1.2, PI - 0.4]]:
		var node := MeshInstance3D.new()
		node.mesh = sheet_of(job.sheet)
		var x = -job.scale[0] if job.mirrored else job.scale[0]
		var basis := Basis(Vector3(0, 1, 0), side[1])
		basis = basis * Basis(Vector3(x, 0, 0), Vector3(0, job.scale[1], 0), Vector3(0, 0, job.scale[2]))
		node.transform = Transform3D(basis, Vector3(side[0], 0, 0))
		node.material_override = material
		viewport.add_child(node)
		nodes.append(node)
	var file := FileAccess.open(job.out, FileAccess.WRITE)
	for part in range(int(job.parts)):
		material.set_shader_parameter("part", float(part))
		await RenderingServer.frame_post_draw
		await RenderingServer.frame_post_draw
		var image := viewport.get_texture().get_image()
		image.convert(Image.FORMAT_RGB8)
		file.store_buffer(image.get_data())
	file.close()
	for node in nodes:
		node.free()

func sheet_of(given) -> ArrayMesh:
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = vectors(given.positions)
	arrays[Mesh.ARRAY_NORMAL] = vectors(given.normals)
	var uvs := PackedVector2Array()
	for i in range(0, len(given.uvs), 2):
		uvs.append(Vector2(given.uvs[i], given.uvs[i + 1]))
	arrays[Mesh.ARRAY_TEX_UV] = uvs
	var flags := 0
	if given.has("tangents"):
		var first := PackedFloat32Array()
		for i in range(0, len(given.tangents), 4):
			first.append_array(PackedFloat32Array([given.tangents[i], given.tangents[i + 1], given.tangents[i + 2]]))
		arrays[Mesh.ARRAY_CUSTOM0] = first
		arrays[Mesh.ARRAY_CUSTOM1] = PackedFloat32Array(given.colors)
		flags = (Mesh.ARRAY_CUSTOM_RGB_FLOAT << Mesh.ARRAY_FORMAT_CUSTOM0_SHIFT) \
			| (Mesh.ARRAY_CUSTOM_RGB_FLOAT << Mesh.ARRAY_FORMAT_CUSTOM1_SHIFT)
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [], {}, flags)
	if given.has("generate_tangents"):
		var tool := SurfaceTool.new()
		tool.create_from(mesh, 0)
		tool.generate_tangents()
		mesh = tool.commit()
	return mesh

func vectors(numbers) -> PackedVector3Array:
	var list := PackedVector3Array()
	for i in range(0, len(numbers), 3):
		list.append(Vector3(numbers[i], numbers[i + 1], numbers[i + 2]))
	return list
