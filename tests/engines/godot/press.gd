# Presses the button of the add-on, waits for the import, and prints the material that a model then has.
@tool
extends EditorPlugin


func _enter_tree() -> void:
	press.call_deferred()


func press() -> void:
	var files := EditorInterface.get_resource_filesystem()
	while files.is_scanning():
		await get_tree().process_frame
	for plugin: EditorPlugin in get_tree().root.find_children("*", "EditorPlugin", true, false):
		if plugin.get_script() and plugin.get_script().resource_path == "res://addons/cotan/plugin.gd":
			plugin._convert_all()
	var scene: Node = ResourceLoader.load("res://ring_with_exact.gltf", "", ResourceLoader.CACHE_MODE_IGNORE).instantiate()
	var node: MeshInstance3D = scene if scene is MeshInstance3D else scene.find_children("*", "MeshInstance3D", true, false)[0]
	print("PRESSED ", node.mesh.surface_get_material(0).get_class())
	scene.free()
	get_tree().quit()
