"""The C API through Python's ctypes: what it exports, what it computes, how it refuses.

    c_api_test.py LIBRARY COTAN_MAP
"""
import ctypes as c
import math
import re
import subprocess
import sys
import threading

library, version_script = sys.argv[1:3]
cotan = c.CDLL(library)
cotan.cotan_version.restype = cotan.cotan_frame_name.restype = c.c_char_p
floats = c.POINTER(c.c_float)


def array(values):
    return (c.c_float * len(values))(*values)


class Struct(c.Structure):
    def __init__(self, *values):
        super().__init__(c.sizeof(type(self)), *values)


class Places(Struct):
    _fields_ = [("size", c.c_size_t), ("count", c.c_size_t)] + [(n, floats) for n in ("normals", "dpdx", "dpdy", "duvdx", "duvdy")]


class Mesh(Struct):
    _fields_ = [("size", c.c_size_t), ("vertex_count", c.c_size_t), ("positions", floats), ("normals", floats), ("texcoords", floats),
                ("index_count", c.c_size_t), ("indices", c.POINTER(c.c_uint32))]


class Picture(Struct):
    _fields_ = [("size", c.c_size_t), ("width", c.c_int), ("height", c.c_int), ("bits", c.c_int), ("pixels", c.c_void_p)]


class Green(c.Structure):
    _fields_ = [("size", c.c_size_t), ("direction", c.c_int), ("swapped", c.c_int), ("confidence", c.c_int), ("agreement", c.c_double),
                ("reason", c.c_char * 256)]


def call(name, *arguments, expect=0):
    message = c.create_string_buffer(256)
    status = getattr(cotan, name)(*arguments, message, c.c_size_t(256))
    assert status == expect, (name, status, message.value)
    assert (message.value == b"") == (status == 0) and b"\n" not in message.value, message.value
    return message.value.decode()


# What is exported is what is written down, no more and no less.
listed = set(re.findall(r"^    (cotan_\w+);", open(version_script).read(), re.M))
lines = subprocess.check_output(["nm", "-D", "--defined-only", library], text=True).splitlines()
exported = {line.split()[-1].split("@")[0] for line in lines} - {"COTAN_1"}
assert exported == listed, exported ^ listed
assert cotan.cotan_api_version() == 1 and re.fullmatch(rb"\d+\.\d+\.\d+", cotan.cotan_version())
frames = [cotan.cotan_frame_name(i).decode() for i in range(cotan.cotan_frame_count())]
assert "cotangent" in frames and "mikktspace" in frames and cotan.cotan_frame_name(99) is None

# A plane whose u runs along -x and v along y: the texel's x goes to -x, its y to +y, whatever the frame.
normals, dpdx, dpdy, duvdx, duvdy = (array(v) for v in ([0, 0, 1], [2, 0, 0], [0, 2, 0], [-1, 0], [0, 1]))
places = Places(1, normals, dpdx, dpdy, duvdx, duvdy)
texel, out, back = array([0.6, 0.48, 0.64]), array([0] * 3), array([0] * 3)
for frame in ("cotangent", "orthonormal", "unit", "exact"):
    call("cotan_frame_apply", frame.encode(), c.byref(places), texel, out)
    assert max(abs(a - b) for a, b in zip(out, (-0.6, 0.48, 0.64))) < 1e-5, (frame, list(out))
    call("cotan_frame_encode", frame.encode(), c.byref(places), out, back)
    assert max(abs(a - b) for a, b in zip(back, texel)) < 1e-5, (frame, list(back))
call("cotan_frame_apply", b"smooth", c.byref(places), texel, out, expect=1)
call("cotan_frame_apply", b"cotangent", None, texel, out, expect=1)
places.size = 8
assert "places.size: expected" in call("cotan_frame_apply", b"cotangent", c.byref(places), texel, out, expect=1)

# Tangents of that plane: -x, and glTF's w for v that runs along y: cross(n, t) = -y is up in the picture, where v falls.
indices = (c.c_uint32 * 3)(0, 1, 2)
mesh = Mesh(3, array([0, 0, 0, 1, 0, 0, 0, 1, 0]), array([0, 0, 1] * 3), array([1, 0, 0, 0, 1, 1]), 3, indices)
tangents = array([0] * 12)
for kind in (b"mikktspace", b"vertex"):
    call("cotan_tangents", kind, c.byref(mesh), 1, tangents)
    assert [round(v, 5) for v in tangents] == [-1, 0, 0, 1] * 3, list(tangents)
indices[2] = 3
assert "mesh.indices[2]: expected less than 3, found 3" in call("cotan_tangents", b"mikktspace", c.byref(mesh), 1, tangents, expect=2)

# A relief of waves as a height, its normals, the green that they show, and the height again.
side = 64
heights = [math.sin(2 * math.pi * x / side) * math.cos(4 * math.pi * y / side) for y in range(side) for x in range(side)]
pixels = array([v for h in heights for v in (h, h, h, 1)])
picture = Picture(side, side, 32, c.cast(pixels, c.c_void_p))
made = (c.c_uint16 * (4 * side * side))()
normal_map = Picture(side, side, 16, c.cast(made, c.c_void_p))
call("cotan_map_from_height", c.byref(picture), c.c_double(2), c.c_double(2), b"gltf", c.byref(normal_map))
green = Green(c.sizeof(Green))
call("cotan_map_green", c.byref(normal_map), c.byref(green))
assert green.direction == 1 and green.swapped == 0 and green.confidence >= 1 and green.agreement > 0.5, green.reason
call("cotan_map_convert", c.byref(normal_map), b"gltf", b"directx", c.byref(normal_map))
call("cotan_map_green", c.byref(normal_map), c.byref(green))
assert green.direction == -1, green.reason
again = array([0] * (side * side))
call("cotan_map_to_height", c.byref(normal_map), b"directx", again)
# Central differences shrink a wave of 32 texels by sin(x)/x with x = 2 pi/32: 0.6 %; those of 64 less.
assert max(abs(a - 2 * h) for a, h in zip(again, heights)) < 0.02 * 2, max(abs(a - 2 * h) for a, h in zip(again, heights))

# Levels arrive largest first, and a caller may stop.
sizes = []
Take = c.CFUNCTYPE(c.c_int, c.c_void_p, c.c_int, c.POINTER(Picture), c.POINTER(Picture))
call("cotan_map_mips", c.byref(normal_map), b"directx", c.c_double(0.3),
     Take(lambda user, level, normals, rough: sizes.append((level, normals[0].width, rough[0].height)) or 0), None)
assert sizes == [(i, side >> i, side >> i) for i in range(7)], sizes
call("cotan_map_mips", c.byref(normal_map), b"directx", c.c_double(0.3), Take(lambda *a: 1), None, expect=1)

# A flat detail changes nothing; the base is unit up to its 8 bits.
flat = (c.c_uint8 * 4)(128, 128, 255, 255)
small = (c.c_uint8 * 16)(*([100, 150, 250, 255] * 4))
result = (c.c_uint8 * 16)()
base, detail, target = Picture(2, 2, 8, c.cast(small, c.c_void_p)), Picture(1, 1, 8, c.cast(flat, c.c_void_p)), Picture(2, 2, 8, c.cast(result, c.c_void_p))
call("cotan_map_blend", c.byref(base), c.byref(detail), b"gltf", b"reoriented", c.c_double(1), c.byref(target))
assert max(abs(a - b) for a, b in zip(result, small)) <= 1, list(result)
for words, name in ((b"gltf,nonsense", "from"), (b"", "from")):
    assert call("cotan_map_convert", c.byref(base), words, b"gltf", c.byref(target), expect=1).startswith(name + ": expected gltf")
assert "signed values need" in call("cotan_map_convert", c.byref(base), b"gltf", b"gltf,signed", c.byref(target), expect=1)
assert "signed values need" in call("cotan_map_blend", c.byref(base), c.byref(detail), b"gltf,signed", b"udn", c.c_double(1), c.byref(target), expect=1)
assert "signed values need" in call("cotan_map_mips", c.byref(base), b"gltf,signed", c.c_double(0.3), Take(lambda *a: 0), None, expect=1)
target.width = 3
assert "expected 2 x 2 pixels" in call("cotan_map_convert", c.byref(base), b"gltf", b"gltf", c.byref(target), expect=1)

# Shader text by its size, then into a buffer; from many threads at once the same.
size = c.c_size_t(0)
call("cotan_shader_text", b"wgsl", b"cotangent", b"gltf", None, c.byref(size))
texts = []


def take_text():
    buffer, length = c.create_string_buffer(size.value), c.c_size_t(size.value)
    call("cotan_shader_text", b"wgsl", b"cotangent", b"gltf", buffer, c.byref(length))
    texts.append(buffer.value)


threads = [threading.Thread(target=take_text) for _ in range(8)]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
assert len(texts) == 8 and len(set(texts)) == 1 and len(texts[0]) == size.value - 1 and b"fn " in texts[0]
print("all of it holds")
