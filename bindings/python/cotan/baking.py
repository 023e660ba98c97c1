"""Baking of maps from detailed meshes for a simple one."""

import ctypes
import dataclasses
from typing import Any, Optional, Sequence, Union

import numpy as np
from numpy.typing import NDArray

from . import _arrays as arrays
from . import _structs as structs
from ._handles import is_path
from ._library import call, library, taken
from ._work import Progress, long_call
from .errors import InputError, in_keywords
from .geometry import Mesh
from .maps import Map
from .models import Model, load
from .images import Path, pixels_of
from .words import BakeKind, Convention, Frame, HighNormals, IdBy, Occluders, Rays, Search, TangentOrigin, Up

Geometry = Union[Mesh, Path, Model]


_OF_MATERIALS = ("base-color", "roughness", "metallic", "orm", "emissive")


@dataclasses.dataclass(frozen=True, eq=False)
class Baked:
    """A baked map with statistics of its texels.

    Attributes:
        map: (height, width, 4) of uint8, uint16 or float32, rows from the top.
        mask: (height, width, 4) uint8, an image of the result for each texel; None unless requested.
        texels, covered: the number of all texels, and of those whose centre lies in a triangle.
        missed: covered texels whose ray found nothing.
        further: missed texels with a detailed surface beyond the search distance.
        nearer: covered texels that show the first surface from outside although another is nearer.
        negative: covered texels whose normal lies below the frame's horizon.
        twice: texels covered by several triangles.
        disputed: of these, the texels where the triangles need normals that differ by over 5 degrees.
        problems: the number of problem areas, 0 to 3, which the last warnings describe; 0: the map can be used.
        rays: number of rays traced.
        ray_distance: the search distance used, in units of the positions.
        ray_start: the largest distance in front of the simple mesh at which rays start.
        unit: of "thickness" and "curvature" the thickness or radius that integers store as 1; else 0.
        box: of the detailed meshes: the lowest x, y, z, then the highest; 0 and 1 of "position" in integers.
        warnings: one line each.
        ids: of "id" by materials or objects the colour of each, (red, green, blue) of 8 bits; else empty.
    """

    map: NDArray[np.generic] = dataclasses.field(repr=False)
    mask: Optional[NDArray[np.uint8]] = dataclasses.field(repr=False)
    texels: int
    covered: int
    missed: int
    negative: int
    twice: int
    rays: int
    ray_distance: float
    further: int
    nearer: int
    ray_start: float
    unit: float
    box: tuple[float, ...]
    disputed: int
    problems: int
    warnings: list[str]
    ids: dict[str, tuple[int, int, int]]


def _model(given, field, up, images=False, memory=640):
    """A Model from a mesh, several meshes, a file, or a Model."""
    if isinstance(given, Model):
        return given
    if is_path(given):
        return load(given, images, memory, up)
    if isinstance(given, Mesh) or (
        isinstance(given, Sequence) and len(given) > 0 and all(isinstance(mesh, Mesh) for mesh in given)
    ):
        return Model(given, up)
    raise arrays.wrong(field, "a cotan.Mesh, a path or a cotan.Model", type(given).__name__)


def _several(given):
    """A list of the items of a list or tuple, or of a single item."""
    return list(given) if isinstance(given, (list, tuple)) else [given]


def _lines(data):
    """The lines of a cotan_bytes handle, which it frees."""
    return [line for line in taken(data).decode("utf-8", "replace").split("\n") if line]


def _pointers(items):
    """An array of pointers to structs of one type; None without any."""
    return (ctypes.POINTER(type(items[0])) * len(items))(*map(ctypes.pointer, items)) if items else None


def name_role(name: str) -> str:
    """What the name of a mesh says that it is: "low" (door_low, Door.lo.001, lp_door), "high", "cage", or ""."""
    return str(library().cotan_name_role(arrays.encoded(name, "name")).decode())


def pair_names(low: Sequence[str], high: Sequence[str]) -> tuple[list[list[int]], list[str]]:
    """Pairs simple with detailed meshes by their names, as `bake` with match_by_name does.

    "door_low" belongs to "door_high" and "door_high_bolts", "door_low.001" to "door_high.001"; case does not matter.

    Returns for each of `low` the indices of its meshes in `high`, none if it has no counterpart; and what the names
    leave open, one sentence each.
    """
    names = [(ctypes.c_char_p * len(n))(*(arrays.encoded(name, what) for name in n))
             for n, what in ((low, "low"), (high, "high"))]  # fmt: skip
    groups = [np.empty(len(n), np.int64) for n in (low, high)]
    notes = structs.handle()
    call(
        "cotan_pair_names", len(low), names[0], len(high), names[1], groups[0].ctypes.data, groups[1].ctypes.data, notes,
    )  # fmt: skip
    of_group: dict[int, list[int]] = {}
    for index, group in enumerate(groups[1].tolist()):
        of_group.setdefault(group, []).append(index)
    return [of_group.get(group, []) if group >= 0 else [] for group in groups[0].tolist()], _lines(notes)


def bake(
    low: Union[Geometry, Sequence[Mesh]],
    high: Union[Geometry, Sequence[Geometry]],
    *,
    size: Any = 1024,
    frame: Frame = "mikktspace",
    kind: BakeKind = "normal",
    pack: Optional[str] = None,
    convention: Convention = "opengl",
    bits: int = 8,
    samples: int = 4,
    padding: int = 0,
    dither: bool = False,
    ao_rays: int = 64,
    ao_occluders: Occluders = "matched",
    search: Search = "first",
    rays: Rays = "auto",
    rays_mask: Optional[Map] = None,
    extrusion: float = 0.0,
    max_distance: float = 0.0,
    cage: Union[Geometry, Sequence[Mesh], None] = None,
    cage_reach: float = 0.0,
    thickness_distance: float = 0.0,
    curvature_radius: float = 0.0,
    id_by: IdBy = "material",
    match_by_name: bool = False,
    wrap: bool = False,
    material: int = -1,
    udim: Optional[int] = None,
    tangents: TangentOrigin = "stored",
    high_normals: HighNormals = "smooth",
    high_frame: Optional[Frame] = None,
    high_map: Union[Map, Sequence[Map], None] = None,
    high_convention: Optional[Convention] = None,
    mask: bool = False,
    memory: int = 640,
    threads: int = 0,
    out: Optional[NDArray[np.generic]] = None,
    progress: Optional[Progress] = None,
    up: Up = "y",
    high_up: Optional[Up] = None,
) -> Baked:
    """Bakes a map from detailed meshes for a simple one. Words and defaults are those of `cotan bake`.

    Args:
        low: a Mesh with texcoords, several of them, a path to a model file, or a Model.
        high: the same, or a list of such items, which are all used.
        size: (width, height) in texels, one number for both, or "WxH".
        frame: the frame that the shader will use: "smooth", "cotangent", "mikktspace", ...: see `frames`.
        kind: "normal", "object-normal", "height" (units of the positions), "ao", "bent-normal", "object-bent-normal",
            "thickness", "curvature", "position", or of the high meshes' materials "base-color", "roughness",
            "metallic", "roughness-metallic" (green and blue), "emissive" or "id". Colours are sRGB with 8 and 16 bits,
            linear with 32; integers clamp them to 1. Several: `bake_maps`.
        pack: instead of `kind`, channels of maps of one value: "R=ao,G=roughness,B=metallic,A=1", or "orm" for these.
        convention: how the map is stored: "opengl" (green up), "directx", "opengl,biased", ...
        bits: bit depth of the map: 8, 16 or 32 (float).
        samples: samples per texel: 1, 4 or 16.
        padding: texels around charts that are filled from the nearest chart; 0: all, -1: none.
        dither: with 8 bits: dithers with a fixed pattern, so that slopes show no steps.
        ao_rays: rays per texel for "ao", bent normals and thickness, 1 to 65536.
        ao_occluders: with match_by_name, what casts occlusion: "matched" (the high meshes of the same name) or "all".
        search: "first": the first surface that a ray from outside inwards hits; "nearest": the surface nearest to the
            low mesh along its normal in either direction, which misses parts that float above another surface.
        rays: which way rays run: "auto": straight, but averaged near hard edges; "averaged": along normals averaged
            over hard edges, without gaps, but details lean; "straight": along the low mesh's normals, with gaps at hard
            edges; "vertex-color": straight where the red of the low mesh's vertex colours is 1, averaged where it is 0.
            No effect with a cage and for the search "nearest".
        rays_mask: an image in the low mesh's uv that replaces `rays`: rays are straight where its red is 1 and averaged
            where it is 0.
        extrusion: distance in front of the low mesh at which rays start, in units of the positions; 0: measured from
            the distance between the meshes.
        max_distance: maximum distance of high surfaces from the low mesh, in units of the positions; 0: 10 % of the
            diagonal of the low mesh, for the search "nearest" 5 % of that of the high mesh.
        cage: a mesh with the triangles of the low mesh in their order, which encloses both meshes. Rays start there.
        cage_reach: length of rays from the cage; 0: as far behind the low mesh as the cage is in front of it.
        thickness_distance: thickness that is stored as 1, in units of the positions; 0: 50 % of the diagonal of the
            high mesh. With 32 bits thickness is in these units.
        curvature_radius: radius of a ball whose curvature is stored as 1, flat is 0.5; 0: 1 % of that diagonal. With 32
            bits curvature is in 1 / unit.
        id_by: what has a colour of its own in "id": "material", "object" or "vertex-color".
        match_by_name: a low mesh named NAME_low sees only its high meshes NAME_high: see `pair_names`.
        wrap: the low mesh is one flat tile that fills the square of its uv once, and what leaves it at a border comes
            in at the opposite one.
        material: index of the low model's material to bake; -1: all.
        udim: tile of the texture coordinates to bake, 1001 to 1999; None: 1001, with a warning of triangles on others.
        tangents: for the frames "vertex" and "mikktspace": "stored" (generated where missing) or "generated".
        high_normals: "smooth", "curved", "face" or "map": the high meshes' own normal maps.
        high_frame: the frame that those maps were made for; None: "mikktspace".
        high_map: an image that replaces the high meshes' own maps, or one for each of `high`; in float32 0.5 stands for
            zero, which is not 128 / 255.
        high_convention: how the high maps are stored; None: as the materials say, "opengl" for high_map.
        mask: whether to return the image of the result for each texel.
        memory: maximum size of an image that is read, in MiB.
        threads: 0 for all cores; the result does not depend on it.
        out: array (height, width, 4) of the dtype of `bits` to write into.
        progress: called on this thread, about twenty times per second, with the fraction done, 0 to 1. Returning False
            stops the bake, and so does Ctrl-C.
        up: the up axis of meshes and files, "y" or "z"; ignored for a Model. high_up: that of `high`, if different.

    Raises UsageError for bad words, numbers and shapes; InputError for bad meshes and files; UnavailableError if the
    library was built without Embree; StoppedError if `progress` stopped the bake, which leaves `out` unchanged.
    """
    given = {name: value for name, value in locals().items() if name not in ("bits", "out")}
    return _baked([None], [bits], [out], **given)[0]


def bake_maps(
    low: Union[Geometry, Sequence[Mesh]],
    high: Union[Geometry, Sequence[Geometry]],
    maps: Sequence[str],
    *,
    size: Any = 1024,
    frame: Frame = "mikktspace",
    convention: Convention = "opengl",
    bits: Union[int, Sequence[int]] = 8,
    samples: int = 4,
    padding: int = 0,
    dither: bool = False,
    ao_rays: int = 64,
    ao_occluders: Occluders = "matched",
    search: Search = "first",
    rays: Rays = "auto",
    rays_mask: Optional[Map] = None,
    extrusion: float = 0.0,
    max_distance: float = 0.0,
    cage: Union[Geometry, Sequence[Mesh], None] = None,
    cage_reach: float = 0.0,
    thickness_distance: float = 0.0,
    curvature_radius: float = 0.0,
    id_by: IdBy = "material",
    match_by_name: bool = False,
    wrap: bool = False,
    material: int = -1,
    udim: Optional[int] = None,
    tangents: TangentOrigin = "stored",
    high_normals: HighNormals = "smooth",
    high_frame: Optional[Frame] = None,
    high_map: Union[Map, Sequence[Map], None] = None,
    high_convention: Optional[Convention] = None,
    mask: bool = False,
    memory: int = 640,
    threads: int = 0,
    out: Optional[Sequence[NDArray[np.generic]]] = None,
    progress: Optional[Progress] = None,
    up: Up = "y",
    high_up: Optional[Up] = None,
) -> dict[str, Baked]:
    """Bakes several maps, whose rays are traced once. Each is as `bake` makes it alone, to the bit.

        maps = cotan.bake_maps(low, high, ["normal", "ao", "R=roughness,G=metallic"], size=2048)
        cotan.write_image("ao.png", maps["ao"].map)

    Args:
        maps: words of `kind` and `pack` of `bake`, all different.
        bits: bit depth of all maps, or one for each of `maps`.
        out: an array to write into for each of `maps`.

    The other arguments and the errors are those of `bake`.

    Returns the maps by their words. Those of one call share the counts of texels and rays, warnings and the mask.
    """
    given = {name: value for name, value in locals().items() if name not in ("maps", "bits", "out")}
    if isinstance(maps, str) or not isinstance(maps, Sequence) or not maps:
        raise arrays.wrong("maps", "a list of words, such as normal and ao", repr(maps))
    each = bits if isinstance(bits, Sequence) else [bits] * len(maps)
    into = [None] * len(maps) if out is None else out
    for name, items in (("bits", each), ("out", into)):
        if len(items) != len(maps):
            raise arrays.wrong(name, f"{len(maps)}, one for each map", len(items))
    return dict(zip(maps, _baked(maps, each, into, kind="normal", pack=None, **given)))


def _baked(
    kinds, bits, out, *, low, high, size, frame, kind, pack, convention, samples, padding, dither, ao_rays,
    ao_occluders, search, rays, rays_mask, extrusion, max_distance, cage, cage_reach, thickness_distance,
    curvature_radius, id_by, match_by_name, wrap, material, udim, tangents, high_normals, high_frame, high_map,
    high_convention, mask, memory, threads, progress, up, high_up,
):  # fmt: skip
    """A list of Baked for `kinds`, of which None is that of `kind` or `pack`. bits, out: one for each."""
    if samples not in (1, 4, 16):
        raise arrays.wrong("samples", "1, 4 or 16", samples)
    material = arrays.integer(material, "material", -1, 100000)
    tile = 0 if udim is None else arrays.integer(udim, "udim", 1001, 1999)
    padding, ao_rays = arrays.integer(padding, "padding", -1, 65536), arrays.integer(ao_rays, "ao_rays", 1, 65536)
    max_distance, threads = arrays.number(max_distance, "max_distance"), arrays.threads_of(threads)
    cage_reach, extrusion = arrays.number(cage_reach, "cage_reach"), arrays.number(extrusion, "extrusion")
    thickness_distance = arrays.number(thickness_distance, "thickness_distance")
    curvature_radius = arrays.number(curvature_radius, "curvature_radius")
    for mesh in _several(low):
        if isinstance(mesh, Mesh) and mesh.texcoords is None:
            raise arrays.wrong("low", "meshes with texcoords", f"one without: {mesh}", InputError)
    width, height = arrays.size_of(size)
    places = [""] if kinds[0] is None else [f"[{number}]" for number in range(len(kinds))]
    made = [
        arrays.made(into, f"out{place}", (height, width, 4), arrays.dtype_of(b)) for b, into, place in zip(bits, out, places)
    ]
    one = kind if pack is None else pack
    shown = [one if k is None else k for k in kinds]
    kind_words = [None if k is None else arrays.encoded(k, f"maps{place}") for k, place in zip(kinds, places)]
    mask_made = np.empty((height, width, 4), np.uint8) if mask else None
    words = {
        name: None if word is None else arrays.encoded(word, name)
        for name, word in (
            ("frame", frame), ("kind", one), ("id_by", id_by), ("convention", convention),
            ("tangents", tangents), ("high_normals", high_normals), ("high_frame", high_frame),
            ("high_convention", high_convention), ("search", search), ("occluders", ao_occluders),
            ("rays", rays),
        )
    }  # fmt: skip
    maps = [] if high_map is None else [pixels_of(m, "high_map") for m in _several(high_map)]
    for given in maps:
        arrays.stored(given, "opengl" if high_convention is None else high_convention, "high_map")
    images = [arrays.image_view(m) for m in maps]
    rays_given = None if rays_mask is None else pixels_of(rays_mask, "rays_mask")
    rays_view = None if rays_given is None else arrays.image_view(rays_given)
    mask_view = None if mask_made is None else arrays.image_view(mask_made)
    views = [arrays.image_view(pixels) for pixels in made]
    results = [structs.BakeResult() for _ in made]
    colors, lines = structs.handle(), structs.handle()
    warnings: list[str] = []

    def work(told):
        simple = _model(low, "low", up, memory=memory)
        enclosing = None if cage is None else _model(cage, "cage", up)
        images_used = high_normals == "map" or any(word in k for word in _OF_MATERIALS for k in shown)
        detailed = [_model(h, "high", high_up or up, images_used, memory) for h in _several(high)]
        for model in (simple, *detailed):
            warnings.extend(w for w in model.warnings if w not in warnings)
        handles = (structs.handle * len(detailed))(*(model._handle for model in detailed))
        high_maps = _pointers(images)
        options = structs.BakeOptions(
            samples={1: 1, 4: 2, 16: 4}[samples],
            padding=padding,
            dither=int(dither),
            occlusion_rays=ao_rays,
            max_distance=max_distance,
            threads=threads,
            progress=told,
            cage=None if enclosing is None else enclosing._handle,
            match_by_name=int(match_by_name),
            wrap=int(wrap),
            rays_mask=None if rays_view is None else ctypes.addressof(rays_view),
            material=material + 1,
            tile=tile,
            high_map_count=len(images),
            high_maps=ctypes.addressof(high_maps) if high_maps else None,
            cage_reach=cage_reach,
            extrusion=extrusion,
            thickness_distance=thickness_distance,
            curvature_radius=curvature_radius,
            mask=None if mask_view is None else ctypes.addressof(mask_view),
            **words,
        )
        call(
            "cotan_bake_maps", simple._handle, len(detailed), handles, options, len(made),
            (ctypes.c_char_p * len(made))(*kind_words), _pointers(views), _pointers(results), colors, lines,
        )  # fmt: skip

    long_call(work, progress)
    warnings += [in_keywords(0, line) for line in _lines(lines)]
    ids = {line[8:]: (int(line[1:3], 16), int(line[3:5], 16), int(line[5:7], 16)) for line in _lines(colors)}
    return [
        Baked(
            map=pixels,
            mask=mask_made,
            warnings=warnings,
            box=tuple(result.box),
            ids=ids if word == "id" else {},
            **{name: getattr(result, name) for name, _ in structs.BakeResult._fields_ if name not in ("size", "box")},
        )
        for word, pixels, result in zip(shown, made, results)
    ]
