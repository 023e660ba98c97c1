"""Reads and writes image files, and names them."""

import ctypes
import os
from typing import Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays as arrays
from . import _old_names
from . import _structs as structs
from ._handles import array_of, is_path
from ._library import call
from ._library import taken as taken_bytes

Path = Union[str, os.PathLike[str]]


def read_image(file: Path, memory: int = 640) -> NDArray[np.generic]:
    """Reads an image file as array (height, width, 4) of uint8, uint16 or float32, rows from the top.

    Colours are not converted; grey is repeated, missing alpha is opaque. memory: maximum size, in MiB. Raises
    InputError for a missing or broken file or one over the limit, UnavailableError for a format that this build cannot
    read.
    """
    image = structs.handle()
    call("cotan_image_read", arrays.encoded(file, "file"), arrays.memory_of(memory), image, files=(file,))
    return array_of(image)


@_old_names.keyword("picture", "image")
def write_image(file: Path, image: ArrayLike) -> None:
    """Writes .png, and with OpenImageIO .exr, .tif, .tga, .jpg and .hdr, atomically.

    image: (height, width, 4), (height, width, 3) or (height, width) of uint8, uint16 or float32. PNG stores floats
    with 8 bits, clamped to 0 to 1. Raises OutputError, UsageError for an unknown extension.
    """
    pixels = arrays.pixels(image, "image")
    call("cotan_image_write", arrays.encoded(file, "file"), arrays.image_view(pixels), files=(file,))


def file_names(names: Sequence[str], taken: Sequence[str] = ()) -> list[str]:
    """Parts of file names for names of objects, materials or images.

    They are 1 to about 64 bytes long, and neither leave a folder nor mean a device on any file system. All differ, also where
    case is ignored, from one another and from `taken`: "a b" and "a_b" become "a_b-2" and "a_b".
    """
    made = structs.handle()
    lists = [(ctypes.c_char_p * len(n))(*(arrays.encoded(name, what) for name in n))
             for n, what in ((names, "names"), (taken, "taken"))]  # fmt: skip
    call("cotan_file_names", len(names), lists[0], len(taken), lists[1], made)
    return taken_bytes(made).decode().split("\n")[:-1]


def pixels_of(given, field="map"):
    """The image of an array, by `_arrays.pixels`, or of an image file."""
    return read_image(given) if is_path(given) else arrays.pixels(given, field)
