"""Images that the library owns, as arrays."""

import ctypes
import os
import weakref

import numpy as np

from . import _arrays as arrays
from . import _structs as structs
from ._library import call, library


def array_of(image):
    """An array over the pixels of an image handle of the library, which is freed with the last view of the array."""
    picture = structs.Picture()
    call("cotan_image_picture", image, picture)
    pixels = _memory_of(picture)
    weakref.finalize(pixels, library().cotan_image_free, image.value)
    return _shaped(pixels, picture)


def array_of_picture(picture):
    """A copied array of a cotan_picture that the library owns."""
    return _shaped(_memory_of(picture), picture).copy()


def _memory_of(picture):
    return (ctypes.c_uint8 * (picture.width * picture.height * picture.bits // 2)).from_address(picture.pixels)


def _shaped(pixels, picture):
    return np.frombuffer(pixels, arrays.DTYPES[picture.bits]).reshape(picture.height, picture.width, 4)


def is_path(given):
    return isinstance(given, (str, os.PathLike))
