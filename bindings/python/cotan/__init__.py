"""Cotan: normal mapping without precomputed tangents.

    import cotan
    baked = cotan.bake(low, high, size=2048, frame="smooth")     # cotan.Mesh of numpy arrays, or paths
    report = cotan.lint("model.glb")                             # degrees, in a dataclass
    cotan.convert("model.glb", "out.glb", to_frame="smooth")
    image = cotan.render("model.glb", size=(640, 360), frame="smooth")
    green = cotan.detect(map).green                              # "up", "down" or "undecidable"

Arrays are passed without copies if dtype and layout fit (float32, uint32, C order). Long calls release the GIL, call
`progress` on the calling thread, and end at Ctrl-C. All errors are of type `cotan.Error`.
"""

from . import _old_names
from ._library import library_path, library_version
from ._version import __version__
from .baking import Baked, bake, bake_maps, name_role, pair_names
from .conversion import Conversion, model_images
from .errors import (
    Error,
    InputError,
    LimitError,
    MissingFileError,
    OutputError,
    StoppedError,
    UnavailableError,
    UsageError,
)
from .geometry import (
    Mesh,
    frame_apply,
    frame_encode,
    frames,
    pack_smooth4,
    pack_smooth8,
    pack_tangents,
    pack_triangles,
    provoking,
    smooth_cotangents,
    split_mirrored,
    split_vertices,
    tangents,
    triangle_vectors,
    vertex_frame_apply,
    vertex_frame_encode,
)
from .images import file_names, read_image, write_image
from .maps import (
    Green,
    Level,
    MapInfo,
    Texture,
    describe,
    detect,
    map_blend,
    map_convert,
    map_from_height,
    map_mips,
    map_texture,
    map_to_height,
)
from .models import Converted, Lint, Model, convert, lint, load
from .rendering import render
from .shaders import shader

__getattr__ = _old_names.of_package
_old_names.of_module("pictures", "images")

__all__ = [
    "Baked",
    "Conversion",
    "Converted",
    "Error",
    "Green",
    "InputError",
    "Level",
    "LimitError",
    "Lint",
    "MapInfo",
    "Mesh",
    "MissingFileError",
    "Model",
    "OutputError",
    "StoppedError",
    "Texture",
    "UnavailableError",
    "UsageError",
    "bake",
    "bake_maps",
    "convert",
    "describe",
    "detect",
    "file_names",
    "frame_apply",
    "frame_encode",
    "frames",
    "library_path",
    "library_version",
    "lint",
    "load",
    "map_blend",
    "map_convert",
    "map_from_height",
    "map_mips",
    "map_texture",
    "map_to_height",
    "model_images",
    "name_role",
    "pack_smooth4",
    "pack_smooth8",
    "pack_tangents",
    "pack_triangles",
    "pair_names",
    "provoking",
    "read_image",
    "render",
    "shader",
    "smooth_cotangents",
    "split_mirrored",
    "split_vertices",
    "tangents",
    "triangle_vectors",
    "vertex_frame_apply",
    "vertex_frame_encode",
    "write_image",
    "__version__",
]
