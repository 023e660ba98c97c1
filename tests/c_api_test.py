"""The C API through Python's ctypes: what it exports, what it computes and what it refuses.

    c_api_test.py LIBRARY COTAN_MAP"""
import ctypes as c
import json
import math
import re
import struct
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


class SurfacePoints(Struct):
    _fields_ = [("size", c.c_size_t), ("count", c.c_size_t)] + [(n, floats) for n in ("normals", "dpdx", "dpdy", "duvdx", "duvdy")]


class Mesh(Struct):
    _fields_ = [("size", c.c_size_t), ("vertex_count", c.c_size_t), ("positions", floats), ("normals", floats), ("texcoords", floats),
                ("index_count", c.c_size_t), ("indices", c.POINTER(c.c_uint32))]


class ImageView(Struct):
    _fields_ = [("size", c.c_size_t), ("width", c.c_int), ("height", c.c_int), ("bits", c.c_int), ("pixels", c.c_void_p)]


sizes_t, text, Progress = c.c_size_t, c.c_char_p, c.CFUNCTYPE(c.c_int, c.c_void_p, c.c_double)


class InterpolatedPoints(Struct):
    _fields_ = [("size", sizes_t), ("count", sizes_t)] + [(n, floats) for n in ("normals", "tangents", "cotangents_u", "cotangents_v")]


class MapInfo(Struct):
    _fields_ = [("size", sizes_t), ("content", c.c_char * 64), ("zero", c.c_int), ("srgb", c.c_int)] + [
        (n, c.c_double) for n in ("background", "invalid", "below_horizon", "mean_length", "mean_tilt")] + [("mean", c.c_double * 3)]


# The struct of version 2: later members are then 0.
class BakeOptions(Struct):
    _fields_ = [("size", sizes_t)] + [(n, text) for n in ("frame", "kind", "convention")] + [
        (n, c.c_int) for n in ("samples", "padding", "dither", "occlusion_rays")] + [
        ("max_distance", c.c_float), ("threads", c.c_int), ("progress", Progress), ("user", c.c_void_p)]


# The struct of version 3: a shorter one is filled up to its size.
class BakeResult(Struct):
    _fields_ = [(n, sizes_t) for n in ("size", "texels", "covered", "missed", "negative", "twice", "rays")] + [("ray_distance", c.c_double)]


pointer, number = c.POINTER(c.c_void_p), c.POINTER(sizes_t)
Read = c.CFUNCTYPE(c.c_int, c.c_void_p, text, pointer, number)
Decode = c.CFUNCTYPE(c.c_int, c.c_void_p, text, c.c_void_p, sizes_t, c.POINTER(ImageView))
Encode = c.CFUNCTYPE(c.c_int, c.c_void_p, c.POINTER(ImageView), pointer, number)
Done = c.CFUNCTYPE(None, c.c_void_p)


class ModelFiles(Struct):
    _fields_ = [("size", sizes_t), ("user", c.c_void_p), ("read", Read), ("decode", Decode), ("encode", Encode), ("done", Done)]


class LintOptions(Struct):
    _fields_ = [("size", sizes_t), ("distance", c.c_double), ("progress", Progress), ("user", c.c_void_p)]


class LintResult(Struct):
    _fields_ = [("size", sizes_t), ("primitives", sizes_t), ("maps", sizes_t), ("advice", c.c_char * 16), ("maps_to_convert", sizes_t),
                ("distrust_stored", c.c_int), ("green_against", sizes_t)] + [
        (n, c.c_double) for n in ("orthonormal_degrees", "cotangent_degrees", "smooth_degrees")] + [("recommendation", c.c_char * 1024)]


class ConvertOptions(Struct):
    _fields_ = [("size", sizes_t), ("from_", text), ("to", text), ("bits", c.c_int), ("keep_tangents", c.c_int),
                ("generate_tangents", c.c_int), ("threads", c.c_int), ("progress", Progress), ("user", c.c_void_p)]


class ConvertResult(Struct):
    _fields_ = [(n, sizes_t) for n in ("size", "maps_converted", "maps_kept", "primitives_given", "tangent_bytes_dropped")] + [
        (n, c.c_double) for n in ("worst_degrees_before", "worst_degrees_after")]


class Green(c.Structure):
    _fields_ = [("size", c.c_size_t), ("direction", c.c_int), ("swapped", c.c_int), ("confidence", c.c_int), ("agreement", c.c_double),
                ("reason", c.c_char * 256)]


def call(name, *arguments, expect=0):
    message = c.create_string_buffer(256)
    status = getattr(cotan, name)(*arguments, message, c.c_size_t(256))
    if expect in ("built", "file") and status == 3:  # if a part is not built
        assert message.value.startswith(b"not built with "), message.value
        return None
    assert status == {"built": 0, "file": 1}.get(expect, expect), (name, status, message.value)
    assert (message.value == b"") == (status == 0) and b"\n" not in message.value, message.value
    return message.value.decode()


# The exported symbols are exactly those of the version script.
listed = set(re.findall(r"^    (cotan_\w+);", open(version_script).read(), re.M))
lines = subprocess.check_output(["nm", "-D", "--defined-only", library], text=True).splitlines()
exported = {line.split()[-1].split("@")[0] for line in lines} - {"COTAN_1", "COTAN_2", "COTAN_3", "COTAN_5", "COTAN_6", "COTAN_7", "COTAN_9"}
assert exported == listed, exported ^ listed
assert cotan.cotan_api_version() == 9 and re.fullmatch(rb"\d+\.\d+\.\d+", cotan.cotan_version())
# Programs that were linked with the last version find their functions.
old, image = c.create_string_buffer(99), c.c_void_p()
assert cotan.cotan_image_picture(None, c.byref(image), old, c.c_size_t(99)) == 1 and old.value == b"image: expected one, found null"
for name in ("cotan_gltf_pictures", "cotan_conversion_picture"):
    assert hasattr(cotan, name)
frames = [cotan.cotan_frame_name(i).decode() for i in range(cotan.cotan_frame_count())]
assert "cotangent" in frames and "mikktspace" in frames and cotan.cotan_frame_name(99) is None

# A plane with u along -x and v along y: the texel's x goes to -x and its y to +y in every frame.
normals, dpdx, dpdy, duvdx, duvdy = (array(v) for v in ([0, 0, 1], [2, 0, 0], [0, 2, 0], [-1, 0], [0, 1]))
points = SurfacePoints(1, normals, dpdx, dpdy, duvdx, duvdy)
texel, out, back = array([0.6, 0.48, 0.64]), array([0] * 3), array([0] * 3)
for frame in ("cotangent", "orthonormal", "unit", "exact"):
    call("cotan_frame_apply", frame.encode(), c.byref(points), texel, out)
    assert max(abs(a - b) for a, b in zip(out, (-0.6, 0.48, 0.64))) < 1e-5, (frame, list(out))
    call("cotan_frame_encode", frame.encode(), c.byref(points), out, back)
    assert max(abs(a - b) for a, b in zip(back, texel)) < 1e-5, (frame, list(back))
call("cotan_frame_apply", b"smooth", c.byref(points), texel, out, expect=1)
call("cotan_frame_apply", b"cotangent", None, texel, out, expect=1)
points.size = 8
assert "points.size: expected" in call("cotan_frame_apply", b"cotangent", c.byref(points), texel, out, expect=1)

# Tangents of that plane: -x, and glTF's w for v along y: cross(n, t) = -y is up in the image, where v falls.
indices = (c.c_uint32 * 3)(0, 1, 2)
mesh = Mesh(3, array([0, 0, 0, 1, 0, 0, 0, 1, 0]), array([0, 0, 1] * 3), array([1, 0, 0, 0, 1, 1]), 3, indices)
tangents = array([0] * 12)
for kind in (b"mikktspace", b"vertex"):
    call("cotan_tangents", kind, c.byref(mesh), 1, tangents)
    assert [round(v, 5) for v in tangents] == [-1, 0, 0, 1] * 3, list(tangents)
indices[2] = 3
assert "mesh.indices[2]: expected less than 3, found 3" in call("cotan_tangents", b"mikktspace", c.byref(mesh), 1, tangents, expect=2)

# A relief of waves as heights, its normal map, the green convention detected in it, and the heights again.
side = 64
heights = [math.sin(2 * math.pi * x / side) * math.cos(4 * math.pi * y / side) for y in range(side) for x in range(side)]
pixels = array([v for h in heights for v in (h, h, h, 1)])
picture = ImageView(side, side, 32, c.cast(pixels, c.c_void_p))
made = (c.c_uint16 * (4 * side * side))()
normal_map = ImageView(side, side, 16, c.cast(made, c.c_void_p))
call("cotan_map_from_height", c.byref(picture), c.c_double(2), c.c_double(2), b"gltf", c.byref(normal_map))
green = Green(c.sizeof(Green))
call("cotan_map_green", c.byref(normal_map), c.byref(green))
assert green.direction == 1 and green.swapped == 0 and green.confidence >= 1 and green.agreement > 0.5, green.reason
call("cotan_map_convert", c.byref(normal_map), b"gltf", b"directx", c.byref(normal_map))
call("cotan_map_green", c.byref(normal_map), c.byref(green))
assert green.direction == -1, green.reason
again = array([0] * (side * side))
call("cotan_map_to_height", c.byref(normal_map), b"directx", again)
# Central differences shrink a wave of 32 texels by sin(x)/x with x = 2 pi/32: 0.6 %, and one of 64 texels by less.
assert max(abs(a - 2 * h) for a, h in zip(again, heights)) < 0.02 * 2, max(abs(a - 2 * h) for a, h in zip(again, heights))

# Levels arrive largest first, and a caller may stop.
sizes = []
Take = c.CFUNCTYPE(c.c_int, c.c_void_p, c.c_int, c.POINTER(ImageView), c.POINTER(ImageView))
call("cotan_map_mips", c.byref(normal_map), b"directx", c.c_double(0.3),
     Take(lambda user, level, normals, rough: sizes.append((level, normals[0].width, rough[0].height)) or 0), None)
assert sizes == [(i, side >> i, side >> i) for i in range(7)], sizes
call("cotan_map_mips", c.byref(normal_map), b"directx", c.c_double(0.3), Take(lambda *a: 1), None, expect=6)

# A flat detail changes nothing; the base has unit length up to its 8 bits.
flat = (c.c_uint8 * 4)(128, 128, 255, 255)
small = (c.c_uint8 * 16)(*([100, 150, 250, 255] * 4))
result = (c.c_uint8 * 16)()
base, detail, target = ImageView(2, 2, 8, c.cast(small, c.c_void_p)), ImageView(1, 1, 8, c.cast(flat, c.c_void_p)), ImageView(2, 2, 8, c.cast(result, c.c_void_p))
call("cotan_map_blend", c.byref(base), c.byref(detail), b"gltf", b"reoriented", c.c_double(1), c.byref(target))
assert max(abs(a - b) for a, b in zip(result, small)) <= 1, list(result)
for words, name in ((b"gltf,nonsense", "from"), (b"", "from")):
    assert call("cotan_map_convert", c.byref(base), words, b"gltf", c.byref(target), expect=1).startswith(name + ": expected gltf")
assert "signed values need" in call("cotan_map_convert", c.byref(base), b"gltf", b"gltf,signed", c.byref(target), expect=1)
assert "signed values need" in call("cotan_map_blend", c.byref(base), c.byref(detail), b"gltf,signed", b"udn", c.c_double(1), c.byref(target), expect=1)
assert "signed values need" in call("cotan_map_mips", c.byref(base), b"gltf,signed", c.c_double(0.3), Take(lambda *a: 0), None, expect=1)
target.width = 3
assert "expected 2 x 2 pixels" in call("cotan_map_convert", c.byref(base), b"gltf", b"gltf", c.byref(target), expect=1)

# Statistics of a normal map, and of an image that is none.
info = MapInfo()
call("cotan_map_describe", c.byref(normal_map), c.byref(info))
assert info.content == b"tangent space" and abs(info.mean_length - 1) < 1e-3 and 10 < info.mean_tilt < 60, info.content
grey = (c.c_uint8 * 64)(*(v for i in range(16) for v in (i * 16, i * 16, i * 16, 255)))
call("cotan_map_describe", c.byref(ImageView(4, 4, 8, c.cast(grey, c.c_void_p))), c.byref(info))
assert info.content.startswith(b"grey"), info.content

# Frames from vertex attributes: the plane's tangents and cotangents give the same as its differences.
u, v = array([0] * 9), array([0] * 9)
indices[2] = 2
call("cotan_smooth_cotangents", c.byref(mesh), u, v)
for frame, vertex in ((b"mikktspace", InterpolatedPoints(1, normals, tangents, None, None)), (b"vertex", InterpolatedPoints(1, normals, tangents, None, None)),
                      (b"smooth", InterpolatedPoints(1, normals, None, u, v))):
    call("cotan_vertex_frame_apply", frame, c.byref(vertex), texel, out)
    assert max(abs(a - b) for a, b in zip(out, (-0.6, 0.48, 0.64))) < 1e-5, (frame, list(out))
    call("cotan_vertex_frame_encode", frame, c.byref(vertex), out, back)
    assert max(abs(a - b) for a, b in zip(back, texel)) < 1e-5, (frame, list(back))
call("cotan_vertex_frame_apply", b"smooth", c.byref(InterpolatedPoints(1, normals, tangents, None, None)), texel, out, expect=1)

# The plane in other forms. Split: three equal corners share no vertex. U and V: t = cross(n, u) is along +u, -x.
split, sources, count = (c.c_uint32 * 3)(), (c.c_uint32 * 6)(), c.c_size_t()
call("cotan_split_vertices", c.c_size_t(3), c.c_size_t(3), indices, tangents, split, sources, c.byref(count))
assert (list(split), list(sources[:3]), count.value) == ([0, 1, 2], [0, 1, 2], 3)
other = array([0, 1, 0, 1] + [1, 0, 0, 1] * 2)
twice = (c.c_uint32 * 3)(0, 0, 1)
call("cotan_split_vertices", c.c_size_t(2), c.c_size_t(3), twice, other, split, sources, c.byref(count))
assert (list(split), list(sources[:3]), count.value) == ([0, 2, 1], [0, 1, 0], 3), list(split)
call("cotan_split_mirrored", c.byref(mesh), split, sources, c.byref(count))
assert list(split) == [0, 1, 2] and count.value == 3
triangle_u, triangle_v = array([0] * 3), array([0] * 3)
call("cotan_triangle_vectors", c.byref(mesh), 1, triangle_u, triangle_v)
assert triangle_u[1] > 0 and abs(triangle_u[0]) < 1e-6, list(triangle_u)  # cross(z, y) = -x
words = (c.c_uint32 * 3)()
call("cotan_pack_triangles", c.c_size_t(1), triangle_u, triangle_v, words)
halfs = struct.unpack("<6e", bytes(words))
assert max(abs(a - b) for a, b in zip(halfs, list(triangle_u) + list(triangle_v))) < 2e-3, halfs
up, packed8, packed4, packed2 = array([0, 0, 1] * 3), (c.c_int16 * 12)(), (c.c_uint32 * 3)(), (c.c_uint16 * 3)()
call("cotan_pack_smooth8", c.c_size_t(3), up, u, v, packed8)
call("cotan_pack_smooth4", c.c_size_t(3), up, u, v, packed4)
call("cotan_pack_tangents", c.c_size_t(3), up, tangents, packed2)
assert any(packed8) and packed4[0] == packed4[2] != 0 and packed2[0] == packed2[2] != 0
assert "normals: expected an array" in call("cotan_pack_smooth8", c.c_size_t(3), None, u, v, packed8, expect=1)
turned = (c.c_uint32 * 3)()
for last, provokes in ((0, 0), (1, 2)):
    call("cotan_provoking", c.c_size_t(3), c.c_size_t(3), indices, c.c_int(last), split, sources, c.byref(count), turned)
    assert split[provokes] == 0 and count.value == 3 and sources[0] == turned[0], list(split)
assert "indices[2]: expected less than 2, found 2" in call("cotan_provoking", c.c_size_t(2), c.c_size_t(3), indices, c.c_int(0), split, sources, c.byref(count), turned, expect=2)

# A plane that rises by 0.1 towards +x, baked onto the unit square with u along x and v against y.
corners = [0, 0, 1, 0, 1, 1, 0, 1]
xy = list(zip(corners[::2], corners[1::2]))
six = (c.c_uint32 * 6)(0, 1, 2, 0, 2, 3)
low = Mesh(4, array([w for x, y in xy for w in (x, y, 0)]), array([0, 0, 1] * 4), array([w for x, y in xy for w in (x, 1 - y)]), 6, six)
slope = math.hypot(0.1, 1)
high = Mesh(4, array([w for x, y in xy for w in (3 * x - 1, 3 * y - 1, 0.3 * x - 0.15)]), array([-0.1 / slope, 0, 1 / slope] * 4), None, 6, six)
for field, width in (("positions", 3), ("normals", 3), ("texcoords", 2)):
    numbers = getattr(low, field)
    kept, numbers[width + 1] = numbers[width + 1], math.nan
    for function, outputs in (("cotan_tangents", [c.c_int(0), array([0] * 24)]), ("cotan_smooth_cotangents", [array([0] * 12)] * 2)):
        words = ([b"mikktspace"] if function == "cotan_tangents" else []) + [c.byref(low)] + outputs
        assert f"mesh.{field}[1]: expected finite numbers, found nan" in call(function, *words, expect=2)
    numbers[width + 1] = kept
# The same tangents with progress; stopping it leaves the outputs unwritten.
for function, words, outputs in (("tangents", [b"mikktspace"], 24), ("tangents", [b"vertex"], 24), ("smooth_cotangents", [], 12)):
    plain, told = ([array([0] * outputs) for _ in range(1 if words else 2)] for _ in range(2))
    call("cotan_" + function, *words, c.byref(low), *([c.c_int(1)] if words else []), *plain)
    shares = []
    call(f"cotan_{function}_with_progress", *words, c.byref(low), c.c_int(1), Progress(lambda user, done: shares.append(done) or 0), None, *told)
    assert [list(a) for a in told] == [list(a) for a in plain] and shares == sorted(shares) and shares[-1] == 1, (function, shares)
    told[0][0] = 7
    assert call(f"cotan_{function}_with_progress", *words, c.byref(low), c.c_int(1), Progress(lambda user, done: 1), None, *told, expect=6) == "stopped by the caller"
    assert told[0][0] == 7
    call(f"cotan_{function}_with_progress", *words, c.byref(low), c.c_int(-1), Progress(), None, *told, expect=1)
shares = []
options = BakeOptions(None, None, None, 1, 0, 0, 0, 0.5, 1, Progress(lambda user, done: shares.append(done) or 0), None)
pixels8 = (c.c_uint8 * (16 * 16 * 4))()
baked_map = ImageView(16, 16, 8, c.cast(pixels8, c.c_void_p))
baked = BakeResult()
if call("cotan_bake", c.byref(low), c.byref(high), c.byref(options), c.byref(baked_map), c.byref(baked), expect="built") is not None:
    expected = (round(128 - 127 * 0.1 / slope), 128, round(128 + 127 / slope), 255)
    assert all(abs(pixels8[i] - expected[i % 4]) <= 1 for i in range(len(pixels8))), (list(pixels8[:4]), expected)
    assert baked.texels == baked.covered == 256 and baked.missed == 0 and abs(baked.ray_distance - 0.5) < 1e-6
    assert shares[-1] == 1 and all(0 <= s <= 1 for s in shares)
    options.progress = Progress(lambda user, done: 1)
    assert call("cotan_bake", c.byref(low), c.byref(high), c.byref(options), c.byref(baked_map), None, expect=6) == "stopped by the caller"
    options.progress = Progress()
    # Images have v downwards: green points as the convention's name says, here up. This plane rises towards +y.
    leaning = Mesh(4, array([w for x, y in xy for w in (3 * x - 1, 3 * y - 1, 0.3 * y - 0.15)]), array([0, -0.1 / slope, 1 / slope] * 4), None, 6, six)
    for convention, green in ((b"opengl", 128 - 127 * 0.1 / slope), (b"gltf", 128 - 127 * 0.1 / slope), (b"directx", 128 + 127 * 0.1 / slope)):
        options.convention = convention
        call("cotan_bake", c.byref(low), c.byref(leaning), c.byref(options), c.byref(baked_map), None)
        assert abs(pixels8[1] - green) <= 1, (convention, pixels8[1], green)
    options.convention = None
    # The same from models; missing normals are generated.
    pixels = bytes(pixels8)
    models = []
    for given, name in ((low, b"a_low"), (Mesh(4, leaning.positions, None, None, 6, six), b"a_high")):
        models.append(c.c_void_p())
        call("cotan_model_of_meshes", c.c_size_t(1), c.byref(c.pointer(given)), c.byref(text(name)), c.byref(models[-1]))
    cotan.cotan_model_warnings.restype = c.c_char_p
    assert cotan.cotan_model_warnings(models[0]) == b""
    options.convention, lines = b"directx", c.c_void_p()
    call("cotan_bake_models", models[0], c.c_size_t(1), c.byref(models[1]), c.byref(options), c.byref(baked_map), None, c.byref(lines))
    assert bytes(pixels8) == pixels
    cotan.cotan_bytes_free(lines)
    # Two maps of one trace, of 8 and 16 bits.
    pixels16, results = (c.c_uint16 * (16 * 16 * 4))(), (BakeResult(), BakeResult())
    maps = (c.POINTER(ImageView) * 2)(c.pointer(ImageView(16, 16, 16, c.cast(pixels16, c.c_void_p))), c.pointer(baked_map))
    filled = (c.POINTER(BakeResult) * 2)(*map(c.pointer, results))
    kinds, ids = (text * 2)(b"ao", b"normal"), c.c_void_p()
    call("cotan_bake_maps", models[0], c.c_size_t(1), c.byref(models[1]), c.byref(options), c.c_size_t(2), kinds, maps, filled, c.byref(ids), None)
    assert bytes(pixels8) == pixels and set(pixels16) == {65535}, "the plane is open to the sky"
    assert filled[0][0].covered == filled[1][0].covered == 256 and filled[0][0].rays == filled[1][0].rays
    assert cotan.cotan_bytes_size(ids) == 0
    cotan.cotan_bytes_free(ids)
    for model in models:
        cotan.cotan_model_free(model)
    # Meshes whose names pair, and the options that follow the names.
    cotan.cotan_name_role.restype, cotan.cotan_bytes_data.restype = c.c_char_p, c.c_char_p
    assert [cotan.cotan_name_role(n) for n in (b"a_low", b"a_HIGH.001", b"a.cage", b"pillow", None)] == [b"low", b"high", b"cage", b"", b""]
    names, details = (text * 3)(b"a_low", b"a_low.001", b"b_low"), (text * 2)(b"a_high.001", b"A_high")
    groups, of_detail, notes = (c.c_int64 * 3)(), (c.c_int64 * 2)(), c.c_void_p()
    call("cotan_pair_names", c.c_size_t(3), names, c.c_size_t(2), details, groups, of_detail, c.byref(notes))
    assert groups[0] == of_detail[1] >= 0 and groups[1] == of_detail[0] >= 0 and groups[0] != groups[1] and groups[2] == -1
    assert cotan.cotan_bytes_data(notes) in (None, b"") and cotan.cotan_bytes_size(notes) == 0
    cotan.cotan_bytes_free(notes)
    assert "expected arrays, found null" in call("cotan_pair_names", c.c_size_t(3), names, c.c_size_t(2), details, None, of_detail, None, expect=1)
    assert call("cotan_pair_names", c.c_size_t(3), None, c.c_size_t(0), None, None, None, None, expect=1) == "low: expected an array, found null"
    assert "low: expected a model, found null" in call("cotan_bake_models", None, c.c_size_t(0), None, None, c.byref(baked_map), None, None, expect=1)
    options.size -= 8
    assert "options.size: expected" in call("cotan_bake", c.byref(low), c.byref(high), c.byref(options), c.byref(baked_map), None, expect=1)
    options.size += 8
    options.frame = b"cotangent-2013"
    assert "depends on the view" in call("cotan_bake", c.byref(low), c.byref(high), c.byref(options), c.byref(baked_map), None, expect=1)
    options.frame, options.samples = None, 3
    assert call("cotan_bake", c.byref(low), c.byref(high), c.byref(options), c.byref(baked_map), None, expect=1).startswith("options.samples: expected 1, 2 or 4 samples")
    options.samples = 1
    six[5] = 4
    assert "low.indices[5]: expected less than 4" in call("cotan_bake", c.byref(low), c.byref(high), None, c.byref(baked_map), None, expect=2)
    six[5] = 3

# Parts of file names.
parts, given = c.c_void_p(), (text * 4)(b"a b", b"a_b", b"..", b"Lid")
call("cotan_file_names", c.c_size_t(4), given, c.c_size_t(1), (text * 1)(b"lid"), c.byref(parts))
cotan.cotan_bytes_data.restype = c.c_void_p
assert c.string_at(cotan.cotan_bytes_data(parts), cotan.cotan_bytes_size(parts)) == b"a_b-2\na_b\n__\nLid-2\n"
cotan.cotan_bytes_free(parts)
assert call("cotan_file_names", c.c_size_t(1), None, c.c_size_t(0), None, c.byref(parts), expect=1) == "names: expected an array, found null"

# A model in memory, with its files and images: a rectangle of 2 x 1 whose uv fill the unit square, all texels equal,
# for MikkTSpace. Frames from differences see u half as steep as v. Only this test decodes its images.
PNG, side = b"\x89PNG\r\n\x1a\n" + bytes(40), 8
first = (0.3, 0.2, math.sqrt(1 - 0.3 ** 2 - 0.2 ** 2))
floats_of = [w for x, y in xy for w in (2 * x, y, 0)] + [0, 0, 1] * 4 + [1, 0, 0, 1] * 4 + [w for x, y in xy for w in (x, 1 - y)]
buffer = struct.pack(f"<{len(floats_of)}f6H", *floats_of, 0, 1, 2, 0, 2, 3)
views, accessors = [], []
for kind, width, count in (("VEC3", 3, 4), ("VEC3", 3, 4), ("VEC4", 4, 4), ("VEC2", 2, 4), ("SCALAR", 0, 6)):
    length = 4 * width * count or 2 * count
    views.append({"buffer": 0, "byteOffset": sum(view["byteLength"] for view in views), "byteLength": length})
    accessors.append({"bufferView": len(accessors), "componentType": 5126 if width else 5123, "count": count, "type": kind})
accessors[0].update(min=[0, 0, 0], max=[2, 1, 0])
model = json.dumps({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TANGENT": 2, "TEXCOORD_0": 3}, "indices": 4, "material": 0}]}],
    "materials": [{"normalTexture": {"index": 0}}], "textures": [{"source": 0}], "images": [{"uri": "the%20map.png"}],
    "buffers": [{"uri": "plane.bin", "byteLength": len(buffer)}], "bufferViews": views, "accessors": accessors}).encode()
beside, encoded, kept, asked = {b"plane.bin": buffer, b"the map.png": PNG}, [], [], []


def give(data, bytes_out, size_out):
    kept.append(c.create_string_buffer(data, len(data)))
    bytes_out[0], size_out[0] = c.cast(kept[-1], c.c_void_p).value, len(data)
    return 0


def read(user, uri, bytes_out, size_out):
    asked.append(uri)
    return give(beside[uri], bytes_out, size_out) if uri in beside else 1


def decode(user, name, data, length, picture):
    data = c.string_at(data, length)
    texels = encoded[data[-1] - 1] if data[-1] else bytes(round(128 + 127 * w) for w in first) + b"\xff"
    kept.append(c.create_string_buffer(texels * (side * side), 4 * side * side))
    picture[0].width = picture[0].height = side
    picture[0].bits, picture[0].pixels = 8, c.cast(kept[-1], c.c_void_p)
    return 0


def encode(user, picture, bytes_out, size_out):
    encoded.append(c.string_at(picture[0].pixels, 4))
    return give(PNG[:-1] + bytes([len(encoded)]), bytes_out, size_out)


def take(handle):
    cotan.cotan_bytes_data.restype, cotan.cotan_bytes_size.restype = c.c_void_p, c.c_size_t
    data = c.string_at(cotan.cotan_bytes_data(handle), cotan.cotan_bytes_size(handle))
    cotan.cotan_bytes_free(handle)
    return data


def degrees(a, b):
    return math.degrees(math.acos(min(1, sum(x * y for x, y in zip(a, b)) / math.hypot(*a) / math.hypot(*b))))


files = ModelFiles(None, Read(read), Decode(decode), Encode(encode), Done(lambda user: kept.clear()))
lint, report = LintResult(), c.c_void_p()


def lint_of(data):
    return call("cotan_lint_gltf", data, c.c_size_t(len(data)), c.byref(files), None, c.byref(lint), c.byref(report), expect="built")


if lint_of(model) is not None:
    assert asked == [b"plane.bin", b"the map.png"] and not kept
    stored = tuple(round(127 * w) for w in first)
    # 8 bits for the texel, floats for all else.
    assert abs(lint.cotangent_degrees - degrees(stored, (stored[0] / 2, stored[1], stored[2]))) < 0.01, lint.cotangent_degrees
    assert lint.primitives == lint.maps == 1 and abs(lint.orthonormal_degrees) < 0.01 and lint.distrust_stored == 0
    said = json.loads(take(report))
    assert said["recommendation"] == lint.recommendation.decode() and said["primitives"][0]["triangles"] == 2

    # A check: options with the size of version 4.
    class CheckOptions(Struct):
        _fields_ = LintOptions._fields_ + [("limit", c.c_double), ("limit_area", c.c_double), ("frame", text)]

    for limit, frame, passed in ((90, b"cotangent", True), (1, b"cotangent", False), (1, None, True), (0, None, None)):
        check = CheckOptions(0, Progress(), None, limit, 0, frame)
        call("cotan_lint_gltf", model, c.c_size_t(len(model)), c.byref(files), c.byref(check), None, c.byref(report))
        found = json.loads(take(report))["check"]
        assert (found and found["passed"]) == passed, (limit, frame, found)
    wrong = CheckOptions(0, Progress(), None, 1, 0, b"tangent")
    assert "options.frame" in call("cotan_lint_gltf", model, c.c_size_t(len(model)), c.byref(files), c.byref(wrong), None, None, expect=1)

    stop = ConvertOptions(None, None, 0, 0, 0, 1, Progress(lambda user, done: 1), None)
    convert, glb, how = ConvertResult(), c.c_void_p(), c.c_void_p()
    arguments = (model, c.c_size_t(len(model)), c.byref(files))
    call("cotan_convert_gltf", *arguments, c.byref(stop), None, c.byref(glb), None, expect=6)
    assert not glb and not encoded
    new_map = ConvertOptions(None, b"cotangent", 0, 0, 0, 1, Progress(), None)
    call("cotan_convert_gltf", *arguments, c.byref(new_map), c.byref(convert), c.byref(glb), c.byref(how))
    assert convert.maps_converted == 1 and convert.maps_kept == 0 and convert.tangent_bytes_dropped == 64 and len(encoded) == 1
    # Half as steep along u: the texel must be twice as steep there. Half a code is 0.3 degrees.
    assert degrees([w - 128 for w in encoded[0][:3]], (2 * stored[0], stored[1], stored[2])) < 0.5, list(encoded[0])
    assert convert.worst_degrees_after < 0.5 < convert.worst_degrees_before
    assert json.loads(take(how))["maps"][0]["size"] == [side, side]
    asked.clear()
    whole = take(glb)
    assert whole[:4] == b"glTF" and lint_of(whole) is not None and not asked  # everything is embedded
    take(report)
    # Two steps give the same, except for the image's position in the file.
    conversion, picture, number = c.c_void_p(), ImageView(), len(encoded)
    names = []
    Take = c.CFUNCTYPE(c.c_int, c.c_void_p, text, c.c_void_p, c.c_size_t)
    call("cotan_gltf_images", *arguments, c.c_int(1), Take(lambda user, name, data, size: names.append(size) or 0), None)
    assert names == [len(PNG)]
    call("cotan_convert_begin", *arguments, c.byref(new_map), c.byref(convert), c.byref(conversion))
    asked.clear()
    cotan.cotan_conversion_count.restype = c.c_size_t
    assert cotan.cotan_conversion_count(conversion) == 1 and len(encoded) == number and convert.maps_converted == 1
    call("cotan_conversion_image", conversion, c.c_size_t(0), c.byref(picture))
    assert picture.width == picture.height == side and c.string_at(picture.pixels, 4) == encoded[0]
    assert "PNG files of all" in call("cotan_convert_end", conversion, c.byref(glb), None, expect=1)
    assert "expected less than 1, found 1" in call("cotan_conversion_set", conversion, c.c_size_t(1), PNG, c.c_size_t(len(PNG)), expect=1)
    call("cotan_conversion_set", conversion, c.c_size_t(0), PNG[:-1] + b"\x01", c.c_size_t(len(PNG)))
    call("cotan_convert_end", conversion, c.byref(glb), c.byref(how))
    cotan.cotan_conversion_free(conversion)
    assert json.loads(take(how))["maps"][0]["bytes_after"] == len(PNG) and not asked
    steps = take(glb)
    assert PNG[:-1] + b"\x01" in steps and len(steps) == len(whole) and lint_of(steps) is not None
    take(report)
    # Read as a map for its new frame it is right: the report assumes maps for MikkTSpace.
    back_again = ConvertOptions(b"cotangent", b"mikktspace", 0, 0, 0, 1, Progress(), None)
    call("cotan_convert_gltf", whole, c.c_size_t(len(whole)), c.byref(files), c.byref(back_again), c.byref(convert), c.byref(glb), None)
    assert degrees([w - 128 for w in encoded[1][:3]], stored) < 0.5 and convert.primitives_given == 1
    cotan.cotan_bytes_free(glb)

    # Without a map nothing is judged, which is not the same as 0 degrees.
    plain = json.loads(model)
    del plain["materials"][0]["normalTexture"]
    plain = json.dumps(plain).encode()
    call("cotan_convert_gltf", plain, c.c_size_t(len(plain)), c.byref(files), None, c.byref(convert), c.byref(glb), None)
    assert convert.maps_converted == convert.maps_kept == 0
    assert convert.worst_degrees_before == convert.worst_degrees_after == -1
    cotan.cotan_bytes_free(glb)

    # One line for every error.
    del beside[b"the map.png"]
    assert "the map.png" in call("cotan_lint_gltf", *arguments, None, None, None, expect=2)
    files.read = Read()
    assert "plane.bin" in call("cotan_lint_gltf", *arguments, None, None, None, expect=2)
    for broken in (b"", b"{", b"glTF", whole[:100], whole[:-4]):
        call("cotan_lint_gltf", broken, c.c_size_t(len(broken)), None, None, None, None, expect=2)
        call("cotan_convert_gltf", broken, c.c_size_t(len(broken)), None, None, None, c.byref(glb), None, expect=2)
    call("cotan_convert_gltf", *arguments, None, None, None, None, expect=1)
    files.decode = Decode(lambda *a: 7)
    assert "the caller did not decode" in call("cotan_lint_gltf", whole, c.c_size_t(len(whole)), c.byref(files), None, None, None, expect=2)

# Files, if they are built in.
made = c.c_void_p()
if call("cotan_render", None, c.c_size_t(0), None, None, None, None, expect="file") is not None:
    class RenderOptions(Struct):
        _fields_ = [("size", sizes_t), ("word_count", sizes_t), ("words", c.POINTER(text)), ("floats", c.c_int), ("threads", c.c_int), ("progress", Progress), ("user", c.c_void_p)]

    words = [b"--size", b"8x6", b"--device", b"reference", b"--environment", b"none", b"--shape", b"plane"]
    wanted = RenderOptions(len(words), (text * len(words))(*words), 0, 0, Progress(), None)
    call("cotan_render", None, c.c_size_t(0), None, c.byref(wanted), c.byref(made), None)
    drawn = ImageView()
    call("cotan_image_pixels", made, c.byref(drawn))
    assert (drawn.width, drawn.height, drawn.bits) == (8, 6, 8)
    cotan.cotan_image_free(made)
    wanted.words[1] = b"8x"
    assert "--size: expected WxH" in call("cotan_render", None, c.c_size_t(0), None, c.byref(wanted), c.byref(made), None, expect=1)
    call("cotan_set_reader", c.c_size_t(0), None)
    assert "words: expected an array" in call("cotan_set_reader", c.c_size_t(1), None, expect=1)
    assert "no such file" in call("cotan_model_open", b"/nowhere/a.glb", c.c_int(1), c.c_int(0), c.byref(made), expect=2)
    assert "no such file" in call("cotan_image_read", b"/nowhere/a.png", c.c_int(0), c.byref(made), expect=2)

# Shader text: its size first, then into a buffer; the same from many threads at once.
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
# A stage after the frame's name.
call("cotan_shader_text", b"wgsl", b"triangle", b"gltf", None, c.byref(size))
whole = size.value
call("cotan_shader_text", b"wgsl", b"triangle,fragment", b"gltf", None, c.byref(size))
assert 0 < size.value < whole
for absent in (None, b""):
    assert call("cotan_shader_text", b"wgsl", absent, b"gltf", None, c.byref(size), expect=1) == ("frame: expected orthonormal for "
        "maps that were baked for MikkTSpace, as most are; smooth or cotangent for maps that you bake for this shader; found none")
call("cotan_shader_text", b"godot", None, b"gltf", None, c.byref(size))
with_name = c.c_size_t()
call("cotan_shader_text", b"godot", b"orthonormal", b"gltf", None, c.byref(with_name))
assert size.value == with_name.value > 500
assert "stage: expected fragment" in call("cotan_shader_text", b"wgsl", b"triangle,pixel", b"gltf", None, c.byref(size), expect=1)
assert "the frame triangle" in call("cotan_shader_text", b"wgsl", b"cotangent,mesh", b"gltf", None, c.byref(size), expect=1)
print("all of it holds")
