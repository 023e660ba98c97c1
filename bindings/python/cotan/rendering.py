"""Renders models."""

import ctypes
import json
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _arrays as arrays
from . import _structs as structs
from ._handles import array_of, is_path
from ._library import call, taken
from ._work import Progress, long_call
from .models import Bytes, Source
from .images import Path
from .words import Convention, DrawnFrame, TangentOrigin, Up


def _word(name, value):
    """A keyword argument as a command line option; None if it is not set."""
    option = b"--" + name.replace("_", "-").encode()
    if value is None or value is False:
        return None
    if value is True:
        return option
    if isinstance(value, (tuple, list, np.ndarray)):
        value = ("x" if name == "size" else ",").join(str(v) for v in value)
    return option + b"=" + arrays.encoded(value if is_path(value) else str(value), name)


def render(
    model: Union[Path, Bytes, None] = None,
    *,
    size: Union[str, int, Sequence[int]] = (1280, 720),
    frame: DrawnFrame = "auto",
    max_degrees: Optional[float] = None,
    view: str = "shaded",
    camera: Union[str, int, Sequence[float], None] = None,
    shape: Optional[str] = None,
    up: Optional[Up] = None,
    device: str = "auto",
    floats: bool = False,
    samples: int = 4,
    normal_map: Optional[Path] = None,
    convention: Optional[Convention] = None,
    material: Optional[int] = None,
    base_color: Optional[Path] = None,
    metallic_roughness: Optional[Path] = None,
    occlusion: Optional[Path] = None,
    height_map: Optional[Path] = None,
    height_depth: Optional[float] = None,
    mask: Optional[Path] = None,
    variant: Union[str, int, None] = None,
    animation: Union[str, int, None] = None,
    time: Optional[float] = None,
    edges: Optional[str] = None,
    shading: Optional[str] = None,
    tangents: Optional[TangentOrigin] = None,
    exposure: Union[float, str, None] = None,
    tone_mapping: Optional[str] = None,
    environment: Optional[Path] = None,
    environment_rotation: Optional[float] = None,
    environment_intensity: Optional[float] = None,
    background: Optional[str] = None,
    ground: Optional[str] = None,
    shadow_softness: Optional[float] = None,
    no_shadows: bool = False,
    no_normal_maps: bool = False,
    specular_antialiasing: bool = False,
    point_sampled: bool = False,
    memory: Optional[int] = None,
    threads: int = 0,
    report: Optional[dict[str, Any]] = None,
    progress: Optional[Progress] = None,
    beside: Optional[Mapping[str, bytes]] = None,
) -> NDArray[np.generic]:
    """Renders a model. Returns (height, width, 4): red, green, blue, alpha, rows from the top.

    The arguments are the options of `cotan render`, with underscores for dashes, and give the same pixels. `cotan
    render --help` documents them. None means the default of the command.

    Args:
        model: a path to a model file, the bytes of a glTF one, or None for the built-in scene or `shape`.
        size: (width, height), one number for both, or "WxH".
        frame: the frame to apply normal maps with: see `frames`.
        max_degrees: for the frame "auto", as in `convert`.
        view: "shaded", "normal", "uv", "depth", "error", "checker", "stretch", "base-color", ...
        camera: "front", "fit", the index of a camera of the file, or six numbers in world units: eye and target.
        up: "y", or "z" for files with z up, such as PLY and STL of Blender and CAD.
        floats: True: float32 with linear, unclamped light, as in an .exr file; False: uint8 as in a .png.
        device: "auto", "reference", or a part of a Vulkan device's name.
        report: a dict to fill with the device, counts, `warnings`, and for the view "error" the degrees in
            `error_against_exact`.
        threads: 0 for all cores; the image does not depend on it.
        progress: called on this thread with the fraction done, 0 to 1 (only by the device "reference"). Returning False
            stops, and so does Ctrl-C.
        beside: files that a model in bytes references, by URI.

    Raises UsageError for bad words and numbers, InputError for a broken or missing file, UnavailableError for a missing
    device, StoppedError if `progress` stopped the render.
    """
    options = dict(locals())
    for name in ("model", "floats", "threads", "report", "progress", "beside"):
        del options[name]
    words = [word for word in (_word(name, value) for name, value in options.items()) if word is not None]
    source = None if model is None or is_path(model) else Source(model, beside)
    if is_path(model):
        words += [b"--", arrays.encoded(model, "model")]
    threads = arrays.threads_of(threads)
    given = (ctypes.c_char_p * len(words))(*words)
    image, text = structs.handle(), structs.handle()

    def work(told):
        wanted = structs.RenderOptions(
            word_count=len(words), words=given, floats=int(floats), threads=threads, progress=told
        )
        if source is not None:
            source.call("cotan_render", wanted, image, text)
        else:
            call("cotan_render", None, 0, None, wanted, image, text, files=(model,) if model else ())

    long_call(work, progress)
    made = json.loads(taken(text))
    if report is not None:
        report.update(made)
    return array_of(image)
