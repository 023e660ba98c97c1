#!/usr/bin/env python3
"""What each command of a table prints and writes, against what it printed and wrote when it was last accepted.

  output_bytes.py TOOL TABLE                says which outputs are others than the table's; exit code 1 if one is
  output_bytes.py TOOL TABLE --accept       writes the outputs of now into the table
  output_bytes.py TOOL TABLE --first        the same, and ends at the first that is another one
  output_bytes.py TOOL TABLE --keep FOLDER  leaves all outputs there, to be looked at

The table has a command a line, and below it its outputs with the first 16 digits of their SHA-256. Commands run in one
folder, from top to bottom: one may read what another wrote. The first inputs are made here. Pictures count by their
pixels, so that another zlib is no change; times are left out. To add a command, write its line and --accept.
Embree takes other instructions on other processors: keep bakes to 8 bits and small sizes, or their last bits differ.
"""
import hashlib
import json
import math
import os
import pathlib
import platform
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

SKIPPED = 77  # the exit code that CMake's SKIP_RETURN_CODE names
NOT_BUILT = hashlib.sha256(b"3").hexdigest()[:16]  # as an exit code in the table


# Inputs.

def png(path, width, height, channels, bits, sample):
    """A PNG whose channel c of the texel x, y is sample(x, y, c), an integer."""
    pack = (lambda v: struct.pack(">H", v)) if bits == 16 else (lambda v: bytes([v]))
    rows = b"".join(b"\0" + b"".join(pack(sample(x, y, c)) for x in range(width) for c in range(channels)) for y in range(height))

    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    header = struct.pack(">IIBBBBB", width, height, bits, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def relief(u, v):
    """A height that repeats with the unit square, in units of its side."""
    return 0.02 * math.sin(4 * math.pi * u) * math.cos(2 * math.pi * v) + 0.01 * math.cos(6 * math.pi * (u + v))


def relief_normal(u, v):
    step = 1e-4
    x = -(relief(u + step, v) - relief(u - step, v)) / (2 * step)
    y = -(relief(u, v + step) - relief(u, v - step)) / (2 * step)
    length = math.sqrt(x * x + y * y + 1)
    return x / length, y / length, 1 / length


def patch(segments, bumps):
    """Positions, normals, texture coordinates (sheared, v down) and triangles of a piece of a bumpy barrel."""
    positions, normals, coordinates, triangles = [], [], [], []
    for j in range(segments + 1):
        for i in range(segments + 1):
            u, v = i / segments, j / segments
            angle, up = 1.2 * (u - 0.5), v - 0.5
            radius = 1 + 0.2 * math.cos(up) + bumps * relief(u, v)
            n = [math.sin(angle), 0.2 * math.sin(up), math.cos(angle)]
            length = math.sqrt(sum(x * x for x in n))
            positions.append([round(radius * math.sin(angle), 6), round(up, 6), round(radius * math.cos(angle), 6)])
            normals.append([round(x / length, 6) for x in n])
            coordinates.append([round(0.06 + 0.7 * u + 0.16 * v, 6), round(0.95 - 0.9 * v, 6)])
    for j in range(segments):
        for i in range(segments):
            a = j * (segments + 1) + i
            b, c, d = a + 1, a + segments + 1, a + segments + 2
            triangles += [[a, b, d], [a, d, c]]
    return positions, normals, coordinates, triangles


def obj(path, name, mesh, outwards=0.0, with_normals=True):
    positions, normals, coordinates, triangles = mesh
    lines = [f"o {name}"]
    lines += ["v " + " ".join(f"{x + outwards * n:.6f}" for x, n in zip(p, m)) for p, m in zip(positions, normals)]
    lines += [f"vt {u:.6f} {1 - v:.6f}" for u, v in coordinates]
    if with_normals:
        lines += ["vn " + " ".join(f"{x:.6f}" for x in n) for n in normals]
    corner = (lambda i: f"{i + 1}/{i + 1}/{i + 1}") if with_normals else (lambda i: f"{i + 1}/{i + 1}")
    lines += ["f " + " ".join(corner(i) for i in t) for t in triangles]
    path.write_text("\n".join(lines) + "\n")


def gltf(path, mesh, picture, with_tangents):
    positions, normals, coordinates, triangles = mesh
    data, views, accessors = b"", [], []

    def add(values, form, kind, component):
        nonlocal data
        packed = b"".join(struct.pack("<" + form * len(v), *v) for v in values)
        views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(packed)})
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "type": kind,
                          "count": len(values) * (3 if kind == "SCALAR" else 1)})
        data += packed
        return len(accessors) - 1
    attributes = {"POSITION": add(positions, "f", "VEC3", 5126), "NORMAL": add(normals, "f", "VEC3", 5126),
                  "TEXCOORD_0": add(coordinates, "f", "VEC2", 5126)}
    accessors[0]["min"] = [min(p[k] for p in positions) for k in range(3)]
    accessors[0]["max"] = [max(p[k] for p in positions) for k in range(3)]
    if with_tangents:  # around the barrel, which is not along u: the coordinates are sheared
        around = [[round(n[2], 6), 0.0, round(-n[0], 6)] for n in normals]
        lengths = [math.sqrt(t[0] * t[0] + t[2] * t[2]) for t in around]
        attributes["TANGENT"] = add([[t[0] / l, 0.0, t[2] / l, 1.0] for t, l in zip(around, lengths)], "f", "VEC4", 5126)
    indices = add(triangles, "I", "SCALAR", 5125)
    root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [-1, 1, 1]}],
            "meshes": [{"primitives": [{"attributes": attributes, "indices": indices, "material": 0}]}],
            "materials": [{"normalTexture": {"index": 0}, "pbrMetallicRoughness": {"roughnessFactor": 0.4}}],
            "textures": [{"source": 0}], "images": [{"uri": picture}], "bufferViews": views, "accessors": accessors,
            "buffers": [{"uri": path.stem + ".bin", "byteLength": len(data)}]}
    path.with_suffix(".bin").write_bytes(data)
    path.write_text(json.dumps(root, indent=1))


def make_inputs(folder):
    def code(value):
        return int(math.floor(128 + 127 * value + 0.5))
    png(folder / "height.png", 48, 32, 1, 16, lambda x, y, c: int(32768 + 1e6 * relief((x + 0.5) / 48, (y + 0.5) / 32)))
    png(folder / "rocks.png", 48, 48, 3, 8, lambda x, y, c: code(relief_normal((x + 0.5) / 48, 1 - (y + 0.5) / 48)[c]))
    png(folder / "grain.png", 16, 16, 3, 8, lambda x, y, c: code(relief_normal((x + 0.5) / 16, 1 - (y + 0.5) / 16)[c]))
    png(folder / "mask.png", 48, 48, 1, 8, lambda x, y, c: 5 * x)
    low, high = patch(4, 0), patch(24, 1)
    obj(folder / "low.obj", "part_low", low)
    obj(folder / "cage.obj", "cage", low, outwards=0.08)
    obj(folder / "high.obj", "part_high", high, with_normals=False)
    gltf(folder / "panel.gltf", low, "rocks.png", with_tangents=True)
    gltf(folder / "plain.gltf", low, "rocks.png", with_tangents=False)


# Outputs.

def png_pixels(data):
    """The parts of a PNG but its compressed data, and the rows of that: of small ones without their filters."""
    at, rest, packed = 8, b"", b""
    while at < len(data):
        size, name = struct.unpack(">I4s", data[at:at + 8])
        if name == b"IDAT":
            packed += data[at + 8:at + 8 + size]
        else:
            rest += name + data[at + 8:at + 8 + size]
        at += 12 + size
    width, height, bits, kind = struct.unpack(">IIBB", data[16:26])
    step = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[kind] * bits // 8
    rows, pitch, before = zlib.decompress(packed), step * width, bytearray(step * width)
    if len(rows) > 1 << 18:  # in Python that takes a second each
        return rest + rows
    for y in range(height):
        how, row = rows[y * (pitch + 1)], bytearray(rows[y * (pitch + 1) + 1:(y + 1) * (pitch + 1)])
        for i in range(pitch):
            a, b, c = row[i - step] if i >= step else 0, before[i], before[i - step] if i >= step else 0
            if how == 4:
                p, q, r = abs(b - c), abs(a - c), abs(a + b - 2 * c)
                add = a if p <= q and p <= r else b if q <= r else c
            else:
                add = (0, a, b, (a + b) // 2)[how]
            row[i] = row[i] + add & 255
        rest += row
        before = row
    return rest


# What a run takes, and how well zlib packs, differ from run to run or from machine to machine.
UNSTEADY = (
    (r'"seconds": *\{[^}]*\}', '"seconds": {}'),
    (r'("[A-Za-z_]*(?:second|bytes|memory)[A-Za-z_]*": *)[-+0-9.eE]+', r"\1N"),
    (r"[0-9.]+ s\b", "N s"),
    (r"[0-9.]+( million rays a second|  ?MiB\b)", r"N\1"),
    (r"[0-9]+ bytes, before .*", "N bytes"),
)


def steady(text):
    for pattern, by in UNSTEADY:
        text = re.sub(pattern, by, text)
    return text


def glb_content(data):
    size = struct.unpack("<I", data[12:16])[0]
    root, binary = json.loads(data[20:20 + size]), data[28 + size:]
    parts = []
    for view in root.get("bufferViews", []):
        part = binary[view.get("byteOffset", 0):][:view["byteLength"]]
        parts.append(png_pixels(part) if part.startswith(b"\x89PNG") else part)
        view["byteOffset"], view["byteLength"] = 0, 0
    for buffer in root.get("buffers", []):
        buffer["byteLength"] = 0
    return json.dumps(root).encode() + b"".join(parts)


def content(path):
    data = path.read_bytes()
    if data.startswith(b"\x89PNG"):
        return png_pixels(data)
    if data.startswith(b"glTF"):
        return glb_content(data)
    if path.suffix in (".exr", ".tif"):
        found = subprocess.run(["iinfo", "--hash", path.name], cwd=path.parent, capture_output=True, text=True, check=True)
        return found.stdout.encode()
    if path.suffix in (".json", ".csv", ".txt", ".md", ".html"):
        return steady(data.decode()).encode()
    return data


def outputs(tool, words, folder, known):
    """Runs a command; what it printed and what it wrote, by name."""
    # glibc's sines are others where there is a fused multiply-add.
    environment = {**os.environ, "HOME": str(folder), "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2"}
    run = subprocess.run([tool, *words], cwd=folder, env=environment, capture_output=True, timeout=120, check=False)
    found = {}
    if run.returncode != 0:
        found["exit code"] = str(run.returncode).encode()
    for name, printed in (("standard output", run.stdout), ("standard error", run.stderr)):
        if printed:
            found[name] = steady(printed.decode()).encode()
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            # A file is new, or it was written again.
            state = (path.stat().st_ino, path.stat().st_mtime_ns)
            if known.get(path) != state:
                known[path] = state
                found[str(path.relative_to(folder))] = content(path)
    return {name: hashlib.sha256(data).hexdigest()[:16] for name, data in found.items()}


# The table.

def read_table(path):
    comments, commands = [], []
    for line in path.read_text().splitlines():
        if line.startswith("#") or not line.strip():
            comments.append(line)
        elif line.startswith("cotan "):
            commands.append((line, {}))
        else:
            name, digits = line.strip().rsplit(": ", 1)
            commands[-1][1][name] = digits
    return comments, commands


def write_table(path, comments, commands):
    lines = list(comments)
    for line, found in commands:
        lines.append(line)
        lines += [f"    {name}: {digits}" for name, digits in found.items()]
    path.write_text("\n".join(lines) + "\n")


def difference(old, new):
    names = list(dict.fromkeys([*old, *new]))
    return [f"{name} ({'was not there' if name not in old else 'is missing' if name not in new else 'changed'})"
            for name in names if old.get(name) != new.get(name)]


def main(arguments):
    accept, first = "--accept" in arguments, "--first" in arguments
    arguments = [a for a in arguments if a not in ("--accept", "--first")]
    kept = None
    if "--keep" in arguments and arguments.index("--keep") + 1 < len(arguments):
        at = arguments.index("--keep")
        kept = pathlib.Path(arguments[at + 1])
        del arguments[at:at + 2]
    if len(arguments) != 2 or any(a.startswith("-") for a in arguments):
        print(__doc__, file=sys.stderr)
        return 1
    tool, table = str(pathlib.Path(arguments[0]).resolve()), pathlib.Path(arguments[1])
    for path in (pathlib.Path(tool), table):
        if not path.is_file():
            print(f"output_bytes.py: {path}: no such file", file=sys.stderr)
            return 1
    if platform.machine() != "x86_64":
        print("skipped: the table holds what x86-64 computes; other processors multiply and add in one rounding")
        return SKIPPED
    if not shutil.which("iinfo"):
        print("skipped: no iinfo (package openimageio-tools) to read EXR and TIFF with")
        return SKIPPED
    if kept:
        kept.mkdir(parents=True)
    folder = kept or pathlib.Path(tempfile.mkdtemp(prefix="cotan-bytes-"))
    try:
        comments, commands = read_table(table)
        make_inputs(folder)
        known = {path: (path.stat().st_ino, path.stat().st_mtime_ns) for path in folder.rglob("*")}
        now, changed = [], 0
        for line, old in commands:
            new = outputs(tool, line.split()[1:], folder, known)
            if new.get("exit code") == NOT_BUILT:
                print(f"skipped: this tool was built without what `{line}` needs")
                return SKIPPED
            now.append((line, new))
            if old != new:
                changed += 1
                print(f"{line}\n    {', '.join(difference(old, new))}")
                if first:
                    return 1
    finally:
        if not kept:
            shutil.rmtree(folder)
    if accept:
        write_table(table, comments, now)
        print(f"{changed} of {len(commands)} commands accepted with other outputs than before")
        return 0
    if changed:
        print(f"{changed} of {len(commands)} commands give other outputs than {table} holds (later ones read what earlier ones wrote). "
              f"To look at them: {sys.argv[0]} {tool} {table} --keep FOLDER, with the tool of before and of now. "
              "If the change is wanted: the same with --accept instead, and say in the commit what changed and why.")
    return 1 if changed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
