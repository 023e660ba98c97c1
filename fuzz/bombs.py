"""Files under 1 MB that ask for as much as they can, for scripts/try-bombs. Each maker takes a random.Random and a
folder, writes into it and returns the file to give to a command. What is drawn from the random numbers are counts, sizes
and shapes. Pictures are in bomb_pictures.py."""
import json
import struct

import bomb_pictures as pictures

LIMIT = 1_000_000  # bytes of a bomb, all its files together


class Gltf:
    """A model in the making: the JSON and one buffer."""

    def __init__(self):
        self.root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [],
                     "accessors": [], "bufferViews": [], "buffers": [{"byteLength": 0}]}
        self.data = b""

    def view(self, data):
        self.data += b"\0" * (-len(self.data) % 4)
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(data)})
        self.data += data
        return len(self.root["bufferViews"]) - 1

    def floats(self, values, width):
        rows = [values[i:i + width] for i in range(0, len(values), width)]
        accessor = {"bufferView": self.view(struct.pack(f"<{len(values)}f", *values)), "componentType": 5126,
                    "count": len(rows), "type": {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}[width]}
        if width == 3:
            stored = struct.unpack(f"<{len(values)}f", struct.pack(f"<{len(values)}f", *values))
            accessor |= {"min": [min(stored[k::3]) for k in range(3)], "max": [max(stored[k::3]) for k in range(3)]}
        self.root["accessors"].append(accessor)
        return len(self.root["accessors"]) - 1

    def indices(self, values, wide=False):
        view = self.view(struct.pack(f"<{len(values)}{'I' if wide else 'H'}", *values))
        self.root["accessors"].append({"bufferView": view, "componentType": 5125 if wide else 5123,
                                       "count": len(values), "type": "SCALAR"})
        return len(self.root["accessors"]) - 1

    def add(self, key, value):
        self.root.setdefault(key, []).append(value)
        return len(self.root[key]) - 1

    def map(self, png):
        """A material with this normal map; its number."""
        image = self.add("images", {"mimeType": "image/png", "bufferView": self.view(png)})
        return self.add("materials", {"normalTexture": {"index": self.add("textures", {"source": image})}})

    def triangle(self, uv=(0, 0, 1, 0, 0, 1), points=(0, 0, 0, 1, 0, 0, 0, 1, 0)):
        return {"POSITION": self.floats(points, 3), "NORMAL": self.floats([0, 0, 1] * (len(points) // 3), 3),
                "TEXCOORD_0": self.floats(uv, 2)}

    def place(self, primitives, **node):
        mesh = self.add("meshes", {"primitives": primitives})
        self.root["scenes"][0]["nodes"].append(self.add("nodes", {"mesh": mesh} | node))

    def write(self, folder):
        self.root["buffers"][0]["byteLength"] = len(self.data)
        if not self.data:
            del self.root["buffers"], self.root["bufferViews"]
        text = json.dumps(self.root, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        data = self.data + b"\0" * (-len(self.data) % 4)
        file = folder / "bomb.glb"
        file.write_bytes(struct.pack("<4sII", b"glTF", 2, 20 + len(text) + 8 + len(data)) + struct.pack("<I4s", len(text), b"JSON")
                         + text + struct.pack("<I4s", len(data), b"BIN\0") + data)
        return file


def flat_map(side):
    return pictures.png(side, side, 8, 2, bytes([128, 128, 255]) * side)


# ---- glTF: texels ----------------------------------------------------------------------------------------------------

def skewed_uv(r, folder):
    """One triangle whose uv repeat a map skewed."""
    g = Gltf()
    n = r.choice([3, 10, 40, 300, 3000])
    material = g.map(flat_map(r.choice([512, 1024, 2048, 4096])))
    g.place([{"attributes": g.triangle((0, 0, n, n * r.random(), n * r.random(), n)), "material": material}])
    return g.write(folder)


def equal_triangles(r, folder):
    """One triangle of a map again and again."""
    g = Gltf()
    count = r.randint(100_000, 150_000)
    material = g.map(flat_map(r.choice([64, 512, 2048])))
    g.place([{"attributes": g.triangle(), "indices": g.indices([0, 1, 2] * count), "material": material}])
    return g.write(folder)


def sliver_uv(r, folder):
    """Triangles that cross the whole map as lines."""
    g = Gltf()
    count = r.randint(5_000, 10_000)
    points, uv = [], []
    for _ in range(count):
        x = r.random()
        points += [x, 0, r.random(), x, 1, r.random(), x + 1e-3, 1, r.random()]
        uv += [x, 0, 1 - x, 1, 1 - x + 1e-4, 1]
    g.place([{"attributes": g.triangle(uv, points), "material": g.map(flat_map(r.choice([256, 1024])))}])
    return g.write(folder)


def large_maps(r, folder):
    """Materials with large flat maps, the same bytes or others."""
    g = Gltf()
    side, count, same = r.choice([4096, 8192, 10_000, 12_000]), r.randint(8, 24), r.random() < 0.5
    attributes = g.triangle()
    for k in range(count):
        png = pictures.png(side, side, r.choice([1, 8]), 0 if same else 2 * (k % 2), b"")
        if len(g.data) + len(png) > LIMIT - 20_000:
            break
        material = g.map(png)
        if r.random() < 0.5:
            g.root["materials"][material]["pbrMetallicRoughness"] = {"baseColorTexture": {"index": material}}
        g.place([{"attributes": attributes, "material": material}], translation=[k, 0, 0])
    return g.write(folder)


def small_maps(r, folder):
    """Thousands of images, textures, materials and primitives."""
    g = Gltf()
    count, side = r.randint(2000, 3000), r.choice([1, 4, 64])
    png = g.view(pictures.png(side, side, 8, 2, b""))
    attributes = g.triangle()
    primitives = []
    for k in range(count):
        g.add("images", {"mimeType": "image/png", "bufferView": png})
        g.add("textures", {"source": k})
        g.add("materials", {"normalTexture": {"index": k}})
        primitives.append({"attributes": attributes, "material": k})
    g.place(primitives)
    return g.write(folder)


# ---- glTF: many things -----------------------------------------------------------------------------------------------

def stretched_nodes(r, folder):
    """Nodes that each stretch a mesh of many primitives another way."""
    g = Gltf()
    material = g.map(flat_map(64))
    attributes = g.triangle()
    mesh = g.add("meshes", {"primitives": [{"attributes": attributes, "material": material}] * r.randint(2000, 6000)})
    for _ in range(r.randint(50, 200)):
        node = {"mesh": mesh, "scale": [1 + r.random(), 1, 1 + r.random()], "translation": [r.random(), 0, 0]}
        g.root["scenes"][0]["nodes"].append(g.add("nodes", node))
    return g.write(folder)


def many_materials(r, folder):
    """Primitives with a material each."""
    g = Gltf()
    attributes = g.triangle()
    primitives = []
    for k in range(r.randint(6000, 8500)):
        name = r.choice(["baseColorFactor", "metallicFactor"])
        g.add("materials", {"pbrMetallicRoughness": {name: [k / 9000, 1, 0.5, 1] if name == "baseColorFactor" else k / 9000}})
        primitives.append({"attributes": attributes, "material": k})
    g.place(primitives)
    return g.write(folder)


def many_primitives(r, folder):
    """Primitives of one triangle, of one material, in one place or spread, opaque or not."""
    g = Gltf()
    alpha = r.choice(["OPAQUE", "MASK", "BLEND"])
    g.add("materials", {"alphaMode": alpha, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5 + r.random() / 2]}})
    primitives = [{"attributes": g.triangle(), "material": 0}] * r.randint(8000, 12_000)
    g.place(primitives)
    for _ in range(r.choice([0, 0, 3])):
        g.root["scenes"][0]["nodes"].append(g.add("nodes", {"mesh": 0, "translation": [r.random() * 3, 0, 0]}))
    return g.write(folder)


def many_nodes(r, folder):
    """Nodes beside or inside one another, over one mesh."""
    g = Gltf()
    mesh = g.add("meshes", {"primitives": [{"attributes": g.triangle()}]})
    deep = r.random() < 0.5
    count = r.randint(2000, 15_000)
    for k in range(count):
        node = {"mesh": mesh, "translation": [r.choice([0, 0, 1]), 0, 0]}
        if deep and k + 1 < count:
            node["children"] = [k + 1]
        g.add("nodes", node)
    g.root["scenes"][0]["nodes"] = [0] if deep else list(range(count))
    return g.write(folder)


def gpu_instances(r, folder):
    """EXT_mesh_gpu_instancing: each place of a long list shows each primitive."""
    g = Gltf()
    mesh = g.add("meshes", {"primitives": [{"attributes": g.triangle()}] * r.choice([1, 10, 60])})
    places = g.floats([r.random() * r.choice([0, 100]) for _ in range(3 * r.randint(5000, 15_000))], 3)
    g.add("nodes", {"mesh": mesh, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}}})
    g.root["scenes"][0]["nodes"], g.root["extensionsUsed"] = [0], ["EXT_mesh_gpu_instancing"]
    return g.write(folder)


def shared_data(r, folder):
    """Primitives that share large arrays."""
    g = Gltf()
    count = r.randint(5000, 20_000)
    attributes = g.triangle([r.random() for _ in range(2 * count)], [r.random() for _ in range(3 * count)])
    g.place([{"attributes": attributes, "material": g.map(flat_map(16))}] * r.randint(100, 2000))
    return g.write(folder)


def no_data(r, folder):
    """Accessors without bytes."""
    g = Gltf()
    count = r.randint(10_000, 50_000_000)
    g.add("accessors", {"componentType": 5126, "count": count, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]})
    g.place([{"attributes": {"POSITION": 0}}] * r.randint(1, 300))
    return g.write(folder)


def soup(r, folder):
    """Triangles over the whole picture, one behind the other, translucent or not."""
    g = Gltf()
    count = r.randint(3000, 9000)
    points = [c for k in range(count) for c in (0, 0, k * 1e-4, 1, 0, k * 1e-4, 0, 1, k * 1e-4)]
    g.add("materials", {"alphaMode": r.choice(["BLEND", "MASK", "OPAQUE"]), "doubleSided": True,
                        "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}})
    g.place([{"attributes": {"POSITION": g.floats(points, 3)}, "material": 0}])
    return g.write(folder)


def fan(r, folder):
    """Triangles around one vertex, or one edge."""
    g = Gltf()
    count = r.randint(20_000, 60_000)
    points = [r.random() for _ in range(3 * (count + 2))]
    uv = [r.random() for _ in range(2 * (count + 2))]
    second = r.random() < 0.5
    indices = [i for k in range(count) for i in ((0, 1, k + 2) if second else (0, k + 1, k + 2))]
    count = min(count, (LIMIT - 60_000) // (20 + 12))
    points, uv, indices = points[:3 * (count + 2)], uv[:2 * (count + 2)], indices[:3 * count]
    attributes = {"POSITION": g.floats(points, 3), "TEXCOORD_0": g.floats(uv, 2)}
    g.place([{"attributes": attributes, "indices": g.indices(indices, wide=True), "material": g.map(flat_map(64))}])
    return g.write(folder)


def one_place(r, folder):
    """Triangles of vertices that all have one position, or one uv, or few."""
    g = Gltf()
    count = r.randint(5000, 8000)
    same = r.choice(["position", "uv", "both"])
    points = [0 if same != "uv" else r.random() for _ in range(9 * count)]
    uv = [0 if same != "position" else r.random() for _ in range(6 * count)]
    g.place([{"attributes": g.triangle(uv, points), "material": g.map(flat_map(64))}])
    return g.write(folder)


def animated(r, folder):
    """Channels, keys and targets by the thousand."""
    g = Gltf()
    attributes = g.triangle()
    targets = [{"POSITION": attributes["POSITION"]}] * r.randint(1, 5000)
    g.place([{"attributes": attributes, "targets": targets}])
    times = g.floats([float(k) for k in range(r.randint(2, 2000))], 1)
    g.root["accessors"][times] |= {"min": [0], "max": [g.root["accessors"][times]["count"] - 1]}
    values = g.floats([0.0, 0, 0] * g.root["accessors"][times]["count"], 3)
    channels = [{"sampler": 0, "target": {"node": k, "path": "translation"}} for k in range(r.randint(1, 3000))]
    for _ in channels[1:]:
        g.add("nodes", {})
    g.add("animations", {"samplers": [{"input": times, "output": values}], "channels": channels})
    return g.write(folder)


def meshopt(r, folder):
    """EXT_meshopt_compression: zeros, a bit for sixteen bytes."""
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
    """KHR_draco_mesh_compression: a head that promises much, and noise or zeros behind it."""
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


def nested_json(r, folder):
    """JSON of many brackets, keys or numbers."""
    file = folder / "bomb.gltf"
    inner = r.choice(['[' * 400_000 + ']' * 400_000, '{"a":' * 150_000 + "1" + "}" * 150_000, "[" + "1," * 400_000 + "1]",
                      "{" + ",".join(f'"k{k}":0' for k in range(70_000)) + "}"])
    file.write_text('{"asset":{"version":"2.0"},"extras":' + inner + "}")
    return file


def picture_in_model(r, folder):
    """A picture bomb as a model's normal map."""
    data, mime = r.choice([(pictures.progressive_jpeg(r), "jpeg"), (pictures.webp_lossless(r), "webp"), (pictures.ktx2(r), "ktx2"),
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


# ---- other models ----------------------------------------------------------------------------------------------------

def written(folder, name, text):
    file = folder / name
    file.write_bytes(text.encode()[:LIMIT] if isinstance(text, str) else text[:LIMIT])
    return file


OBJ_TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"


def obj_usemtl(r, folder):
    """A group or a material for each face, in one place or spread."""
    count, spread, materials = r.randint(15_000, 38_000), r.random() < 0.5, r.choice([1, 2, 3000])
    (folder / "m.mtl").write_text("".join(f"newmtl m{k}\nKd {k / 4000} 1 1\n" for k in range(materials)))
    lines = ["mtllib m.mtl\n", OBJ_TRIANGLE]
    word = r.choice(["usemtl m{m}\n", "g g{k}\n", "o o{k}\n"])
    for k in range(count):
        if spread and k < 9000:
            lines.append(f"v {r.random():.2f} {r.random():.2f} {r.random():.2f}\n")
        lines.append(word.format(m=k % materials, k=k) + ("f -1 -2 -3\n" if spread else "f 1/1 2/2 3/3\n"))
    text = "".join(lines)
    return written(folder, "bomb.obj", text[:text.rfind("f", 0, LIMIT - 100_000)])


def obj_equal(r, folder):
    """One triangle again and again."""
    return written(folder, "bomb.obj", OBJ_TRIANGLE + r.choice(["f 1 2 3\n", "f 1/1 2/2 3/3\n"]) * r.randint(40_000, 60_000))


def obj_polygon(r, folder):
    """A polygon of very many corners: a comb, a spiral, a star or noise."""
    from math import cos, sin
    count = r.randint(20_000, 60_000)
    if r.random() < 0.3:  # few vertices, many corners
        few = r.randint(4, 400)
        points = [(r.random(), r.random()) for _ in range(few)]
        face = [r.randint(1, few) for _ in range(4 * count)]
    else:
        make = r.choice([lambda k: (k / count, k % 2), lambda k: (k * cos(k / 9), k * sin(k / 9)),
                         lambda k: ((1 + k % 2) * cos(6.2831 * k / count), (1 + k % 2) * sin(6.2831 * k / count)),
                         lambda k: (r.random(), r.random())])
        points, face = [make(k) for k in range(count)], list(range(1, count + 1))
    text = "".join(f"v {x:.4g} {y:.4g} 0\n" for x, y in points) + "f " + " ".join(map(str, face)) + "\n"
    return written(folder, "bomb.obj", text)


def obj_maps(r, folder):
    """Materials with large maps."""
    count, side = r.randint(4, 12), r.choice([4096, 8192, 10_000])
    lines = ["mtllib m.mtl\n", OBJ_TRIANGLE]
    with open(folder / "m.mtl", "w") as mtl:
        for k in range(count):
            (folder / f"{k}.png").write_bytes(pictures.png(side, side, 1, 0, bytes([k]) * (side // 8)))
            mtl.write(f"newmtl m{k}\n{r.choice(['map_Kd', 'norm', 'map_Bump'])} {k}.png\n")
            lines.append(f"usemtl m{k}\nf 1/1 2/2 3/3\n")
    return written(folder, "bomb.obj", "".join(lines))


def obj_words(r, folder):
    """Long lines, many names, many corners that are no faces."""
    return written(folder, "bomb.obj", r.choice(["v " + "0" * 900_000, "g " + "a " * 450_000, "\n" * 900_000, "l " + "1 " * 400_000,
                                                  OBJ_TRIANGLE + "f 1 2 3 \\\n" * 100_000, "mtllib a.mtl\n" * 70_000]))


def ply_equal(r, folder):
    """One triangle again and again, or a polygon of many corners, as bytes."""
    polygon = r.random() < 0.4
    count = r.randint(100_000, 240_000)
    corners = struct.pack(f"<I{count}i", count, *(k % 3 if r.random() < 0.5 else k % 1000 for k in range(count)))
    faces = [corners] if polygon else [struct.pack("<Iiii", 3, 0, 1, 2)] * (count // 4)
    vertices = [struct.pack("<3f", r.random(), r.random(), 0) for _ in range(1000)]
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\n"
            f"property float z\nelement face {len(faces)}\nproperty list uint int vertex_indices\nend_header\n")
    return written(folder, "bomb.ply", head.encode() + b"".join(vertices) + b"".join(faces))


def ply_grid(r, folder):
    """Points and faces in columns of other widths, or counts that are not there."""
    count = r.choice([70_000, 10_000_000])
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {count}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {count}\nproperty list uchar int vertex_indices\nend_header\n")
    return written(folder, "bomb.ply", head.encode() + struct.pack("<3f", 0, 0, 1) * 40_000 + b"\3" + b"\0" * 400_000)


def stl_equal(r, folder):
    """One triangle again and again, or triangles without area."""
    same = r.random() < 0.6
    count = r.randint(10_000, 19_000)
    faces = [struct.pack("<12fH", 0, 0, 1, *((0, 0, 0, 1, 0, 0, 0, 1, 0) if same else [r.random()] * 9), 0) for _ in range(count)]
    return written(folder, "bomb.stl", b"\0" * 80 + struct.pack("<I", count) + b"".join(faces))


def stl_solids(r, folder):
    """Text of many solids."""
    solid = ("solid a{k}\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 {k}\nvertex 0 1 0\nendloop\nendfacet\n"
             "endsolid a{k}\n")
    same = r.random() < 0.5
    return written(folder, "bomb.stl", "".join(solid.format(k=0 if same else k) for k in range(r.randint(4000, 7500))))


def collada(r, folder):
    """Instances of one geometry, or many geometries."""
    head = ('<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset/>'
            '<library_geometries>')
    geometry = ('<geometry id="g{k}"><mesh><source id="p{k}"><float_array id="a{k}" count="9">0 0 0 1 0 0 0 1 0</float_array>'
                '<technique_common><accessor source="#a{k}" count="3" stride="3"><param name="X" type="float"/><param name="Y" '
                'type="float"/><param name="Z" type="float"/></accessor></technique_common></source><vertices id="v{k}"><input '
                'semantic="POSITION" source="#p{k}"/></vertices><triangles count="1"><input semantic="VERTEX" source="#v{k}" '
                'offset="0"/><p>0 1 2</p></triangles></mesh></geometry>')
    many = r.random() < 0.4
    geometries = r.randint(500, 1400) if many else 1
    nodes = geometries if many else r.randint(8000, 15_000)
    node = '<node id="n{k}"><instance_geometry url="#g{g}"/></node>'
    text = head + "".join(geometry.format(k=k) for k in range(geometries)) + "</library_geometries><library_visual_scenes><visual_scene id=\"s\">"
    text += "".join(node.format(k=k, g=k % geometries) for k in range(nodes))
    return written(folder, "bomb.dae", text + '</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>')


def collada_doubling(r, folder):
    """Entities, or nodes of a library that show each other twice."""
    if r.random() < 0.5:
        entities = "".join(f'<!ENTITY e{k} "{f"&e{k - 1};" * 10}">' for k in range(1, 12))
        return written(folder, "bomb.dae", f'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY e0 "aaaa">{entities}]><COLLADA version="1.4.1">&e11;</COLLADA>')
    depth = r.randint(12, 40)
    nodes = "".join(f'<node id="n{k}">{f"<instance_node url=#n{k + 1}/>".replace("#", chr(34) + "#").replace("/>", chr(34) + "/>") * 2}</node>'
                    for k in range(depth))
    return written(folder, "bomb.dae", '<?xml version="1.0"?><COLLADA version="1.4.1"><asset/><library_nodes>' + nodes
                   + f'<node id="n{depth}"/></library_nodes><library_visual_scenes><visual_scene id="s"><node><instance_node url="#n0"/></node>'
                   '</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>')


# ---- pictures --------------------------------------------------------------------------------------------------------

def picture(make, ending):
    def maker(r, folder):
        return written(folder, "bomb." + ending, make(r))
    maker.__doc__ = make.__doc__
    return maker


MODELS = [skewed_uv, equal_triangles, sliver_uv, large_maps, small_maps, stretched_nodes, many_materials, many_primitives, many_nodes,
          gpu_instances, shared_data, no_data, soup, fan, one_place, animated, meshopt, draco, nested_json, picture_in_model, obj_usemtl,
          obj_equal, obj_polygon, obj_maps, obj_words, ply_equal, ply_grid, stl_equal, stl_solids, collada, collada_doubling]
MAKERS = {maker.__name__: maker for maker in MODELS} | {name: picture(make, ending) for name, (make, ending) in pictures.MAKERS.items()}
