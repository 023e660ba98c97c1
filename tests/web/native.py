"""Writes the results of the native library for the input of tests/web: native.py LIBRARY tangents|model FOLDER

tangents: from FOLDER/mesh.bin (vertices, corners, positions, normals, uvs, indices) to FOLDER/native.bin.
model: from FOLDER/model.glb to FOLDER/lint.json, converted.json and converted.glb.
"""
import ctypes as c
import pathlib
import struct
import sys

library, what, folder = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
cotan = c.CDLL(library)


class Mesh(c.Structure):
    _fields_ = [("size", c.c_size_t), ("vertex_count", c.c_size_t), ("positions", c.c_void_p), ("normals", c.c_void_p),
                ("texcoords", c.c_void_p), ("index_count", c.c_size_t), ("indices", c.c_void_p)]


def call(name, *arguments):
    message = c.create_string_buffer(1024)
    if getattr(cotan, name)(*arguments, message, c.c_size_t(1024)) != 0:
        sys.exit(name + ": " + message.value.decode())


def tangents():
    data = (folder / "mesh.bin").read_bytes()
    vertices, corners = struct.unpack_from("<2I", data)
    held = c.create_string_buffer(data[8:], len(data) - 8)
    at = c.addressof(held)
    mesh = Mesh(c.sizeof(Mesh), vertices, at, at + 12 * vertices, at + 24 * vertices, corners, at + 32 * vertices)
    out = b""
    for kind in (b"mikktspace", b"vertex"):
        made = (c.c_float * (4 * corners))()
        call("cotan_tangents", kind, c.byref(mesh), 0, made)
        out += bytes(made)
    for name, count, extra in (("cotan_smooth_cotangents", vertices, ()), ("cotan_triangle_vectors", corners // 3, (0,))):
        u, v = (c.c_float * (3 * count))(), (c.c_float * (3 * count))()
        call(name, c.byref(mesh), *extra, u, v)
        out += bytes(u) + bytes(v)
    (folder / "native.bin").write_bytes(out)


def take(handle):
    cotan.cotan_bytes_data.restype, cotan.cotan_bytes_size.restype = c.c_void_p, c.c_size_t
    return c.string_at(cotan.cotan_bytes_data(handle), cotan.cotan_bytes_size(handle))


class ConvertOptions(c.Structure):  # the fields of version 1
    _fields_ = [("size", c.c_size_t), ("from", c.c_char_p), ("to", c.c_char_p)] + [
        (name, c.c_int) for name in ("bits", "keep_tangents", "generate_tangents", "threads")] + [("progress", c.c_void_p), ("user", c.c_void_p)]


def model():
    data = (folder / "model.glb").read_bytes()
    report, glb = c.c_void_p(), c.c_void_p()
    call("cotan_lint_gltf", data, c.c_size_t(len(data)), None, None, None, c.byref(report))
    (folder / "lint.json").write_bytes(take(report))
    options = ConvertOptions(size=c.sizeof(ConvertOptions), to=b"cotangent")
    call("cotan_convert_gltf", data, c.c_size_t(len(data)), None, c.byref(options), None, c.byref(glb), c.byref(report))
    (folder / "converted.json").write_bytes(take(report))
    (folder / "converted.glb").write_bytes(take(glb))


{"tangents": tangents, "model": model}[what]()
