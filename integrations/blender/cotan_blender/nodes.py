"""Materials: finds and assigns normal maps in their nodes."""

from .refused import Refused


FIX = "make it local first, or do not assign the map"


def _principled(material):
    """The material's Principled BSDF, preferably the one that is displayed; None if there is none."""
    nodes = material.node_tree.nodes if material.use_nodes and material.node_tree else []
    shaders = [n for n in nodes if n.type == "BSDF_PRINCIPLED"]
    shown = [n for n in shaders if n.outputs[0].is_linked]
    return (shown or shaders or [None])[0]


def _source(socket, kind):
    """The node that the socket is linked from, if it is of this type; else None."""
    node = socket.links[0].from_node if socket.is_linked else None
    return node if node is not None and node.type == kind else None


def _normal_socket(shader):
    """The normal input of the shader, or of a Bump node in front of it."""
    socket = shader.inputs["Normal"]
    bump = _source(socket, "BUMP")
    return bump.inputs["Normal"] if bump else socket


def map_of(material):
    """The Normal Map node and the Image Texture node of the material's normal; None for each that is missing."""
    shader = _principled(material) if material is not None else None
    reader = _source(_normal_socket(shader), "NORMAL_MAP") if shader else None
    return reader, _source(reader.inputs["Color"], "TEX_IMAGE") if reader else None


def writable(material):
    """Raises Refused if the material cannot be changed."""
    if material is not None and material.library is not None:
        raise Refused(f"The material '{material.name}' comes from a library file: {FIX}")


def assign(material, image, uv_map):
    """Makes the material read its normal from the image. uv_map: name of the uv map, "" for the default of renders.
    Returns a sentence on what could not be done, or ""."""
    material.use_nodes = True
    tree = material.node_tree
    shader = _principled(material)
    reader, texture = map_of(material)
    x, y = shader.location if shader else (0, 0)
    if texture is None:
        texture = tree.nodes.new("ShaderNodeTexImage")
        texture.location = (x - 600, y - 350)
    texture.image = image
    if reader is None:
        reader = tree.nodes.new("ShaderNodeNormalMap")
        reader.location = (x - 250, y - 350)
    tree.links.new(texture.outputs["Color"], reader.inputs["Color"])
    reader.space = "TANGENT"
    reader.uv_map = uv_map
    if uv_map:
        chosen = _source(texture.inputs["Vector"], "UVMAP")
        if chosen is None:
            chosen = tree.nodes.new("ShaderNodeUVMap")
            chosen.location = (x - 850, y - 450)
            tree.links.new(chosen.outputs["UV"], texture.inputs["Vector"])
        chosen.uv_map = uv_map
    tree.nodes.active = texture
    if shader is None:
        return f"the material '{material.name}' has no Principled BSDF, so its Normal Map node is linked to nothing"
    tree.links.new(reader.outputs["Normal"], _normal_socket(shader))
    return ""
