# Registers the import option of models, and the menu item that sets it for all of them.
@tool
extends EditorPlugin

const MENU := "Cotan: Draw Models Without Tangents"

var _import := preload("import_option.gd").new()


func _enter_tree() -> void:
	add_scene_post_import_plugin(_import)
	add_tool_menu_item(MENU, _convert_all)


func _exit_tree() -> void:
	remove_scene_post_import_plugin(_import)
	remove_tool_menu_item(MENU)


# Turns the option on for every model of the project, and Ensure Tangents off, and imports the models again.
func _convert_all() -> void:
	var files := PackedStringArray()
	var folders: Array[EditorFileSystemDirectory] = [EditorInterface.get_resource_filesystem().get_filesystem()]
	while not folders.is_empty():
		var folder: EditorFileSystemDirectory = folders.pop_back()
		for i in folder.get_subdir_count():
			folders.append(folder.get_subdir(i))
		for i in folder.get_file_count():
			var file := folder.get_file_path(i)
			var settings := ConfigFile.new()
			if settings.load(file + ".import") != OK or settings.get_value("remap", "importer", "") != "scene":
				continue
			settings.set_value("params", _import.OPTION, true)
			settings.set_value("params", "meshes/ensure_tangents", false)
			if settings.save(file + ".import") == OK:
				files.append(file)
			else:
				push_warning("Cotan: %s.import cannot be written" % file)
	if files.is_empty():
		print("Cotan: the project has no models")
		return
	print("Cotan: importing %d models without tangents" % files.size())
	EditorInterface.get_resource_filesystem().reimport_files(files)
