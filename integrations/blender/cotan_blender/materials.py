"""Detailed objects with their materials, for maps of these: as a model that Blender's glTF exporter writes."""

import json
import os
import struct
import tempfile

import bpy

from . import gltf, meshes, nodes
from .refused import packages

# For maps of materials, the inputs of the Principled BSDF that they show, and the textures of glTF for these.
SHOWN = {
    "base-color": (("Base Color",), "baseColorTexture"),
    "roughness": (("Roughness",), "metallicRoughnessTexture"),
    "metallic": (("Metallic",), "metallicRoughnessTexture"),
    "emissive": (("Emission", "Emission Color"), "emissiveTexture"),
    "id": ((), ""),
}
COLORS = ("base-color", "emissive", "id")  # stored as sRGB


def model_of(context, things, depsgraph, kinds):
    """A cotan.Model of these objects and their instances in Blender's axes, with materials but without vertex colours; and
    sentences on what its maps of these kinds lack. Raises Refused if the exporter fails."""
    shared, placed = {}, []
    for evaluated, matrix, key, own in meshes.solids_of(things, depsgraph):
        if key not in shared:
            layers = {"preserve_all_data_layers": True, "depsgraph": depsgraph} if own else {}  # others have all anyway
            mesh = shared[key] = bpy.data.meshes.new_from_object(evaluated, **layers)
            for number, slot in enumerate(evaluated.material_slots):
                if slot.link == "OBJECT" and number < len(mesh.materials):
                    mesh.materials[number] = slot.material and slot.material.original
        if shared[key].polygons:
            placed.append((evaluated.name, [x for column in matrix.transposed() for x in column], shared[key]))
    copies = [bpy.data.objects.new("cotan", mesh) for _, _, mesh in placed]
    try:
        for copy in copies:
            context.scene.collection.objects.link(copy)
        document, rest = _parts(gltf.exported(context, copies, y_up=False, colors=False))
        of_copy = {copy.name: (name, matrix) for copy, (name, matrix, _) in zip(copies, placed)}
        used = {m.name: m for mesh in shared.values() for m in mesh.materials if m is not None}
    finally:
        for copy in copies:
            bpy.data.objects.remove(copy)
        for mesh in shared.values():
            bpy.data.meshes.remove(mesh)
    for node in document["nodes"]:
        node["name"], node["matrix"] = of_copy[node["name"]]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "detail.glb")
        with open(path, "wb") as file:
            file.write(_joined(document, rest))
        return packages().load(path), _lacks(used, document, kinds)


def _parts(glb):
    """The JSON of a .glb, and the bytes of its other chunks."""
    length = struct.unpack_from("<I", glb, 12)[0]
    return json.loads(glb[20 : 20 + length]), glb[20 + length :]


def _joined(document, rest):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIII4s", b"glTF", 2, 20 + len(text) + len(rest), len(text), b"JSON") + text + rest


def _lacks(used, document, kinds):
    """Sentences on inputs of materials that the exporter has left out, since glTF has only numbers and images for them."""
    said = {}
    for written in document.get("materials", []):
        material = used.get(written["name"])
        shader = nodes.principled(material) if material else None
        if material is not None and shader is None and nodes.uses_nodes(material):
            said[f"'{material.name}' has no Principled BSDF, so that maps of materials show little of it"] = None
        for names, texture in [SHOWN[kind] for kind in kinds if kind in SHOWN and shader is not None]:
            exported = texture in written or texture in written.get("pbrMetallicRoughness", {})
            for socket in [shader.inputs[name] for name in names if name in shader.inputs]:
                if socket.is_linked and not exported and socket.links[0].from_node.type not in ("RGB", "VALUE"):
                    said[
                        f"'{material.name}': '{socket.name}' is neither a number nor an image, so that its map shows "
                        "glTF's default there: bake that texture to an image first"
                    ] = None
    return list(said)
