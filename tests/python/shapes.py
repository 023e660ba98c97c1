"""Meshes and models whose properties the tests know exactly."""

import json
import struct

import numpy as np

import cotan

CORNERS = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
TWO = np.array([0, 1, 2, 0, 2, 3], np.uint32)


def square(name=""):
    """The unit square in the plane z = 0, u along x and v against y."""
    positions = np.c_[CORNERS, np.zeros(4)].astype(np.float32)
    normals = np.tile(np.float32([0, 0, 1]), (4, 1))
    return cotan.Mesh(positions, TWO, normals, np.c_[CORNERS[:, 0], 1 - CORNERS[:, 1]], name)


def slope(rise, name=""):
    """A square of side 3 around `square` with slope `rise` along x and height 0 at the centre; without texcoords."""
    xy = 3 * CORNERS - 1
    positions = np.c_[xy, rise * (xy[:, 0] - 0.5)]
    normal = np.array([-rise, 0, 1]) / np.hypot(rise, 1)
    return cotan.Mesh(positions, TWO, np.tile(normal, (4, 1)), name=name)


def bumps(count=24):
    """A grid of count x count squares over the unit square, with waves; texcoords as in `square`."""
    x, y = np.meshgrid(np.linspace(0, 1, count + 1), np.linspace(0, 1, count + 1))
    x, y = x.ravel(), y.ravel()
    z = 0.03 * np.sin(7 * x) * np.cos(5 * y)
    slope_x, slope_y = 0.21 * np.cos(7 * x) * np.cos(5 * y), -0.15 * np.sin(7 * x) * np.sin(5 * y)
    normals = np.c_[-slope_x, -slope_y, np.ones_like(x)]
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    first = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    quads = np.c_[first, first + 1, first + count + 2, first, first + count + 2, first + count + 1]
    return cotan.Mesh(np.c_[x, y, z], quads.ravel(), normals, np.c_[x, 1 - y])


def write_obj(file, mesh):
    """Writes the mesh as an OBJ file, where v runs up; every float is read back exactly."""
    texcoords = np.zeros((len(mesh.positions), 2)) if mesh.texcoords is None else mesh.texcoords.astype(float)
    with open(file, "w", encoding="ascii") as out:
        if mesh.name:
            out.write(f"o {mesh.name}\n")
        for word, array in (("v", mesh.positions), ("vt", texcoords * [1, -1] + [0, 1]), ("vn", mesh.normals)):
            for row in array:
                out.write(f"{word} {' '.join(repr(float(x)) for x in row)}\n")
        for a, b, c in mesh.indices.reshape(-1, 3) + 1:
            out.write(f"f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}\n")
    return file


# A texel tilted by 0.3 and 0.2, in 8 bits.
FIRST = np.array([0.3, 0.2, np.sqrt(1 - 0.3**2 - 0.2**2)])
CODES = np.round(128 + 127 * FIRST).astype(np.uint8)


def stretched_gltf(side=8):
    """A rectangle of 2 x 1 with uv over the unit square and a one-texel map for MikkTSpace: returns the .gltf, its
    buffer and its texels. Frames from differences halve slopes along u."""
    texel = np.empty((side, side, 4), np.uint8)
    texel[:] = [*CODES, 255]
    floats = np.concatenate([
        np.c_[2 * CORNERS[:, 0], CORNERS[:, 1], np.zeros(4)].ravel(),
        np.tile([0, 0, 1], 4),
        np.tile([1, 0, 0, 1], 4),
        np.c_[CORNERS[:, 0], 1 - CORNERS[:, 1]].ravel(),
    ])
    buffer = floats.astype("<f4").tobytes() + struct.pack("<6H", *TWO)
    views, accessors = [], []
    for kind, width, count in (("VEC3", 3, 4), ("VEC3", 3, 4), ("VEC4", 4, 4), ("VEC2", 2, 4), ("SCALAR", 0, 6)):
        length = 4 * width * count or 2 * count
        views.append({"buffer": 0, "byteOffset": sum(v["byteLength"] for v in views), "byteLength": length})
        accessors.append(
            {"bufferView": len(accessors), "componentType": 5126 if width else 5123, "count": count, "type": kind}
        )
    accessors[0].update(min=[0, 0, 0], max=[2, 1, 0])
    attributes = {"POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3}
    model = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": 4, "material": 0}]}],
        "materials": [{"normalTexture": {"index": 0}}], "textures": [{"source": 0}],
        "images": [{"uri": "the%20map.png"}], "buffers": [{"uri": "plane.bin", "byteLength": len(buffer)}],
        "bufferViews": views, "accessors": accessors,
    }  # fmt: skip
    return json.dumps(model).encode(), buffer, texel


def write_stretched(folder):
    """Writes stretched_gltf as files; returns the path of the .gltf."""
    model, buffer, texel = stretched_gltf()
    (folder / "plane.gltf").write_bytes(model)
    (folder / "plane.bin").write_bytes(buffer)
    cotan.write_image(folder / "the map.png", texel)
    return folder / "plane.gltf"


def degrees(a, b):
    """The angle between two vectors in degrees."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    return np.degrees(np.arccos(min(1, a @ b / np.linalg.norm(a) / np.linalg.norm(b))))
