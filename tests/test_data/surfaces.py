"""Flat grids under every transform of uv, the waves that bakes are compared with, OBJ models, and normal maps."""

import json

import numpy as np

from files import Gltf, obj, png
import shapes
from shapes import Mesh

WAVES = ((0.011, 5, 0, 0.3), (0.008, 3, 5, 1.1), (0.006, -2, 4, 2.0))  # height, waves along u and v (up), phase


def waves(u, v):
    """Height of the waves and its slopes along u and v, v up."""
    h = hu = hv = 0
    for height, a, b, phase in WAVES:
        angle = 2 * np.pi * (a * u + b * v) + phase
        h = h + height * np.sin(angle)
        hu, hv = hu + 2 * np.pi * a * height * np.cos(angle), hv + 2 * np.pi * b * height * np.cos(angle)
    return h, hu, hv


def waves_downwards(u, v):
    """The slopes of the waves for maps, whose v points down."""
    _, hu, hv = waves(u, 1 - v)
    return hu, -hv


# Name; u and v of a point (x, y) of the unit square, y up; the node.
CASES = (
    ("identity", lambda x, y: (x, 1 - y), {}),
    ("rotated90", lambda x, y: (y, x), {}),
    ("rotated30", lambda x, y: (0.866 * x - 0.5 * y, 1 - 0.5 * x - 0.866 * y), {}),
    ("mirrored_u", lambda x, y: (1 - x, 1 - y), {}),
    ("mirrored_v", lambda x, y: (x, y), {}),
    ("mirrored_both", lambda x, y: (1 - x, y), {}),
    ("sheared", lambda x, y: (x + 0.6 * y, 1 - y), {}),
    ("stretched4", lambda x, y: (4 * x, 1 - y), {}),
    ("tiled3", lambda x, y: (3 * x - 1, 1 - 3 * y), {}),
    ("tiny", lambda x, y: (0.5 + 1e-4 * x, 0.5 - 1e-4 * y), {}),
    ("degenerate_line", lambda x, y: (x, 0.5 + 0 * y), {}),
    ("degenerate_point", lambda x, y: (0.25 + 0 * x, 0.75 + 0 * y), {}),
    ("node_nonuniform", lambda x, y: (x, 1 - y), {"scale": [1, 2.5, 1]}),
    ("node_negative_x", lambda x, y: (x, 1 - y), {"scale": [-1, 1, 1]}),
    ("node_negative_xyz", lambda x, y: (x, 1 - y), {"scale": [-1, -1, -1]}),
    ("node_rotated", lambda x, y: (x, 1 - y), {"rotation": [0, 0, 0.70710678, 0.70710678]}),
)


def tangent_of(uv):
    """The exact tangent of a grid: the direction of growing u, across which v is constant. w: the sign of the uv area
    in (u, -v). Grids whose uv have no area have the tangent (1, 0, 0, 1), as MikkTSpace gives them."""
    du, dv = uv(1, 0)[0] - uv(0, 0)[0], uv(0, 1)[0] - uv(0, 0)[0]
    eu, ev = uv(1, 0)[1] - uv(0, 0)[1], uv(0, 1)[1] - uv(0, 0)[1]
    area = du * ev - dv * eu
    if area == 0:
        return np.array([1.0, 0, 0, 1])
    # dp/du: v stays constant along it. MikkTSpace has this direction, times the sign of the area.
    direction = np.array([ev, -eu]) / area
    return np.array([*(direction / np.hypot(*direction)), 0, -np.sign(area)])


def uv_cases(folder):
    flat = shapes.surface(lambda s, t: (s - 0.5, t - 0.5, 0 * s), 4, 4)
    for tangents in (False, True):
        gltf = Gltf()
        gltf.image(shapes.relief_map(waves_downwards, 256), "waves_normal_gl.png")
        gltf.list("samplers", {"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 10497})
        gltf.root["textures"][0]["sampler"] = 0
        gltf.list("materials", {"name": "relief", "doubleSided": True, "normalTexture": {"index": 0},
                                "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.8, 0.8, 1], "metallicFactor": 0,
                                                         "roughnessFactor": 0.5}})
        for k, (name, uv, node) in enumerate(CASES):
            u, v = uv(flat.position[:, 0] + 0.5, flat.position[:, 1] + 0.5)
            mesh = Mesh(flat.position, flat.normal, np.stack([u, v], 1), flat.triangles,
                        np.tile(tangent_of(uv), (len(u), 1)) if tangents else None)
            gltf.mesh(mesh, 0, name=name, node={"translation": [1.5 * (k % 4), -3.0 * (k // 4), 0], **node})
        gltf.write(folder / f"synthetic/uv_cases{'_tangents' if tangents else ''}.gltf")


def synthetic_waves(folder):
    place = folder / "bake/synthetic_waves"
    place.mkdir(parents=True)
    quad = shapes.quad((0, 0), (1, 1))
    (place / "low.obj").write_text(obj(quad, [[0, 1, 3, 2]]))
    high = shapes.surface(lambda s, t: (s, t, waves(s, t)[0]), 128, 128)
    _, hu, hv = waves(high.position[:, 0], high.position[:, 1])
    normal = np.stack([-hu, -hv, np.ones_like(hu)], 1)
    high.normal = normal / np.linalg.norm(normal, axis=1, keepdims=True)
    (place / "high.obj").write_text(obj(high))
    normals = shapes.normals_of(waves_downwards, 256)
    for bits in (8, 16):
        most = 2**bits - 1
        kind = np.uint8 if bits == 8 else np.uint16
        for name, green in (("gl", 1), ("dx", -1)) if bits == 8 else (("gl", 1),):
            texels = np.round((normals * [1, green, 1] * 0.5 + 0.5) * most).astype(kind)
            (place / f"normal_{name}{bits}.png").write_bytes(png(texels))
        u, v = np.meshgrid((np.arange(256) + 0.5) / 256, 1 - (np.arange(256) + 0.5) / 256)
        h = waves(u, v)[0]
        (place / f"height{bits}.png").write_bytes(png(np.round((h - h.min()) / (h.max() - h.min()) * most).astype(kind)[..., None]))


def lathe(outline, columns, rows):
    """A closed pot: an outline (radius, height) that turns around y; its ends collapse into points."""
    def of(s, t):
        radius, height = outline(t)
        return radius * np.sin(2 * np.pi * s), height, radius * np.cos(2 * np.pi * s)
    mesh = shapes.surface(of, columns, rows)
    broken = ~(np.linalg.norm(mesh.normal, axis=1) > 0.5)
    mesh.normal[broken] = [0, 1, 0]
    return mesh


def obj_models(folder):
    classic, spot = folder / "classic", folder / "bake/spot"
    classic.mkdir()
    spot.mkdir()
    (classic / "cube.obj").write_text(obj(shapes.cube()))
    (classic / "sphere.obj").write_text(obj(shapes.zone(128, 64, -np.pi / 2 + 1e-3, np.pi / 2 - 1e-3)))
    pot = lambda t: (0.9 * np.abs(np.sin(np.pi * t)) ** 0.7 * (1 - 0.3 * t), 1.2 * t - 0.6)
    (classic / "teapot.obj").write_text(obj(lathe(pot, 96, 64)))
    # 32 patches, each with its own uv square; the first and the last row collapse into points, and the upper rows are
    # strongly stretched.
    patches = []
    for k in range(32):
        low, left = (k // 8) / 4, (k % 8) / 8
        def part(s, t, low=low, left=left):
            radius, height = pot(np.abs(low + t / 4)**1.5)
            return radius * np.sin(2 * np.pi * (left + s / 8)), height, radius * np.cos(2 * np.pi * (left + s / 8))
        patch = shapes.surface(part, 8, 8)
        patch.normal[~(np.linalg.norm(patch.normal, axis=1) > 0.5)] = [0, -1, 0]
        patches.append(patch)
    (classic / "teapot_patches.obj").write_text(obj(shapes.joined(patches)))
    # Hard edges: the sides of prisms have their own normals.
    prisms = []
    for k, sides in enumerate((3, 4, 6, 9)):
        for side in range(sides):
            a, b = 2 * np.pi * side / sides, 2 * np.pi * (side + 1) / sides
            wall = shapes.surface(lambda s, t, a=a, b=b: (np.sin(a) * (1 - s) + np.sin(b) * s, t, np.cos(a) * (1 - s) + np.cos(b) * s), 2, 2)
            prisms.append(wall.moved((2.5 * k, 0, 0)))
    (classic / "normal_map_stress_test_low.obj").write_text(obj(shapes.joined(prisms)))
    low, high = shapes.torus(1, 0.4, 16, 8), shapes.torus(1, 0.4, 64, 32)
    (spot / "spot_low.obj").write_text(obj(low))
    (spot / "spot_high.obj").write_text(obj(high))
    quads = [[a, a + 1, a + 66, a + 65] for a in range(32 * 65) if a % 65 < 64]
    (spot / "spot_quads.obj").write_text(obj(high, quads))


def textures(folder):
    """Normal maps, with what is true of their green in CONVENTIONS.tsv."""
    place = folder / "textures"
    place.mkdir()
    relief = shapes.domes(3)
    rows = ["file\tgreen\thow it is known"]
    for name, truth, slopes, size, bits in (
            ("cube_normal_gl.png", "+Y", relief, 256, 8),
            ("scratched_gold_normal_dx.png", "-Y", shapes.domes(11, 0.5), 512, 8),
            ("noise16_normal_gl.png", "+Y", shapes.domes(7, 0.4), 512, 16),
            ("sofa_normal_gl.png", "+Y", shapes.bumps(1.6), 512, 8),
            ("ornament_normal_gl.png", "+Y", shapes.domes(5, 0.4), 204, 8),
            ("mesh_wire_normal.png", "undecidable", shapes.grooves(0.5), 256, 8)):
        texels = shapes.relief_map(slopes, size, bits=bits, green=-1 if truth == "-Y" else 1)
        (place / name).write_bytes(png(texels))
        rows.append(f"{name}\t{truth}\tmade by scripts/test-data from a formula")
    u, v = np.meshgrid((np.arange(256) + 0.5) / 256, (np.arange(256) + 0.5) / 256)
    (place / "plain_heightmap.png").write_bytes(png(np.round(127 + 100 * np.sin(9 * u) * np.cos(7 * v)).astype(np.uint8)[..., None]))
    (place / "CONVENTIONS.tsv").write_text("\n".join(rows) + "\n")


def make(folder):
    uv_cases(folder)
    synthetic_waves(folder)
    obj_models(folder)
    textures(folder)
