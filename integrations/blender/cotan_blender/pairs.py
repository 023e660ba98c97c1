"""Finds the detailed objects that belong to each simple one."""

import dataclasses
import re

from .meshes import SOLID
from .refused import Refused

# "door_low", "door.high.001", "door_hi_bolts": stem, word, and rest.
_NAME = re.compile(r"^(?P<stem>.+?)[._ -](?P<word>low|lo|high|hi|cage)(?P<rest>(?:[._ -].*)?)$", re.IGNORECASE)


@dataclasses.dataclass(frozen=True)
class Pair:
    low: object  # a Blender object
    highs: tuple
    cage: object = None  # a cage found by name, or None


def parts(name):
    """("door", "low", ".001") for "door_low.001", in lower case. The word is "low", "high", "cage" or None."""
    found = _NAME.match(name)
    if not found:
        return name.lower(), None, ""
    word = {"lo": "low", "hi": "high"}.get(found["word"].lower(), found["word"].lower())
    return found["stem"].lower(), word, found["rest"].lower()


def by_selection(context):
    """Pairs the active object with the other selected objects as its detailed ones."""
    low = context.view_layer.objects.active
    if low is None:
        raise Refused("No object is active: select the detailed meshes, then the simple one last")
    if low.type != "MESH":
        raise Refused(f"'{low.name}' is not a mesh: select the detailed meshes, then the simple one last")
    highs = tuple(o for o in context.selected_objects if o != low and o.type in SOLID | {"EMPTY"})
    if not highs:
        raise Refused("No detailed mesh is selected: select the detailed meshes, then the simple one last")
    return [Pair(low, highs)]


def by_name(context):
    """Pairs each selected mesh x_low with the objects x_high or x_hi; all meshes x_low if none is selected."""
    every = [o for o in context.view_layer.objects if o.visible_get()]
    lows = [o for o in every if o.type == "MESH" and parts(o.name)[1] == "low"]
    lows = [o for o in lows if o.select_get()] or lows
    if not lows:
        raise Refused("No visible mesh is named like 'door_low'")
    found = []
    for low in sorted(lows, key=lambda o: o.name):
        stem, _, rest = parts(low.name)
        named = {word: [o for o in every if parts(o.name)[:2] == (stem, word)] for word in ("high", "cage")}
        highs = [o for o in named["high"] if o.type in SOLID | {"EMPTY"}]
        cages = [o for o in named["cage"] if o.type == "MESH"]
        if rest:  # "door_low.001": objects with the same ending, if there are any
            highs = [o for o in highs if parts(o.name)[2] == rest] or highs
            cages = [o for o in cages if parts(o.name)[2] == rest] or cages
        found.append(Pair(low, tuple(highs), cages[0] if cages else None))
    return found
