"""glTF models whose triangles cover many texels or pixels, for fuzz/bombs.py."""
import bomb_images as pictures
from bomb_gltf import LIMIT, Gltf, flat_map


def skewed_uv(r, folder):
    """One triangle whose uv repeat a map many times, skewed."""
    g = Gltf()
    n = r.choice([3, 10, 40, 300, 3000])
    material = g.map(flat_map(r.choice([512, 1024, 2048, 4096])))
    g.place([{"attributes": g.triangle((0, 0, n, n * r.random(), n * r.random(), n)), "material": material}])
    return g.write(folder)


def equal_triangles(r, folder):
    """One triangle with a map, repeated many times."""
    g = Gltf()
    count = r.randint(100_000, 150_000)
    material = g.map(flat_map(r.choice([64, 512, 2048])))
    g.place([{"attributes": g.triangle(), "indices": g.indices([0, 1, 2] * count), "material": material}])
    return g.write(folder)


def sliver_uv(r, folder):
    """Thin triangles that cross the whole map."""
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
    """Materials with large flat maps, with equal or different bytes."""
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


def soup(r, folder):
    """Triangles that cover the image, one behind the other, translucent or not."""
    g = Gltf()
    count = r.randint(3000, 9000)
    points = [c for k in range(count) for c in (0, 0, k * 1e-4, 1, 0, k * 1e-4, 0, 1, k * 1e-4)]
    g.add("materials", {"alphaMode": r.choice(["BLEND", "MASK", "OPAQUE"]), "doubleSided": True,
                        "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}})
    g.place([{"attributes": {"POSITION": g.floats(points, 3)}, "material": 0}])
    return g.write(folder)


def fan(r, folder):
    """Many triangles around one vertex or one edge."""
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
    """Triangles whose vertices all have the same position, the same uv, or both."""
    g = Gltf()
    count = r.randint(5000, 8000)
    same = r.choice(["position", "uv", "both"])
    points = [0 if same != "uv" else r.random() for _ in range(9 * count)]
    uv = [0 if same != "position" else r.random() for _ in range(6 * count)]
    g.place([{"attributes": g.triangle(uv, points), "material": g.map(flat_map(64))}])
    return g.write(folder)


def random_triangles(g, r, count, corners=255):
    """Adds indices of random triangles between few vertices, one byte each."""
    data = bytes(r.randrange(corners) for _ in range(3 * count))
    g.root["accessors"].append({"bufferView": g.view(data), "componentType": 5121, "count": 3 * count, "type": "SCALAR"})
    return len(g.root["accessors"]) - 1


def web(r, folder):
    """Large overlapping triangles between few vertices, with a map."""
    g = Gltf()
    points = [r.random() * (1 if k % 3 < 2 else r.choice([0, 1])) for k in range(3 * 255)]
    attributes = {"POSITION": g.floats(points, 3), "TEXCOORD_0": g.floats([r.random() for _ in range(2 * 255)], 2)}
    indices = random_triangles(g, r, r.randint(100_000, 300_000))
    g.place([{"attributes": attributes, "indices": indices, "material": g.map(flat_map(r.choice([64, 1024])))}])
    return g.write(folder)


def overlapping_uv(r, folder):
    """Different triangles on a curved surface that each cover much of the map."""
    g = Gltf()
    count = r.randint(2000, 8000)
    points, uv = [], []
    for k in range(count):
        x, y = k % 100, k // 100
        points += [x, y, r.random(), x + 1, y, r.random(), x, y + 1, r.random()]
        uv += [r.random() * 0.3, r.random() * 0.3, 0.7 + r.random() * 0.3, r.random() * 0.3, r.random() * 0.3, 0.7 + r.random() * 0.3]
    attributes = {"POSITION": g.floats(points, 3), "TEXCOORD_0": g.floats(uv, 2)}
    g.place([{"attributes": attributes, "material": g.map(flat_map(r.choice([256, 1024, 2048])))}])
    return g.write(folder)


def grid(g, r, side, tiles, bump, fraction=1.0):
    """Returns the attributes and indices of a floor of side x side squares, on which the map is repeated."""
    points, normals, uv = [], [], []
    for y in range(side + 1):
        for x in range(side + 1):
            points += [x, bump * r.random(), y]
            normals += [0.0, 1.0, 0.0]
            uv += [tiles * x / side * fraction, tiles * y / side]
    indices = []
    for y in range(side):
        for x in range(side):
            a = y * (side + 1) + x
            indices += [a, a + side + 1, a + 1, a + 1, a + side + 1, a + side + 2]
    attributes = {"POSITION": g.floats(points, 3), "NORMAL": g.floats(normals, 3), "TEXCOORD_0": g.floats(uv, 2)}
    return attributes, g.indices(indices, wide=True)


def tiled_floor(r, folder):
    """A floor of many triangles with a repeated map, as in games."""
    g = Gltf()
    attributes, indices = grid(g, r, r.randint(20, 100), r.choice([4, 10, 30]), r.choice([0.1, 1]))
    g.place([{"attributes": attributes, "indices": indices, "material": g.map(flat_map(r.choice([1024, 2048, 4096])))}])
    return g.write(folder)


def half_map(r, folder):
    """A surface that uses a part of a large map."""
    g = Gltf()
    attributes, indices = grid(g, r, r.randint(10, 100), 1, 0.5, fraction=r.choice([0.05, 0.5, 0.9]))
    g.place([{"attributes": attributes, "indices": indices, "material": g.map(flat_map(r.choice([2048, 4096, 8192])))}])
    return g.write(folder)


def far_uv(r, folder):
    """Thin triangles in uv, each crossing thousands of copies of the map."""
    g = Gltf()
    count, far = r.randint(1000, 8000), r.choice([100, 10_000, 1e6])
    points, uv = [], []
    for k in range(count):
        points += [k, 0, r.random(), k + 1, 0, r.random(), k, 1, r.random()]
        u, v = far * r.random(), far * r.random()
        uv += [0, 0, u, v, u * 1.0001, v]
    attributes = {"POSITION": g.floats(points, 3), "TEXCOORD_0": g.floats(uv, 2)}
    g.place([{"attributes": attributes, "material": g.map(flat_map(r.choice([64, 512])))}])
    return g.write(folder)


def many_lights(r, folder):
    """Thousands of lights on a surface that fills the image."""
    g = Gltf()
    attributes, indices = grid(g, r, 10, 1, 0.1)
    g.place([{"attributes": attributes, "indices": indices, "material": g.map(flat_map(64))}])
    kind = r.choice(["point", "directional", "spot"])
    lights = [{"type": kind} | ({"spot": {}} if kind == "spot" else {})] * r.randint(100, 9000)
    g.root["extensions"] = {"KHR_lights_punctual": {"lights": lights}}
    g.root["extensionsUsed"] = ["KHR_lights_punctual"]
    for k in range(len(lights)):
        node = {"translation": [10 * r.random(), 5, 0], "extensions": {"KHR_lights_punctual": {"light": k}}}
        g.root["scenes"][0]["nodes"].append(g.add("nodes", node))
    return g.write(folder)


def many_layers(r, folder):
    """Overlapping layers, translucent or not, whose material uses many extensions."""
    g = Gltf()
    material = g.map(flat_map(64))
    g.root["materials"][material] |= {
        "alphaMode": r.choice(["BLEND", "OPAQUE"]), "doubleSided": True,
        "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5], "baseColorTexture": {"index": 0}},
        "extensions": {"KHR_materials_transmission": {"transmissionFactor": r.choice([0, 0.5])},
                       "KHR_materials_clearcoat": {"clearcoatFactor": 1, "clearcoatNormalTexture": {"index": 0}},
                       "KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1]}, "KHR_materials_anisotropy": {"anisotropyStrength": 1}}}
    g.root["extensionsUsed"] = sorted(g.root["materials"][material]["extensions"])
    points, uv = [], []
    for k in range(r.choice([20, 200, 2000])):
        points += [0, 0, k * 1e-3, 1, 0, k * 1e-3, 0, 1, k * 1e-3]
        uv += [0, 0, 1, 0, 0, 1]
    g.place([{"attributes": {"POSITION": g.floats(points, 3), "TEXCOORD_0": g.floats(uv, 2)}, "material": material}])
    return g.write(folder)
