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
    view = structs.ImageView()
    call("cotan_image_pixels", image, view)
    pixels = _memory_of(view)
    weakref.finalize(pixels, library().cotan_image_free, image.value)
    return _shaped(pixels, view)


def array_of_view(view):
    """A copied array of a cotan_image_view that the library owns."""
    return _shaped(_memory_of(view), view).copy()


def _memory_of(view):
    return (ctypes.c_uint8 * (view.width * view.height * view.bits // 2)).from_address(view.pixels)


def _shaped(pixels, view):
    return np.frombuffer(pixels, arrays.DTYPES[view.bits]).reshape(view.height, view.width, 4)


def is_path(given):
    return isinstance(given, (str, os.PathLike))
