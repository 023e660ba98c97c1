"""Checks arguments and converts them to arrays that the library reads, without a copy if dtype and layout fit."""

import math
import operator
import os

import numpy as np

from . import _structs as structs
from .errors import InputError, UsageError

BITS = {np.dtype(np.uint8): 8, np.dtype(np.uint16): 16, np.dtype(np.float32): 32}
DTYPES = {bits: dtype for dtype, bits in BITS.items()}


def wrong(field, expected, found, kind=UsageError):
    """The exception for a bad argument."""
    return kind(f"{field}: expected {expected}, found {found}", field=field, expected=expected, found=str(found))


def _shape_text(shape):
    return "(" + ", ".join("n" if s is None else str(s) for s in shape) + ("," if len(shape) == 1 else "") + ")"


def _array(given, field, expected):
    try:
        return np.asarray(given)
    except ValueError:  # replaces numpy's message
        raise wrong(field, expected, "rows of different lengths") from None


def floats(given, field, width, count=None):
    """Array of float32 in C order of shape (count, width), or (count,) if width is None. Converts other types."""
    shape = (count,) if width is None else (count, width)
    array = _array(given, field, f"numbers of shape {_shape_text(shape)}")
    if array.dtype.kind not in "fiub":
        raise wrong(field, "numbers, preferably of dtype float32", f"dtype {array.dtype}")
    if array.ndim != len(shape) or any(s not in (None, a) for s, a in zip(shape, array.shape)):
        raise wrong(field, f"shape {_shape_text(shape)}", _shape_text(array.shape))
    return np.ascontiguousarray(array, dtype=np.float32)


def triangles(given, field="indices"):
    """Array (3 n,) of uint32 from an array (3 n,) or (n, 3) of any integers."""
    array = _array(given, field, "integers of shape (n,) or (n, 3)")
    if array.size == 0 and array.dtype.kind == "f":  # an empty list
        array = array.astype(np.uint32)
    if array.dtype.kind not in "iu":
        raise wrong(field, "integers, preferably of dtype uint32", f"dtype {array.dtype}")
    if not (array.ndim == 1 or (array.ndim == 2 and array.shape[1] == 3)):
        raise wrong(field, "shape (n,) or (n, 3)", _shape_text(array.shape))
    if array.dtype != np.uint32 and array.size:
        least, most = int(array.min()), int(array.max())
        if least < 0 or most > 0xFFFFFFFF:
            raise wrong(field, "0 to 4294967295", least if least < 0 else most, InputError)
    return np.ascontiguousarray(array, dtype=np.uint32).reshape(-1)


def made(out, field, shape, dtype):
    """The array for a result: `out` if given, after checks, or a new one."""
    if out is None:
        return np.empty(shape, dtype)
    good = isinstance(out, np.ndarray) and out.shape == tuple(shape) and out.dtype == dtype
    if not (good and out.flags.c_contiguous and out.flags.writeable):
        found = type(out).__name__ if not isinstance(out, np.ndarray) else f"{_shape_text(out.shape)} of {out.dtype}"
        if good:
            found = "gaps between elements" if out.flags.writeable else "a read-only array"
        raise wrong(field, f"a contiguous, writeable array {_shape_text(tuple(shape))} of {np.dtype(dtype)}", found)
    return out


def at(array):
    """The address of an array's data; None for None."""
    return None if array is None else array.ctypes.data


def pixels(given, field="map"):
    """An image as array (height, width, 4) of uint8, uint16 or float32 in C order. Arrays of one or three channels are
    copied to four: grey is repeated, alpha is opaque. Other float types become float32."""
    array = _array(given, field, "an image")
    if array.dtype.kind == "f" and array.dtype != np.float32:
        array = array.astype(np.float32)
    if array.dtype not in BITS:
        raise wrong(field, "dtype uint8, uint16 or float32", f"dtype {array.dtype}")
    if array.ndim == 2:
        array = array[..., None]
    if array.ndim != 3 or array.shape[2] not in (1, 3, 4) or 0 in array.shape:
        raise wrong(field, "shape (height, width, 4), (height, width, 3) or (height, width)", _shape_text(array.shape))
    if array.shape[2] == 4:
        return np.ascontiguousarray(array)
    whole = np.empty((*array.shape[:2], 4), array.dtype)
    whole[..., :3] = array
    whole[..., 3] = 1 if array.dtype == np.float32 else np.iinfo(array.dtype).max
    return whole


def finite(array, field):
    """Refuses NaN and infinite floats; the error names the first one's row and column."""
    if array.dtype != np.float32:
        return
    wrong_at = ~np.isfinite(array[..., :3])
    if wrong_at.any():
        row, column, channel = (int(i) for i in np.argwhere(wrong_at)[0])
        found = f"{array[row, column, channel]} at row {row}, column {column}"
        raise wrong(field, "finite numbers", found, InputError)


_SLACK = 1e-3  # allowed excess over the range, from filters and half floats


def stored(array, words, field):
    """Refuses floats outside the range of a convention: 0 to 1, or -1 to 1 if signed. Slopes have no limits."""
    finite(array, field)
    words = os.fsdecode(words).split(",") if isinstance(words, (str, bytes)) else []
    if array.dtype != np.float32 or "slope" in words:
        return
    low = -1.0 if "signed" in words or words == ["auto"] else 0.0
    for found in (float(array[..., :3].min()), float(array[..., :3].max())):
        if not low - _SLACK <= found <= 1 + _SLACK:
            raise wrong(field, f"floats from {low:g} to 1 as {','.join(words)} stores them", f"{found:g}", InputError)


def image_view(array):
    """A cotan_image_view that refers to an array from `pixels` or `made`, which must outlive the struct."""
    return structs.ImageView(width=array.shape[1], height=array.shape[0], bits=BITS[array.dtype], pixels=at(array))


def dtype_of(bits, field="bits"):
    """The dtype of components with `bits` bits."""
    if bits not in DTYPES:
        raise wrong(field, "8, 16 or 32", bits)
    return DTYPES[bits]


def integer(value, field, least, most):
    """Checks an int from `least` to `most`, since ctypes would truncate larger ones."""
    try:
        number = operator.index(value)
    except TypeError:
        raise wrong(field, f"an integer from {least} to {most}", repr(value)) from None
    if not least <= number <= most:
        raise wrong(field, f"{least} to {most}", number)
    return number


def number(value, field):
    """Checks a finite float."""
    try:
        given = float(value)
    except (TypeError, ValueError):
        raise wrong(field, "a number", repr(value)) from None
    if not math.isfinite(given):
        raise wrong(field, "a finite number", given)
    return given


def threads_of(threads):
    return integer(threads, "threads", 0, 1024)


def memory_of(memory):
    return integer(memory, "memory", 1, 65536)


def size_of(size):
    """(width, height) from 1024, (1024, 512) or "1024x512"."""
    if isinstance(size, str):
        size = size.split("x")
    try:
        width, height = (size, size) if np.ndim(size) == 0 else size
        width, height = (int(s) if isinstance(s, str) else operator.index(s) for s in (width, height))
    except (TypeError, ValueError):
        raise wrong("size", "a number, (width, height) or 'WxH'", repr(size)) from None
    if not (1 <= width <= 16384 and 1 <= height <= 16384):
        raise wrong("size", "1 to 16384 per side", f"{width} x {height}")
    return width, height


def encoded(word, field):
    """A string or path as bytes for the library."""
    if not isinstance(word, (str, bytes, os.PathLike)):
        raise wrong(field, "a string", type(word).__name__)
    data = os.fsencode(word)
    if b"\0" in data:
        raise wrong(field, "a string without zero bytes", repr(word))
    return data
