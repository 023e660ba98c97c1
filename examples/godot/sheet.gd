# A sheet with a normal map of domes but no tangents, seen from the front (left) and from behind (right). Its texture
# coordinates are sheared, half of them mirrored. The driver GLES2 has no derivatives and gets the frame `triangle`.
#   --mirrored          mirrors the sheets in x by their transforms; the image stays the same
#   --scale=0.5         scales the sheets by their transforms, and their meshes the other way; the image stays the same
#   --normals           the normals in view space as colours, (n + 1)/2
#   --picture=FILE.png  saves the picture and stops
extends Spatial

func has_word(word):
	return word in OS.get_cmdline_args()

func scale_word():
	for argument in OS.get_cmdline_args():
		if argument.begins_with("--scale="):
			return float(argument.substr(8))
	return 1.0

func _ready():
	var triangles = OS.get_current_video_driver() == OS.VIDEO_DRIVER_GLES2
	var material = ShaderMaterial.new()
	material.shader = load("res://triangle.shader" if triangles else "res://cotan.shader")
	if has_word("--normals"):
		material.shader = showing_normals(material.shader)
		get_viewport().keep_3d_linear = true # no sRGB
		get_viewport().hdr = false # the bytes as the shader rounds them
	material.set_shader_param("normal_map", domes(128))

	var scale = scale_word()
	var x = -scale if has_word("--mirrored") else scale
	var model = Basis(Vector3(x, 0, 0), Vector3(0, scale, 0), Vector3(0, 0, scale))
	for side in [[-1.2, 0.4], [1.2, PI - 0.4]]:
		var sheet = MeshInstance.new()
		sheet.mesh = sheet_mesh(1 / scale)
		sheet.material_override = material
		sheet.transform = Transform(Basis(Vector3(0, 1, 0), side[1]) * model, Vector3(side[0], 0, 0))
		add_child(sheet)

	var camera = Camera.new()
	camera.set_perspective(rad2deg(2 * atan(1 / 2.2)), 0.1, 100)
	camera.translation = Vector3(0, 0, 4)
	add_child(camera)
	var light = DirectionalLight.new()
	add_child(light)
	light.look_at_from_position(Vector3(-1, 1.5, 1.5), Vector3(0, 0, 0), Vector3(0, 1, 0))

	for argument in OS.get_cmdline_args():
		if argument.begins_with("--picture="):
			save(argument.substr(10))

# u = |x| + (1 - y)/2, v = 1 - y, clockwise as Godot expects. Triangles share no vertices, so that the two vectors of
# `triangle` can be stored at all three corners: U in the array of tangents and V in that of colours. size: half the
# sheet's width.
func sheet_mesh(size):
	var positions = PoolVector3Array()
	var normals = PoolVector3Array()
	var uvs = PoolVector2Array()
	var tangents = PoolRealArray()
	var colors = PoolColorArray()
	for left in [-1, 0]:
		for corners in [[Vector2(0, 1), Vector2(1, -1), Vector2(0, -1)], [Vector2(0, 1), Vector2(1, 1), Vector2(1, -1)]]:
			var p = []
			var t = []
			for corner in corners:
				p.append(Vector3(left + corner.x, corner.y, 0) * size)
				t.append(Vector2(abs(left + corner.x) + (1 - corner.y) / 2, 1 - corner.y))
			var vectors = triangle_vectors(p, t, Vector3(0, 0, 1))
			for k in range(3):
				positions.append(p[k])
				normals.append(Vector3(0, 0, 1))
				uvs.append(t[k])
				tangents.append_array(PoolRealArray([vectors[0].x, vectors[0].y, vectors[0].z, 1]))
				colors.append(Color(vectors[1].x, vectors[1].y, vectors[1].z))
	var arrays = []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = positions
	arrays[Mesh.ARRAY_NORMAL] = normals
	arrays[Mesh.ARRAY_TEX_UV] = uvs
	if OS.get_current_video_driver() == OS.VIDEO_DRIVER_GLES2:
		arrays[Mesh.ARRAY_TANGENT] = tangents
		arrays[Mesh.ARRAY_COLOR] = colors
	var mesh = ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays, [], 0) # 0: keep the floats
	return mesh

# U and V of the frame `triangle` for corners p with texture coordinates t. n: normal of the outer side.
func triangle_vectors(p, t, n):
	var e1 = p[1] - p[0]
	var e2 = p[2] - p[0]
	var d1 = t[1] - t[0]
	var d2 = t[2] - t[0]
	var u = e1 * d2.x - e2 * d1.x
	var v = e1 * d2.y - e2 * d1.y
	var longest = max(u.length(), v.length())
	var side = -1 if e1.cross(e2).dot(n) < 0 else 1
	return [u * side / longest, v * side / longest] if longest > 0 else [Vector3(), Vector3()]

# A normal map of domes: red along u, green up the image, flat is (128, 128, 255).
func domes(size):
	var bytes = PoolByteArray()
	for row in range(size):
		for column in range(size):
			var x = fmod((column + 0.5) / size * 4, 2) - 1
			var down = fmod((row + 0.5) / size * 4, 2) - 1
			var z2 = 1 - x * x - down * down
			var n = Vector3(x, -down, sqrt(z2)) if z2 > 0.36 else Vector3(0, 0, 1)
			bytes.append_array(PoolByteArray([round(127 * n.x + 128), round(127 * n.y + 128), round(127 * n.z + 128)]))
	var image = Image.new()
	image.create_from_data(size, size, false, Image.FORMAT_RGB8, bytes)
	var texture = ImageTexture.new()
	texture.create_from_image(image, Texture.FLAG_REPEAT | Texture.FLAG_FILTER | Texture.FLAG_MIPMAPS)
	return texture

# The shader changed to output its normal as a colour; fragment() must be its last function.
func showing_normals(shader):
	var shown = Shader.new()
	var code = shader.code.replace("render_mode cull_disabled;", "render_mode cull_disabled, unshaded;")
	shown.code = code.substr(0, code.rfind("}")) + "\tALBEDO = NORMAL * 0.5 + vec3(0.5);\n}\n"
	return shown

func save(path):
	for _frame in range(3):
		yield(VisualServer, "frame_post_draw")
	var image = get_viewport().get_texture().get_data()
	image.flip_y()
	image.convert(Image.FORMAT_RGB8)
	image.save_png(path)
	get_tree().quit()
