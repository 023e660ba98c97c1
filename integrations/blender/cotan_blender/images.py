"""Baked maps as Blender images: packed into the .blend or in files beside it."""

import os

import bpy
import numpy as np

from .refused import Refused, packages


def pixels_of(image):
    """The pixels of an image, (height, width, 4), rows from the top: uint8, or float32 for more than 8 bits. Raises Refused
    if it has none."""
    width, height = image.size
    if width == 0 or height == 0:
        raise Refused(f"'{image.name}' has no pixels, or its file is missing")
    values = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(height, width, 4)[::-1]
    return np.ascontiguousarray(values) if image.is_float else np.rint(values * 255).astype(np.uint8)


def _before(owner, name):
    """The image of an earlier bake of this map, None if there is none. owner: text that is the same for each bake of it;
    images of older versions of the add-on have none, and are found by their name."""
    named = bpy.data.images.get(name)
    return next(
        (image for image in bpy.data.images if image.get("cotan_of") == owner),
        named if named is not None and "cotan_of" not in named else None,
    )


def _free(name):
    """The name, cut to the length that Blender allows; with a number if another image has it, which would lose it."""
    number, base = 0, name.encode()[:59].decode(errors="ignore")
    free = name if len(name.encode()) < 64 else base
    while bpy.data.images.get(free) is not None:
        number += 1
        free = f"{base}.{number:03}"
    return free


def part_for(owner, name, others=()):
    """The name of the map's file, without folder and ending. It differs from those of other maps; others: maps to come."""
    before = _before(owner, name)
    if before is not None and "cotan_part" in before:
        return before["cotan_part"]
    taken = [image["cotan_part"] for image in bpy.data.images if "cotan_part" in image]
    return packages().file_names([name], [*taken, *others])[0]


def file_for(settings, owner, name, part):
    """The path for a map, "" if it is packed. Raises Refused if the map cannot be saved there."""
    if settings.store != "FILE":
        return ""
    if settings.folder.startswith("//") and not bpy.data.filepath:
        raise Refused("The maps' folder is beside the .blend file, which is not saved yet: save it, or choose a folder")
    folder = bpy.path.abspath(settings.folder)
    if not os.path.isdir(folder):
        raise Refused(f"There is no folder '{folder}' for the maps")
    path = os.path.join(folder, part + ".png")
    ours = _before(owner, name)
    known = ours is not None and bpy.path.abspath(ours.filepath) == path
    if os.path.exists(path) and not known and not settings.overwrite:
        raise Refused(f"'{path}' already exists: choose another folder, or enable Replace Files")
    return path


def stored(made, file, frame, space="Non-Color"):
    """Loads a map as an image and replaces all uses of the image of an earlier bake. A map without a path is packed into
    the .blend, so that the file may be deleted. Returns the image, and whether it or its file has another name than the
    map, because another map has it or it is too long. frame: that the map is for; "": none. space: of its colours. Raises
    Refused if Blender cannot read the file."""
    old, name = _before(made.owner, made.name), made.name
    try:
        image = bpy.data.images.load(file)
        image.colorspace_settings.name = space
        if not made.path:
            image.pack()
            image.filepath_raw = f"//{made.part}.png"
        elif bpy.data.filepath and file.startswith(os.path.dirname(bpy.data.filepath) + os.sep):
            image.filepath_raw = bpy.path.relpath(file)  # moves with the .blend
    except RuntimeError as error:
        raise Refused(f"Blender cannot read the map of '{name}': {str(error).strip()}") from None
    if old is not None and old.library is None:
        name = old.name
        old.user_remap(image)
        bpy.data.images.remove(old)
    image.name = name if old is not None else _free(name)
    image["cotan_of"], image["cotan_part"] = made.owner, made.part
    if frame:
        image["cotan_frame"] = frame
    numbered = image.name != made.name or made.part != packages().file_names([made.name])[0]
    return image, old is None and numbered


def with_green_reversed(image, path):
    """A new image of the file `path`, which gets the pixels of `image` with green reversed."""
    pixels = pixels_of(image)
    if image.is_float:
        pixels = np.rint(np.clip(pixels, 0, 1) * 65535).astype(np.uint16)
    packages().write_image(path, packages().map_convert(pixels, "directx,biased", "gltf"))
    copy = bpy.data.images.load(path)
    copy.colorspace_settings.name = "Non-Color"
    copy.name = image.name  # Blender adds a number
    return copy
