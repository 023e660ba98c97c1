# Draws stone.glb with cotan.shader and stone_normal.png, as docs/tutorials/blender-to-godot.md sets them up, and stops.
#   --image=FILE.png    where the image goes
#   --flat              without the map
extends Spatial

func _ready():
	var material = ShaderMaterial.new()
	material.shader = load("res://cotan.shader")
	if not "--flat" in OS.get_cmdline_args():
		material.set_shader_param("normal_map", load("res://stone_normal.png"))
	var model = load("res://stone.glb").instance()
	add_child(model)
	var box = AABB()
	for mesh in meshes_of(model):
		mesh.material_override = material
		box = box.merge(mesh.get_transformed_aabb())
	var middle = box.position + box.size / 2
	var camera = Camera.new()
	camera.set_perspective(30, 0.1, 100)
	add_child(camera)
	var away = Vector3(0.5, 0.6, 2.2).normalized() * box.size.length() * 1.6
	camera.look_at_from_position(middle + away, middle, Vector3(0, 1, 0))
	var world = WorldEnvironment.new()
	world.environment = Environment.new()
	world.environment.background_mode = Environment.BG_COLOR
	world.environment.background_color = Color(0.18, 0.18, 0.2)
	world.environment.ambient_light_color = Color(1, 1, 1)
	world.environment.ambient_light_energy = 0.2
	add_child(world)
	var light = DirectionalLight.new()
	light.light_energy = 0.8
	add_child(light)
	light.look_at_from_position(Vector3(-1, 1.2, 1), Vector3(), Vector3(0, 1, 0))
	for _frame in range(3):
		yield(VisualServer, "frame_post_draw")
	var image = get_viewport().get_texture().get_data()
	image.flip_y()
	for argument in OS.get_cmdline_args():
		if argument.begins_with("--image="):
			image.save_png(argument.substr(8))
	print("DONE")
	get_tree().quit()

func meshes_of(node):
	var found = [node] if node is MeshInstance else []
	for child in node.get_children():
		found += meshes_of(child)
	return found
