"""Models: read, judged, and their maps made for another frame."""

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
from . import _structs as structs
from ._handles import array_of_picture, is_path
from ._library import call, library, taken
from ._work import Progress, long_call
from .errors import InputError, MissingFileError, OutputError, UsageError
from .geometry import Mesh
from .pictures import Path
from .words import Expansion, Frame, Reading, TangentOrigin, Up

Bytes = Union[bytes, bytearray, memoryview]
Decode = Callable[[str, bytes], Any]
Encode = Callable[[np.ndarray], bytes]


class Model:
    """A model in the library's memory: what `load` returns, or a copy of meshes. For reading once and using often.

    Attributes:
        warnings: what was odd about it, one line each.

    up: which axis of the meshes is up, "y" or "z"; a model whose z is up is turned by 90 degrees about x.
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


def load(file: Path, pictures: bool = True, memory: int = 640, up: Up = "y") -> Model:
    """Reads a model file: .glb, .gltf, .obj, .ply, .stl, .dae, .fbx or .3ds. Missing normals are made.

    pictures: False leaves those of its materials out, which is enough to bake by its shape. memory: of the largest
    picture, in MiB. up: "z" turns the model by 90 degrees about x, for PLY and STL of Blender and CAD. Formats other than glTF are read by a child process.
    Raises InputError for a missing or broken file or one over a limit.
    """
    made = structs.handle()
    call("cotan_model_open", arrays.encoded(file, "file"), int(pictures), arrays.memory_of(memory), made, files=(file,))
    model = Model.__new__(Model)
    model._hold(made, up)
    return model


@dataclasses.dataclass(frozen=True)
class Lint:
    """What to expect of a model whose normal maps are read without stored tangents.

    Attributes:
        primitives, maps: how many there are.
        advice: the frame to read or make the maps for; None where nothing has to be changed.
        maps_to_convert: how many maps that asks for.
        distrust_stored: whether stored tangents contradict the uv.
        green_against: maps whose green points the other way than the model says.
        orthonormal_degrees, cotangent_degrees, smooth_degrees: how far maps for MikkTSpace are off when they are read
            with that frame: the mean over the surface, of the worst of the maps; None where nothing was judged.
        recommendation: in sentences.
        report: the figures of every primitive and map, `warnings`, and `check`, as `cotan lint --json` has them.
        passed: whether the check passed; None where neither `limit` nor `limit_area` was given. What failed is in
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
    """What became of a model.

    Attributes:
        glb: the new model as bytes, with all files of the old one inside; None where it was written to a file.
        maps_converted, maps_kept: how many.
        primitives_given: how many have new tangents.
        tangent_bytes_dropped: of the old model.
        worst_degrees_before, worst_degrees_after: how far the normals are off with the new frame: the mean over the
            surface of a map, of the worst of the maps; None where nothing was judged.
        report: all of it, map by map.
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
    """A glTF model's bytes, and what its URIs name, as the library asks for them."""

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
        """What the library is told of work that gives an array or nothing: no exception may cross it."""
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

    def _decode(self, _, name, data, size, picture):
        name, content = name.decode("utf-8", "replace"), ctypes.string_at(data, size)
        pixels = self._safely(lambda: arrays.pixels(self.decode(name, content), "decode"))
        if pixels is None:
            return 1
        picture[0] = arrays.picture(pixels)
        return 0

    def _encode(self, _, picture, data, size):
        return self._give(self._safely(lambda: self.encode(array_of_picture(picture[0]))), data, size)

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


# 0 is none to the library, and what allows nothing is a little more.
def _limit(value, name):
    return 0.0 if value is None else max(arrays.number(value, name), 1e-9)


def lint(
    model: Union[Path, Bytes, Model],
    distance: float = 0.0,
    memory: int = 640,
    progress: Optional[Progress] = None,
    beside: Optional[Mapping[str, bytes]] = None,
    limit: Optional[float] = None,
    limit_area: Optional[float] = None,
    frame: Reading = "orthonormal",
) -> Lint:
    """What to expect of a model whose normal maps are read without stored tangents, before anything is drawn.

    Args:
        model: a path to a model of any format, the bytes of a glTF one, or a Model.
        distance: from eye to surface, in units of the model; 0: where the whole model fills the picture.
        memory: of the largest picture, in MiB, for a path.
        progress: called on this thread with the share that is done, 0 to 1; False stops. Ctrl-C stops, too.
        beside: files that a model in bytes names, by their URIs.
        limit, limit_area: make it a check, whose verdict is `passed`: degrees that the error with `frame` may exceed
            on 5 % of the area, and % of a primitive's area with wrong uv or tangents. Green that points the other way
            fails it; maps that could not be judged fail `limit`.
        frame: that `limit` judges: cotangent, orthonormal, smooth, exact, triangle or stored.

    Raises InputError for a broken or missing file, StoppedError where `progress` stopped it.
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
) -> Converted:
    """A glTF model's normal maps made for another frame, and its tangents dropped.

    Args:
        model: a path to .glb or .gltf, or the bytes of one.
        out: .glb to write, whole or not at all; None: the bytes are in the result.
        to_frame, from_frame: names of frames. "mikktspace" and "vertex" write TANGENT, all others drop it.
            to_frame None: "cotangent", with keep_maps "orthonormal". from_frame None: the frame that the file names
            for its maps, else "mikktspace".
        tangents: "stored" (generated where missing) or "generated", for from_frame.
        keep_tangents: TANGENT stays where the new frame does not read it.
        bits: of the new maps, 8 or 16, and all are written anew; 0: as the old ones, which stay where they fit.
        threads: 0 for all cores; the result does not depend on it.
        overwrite: lets `out` be the model itself.
        progress: called on this thread with the share that is done, 0 to 1; False stops. Ctrl-C stops, too.
        beside: files that a model in bytes names, by their URIs.
        decode: decode(name, bytes) gives a picture for a PNG or JPEG file, in place of the library's own readers.
        encode: encode(picture) gives the PNG file of a picture of uint8 or uint16, in place of its own writer.
        unsigned: how engines take the numbers of the maps: "biased" (2c - 1, as stock engines do) or "exact".
        keep_maps: leaves all maps byte for byte as they are, to be read with to_frame, and drops tangents only.

    Raises UsageError, InputError for a broken or missing file, OutputError, StoppedError; nothing is written then.
    """
    check_tangents(tangents)
    source = Source(model, beside, decode, encode)
    if out is not None:
        out = _output(out, source.path, overwrite)
    result, glb, text = structs.ConvertResult(), structs.handle(), structs.handle()

    def work(told):
        options = convert_options(to_frame, from_frame, tangents, keep_tangents, bits, threads, told, unsigned, keep_maps)
        source.call("cotan_convert_gltf", options, result, glb, text)

    long_call(work, progress)
    report, made = json.loads(taken(text)), taken(glb)
    if out is not None:
        _write_whole(out, made)
    return converted_of(result, made if out is None else None, report)


def convert_options(to_frame, from_frame, tangents, keep_tangents, bits, threads, told, unsigned, keep_maps):
    """The struct of the C API."""
    options = structs.ConvertOptions(
        to=None if to_frame is None else arrays.encoded(to_frame, "to_frame"),
        bits=arrays.integer(bits, "bits", 0, 16),
        keep_tangents=int(keep_tangents),
        generate_tangents=int(tangents == "generated"),
        threads=arrays.threads_of(threads),
        progress=told,
        expansion=arrays.encoded(unsigned, "unsigned"),
        keep_maps=int(keep_maps),
    )
    if from_frame is not None:
        setattr(options, "from", arrays.encoded(from_frame, "from_frame"))
    return options


def converted_of(result, glb, report):
    """The dataclass of a struct of the C API."""
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
    """The file to write, looked at before the work."""
    out = pathlib.Path(out)
    if out.suffix.lower() != ".glb":
        raise arrays.wrong("out", "a file that ends in .glb", f"'{out}'")
    if model is not None and not overwrite and out.exists() and out.samefile(model):
        raise UsageError(f"out: {out} is the model itself; overwrite=True replaces it", file=str(out), field="out")
    if not out.parent.is_dir():
        raise OutputError(f"{out}: there is no folder {out.parent}", file=str(out))
    return out


def _write_whole(path, data):
    """Writes a file that appears whole or not at all. Raises OutputError."""
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
