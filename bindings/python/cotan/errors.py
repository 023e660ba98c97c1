"""The exceptions. Each has the library's message, which is one line, and its parts."""

import errno
import os
import re
from typing import Any, Optional

# Messages of the library: "WHERE: expected THIS, found THAT"; WHERE is a file, a field, or a file and a field.
_SAYING = re.compile(r"(?:(?P<where>.*?): )?expected (?P<expected>.+?)[,;] found (?P<found>.+)", re.DOTALL)
# Keywords here that differ from the names of the C API's options.
_KEYWORDS = {
    "occlusion_rays": "ao_rays",
    "tile": "udim",
    "tiles": "udim",
    "high_maps": "high_map",
}


class Error(Exception):
    """The base class of all errors. Its text is a message of one line.

    Attributes:
        file: name of the file concerned, or None.
        field: part of the file or argument of the call concerned ("accessors[3].count", "options.samples"), or None.
        expected, found: what was expected and what was found, or None if the message does not say.
    """

    status = 0

    def __init__(
        self,
        message: str,
        file: Optional[str] = None,
        field: Optional[str] = None,
        expected: Optional[str] = None,
        found: Optional[str] = None,
    ) -> None:
        super().__init__(message)
        self.file, self.field, self.expected, self.found = file, field, expected, found

    def __str__(self) -> str:  # overrides OSError.__str__ in subclasses
        return str(self.args[0])

    def __reduce__(self) -> Any:  # keeps all attributes when pickled for another process
        return type(self), (self.args[0], self.file, self.field, self.expected, self.found)


class UsageError(Error, ValueError):
    """The call is wrong: a shape, a dtype, a word, a number out of range."""

    status = 1


class InputError(Error, ValueError):
    """The content of a file or an array is invalid."""

    status = 2


class MissingFileError(InputError, FileNotFoundError):
    """A file to read does not exist. Has `errno` and `filename` like FileNotFoundError."""

    def __init__(
        self,
        message: str,
        file: Optional[str] = None,
        field: Optional[str] = None,
        expected: Optional[str] = None,
        found: Optional[str] = None,
    ) -> None:
        super().__init__(message, file, field, expected, found)
        self.errno, self.strerror, self.filename = errno.ENOENT, os.strerror(errno.ENOENT), file


class UnavailableError(Error, RuntimeError):
    """The library is missing or was built without a required part, or memory is exhausted."""

    status = 3


class OutputError(Error, RuntimeError, OSError):
    """A file could not be written. `filename` is its name; `errno` is None, the message has the reason."""

    status = 4


class LimitError(Error, RuntimeError):
    """A limit is exceeded."""

    status = 5


class StoppedError(Error, RuntimeError):
    """The progress function returned False."""

    status = 6


_OF_STATUS = {c.status: c for c in (UsageError, InputError, UnavailableError, OutputError, LimitError, StoppedError)}


def _keyword(match):
    name = re.sub("[A-Z]", lambda m: "_" + m[0].lower(), match[1])
    return _KEYWORDS.get(name, name)


def in_keywords(status, message):
    """Replaces names of options by keywords: --max-distance and options.max_distance become max_distance."""
    message = re.sub(r"^options\.(\w+)", _keyword, re.sub(r"^kinds\[", "maps[", message))
    if status != UsageError.status:
        return message
    return re.sub(r"(?<![\w/.-])--([a-z]+(?:-[a-z]+)*)", lambda m: m[1].replace("-", "_"), message)


def error_of(status, message, files=()):
    """The exception for a status and a message of the library. files: names with which the message may begin."""
    message = in_keywords(status, message)
    rest, file = message, None
    for name in files:
        said = os.fsencode(name).decode("utf-8", "replace")
        if said and message.startswith(said + ": "):
            file, rest = str(name), message[len(said) + 2 :]
            break
    field = expected = found = None
    parts = _SAYING.fullmatch(rest)
    if parts:
        field, expected, found = parts["where"], parts["expected"], parts["found"]
    elif ": " in rest:
        field = rest.split(": ", 1)[0]
    kind = _OF_STATUS.get(status, Error)
    if kind is InputError and rest.endswith("no such file"):
        kind = MissingFileError
    error = kind(message, file, field, expected, found)
    if isinstance(error, OutputError):
        error.filename = file
    return error
