# The node "Cotan > CotanDirectionOfU" of visual shaders: the direction in which u increases, for anisotropy.
@tool
class_name VisualShaderNodeCotanDirectionOfU
extends VisualShaderNodeCustom


func _get_name() -> String:
	return "CotanDirectionOfU"


func _get_category() -> String:
	return "Cotan"


func _get_description() -> String:
	return "Tangent and binormal without stored ones, for anisotropy. Connect the normal of the node CotanNormalMap."


func _is_available(mode: Shader.Mode, type: VisualShader.Type) -> bool:
	return mode == Shader.MODE_SPATIAL and type == VisualShader.TYPE_FRAGMENT


func _get_return_icon_type() -> PortType:
	return PORT_TYPE_VECTOR_3D


func _get_input_port_count() -> int:
	return 2


func _get_input_port_name(port: int) -> String:
	return ["normal", "uv"][port]


func _get_input_port_type(port: int) -> PortType:
	return [PORT_TYPE_VECTOR_3D, PORT_TYPE_VECTOR_2D][port]


func _get_output_port_count() -> int:
	return 2


func _get_output_port_name(port: int) -> String:
	return ["tangent", "binormal"][port]


func _get_output_port_type(_port: int) -> PortType:
	return PORT_TYPE_VECTOR_3D


func _get_global_code(_mode: Shader.Mode) -> String:
	return "#include \"%s\"\n" % get_script().resource_path.get_base_dir().path_join("cotan.gdshaderinc")


func _get_code(inputs: Array[String], outputs: Array[String], _mode: Shader.Mode, _type: VisualShader.Type) -> String:
	var normal := inputs[0] if inputs[0] else "NORMAL"
	var uv := inputs[1] if inputs[1] else "UV"
	return "%s = cotan_direction_of_u(%s, VERTEX, %s);\n%s = cross(%s, %s);\n" % [
		outputs[0], normal, uv, outputs[1], normal, outputs[0]]
