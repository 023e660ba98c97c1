"""Prints the portable shader text for a language."""

import ctypes
from typing import Union

from . import _arrays as arrays
from ._library import call
from .words import Convention, Frame, ShaderLanguage


def shader(lang: ShaderLanguage, frame: Union[Frame, str, None] = None, convention: Convention = "gltf,exact") -> str:
    """Self-contained source, to paste into a shader, of the function that perturbs the normal with the given frame.

    Args:
        lang: "glsl", "essl", "hlsl", "wgsl", "msl", "cpp" or "godot" (a whole spatial shader).
        frame: the one that the map was baked for: "orthonormal" reads maps for MikkTSpace, as most are, "smooth" and
            "cotangent" those that you bake for this shader. Required, except for "godot", whose default is
            "orthonormal". "triangle,vertex" and the like give the part for one stage (fragment, vertex, mesh, compute).
        convention: how the map is stored.
    """
    words = [None if w is None and n == "frame" else arrays.encoded(w, n)
             for w, n in ((lang, "lang"), (frame, "frame"), (convention, "convention"))]  # fmt: skip
    size = ctypes.c_size_t(0)
    call("cotan_shader_text", *words, None, size)
    text = ctypes.create_string_buffer(size.value)
    call("cotan_shader_text", *words, ctypes.addressof(text), size)
    return text.value.decode()
