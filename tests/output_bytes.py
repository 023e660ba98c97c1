#!/usr/bin/env python3
"""Compares the images, maps, models and shaders of each command of a table with those that were last accepted.

  output_bytes.py TOOL TABLE                lists the outputs that differ from the table's; exit code 1 if any does
  output_bytes.py TOOL TABLE --accept       writes the current outputs into the table
  output_bytes.py TOOL TABLE --first        lists the differences, and ends at the first
  output_bytes.py TOOL TABLE --keep FOLDER  keeps all outputs there for inspection
  output_bytes.py TOOL TABLE --where-built  leaves out commands that need a library that the tool was built without,
                                            and those that read their outputs; says how many were compared

The table has one command per line, followed by its outputs with the first 16 digits of their SHA-256. Texts and reports
are no part of it: other tests read them, and every changed word would change the table. Commands run in one folder from top to bottom, so a command may read the outputs of earlier ones; make_inputs writes the first inputs.
Images are compared by pixels, independent of the zlib version; times are left out. To add a command, add its line and
run --accept. Embree's instructions depend on the processor: keep bakes small and at 8 bits, or their last bits differ.
"""
import hashlib
import json
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

from output_inputs import make_inputs

SKIPPED = 77  # the exit code in CMake's SKIP_RETURN_CODE
NOT_BUILT = hashlib.sha256(b"3").hexdigest()[:16]  # as an exit code in the table


# Outputs.

def png_pixels(data):
    """The chunks of a PNG except its compressed data, and the rows of that data; those of small images unfiltered."""
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
    if len(rows) > 1 << 18:  # Python would take a second for each
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


# Times, and the sizes that zlib reaches, differ between runs or machines.
UNSTEADY = (
    (r'"seconds": *\{[^}]*\}', '"seconds": {}'),
    (r'("[A-Za-z_]*(?:second|bytes|memory)[A-Za-z_]*": *)[-+0-9.eE]+', r"\1N"),
    (r"[0-9.]+ s\b", "N s"),
    (r"[0-9.]+( million rays per second|  ?MiB\b)", r"N\1"),
    (r"[0-9]+ bytes, before .*", "N bytes"),
)


TEXTS = (".json", ".csv", ".txt", ".md", ".html")


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
    if path.suffix in (".exr", ".tif", ".gif"):
        found = subprocess.run(["iinfo", "--hash", path.name], cwd=path.parent, capture_output=True, text=True, check=True)
        return found.stdout.encode()
    if path.suffix in TEXTS:
        return steady(data.decode()).encode()
    return data


def outputs(tool, words, folder, known):
    """Runs a command and returns its printed output and its files, by name."""
    # glibc's sine differs with fused multiply-add.
    environment = {**os.environ, "HOME": str(folder), "GLIBC_TUNABLES": "glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2"}
    run = subprocess.run([tool, *words], cwd=folder, env=environment, capture_output=True, timeout=120, check=False)
    found = {}
    if run.returncode != 0:
        found["exit code"] = str(run.returncode).encode()
    if words[0] == "shader" and run.stdout:
        found["standard output"] = steady(run.stdout.decode()).encode()
    for path in sorted(folder.rglob("*")):
        if path.is_file():
            # Counts files that are new or were rewritten.
            state = (path.stat().st_ino, path.stat().st_mtime_ns)
            if known.get(path) != state:
                known[path] = state
                if path.suffix in TEXTS:
                    continue
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
    accept, first, where_built = (option in arguments for option in ("--accept", "--first", "--where-built"))
    arguments = [a for a in arguments if a not in ("--accept", "--first", "--where-built")]
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
        now, changed, absent = [], 0, set()
        for line, old in commands:
            new = {} if absent.intersection(line.split()) else outputs(tool, line.split()[1:], folder, known)
            left_out = absent.intersection(line.split()) or new.get("exit code") == NOT_BUILT != old.get("exit code")
            if where_built and left_out:
                absent.update(old)
                continue
            if left_out:
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
    if where_built:
        print(f"{len(now)} of {len(commands)} commands compared, {changed} differ")
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
