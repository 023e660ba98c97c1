"""The words that functions take, as types: an editor completes them, and a type checker finds the misspelt one.

    from cotan.words import Frame
    frame: Frame = "smooth"
"""

from typing import Literal, Union

# What normals are perturbed with: `cotan.frames()`.
Frame = Literal[
    "cotangent",
    "cotangent-2013",
    "nonperspective",
    "paper-full",
    "paper-nodet",
    "paper-transpose",
    "paper-orthogonal",
    "unit",
    "orthonormal",
    "gradient",
    "exact",
    "smooth",
    "vertex",
    "mikktspace",
    "triangle",
]
# "auto": the one that the maps mean.
DrawnFrame = Union[Frame, Literal["auto"]]
# Those that are made at the vertices.
VertexFrame = Literal["smooth", "vertex", "mikktspace"]
# What `lint` judges.
Reading = Literal["cotangent", "orthonormal", "smooth", "exact", "triangle", "stored"]

# How a map is stored, by the name of who reads it. After a comma words may say what differs: "unity,xy".
Preset = Literal["gltf", "opengl", "directx", "unity", "unreal", "blender", "godot", "maya", "3dsmax", "source"]
Convention = Union[Preset, str]

BakeKind = Literal["normal", "object-normal", "height", "ao"]
HighNormals = Literal["smooth", "curved", "face", "map"]
Search = Literal["first", "nearest"]
BlendMode = Literal["reoriented", "whiteout", "udn", "slopes", "linear"]
TangentKind = Literal["mikktspace", "vertex"]
TangentOrigin = Literal["stored", "generated"]
Expansion = Literal["biased", "exact"]
Up = Literal["y", "z"]
ShaderLanguage = Literal["glsl", "essl", "hlsl", "wgsl", "msl", "cpp", "godot"]
