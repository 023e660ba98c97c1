"""glTF models that decompress to much more than their size, for fuzz/bombs.py."""
import struct

import bomb_packed_images as packed_pictures
import bomb_images as pictures
from bomb_gltf import LIMIT, Gltf


def meshopt(r, folder):
    """EXT_meshopt_compression: zeros, one bit per sixteen bytes."""
    g = Gltf()
    count, stride = r.randint(1_000_000, 4_000_000), 12
    blocks = -(-count // min(256, 8192 // stride // 16 * 16))
    stream = b"\xa0" + b"\0" * (4 * stride * blocks) + b"\0" * 32
    stream = stream[:LIMIT - 5000]
    view = g.view(stream)
    packed = {"buffer": 0, "byteLength": len(stream), "byteOffset": 0, "byteStride": stride, "count": count, "mode": "ATTRIBUTES"}
    g.add("buffers", {"byteLength": count * stride})
    g.root["bufferViews"][view] = {"buffer": 1, "byteLength": count * stride, "byteStride": stride,
                                   "extensions": {"EXT_meshopt_compression": packed}}
    g.add("accessors", {"bufferView": view, "componentType": 5126, "count": count, "type": "VEC3", "min": [0] * 3, "max": [0] * 3})
    g.root["extensionsUsed"] = g.root["extensionsRequired"] = ["EXT_meshopt_compression"]
    g.place([{"attributes": {"POSITION": 0}}])
    return g.write(folder)


def draco(r, folder):
    """KHR_draco_mesh_compression: a header with large counts, followed by noise or zeros."""
    g = Gltf()
    faces, points = r.randint(1000, 30_000_000), r.randint(1000, 30_000_000)

    def varint(n):
        return bytes([n]) if n < 128 else bytes([n % 128 + 128]) + varint(n // 128)
    method = r.randint(0, 1)  # sequential, edgebreaker
    head = b"DRACO\x02\x02\x01" + bytes([method]) + b"\0\0"
    head += varint(faces) + varint(points) + b"\0" if method == 0 else b"\0" + varint(points) + varint(faces) + b"\1\0\0"
    stream = (head + (r.randbytes(2000) if r.random() < 0.5 else b"") + b"\0" * r.randint(10, 900_000))[:LIMIT - 5000]
    packed = {"bufferView": g.view(stream), "attributes": {"POSITION": 0}}
    g.add("accessors", {"componentType": 5126, "count": points, "type": "VEC3", "min": [0] * 3, "max": [1] * 3})
    g.add("accessors", {"componentType": 5125, "count": 3 * faces, "type": "SCALAR"})
    g.place([{"attributes": {"POSITION": 0}, "indices": 1, "extensions": {"KHR_draco_mesh_compression": packed}}])
    g.root["extensionsUsed"] = g.root["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    return g.write(folder)


def draco_faces(r, folder):
    """Valid Draco data: faces whose indices take no bits, or one byte each."""
    g = Gltf()
    packed = r.random() < 0.5
    faces, points = r.choice([300_000, 2_000_000, 30_000_000]) if packed else r.randint(100_000, 290_000), 200

    def varint(n):
        return bytes([n]) if n < 128 else bytes([n % 128 + 128]) + varint(n // 128)
    head = b"DRACO\x02\x02\x01\0\0\0" + varint(faces) + varint(points)
    if packed:  # a single symbol of probability 1, so that decoding reads no bits
        connections = b"\0" + b"\1\1" + b"\1" + b"\x01\x40" + b"\1\0"
    else:
        connections = b"\1" + bytes(r.randrange(points) for _ in range(3 * faces))
    values = struct.pack(f"<{3 * points}f", *(r.random() for _ in range(3 * points)))
    stream = head + connections + b"\1" + b"\1\0\x09\x03\0\0" + b"\0" + values
    packing = {"bufferView": g.view(stream), "attributes": {"POSITION": 0}}
    g.add("accessors", {"componentType": 5126, "count": points, "type": "VEC3", "min": [0] * 3, "max": [1] * 3})
    g.add("accessors", {"componentType": 5125, "count": 3 * faces, "type": "SCALAR"})
    g.place([{"attributes": {"POSITION": 0}, "indices": 1, "extensions": {"KHR_draco_mesh_compression": packing}}])
    g.root["extensionsUsed"] = g.root["extensionsRequired"] = ["KHR_draco_mesh_compression"]
    return g.write(folder)


def meshopt_triangles(r, folder):
    """EXT_meshopt_compression: one byte per triangle, with new vertices or reusing the last sixteen."""
    g = Gltf()
    count, few = r.randint(300_000, 900_000), r.random() < 0.5
    codes = (b"\0" * 20 + bytes([r.randrange(1, 12)]) * (count - 20)) if few else b"\0" * count
    stream = b"\xe1" + codes + b"\0" * 16
    points = r.randint(100, 10_000) if few else count + 2
    attributes = {}
    if few:
        attributes["POSITION"] = g.floats([r.random() for _ in range(3 * points)], 3)
    else:
        g.add("accessors", {"componentType": 5126, "count": points, "type": "VEC3", "min": [0] * 3, "max": [0] * 3})
        attributes["POSITION"] = 0
    view = g.view(stream)
    packed = {"buffer": 0, "byteLength": len(stream), "byteOffset": g.root["bufferViews"][view]["byteOffset"], "byteStride": 4,
              "count": 3 * count, "mode": "TRIANGLES"}
    g.add("buffers", {"byteLength": 12 * count})
    g.root["bufferViews"][view] = {"buffer": 1, "byteLength": 12 * count, "extensions": {"EXT_meshopt_compression": packed}}
    indices = g.add("accessors", {"bufferView": view, "componentType": 5125, "count": 3 * count, "type": "SCALAR"})
    g.root["extensionsUsed"] = g.root["extensionsRequired"] = ["EXT_meshopt_compression"]
    g.place([{"attributes": attributes, "indices": indices}])
    return g.write(folder)


def nested_json(r, folder):
    """JSON with many brackets, keys or numbers."""
    file = folder / "bomb.gltf"
    inner = r.choice(['[' * 400_000 + ']' * 400_000, '{"a":' * 150_000 + "1" + "}" * 150_000, "[" + "1," * 400_000 + "1]",
                      "{" + ",".join(f'"k{k}":0' for k in range(70_000)) + "}"])
    file.write_text('{"asset":{"version":"2.0"},"extras":' + inner + "}")
    return file


def picture_in_model(r, folder):
    """A model whose normal map is an image bomb."""
    data, mime = r.choice([(pictures.progressive_jpeg(r), "jpeg"), (packed_pictures.webp_lossless(r), "webp"), (packed_pictures.ktx2(r), "ktx2"),
                           (pictures.flat_jpeg(r), "jpeg")])
    g = Gltf()
    material = g.map(data[:LIMIT - 5000])
    g.root["images"][0]["mimeType"] = "image/" + mime
    name = {"webp": "EXT_texture_webp", "ktx2": "KHR_texture_basisu"}.get(mime)
    if name:
        g.root["textures"][0] = {"extensions": {name: {"source": 0}}}
        g.root["extensionsUsed"] = g.root["extensionsRequired"] = [name]
    g.place([{"attributes": g.triangle(), "material": material}])
    return g.write(folder)
