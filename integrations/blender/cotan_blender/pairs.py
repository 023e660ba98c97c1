"""Which detailed objects belong to which simple one."""

import dataclasses
import re

from .meshes import SOLID
from .refused import Refused

# "door_low", "door.high.001", "door_hi_bolts": stem, word, and what follows.
_NAME = re.compile(r"^(?P<stem>.+?)[._ -](?P<word>low|lo|high|hi|cage)(?P<rest>(?:[._ -].*)?)$", re.IGNORECASE)


@dataclasses.dataclass(frozen=True)
class Pair:
    low: object  # of Blender
    highs: tuple
    cage: object = None  # by name; None: there is none


def parts(name):
    """("door", "low", ".001") of "door_low.001"; the word is "low", "high", "cage" or None. All in small letters."""
    found = _NAME.match(name)
    if not found:
        return name.lower(), None, ""
    word = {"lo": "low", "hi": "high"}.get(found["word"].lower(), found["word"].lower())
    return found["stem"].lower(), word, found["rest"].lower()


def by_selection(context):
    """The selected objects onto the active one."""
    low = context.view_layer.objects.active
    if low is None:
        raise Refused("Nothing is active: select the detailed meshes, then the simple one last")
    if low.type != "MESH":
        raise Refused(f"'{low.name}' is not a mesh: select the detailed meshes, then the simple one last")
    highs = tuple(o for o in context.selected_objects if o != low and o.type in SOLID | {"EMPTY"})
    if not highs:
        raise Refused("No detailed mesh is selected: select the detailed meshes, then the simple one last")
    return [Pair(low, highs)]


def by_name(context):
    """Each selected mesh x_low with what is named x_high or x_hi; all of them where none is selected."""
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
        if rest:  # "door_low.001": what has the same ending, if anything has
            highs = [o for o in highs if parts(o.name)[2] == rest] or highs
            cages = [o for o in cages if parts(o.name)[2] == rest] or cages
        found.append(Pair(low, tuple(highs), cages[0] if cages else None))
    return found
