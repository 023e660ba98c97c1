"""Meshes, frames and tangents as arrays."""

import ctypes
import dataclasses
from typing import Optional

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _arrays as arrays
from . import _structs as structs
from ._library import call, library
from ._work import Progress, long_call
from .words import Frame, TangentKind, VertexFrame

Floats = NDArray[np.float32]
Words = NDArray[np.uint32]


@dataclasses.dataclass(eq=False, init=False, repr=False)
class Mesh:
    """A triangle mesh. Arrays of the right dtype in C order are kept without a copy, others are converted once.

    Attributes:
        positions: (n, 3) float32, in any unit.
        indices: (3 t,) uint32, three per triangle, each below n; passed as (3 t,) or (t, 3) of any integers.
        normals: (n, 3) float32, of length one; None: `bake` computes smooth normals, all other functions need them.
        texcoords: (n, 2) float32, v down as in glTF (OBJ and Blender: 1 - v); None if the mesh has none.
        name: used in messages, and by `bake` with match_by_name.
        colors: (n, 4) float32, linear red, green, blue, alpha; read by models and `bake`. None if the mesh has none.

    Raises UsageError for other shapes and for dtypes that are not numbers.
    """

    positions: Floats
    indices: Words
    normals: Optional[Floats] = None
    texcoords: Optional[Floats] = None
    name: str = ""
    colors: Optional[Floats] = None

    def __init__(
        self,
        positions: ArrayLike,
        indices: ArrayLike,
        normals: Optional[ArrayLike] = None,
        texcoords: Optional[ArrayLike] = None,
        name: str = "",
        colors: Optional[ArrayLike] = None,
    ) -> None:
        self.positions = arrays.floats(positions, "positions", 3)
        count = len(self.positions)
        self.indices = arrays.triangles(indices)
        self.normals = None if normals is None else arrays.floats(normals, "normals", 3, count)
        self.texcoords = None if texcoords is None else arrays.floats(texcoords, "texcoords", 2, count)
        self.name = name
        self.colors = None if colors is None else arrays.floats(colors, "colors", 4, count)

    def __repr__(self) -> str:
        return f"Mesh(name={self.name!r}, vertices={len(self.positions)}, triangles={len(self.indices) // 3})"

    def _c(self):
        """The C struct, which refers to the arrays of this mesh."""
        return structs.CMesh(
            vertex_count=len(self.positions),
            positions=arrays.at(self.positions),
            normals=arrays.at(self.normals),
            texcoords=arrays.at(self.texcoords),
            index_count=len(self.indices),
            indices=arrays.at(self.indices),
            colors=arrays.at(self.colors),
        )


def frames() -> list[Frame]:
    """The names of all frames."""
    made = library()
    return [made.cotan_frame_name(i).decode() for i in range(made.cotan_frame_count())]


def _by_frame(function, frame, given, points, out, missing=(), **attributes):
    """Calls a function for points: attributes, with their widths, of the struct `points`. missing: may be None."""
    given = arrays.floats(given, "texels" if function.endswith("apply") else "normals_wanted", 3)
    count = len(given)
    own = {
        name: None if array is None and name in missing else arrays.floats(array, name, width, count)
        for name, (array, width) in attributes.items()
    }
    out = arrays.made(out, "out", (count, 3), np.float32)
    struct = points(count=count, **{name: arrays.at(array) for name, array in own.items()})
    call(function, arrays.encoded(frame, "frame"), struct, arrays.at(given), arrays.at(out))
    return out


def _at_points(function, frame, given, normals, dpdx, dpdy, duvdx, duvdy, out):
    return _by_frame(
        function, frame, given, structs.SurfacePoints, out,
        normals=(normals, 3), dpdx=(dpdx, 3), dpdy=(dpdy, 3), duvdx=(duvdx, 2), duvdy=(duvdy, 2),
    )  # fmt: skip


def _at_interpolated_points(function, frame, given, normals, tangents, u, v, out):
    return _by_frame(
        function, frame, given, structs.InterpolatedPoints, out, ("tangents", "cotangents_u", "cotangents_v"),
        normals=(normals, 3), tangents=(tangents, 4), cotangents_u=(u, 3), cotangents_v=(v, 3),
    )  # fmt: skip


def frame_apply(
    frame: Frame,
    texels: ArrayLike,
    normals: ArrayLike,
    dpdx: ArrayLike,
    dpdy: ArrayLike,
    duvdx: ArrayLike,
    duvdy: ArrayLike,
    out: Optional[Floats] = None,
) -> Floats:
    """Perturbs normals with a frame that is computed from differences. Returns unit normals (n, 3).

    Args:
        frame: "cotangent", "orthonormal", ...: see `frames`.
        texels: (n, 3) decoded texels: x along +u, y along +v, z outwards.
        normals: (n, 3) unit normals of the surface.
        dpdx, dpdy: (n, 3) differences of position along any two directions, such as pixels or edges.
        duvdx, duvdy: (n, 2) differences of uv along the same two.
        out: array (n, 3) of float32 to write into.

    Degenerate differences give the unperturbed normal. Raises UsageError for bad shapes and frames.
    """
    return _at_points("cotan_frame_apply", frame, texels, normals, dpdx, dpdy, duvdx, duvdy, out)


def frame_encode(
    frame: Frame,
    normals_wanted: ArrayLike,
    normals: ArrayLike,
    dpdx: ArrayLike,
    dpdy: ArrayLike,
    duvdx: ArrayLike,
    duvdy: ArrayLike,
    out: Optional[Floats] = None,
) -> Floats:
    """The inverse of `frame_apply`: unit texels (n, 3) for normals_wanted (n, 3). The other arguments are the same.

    Degenerate differences give (0, 0, 1).
    """
    return _at_points("cotan_frame_encode", frame, normals_wanted, normals, dpdx, dpdy, duvdx, duvdy, out)


def vertex_frame_apply(
    frame: VertexFrame,
    texels: ArrayLike,
    normals: ArrayLike,
    tangents: Optional[ArrayLike] = None,
    cotangents_u: Optional[ArrayLike] = None,
    cotangents_v: Optional[ArrayLike] = None,
    out: Optional[Floats] = None,
) -> Floats:
    """Like `frame_apply`, for frames that are stored at the vertices and interpolated.

    Args:
        frame: "mikktspace", "area-weighted" or "vertex", which read tangents; "smooth", which reads cotangents.
        texels: (n, 3) decoded texels.
        normals: (n, 3) interpolated normals of any length.
        tangents: (n, 4), w as in glTF's TANGENT, from `tangents`.
        cotangents_u, cotangents_v: (n, 3) each, from `smooth_cotangents`.
    """
    return _at_interpolated_points(
        "cotan_vertex_frame_apply", frame, texels, normals, tangents, cotangents_u, cotangents_v, out
    )


def vertex_frame_encode(
    frame: VertexFrame,
    normals_wanted: ArrayLike,
    normals: ArrayLike,
    tangents: Optional[ArrayLike] = None,
    cotangents_u: Optional[ArrayLike] = None,
    cotangents_v: Optional[ArrayLike] = None,
    out: Optional[Floats] = None,
) -> Floats:
    """The inverse of `vertex_frame_apply`: unit texels (n, 3) for normals_wanted (n, 3)."""
    return _at_interpolated_points(
        "cotan_vertex_frame_encode", frame, normals_wanted, normals, tangents, cotangents_u, cotangents_v, out
    )


def tangents(
    mesh: Mesh,
    kind: TangentKind = "mikktspace",
    threads: int = 0,
    out: Optional[Floats] = None,
    progress: Optional[Progress] = None,
) -> Floats:
    """One tangent for each index: (3 t, 4) float32; x, y, z along increasing u, w as in glTF's TANGENT.

    x, y, z are unit. Only "vertex" never gives (0, 0, 0, 1) or (0, 0, 0, -1) where directions cancel at a vertex, as
    MikkTSpace does. glTF requires unit length: replace such a tangent by (1, 0, 0) before you write a file. `convert`,
    `bake` and the tool do so.

    kind: "mikktspace", "area-weighted" (meshoptimizer's default) or "vertex". threads: 0 for all cores; the result does
    not depend on it. The mesh needs texcoords. progress: as in `bake`; for "vertex" it is only called at the start and at the end. Raises UsageError,
    InputError for an index that is out of range, and StoppedError, which leaves `out` unchanged.
    """
    out = arrays.made(out, "out", (len(mesh.indices), 4), np.float32)
    given = arrays.encoded(kind, "kind"), mesh._c(), arrays.threads_of(threads)
    long_call(lambda told: call("cotan_tangents_with_progress", *given, told, None, arrays.at(out)), progress)
    return out


def smooth_cotangents(mesh: Mesh, threads: int = 0, progress: Optional[Progress] = None) -> tuple[Floats, Floats]:
    """The cotangents of the frame "smooth": u and v, (n, 3) float32 each, one pair for each vertex.

    threads: 0 for all cores; the result does not depend on it. progress: as in `bake`.
    """
    u, v = np.empty_like(mesh.positions), np.empty_like(mesh.positions)
    given, to = (mesh._c(), arrays.threads_of(threads)), (arrays.at(u), arrays.at(v))
    long_call(lambda told: call("cotan_smooth_cotangents_with_progress", *given, told, None, *to), progress)
    return u, v


def triangle_vectors(mesh: Mesh, threads: int = 0) -> tuple[Floats, Floats]:
    """U and V of the frame "triangle": (t, 3) float32 each, one pair for each triangle."""
    shape = (len(mesh.indices) // 3, 3)
    u, v = np.empty(shape, np.float32), np.empty(shape, np.float32)
    call("cotan_triangle_vectors", mesh._c(), arrays.threads_of(threads), arrays.at(u), arrays.at(v))
    return u, v


def _split(function, vertex_count, index_count, *first):
    split = np.empty(index_count, np.uint32)
    sources = np.empty(vertex_count + index_count, np.uint32)
    count = ctypes.c_size_t()
    call(function, *first, arrays.at(split), arrays.at(sources), count)
    return split, sources[: count.value].copy()


def split_vertices(vertex_count: int, indices: ArrayLike, corners: ArrayLike) -> tuple[Words, Words]:
    """Duplicates vertices so that values per corner can be stored per vertex.

    A vertex is duplicated if its corners have different values. corners: (3 t, 4), from `tangents`. Returns the new
    indices (3 t,) and sources, for each new vertex the old one that it copies, the old vertices first:
    `positions[sources]` are the new positions.
    """
    indices, vertex_count = arrays.triangles(indices), arrays.integer(vertex_count, "vertex_count", 0, 2**32 - 1)
    corners = arrays.floats(corners, "corners", 4, len(indices))
    sizes = vertex_count, len(indices)
    return _split("cotan_split_vertices", *sizes, *sizes, arrays.at(indices), arrays.at(corners))


def split_mirrored(mesh: Mesh) -> tuple[Words, Words]:
    """Duplicates vertices that mirrored and unmirrored triangles share, as `smooth_cotangents` needs it."""
    return _split("cotan_split_mirrored", len(mesh.positions), len(mesh.indices), mesh._c())


def provoking(vertex_count: int, indices: ArrayLike, last: bool = False) -> tuple[Words, Words, Words]:
    """Renumbers vertices so that vertex k is the provoking vertex of triangle k.

    last: whether the provoking vertex is the last of the three (OpenGL, WebGL) or the first (Vulkan, Direct3D, Metal,
    WebGPU). Returns the new indices (3 t,), the old vertex of each new one, and corners (3 t,): the old indices with
    each triangle rotated so that its provoking vertex comes first.
    """
    indices, vertex_count = arrays.triangles(indices), arrays.integer(vertex_count, "vertex_count", 0, 2**32 - 1)
    made, corners = np.empty_like(indices), np.empty_like(indices)
    sources = np.empty(vertex_count + len(indices), np.uint32)
    count = ctypes.c_size_t()
    call(
        "cotan_provoking", vertex_count, len(indices), arrays.at(indices), int(last), arrays.at(made),
        arrays.at(sources), count, arrays.at(corners),
    )  # fmt: skip
    return made, sources[: count.value].copy(), corners


def pack_triangles(u: ArrayLike, v: ArrayLike) -> Words:
    """Packs `triangle_vectors` in (t, 3) uint32, which shaders/cotan/triangle.h unpacks."""
    u = arrays.floats(u, "u", 3)
    v = arrays.floats(v, "v", 3, len(u))
    words = np.empty((len(u), 3), np.uint32)
    call("cotan_pack_triangles", len(u), arrays.at(u), arrays.at(v), arrays.at(words))
    return words


def _pack_smooth(function, normals, u, v, shape, dtype):
    normals = arrays.floats(normals, "normals", 3)
    u, v = arrays.floats(u, "u", 3, len(normals)), arrays.floats(v, "v", 3, len(normals))
    packed = np.empty((len(normals), *shape), dtype)
    call(function, len(normals), arrays.at(normals), arrays.at(u), arrays.at(v), arrays.at(packed))
    return packed


def pack_smooth8(normals: ArrayLike, u: ArrayLike, v: ArrayLike) -> NDArray[np.int16]:
    """Packs `smooth_cotangents` in (n, 4) int16 (SNORM16), which shaders/cotan/pack.h unpacks.

    normals: (n, 3), the unit normals that unpacking will see.
    """
    return _pack_smooth("cotan_pack_smooth8", normals, u, v, (4,), np.int16)


def pack_smooth4(normals: ArrayLike, u: ArrayLike, v: ArrayLike) -> Words:
    """Like `pack_smooth8`, in one word per vertex: (n,) uint32."""
    return _pack_smooth("cotan_pack_smooth4", normals, u, v, (), np.uint32)


def pack_tangents(normals: ArrayLike, tangents: ArrayLike) -> NDArray[np.uint16]:
    """Packs tangents (n, 4) in (n,) uint16. normals: (n, 3), the unit normals that unpacking will see."""
    normals = arrays.floats(normals, "normals", 3)
    tangents = arrays.floats(tangents, "tangents", 4, len(normals))
    packed = np.empty(len(normals), np.uint16)
    call("cotan_pack_tangents", len(normals), arrays.at(normals), arrays.at(tangents), arrays.at(packed))
    return packed
