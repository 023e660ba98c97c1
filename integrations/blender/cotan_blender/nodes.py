"""Materials: finds and assigns normal maps in their nodes."""

import bpy

from .refused import Refused


FIX = "make it local first, or do not assign the map"
HAS_CONVENTION = "convention" in bpy.types.ShaderNodeNormalMap.bl_rna.properties  # since Blender 5
_OPTIONAL = bpy.app.version < (5, 0, 0)  # later materials always use nodes, and use_nodes is deprecated


def uses_nodes(material):
    return material.node_tree is not None and (not _OPTIONAL or material.use_nodes)


def principled(material):
    """The material's Principled BSDF, preferably the one that is displayed; None if there is none."""
    shaders = [] if not uses_nodes(material) else [n for n in material.node_tree.nodes if n.type == "BSDF_PRINCIPLED"]
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


def frame_group(material):
    """The node group of frames.py that gives the material's normal; None if there is none."""
    shader = principled(material) if material is not None else None
    group = _source(_normal_socket(shader), "GROUP") if shader else None
    return group if group is not None and group.node_tree is not None and "cotan_frame" in group.node_tree else None


def map_of(material):
    """The Normal Map node and the Image Texture node of the material's normal; None for each that is missing. With a
    node group of frames.py, the Normal Map node is the one in front of it."""
    shader, group = principled(material) if material is not None else None, frame_group(material)
    socket = group.inputs["Normal"] if group else _normal_socket(shader) if shader else None
    reader = _source(socket, "NORMAL_MAP") if socket else None
    return reader, _source(reader.inputs["Color"], "TEX_IMAGE") if reader else None


def link_normal(material, node):
    """Makes the material take its normal from this node."""
    material.node_tree.links.new(node.outputs["Normal"], _normal_socket(principled(material)))


def uv_name(thing, reader):
    """Name of the uv map of an object with which the node computes tangents; "" if it has none."""
    layers = thing.data.uv_layers
    shown = next((layer.name for layer in layers if layer.active_render), "")
    return reader.uv_map if reader.uv_map in layers else shown


def reads_green_down(reader):
    """Whether the Normal Map node takes green as pointing down (DirectX). Older Blenders always take it as up."""
    return getattr(reader, "convention", "OPENGL") == "DIRECTX"


def read_green_up(material, reader):
    """Makes the node take green as pointing up, as in every map that is baked here. Returns sentences."""
    if not reads_green_down(reader):
        return []
    if material.library is not None:
        return [f"The material '{material.name}' comes from a library file and reverses the green of its map: {FIX}"]
    reader.convention = "OPENGL"
    return [f"'{material.name}' took green as pointing down (DirectX): its node is set to OpenGL, as the map is"]


def all_read_green_up(image):
    """The same for all materials that read the image, which may have replaced another. Returns sentences."""
    said = []
    for material in bpy.data.materials:
        reader, texture = map_of(material)
        if texture is not None and texture.image == image:
            said += read_green_up(material, reader)
    return said


def writable(material):
    """Raises Refused if the material cannot be changed."""
    if material is not None and material.library is not None:
        raise Refused(f"The material '{material.name}' comes from a library file: {FIX}")


def assign(material, image, uv_map):
    """Makes the material read its normal from the image. uv_map: name of the uv map, "" for the default of renders.
    Returns sentences on what could not be done, or was changed."""
    if _OPTIONAL:
        material.use_nodes = True
    tree = material.node_tree
    shader = principled(material)
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
    said, group = read_green_up(material, reader), frame_group(material)
    if group is not None:
        tree.links.new(texture.outputs["Color"], group.inputs["Color"])
    elif shader is not None:
        link_normal(material, reader)
    else:
        said.append(f"the material '{material.name}' has no Principled BSDF, so its Normal Map node is linked to nothing")
    return said
