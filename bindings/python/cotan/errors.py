"""What can go wrong, as exceptions. Each carries the one line that the library said, and the parts of it."""

import errno
import os
import re
from typing import Any, Optional

# The library says "WHERE: expected THIS, found THAT"; WHERE is a file, a field, or a file and a field.
_SAYING = re.compile(r"(?:(?P<where>.*?): )?expected (?P<expected>.+?)[,;] found (?P<found>.+)", re.DOTALL)
# Options of the C API that keywords here have other names for.
_KEYWORDS = {
    "occlusion_rays": "ao_rays",
    "tile": "udim",
    "tiles": "udim",
    "high_maps": "high_map",
}


class Error(Exception):
    """Anything that Cotan refuses. Its text is one line that says what is wrong.

    Attributes:
        file: name of the file that it is about, or None.
        field: what in the file or in the call it is about ("accessors[3].count", "options.samples"), or None.
        expected, found: what should have been there and what was, or None where the line has no such parts.
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

    def __str__(self) -> str:  # not that of OSError, which some are too
        return str(self.args[0])

    def __reduce__(self) -> Any:  # all of it survives pickle, so that it comes whole from another process
        return type(self), (self.args[0], self.file, self.field, self.expected, self.found)


class UsageError(Error, ValueError):
    """The call itself is wrong: a shape, a dtype, a word, a number out of range."""

    status = 1


class InputError(Error, ValueError):
    """A file or an array that was given is bad."""

    status = 2


class MissingFileError(InputError, FileNotFoundError):
    """A file that was to be read is not there. `errno` and `filename` are those of a FileNotFoundError."""

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
    """Not here: the library is missing or was built without what this needs, or there is no memory."""

    status = 3


class OutputError(Error, RuntimeError, OSError):
    """A file could not be written. `filename` is its name; `errno` is None, for the line says why."""

    status = 4


class LimitError(Error, RuntimeError):
    """Over a limit."""

    status = 5


class StoppedError(Error, RuntimeError):
    """The progress function said False."""

    status = 6


_OF_STATUS = {c.status: c for c in (UsageError, InputError, UnavailableError, OutputError, LimitError, StoppedError)}


def _keyword(match):
    name = re.sub("[A-Z]", lambda m: "_" + m[0].lower(), match[1])
    return _KEYWORDS.get(name, name)


def _in_keywords(status, message):
    """A line about options in the names that they have here: --max-distance and options.max_distance are
    max_distance."""
    message = re.sub(r"^options\.(\w+)", _keyword, message)
    if status != UsageError.status:
        return message
    return re.sub(r"(?<![\w/.-])--([a-z]+(?:-[a-z]+)*)", lambda m: m[1].replace("-", "_"), message)


def error_of(status, message, files=()):
    """The exception for a status and a line of the library. files: names that the line may begin with."""
    message = _in_keywords(status, message)
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
