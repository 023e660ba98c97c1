"""Finds the detailed objects that belong to each simple one."""

import dataclasses

from .meshes import SOLID
from .refused import Refused, packages


@dataclasses.dataclass(frozen=True)
class Pair:
    low: object  # a Blender object
    highs: tuple
    cage: object = None  # a cage found by name, or None


def by_selection(context):
    """Pairs the active object with the other selected objects as its detailed ones. Returns the pair, and no notes."""
    low = context.view_layer.objects.active
    if low is None:
        raise Refused("No object is active: select the detailed meshes, then the simple one last")
    if low.type != "MESH":
        raise Refused(f"'{low.name}' is not a mesh: select the detailed meshes, then the simple one last")
    highs = tuple(o for o in context.selected_objects if o != low and o.type in SOLID | {"EMPTY"})
    if not highs:
        raise Refused("No detailed mesh is selected: select the detailed meshes, then the simple one last")
    return [Pair(low, highs)], []


def by_name(context):
    """Pairs each selected mesh x_low with the objects x_high; all meshes x_low if none is selected.

    Returns the pairs, and sentences on what the names leave open. The library decides which names belong together, for
    all visible meshes x_low, so that a selection changes no pair.
    """
    cotan = packages()
    every = sorted((o for o in context.view_layer.objects if o.visible_get()), key=lambda o: o.name)
    named = {role: [o for o in every if cotan.name_role(o.name) == role] for role in ("low", "high", "cage")}
    lows = [o for o in named["low"] if o.type == "MESH"]
    highs = [o for o in named["high"] if o.type in SOLID | {"EMPTY"}]
    cages = [o for o in named["cage"] if o.type == "MESH"]
    if not lows:
        raise Refused("No visible mesh is named like 'door_low'")
    names = [o.name for o in lows]
    of_low, notes = cotan.pair_names(names, [o.name for o in highs])
    cage_of_low, _ = cotan.pair_names(names, [o.name for o in cages])
    notes += [
        f"'{low.name}' has several cages: '{cages[caged[0]].name}' is used"
        for low, caged in zip(lows, cage_of_low)
        if len(caged) > 1
    ]
    some = any(o.select_get() for o in lows)
    return [
        Pair(low, tuple(highs[k] for k in own), next((cages[k] for k in caged), None))
        for low, own, caged in zip(lows, of_low, cage_of_low)
        if low.select_get() or not some
    ], notes
