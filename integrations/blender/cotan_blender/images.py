"""Baked maps as images of Blender: packed into the .blend, or files beside it."""

import os

import bpy
import numpy as np

from .refused import Refused


def pixels_of(image):
    """(height, width, 4) of an image, rows from the top: uint8, or float32 where the image has more than 8 bits."""
    width, height = image.size
    values = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(height, width, 4)[::-1]
    return np.ascontiguousarray(values) if image.is_float else np.rint(values * 255).astype(np.uint8)


def file_for(settings, name):
    """Where the map of that name is saved, "" for a packed one. Raises Refused where it cannot be."""
    if settings.store != "FILE":
        return ""
    if settings.folder.startswith("//") and not bpy.data.filepath:
        raise Refused("The maps' folder is beside the .blend file, which is not saved yet: save it, or choose another")
    folder = bpy.path.abspath(settings.folder)
    if not os.path.isdir(folder):
        raise Refused(f"There is no folder '{folder}' for the maps")
    path = os.path.join(folder, bpy.path.clean_name(name) + ".png")
    ours = bpy.data.images.get(name)
    known = ours is not None and bpy.path.abspath(ours.filepath) == path
    if os.path.exists(path) and not known and not settings.overwrite:
        raise Refused(f"'{path}' is there already: choose another folder, or let files be replaced")
    return path


def stored(name, file, packed, frame):
    """The image of a map in a file, in the place of one with that name for all who use it. packed: the file goes away,
    and its bytes into the .blend. Raises Refused where Blender cannot read it."""
    old = bpy.data.images.get(name)
    try:
        image = bpy.data.images.load(file)
        image.colorspace_settings.name = "Non-Color"
        if packed:
            image.pack()
            image.filepath_raw = f"//{bpy.path.clean_name(name)}.png"
        elif bpy.data.filepath and file.startswith(os.path.dirname(bpy.data.filepath) + os.sep):
            image.filepath_raw = bpy.path.relpath(file)  # goes where the .blend goes
    except RuntimeError as error:
        raise Refused(f"Blender cannot read the map of '{name}': {str(error).strip()}") from None
    if old is not None and old.library is None:
        old.user_remap(image)
        bpy.data.images.remove(old)
    image.name = name
    image["cotan_frame"] = frame
    return image
