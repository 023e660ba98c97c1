"""Bakes maps for pairs of meshes into their materials, in steps between which Blender can redraw its window."""

import dataclasses
import os
import tempfile
import threading

import bpy
import numpy as np

from . import cages, frames, images, materials, meshes, nodes
from .refused import Refused, packages
from .settings import MAPS


@dataclasses.dataclass
class Map:
    """One map to bake."""

    name: str
    owner: str  # the object and material that the map is for
    part: str  # the name of its file, without folder and ending
    kind: str  # a word of cotan.bake
    path: str = ""  # file to write; "": packed into the .blend


@dataclasses.dataclass
class Bake:
    """The maps of the same texels, whose rays are traced once."""

    slots: list  # material slots of the simple object that will use the maps; empty: the object has none yet
    first: bool  # of those of the same texels: tells of their problems
    arguments: dict  # for cotan.bake_maps, without the maps and the progress function
    maps: list = dataclasses.field(default_factory=list)


@dataclasses.dataclass
class Outcome:
    made: list = dataclasses.field(default_factory=list)  # images
    notes: list = dataclasses.field(default_factory=list)  # sentences about the images that were made
    failures: list = dataclasses.field(default_factory=list)  # sentences: why images could not be made


def _slots_of(low, surface, each):
    """For each map: (list of material slots, selection of the triangles with these slots)."""
    used = np.unique(np.clip(surface.slots, 0, max(len(low.material_slots) - 1, 0)))
    if not each or len(used) < 2:
        return [([int(s) for s in used] if len(low.material_slots) else [], slice(None))]
    return [([int(s)], surface.slots == s) for s in used]


def _check_uv(low, texcoords, triangles, uv_map):
    corners = texcoords[triangles]
    if not np.isfinite(corners).all():
        raise Refused(f"The uv map '{uv_map}' of '{low.name}' has coordinates that are not finite numbers")
    u, v = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    flat = u[:, 0] * v[:, 1] == u[:, 1] * v[:, 0]
    if flat.all():
        raise Refused(f"The uv map '{uv_map}' of '{low.name}' has no area: unwrap it again")
    inside = ((corners.max(axis=1) > 0) & (corners.min(axis=1) < 1)).all(axis=1)
    if not (inside & ~flat).any():
        raise Refused(f"The uv map '{uv_map}' of '{low.name}' lies outside the square from 0 to 1")


def check_low(low, settings):
    """Raises Refused if the simple object cannot have a map. Needs no evaluated objects."""
    if low.mode != "OBJECT":
        raise Refused(f"'{low.name}' is being edited: go back to Object Mode first")
    if settings.assign:
        if not low.material_slots and low.data.library is not None:
            raise Refused(f"'{low.name}' has no material, and its mesh comes from a library file: {nodes.FIX}")
        if low.library is not None and any(slot.material is None for slot in low.material_slots):
            raise Refused(f"'{low.name}' has an empty material slot and comes from a library file: {nodes.FIX}")
        for slot in low.material_slots:
            nodes.writable(slot.material)


def _details(context, settings, highs, depsgraph):
    """The detailed side: a list of (cotan.Mesh or cotan.Model, words of the maps that are baked from it), and notes. Maps
    of materials need a model without vertex colours, which would be factors of the base colour in it; ids of vertex colours
    a mesh with them."""
    wanted = [word for word, *_ in MAPS if word in settings.maps]
    paint = settings.id_colors if "id" in wanted and settings.id_by == "VERTEX_COLOR" else None
    painted = ["id"] if paint is not None else []
    joined = meshes.joined(meshes.high_surfaces(highs, depsgraph, paint))
    shown = [word for word in materials.SHOWN if word in wanted and word not in painted]
    mesh = packages().Mesh(*joined[:3], colors=joined[3])
    if not shown:
        return [(mesh, wanted)], []
    model, lacks = materials.model_of(context, highs, depsgraph, shown)
    return [(model, [word for word in wanted if word not in painted])] + [(mesh, painted)] * bool(painted), lacks


def prepare(context, settings, pair):
    """The bakes of a pair, the name of their uv map, and notes in sentences. Raises Refused."""
    low = pair.low
    check_low(low, settings)
    if not settings.maps:
        raise Refused("No map is chosen: choose some under Maps")
    if not pair.highs:
        raise Refused(f"There is no visible object named like '{low.name}' with 'high' or 'hi' instead of 'low'")
    others = [o for o in (pair.cage, settings.cage_object, context.scene.render.bake.cage_object) if o is not None]
    with meshes.as_rendered(context, [low, *pair.highs, *others], settings.as_rendered) as depsgraph:
        surface = meshes.low_surface(low, depsgraph, settings.uv_map, cages.rays_colors(settings))
        rays = cages.cage_for(settings, context.scene.render.bake, surface, low, pair.cage, depsgraph)
        matrix = low.evaluated_get(depsgraph).matrix_world.copy()
        details, notes = _details(context, settings, pair.highs, depsgraph)
        notes = _notes_on(low, matrix) + notes
    surface = meshes.placed(surface, matrix, low.name)
    cotan = packages()
    common = {
        "size": (settings.width, settings.height),
        "frame": settings.frame,
        "convention": "blender",
        "bits": int(settings.bits),
        "samples": int(settings.samples),
        "padding": settings.padding,
        "id_by": settings.id_by.lower().replace("_", "-"),
    }
    bakes, names = [], []
    parts = _slots_of(low, surface, settings.each_material)
    for slots, own in parts:
        material = low.material_slots[slots[0]].material if slots else None
        part = "" if len(parts) == 1 else f"_{material.name if material else slots[0]}"
        chosen = surface.triangles[own]
        _check_uv(low, surface.texcoords, chosen, surface.uv_map)
        mesh = cotan.Mesh(surface.positions, chosen, surface.normals, surface.texcoords, colors=surface.colors)
        arguments = {"low": mesh, **common, **rays}
        if "cage" in rays:
            arguments["cage"] = cotan.Mesh(rays["cage"], chosen, surface.normals)
        for high, kinds in details:
            bakes.append(Bake(slots, high is details[0][0], {"high": high, **arguments}))
            for kind in kinds:
                name = f"{low.name}{part}_{kind.replace('-', '_')}"
                owner = "\n".join([low.name, part] + [kind] * (kind != "normal"))
                names.append(images.part_for(owner, name, names))
                path = images.file_for(settings, owner, name, names[-1])
                bakes[-1].maps.append(Map(name, owner, names[-1], kind, path))
    return bakes, surface.uv_map, notes


def _notes_on(low, matrix):
    sizes = matrix.to_scale()
    if max(map(abs, sizes)) > 1.001 * min(map(abs, sizes)):
        return [f"'{low.name}' has a non-uniform scale, which programs treat differently: apply the scale"]
    return []


class Work(threading.Thread):
    """A bake into PNG files on its own thread. files: of the maps, by their kinds."""

    def __init__(self, arguments, files):
        super().__init__(name="cotan bake")
        self.arguments, self.files, self.share, self.stop = arguments, files, 0.0, False
        self.baked, self.written, self.error = {}, [], None  # written: kinds
        self.start()

    def _told(self, share):
        self.share = share
        return not self.stop

    def run(self):
        try:
            self.baked = packages().bake_maps(maps=list(self.files), progress=self._told, **self.arguments)
            for kind, file in self.files.items():
                packages().write_image(file, self.baked[kind].map)
                self.written.append(kind)
        except BaseException as error:  # raised by the waiting thread
            self.error = error


def _put(low, slots, image, uv_map, outcome):
    """Assigns the normal map to the materials of the slots."""
    if not slots:
        low.data.materials.append(None)
        slots = [0]
    shown_anyway = next((layer.name for layer in low.data.uv_layers if layer.active_render), uv_map) == uv_map
    for material_slot in [low.material_slots[s] for s in slots]:
        if material_slot.material is None:
            material_slot.material = bpy.data.materials.new(low.name)
            outcome.notes.append(f"'{low.name}' had no material: '{material_slot.material.name}' was created")
        outcome.notes += nodes.assign(material_slot.material, image, "" if shown_anyway else uv_map)


def _notes_of(baked, name):
    """What the bake says of problem areas, its last warnings."""
    return [f"{name}: {line}" for line in baked.warnings[len(baked.warnings) - baked.problems :]]


def _store(settings, low, bake, work, uv_map, outcome):
    """Makes images of the maps that were written. Raises Refused."""
    for made in bake.maps:
        if made.kind not in work.written:
            continue
        frame = settings.frame if made.kind in ("normal", "bent-normal") else ""
        space = "sRGB" if made.kind in materials.COLORS else "Non-Color"
        image, named_otherwise = images.stored(made, work.files[made.kind], frame, space)
        if named_otherwise:
            outcome.notes.append(
                f"The map '{made.name}' of '{low.name}' is named '{image.name}', and its file {made.part}.png"
            )
        if work.baked[made.kind].ids:
            image["cotan_ids"] = {name: "#%02x%02x%02x" % color for name, color in work.baked[made.kind].ids.items()}
        outcome.made.append(image)
        if bake.first and made is bake.maps[0]:  # the same for all
            outcome.notes += _notes_of(work.baked[made.kind], image.name)
        if settings.assign and made.kind == "normal":
            _put(low, bake.slots, image, uv_map, outcome)
        outcome.notes += nodes.all_read_green_up(image) + frames.follow(image)


def run(context, settings, pairs, outcome):
    """A generator that bakes all pairs and yields the fraction done, 0 to 1. Closing it stops; finished maps stay."""
    for number, pair in enumerate(pairs):
        yield number / len(pairs)
        try:
            bakes, uv_map, notes = prepare(context, settings, pair)
            outcome.notes += notes
            for index, bake in enumerate(bakes):
                with tempfile.TemporaryDirectory() as folder:
                    files = {made.kind: made.path or os.path.join(folder, f"{made.part}.png") for made in bake.maps}
                    work = Work(bake.arguments, files)
                    try:
                        while work.is_alive():
                            work.join(0.02)
                            yield (number + (index + work.share) / len(bakes)) / len(pairs)
                    finally:
                        work.stop = True
                        work.join()
                    _store(settings, pair.low, bake, work, uv_map, outcome)
                    if work.error is not None:
                        raise work.error
        except Refused as error:
            outcome.failures.append(str(error))
        except packages().Error as error:
            outcome.failures.append(f"'{pair.low.name}': {error}")
        except MemoryError:
            outcome.failures.append(f"'{pair.low.name}': there is not enough memory for a map of this size")
