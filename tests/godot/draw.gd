# Draws the jobs of --folder=FOLDER/jobs.json and stores the bytes of the pictures, RGB, rows from the top.
# A job: shader and out (files), size, parts (the shader's uniform `part` is 0, 1, ... in so many pictures, one behind the
# other); textures (of raw RGBA bytes, not filtered, repeated: file, width, height); sheet (its corners), or nothing for
# a rectangle that fills the picture; mirrored and scale (x, y, z; of the sheet's transforms), light (three directions, for red, green, blue).
extends Node

var viewport = Viewport.new()
var folder = ""

func _ready():
	for argument in OS.get_cmdline_args():
		if argument.begins_with("--folder="):
			folder = argument.substr(9)
	viewport.hdr = false
	viewport.keep_3d_linear = true
	viewport.own_world = true
	viewport.render_target_update_mode = Viewport.UPDATE_ALWAYS
	add_child(viewport)
	var camera = Camera.new()
	# 2 * atan(1 / 2.2), as in tests/examples_sheets.hpp
	camera.set_perspective(rad2deg(2 * atan(1 / 2.2)), 0.1, 100)
	camera.translation = Vector3(0, 0, 4)
	viewport.add_child(camera)
	for job in JSON.parse(text_of(folder + "/jobs.json")).result:
		yield(draw(job), "completed")
	print("DONE")
	get_tree().quit()

func text_of(path):
	var file = File.new()
	file.open(path, File.READ)
	return file.get_as_text()

func bytes_of(path):
	var file = File.new()
	file.open(path, File.READ)
	return file.get_buffer(file.get_len())

func draw(job):
	viewport.size = Vector2(job.size[0], job.size[1])
	var material = ShaderMaterial.new()
	material.shader = Shader.new()
	material.shader.code = text_of(job.shader)
	for name in job.textures:
		var given = job.textures[name]
		var image = Image.new()
		image.create_from_data(int(given.width), int(given.height), false, Image.FORMAT_RGBA8, bytes_of(given.file))
		var texture = ImageTexture.new()
		texture.create_from_image(image, Texture.FLAG_REPEAT)
		material.set_shader_param(name, texture)
	var nodes = []
	if job.has("sheet"):
		for side in [[-1.2, 0.4], [1.2, PI - 0.4]]:
			var node = MeshInstance.new()
			node.mesh = sheet_of(job.sheet)
			var x = -job.scale[0] if job.mirrored else job.scale[0]
			var basis = Basis(Vector3(0, 1, 0), side[1])
			basis = basis * Basis(Vector3(x, 0, 0), Vector3(0, job.scale[1], 0), Vector3(0, 0, job.scale[2]))
			node.transform = Transform(basis, Vector3(side[0], 0, 0))
			nodes.append(node)
	else:
		var node = MeshInstance.new()
		node.mesh = QuadMesh.new()
		node.mesh.size = Vector2(20000, 20000)
		nodes.append(node)
	for i in range(len(job.light)):
		var light = DirectionalLight.new()
		light.light_color = [Color(1, 0, 0), Color(0, 1, 0), Color(0, 0, 1)][i]
		light.light_specular = 0
		var to = job.light[i]
		viewport.add_child(light)
		light.look_at_from_position(Vector3(to[0], to[1], to[2]), Vector3(), Vector3(0.3, 1, 0.1))
		nodes.append(light)
	for node in nodes:
		if node is MeshInstance:
			node.material_override = material
			viewport.add_child(node)
	var file = File.new()
	file.open(job.out, File.WRITE)
	for part in range(job.parts):
		material.set_shader_param("part", float(part))
		yield(VisualServer, "frame_post_draw")
		var image = viewport.get_texture().get_data()
		image.flip_y()
		image.convert(Image.FORMAT_RGB8)
		file.store_buffer(image.get_data())
	file.close()
	for node in nodes:
		node.queue_free()

# given: positions, normals, uvs, and tangents (four each) and colors (three each) where there are any; or
# generate_tangents: by Godot.
func sheet_of(given):
	var arrays = []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = vectors(given.positions)
	arrays[Mesh.ARRAY_NORMAL] = vectors(given.normals)
	var uvs = PoolVector2Array()
	for i in range(0, len(given.uvs), 2):
		uvs.append(Vector2(given.uvs[i], given.uvs[i + 1]))
	arrays[Mesh.ARRAY_TEX_UV] = uvs
	if given.has("tangents"):
		arrays[Mesh.ARRAY_TANGENT] = PoolRealArray(given.tangents)
	if given.has("colors"):
		var colors = PoolColorArray()
		for i in range(0, len(given.colors), 3):
			colors.append(Color(given.colors[i], given.colors[i + 1], given.colors[i + 2]))
		arrays[Mesh.ARRAY_COLOR] = colors
	var mesh = ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [], 0) # 0: nothing compressed
	if given.has("generate_tangents"):
		var tool = SurfaceTool.new()
		tool.create_from(mesh, 0)
		tool.generate_tangents()
		mesh = tool.commit()
	return mesh

func vectors(numbers):
	var list = PoolVector3Array()
	for i in range(0, len(numbers), 3):
		list.append(Vector3(numbers[i], numbers[i + 1], numbers[i + 2]))
	return list
