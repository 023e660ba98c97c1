"""Baking: the map of a detailed mesh for a simple one."""

import dataclasses
from typing import Any, Callable, Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays as arrays
from . import _structs as structs
from ._library import call
from ._work import long_call
from .geometry import Mesh


@dataclasses.dataclass(frozen=True)
class Baked:
    """A map, and what became of its texels.

    Attributes:
        map: (height, width, 4) of uint8, uint16 or float32, rows from the top.
        texels, covered: all of them, and those whose centre lies in a triangle.
        missed: covered ones whose ray found nothing.
        negative: covered ones whose normal lies below the frame's horizon.
        twice: covered by several triangles.
        rays: shot.
        ray_distance: the search distance used, in units of the positions.
    """

    map: NDArray[np.generic]
    texels: int
    covered: int
    missed: int
    negative: int
    twice: int
    rays: int
    ray_distance: float


def bake(
    low: Mesh,
    high: Mesh,
    *,
    size: Any = 1024,
    frame: str = "smooth",
    kind: str = "normal",
    convention: str = "opengl",
    bits: int = 8,
    samples: int = 1,
    padding: int = 0,
    dither: bool = False,
    ao_rays: int = 64,
    max_distance: float = 0.0,
    cage: Optional[ArrayLike] = None,
    cage_reach: float = 0.0,
    threads: int = 0,
    out: Optional[NDArray[np.generic]] = None,
    progress: Optional[Callable[[float], Any]] = None,
) -> Baked:
    """The map of the detailed mesh `high` for the simple mesh `low`. Words and defaults are those of `cotan bake`.

    Args:
        low: a Mesh with texcoords.
        high: a Mesh.
        size: (width, height) in texels, one number for both, or "WxH".
        frame: that the shader will use: "smooth", "cotangent", "mikktspace", ...: see `frames`.
        kind: "normal", "object-normal", "height" (units of the positions) or "ao".
        convention: how the map is stored: "opengl" (green up), "directx", "opengl,biased", ...
        bits: of the map: 8, 16 or 32 (float).
        samples: per texel: 1, 4 or 16.
        padding: texels around charts that are filled from the nearest chart; 0: all, -1: none.
        dither: with 8 bits: round by a fixed pattern, so that slopes show no steps.
        ao_rays: rays per sample for "ao", 1 to 65536.
        max_distance: how far rays reach to both sides of the low mesh, in units of the positions; 0: 5 % of the
            diagonal of the high mesh.
        cage: (n, 3), a position for each vertex of the low mesh, around both: rays run from there through the low mesh
            and take the first surface they meet.
        cage_reach: how far those rays run; 0: as far behind the low mesh as the cage is before it.
        threads: 0 for all cores; the result does not depend on it.
        out: (height, width, 4) to write into.
        progress: called on this thread, about twenty times a second, with the share that is done, 0 to 1; False
            stops. Ctrl-C stops, too.

    Raises UsageError for words, numbers, shapes; InputError for what is wrong in the meshes; UnavailableError where the
    library was built without Embree; StoppedError where `progress` stopped it, which leaves `out` as it was.
    """
    if samples not in (1, 4, 16):
        raise arrays.wrong("samples", "1, 4 or 16", samples)
    width, height = arrays.size_of(size)
    made = arrays.made(out, "out", (height, width, 4), arrays.dtype_of(bits))
    around = None if cage is None else arrays.floats(cage, "cage", 3, len(low.positions))
    result = structs.BakeResult()

    def work(told):
        options = structs.BakeOptions(
            frame=arrays.encoded(frame, "frame"),
            kind=arrays.encoded("occlusion" if kind == "ao" else kind, "kind"),
            convention=arrays.encoded(convention, "convention"),
            samples={1: 1, 4: 2, 16: 4}[samples],
            padding=padding,
            dither=int(dither),
            occlusion_rays=ao_rays,
            max_distance=max_distance,
            threads=threads,
            progress=told,
            cage=arrays.at(around),
            cage_reach=cage_reach,
        )
        call("cotan_bake", low._c(), high._c(), options, arrays.picture(made), result)

    long_call(work, progress)
    return Baked(
        map=made,
        texels=result.texels,
        covered=result.covered,
        missed=result.missed,
        negative=result.negative,
        twice=result.twice,
        rays=result.rays,
        ray_distance=result.ray_distance,
    )
