"""Malformed and hostile files, each with the verdict that every reader has to give: EXPECTED.tsv of the folders `bad`
and `found`. reject: one clear line, exit code 2, no output; accept: works; warn: works or one clear line, and says
what is wrong; either: both are fine. Never: a crash, a hang, unlimited memory, NaN, a file outside the folder."""

import copy
import json
import struct

import numpy as np

from files import chunk, data_uri, glb, png, png_of


def quad(*without, **arrays):
    """A quad with a flat normal map: its JSON and arrays by attribute. without: attributes to leave out."""
    given = {"POSITION": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "NORMAL": [[0, 0, 1]] * 4,
             "TEXCOORD_0": [[0, 1], [1, 1], [1, 0], [0, 0]], **arrays}
    root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {}, "material": 0}]}],
            "materials": [{"normalTexture": {"index": 0}}], "accessors": [], "bufferViews": [],
            "textures": [{"source": 0}],
            "images": [{"uri": data_uri(png(np.full((2, 2, 3), (128, 128, 255), np.uint8)), "image/png")}]}
    binary = b""
    primitive = root["meshes"][0]["primitives"][0]
    indices = given.pop("indices", [0, 1, 2, 0, 2, 3])
    for name, values in [*given.items(), ("indices", indices)]:
        if name in without:
            continue
        array = np.array(values, np.uint16 if name == "indices" else np.float32)
        root["bufferViews"].append({"buffer": 0, "byteOffset": len(binary), "byteLength": array.nbytes})
        accessor = {"bufferView": len(root["bufferViews"]) - 1, "componentType": 5123 if name == "indices" else 5126,
                    "count": len(array), "type": "SCALAR" if name == "indices" else f"VEC{array.shape[1]}"}
        if name == "POSITION":
            accessor["min"], accessor["max"] = [0, 0, 0], [1, 1, 0]
        root["accessors"].append(accessor)
        (primitive if name == "indices" else primitive["attributes"])[name] = len(root["accessors"]) - 1
        binary += array.tobytes()
    root["buffers"] = [{"byteLength": len(binary)}]
    return root, binary


def changed(change, **arrays):
    """A GLB of the quad after change(JSON)."""
    root, binary = quad(**arrays)
    root = copy.deepcopy(root)
    change(root)
    return glb(root, binary)


def first(root):
    return root["accessors"][0]


def made():
    """The files of `bad/made`: name, verdict, reason, bytes."""
    nan = float("nan")
    whole = glb(*quad())
    tangents = {"TANGENT": [[1, 0, 0, -1]] * 4}
    yield "ok_quad.glb", "accept", "control: a valid quad with a flat normal map", whole
    yield ("accessor_count_huge.glb", "reject", "4294967295 elements",
           changed(lambda r: first(r).update(count=4294967295)))
    yield ("image_not_image.glb", "reject", "the image is text",
           changed(lambda r: r["images"][0].update(uri=data_uri(b"not an image", "image/png"))))
    yield "index_out_of_range.glb", "reject", "index 60000 of 4", glb(*quad(indices=[0, 1, 2, 0, 2, 60000]))
    yield "json_deep.gltf", "reject", "nested 200000 deep", b'{"asset":{"version":"2.0"},"extras":' + b"[" * 200000 + b"]" * 200000 + b"}"
    yield "json_number.gltf", "reject", "1e999 as an index", b'{"asset":{"version":"2.0"},"scene":1e999,"scenes":[{}]}'
    yield ("nan_position.glb", "reject", "NaN in POSITION",
           glb(*quad(POSITION=[[0, 0, 0], [1, nan, 0], [1, 1, 0], [0, 1, 0]])))
    yield "no_uvs.glb", "warn", "a normal texture without TEXCOORD_0", glb(*quad("TEXCOORD_0"))
    yield ("node_scale_zero.glb", "warn", "a node scale of (1,1,0)",
           changed(lambda r: r["nodes"][0].update(scale=[1, 1, 0])))
    yield ("required_extension_unknown.glb", "reject", "requires an unknown extension",
           changed(lambda r: r.update(extensionsUsed=["VENDOR_unknown"], extensionsRequired=["VENDOR_unknown"])))
    yield "tangent_w_inverted.glb", "warn", "TANGENT.w contradicts the uv", glb(*quad(**tangents))
    yield "tangent_zero.glb", "warn", "tangents of length 0", glb(*quad(TANGENT=[[0, 0, 0, 0]] * 4))
    yield ("texcoord_missing.glb", "warn", "a texture of TEXCOORD_3, which is missing",
           changed(lambda r: r["materials"][0]["normalTexture"].update(texCoord=3)))
    yield "truncated.glb", "reject", "the last 90 bytes are missing", sized(1224)[:-90]
    yield ("uri_traversal.glb", "reject", "an image outside the folder",
           changed(lambda r: r["images"][0].update(uri="../../../../../../etc/hostname")))
    yield "uv_nan.glb", "warn", "NaN in TEXCOORD_0", glb(*quad(TEXCOORD_0=[[0, 1], [nan, 1], [1, 0], [0, 0]]))
    yield "uv_one_point.glb", "warn", "all uv equal", glb(*quad(TEXCOORD_0=[[0.5, 0.5]] * 4))
    yield ("view_past_end.glb", "reject", "a buffer view past its buffer",
           changed(lambda r: r["bufferViews"][0].update(byteLength=4800)))
    yield "zero_normals.glb", "warn", "normals of length 0", glb(*quad(NORMAL=[[0, 0, 0]] * 4))

    square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
    corners = square + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
    around = np.linspace(0, 2 * np.pi, 5000, endpoint=False)
    polygon = "".join(f"v {x:.6f} {y:.6f} 0\n" for x, y in zip(np.cos(around), np.sin(around)))
    for name, verdict, reason, text in (
            ("obj_crlf_tabs_continued.obj", "accept", "CR LF, tabs, a continued line",
             "# c\r\nv\t0 0 0\r\nv 1 0\t0\r\nv 1 1 0 \r\nvt 0 0\r\nvt 1 0\r\nvt 1 1\r\nf 1/1 2/2 \\\r\n 3/3\r\n"),
            ("obj_index_negative.obj", "accept", "negative indices", corners + "f -4/-4/-1 -3/-3/-1 -2/-2/-1\n"),
            ("obj_index_zero.obj", "reject", "index 0", corners + "f 0/1/1 1/2/1 2/3/1\n"),
            ("obj_mixed_corners.obj", "either", "corners with and without vt and vn",
             corners + "f 1/1/1 2//1 3/3\nf 1 3/3/1 4/4/1\n"),
            ("obj_mtllib_traversal.obj", "warn", "a material library outside the folder",
             "mtllib ../../../../../../etc/hostname\nusemtl x\n" + corners + "f 1/1/1 2/2/1 3/3/1\n"),
            ("obj_nan.obj", "reject", "nan and inf", "v nan 0 0\nv inf 0 0\nv 1e999 1 0\nf 1 2 3\n"),
            ("obj_no_faces.obj", "reject", "no faces", "v 0 0 0\nv 1 0 0\n"),
            ("obj_polygon_5000.obj", "accept", "a polygon of 5000 corners",
             polygon + "f" + "".join(f" {k + 1}" for k in range(5000)) + "\n"),
            ("obj_number_formats.obj", "either", "odd spellings of numbers",
             "v +1.0 -0 .5\nv 1e0 2E-1 -.25e+1\nv 0x1p0 1. 00.5\nf 1 2 3\n"),
            ("obj_malformed.obj", "reject", "indices 0 and 12 of 8", square + "f 0 1 2\nf 1 2 12\n")):
        yield name, verdict, reason, text.encode()

    four = b"\0" * 17 * 4
    yield "png_bad_filter.png", "reject", "row filter 9", png_of(4, 4, 8, 6, (b"\x09" + b"\x80" * 16) * 4)
    yield "png_bomb_1bit.png", "either", "20000 x 20000 in 48 KB", png_of(20000, 20000, 1, 0, b"\0" * (2501 * 20000))
    yield "png_dims_60000.png", "reject", "claims 60000 x 60000 with 4 rows of data", png_of(60000, 60000, 8, 6, four)
    yield ("png_palette_index.png", "either", "palette index 255 of 1",
           png_of(4, 4, 8, 3, (b"\0" + b"\xff" * 4) * 4, [chunk(b"PLTE", b"\x80\x80\xff")]))
    yield "png_short_data.png", "reject", "data end in the second row", png_of(4, 4, 8, 6, b"\0" + b"\x80" * 16 + b"\0\x80")
    yield "png_zero_width.png", "reject", "width 0", png_of(0, 4, 8, 6, four)
    # Unusual but valid forms.
    yield "png_grey_1bit.png", "accept", "1 bit of grey", png_of(32, 4, 1, 0, b"\0\xaa\xaa\xaa\xaa" * 4)
    yield "png_grey_16bit.png", "accept", "16 bits of grey", png_of(4, 4, 16, 0, (b"\0" + bytes(range(8))) * 4)
    yield "png_rgb_16bit.png", "accept", "16 bits a channel", png_of(4, 4, 16, 2, (b"\0" + bytes(range(24))) * 4)
    yield "png_rgba_16bit.png", "accept", "16 bits a channel, alpha", png_of(4, 4, 16, 6, (b"\0" + bytes(range(32))) * 4)
    yield ("png_background_and_transparent.png", "accept", "bKGD and tRNS of 16 bits",
           png_of(4, 4, 16, 2, (b"\0" + bytes(range(24))) * 4, [chunk(b"tRNS", bytes(6)), chunk(b"bKGD", bytes(range(6)))]))
    passes = b"".join(b"\0" + b"\x01\x23\x45\x67"[:(columns + 1) // 2] for rows, columns in
                      ((1, 1), (0, 0), (1, 1), (1, 1), (1, 2), (2, 2), (2, 4)) for _ in range(rows))
    yield ("png_interlaced_palette.png", "accept", "interlaced, 4 bits of palette",
           png_of(4, 4, 4, 3, passes, [chunk(b"PLTE", bytes(range(48)))], interlaced=1))
    valid = png(np.zeros((8, 8, 3), np.uint8))
    yield "png_checksum.png", "reject", "a wrong checksum", valid[:29] + bytes(4) + valid[33:]  # of the header
    yield "png_cut_off.png", "either", "its end is missing", valid[:-9]


def sized(size):
    """The GLB of the quad, made longer with extras until it has this size."""
    root, binary = quad()
    root["extras"] = ""
    root["extras"] = "x" * (size - len(glb(root, binary)))
    assert len(glb(root, binary)) == size
    return glb(root, binary)


def validator():
    """The faults that glTF-Validator's tests have, by the names that they have there."""
    asset = {"asset": {"version": "2.0"}}
    header = lambda total, part, text: struct.pack("<4sIII4s", b"glTF", 2, total, part, b"JSON") + text
    text = json.dumps(asset, separators=(",", ":")).encode() + b" "
    bounds = {"min": [-1, -1, -1], "max": [1, 1, 1]}
    attributes = lambda *names: [{"primitives": [{"attributes": {name: k for k, name in enumerate(names)}}]}]
    vec3 = {"type": "VEC3", "componentType": 5126, "count": 3}
    yield ("accessor_data/invalid_elements_float.gltf", "reject", "NaN and infinity",
           {**asset, "accessors": [{**vec3, "count": 1, "bufferView": 0}], "bufferViews": [{"buffer": 0, "byteLength": 12}],
            "buffers": [{"byteLength": 12, "uri": data_uri(struct.pack("<3f", float("nan"), float("inf"), 0), "application/octet-stream")}]})
    yield ("buffer/invalid_uri_data.gltf", "reject", "a data URI that does not decode",
           {**asset, "buffers": [{"uri": "data:application/octet-stream;;base64,AA==", "byteLength": 1}]})
    yield "glb/chunk_too_big.glb", "reject", "a chunk longer than the file", header(len(text), len(text), text)
    yield "glb/empty_file.glb", "reject", "no bytes", b""
    yield "glb/invalid_magic.glb", "reject", "wrong magic", bytes(12)
    yield "glb/length_mismatch.glb", "reject", "the header's length is wrong", header(21 + len(text), len(text), text)
    yield "glb/unaligned_chunk.glb", "either", "a chunk of 27 bytes", header(47, 27, text[:-1])
    yield ("image/png_eos.gltf", "reject", "a PNG that ends in its header",
           {**asset, "images": [{"uri": data_uri(b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHD", "image/png")}]})
    yield ("mesh/accessor_unequal_count.gltf", "reject", "attributes of unequal counts",
           {**asset, "meshes": attributes("POSITION", "COLOR_0"), "accessors": [{**vec3, **bounds},
            {"type": "VEC4", "componentType": 5123, "count": 4, "normalized": True}]})
    points = attributes("POSITION", "TANGENT")
    points[0]["primitives"][0]["mode"] = 0
    yield ("mesh/invalid_tangent.gltf", "warn", "TANGENT without NORMAL",
           {**asset, "meshes": points, "accessors": [{**vec3, **bounds}, {**vec3, "type": "VEC4"}]})
    restart = attributes("POSITION")
    restart[0]["primitives"][0]["indices"] = 1
    yield ("mesh_data/index_buffer_primitive_restart.gltf", "reject", "the restart value among the indices",
           {**asset, "meshes": restart, "accessors": [{**vec3, **bounds, "count": 256},
            {"type": "SCALAR", "componentType": 5121, "count": 3, "bufferView": 0}],
            "bufferViews": [{"buffer": 0, "byteLength": 3}],
            "buffers": [{"byteLength": 3, "uri": data_uri(b"\0\1\xff", "application/octet-stream")}]})
    numbers = np.array([2, 0, 0] * 3 + [0, 3, 0, 0.5] * 3, "<f4").tobytes()
    shaded = attributes("POSITION", "NORMAL", "TANGENT", "TEXCOORD_0")
    shaded[0]["primitives"][0]["material"] = 0
    yield ("mesh_data/normals_tangents_non_unit_invalid_sign.gltf", "warn", "normals and tangents that are not unit; w is not +-1",
           {**asset, "meshes": shaded, "materials": [{"normalTexture": {"index": 0}}], "textures": [{}],
            "accessors": [{**vec3, **bounds}, {**vec3, "bufferView": 0}, {**vec3, "type": "VEC4", "bufferView": 1}, {**vec3, "type": "VEC2"}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 48}],
            "buffers": [{"byteLength": 84, "uri": data_uri(numbers, "application/octet-stream")}]})
    yield ("node/node_loop_scene.gltf", "reject", "a cycle among the nodes of the scene",
           {**asset, "nodes": [{"children": [k]} for k in (0, 2, 1, 4, 5, 4)], "scenes": [{"nodes": [0, 1, 3]}]})
    yield "root/invalid_collection_type.gltf", "reject", "an object where an array belongs", {**asset, "samplers": {}}


def found():
    """Small files that once crashed a reader, filled memory, took minutes or were not noticed."""
    root, binary = quad("POSITION")
    yield "no_position.glb", "warn", "no POSITION: convert crashed", glb(root, binary)
    names = ("POSITION", "NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0")
    many = {"accessors": [{"componentType": 5126, "count": 99000000, "type": kind} for kind in
                          ("VEC3", "VEC3", "VEC4", "VEC2", "VEC2", "VEC4")], "asset": {"version": "2.0"},
            "bufferViews": [{"buffer": 0, "byteLength": 12}], "buffers": [{"byteLength": 12}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {n: k for k, n in enumerate(names)}, "indices": 6}]}], "scenes": [{"nodes": [0]}]}
    many["accessors"].append({"bufferView": 0, "componentType": 5125, "count": 3, "type": "SCALAR"})
    yield "accessors_without_view.glb", "reject", "99 million elements without data: 9.8 GB", glb(many, struct.pack("<3I", 0, 1, 2))
    strip = np.random.default_rng(1).random((4000, 3), np.float32)
    big = {"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4000, "type": "VEC3"},
                         {"bufferView": 1, "componentType": 5123, "count": 11700, "type": "SCALAR"}],
           "bufferViews": [{"buffer": 0, "byteLength": 48000}, {"buffer": 0, "byteOffset": 48000, "byteLength": 23400}],
           "buffers": [{"byteLength": 71400}], "asset": {"version": "2.0"}, "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}]}
    data = strip.tobytes() + (np.arange(11700) % 4000).astype("<u2").tobytes()
    primitive = {"attributes": {"POSITION": 0, "NORMAL": 0}, "indices": 1}
    yield ("one_accessor_20000_primitives.glb", "either", "20,000 primitives of one accessor: 9.6 GB",
           glb({**big, "meshes": [{"primitives": [primitive] * 20000}]}, data))
    crowd = copy.deepcopy({**big, "meshes": [{"primitives": [primitive]}], "extensionsUsed": ["EXT_mesh_gpu_instancing"]})
    crowd["accessors"].append({"componentType": 5126, "count": 1000000, "type": "VEC3"})
    crowd["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}}
    yield "million_instances.glb", "either", "a million instances of 4,000 vertices", glb(crowd, data)
    yield ("statements_before_newmtl.obj", "warn", "MTL statements before the first newmtl: crash inside Assimp",
           b"mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n# needs 16 bytes or more\n")
    yield "m.mtl", None, None, b"a 1\nillum 2\nKd 1 0 0\nnewmtl m\n"
    yield ("cycle.fbx", "reject", "connections in a circle: endless recursion inside Assimp",
           b'; FBX 7.3.0 project file\nFBXHeaderExtension:  {\n\tFBXVersion: 7300\n}\nObjects:  {\n\tModel: 20, "Model::m", "Mesh" {\n\t}\n}\n'
           b'Connections:  {\n\tC: "OO",20,0\n\tC: "OO",20,20\n}\n')
    yield ("accessor_beyond_array.dae", "reject", "an accessor beyond its array: crash inside Assimp",
           b'<COLLADA version="1.4.1"><library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="0">0 0 0 1 0 0 0 1 0'
           b'</float_array><technique_common><accessor source="#a" count="3" stride="3"><param name="X" type="float"/><param name="Y" '
           b'type="float"/><param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" '
           b'source="#p"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh>'
           b'</geometry></library_geometries><library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node>'
           b'</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>\n')
    yield ("list_count.ply", "reject", "a list of 1,500,000,000 entries: 10.9 GB",
           b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
           b"property list uint int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1500000000 0 1 2\n")
    yield ("25000_groups.obj", "either", "25,000 groups and materials: no end",
           b"v 0 0 0\nv 1 0 0\nv 0 1 0\n" + b"".join(b"g %d\nusemtl m%d\nf 1 2 3\n" % (k, k) for k in range(25000)))
    yield ("attribute_size.exr", "reject", "an attribute of 2 GB in 21 bytes",
           struct.pack("<II", 20000630, 2) + b"a\0string\0" + struct.pack("<I", 0x7fffffff))
    yield "100_scans.jpg", "either", "progressive, 100 scans of 12800 x 12800: 10 s, 1 GB", hundred_scans()
    tags = ((256, 4, 64), (257, 4, 64), (258, 3, 8), (259, 3, 1), (262, 3, 1), (273, 4, 134), (277, 3, 1), (278, 4, 64), (279, 4, 4096))
    yield ("truncated.tif", "reject", "88 of 4,096 bytes of pixels",
           struct.pack("<2sHIH", b"II", 42, 8, 9) + b"".join(struct.pack("<HHII", t, kind, 1, value) for t, kind, value in tags)
           + bytes(4) + b"MM" * 8 + b"M" * 72)
    yield ("truncated_dx10.dds", "reject", "a DX10 header without pixels",
           struct.pack("<4s7I44x", b"DDS ", 124, 0x21007, 64, 64, 0, 0, 1) + struct.pack("<2I4s5I", 32, 4, b"DX10", 0, 0, 0, 0, 0)
           + struct.pack("<5I", 0x401008, 0, 0, 0, 0) + struct.pack("<5I", 83, 3, 0, 1, 0) + b"\x09" * 16)


def hundred_scans():
    """A grey progressive JPEG: one scan of DC coefficients, and 99 of AC coefficients that are all zero."""
    side, blocks = 12800, 1600 * 1600
    segment = lambda marker, data: struct.pack(">BBH", 255, marker, 2 + len(data)) + data
    table = lambda kind, symbol: segment(0xc4, bytes([kind, 1] + [0] * 15 + [symbol]))  # one code, the bit 0
    data = b"\xff\xd8" + segment(0xdb, bytes(1) + b"\1" * 64) + segment(0xc2, struct.pack(">BHHBBBB", 8, side, side, 1, 1, 0x11, 0))
    data += table(0x00, 0) + table(0x10, 0xe0)  # DC: difference 0; AC: a run of 2^14 blocks without coefficients
    data += segment(0xda, bytes([1, 1, 0x00, 0, 0, 0])) + bytes(blocks // 8)
    runs = "".join("0" + format(0, "014b") for _ in range(-(-blocks // 2**14)))
    runs += "1" * (-len(runs) % 8)
    scan = bytes(int(runs[k:k + 8], 2) for k in range(0, len(runs), 8)).replace(b"\xff", b"\xff\0")
    for k in range(99):
        data += segment(0xda, bytes([1, 1, 0x00, 1 + k % 63, 1 + k % 63, 0x00])) + scan
    return data + b"\xff\xd9"


def write(folder, name, rows):
    lines = ["# file, verdict, what is special\n"]
    for file, verdict, reason, data in rows:
        path = folder / name / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(data if isinstance(data, bytes) else json.dumps(data, indent=1).encode())
        if verdict:
            lines.append(f"{file}\t{verdict}\t{reason}\n")
    with open(folder / name / "EXPECTED.tsv", "a", encoding="utf-8") as out:
        out.writelines(lines)


def of_assimp(source):
    """Files of assimp-testmodels. None: only used by others."""
    for name, verdict, reason in (
            ("OBJ/number_formats.obj", "either", "odd number spellings"),
            ("glTF2/BoxBadNormals-glTF-Binary/BoxBadNormals.glb", "warn", "bad vertex normals"),
            ("glTF2/RecursiveNodes/RecursiveNodes.gltf", "reject", "a node that is its own descendant"),
            ("glTF2/wrongTypes/badArray.gltf", "reject", "a string where an array belongs"),
            ("glTF2/wrongTypes/BoxTextured0.bin", None, None), ("glTF2/wrongTypes/CesiumLogoFlat.png", None, None),
            ("invalid/malformed.obj", "reject", "indices 0 and 12 of 8")):
        yield "assimp/" + name, verdict, reason, (source / name).read_bytes()


def make(folder, assimp=None):
    write(folder, "bad", [("made/" + name, *more) for name, *more in made()])
    write(folder, "bad", [("validator/" + name, *more) for name, *more in validator()])
    if assimp:
        write(folder, "bad", of_assimp(assimp))
    write(folder, "found", found())
