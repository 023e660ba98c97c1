"""The start of rays for a bake: by Blender's own bake settings or by a cage mesh."""

import dataclasses
import re

import bpy
import numpy as np

from .images import pixels_of
from .meshes import as_rendered, got, mesh_of, placed
from .refused import Refused, packages


FOREVER = 1e17  # the largest reach that the library accepts, more than any mesh needs


def _around(surface, cage, depsgraph, low):
    """World positions of the cage's vertex for each vertex of the surface."""
    with mesh_of(cage.evaluated_get(depsgraph), depsgraph) as mesh:
        positions = got(mesh.vertices, "co", 3)
    if len(positions) != surface.vertex_count:
        raise Refused(
            f"The cage '{cage.name}' has {len(positions)} vertices, '{low.name}' has {surface.vertex_count}: "
            f"make the cage from a copy of '{low.name}'"
        )
    moved = dataclasses.replace(surface, positions=positions[surface.vertices])
    return placed(moved, cage.matrix_world, cage.name).positions


def made_for(context, low, settings):
    """A new object, drawn as wires: the simple mesh as it is baked, moved outwards by the extrusion of the settings, or by
    2 % of its diagonal if that is 0. It replaces the cage made before. Raises Refused for a mesh without faces."""
    with as_rendered(context, [low], settings.as_rendered) as depsgraph:
        mesh = bpy.data.meshes.new_from_object(low.evaluated_get(depsgraph), depsgraph=depsgraph)
    positions, outwards = got(mesh.vertices, "co", 3), got(mesh.vertices, "normal", 3)
    if not mesh.polygons:
        bpy.data.meshes.remove(mesh)
        raise Refused(f"'{low.name}' has no faces")
    # The extrusion is a distance in the world, as for the rays that it shows.
    scale = abs(low.matrix_world.determinant()) ** (1 / 3)
    distance = settings.extrusion / max(scale, 1e-9) or 0.02 * float(np.linalg.norm(np.ptp(positions, axis=0)))
    mesh.vertices.foreach_set("co", (positions + np.float32(distance) * outwards).ravel())
    mesh.materials.clear()
    mesh.update()
    cage = next((o for o in context.scene.objects if o.get("cotan_cage_of") == low.name), None)
    if cage is None:
        words = packages().name_role(low.name) == "low"
        cage = bpy.data.objects.new(_cage_name(low.name) if words else f"{low.name}_cage", mesh)
        cage["cotan_cage_of"] = low.name
        for collection in low.users_collection:
            collection.objects.link(cage)
    else:
        old, cage.data = cage.data, mesh
        if old.users == 0:
            bpy.data.meshes.remove(old)
    mesh.name = cage.name
    cage.matrix_world, cage.display_type, cage.hide_render = low.matrix_world, "WIRE", True
    return cage


def _cage_name(name):
    """The name of a simple mesh with `cage` instead of its word for simple: door_low.001 -> door_cage.001."""
    return re.sub(r"(?i)(?<![a-z0-9])(low|lo|lp|lowpoly)(?![a-z0-9])", "cage", name)


def rays_colors(settings):
    """The name of the colour attribute of the simple mesh that says which way rays run, "" for its active one; None if none
    does."""
    painted = settings.cage == "FIRST" and settings.directions == "VERTEX_COLOR" and settings.rays_mask is None
    return settings.rays_colors if painted else None


def cage_for(settings, bake, surface, low, named, depsgraph):
    """Arguments for cotan.bake: the start and the reach of rays.

    surface: the object `low` in its own space. bake: Blender's own settings. named: a cage found by name, or None.
    """
    if settings.cage == "FIRST":
        rays = {"extrusion": settings.extrusion, "max_distance": settings.distance}
        if settings.rays_mask is not None:
            return {"rays_mask": pixels_of(settings.rays_mask), **rays}
        return {"rays": settings.directions.lower().replace("_", "-"), **rays}
    if settings.cage == "NEAREST":
        return {"search": "nearest", "max_distance": settings.distance}
    if settings.cage == "MESH":
        cage = named or settings.cage_object
        if cage is None or cage.type != "MESH":
            raise Refused(
                f"There is no cage for '{low.name}': choose a mesh, or name one like it with 'cage' instead of 'low'"
            )
        return {"cage": _around(surface, cage, depsgraph, low)}
    # Blender's settings: extrusion in the space of the simple mesh, distance in world space; 0 means no limit.
    reach = bake.max_ray_distance or FOREVER
    if bake.use_cage and bake.cage_object is not None:
        return {"cage": _around(surface, bake.cage_object, depsgraph, low), "cage_reach": reach}
    if not bake.cage_extrusion > 0:
        return {"search": "nearest", "max_distance": bake.max_ray_distance}
    outwards = surface.smooth if bake.use_cage else surface.normals
    moved = dataclasses.replace(surface, positions=surface.positions + np.float32(bake.cage_extrusion) * outwards)
    return {"cage": placed(moved, low.matrix_world, low.name).positions, "cage_reach": reach}
