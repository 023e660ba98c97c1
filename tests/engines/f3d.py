"""What F3D does with mirrored uv, for which Cotan has nothing to install: F3D takes no shaders for materials.

    f3d.py TOOL [FOLDER]

The same bumps twice on the same ring: with plain uv, and with mirrored uv and the map mirrored to match. TOOL: cotan, which
adds tangents to both. Exit code 77 if F3D is missing (scripts/try-engines gets it)."""

import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

import numpy as np
import ring

PLAIN = ring.waves(16, 6)


def mirrored(u, v):
    m = PLAIN(1 - u, v)
    return m * [-1, 1, 1]


def read_png(file):
    """Pixels of a PNG file of 8 bits with 3 or 4 channels, not interlaced."""
    data, at, packed = file.read_bytes(), 8, b""
    while at < len(data):
        length, kind = struct.unpack_from(">I4s", data, at)
        packed += data[at + 8 : at + 8 + length] if kind == b"IDAT" else b""
        at += length + 12
    width, height, bits, kind = struct.unpack_from(">IIBB", data, 16)
    assert bits == 8 and kind in (2, 6)
    channels = 3 if kind == 2 else 4
    rows = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, 1 + width * channels)
    pixels = np.zeros((height + 1, width + 1, channels), int)  # row and column 0 are zeros outside
    for y, row in enumerate(rows, 1):
        steps = row[1:].reshape(width, channels).astype(int)
        for x in range(1, width + 1):
            left, up, corner = pixels[y, x - 1], pixels[y - 1, x], pixels[y - 1, x - 1]
            p, q, r = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
            paeth = np.where((p <= q) & (p <= r), left, np.where(q <= r, up, corner))
            pixels[y, x] = (steps[x - 1] + (0, left, up, (left + up) // 2, paeth)[row[0]]) & 255
    return pixels[1:, 1:, :3]


def draw(tool, folder, name):
    subprocess.run([tool, "tangents", folder / f"{name}.gltf", "-o", folder / f"{name}.glb", "--quiet"], check=True)
    words = ("--no-config", "--camera-direction=0,0,-1", "--camera-view-up=0,1,0", "--axis=false", "--filename=false", "--grid=false", "--resolution=256,192")
    ring.run("f3d", f"{name}.glb", f"--output={name}_drawn.png", *words, folder=folder, log=folder / f"{name}.txt")
    return read_png(folder / f"{name}_drawn.png")


def main(tool, folder):
    ring.need("f3d")
    said = ring.run("f3d", "--version", folder=folder, log=folder / "version.txt", screen=False)
    version = next(line.split()[1].rstrip(".") for line in said.splitlines() if line.strip().startswith("Version:"))
    if version.startswith(("1.", "2.")):
        ring.skip(f"F3D {version} is too old (scripts/try-engines)")
    u, v = np.meshgrid(np.linspace(0, 1, 50), np.linspace(0, 1, 50))
    same = ring.degrees(ring.truth(u, v, PLAIN, ring.BASIS), ring.truth(1 - u, v, mirrored, ring.BASIS, True))
    assert same.max() < 1e-5, "the two models have the same normals"
    images = {}
    for name, formula, turned in (("plain", PLAIN, False), ("mirrored", mirrored, True), ("flat", ring.flat, False)):
        ring.write_map(folder / f"{name}.png", formula, 2048, 1024)
        ring.write_rings(folder / f"{name}.gltf", [(f"{name}.png", turned, {"matrix": ring.matrix(0)})])
        images[name] = draw(tool, folder, name)
    surface = np.abs(images["flat"] - images["flat"][0, 0]).max(axis=-1) > 8
    assert 0.1 < surface.mean() < 0.6
    steps = {name: np.abs(images["plain"] - images[name]).max(axis=-1)[surface].mean() for name in ("mirrored", "flat")}
    print(f"F3D {version}: the same bumps with mirrored uv differ by {steps['mirrored']:.1f} steps of 255 in the mean; without bumps by {steps['flat']:.1f}")
    assert steps["mirrored"] > 0.5 * steps["flat"], "F3D has learnt the sign of tangents: docs/engines.md says otherwise"
    print(f"holds: F3D {version} draws mirrored uv as if they were not mirrored")


if __name__ == "__main__":
    if len(sys.argv) > 2:
        main(sys.argv[1], pathlib.Path(sys.argv[2]).resolve())
    else:
        with tempfile.TemporaryDirectory() as place:
            main(sys.argv[1], pathlib.Path(place))
