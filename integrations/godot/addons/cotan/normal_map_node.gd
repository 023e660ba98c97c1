# The node "Cotan > CotanNormalMap" of visual shaders: connect the color of a normal map, and the result to Normal.
@tool
class_name VisualShaderNodeCotanNormalMap
extends VisualShaderNodeCustom


func _get_name() -> String:
	return "CotanNormalMap"


func _get_category() -> String:
	return "Cotan"


func _get_description() -> String:
	return "The normal of a surface with a normal map, without tangents. Connect it to Normal, not to Normal Map."


func _is_available(mode: Shader.Mode, type: VisualShader.Type) -> bool:
	return mode == Shader.MODE_SPATIAL and type == VisualShader.TYPE_FRAGMENT


func _get_return_icon_type() -> PortType:
	return PORT_TYPE_VECTOR_3D


func _get_input_port_count() -> int:
	return 3


func _get_input_port_name(port: int) -> String:
	return ["normal map", "uv", "scale"][port]


func _get_input_port_type(port: int) -> PortType:
	return [PORT_TYPE_VECTOR_3D, PORT_TYPE_VECTOR_2D, PORT_TYPE_SCALAR][port]


func _get_input_port_default_value(port: int) -> Variant:
	return [Vector3(128.0 / 255.0, 128.0 / 255.0, 1.0), null, 1.0][port] # no map: flat


func _get_output_port_count() -> int:
	return 1


func _get_output_port_name(_port: int) -> String:
	return "normal"


func _get_output_port_type(_port: int) -> PortType:
	return PORT_TYPE_VECTOR_3D


func _get_global_code(_mode: Shader.Mode) -> String:
	return "#include \"%s\"\n" % get_script().resource_path.get_base_dir().path_join("cotan.gdshaderinc")


# Ports that are not connected: nodes that scripts make have no default values.
func _get_code(inputs: Array[String], outputs: Array[String], _mode: Shader.Mode, _type: VisualShader.Type) -> String:
	var texel := inputs[0] if inputs[0] else "vec3(128.0 / 255.0, 128.0 / 255.0, 1.0)"
	var uv := inputs[1] if inputs[1] else "UV"
	var amount := inputs[2] if inputs[2] else "1.0"
	return "%s = normalize(mix(NORMAL, cotan_perturb_normal(NORMAL, VERTEX, %s, %s), %s));\n" % [
		outputs[0], uv, texel, amount]
