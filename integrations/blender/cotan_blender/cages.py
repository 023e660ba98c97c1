"""The start of rays for a bake: by Blender's own bake settings or by a cage mesh."""

import dataclasses

import numpy as np

from .meshes import mesh_of, got, placed
from .refused import Refused


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


def cage_for(settings, bake, surface, low, named, depsgraph):
    """Arguments for cotan.bake: the start and the reach of rays.

    surface: the object `low` in its own space. bake: Blender's own settings. named: a cage found by name, or None.
    """
    if settings.cage == "FIRST":
        rays = settings.directions.lower()
        return {"rays": rays, "extrusion": settings.extrusion, "max_distance": settings.distance}
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
