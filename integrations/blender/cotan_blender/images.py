"""Baked maps as Blender images: packed into the .blend or in files beside it."""

import os

import bpy
import numpy as np

from .refused import Refused, packages


def pixels_of(image):
    """The pixels of an image, (height, width, 4), rows from the top: uint8, or float32 for more than 8 bits."""
    width, height = image.size
    values = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(values)
    values = values.reshape(height, width, 4)[::-1]
    return np.ascontiguousarray(values) if image.is_float else np.rint(values * 255).astype(np.uint8)


def file_for(settings, name):
    """The path for the map of this name, "" if it is packed. Raises Refused if the map cannot be saved there."""
    if settings.store != "FILE":
        return ""
    if settings.folder.startswith("//") and not bpy.data.filepath:
        raise Refused("The maps' folder is beside the .blend file, which is not saved yet: save it, or choose a folder")
    folder = bpy.path.abspath(settings.folder)
    if not os.path.isdir(folder):
        raise Refused(f"There is no folder '{folder}' for the maps")
    path = os.path.join(folder, bpy.path.clean_name(name) + ".png")
    ours = bpy.data.images.get(name)
    known = ours is not None and bpy.path.abspath(ours.filepath) == path
    if os.path.exists(path) and not known and not settings.overwrite:
        raise Refused(f"'{path}' already exists: choose another folder, or enable Replace Files")
    return path


def stored(name, file, packed, frame):
    """Loads a map as an image and replaces all uses of an image of the same name. packed: packs the file into the
    .blend, so that it may be deleted. Raises Refused if Blender cannot read the file."""
    old = bpy.data.images.get(name)
    try:
        image = bpy.data.images.load(file)
        image.colorspace_settings.name = "Non-Color"
        if packed:
            image.pack()
            image.filepath_raw = f"//{bpy.path.clean_name(name)}.png"
        elif bpy.data.filepath and file.startswith(os.path.dirname(bpy.data.filepath) + os.sep):
            image.filepath_raw = bpy.path.relpath(file)  # moves with the .blend
    except RuntimeError as error:
        raise Refused(f"Blender cannot read the map of '{name}': {str(error).strip()}") from None
    if old is not None and old.library is None:
        old.user_remap(image)
        bpy.data.images.remove(old)
    image.name = name
    image["cotan_frame"] = frame
    return image


def with_green_reversed(image, path):
    """A new image of the file `path`, which gets the pixels of `image` with green reversed."""
    pixels = pixels_of(image)
    if image.is_float:
        pixels = np.rint(np.clip(pixels, 0, 1) * 65535).astype(np.uint16)
    packages().write_picture(path, packages().map_convert(pixels, "directx", "gltf"))
    copy = bpy.data.images.load(path)
    copy.colorspace_settings.name = "Non-Color"
    copy.name = image.name  # Blender adds a number
    return copy
