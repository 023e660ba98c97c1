"""Reads, lints and converts models."""

import ctypes
import dataclasses
import json
import os
import pathlib
import tempfile
import weakref
from typing import Any, Callable, Mapping, Optional, Sequence, Union

import numpy as np

from . import _arrays as arrays
from . import _old_names
from . import _structs as structs
from ._handles import array_of_view, is_path
from ._library import call, library, taken
from ._work import Progress, long_call
from .errors import InputError, MissingFileError, OutputError, UsageError
from .geometry import Mesh
from .images import Path
from .words import Expansion, Frame, Reading, TangentOrigin, Up

Bytes = Union[bytes, bytearray, memoryview]
Decode = Callable[[str, bytes], Any]
Encode = Callable[[np.ndarray], bytes]


class Model:
    """A model in the library's memory, from `load` or copied from meshes, to be used several times.

    Attributes:
        warnings: warnings about the model, one line each.

    up: the up axis of the meshes, "y" or "z"; a model with z up is rotated by 90 degrees about x.
    """

    def __init__(self, meshes: Union[Mesh, Sequence[Mesh]], up: Up = "y") -> None:
        meshes = [meshes] if isinstance(meshes, Mesh) else list(meshes)
        for i, mesh in enumerate(meshes):
            if not isinstance(mesh, Mesh):
                raise arrays.wrong(f"meshes[{i}]", "a cotan.Mesh", type(mesh).__name__)
        given = [mesh._c() for mesh in meshes]
        pointers = (ctypes.POINTER(structs.CMesh) * len(given))(*map(ctypes.pointer, given))
        names = (ctypes.c_char_p * len(given))(*(arrays.encoded(mesh.name, "name") for mesh in meshes))
        made = structs.handle()
        call("cotan_model_of_meshes", len(given), pointers, names, made)
        self._hold(made, up)

    def _hold(self, made, up):
        self._handle = made
        weakref.finalize(self, library().cotan_model_free, made.value)
        call("cotan_model_up", made, arrays.encoded(up, "up"))
        self.warnings = [w for w in library().cotan_model_warnings(made).decode("utf-8", "replace").split("\n") if w]


@_old_names.keyword("pictures", "images")
def load(file: Path, images: bool = True, memory: int = 640, up: Up = "y") -> Model:
    """Reads a model file: .glb, .gltf, .obj, .ply, .stl, .dae, .fbx or .3ds. Missing normals are computed.

    images: False skips the images of materials, which a bake of the shape does not need. memory: maximum size of an
    image, in MiB. up: "z" rotates the model by 90 degrees about x, for PLY and STL of Blender and CAD. A child process
    reads formats other than glTF. Raises InputError for a missing or broken file or one over a limit.
    """
    made = structs.handle()
    call("cotan_model_open", arrays.encoded(file, "file"), int(images), arrays.memory_of(memory), made, files=(file,))
    model = Model.__new__(Model)
    model._hold(made, up)
    return model


@dataclasses.dataclass(frozen=True)
class Lint:
    """What to expect of a model whose normal maps are read without stored tangents.

    Attributes:
        primitives, maps: number of primitives and of normal maps.
        advice: the frame that most primitives read their maps with; None if there is nothing to read.
        maps_to_convert: always 0: maps stay as they are.
        distrust_stored: whether stored tangents contradict the uv.
        green_against: number of maps whose green points the other way than the model says.
        orthonormal_degrees, cotangent_degrees, smooth_degrees: error of maps for MikkTSpace that are read with this
            frame: mean over the surface, maximum over the maps; None if nothing was judged.
        recommendation: the advice in sentences.
        report: the data of all primitives and maps, `decisions` (the frame of each primitive), `warnings` and `check`,
            as in `cotan lint --json`.
        passed: whether the check passed; None if neither `limit` nor `limit_area` was given. The failures are in
            `report["check"]["failures"]`.
    """

    primitives: int
    maps: int
    advice: Optional[Frame]
    maps_to_convert: int
    distrust_stored: bool
    green_against: int
    orthonormal_degrees: Optional[float]
    cotangent_degrees: Optional[float]
    smooth_degrees: Optional[float]
    recommendation: str
    report: dict[str, Any] = dataclasses.field(repr=False)
    passed: Optional[bool] = None


@dataclasses.dataclass(frozen=True)
class Converted:
    """The result of a conversion.

    Attributes:
        glb: the new model as bytes, self-contained; None if it was written to a file.
        maps_converted, maps_kept: number of maps.
        primitives_given: number of primitives with new tangents.
        tangent_bytes_dropped: size of the dropped tangents.
        worst_degrees_before, worst_degrees_after: error of the normals with the new frame: mean over the surface of a
            map, maximum over the maps; None if nothing was judged.
        report: details for each map.
    """

    glb: Optional[bytes] = dataclasses.field(repr=False)
    maps_converted: int
    maps_kept: int
    primitives_given: int
    tangent_bytes_dropped: int
    worst_degrees_before: Optional[float]
    worst_degrees_after: Optional[float]
    report: dict[str, Any] = dataclasses.field(repr=False)


class Source:
    """The bytes of a glTF model, and callbacks by which the library reads the files that its URIs reference."""

    def __init__(self, model, beside=None, decode=None, encode=None):
        self.path = None
        if is_path(model):
            self.path = pathlib.Path(model)
            model = self._read_file(self.path)
        try:
            self.array = np.frombuffer(model, np.uint8)
        except (TypeError, ValueError, BufferError):
            raise arrays.wrong("model", "a path or bytes", type(model).__name__) from None
        self.beside, self.kept, self.failures = beside or {}, [], []
        self.decode, self.encode = decode, encode
        self.files = structs.ModelFiles(read=structs.Read(self._read), done=structs.Done(self._done))
        if decode is not None:
            self.files.decode = structs.Decode(self._decode)
        if encode is not None:
            self.files.encode = structs.Encode(self._encode)
        if self.path is not None:
            self.files.name = arrays.encoded(self.path, "model")

    @staticmethod
    def _read_file(path):
        try:
            return path.read_bytes()
        except FileNotFoundError:
            raise MissingFileError(f"{path}: no such file", file=str(path)) from None
        except OSError as error:
            raise InputError(f"{path}: {error.strerror or error}", file=str(path)) from None

    def _bytes_of(self, uri):
        name = os.fsdecode(uri)
        if name in self.beside:
            return self.beside[name]
        if self.path is None:
            return None
        folder = self.path.parent.resolve()
        file = (folder / name).resolve()
        return file.read_bytes() if folder in file.parents and file.is_file() else None

    def _safely(self, work):
        """The array that work() returns, or None. Catches exceptions, which must not pass through the library."""
        try:
            array = work()
            if array is not None:
                self.kept.append(array)  # until the library has copied it
            return array
        except OSError:
            return None
        except BaseException as error:
            self.failures.append(error)
            return None

    def _give(self, found, data, size):
        array = self._safely(lambda: None if found is None else np.frombuffer(found, np.uint8))
        if array is None:
            return 1
        data[0], size[0] = arrays.at(array), array.nbytes
        return 0

    def _read(self, _, uri, data, size):
        return self._give(self._safely(lambda: self._bytes_of(uri)), data, size)

    def _decode(self, _, name, data, size, image):
        name, content = name.decode("utf-8", "replace"), ctypes.string_at(data, size)
        pixels = self._safely(lambda: arrays.pixels(self.decode(name, content), "decode"))
        if pixels is None:
            return 1
        image[0] = arrays.image_view(pixels)
        return 0

    def _encode(self, _, image, data, size):
        return self._give(self._safely(lambda: self.encode(array_of_view(image[0]))), data, size)

    def _done(self, _):
        self.kept.clear()

    def call(self, name, *arguments):
        names = ("model.glb", "model.gltf") if self.path is None else (self.path,)
        try:
            call(name, arrays.at(self.array), self.array.nbytes, self.files, *arguments, files=names)
        except Exception:
            if self.failures:
                raise self.failures[0] from None
            raise


def _degrees(value):
    return None if value < 0 else value


# The library takes 0 for no limit, so a limit of 0 becomes a tiny positive one.
def _limit(value, name):
    return 0.0 if value is None else max(arrays.number(value, name), 1e-9)


def _max_degrees(value):
    degrees = arrays.number(value, "max_degrees")
    if not 0 < degrees <= 180:
        raise arrays.wrong("max_degrees", "more than 0 and at most 180", value)
    return degrees


def lint(
    model: Union[Path, Bytes, Model],
    distance: float = 0.0,
    memory: int = 640,
    progress: Optional[Progress] = None,
    beside: Optional[Mapping[str, bytes]] = None,
    limit: Optional[float] = None,
    limit_area: Optional[float] = None,
    frame: Reading = "orthonormal",
    max_degrees: float = 0.3,
) -> Lint:
    """Reports what to expect of a model whose normal maps are read without stored tangents, without a render.

    Args:
        model: a path to a model of any format, the bytes of a glTF one, or a Model.
        distance: distance from eye to surface in units of the model; 0: where the whole model fills the image.
        memory: maximum size of an image, in MiB, for a path.
        progress: called on this thread with the fraction done, 0 to 1. Returning False stops, and so does Ctrl-C.
        beside: files that a model in bytes references, by URI.
        limit, limit_area: request a check, whose verdict is `passed`. limit: maximum error in degrees with `frame` on
            95 % of the area. limit_area: maximum percent of a primitive's area with bad uv or tangents. Reversed green
            fails the check; maps that could not be judged fail `limit`.
        frame: the frame that `limit` judges: cotangent, orthonormal, smooth, exact, triangle or stored.
        max_degrees: as for `convert`, for the decisions in the report.

    Raises InputError for a broken or missing file, StoppedError if `progress` stopped the work.
    """
    result, text = structs.LintResult(), structs.handle()
    source = None if is_path(model) or isinstance(model, Model) else Source(model, beside)

    def work(told):
        options = structs.LintOptions(
            distance=arrays.number(distance, "distance"),
            progress=told,
            limit=_limit(limit, "limit"),
            limit_area=_limit(limit_area, "limit_area"),
            frame=arrays.encoded(frame, "frame"),
            max_degrees=_max_degrees(max_degrees),
        )
        if source is not None:
            source.call("cotan_lint_gltf", options, result, text)
            return
        opened = model if isinstance(model, Model) else load(model, memory=memory)
        call("cotan_lint_model", opened._handle, options, result, text)

    long_call(work, progress)
    report = json.loads(taken(text))
    return Lint(
        primitives=result.primitives,
        maps=result.maps,
        advice=result.advice.decode() or None,
        maps_to_convert=result.maps_to_convert,
        distrust_stored=bool(result.distrust_stored),
        green_against=result.green_against,
        orthonormal_degrees=_degrees(result.orthonormal_degrees),
        cotangent_degrees=_degrees(result.cotangent_degrees),
        smooth_degrees=_degrees(result.smooth_degrees),
        recommendation=result.recommendation.decode("utf-8", "replace"),
        report=report,
        passed=report["check"] and report["check"]["passed"],
    )


def check_tangents(tangents):
    if tangents not in ("stored", "generated"):
        raise arrays.wrong("tangents", "'stored' or 'generated'", repr(tangents))


def convert(
    model: Union[Path, Bytes],
    out: Optional[Path] = None,
    to_frame: Optional[Frame] = None,
    from_frame: Optional[Frame] = None,
    tangents: TangentOrigin = "stored",
    keep_tangents: bool = False,
    bits: int = 0,
    threads: int = 0,
    overwrite: bool = False,
    progress: Optional[Progress] = None,
    beside: Optional[Mapping[str, bytes]] = None,
    decode: Optional[Decode] = None,
    encode: Optional[Encode] = None,
    unsigned: Expansion = "biased",
    keep_maps: bool = False,
    max_degrees: float = 0.3,
) -> Converted:
    """Drops the tangents of a glTF model where nobody can see it, or converts its normal maps to another frame.

    Args:
        model: a path to .glb or .gltf, or the bytes of one.
        out: .glb file to write atomically; None: returns the bytes in the result.
        to_frame, from_frame: names of frames. "mikktspace" and "vertex" write TANGENT, all others drop it.
            to_frame None: maps are kept, each primitive is read with the frame that is near enough, which its extras
            name, and keeps its tangents where none is. from_frame None: the frame that the file names for its maps,
            else "mikktspace".
        tangents: "stored" (generated where missing) or "generated", for from_frame.
        keep_tangents: keeps TANGENT even if the new frame does not read it.
        bits: bit depth of the new maps, 8 or 16; all maps are rewritten. 0: that of the old maps, which stay if valid.
        threads: 0 for all cores; the result does not depend on it.
        overwrite: allows `out` to be the model itself.
        progress: called on this thread with the fraction done, 0 to 1. Returning False stops, and so does Ctrl-C.
        beside: files that a model in bytes references, by URI.
        decode: decode(name, bytes) returns the image of a PNG or JPEG file; replaces the library's own readers.
        encode: encode(image) returns the PNG file of an image of uint8 or uint16; replaces the library's own writer.
        unsigned: how engines decode the maps: "biased" (2c - 1, as stock engines do) or "exact".
        keep_maps: only drops tangents and leaves maps byte for byte as they are, to be read with to_frame. Where
            tangents reverse green of a map, its green is reversed, or they stay.
        max_degrees: without to_frame: the mean error of normals that a frame may have on a primitive, and ten times as
            much on 1 % of its area; above 0, at most 180.

    Raises UsageError, InputError for a broken or missing file, OutputError, StoppedError. Nothing is written then.
    """
    check_tangents(tangents)
    source = Source(model, beside, decode, encode)
    if out is not None:
        out = _output(out, source.path, overwrite)
    result, glb, text = structs.ConvertResult(), structs.handle(), structs.handle()

    def work(told):
        options = convert_options(
            to_frame, from_frame, tangents, keep_tangents, bits, threads, told, unsigned, keep_maps, max_degrees
        )
        source.call("cotan_convert_gltf", options, result, glb, text)

    long_call(work, progress)
    report, made = json.loads(taken(text)), taken(glb)
    if out is not None:
        _write_whole(out, made)
    return converted_of(result, made if out is None else None, report)


def convert_options(
    to_frame, from_frame, tangents, keep_tangents, bits, threads, told, unsigned, keep_maps, max_degrees
):
    """The cotan_convert_options for these arguments."""
    options = structs.ConvertOptions(
        to=None if to_frame is None else arrays.encoded(to_frame, "to_frame"),
        bits=arrays.integer(bits, "bits", 0, 16),
        keep_tangents=int(keep_tangents),
        generate_tangents=int(tangents == "generated"),
        threads=arrays.threads_of(threads),
        progress=told,
        expansion=arrays.encoded(unsigned, "unsigned"),
        keep_maps=int(keep_maps),
        max_degrees=_max_degrees(max_degrees),
    )
    if from_frame is not None:
        setattr(options, "from", arrays.encoded(from_frame, "from_frame"))
    return options


def converted_of(result, glb, report):
    """The dataclass for a cotan_convert_result."""
    return Converted(
        glb=glb,
        maps_converted=result.maps_converted,
        maps_kept=result.maps_kept,
        primitives_given=result.primitives_given,
        tangent_bytes_dropped=result.tangent_bytes_dropped,
        worst_degrees_before=_degrees(result.worst_degrees_before),
        worst_degrees_after=_degrees(result.worst_degrees_after),
        report=report,
    )


def _output(out, model, overwrite):
    """The path to write to, checked before the work starts."""
    out = pathlib.Path(out)
    if out.suffix.lower() != ".glb":
        raise arrays.wrong("out", "a file that ends in .glb", f"'{out}'")
    if model is not None and not overwrite and out.exists() and out.samefile(model):
        raise UsageError(f"out: {out} is the model itself; overwrite=True replaces it", file=str(out), field="out")
    if not out.parent.is_dir():
        raise OutputError(f"{out}: the folder {out.parent} does not exist", file=str(out))
    return out


def _write_whole(path, data):
    """Writes a file atomically. Raises OutputError."""
    temporary = None
    try:
        with tempfile.NamedTemporaryFile(dir=path.parent, prefix=f".{path.name}.", delete=False) as file:
            temporary = file.name
            file.write(data)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(temporary, 0o666 & ~umask)
        os.replace(temporary, path)
    except OSError as error:
        raise OutputError(f"{path}: {error.strerror or error}", file=str(path)) from None
    finally:
        if temporary and os.path.exists(temporary):
            os.unlink(temporary)
