"""Meshes as Blender evaluates them (modifiers, shape keys, instances), as numpy arrays."""

import contextlib
import dataclasses
from typing import Optional

import numpy as np

from .refused import Refused

SOLID = {"MESH", "CURVE", "SURFACE", "META", "FONT"}  # objects that have faces


@dataclasses.dataclass
class Surface:
    """A triangle mesh. Its vertices are those of Blender's mesh, or one for each corner of its faces."""

    positions: np.ndarray  # (n, 3) float32
    normals: np.ndarray  # (n, 3) float32, unit
    triangles: np.ndarray  # (t, 3) uint32
    slots: np.ndarray  # (t,) int32: material slot
    vertices: np.ndarray  # (n,) int32: index of Blender's vertex
    vertex_count: int  # vertices of Blender's mesh
    smooth: np.ndarray  # (n, 3) float32: normal of Blender's vertex, smooth even at sharp edges
    texcoords: Optional[np.ndarray] = None  # (n, 2) float32, v down
    colors: Optional[np.ndarray] = None  # (n, 4) float32, linear
    uv_map: str = ""


def got(items, attribute, width=1, dtype=np.float32):
    """An attribute of all items of a collection: (n,), or (n, width)."""
    values = np.empty(len(items) * width, dtype)
    items.foreach_get(attribute, values)
    return values.reshape(-1, width) if width > 1 else values


def _corner_normals(mesh):
    if hasattr(mesh, "calc_normals_split"):  # before 4.1
        mesh.calc_normals_split()
        return got(mesh.loops, "normal", 3)
    return got(mesh.corner_normals, "vector", 3)


def _one_normal_a_vertex(mesh):
    if hasattr(mesh, "normals_domain"):  # since 4.1, which has no Auto Smooth
        return mesh.normals_domain == "POINT"
    return not mesh.use_auto_smooth and bool(got(mesh.polygons, "use_smooth", dtype=bool).all())


def _uv_of(mesh, name, wanted):
    layer = mesh.uv_layers.get(wanted) if wanted else mesh.uv_layers.active
    if layer is None:
        have = ", ".join(f"'{each.name}'" for each in mesh.uv_layers)
        if wanted and have:
            raise Refused(f"'{name}' has no uv map '{wanted}', only {have}")
        raise Refused(f"'{name}' has no uv map: unwrap it first")
    return layer


def _colors_of(mesh, wanted):
    """The colour attribute of a mesh with this name, the active one for ""; None if there is none, or `wanted` is None."""
    layers = mesh.color_attributes
    if wanted is None or len(layers) == 0:
        return None
    return layers.get(wanted) if wanted else layers.active_color or layers[0]


def surface_of(mesh, name, with_uv=False, uv_map="", colors=None):
    """The Surface of a mesh in object space. colors: name of its colour attribute, "" for the active one, None for none.
    Raises Refused if the mesh has no faces or lacks the uv map."""
    mesh.calc_loop_triangles()
    if len(mesh.loop_triangles) == 0:
        raise Refused(f"'{name}' has no faces, or none remain after its modifiers")
    positions = got(mesh.vertices, "co", 3)
    smooth = got(mesh.vertex_normals, "vector", 3)
    slots = got(mesh.loop_triangles, "material_index", dtype=np.int32)
    paint = _colors_of(mesh, colors)
    painted = got(paint.data, "color", 4) if paint is not None else None
    of_corners = paint is not None and paint.domain == "CORNER"
    if not with_uv and not of_corners and _one_normal_a_vertex(mesh):
        triangles = got(mesh.loop_triangles, "vertices", 3, np.int32).astype(np.uint32)
        vertex = np.arange(len(positions), dtype=np.int32)
        return Surface(positions, smooth, triangles, slots, vertex, len(positions), smooth, colors=painted)
    # One vertex per corner: Cotan welds equal vertices when it averages frames.
    triangles = got(mesh.loop_triangles, "loops", 3, np.int32).astype(np.uint32)
    vertex = got(mesh.loops, "vertex_index", dtype=np.int32)
    made = Surface(positions[vertex], _corner_normals(mesh), triangles, slots, vertex, len(positions), smooth[vertex])
    if painted is not None:
        made.colors = painted if of_corners else painted[vertex]
    if with_uv:
        layer = _uv_of(mesh, name, uv_map)
        made.texcoords, made.uv_map = got(layer.data, "uv", 2), layer.name
        made.texcoords[:, 1] = 1 - made.texcoords[:, 1]
    return made


def placed(surface, matrix, name):
    """The Surface in world space. Raises Refused if the matrix flattens it or positions are not finite or too far."""
    m = np.array(matrix, np.float64)
    turn, size = m[:3, :3], abs(np.linalg.det(m[:3, :3]))
    if not size > 1e-12 * np.linalg.norm(turn) ** 3:
        raise Refused(f"'{name}' has a scale of zero along an axis")
    positions = surface.positions @ turn.T.astype(np.float32) + m[:3, 3].astype(np.float32)
    bad = np.unique(surface.vertices[~(np.abs(positions) <= 1e17).all(axis=1)])
    if len(bad):
        raise Refused(
            f"'{name}': {len(bad)} of its vertices have invalid positions (NaN, infinite or too far away), the first "
            f"is number {bad[0]}"
        )
    triangles = surface.triangles if np.linalg.det(turn) > 0 else np.ascontiguousarray(surface.triangles[:, ::-1])
    inverse = np.linalg.inv(turn).astype(np.float32)
    return dataclasses.replace(
        surface,
        positions=positions,
        normals=_unit(surface.normals @ inverse),
        smooth=_unit(surface.smooth @ inverse),
        triangles=triangles,
    )


def _unit(vectors):
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.divide(vectors, length, out=np.zeros_like(vectors), where=length > 0)


def joined(surfaces):
    """Concatenated positions, triangles, normals and colours of all surfaces; white where one has none, None if none has."""
    colors = [np.ones((len(s.positions), 4), np.float32) if s.colors is None else s.colors for s in surfaces]
    starts = np.cumsum([0] + [len(s.positions) for s in surfaces[:-1]]).astype(np.uint32)
    return (
        np.concatenate([s.positions for s in surfaces]),
        np.concatenate([s.triangles + start for s, start in zip(surfaces, starts)]),
        np.concatenate([s.normals for s in surfaces]),
        np.concatenate(colors) if any(s.colors is not None for s in surfaces) else None,
    )


@contextlib.contextmanager
def mesh_of(evaluated, depsgraph, layers=False):
    """A temporary mesh of an evaluated object. layers: whether to preserve all uv maps."""
    mesh = evaluated.to_mesh(preserve_all_data_layers=True, depsgraph=depsgraph) if layers else evaluated.to_mesh()
    try:
        if mesh is None:
            raise Refused(f"'{evaluated.name}' has no faces, or none remain after its modifiers")
        yield mesh
    finally:
        evaluated.to_mesh_clear()


def _colors_missing(wanted):
    return f"color attribute '{wanted}'" if wanted else "vertex colors: paint some"


def low_surface(thing, depsgraph, uv_map="", colors=None):
    """The simple mesh in object space, with uv. colors: as for surface_of; a mesh without them is refused."""
    evaluated = thing.evaluated_get(depsgraph)
    with mesh_of(evaluated, depsgraph, layers=True) as mesh:
        made = surface_of(mesh, thing.name, True, uv_map, colors)
    if colors is not None and made.colors is None:
        raise Refused(f"'{thing.name}' has no {_colors_missing(colors)}")
    return made


def solids_of(things, depsgraph):
    """Yields the evaluated objects that have faces, of these objects and their instances: (object, world matrix, key, own).
    Those with the same key have the same mesh. own: it is a mesh object, not geometry that was made of another kind."""
    wanted = set(things)
    for instance in depsgraph.object_instances:
        owner = instance.parent if instance.is_instance else instance.object
        evaluated = instance.object
        if owner is None or owner.original not in wanted or evaluated.type not in SOLID:
            continue
        key = (evaluated.as_pointer(), evaluated.data.as_pointer() if evaluated.data else 0)
        made = instance.is_instance and owner.original == evaluated.original
        yield evaluated, instance.matrix_world, key, evaluated.type == "MESH" and not made


def high_surfaces(things, depsgraph, colors=None):
    """The detailed objects and their instances in world space. colors: as for surface_of; some must have them. Raises
    Refused if there are no faces, or none of these colours."""
    local, found = {}, []
    for evaluated, matrix, key, own in solids_of(things, depsgraph):
        if key not in local:
            try:
                with mesh_of(evaluated, depsgraph, layers=own and colors is not None) as mesh:
                    local[key] = surface_of(mesh, evaluated.name, colors=colors)
            except Refused:
                local[key] = None  # other objects may have faces
        if local[key] is not None:
            found.append(placed(local[key], matrix, evaluated.name))
    if not found:
        names = ", ".join(f"'{thing.name}'" for thing in things)
        raise Refused(f"No faces remain of {names} after modifiers, or it is hidden")
    if colors is not None and all(surface.colors is None for surface in found):
        raise Refused(f"No detailed mesh has {_colors_missing(colors)}")
    return found


@contextlib.contextmanager
def as_rendered(context, things, wanted=True):
    """A depsgraph with these objects as in a render: modifiers enabled for renders, with their subdivision levels for
    renders. Restores the settings afterwards. Linked objects stay as in the viewport."""
    changed = []
    for modifier in [m for thing in things if wanted and thing.library is None for m in thing.modifiers]:
        pairs = [("show_viewport", "show_render")]
        if modifier.type in {"SUBSURF", "MULTIRES"}:
            pairs.append(("levels", "render_levels"))
        for view, render in pairs:
            old, new = getattr(modifier, view), getattr(modifier, render)
            if old != new:
                changed.append((modifier, view, old))
                setattr(modifier, view, new)
    try:
        if changed:
            context.view_layer.update()
        yield context.evaluated_depsgraph_get()
    finally:
        for modifier, view, old in changed:
            setattr(modifier, view, old)
