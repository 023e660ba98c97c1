"""glTF models with huge numbers of elements, for fuzz/bombs.py."""
from bomb_gltf import Gltf, flat_map


def stretched_nodes(r, folder):
    """Nodes that each scale a mesh of many primitives differently."""
    g = Gltf()
    material = g.map(flat_map(64))
    attributes = g.triangle()
    mesh = g.add("meshes", {"primitives": [{"attributes": attributes, "material": material}] * r.randint(2000, 6000)})
    for _ in range(r.randint(50, 200)):
        node = {"mesh": mesh, "scale": [1 + r.random(), 1, 1 + r.random()], "translation": [r.random(), 0, 0]}
        g.root["scenes"][0]["nodes"].append(g.add("nodes", node))
    return g.write(folder)


def many_materials(r, folder):
    """Many primitives, each with its own material."""
    g = Gltf()
    attributes = g.triangle()
    primitives = []
    for k in range(r.randint(5000, 6800)):
        name = r.choice(["baseColorFactor", "metallicFactor"])
        g.add("materials", {"pbrMetallicRoughness": {name: [k / 9000, 1, 0.5, 1] if name == "baseColorFactor" else k / 9000}})
        primitives.append({"attributes": attributes, "material": k})
    g.place(primitives)
    return g.write(folder)


def many_primitives(r, folder):
    """Many primitives of one triangle and one material, with one or several instances, opaque or not."""
    g = Gltf()
    alpha = r.choice(["OPAQUE", "MASK", "BLEND"])
    g.add("materials", {"alphaMode": alpha, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5 + r.random() / 2]}})
    primitives = [{"attributes": g.triangle(), "material": 0}] * r.randint(8000, 12_000)
    g.place(primitives)
    for _ in range(r.choice([0, 0, 3])):
        g.root["scenes"][0]["nodes"].append(g.add("nodes", {"mesh": 0, "translation": [r.random() * 3, 0, 0]}))
    return g.write(folder)


def many_members(r, folder):
    """An object with very many members, up to the limit, with many lookups in it."""
    g = Gltf()
    material = g.map(flat_map(4))
    attributes = g.triangle()
    g.place([{"attributes": attributes, "material": material}])
    count = r.randint(2000, 4000)
    for _ in range(count):
        g.root["materials"].append({"normalTexture": {"index": g.add("textures", {"source": 0})}})
    g.root["meshes"][0]["primitives"] = [{"attributes": attributes, "material": k} for k in range(count)]
    owner = r.choice([g.root, g.root["meshes"][0], g.root["materials"][0], g.root["textures"][0], g.root["images"][0],
                      g.root["accessors"][0], g.root["bufferViews"][0]])
    if r.random() < 0.5:
        for primitive in g.root["meshes"][0]["primitives"]:
            primitive["material"] = 0
    first = {f"m{k}": 0 for k in range(r.choice([4000, 40_000]))} | owner  # readers search from the first member on
    owner.clear()
    owner.update(first)
    return g.write(folder)


def many_nodes(r, folder):
    """Many nodes of one mesh, as siblings or nested."""
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
    """EXT_mesh_gpu_instancing: each instance of a long list draws each of the equal or different primitives."""
    g = Gltf()
    count, different = r.choice([1, 10, 60]), r.random() < 0.5
    shapes = [g.triangle(points=[r.random() for _ in range(9)]) for _ in range(count if different else 1)]
    mesh = g.add("meshes", {"primitives": [{"attributes": shapes[k % len(shapes)]} for k in range(count)]})
    translations = g.floats([r.random() * r.choice([0, 100]) for _ in range(3 * r.randint(5000, 15_000))], 3)
    g.add("nodes", {"mesh": mesh, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": translations}}}})
    g.root["scenes"][0]["nodes"], g.root["extensionsUsed"] = [0], ["EXT_mesh_gpu_instancing"]
    return g.write(folder)


def shared_data(r, folder):
    """Many primitives that share large arrays."""
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


def animated(r, folder):
    """Thousands of channels, keys and morph targets."""
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


def parts_in_place(r, folder):
    """Many meshes with a node each, all at the same position, with few materials."""
    g = Gltf()
    attributes = g.triangle()
    materials = [g.add("materials", {"name": f"m{k}"}) for k in range(r.choice([1, 10]))]
    for k in range(r.randint(5000, 7500)):
        g.place([{"attributes": attributes, "material": materials[k % len(materials)]}])
    return g.write(folder)


def skinned(r, folder):
    """Skins with many joints and many primitives."""
    g = Gltf()
    count, joints = r.randint(100, 4000), r.randint(10, 5000)
    attributes = g.triangle()
    data = g.view(b"\0" * 4 * 3)
    g.root["accessors"].append({"bufferView": data, "componentType": 5121, "count": 3, "type": "VEC4"})
    attributes |= {"JOINTS_0": len(g.root["accessors"]) - 1, "WEIGHTS_0": g.floats([1.0, 0, 0, 0] * 3, 4)}
    mesh = g.add("meshes", {"primitives": [{"attributes": attributes}] * count})
    nodes = [g.add("nodes", {"translation": [r.random(), 0, 0]}) for _ in range(joints)]
    skin = g.add("skins", {"joints": nodes})
    for _ in range(r.choice([1, 30])):
        g.root["scenes"][0]["nodes"].append(g.add("nodes", {"mesh": mesh, "skin": skin}))
    g.root["scenes"][0]["nodes"] += nodes
    return g.write(folder)


def variants(r, folder):
    """KHR_materials_variants: each primitive has a material for each variant."""
    g = Gltf()
    count, primitives = r.randint(10, 300), r.randint(50, 300)
    g.root["extensions"] = {"KHR_materials_variants": {"variants": [{"name": f"v{k}"} for k in range(count)]}}
    g.root["extensionsUsed"] = ["KHR_materials_variants"]
    for _ in range(count):
        g.map(flat_map(1))
    mappings = [{"material": k, "variants": [k]} for k in range(min(count, 15_000 // primitives))]
    g.place([{"attributes": g.triangle(), "extensions": {"KHR_materials_variants": {"mappings": mappings}}}] * primitives)
    return g.write(folder)


def sparse(r, folder):
    """Many sparse accessors without base data that share one list."""
    g = Gltf()
    count, few = r.choice([30_000, 1_000_000, 20_000_000]), r.randint(1000, 20_000)
    step = count // few
    at = g.view(b"".join((k * step).to_bytes(4, "little") for k in range(few)))
    values = g.view(b"\0\0\x80\x3f" * 3 * few)
    for _ in range(r.choice([1, 100, 2000])):
        g.root["accessors"].append({"componentType": 5126, "count": count, "type": "VEC3", "min": [0] * 3, "max": [1] * 3, "sparse": {
            "count": few, "indices": {"bufferView": at, "componentType": 5125}, "values": {"bufferView": values}}})
    g.place([{"attributes": {"POSITION": k}} for k in range(len(g.root["accessors"]))])
    return g.write(folder)


def strips(r, folder):
    """Strips and fans with byte indices: one triangle per byte."""
    g = Gltf()
    count = r.randint(300_000, 900_000)
    attributes = g.triangle([r.random() for _ in range(2 * 200)], [r.random() for _ in range(3 * 200)])
    data = bytes(r.randrange(200) for _ in range(count)) if r.random() < 0.5 else bytes([0, 1, 2, 3]) * (count // 4)
    g.root["accessors"].append({"bufferView": g.view(data), "componentType": 5121, "count": len(data), "type": "SCALAR"})
    g.place([{"attributes": attributes, "indices": len(g.root["accessors"]) - 1, "mode": r.choice([1, 5, 6]),
              "material": g.map(flat_map(r.choice([16, 512])))}])
    return g.write(folder)


def far_apart(r, folder):
    """Nodes scaled and translated up to the limits of floats."""
    g = Gltf()
    mesh = g.add("meshes", {"primitives": [{"attributes": g.triangle(), "material": g.map(flat_map(16))}]})
    for _ in range(r.randint(10, 5000)):
        size = 10.0 ** r.uniform(-38, 38)
        node = {"mesh": mesh, "scale": [size, size, 10.0 ** r.uniform(-38, 38)], "translation": [size, r.uniform(-size, size), 0]}
        g.root["scenes"][0]["nodes"].append(g.add("nodes", node))
    return g.write(folder)
