"""glTF models: what to expect of them, and their maps made for another frame."""

import ctypes
import dataclasses
import json
import os
import pathlib
import tempfile
from typing import Any, Callable, Mapping, Optional, Union

import numpy as np

from . import _arrays as arrays
from . import _structs as structs
from ._library import call, taken
from ._work import long_call
from .errors import InputError, OutputError, UsageError

Model = Union[str, "os.PathLike[str]", bytes, bytearray, memoryview]
Progress = Callable[[float], Any]


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
        report: all of it, as `cotan lint --json` has it.
    """

    primitives: int
    maps: int
    advice: Optional[str]
    maps_to_convert: int
    distrust_stored: bool
    green_against: int
    orthonormal_degrees: Optional[float]
    cotangent_degrees: Optional[float]
    smooth_degrees: Optional[float]
    recommendation: str
    report: dict


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

    glb: Optional[bytes]
    maps_converted: int
    maps_kept: int
    primitives_given: int
    tangent_bytes_dropped: int
    worst_degrees_before: Optional[float]
    worst_degrees_after: Optional[float]
    report: dict


class _Source:
    """A model's bytes, and what its URIs name, as the library asks for them."""

    def __init__(self, model: Model, beside: Optional[Mapping[str, bytes]]):
        self.path = None
        if isinstance(model, (str, os.PathLike)):
            self.path = pathlib.Path(model)
            self.bytes = self._read_file(self.path)
        elif isinstance(model, (bytes, bytearray, memoryview, np.ndarray)):
            self.bytes = model
        else:
            raise arrays.wrong("model", "a path or bytes", type(model).__name__)
        self.array = np.frombuffer(self.bytes, np.uint8)
        self.beside, self.kept, self.failures = beside or {}, [], []
        self.files = structs.ModelFiles(read=structs.Read(self._read), done=structs.Done(self._done))

    @staticmethod
    def _read_file(path):
        try:
            return path.read_bytes()
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

    def _read(self, _, uri, data, size):
        try:
            found = self._bytes_of(uri)
            if found is None:
                return 1
            array = np.frombuffer(found, np.uint8)
            self.kept.append(array)  # until the library has copied it
            data[0], size[0] = arrays.at(array), array.nbytes
            return 0
        except OSError:
            return 1
        except BaseException as error:  # must not cross the library
            self.failures.append(error)
            return 1

    def _done(self, _):
        self.kept.clear()

    def call(self, name, *arguments):
        try:
            call(name, arrays.at(self.array), self.array.nbytes, self.files, *arguments, files=self.names())
        except Exception:
            if self.failures:
                raise self.failures[0] from None
            raise

    def names(self):
        """What messages may begin with."""
        return ("model.glb", "model.gltf")


def _degrees(value):
    return None if value < 0 else value


def lint(
    model: Model,
    distance: float = 0.0,
    progress: Optional[Progress] = None,
    beside: Optional[Mapping[str, bytes]] = None,
) -> Lint:
    """What to expect of a glTF model whose normal maps are read without stored tangents.

    Args:
        model: a path to .glb or .gltf, or the bytes of one.
        distance: from eye to surface, in units of the model; 0: where the whole model fills the picture.
        progress: called on this thread with the share that is done, 0 to 1; False stops.
        beside: files that a model in bytes names, by their URIs.

    Raises InputError for a broken or missing file, StoppedError where `progress` stopped it.
    """
    source = _Source(model, beside)
    result, text = structs.LintResult(), structs.handle()

    def work(told):
        options = structs.LintOptions(distance=distance, progress=told)
        source.call("cotan_lint_gltf", options, result, text)

    long_call(work, progress)
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
        report=json.loads(taken(text)),
    )


def convert(
    model: Model,
    out: Union[str, "os.PathLike[str]", None] = None,
    to_frame: str = "cotangent",
    from_frame: str = "mikktspace",
    tangents: str = "stored",
    keep_tangents: bool = False,
    bits: int = 0,
    threads: int = 0,
    overwrite: bool = False,
    progress: Optional[Progress] = None,
    beside: Optional[Mapping[str, bytes]] = None,
) -> Converted:
    """A glTF model's normal maps made for another frame, and its tangents dropped.

    Args:
        model: a path to .glb or .gltf, or the bytes of one.
        out: .glb to write, whole or not at all; None: the bytes are in the result.
        to_frame, from_frame: names of frames. "mikktspace" and "vertex" write TANGENT, all others drop it.
        tangents: "stored" (generated where missing) or "generated", for from_frame.
        keep_tangents: TANGENT stays where the new frame does not read it.
        bits: of the new maps, 8 or 16, and all are written anew; 0: as the old ones, which stay where they fit.
        threads: 0 for all cores; the result does not depend on it.
        overwrite: lets `out` be the model itself.
        progress: called on this thread with the share that is done, 0 to 1; False stops. Ctrl-C stops, too.
        beside: files that a model in bytes names, by their URIs.

    Raises UsageError, InputError for a broken or missing file, OutputError, StoppedError; nothing is written then.
    """
    source = _Source(model, beside)
    if out is not None:
        out = _output(out, source.path, overwrite)
    if tangents not in ("stored", "generated"):
        raise arrays.wrong("tangents", "'stored' or 'generated'", repr(tangents))
    result, glb, text = structs.ConvertResult(), structs.handle(), structs.handle()

    def work(told):
        options = structs.ConvertOptions(
            to=arrays.encoded(to_frame, "to_frame"),
            bits=bits,
            keep_tangents=int(keep_tangents),
            generate_tangents=int(tangents == "generated"),
            threads=threads,
            progress=told,
        )
        setattr(options, "from", arrays.encoded(from_frame, "from_frame"))
        source.call("cotan_convert_gltf", options, result, glb, text)

    long_call(work, progress)
    report, made = json.loads(taken(text)), taken(glb)
    if out is not None:
        write_whole(out, made)
    return Converted(
        glb=made if out is None else None,
        maps_converted=result.maps_converted,
        maps_kept=result.maps_kept,
        primitives_given=result.primitives_given,
        tangent_bytes_dropped=result.tangent_bytes_dropped,
        worst_degrees_before=_degrees(result.worst_degrees_before),
        worst_degrees_after=_degrees(result.worst_degrees_after),
        report=report,
    )


def _output(out, model, overwrite):
    out = pathlib.Path(out)
    if out.suffix.lower() != ".glb":
        raise arrays.wrong("out", "a file that ends in .glb", f"'{out}'")
    if model is not None and not overwrite and out.exists() and out.samefile(model):
        raise UsageError(f"out: {out} is the model itself; overwrite=True replaces it", file=str(out), field="out")
    if not out.parent.is_dir():
        raise OutputError(f"{out}: there is no folder {out.parent}", file=str(out))
    return out


def write_whole(path: pathlib.Path, data: bytes) -> None:
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
        if temporary and os.path.exists(temporary):
            os.unlink(temporary)
        raise OutputError(f"{path}: {error.strerror or error}", file=str(path)) from None
