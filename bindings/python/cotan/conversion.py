"""Conversion in two steps, for callers that encode images themselves, later or in parallel; and the encoded images of a
model."""

import ctypes
import json
import weakref
from typing import Mapping, Optional, Union

import numpy as np
from numpy.typing import NDArray

from . import _arrays as arrays
from . import _old_names
from . import _structs as structs
from ._handles import array_of_view
from ._library import call, library, taken
from ._work import Progress, long_call
from .models import (
    Bytes,
    Converted,
    Decode,
    Source,
    check_tangents,
    convert_options,
    converted_of,
)
from .images import Path
from .words import Expansion, Frame, TangentOrigin


def model_images(
    model: Union[Path, Bytes], maps_only: bool = False, beside: Optional[Mapping[str, bytes]] = None
) -> list[tuple[str, bytes]]:
    """Names and encoded files (PNG, JPEG, ...) of the images in a glTF model that are decoded to lint it.

    model: a path or bytes. maps_only: only images that are decoded to convert it. beside: files that a model in bytes
    references.
    """
    source, found = Source(model, beside), []

    def take(_, name, data, size):
        found.append((name.decode("utf-8", "replace"), ctypes.string_at(data, size)))
        return 0

    source.call("cotan_gltf_images", int(maps_only), structs.TakeFile(take), None)
    return found


class Conversion:
    """`convert` in two steps: the first makes the new maps; after they are encoded as PNG, the second makes the model.

        conversion = cotan.Conversion("model.glb", to_frame="smooth")
        for number, image in enumerate(conversion.images):
            conversion.set(number, png_of(image))
        converted = conversion.end()

    Attributes:
        images: the images to encode, (height, width, 4) of uint8 or uint16 each.
    """

    def __init__(
        self,
        model: Union[Path, Bytes],
        to_frame: Optional[Frame] = None,
        from_frame: Optional[Frame] = None,
        tangents: TangentOrigin = "stored",
        keep_tangents: bool = False,
        bits: int = 0,
        threads: int = 0,
        progress: Optional[Progress] = None,
        beside: Optional[Mapping[str, bytes]] = None,
        decode: Optional[Decode] = None,
        unsigned: Expansion = "biased",
        keep_maps: bool = False,
        max_degrees: float = 0.3,
    ) -> None:
        """Arguments and errors are those of `convert`."""
        check_tangents(tangents)
        source = Source(model, beside, decode)
        self._result, self._handle = structs.ConvertResult(), structs.handle()

        def work(told):
            options = convert_options(
                to_frame, from_frame, tangents, keep_tangents, bits, threads, told, unsigned, keep_maps, max_degrees
            )
            source.call("cotan_convert_begin", options, self._result, self._handle)

        long_call(work, progress)
        weakref.finalize(self, library().cotan_conversion_free, self._handle.value)
        self.images: list[NDArray[np.generic]] = []
        for number in range(library().cotan_conversion_count(self._handle)):
            view = structs.ImageView()
            call("cotan_conversion_image", self._handle, number, view)
            self.images.append(array_of_view(view))

    pictures = _old_names.attribute("pictures", "images")

    def set(self, number: int, png: bytes) -> None:
        """Sets the PNG file of image `number`, once."""
        if not 0 <= number < len(self.images):
            raise arrays.wrong("number", f"0 to {len(self.images) - 1}", number)
        array = np.frombuffer(png, np.uint8)
        call("cotan_conversion_set", self._handle, number, arrays.at(array), array.nbytes)

    def end(self) -> Converted:
        """Returns the model as bytes. Raises UsageError if a PNG file is missing."""
        glb, text = structs.handle(), structs.handle()
        call("cotan_convert_end", self._handle, glb, text)
        return converted_of(self._result, taken(glb), json.loads(taken(text)))
