"""Pictures in files."""

import os
from typing import Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays as arrays
from . import _structs as structs
from ._handles import array_of, is_path
from ._library import call

Path = Union[str, os.PathLike[str]]


def read_picture(file: Path, memory: int = 640) -> NDArray[np.generic]:
    """A picture file as it is stored: (height, width, 4) of uint8, uint16 or float32, rows from the top.

    No colours are converted; grey is repeated, a missing alpha is full. memory: that it may take, in MiB.
    Raises InputError for a missing or broken file or one over the limit, UnavailableError for a format that is not read
    here.
    """
    image = structs.handle()
    call("cotan_image_read", arrays.encoded(file, "file"), arrays.memory_of(memory), image, files=(file,))
    return array_of(image)


def write_picture(file: Path, picture: ArrayLike) -> None:
    """Writes .png, and with OpenImageIO .exr, .tif, .tga, .jpg and .hdr; whole or not at all.

    picture: (height, width, 4), (height, width, 3) or (height, width) of uint8, uint16 or float32. PNG takes floats
    clamped to 0 to 1, with 8 bits. Raises OutputError, UsageError for an extension that nothing writes.
    """
    pixels = arrays.pixels(picture, "picture")
    call("cotan_image_write", arrays.encoded(file, "file"), arrays.picture(pixels), files=(file,))


def pixels_of(given, field="map"):
    """An array as `_arrays.pixels` makes it, or the picture file of that name."""
    return read_picture(given) if is_path(given) else arrays.pixels(given, field)
