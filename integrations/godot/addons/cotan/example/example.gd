# Two rings without tangents: left with the material of Cotan, right with a visual shader. Both have one normal map.
extends Node3D

@export var material: ShaderMaterial


func _ready() -> void:
	var map := domes(256)
	var ring := ring_mesh(96, 48, 0.7, 0.3)
	$Material.mesh = ring
	$Material.material_override = material.duplicate()
	$Material.material_override.set_shader_parameter("roughness", 0.4)
	$Material.material_override.set_shader_parameter("normal_map", map)
	$Material.material_override.set_shader_parameter("uv_scale", Vector2(16, 6))
	$VisualShader.mesh = ring
	$VisualShader.material_override = ShaderMaterial.new()
	$VisualShader.material_override.shader = visual_shader(Vector2(16, 6))
	$VisualShader.material_override.set_shader_parameter("normal_map", map)


func _process(delta: float) -> void:
	$Material.rotate_y(0.3 * delta)
	$VisualShader.rotate_y(0.3 * delta)


# A ring of radius `radius` and thickness 2 * `tube`, with u around the ring and v around the tube, once each.
static func ring_mesh(columns: int, rows: int, radius: float, tube: float) -> ArrayMesh:
	var positions := PackedVector3Array()
	var normals := PackedVector3Array()
	var uvs := PackedVector2Array()
	var indices := PackedInt32Array()
	for row in rows + 1:
		for column in columns + 1:
			var u := float(column) / columns
			var v := float(row) / rows
			var outwards := Vector3(sin(TAU * u), 0, cos(TAU * u))
			var normal := outwards * cos(TAU * v) + Vector3.DOWN * sin(TAU * v)
			positions.append(outwards * radius + normal * tube)
			normals.append(normal)
			uvs.append(Vector2(u, v))
			if row < rows and column < columns:
				var first := row * (columns + 1) + column
				var below := first + columns + 1
				indices.append_array(PackedInt32Array([first, first + 1, below, first + 1, below + 1, below]))
	var arrays := []
	arrays.resize(Mesh.ARRAY_MAX)
	arrays[Mesh.ARRAY_VERTEX] = positions
	arrays[Mesh.ARRAY_NORMAL] = normals
	arrays[Mesh.ARRAY_TEX_UV] = uvs
	arrays[Mesh.ARRAY_INDEX] = indices
	var mesh := ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, arrays)
	return mesh


# A normal map of one dome: red along u, green up the image, flat is (128, 128, 255).
static func domes(size: int) -> ImageTexture:
	var image := Image.create(size, size, false, Image.FORMAT_RGB8)
	for row in size:
		for column in size:
			var x := (column + 0.5) / size * 2 - 1
			var down := (row + 0.5) / size * 2 - 1
			var z2 := 1 - x * x - down * down
			var n := Vector3(x, -down, sqrt(z2)) if z2 > 0.36 else Vector3(0, 0, 1)
			image.set_pixel(column, row, Color8(roundi(127 * n.x + 128), roundi(127 * n.y + 128), roundi(127 * n.z + 128)))
	image.generate_mipmaps(true)
	return ImageTexture.create_from_image(image)


# The graph that the editor of visual shaders makes of: UV, a map of type Normal Map, CotanNormalMap, and Normal.
static func visual_shader(repeats: Vector2) -> VisualShader:
	var shader := VisualShader.new()
	var uv := VisualShaderNodeUVFunc.new() # (uv - pivot) * scale + pivot
	uv.function = VisualShaderNodeUVFunc.FUNC_SCALING
	uv.set_input_port_default_value(1, repeats)
	var map := VisualShaderNodeTexture2DParameter.new()
	map.parameter_name = "normal_map"
	map.texture_type = VisualShaderNodeTextureParameter.TYPE_NORMAL_MAP
	map.texture_repeat = VisualShaderNodeTextureParameter.REPEAT_ENABLED
	map.texture_filter = VisualShaderNodeTextureParameter.FILTER_LINEAR_MIPMAP_ANISOTROPIC
	var texel := VisualShaderNodeTexture.new()
	texel.source = VisualShaderNodeTexture.SOURCE_PORT
	var normal := VisualShaderNodeCotanNormalMap.new()
	var at := 2
	for node: VisualShaderNode in [uv, map, texel, normal]:
		shader.add_node(VisualShader.TYPE_FRAGMENT, node, Vector2(at * 300 - 1600, 0), at)
		at += 1
	for wire in [[2, 0, 4, 0], [3, 0, 4, 2], [4, 0, 5, 0], [2, 0, 5, 1], [5, 0, 0, 8]]:
		var refused := shader.connect_nodes(VisualShader.TYPE_FRAGMENT, wire[0], wire[1], wire[2], wire[3])
		assert(refused == OK)
	return shader
