"""Baked maps as images of Blender: packed into the .blend, or files beside it."""

import os
import struct
import zlib

import bpy
import numpy as np

from .refused import Refused


def png16(pixels):
    """The bytes of a PNG of 16 bits. pixels: (height, width, 4) of uint16; alpha is left out."""
    height, width = pixels.shape[:2]
    rows = pixels[:, :, :3].astype(">u2").view(np.uint8).reshape(height, 6 * width)
    # Each byte less the same one of the texel to the left (filter 1).
    lines = np.empty((height, 6 * width + 1), np.uint8)
    lines[:, 0], lines[:, 1:7], lines[:, 7:] = 1, rows[:, :6], rows[:, 6:] - rows[:, :-6]

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 16, 2, 0, 0, 0)
    data = zlib.compress(lines, 1)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def floats_of(pixels):
    """What image.pixels takes, rows from the bottom. pixels: (height, width, 4) of uint8, rows from the top."""
    return np.multiply(pixels[::-1], np.float32(1 / 255), dtype=np.float32).reshape(-1)


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
        raise Refused("The maps' folder is beside the .blend file, which is not saved yet: save it, or choose another folder")
    folder = bpy.path.abspath(settings.folder)
    if not os.path.isdir(folder):
        raise Refused(f"There is no folder '{folder}' for the maps")
    path = os.path.join(folder, bpy.path.clean_name(name) + ".png")
    ours = bpy.data.images.get(name)
    known = ours is not None and bpy.path.abspath(ours.filepath) == path
    if os.path.exists(path) and not known and not settings.overwrite:
        raise Refused(f"'{path}' is there already: choose another folder, or let files be replaced")
    return path


def _replaced(name, make):
    """A new image in the place of one with that name, for all who use it."""
    old = bpy.data.images.get(name)
    new = make()
    if old is not None and old.library is None:
        old.user_remap(new)
        bpy.data.images.remove(old)
    new.name = name
    new.colorspace_settings.name = "Non-Color"
    return new


def stored(name, baked, floats, path, frame):
    """The image of a baked map. baked: (height, width, 4) of uint8 or uint16; floats: floats_of(it) for uint8;
    path: file, or "" for a packed one. Raises Refused where the file cannot be written."""
    try:
        image = _of_16_bits(name, baked, path) if baked.dtype == np.uint16 else _of_8_bits(name, baked, floats, path)
    except (OSError, RuntimeError) as error:
        raise Refused(f"'{path or name}' cannot be written: {getattr(error, 'strerror', None) or error}") from None
    image["cotan_frame"] = frame
    return image


def _of_8_bits(name, baked, floats, path):
    height, width = baked.shape[:2]
    image = _replaced(name, lambda: bpy.data.images.new(name, width, height, alpha=False, float_buffer=False))
    image.pixels.foreach_set(floats)
    image.update()
    image.file_format = "PNG"
    if path:
        image.filepath_raw = path
        image.save()
    else:
        image.pack()
    return image


def _of_16_bits(name, baked, path):
    data = png16(baked)
    if path:
        with open(path, "wb") as file:
            file.write(data)
        return _replaced(name, lambda: bpy.data.images.load(path))

    def packed():
        image = bpy.data.images.new(name, 8, 8)
        image.source = "FILE"
        image.filepath_raw = f"//{bpy.path.clean_name(name)}.png"
        image.pack(data=data, data_len=len(data))
        return image

    return _replaced(name, packed)
