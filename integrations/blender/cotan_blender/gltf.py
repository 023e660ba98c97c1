"""Export by Blender's own glTF exporter, and warnings about it."""

import contextlib
import os
import tempfile

import bpy
import numpy as np

from . import images, meshes, nodes
from .refused import Refused, packages


def exported(context, things, apply_modifiers=True, y_up=True, colors=True):
    """The bytes of a .glb of these objects, without tangents, as Blender's exporter writes it. y_up: as glTF needs it, else
    with Blender's axes. colors: with those of vertices. Raises Refused."""
    if "gltf" not in dir(bpy.ops.export_scene):
        raise Refused("Blender's glTF exporter is disabled: enable 'glTF 2.0 format' in Preferences > Add-ons")
    more = {}
    if not colors:  # the second since Blender 4.2
        known = bpy.ops.export_scene.gltf.get_rna_type().properties
        more = {"export_colors": False} if "export_colors" in known else {"export_vertex_color": "NONE"}
    active, selected = context.view_layer.objects.active, context.selected_objects
    try:
        for thing in selected:
            thing.select_set(False)
        for thing in things:
            thing.select_set(True)
        with tempfile.TemporaryDirectory() as folder, _green_up(things, folder), _blenders_nodes(things):
            path = os.path.join(folder, "model.glb")
            bpy.ops.export_scene.gltf(
                filepath=path,
                export_format="GLB",
                use_selection=True,
                export_tangents=False,
                export_apply=apply_modifiers,
                export_yup=y_up,
                **more,
            )
            with open(path, "rb") as file:
                return file.read()
    except (RuntimeError, OSError) as error:
        raise Refused(f"Blender's glTF exporter failed: {_last_line(error)}") from None
    finally:
        for thing in context.selected_objects:
            thing.select_set(False)
        for thing in selected:
            thing.select_set(True)
        context.view_layer.objects.active = active


def _last_line(error):
    lines = [line for line in str(error).splitlines() if line.strip()]
    return lines[-1].strip() if lines else type(error).__name__


def _readers(things):
    """(material, Normal Map node, Image Texture node) of the materials of these objects that have a normal map."""
    materials = {slot.material: None for thing in things for slot in thing.material_slots}
    chains = [(material, *nodes.map_of(material)) for material in materials]
    return [chain for chain in chains if chain[2] is not None and chain[2].image is not None]


def normal_maps(things):
    """The distinct normal maps of these objects: (image, whether its node takes green as pointing down)."""
    return list({(texture.image, nodes.reads_green_down(reader)): None for _, reader, texture in _readers(things)})


@contextlib.contextmanager
def _green_up(things, folder):
    """Blender's exporter writes maps as they are, but glTF needs green up: nodes that take it as pointing down read a
    copy in the folder, with green reversed, meanwhile. Raises Refused for a node that cannot be changed."""
    copies, changed = {}, []
    try:
        for material, reader, texture in _readers(things):
            image = texture.image
            if not nodes.reads_green_down(reader) or 0 in tuple(image.size):
                continue
            if image not in copies:
                copies[image] = images.with_green_reversed(image, os.path.join(folder, f"{len(copies)}.png"))
            changed.append((texture, image))
            texture.image = copies[image]
            if texture.image != copies[image]:  # since Blender 5, nodes of a library file keep their image
                raise Refused(
                    f"The material '{material.name}' comes from a library file and takes green as pointing down, which "
                    "glTF cannot: make it local first"
                )
        yield
    finally:
        for texture, image in changed:
            texture.image = image
        for copy in copies.values():
            bpy.data.images.remove(copy)


@contextlib.contextmanager
def _blenders_nodes(things):
    """Materials that are shown with a frame of Cotan take their normals from Blender's node meanwhile, which the
    exporter reads; those of a library file stay."""
    changed = []
    try:
        for material, reader, _ in _readers(things):
            group = nodes.frame_group(material)
            if group is not None and material.library is None:
                strength = reader.inputs["Strength"]
                changed.append((material, group, strength, strength.default_value))
                strength.default_value = group.inputs["Strength"].default_value
                nodes.link_normal(material, reader)
        yield
    finally:
        for material, group, strength, before in changed:
            strength.default_value = before
            nodes.link_normal(material, group)


def frame_of(image):
    """The frame that the image was baked for: the stored one, else MikkTSpace as in other programs."""
    return image.get("cotan_frame", "mikktspace")


def frame_of_all(things):
    """The frame that all maps of these objects were made for. Raises Refused if there are several frames."""
    frames = {}
    for image, _ in normal_maps(things):
        frames.setdefault(frame_of(image), image)
    if len(frames) > 1:
        (a, first), (b, second) = list(frames.items())[:2]
        raise Refused(f"'{first.name}' was baked for {a} and '{second.name}' for {b}: bake them for the same frame")
    return next(iter(frames), "mikktspace")


def _uv_of_texture(thing, texture):
    """Name of the uv map that the image is read with; None: unknown."""
    socket = texture.inputs["Vector"]
    if not socket.is_linked:
        return next((layer.name for layer in thing.data.uv_layers if layer.active_render), None)
    node = socket.links[0].from_node
    return node.uv_map if node.type == "UVMAP" else None


def _on_uv(thing):
    """Warnings about the uv maps of a mesh object."""
    said, layers = [], thing.data.uv_layers
    for slot in thing.material_slots:
        reader, texture = nodes.map_of(slot.material)
        if texture is None:
            continue
        if nodes.reads_green_down(reader):
            said.append(
                f"'{slot.material.name}' takes green as pointing down (DirectX): the export reverses it, as glTF needs "
                "it up; Blender's own exporter does not"
            )
        if not layers:
            said.append(f"'{thing.name}' has no uv map: no program can show the normal map of '{slot.material.name}'")
            continue
        active = next((layer.name for layer in layers if layer.active_render), layers[0].name)
        of_texture, of_tangents = _uv_of_texture(thing, texture), reader.uv_map or active
        if of_texture and of_texture != of_tangents:
            said.append(
                f"'{slot.material.name}' reads its normal map with uv '{of_texture}' and its tangents with "
                f"'{of_tangents}': glTF supports only one for both"
            )
        elif len(layers) > 1:
            said.append(
                f"'{thing.name}' has {len(layers)} uv maps: its normal map is read with '{of_tangents}', and programs "
                f"that support only the first use '{layers[0].name}'"
            )
    return said


def _on_mesh(thing, mesh, apply_modifiers):
    """Warnings about faces and normals. mesh: the mesh that is exported."""
    said, own = [], thing.data
    corners = meshes.got(mesh.polygons, "loop_total", dtype=np.int32)
    if (corners > 4).any():
        said.append(
            f"'{thing.name}' has {int((corners > 4).sum())} faces of more than four corners: Blender silently "
            "writes no tangents for such a mesh, and each program triangulates them in its own way. Add a Triangulate "
            "modifier before you bake and export"
        )
    if not np.isfinite(meshes.got(mesh.vertices, "co", 3)).all():
        raise Refused(f"'{thing.name}' has vertices with invalid positions (NaN or infinite)")
    if own.has_custom_normals and hasattr(own, "use_auto_smooth") and not own.use_auto_smooth:
        said.append(f"'{thing.name}' has custom normals, but its Auto Smooth is off, so they are not exported")
    elif own.has_custom_normals and not mesh.has_custom_normals:
        said.append(f"'{thing.name}' loses its custom normals to a modifier")
    if apply_modifiers and own.shape_keys and len(own.shape_keys.key_blocks) > 1:
        said.append(
            f"'{thing.name}' has shape keys: their current values are exported and cannot be changed any more, "
            "because modifiers are applied"
        )
    if not apply_modifiers and any(m.show_viewport and m.type != "ARMATURE" for m in thing.modifiers):
        said.append(f"'{thing.name}' is exported without its modifiers")
    return said


def warnings(context, things, apply_modifiers=True):
    """Warnings about what other programs will show differently, on which exporters are silent. Raises Refused for
    objects that cannot be exported."""
    said, depsgraph = [], context.evaluated_depsgraph_get()
    for thing in [t for t in things if t.type == "MESH"]:
        said += _on_uv(thing)
        sizes = [abs(s) for s in thing.matrix_world.to_scale()]
        if max(sizes) > 1.001 * min(sizes):
            said.append(
                f"'{thing.name}' has a non-uniform scale: programs transform its tangents differently. "
                "Apply the scale"
            )
        if apply_modifiers:
            with meshes.mesh_of(thing.evaluated_get(depsgraph), depsgraph) as mesh:
                said += _on_mesh(thing, mesh, apply_modifiers)
        else:
            said += _on_mesh(thing, thing.data, apply_modifiers)
    return said


def detected(image, down):
    """A sentence on which way green of a normal map points, judged by the map alone. down: the way in which its Normal
    Map node takes it."""
    in_file = image.source == "FILE" and not image.has_data and not image.packed_file
    if in_file and not os.path.exists(bpy.path.abspath(image.filepath)):
        return f"'{image.name}': its file is missing"
    if 0 in tuple(image.size):
        return f"'{image.name}' has no pixels"
    green = packages().detect(images.pixels_of(image))
    if green.green == "undecidable":
        return f"'{image.name}': which way green points is undecidable ({green.reason})"
    turned = ""
    if green.green != ("down" if down else "up"):
        other = f", or set its Normal Map node to {'OpenGL' if down else 'DirectX'}" if nodes.HAS_CONVENTION else ""
        turned = f" Reverse it{other}: Blender shows every bump as a dent along v"
    swapped = " Red and green are exchanged." if green.swapped else ""
    return f"'{image.name}': green points {green.green}, {green.confidence}.{swapped}{turned}"
