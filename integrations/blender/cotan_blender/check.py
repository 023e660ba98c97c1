"""Checks a mesh: a verdict in sentences, and the faces in question."""

import dataclasses

import bpy
import numpy as np

from . import gltf, meshes
from .refused import Refused, packages

_TILT = np.radians(35)  # tilt of the texels with which frames are compared, as in `cotan lint`


@dataclasses.dataclass
class Question:
    kind: str
    text: str  # the end of a sentence that starts with the number of faces
    faces: np.ndarray  # indices of polygons


KINDS = [
    ("ALL", "All", "All faces with problems"),
    ("PLACE", "No position", "Faces with a corner that is not finite"),
    ("AREA", "No area", "Faces without area"),
    ("UV", "No area in uv", "Faces whose uv form a line or a point"),
    ("STRETCH", "Stretched uv", "Faces on which frames differ"),
    ("NGON", "N-gons", "Faces of more than four corners"),
]


def _differences(positions, texcoords):
    """For each triangle: the maximum angle in degrees between normals of an orthonormal and of the cotangent frame."""
    cotan = packages()
    count = len(positions)
    e1, e2 = positions[:, 1] - positions[:, 0], positions[:, 2] - positions[:, 0]
    t1, t2 = texcoords[:, 1] - texcoords[:, 0], texcoords[:, 2] - texcoords[:, 0]
    normals = np.cross(e1, e2)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    most = np.zeros(count)
    for turn in np.arange(8) * np.pi / 4:
        texel = np.array([np.sin(_TILT) * np.cos(turn), np.sin(_TILT) * np.sin(turn), np.cos(_TILT)], np.float32)
        texels = np.tile(texel, (count, 1))
        frames = ("orthonormal", "cotangent")
        one, other = (cotan.frame_apply(frame, texels, normals, e1, e2, t1, t2) for frame in frames)
        most = np.maximum(most, np.degrees(np.arccos(np.clip((one * other).sum(axis=1), -1, 1))))
    return most


def questions(mesh, degrees):
    """The faces in question of a mesh in Object Mode. degrees: the allowed difference between frames."""
    mesh.calc_loop_triangles()
    polygon = meshes.got(mesh.loop_triangles, "polygon_index", dtype=np.int32)
    positions = meshes.got(mesh.vertices, "co", 3)[meshes.got(mesh.loop_triangles, "vertices", 3, np.int32)]
    placed = np.isfinite(positions).all(axis=(1, 2))
    with np.errstate(invalid="ignore", over="ignore"):
        area = np.linalg.norm(np.cross(positions[:, 1] - positions[:, 0], positions[:, 2] - positions[:, 0]), axis=1)
    solid = placed & (area > 0)
    found = [
        Question("PLACE", "have a corner without a position (NaN or infinite)", polygon[~placed]),
        Question("AREA", "have no area", _all_of(polygon, placed & ~solid)),
    ]
    if mesh.uv_layers.active is not None:
        uv = meshes.got(mesh.uv_layers.active.data, "uv", 2)[meshes.got(mesh.loop_triangles, "loops", 3, np.int32)]
        uv[..., 1] = 1 - uv[..., 1]
        u, v = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
        spread = np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) > 0
        text = "have no area in uv: no frame has a direction on them"
        found.append(Question("UV", text, _all_of(polygon, solid & ~spread)))
        judged = np.flatnonzero(solid & spread)
        off = judged[_differences(positions[judged], uv[judged]) > degrees] if len(judged) else judged
        text = f"have stretched uv: a map for MikkTSpace, read with cotangent, has an error of over {degrees:g} degrees"
        found.append(Question("STRETCH", text, polygon[off]))
    corners = meshes.got(mesh.polygons, "loop_total", dtype=np.int32)
    text = "have more than four corners: no tangents are exported for such a mesh"
    found.append(Question("NGON", text, np.flatnonzero(corners > 4)))
    for each in found:
        each.faces = np.unique(each.faces)
    return [each for each in found if len(each.faces)]


def _all_of(polygon, bad):
    """Polygons whose triangles are all bad. A single flat triangle, from a corner on a straight edge, is harmless."""
    return np.setdiff1d(polygon[bad], polygon[~bad])


def _on_maps(context, thing):
    """Sentences about the normal maps, from lint and detect."""
    maps = gltf.normal_maps([thing])
    if not maps:
        return ["None of its materials reads a normal map"]
    said = []
    foreign = [image for image, _ in maps if gltf.frame_of(image) != "mikktspace"]
    for image in foreign:
        frame = gltf.frame_of(image)
        said.append(f"'{image.name}' was baked for {frame}: read it with that; Blender's own node uses MikkTSpace")
    report = packages().lint(gltf.exported(context, [thing]))
    if len(foreign) < len(maps) and report.recommendation:
        said.append(report.recommendation)
    for image, down in maps:
        if image.colorspace_settings.name not in {"Non-Color", "Raw", "Generic Data"}:
            space = image.colorspace_settings.name
            said.append(f"'{image.name}' is read as a colour ({space}): set its colour space to Non-Color")
        said.append(gltf.detected(image, down))
    return said


def verdict(context, thing, degrees):
    """Sentences about a mesh object, and its faces in question. Raises Refused if it cannot be checked."""
    if thing is None or thing.type != "MESH":
        raise Refused(f"'{thing.name}' is not a mesh" if thing else "No object is active: make a mesh the active one")
    if len(thing.data.polygons) == 0:
        raise Refused(f"'{thing.name}' has no faces")
    asked = questions(thing.data, degrees)
    if any(each.kind == "PLACE" for each in asked):
        return [], asked
    said = gltf.warnings(context, [thing])
    if not thing.data.uv_layers:
        said.append(f"'{thing.name}' has no uv map: unwrap it first")
    elif not any(slot.material for slot in thing.material_slots):
        said.append(f"'{thing.name}' has no material")
    else:
        said += _on_maps(context, thing)
    return said, asked


def select(context, thing, faces):
    """Enters Edit Mode with only these polygons selected."""
    mesh = thing.data
    chosen = np.zeros(len(mesh.polygons), bool)
    chosen[faces] = True
    for items in (mesh.vertices, mesh.edges):
        items.foreach_set("select", np.zeros(len(items), bool))
    mesh.polygons.foreach_set("select", chosen)
    context.view_layer.objects.active = thing
    context.tool_settings.mesh_select_mode = (False, False, True)
    bpy.ops.object.mode_set(mode="EDIT")
