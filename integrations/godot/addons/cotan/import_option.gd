# The option "Cotan > Without Tangents" of imported models. Materials with a normal map become materials of Cotan, and
# surfaces that no longer need tangents lose them. What cannot be converted stays as it is, with a warning.
@tool
extends EditorScenePostImportPlugin

const OPTION := "cotan/without_tangents"


func _get_import_options(_path: String) -> void:
	add_import_option(OPTION, false)


func _pre_process(scene: Node) -> void:
	if get_option_value(OPTION):
		preload("without_tangents.gd").new().convert_scene(scene)
