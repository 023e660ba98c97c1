"""What the library has made and Python holds."""

import ctypes
import os
import weakref

import numpy as np

from . import _arrays as arrays
from . import _structs as structs
from ._library import call, library


def array_of(image):
    """A picture of the library, a handle, as an array over its own pixels; freed with the last view of them."""
    picture = structs.Picture()
    call("cotan_image_picture", image, picture)
    count = picture.width * picture.height * 4 * picture.bits // 8
    pixels = (ctypes.c_uint8 * count).from_address(picture.pixels)
    weakref.finalize(pixels, library().cotan_image_free, image.value)
    return np.frombuffer(pixels, arrays.DTYPES[picture.bits]).reshape(picture.height, picture.width, 4)


def is_path(given):
    return isinstance(given, (str, os.PathLike))
