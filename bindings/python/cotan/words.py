"""The words that functions accept, as types for completion in editors and for type checkers.

    from cotan.words import Frame
    frame: Frame = "smooth"
"""

from typing import Literal, Union

# The frames: `cotan.frames()`.
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
    "area-weighted",
]
# "auto": the frame that the maps were made for.
DrawnFrame = Union[Frame, Literal["auto"]]
# Frames that are stored at the vertices.
VertexFrame = Literal["smooth", "vertex", "mikktspace", "area-weighted"]
# Frames that `lint` judges.
Reading = Literal["cotangent", "orthonormal", "smooth", "exact", "triangle", "stored"]

# How a map is stored, by the program that reads it. Words after a comma name differences: "unity,xy".
Preset = Literal["gltf", "opengl", "directx", "unity", "unreal", "blender", "godot", "maya", "3dsmax", "source"]
Convention = Union[Preset, str]

BakeKind = Literal[
    "normal", "object-normal", "height", "ao", "bent-normal", "object-bent-normal", "thickness", "curvature", "position",
    "base-color", "roughness", "metallic", "roughness-metallic", "emissive", "id",
]  # fmt: skip
IdBy = Literal["material", "object", "vertex-color"]
HighNormals = Literal["smooth", "curved", "face", "map"]
Search = Literal["first", "nearest"]
Rays = Literal["auto", "averaged", "straight", "vertex-color"]
Occluders = Literal["matched", "all"]
BlendMode = Literal["reoriented", "whiteout", "udn", "slopes", "linear"]
Compress = Literal[
    "none", "bc3", "bc5", "bc5-snorm", "bc7", "uastc", "eac-rg11",
    "astc-4x4", "astc-5x4", "astc-5x5", "astc-6x5", "astc-6x6", "astc-8x5", "astc-8x6", "astc-8x8",
]  # fmt: skip
Swizzle = Literal["auto", "rg", "ra", "ag", "rrrg"]
Container = Literal["ktx2", "dds"]
TangentKind = Literal["mikktspace", "area-weighted", "vertex"]
TangentOrigin = Literal["stored", "generated"]
Expansion = Literal["biased", "exact"]
Up = Literal["y", "z"]
ShaderLanguage = Literal["glsl", "essl", "hlsl", "wgsl", "msl", "cpp", "godot"]
