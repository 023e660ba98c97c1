"""Normal maps as arrays.

An image is an array (height, width, 4) of uint8, uint16 or float32: red, green, blue, alpha, rows from the top. Images
with three channels or one are also accepted and copied to four channels, and so are paths of image files. A convention
is a list of words: "gltf", "directx", "unity,xy". Two channels are found wherever they are; a map whose blue is the
middle code everywhere, as readers of two channels leave it, has two.

The number that stands for zero depends on the dtype: 128 in uint8, 32768 in uint16, and **0.5 in float32**, where 0 and
1 stand for -1 and 1. With "signed" in the convention, floats stand for themselves; with "biased", zero is 127.5 and
32767.5 in integers. So an 8-bit map divided by 255 is not the same map in floats: its zero is 128 / 255 = 0.50196. Make
floats with `map_convert(map, source, to, bits=32)`. Floats outside the range and NaN are refused.
"""

import dataclasses
from typing import Literal, NamedTuple, Optional, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays as arrays
from . import _structs as structs
from ._handles import array_of_view
from ._library import call, taken
from .images import Path, pixels_of
from .words import BlendMode, Compress, Container, Convention, Swizzle

Pixels = NDArray[np.generic]
Map = Union[ArrayLike, Path]


@dataclasses.dataclass(frozen=True)
class Green:
    """Which way green of a normal map points, judged by the map alone.

    Attributes:
        green: "up" (OpenGL, glTF), "down" (DirectX) or "undecidable".
        swapped: whether red and green are swapped; None if unknown.
        confidence: "none", "likely" or "certain".
        agreement: the correlation on which the verdict is based, -1 to 1.
        reason: one sentence.
    """

    green: Literal["up", "down", "undecidable"]
    swapped: Optional[bool]
    confidence: Literal["none", "likely", "certain"]
    agreement: float
    reason: str


@dataclasses.dataclass(frozen=True)
class MapInfo:
    """Statistics of an image, read as a normal map. Fractions are 0 to 1.

    Attributes:
        content: a few words, such as "tangent space" or "one value everywhere".
        zero: the code of 255 that stands for zero: 128, 127 (for 127.5), or None if unknown.
        transfer: "linear"; "srgb": encoded like a colour; "linearised": decoded like a colour when it was read.
        background: fraction outside the charts, which all other statistics exclude.
        invalid: fraction of texels that are not a direction.
        below_horizon: fraction of texels with z below 0.
        mean_length: mean length of the decoded vectors.
        mean_tilt: mean angle to (0, 0, 1) in degrees.
        mean: mean vector x, y, z, green up.
    """

    content: str
    zero: Optional[int]
    transfer: Literal["linear", "srgb", "linearised"]
    background: float
    invalid: float
    below_horizon: float
    mean_length: float
    mean_tilt: float
    mean: tuple[float, float, float]


class Level(NamedTuple):
    """A level of `map_mips`: the map, and the roughness (grey) that compensates for the averaging of normals."""

    map: Pixels
    roughness: Pixels


@dataclasses.dataclass(frozen=True)
class Texture:
    """What `map_texture` makes.

    Attributes:
        data: the bytes of the file.
        levels: how many it has.
        mean_degrees, percentile99_degrees: angles between the map and the largest level as it is read, on average and
            for 99 % of the texels; None if this build cannot decode the format.
    """

    data: bytes = dataclasses.field(repr=False)
    levels: int
    mean_degrees: Optional[float]
    percentile99_degrees: Optional[float]


def detect(map: Map) -> Green:
    """Detects which way green of a tangent-space normal map points. map: an image."""
    pixels, green = pixels_of(map), structs.CGreen()
    call("cotan_map_green", arrays.image_view(pixels), green)
    return Green(
        green={1: "up", -1: "down"}.get(green.direction, "undecidable"),
        swapped=None if green.swapped < 0 else bool(green.swapped),
        confidence=("none", "likely", "certain")[green.confidence],
        agreement=green.agreement,
        reason=green.reason.decode(),
    )


def describe(map: Map) -> MapInfo:
    """Statistics of an image, read as a normal map."""
    pixels, info = pixels_of(map), structs.CMapInfo()
    call("cotan_map_describe", arrays.image_view(pixels), info)
    return MapInfo(
        content=info.content.decode(),
        zero=info.zero or None,
        transfer={1: "srgb", -1: "linearised"}.get(info.srgb, "linear"),
        background=info.background,
        invalid=info.invalid,
        below_horizon=info.below_horizon,
        mean_length=info.mean_length,
        mean_tilt=info.mean_tilt,
        mean=tuple(info.mean),
    )


def _like(pixels, bits, out):
    """The array for a result of the same size as `pixels`."""
    dtype = pixels.dtype if bits is None else arrays.dtype_of(bits)
    if out is not None and bits is None and isinstance(out, np.ndarray) and out.dtype in arrays.BITS:
        dtype = out.dtype
    return arrays.made(out, "out", (*pixels.shape[:2], 4), dtype)


def map_convert(
    map: Map, source: Convention, to: Convention, bits: Optional[int] = None, out: Optional[Pixels] = None
) -> Pixels:
    """Converts a map from one convention to another.

    Args:
        map: an image; in float32 0.5 stands for zero, which is not 128 / 255.
        source, to: conventions: "directx", "gltf", ...; both in tangent space or both in object space. source may have
            the words for broken maps, "gltf,srgb", or be "auto": what `detect` finds, and repaired.
        bits: bit depth of the result: 8, 16 or 32. Default: that of the map.
        out: an image of the map's size to write into.

    Raises InputError for NaN, for floats outside the range of `source`, and if "auto" cannot tell green.
    """
    pixels = pixels_of(map)
    arrays.stored(pixels, source, "map")
    out = _like(pixels, bits, out)
    call(
        "cotan_map_convert", arrays.image_view(pixels), arrays.encoded(source, "source"), arrays.encoded(to, "to"),
        arrays.image_view(out),
    )  # fmt: skip
    return out


def map_from_height(
    height: Map,
    scale_x: float,
    scale_y: Optional[float] = None,
    to: Convention = "gltf,exact",
    bits: int = 8,
    out: Optional[Pixels] = None,
) -> Pixels:
    """Makes a normal map from heights (height, width) or from red of an image. Heights repeat at the borders.

    Args:
        scale_x, scale_y: slope per unit of stored height and texel: for w metres across `width` texels and r metres
            from 0 to 1 (of 8 and 16 bits: the full range), r * width / w. Default of scale_y: scale_x.
        to: the convention of the map.
        bits: bit depth of the map: 8, 16 or 32.
    """
    pixels = pixels_of(height, "height")
    arrays.finite(pixels, "height")
    out = arrays.made(out, "out", pixels.shape, arrays.dtype_of(bits))
    scale_x = arrays.number(scale_x, "scale_x")
    scale_y = scale_x if scale_y is None else arrays.number(scale_y, "scale_y")
    given = arrays.image_view(pixels)
    call("cotan_map_from_height", given, scale_x, scale_y, arrays.encoded(to, "to"), arrays.image_view(out))
    return out


def map_to_height(map: Map, source: Convention = "gltf,exact") -> NDArray[np.float32]:
    """Heights (height, width) float32, in texel widths, mean 0, whose slopes are nearest to those of the map."""
    pixels = pixels_of(map)
    arrays.stored(pixels, source, "map")
    heights = np.empty(pixels.shape[:2], np.float32)
    call("cotan_map_to_height", arrays.image_view(pixels), arrays.encoded(source, "source"), arrays.at(heights))
    return heights


def map_blend(
    base: Map,
    detail: Map,
    convention: Convention = "gltf,exact",
    mode: BlendMode = "reoriented",
    strength: float = 1.0,
    bits: Optional[int] = None,
    out: Optional[Pixels] = None,
) -> Pixels:
    """Blends a detail map over a base map. All maps have the size of the base and the same convention.

    mode: "reoriented", "whiteout", "udn", "slopes" or "linear". strength: factor on the detail's slopes.
    """
    under, over = pixels_of(base, "base"), pixels_of(detail, "detail")
    for pixels, field in ((under, "base"), (over, "detail")):
        arrays.stored(pixels, convention, field)
    out = _like(under, bits, out)
    call(
        "cotan_map_blend", arrays.image_view(under), arrays.image_view(over), arrays.encoded(convention, "convention"),
        arrays.encoded(mode, "mode"), arrays.number(strength, "strength"), arrays.image_view(out),
    )  # fmt: skip
    return out


def map_mips(map: Map, convention: Convention = "gltf,exact", roughness: float = 0.3) -> list[Level]:
    """Mip levels, filtered as vectors: the map's own size first, 1 x 1 last.

    roughness: roughness of the material, 0 to 1.
    """
    levels: list[Level] = []
    failures: list[BaseException] = []
    pixels = pixels_of(map)
    arrays.stored(pixels, convention, "map")

    def take(_, number, level, rough):
        try:
            levels.append(Level(array_of_view(level[0]), array_of_view(rough[0])))
            return 0
        except BaseException as error:  # exceptions must not pass through the library
            failures.append(error)
            return 1

    try:
        call(
            "cotan_map_mips", arrays.image_view(pixels), arrays.encoded(convention, "convention"),
            arrays.number(roughness, "roughness"), structs.TakeLevel(take), None,
        )  # fmt: skip
    except Exception:
        if failures:
            raise failures[0] from None
        raise
    return levels


def map_texture(
    map: Map,
    source: Convention = "gltf,exact",
    to: Optional[Convention] = None,
    compress: Compress = "none",
    swizzle: Swizzle = "auto",
    container: Container = "ktx2",
    mips: bool = True,
    frame: Optional[str] = None,
) -> Texture:
    """A texture for GPUs: the file that `cotan map convert` writes with the same words, byte for byte.

    Args:
        map: an image.
        source, to: conventions of the map, as for `map_convert`, and of the texture. Default of to: source.
        compress: the format of the blocks; "none" stores pixels of 8 bits.
        swizzle: where a map of two channels has x and y; "auto": where engines expect them.
        container: "ktx2" or "dds", which has BC formats and pixels only.
        mips: all levels to 1 x 1, filtered as vectors; False: the largest only.
        frame: the frame that the map was made for, which KTX2 stores.
    """
    pixels = pixels_of(map)
    arrays.stored(pixels, source, "map")
    words = {"from": source, "to": source if to is None else to, "compress": compress, "swizzle": swizzle,
             "container": container}  # fmt: skip
    words = {name: arrays.encoded(word, "source" if name == "from" else name) for name, word in words.items()}
    options = structs.TextureOptions(
        **words, frame=None if frame is None else arrays.encoded(frame, "frame"), mips=int(bool(mips))
    )
    made, result = structs.handle(), structs.TextureResult()
    call("cotan_map_texture", arrays.image_view(pixels), options, result, made)
    degrees = [None if d < 0 else d for d in (result.mean_degrees, result.percentile99_degrees)]
    return Texture(taken(made), result.levels, *degrees)
