"""Inputs for the command tables of output_bytes/: maps of a relief given by a formula, and models with them."""
import json
import math
import struct
import zlib

FLOAT, BYTES, SHORTS, INTS = 5126, 5121, 5123, 5125  # component types of glTF


def png(path, width, height, channels, bits, sample):
    """Writes a PNG whose channel c of texel (x, y) is the integer sample(x, y, c)."""
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


def layers(mesh, apart):
    """The mesh, and a second copy over its left half, `apart` in front of it."""
    positions, normals, coordinates, triangles = mesh
    count = len(positions)
    over = [[x + apart * n for x, n in zip(p, m)] for p, m in zip(positions, normals)]
    above = [[i + count for i in t] for t in triangles if all(positions[i][0] < 0 for i in t)]
    return positions + over, normals * 2, coordinates * 2, triangles + above


def flat(mesh):
    """The mesh with hard edges everywhere: each triangle has its own vertices and normal."""
    positions, _, coordinates, triangles = mesh
    corners = [[positions[i] for i in t] for t in triangles]
    normals = []
    for a, b, c in corners:
        u, v = ([q - p for p, q in zip(a, other)] for other in (b, c))
        n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
        normals += [[x / math.sqrt(sum(y * y for y in n)) for x in n]] * 3
    return ([p for t in corners for p in t], normals, [coordinates[i] for t in triangles for i in t],
            [[3 * k, 3 * k + 1, 3 * k + 2] for k in range(len(triangles))])


def around(normals):
    """Unit tangents around the barrel, which are not along u: the coordinates are sheared."""
    flat = [[round(n[2], 6), 0.0, round(-n[0], 6)] for n in normals]
    lengths = [math.sqrt(t[0] * t[0] + t[2] * t[2]) for t in flat]
    return [[t[0] / l, 0.0, t[2] / l, 1.0] for t, l in zip(flat, lengths)]


def obj(path, name, mesh, outwards=0.0, with_normals=True, material=None):
    positions, normals, coordinates, triangles = mesh
    lines = [f"mtllib {path.stem}.mtl"] if material else []
    lines += [f"o {name}"]
    lines += ["v " + " ".join(f"{x + outwards * n:.6f}" for x, n in zip(p, m)) for p, m in zip(positions, normals)]
    lines += [f"vt {u:.6f} {1 - v:.6f}" for u, v in coordinates]
    if with_normals:
        lines += ["vn " + " ".join(f"{x:.6f}" for x in n) for n in normals]
    lines += ["usemtl painted"] if material else []
    corner = (lambda i: f"{i + 1}/{i + 1}/{i + 1}") if with_normals else (lambda i: f"{i + 1}/{i + 1}")
    lines += ["f " + " ".join(corner(i) for i in t) for t in triangles]
    path.write_text("\n".join(lines) + "\n")
    if material:
        path.with_suffix(".mtl").write_text(f"newmtl painted\n{material}\n")


def ply(path, mesh):
    positions, normals, coordinates, triangles = mesh
    names = "x y z nx ny nz s t".split()
    lines = ["ply", "format ascii 1.0", f"element vertex {len(positions)}", *(f"property float {n}" for n in names),
             f"element face {len(triangles)}", "property list uchar int vertex_indices", "end_header"]
    lines += [" ".join(f"{x:.6f}" for x in (*p, *n, u, 1 - v)) for p, n, (u, v) in zip(positions, normals, coordinates)]
    lines += [f"3 {a} {b} {c}" for a, b, c in triangles]
    path.write_text("\n".join(lines) + "\n")


def stl(path, mesh):
    positions, _, _, triangles = mesh
    data = b"".join(struct.pack("<12fH", 0, 0, 0, *positions[a], *positions[b], *positions[c], 0) for a, b, c in triangles)
    path.write_bytes(b"barrel".ljust(80) + struct.pack("<I", len(triangles)) + data)


class Gltf:
    """A glTF file with one buffer beside it: `root` is its JSON, add() returns accessor indices."""

    def __init__(self):
        self.root, self.data = {"asset": {"version": "2.0"}, "bufferViews": [], "accessors": []}, b""

    def add(self, values, kind, component=FLOAT, bounds=False, **more):
        form = {FLOAT: "f", BYTES: "B", SHORTS: "H", INTS: "I"}[component]
        self.data += b"\0" * (-len(self.data) % 4)
        packed = b"".join(struct.pack("<" + form * len(v), *v) for v in values)
        self.root["bufferViews"].append({"buffer": 0, "byteOffset": len(self.data), "byteLength": len(packed)})
        accessor = {"bufferView": len(self.root["bufferViews"]) - 1, "componentType": component, "type": kind,
                    "count": len(values) * (len(values[0]) if kind == "SCALAR" else 1), **more}
        if bounds:
            accessor["min"], accessor["max"] = ([f(v[k] for v in values) for k in range(len(values[0]))] for f in (min, max))
        self.root["accessors"].append(accessor)
        self.data += packed
        return len(self.root["accessors"]) - 1

    def primitive(self, mesh, material, with_tangents=False):
        positions, normals, coordinates, triangles = mesh
        attributes = {"POSITION": self.add(positions, "VEC3", bounds=True), "NORMAL": self.add(normals, "VEC3"),
                      "TEXCOORD_0": self.add(coordinates, "VEC2")}
        if with_tangents:
            attributes["TANGENT"] = self.add(around(normals), "VEC4")
        return {"attributes": attributes, "indices": self.add(triangles, "SCALAR", INTS), "material": material}

    def write(self, path):
        for name in ("bufferViews", "accessors"):  # at the end, like most exporters
            self.root[name] = self.root.pop(name)
        self.root["buffers"] = [{"uri": path.stem + ".bin", "byteLength": len(self.data)}]
        path.with_suffix(".bin").write_bytes(self.data)
        path.write_text(json.dumps(self.root, indent=1))


def panel(path, mesh, picture, with_tangents):
    g = Gltf()
    g.root |= {"scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "scale": [-1, 1, 1]}],
               "meshes": [{"primitives": [g.primitive(mesh, 0, with_tangents)]}],
               "materials": [{"normalTexture": {"index": 0}, "pbrMetallicRoughness": {"roughnessFactor": 0.4}}],
               "textures": [{"source": 0}], "images": [{"uri": picture}]}
    g.write(path)


def room_materials():
    """Materials that use the glTF extensions which Cotan reads. Textures: 0 rocks, 1 grain, 2 and 3 colours."""
    turned = {"KHR_texture_transform": {"offset": [0.1, 0.3], "rotation": 0.4, "scale": [2, 1.5]}}
    return [
        {"name": "painted", "normalTexture": {"index": 0, "scale": 0.8, "extensions": turned},
         "pbrMetallicRoughness": {"baseColorTexture": {"index": 2}, "baseColorFactor": [0.9, 0.8, 0.7, 1],
                                  "metallicRoughnessTexture": {"index": 3}, "metallicFactor": 0.6, "roughnessFactor": 0.9},
         "occlusionTexture": {"index": 3, "texCoord": 1, "strength": 0.7},
         "emissiveTexture": {"index": 2}, "emissiveFactor": [0.1, 0.05, 0],
         "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 1.5},
                        "KHR_materials_clearcoat": {"clearcoatFactor": 0.7, "clearcoatRoughnessFactor": 0.2,
                                                    "clearcoatNormalTexture": {"index": 1}}}},
        {"name": "brushed", "doubleSided": True, "normalTexture": {"index": 1},
         "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.5, 0.3, 1], "metallicFactor": 1, "roughnessFactor": 0.35},
         "extensions": {"KHR_materials_anisotropy": {"anisotropyStrength": 0.8, "anisotropyRotation": 0.6}}},
        {"name": "cloth", "pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.1, 0.4, 1], "metallicFactor": 0},
         "extensions": {"KHR_materials_sheen": {"sheenColorFactor": [0.8, 0.6, 0.5], "sheenRoughnessFactor": 0.3},
                        "KHR_materials_ior": {"ior": 1.8},
                        "KHR_materials_specular": {"specularFactor": 0.6, "specularColorFactor": [1, 0.9, 0.5]}}},
        {"name": "glass", "alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [0.6, 0.9, 0.8, 0.5], "roughnessFactor": 0.1},
         "extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.6}}},
        {"name": "leaf", "alphaMode": "MASK", "alphaCutoff": 0.6, "pbrMetallicRoughness": {"baseColorTexture": {"index": 2}}},
        {"name": "sign", "pbrMetallicRoughness": {"baseColorFactor": [1, 0.8, 0.1, 1]}, "extensions": {"KHR_materials_unlit": {}}},
    ]


def room(path, mesh):
    """A scene with most features of glTF: materials, variants, lights, cameras, copies, animations, a skin."""
    positions, normals, coordinates, triangles = mesh
    g = Gltf()
    primitives = [g.primitive(mesh, k, with_tangents=k == 1) for k in range(6)]
    primitives[0]["attributes"]["TEXCOORD_1"] = g.add([[0.5 * u, 0.25 + 0.5 * v] for u, v in coordinates], "VEC2")
    primitives[0]["extensions"] = {"KHR_materials_variants": {"mappings": [{"material": 2, "variants": [0]}, {"material": 5, "variants": [1]}]}}
    primitives[2]["targets"] = [{"POSITION": g.add([[0.3 * y * n for n in m] for (_, y, _), m in zip(positions, normals)], "VEC3", bounds=True)}]
    primitives[3]["attributes"]["JOINTS_0"] = g.add([[0, 1, 0, 0]] * len(positions), "VEC4", BYTES)
    primitives[3]["attributes"]["WEIGHTS_0"] = g.add([[0.5 - y, 0.5 + y, 0, 0] for _, y, _ in positions], "VEC4")
    primitives[5].pop("indices")  # three vertices for each triangle
    primitives[5]["attributes"] = {
        name: g.add([values[i] for t in triangles for i in t], kind, bounds=name == "POSITION")
        for name, kind, values in (("POSITION", "VEC3", positions), ("NORMAL", "VEC3", normals), ("TEXCOORD_0", "VEC2", coordinates))}
    times = g.add([[0.0], [0.5], [1.0]], "SCALAR", bounds=True)
    half = math.sqrt(0.5)
    turns = g.add([[0, 0, 0, 1], [0, half, 0, half], [0, 1, 0, 0]], "VEC4")
    steps = g.add([[0, 0, 0], [0, 0.4, 0.1], [0.2, 0, 0]], "VEC3")
    smooth = g.add([[0.0], [0.0], [1.0], [1.0], [0.8], [-1.0], [0.0], [0.2], [0.0]], "SCALAR")
    sampler = lambda output, how: {"input": times, "output": output, "interpolation": how}
    channel = lambda number, node, way: {"sampler": number, "target": {"node": node, "path": way}}
    g.root |= {
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_variants", "EXT_mesh_gpu_instancing", "KHR_texture_transform"],
        "scene": 0, "scenes": [{"nodes": list(range(13))}],
        "meshes": [{"name": f"part-{k}", "primitives": [p], **({"weights": [0.25]} if k == 2 else {})} for k, p in enumerate(primitives)],
        "nodes": [
            {"mesh": 0}, {"mesh": 1, "translation": [1.4, 0.2, 0], "rotation": [0, 0.2, 0, 0.98]},
            {"mesh": 2, "translation": [-1.4, 0, 0.1], "scale": [0.8, 1.2, 1]}, {"mesh": 3, "skin": 0},
            {"mesh": 4, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {
                "TRANSLATION": g.add([[0.2, 1.1, 0], [-1, 1.2, 0.3]], "VEC3"), "SCALE": g.add([[0.7, 0.7, 0.7], [0.5, 0.6, 0.7]], "VEC3")}}}},
            {"mesh": 5, "translation": [1.2, 1.2, 0], "scale": [-0.6, 0.6, 0.6]},
            {"name": "lower", "translation": [0, -1, 0.3]}, {"name": "upper", "translation": [0.2, -1.1, 0.3]},
            {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [0, 2, 3]},
            {"extensions": {"KHR_lights_punctual": {"light": 1}}, "translation": [1, 0.5, 3]},
            {"extensions": {"KHR_lights_punctual": {"light": 2}}, "rotation": [-0.3, 0.2, 0, 0.93]},
            {"camera": 0, "translation": [0.3, 0.4, 5]}, {"camera": 1, "translation": [-0.2, 0.1, 6]}],
        "skins": [{"joints": [6, 7]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.1, "zfar": 50}},
                    {"type": "orthographic", "orthographic": {"xmag": 3, "ymag": 2, "znear": 0.5, "zfar": 20}}],
        "animations": [
            {"name": "turn", "samplers": [sampler(turns, "LINEAR"), sampler(steps, "STEP")],
             "channels": [channel(0, 0, "rotation"), channel(1, 1, "translation")]},
            {"name": "bend", "samplers": [sampler(smooth, "CUBICSPLINE"), sampler(steps, "LINEAR")],
             "channels": [channel(0, 2, "weights"), channel(1, 7, "translation")]}],
        "materials": room_materials(), "samplers": [{"wrapS": 33648, "wrapT": 33071, "magFilter": 9728}],
        "textures": [{"source": 0}, {"source": 1}, {"source": 2, "sampler": 0}, {"source": 3}],
        "images": [{"uri": name} for name in ("rocks.png", "grain.png", "colors.png", "rough.png")],
        "extensions": {
            "KHR_materials_variants": {"variants": [{"name": "cloth"}, {"name": "sign"}]},
            "KHR_lights_punctual": {"lights": [
                {"type": "point", "color": [1, 0.7, 0.4], "intensity": 30},
                {"type": "spot", "intensity": 60, "range": 8, "spot": {"innerConeAngle": 0.2, "outerConeAngle": 0.5}},
                {"type": "directional", "color": [0.4, 0.6, 1], "intensity": 2}]}}}
    g.write(path)


def make_inputs(folder):
    def code(value):
        return int(math.floor(128 + 127 * value + 0.5))
    png(folder / "height.png", 48, 32, 1, 16, lambda x, y, c: int(32768 + 1e6 * relief((x + 0.5) / 48, (y + 0.5) / 32)))
    png(folder / "rocks.png", 48, 48, 3, 8, lambda x, y, c: code(relief_normal((x + 0.5) / 48, 1 - (y + 0.5) / 48)[c]))
    png(folder / "grain.png", 16, 16, 3, 8, lambda x, y, c: code(relief_normal((x + 0.5) / 16, 1 - (y + 0.5) / 16)[c]))
    (folder / "sky.hdr").write_bytes(b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n" + bytes(v for y in range(4) for x in range(8) for v in (32 * x, 60 * y, 128, 130 - y)))
    png(folder / "mask.png", 48, 48, 1, 8, lambda x, y, c: 5 * x)
    png(folder / "colors.png", 24, 16, 4, 8, lambda x, y, c: (10 * x, 15 * y, 90 + 60 * ((x // 4 + y // 4) % 2), 255 - 8 * x)[c])
    png(folder / "rough.png", 16, 24, 3, 8, lambda x, y, c: (120 + 8 * x, 10 * y, 255 - 16 * x)[c])
    low, high = patch(4, 0), patch(24, 1)
    obj(folder / "low.obj", "part_low", low)
    obj(folder / "cage.obj", "cage", low, outwards=0.08)
    obj(folder / "high.obj", "part_high", high, with_normals=False)
    obj(folder / "flat.obj", "flat", flat(low))
    obj(folder / "mirrored.obj", "mirrored", (low[0], low[1], [[abs(u - 0.4), v] for u, v in low[2]], low[3]))
    obj(folder / "layers.obj", "layers", layers(high, 0.05), with_normals=False)
    obj(folder / "painted.obj", "painted", low, material="Kd 0.8 0.6 0.4\nNs 60\nKs 0.5 0.5 0.5\nmap_Kd colors.png\nnorm rocks.png")
    ply(folder / "low.ply", low)
    stl(folder / "low.stl", low)
    panel(folder / "panel.gltf", low, "rocks.png", with_tangents=True)
    panel(folder / "plain.gltf", low, "rocks.png", with_tangents=False)
    room(folder / "room.gltf", low)
    square = [[0, 0], [1, 0], [1, 1], [0, 1]]
    def rectangle(x, y, z, width, height, rise):
        return [[x + u * width, y + v * height, z + u * rise] for u, v in square]
    tile = (rectangle(0, 0, 0, 1, 1, 0), [[0, 0, 1]] * 4, [[u, 1 - v] for u, v in square], [[0, 1, 2], [0, 2, 3]])
    obj(folder / "tile.obj", "tile", tile)
    obj(folder / "tile_high.obj", "tile_high", (tile[0] + rectangle(0.8, 0.4, 0.03, 0.4, 0.2, 0.05), tile[1] * 2, tile[2] * 2, tile[3] + [[4, 5, 6], [4, 6, 7]]), with_normals=False)
