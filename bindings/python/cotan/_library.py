"""Finds, loads and calls libcotan."""

import ctypes
import os
import pathlib
import sys
import threading

from . import _structs as structs
from .errors import UnavailableError, error_of

API_VERSION = 9  # minimum version of the interface of cotan.h

if sys.platform == "win32":
    _NAMES = ("cotan.dll", "libcotan.dll")
elif sys.platform == "darwin":
    _NAMES = ("libcotan.0.dylib", "libcotan.dylib")
else:
    _NAMES = ("libcotan.so.0", "libcotan.so")

_lock = threading.Lock()
_loaded = None  # (the library, its path)


def _candidates():
    """Paths of the library in order of preference: beside this file, COTAN_LIBRARY, the system's search path."""
    here = pathlib.Path(__file__).resolve().parent
    for name in _NAMES:
        if (here / name).exists():
            yield str(here / name)
    named = os.environ.get("COTAN_LIBRARY")
    if named:
        yield named
    yield from _NAMES


def _declare(library):
    for name, (result, *arguments) in structs.FUNCTIONS.items():
        function = getattr(library, name)
        function.restype, function.argtypes = result, arguments


def _python():
    """A Python executable for child processes; None if this Python is embedded in a program without one."""
    beside = pathlib.Path(sys.base_exec_prefix, "bin", f"python3.{sys.version_info.minor}")
    for program in (sys.executable, str(beside)):
        if program and "python" in os.path.basename(program).lower() and os.access(program, os.X_OK):
            return program
    return None


def _read_elsewhere(library, candidate):
    """Makes the library use a child process for formats whose third-party readers may crash, such as FBX."""
    reader, python = pathlib.Path(__file__).resolve().parent / "_reader.py", _python()
    if not sys.platform.startswith("linux") or python is None or not reader.exists():
        return
    words = [os.fsencode(word) for word in (python, "-I", "-S", reader, candidate)]
    library.cotan_set_reader(len(words), (ctypes.c_char_p * len(words))(*words), None, 0)


def _open():
    tried = []
    for candidate in _candidates():
        try:
            library = ctypes.CDLL(candidate)
            version = int(library.cotan_api_version())
            if version < API_VERSION:
                tried.append(f"{candidate}: expected interface version {API_VERSION} or later, found {version}")
                continue
            _declare(library)
            _read_elsewhere(library, candidate)
        except (OSError, AttributeError) as error:
            tried.append(str(error) if candidate in str(error) else f"{candidate}: {error}")
            continue
        return library, candidate
    raise UnavailableError(
        "libcotan is missing: it was found neither in the package nor at COTAN_LIBRARY nor in the system's library "
        "folders. Install libcotan0 or a wheel that contains it, or set COTAN_LIBRARY to its path. "
        f"({'; '.join(tried)})",
        file=_NAMES[0],
    )


def library():
    """libcotan, loaded on first use. Raises UnavailableError if it is missing or too old."""
    global _loaded
    if _loaded is None:
        with _lock:
            if _loaded is None:
                _loaded = _open()
    return _loaded[0]


def library_path() -> str:
    """The path or name by which libcotan was loaded. Raises UnavailableError if it is missing or too old."""
    library()
    return _loaded[1]


def library_version() -> str:
    """The version of libcotan, such as "0.2.0". Raises UnavailableError if it is missing or too old."""
    return library().cotan_version().decode()


def call(name, *arguments, files=()):
    """Calls a function that returns a cotan_status, without the GIL. Raises the exception for a status other than 0."""
    message = ctypes.create_string_buffer(4096)
    status = getattr(library(), name)(*arguments, message, len(message))
    if status != 0:
        raise error_of(status, message.value.decode("utf-8", "replace"), files)


def taken(data):
    """Copies the bytes of a cotan_bytes handle and frees it. data: the handle, as a ctypes.c_void_p."""
    made = library()
    try:
        return ctypes.string_at(made.cotan_bytes_data(data), made.cotan_bytes_size(data))
    finally:
        made.cotan_bytes_free(data)
