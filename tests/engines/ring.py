"""What the tests of engines share: rings whose normals are a formula, their maps and files, and the judge in degrees.

A ring has u around it, v around its tube and down, and normals outwards. Its map has 8 bits, and 128 is zero."""

import json
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import zlib

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
RADIUS, TUBE = 0.7, 0.3


def skip(reason):
    print("skipped: " + reason)
    sys.exit(77)


def degrees(a, b):
    a, b = (x / np.linalg.norm(x, axis=-1, keepdims=True) for x in (a, b))
    return np.degrees(2 * np.arcsin(np.minimum(np.linalg.norm(a - b, axis=-1) / 2, 1)))


def rotation(x, y):
    a, b = np.array([[1, 0, 0], [0, np.cos(x), -np.sin(x)], [0, np.sin(x), np.cos(x)]]), np.array([[np.cos(y), 0, np.sin(y)], [0, 1, 0], [-np.sin(y), 0, np.cos(y)]])
    return a @ b


# ---- Formulas


def waves(around, across):
    def formula(u, v):
        x, y = 0.6 * np.sin(2 * np.pi * around * u), 0.6 * np.sin(2 * np.pi * across * v)
        m = np.stack([x, y, np.ones_like(x)], axis=-1)
        return m / np.linalg.norm(m, axis=-1, keepdims=True)

    return formula


def flat(u, v):
    return np.stack([0 * u, 0 * u, np.ones_like(u)], axis=-1)


def ring(u, v):
    """Position, normal, direction of u, and direction up the image, against v."""
    a, b = 2 * np.pi * u, 2 * np.pi * v
    zero = np.zeros_like(a)
    outwards = np.stack([np.sin(a), zero, np.cos(a)], axis=-1)
    normal = outwards * np.cos(b)[..., None] + np.stack([zero, -np.sin(b), zero], axis=-1)
    along = np.stack([np.cos(a), zero, -np.sin(a)], axis=-1)
    up = outwards * np.sin(b)[..., None] + np.stack([zero, np.cos(b), zero], axis=-1)
    return outwards * RADIUS + normal * TUBE, normal, along, up


def truth(u, v, formula, basis, mirrored=False):
    """The normal of a ring with a map. mirrored: its u runs the other way around."""
    m = formula(u, v)
    _, normal, along, up = ring(1 - u if mirrored else u, v)
    return (along * m[..., :1] * (-1 if mirrored else 1) + up * m[..., 1:2] + normal * m[..., 2:]) @ basis.T


# ---- Files


def write_png(file, pixels):
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)), (b"IDAT", zlib.compress(rows)), (b"IEND", b"")]
    data = b"".join(struct.pack(">I", len(c)) + n + c + struct.pack(">I", zlib.crc32(n + c)) for n, c in chunks)
    file.write_bytes(b"\x89PNG\r\n\x1a\n" + data)


def map_pixels(formula, width, height):
    u, v = np.meshgrid((np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height)
    return np.round(127 * formula(u, v) + 128).astype(np.uint8)


def write_map(file, formula, width, height):
    write_png(file, map_pixels(formula, width, height))


def ring_mesh(mirrored=False, columns=128, rows=64):
    """Positions, normals, uv and corners of triangles."""
    u, v = np.meshgrid(np.arange(columns + 1) / columns, np.arange(rows + 1) / rows)
    position, normal, _, _ = ring(u, v)
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    below = first + columns + 1
    corners = np.stack([first, below, first + 1, first + 1, below, below + 1], axis=-1).ravel()
    uv = np.stack([1 - u if mirrored else u, v], axis=-1)
    return position.reshape(-1, 3).astype(np.float32), normal.reshape(-1, 3).astype(np.float32), uv.reshape(-1, 2).astype(np.float32), corners.astype(np.uint16)


def write_rings(file, rings, inside_out=False):
    """A glTF file without tangents. rings: for each the name of its map, whether it is mirrored, and its node. inside_out:
    whoever sees the rings sees the backs of triangles."""
    views, parts, accessors, at = [], [], [], 0
    meshes, materials, nodes = [], [], []
    for k, (_, mirrored, node) in enumerate(rings):
        position, *others, corners = ring_mesh(mirrored)
        corners = np.ascontiguousarray(corners[::-1]) if inside_out else corners
        for part, kind in zip((position, *others, corners), ("VEC3", "VEC3", "VEC2", "SCALAR")):
            views.append({"buffer": 0, "byteOffset": at, "byteLength": part.nbytes})
            accessors.append({"bufferView": len(views) - 1, "componentType": 5126 if part.dtype == np.float32 else 5123, "count": len(part), "type": kind})
            parts.append(part.tobytes() + b"\0" * (-part.nbytes % 4))
            at += len(parts[-1])
        accessors[4 * k].update(min=position.min(axis=0).tolist(), max=position.max(axis=0).tolist())
        attributes = {"POSITION": 4 * k, "NORMAL": 4 * k + 1, "TEXCOORD_0": 4 * k + 2}
        meshes.append({"primitives": [{"attributes": attributes, "indices": 4 * k + 3, "material": k}]})
        materials.append({"normalTexture": {"index": k}, "pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.6}})
        nodes.append(dict(node, mesh=k))
    file.with_suffix(".bin").write_bytes(b"".join(parts))
    document = {
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(rings)))}], "nodes": nodes, "meshes": meshes, "materials": materials,
        "textures": [{"source": k} for k in range(len(rings))], "images": [{"uri": name} for name, _, _ in rings], "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": at, "uri": file.with_suffix(".bin").name}]}  # fmt: skip
    file.write_text(json.dumps(document))


# ---- The pair: two rings with two maps, side by side, the right one with mirrored uv. An engine draws it 768 x 384, seen
# from (0, 0, 5) with 30 degrees from top to bottom.

WIDTH, HEIGHT, EYE, FIELD = 768, 384, 5.0, 30.0
BASIS = rotation(0.6, 0.3)
PAIR = (("left", waves(16, 6), False, -1.2), ("right", waves(10, 5), True, 1.2))
MAPS = ("bumps", "flat")


def matrix(x):
    """The node of a ring: rotated, and moved along x; by columns, as glTF has it."""
    whole = np.eye(4)
    whole[:3, :3] = BASIS
    whole[0, 3] = x
    return whole.T.ravel().tolist()


def write_pair(folder):
    """bumps.gltf and flat.gltf, the same rings with other maps; inside_out.gltf is bumps.gltf seen from behind."""
    for name, formula, _, _ in PAIR:
        write_map(folder / f"bumps_{name}.png", formula, 2048, 1024)
        write_map(folder / f"flat_{name}.png", flat, 4, 4)
    for file, kind in (("bumps", "bumps"), ("flat", "flat"), ("inside_out", "bumps")):
        rings = [(f"{kind}_{name}.png", mirrored, {"matrix": matrix(x)}) for name, _, mirrored, x in PAIR]
        write_rings(folder / f"{file}.gltf", rings, file == "inside_out")


def judge_pair(engine, kind, whose, pixels):
    """Prints and returns mean and 99 % of each ring. pixels: HEIGHT x WIDTH x 6, the normal in world space, u, v, and 1
    on a surface."""
    assert pixels.shape == (HEIGHT, WIDTH, 6) and np.isfinite(pixels).all()
    results = {}
    for name, formula, mirrored, x in PAIR:
        half = pixels[:, : WIDTH // 2] if x < 0 else pixels[:, WIDTH // 2 :]
        inside = half[..., 5] == 1
        assert 0.2 < inside.mean() < 0.5, (engine, kind, whose, name, inside.mean())
        seen = half[inside]
        assert np.abs(np.linalg.norm(seen[:, :3], axis=-1) - 1).max() < 1e-3, (engine, kind, whose, "no unit vectors")
        error = degrees(seen[:, :3], truth(seen[:, 3], seen[:, 4], formula if kind == "bumps" else flat, BASIS, mirrored))
        results[name] = (error.mean(), np.percentile(error, 99))
        print(f"{engine}, {kind:5} {name:5} {whose:10} mean {error.mean():.3f}, 99 % {np.percentile(error, 99):.2f}")
    return results


def judge_ours(ours, own, bumps_limit=0.4):
    """ours, own: of each kind of map the results of judge_pair, without and with the engine's tangents. The error of bumps
    is that of 8 bits and of filtering a minified map; a flat map has that of interpolating normals."""
    for name, *_ in PAIR:
        assert ours["flat"][name][0] < 0.03, name
        assert ours["bumps"][name][0] < bumps_limit and ours["bumps"][name][0] < own["bumps"][name][0] + 0.001, name


def between(engine, ours, own):
    """Prints the mean of the degrees between two measurements."""
    both = (ours[..., 5] == 1) & (own[..., 5] == 1)
    print(f"{engine}: {degrees(ours[both][:, :3], own[both][:, :3]).mean():.3f} degrees between Cotan and its tangents, in the mean")


def judge_page(engine, version, ours, own=None):
    """The rows of docs/engines.md, if they are of this version. Each has mean and 99 % of the left and the right ring."""
    page = (ROOT / "docs/engines.md").read_text().splitlines()
    if not any(line.startswith(f"| {engine}") and f" | {version} | " in line for line in page):
        print(f"docs/engines.md has another version than {version}: not compared")
        return
    for kind in MAPS:
        for whose, results in (("Cotan", ours), ("its tangents", own))[: 2 if own else 1]:
            start = f"| {engine}, {kind}: {whose} |"
            cells = next(line for line in page if line.startswith(start)).split("|")[2:4]
            for cell, (name, *_) in zip(cells, PAIR):
                mean, high = map(float, cell.split(","))
                measured = results[kind][name]
                assert abs(mean - measured[0]) < 0.01 and abs(high - measured[1]) < 0.05, (start, name, measured)


def judge_lit(file):
    """A lit image of the pair, raw RGB: both rings show relief: many steps of brightness between
    neighbours. Smooth rings have 700."""
    gray = np.frombuffer(file.read_bytes(), np.uint8).reshape(HEIGHT, WIDTH, 3).astype(int).mean(axis=-1)
    steps = np.abs(np.diff(gray, axis=1)) > 12
    halves = [int(steps[:, : WIDTH // 2].sum()), int(steps[:, WIDTH // 2 :].sum())]
    assert min(halves) > 1500, f"{file.name}: the rings have {halves} edges"


# ---- Programs


def run(*words, folder, log, screen=True, **environment):
    """Runs a command, on a screen of its own, and returns its output."""
    display = ["xvfb-run", "-a", "-s", f"-screen 0 {WIDTH}x{HEIGHT}x24"] if screen else []
    whole = dict(os.environ, HOME=str(folder), LIBGL_ALWAYS_SOFTWARE="1", LC_ALL="C.UTF-8", **environment)
    started = subprocess.Popen([*display, *map(str, words)], cwd=folder, env=whole, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               text=True, start_new_session=True)  # fmt: skip
    try:
        said, _ = started.communicate(timeout=120)
    except subprocess.TimeoutExpired:
        os.killpg(started.pid, signal.SIGKILL)
        said, _ = started.communicate()
        said += "\nended after two minutes"
    log.write_text(said)
    assert started.returncode == 0, said[-3000:]
    return said


def need(engine):
    """Skips the test where scripts/try-engines has not made the program of this name. It runs a command where the engine
    is installed."""
    if not shutil.which("xvfb-run") or not shutil.which(engine):
        skip(f"no {engine} or no xvfb-run (scripts/try-engines)")


def functions(tool, *words):
    """The shader text that the command prints."""
    return subprocess.run([tool, "shader", *words, "--quiet"], check=True, capture_output=True, text=True).stdout


def replaced(text, old, new):
    assert text.count(old) == 1, f"{old}: {text.count(old)} times"
    return text.replace(old, new)


# GLSL: a number of -1 to 1 as a colour of 3 x 7 bits, each from 100; read_bytes is its inverse.
NUMBER_BYTES = """
vec3 number_bytes(float x)
{
    float number = floor((clamp(x, -1.0, 1.0) * 0.5 + 0.5) * 2097151.0 + 0.5);
    float high = floor(number / 16384.0);
    float middle = floor((number - high * 16384.0) / 128.0);
    return (vec3(high, middle, number - high * 16384.0 - middle * 128.0) + 100.0) / 255.0;
}
"""


def read_bytes(file, height, width):
    """Six images of bytes: normal, u, v, and 1/4 to check that nothing changes colours. Returns normal, u, v, and where
    there is a surface."""
    bytes_ = np.frombuffer(file.read_bytes(), np.uint8).reshape(6, height, width, 3).astype(int)
    inside = (bytes_ > 0).all(axis=(0, 3))
    digits = bytes_ - 100
    assert ((digits >= 0) & (digits < 128))[:, inside].all(), f"{file.name}: colours that the shader did not write"
    numbers = (digits @ np.array([16384, 128, 1])) / 2097151 * 2 - 1
    assert np.abs(numbers[5][inside] - 0.25).max() < 2e-6, f"{file.name}: the renderer changes colours"
    return np.moveaxis(numbers[:3], 0, -1), numbers[3], numbers[4], inside


def parts_of(file, channels=4):
    """Floats of two images: the normal and 1, then u and v; as judge_pair takes them."""
    images = np.frombuffer(file.read_bytes(), np.float32).reshape(2, HEIGHT, WIDTH, channels).astype(float)
    return np.concatenate([images[0][..., :3], images[1][..., :2], images[0][..., 3:4]], axis=-1)
