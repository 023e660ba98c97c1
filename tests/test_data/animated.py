"""Models with skins and morph targets."""

import numpy as np

from files import Gltf
from models import material_of, surface_maps
import shapes
from shapes import Mesh


def turn(axis, degrees):
    """A quaternion."""
    half = np.radians(degrees) / 2
    return np.append(np.sin(half) * np.asarray(axis, float), np.cos(half))


def animate(gltf, name, tracks):
    """tracks: (node, path, times, values)."""
    animation = {"name": name, "samplers": [], "channels": []}
    for node, path, times, values in tracks:
        animation["samplers"].append({"input": gltf.add(np.array(times, np.float32), bounds=True),
                                      "output": gltf.add(np.array(values, np.float32).reshape(
                                          -1 if path == "weights" else len(times), *([] if path == "weights" else [len(values[0])])))})
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1,
                                      "target": {"node": node, "path": path}})
    gltf.list("animations", animation)


def skeleton(gltf, joints):
    """Appends joints, (parent or None, position in the rest pose), and their skin. Returns the nodes."""
    first = len(gltf.root["nodes"])
    inverse = []
    for parent, at in joints:
        offset = np.asarray(at, float) - (joints[parent][1] if parent is not None else np.zeros(3))
        gltf.node({"name": f"joint {len(inverse)}", "translation": offset.tolist()}, child=parent is not None)
        if parent is not None:
            gltf.root["nodes"][first + parent].setdefault("children", []).append(first + len(inverse))
        matrix = np.eye(4)
        matrix[3, :3] = -np.asarray(at, float)  # columns one after the other
        inverse.append(matrix)
    nodes = list(range(first, first + len(joints)))
    gltf.list("skins", {"joints": nodes, "inverseBindMatrices": gltf.add(np.array(inverse).reshape(-1, 16))})
    return nodes


def fox(file):
    """One primitive without normals and indices, with smooth weights; its legs stretch when it runs."""
    gltf = Gltf()
    joints = [(None, (0, 0, 0)), (0, (0, 0, 40)), (1, (0, 10, 60))]
    body = shapes.tube(24, 24, lambda t: 14 * np.sqrt(np.maximum(1e-3, 1 - (2 * t - 1)**4)), 100)
    # Texels are square in the rest pose.
    body = Mesh(body.position[:, [0, 2, 1]], body.normal, body.uv * [0.88, 1], body.triangles[:, ::-1])
    parts, owners = [body], []
    z = body.position[:, 2]
    bend = np.clip((z - 10) / 30, 0, 1)
    owners.append(np.stack([1 - bend, bend, 0 * bend], 1))
    for leg in range(4):
        x, z = (leg % 2 * 2 - 1) * 8, (leg // 2 * 2 - 1) * 32
        upper = len(joints)
        joints += [(1 if leg > 1 else 0, (x, -8, z)), (upper, (x, -30, z))]
        mesh = shapes.tube(12, 24, lambda t: 5 + 0 * t, 48).moved((x, -32, z)).charted((0.65, 1))
        down = np.clip((-mesh.position[:, 1] - 24) / 12, 0, 1)
        weights = np.zeros((len(mesh.position), len(joints)))
        weights[:, upper], weights[:, upper + 1] = 1 - down, down
        parts.append(mesh)
        owners.append(weights)
    mesh = shapes.split(shapes.joined(parts))
    count = len(joints)
    weights = np.concatenate([np.pad(w, ((0, 0), (0, count - w.shape[1]))) for w in owners])
    corners = shapes.joined(parts).triangles.reshape(-1)
    weights = weights[corners]
    four = np.argsort(-weights, axis=1)[:, :4]
    base = gltf.image(shapes.checks((200, 110, 40), (230, 150, 80), 8))
    gltf.list("materials", {"name": "fox_material", "pbrMetallicRoughness": {
        "baseColorTexture": base, "metallicFactor": 0, "roughnessFactor": 0.58}})
    mesh.triangles, mesh.normal = None, None
    gltf.mesh(mesh, 0, name="fox", node={"skin": 0}, JOINTS_0=four.astype(np.uint16),
              WEIGHTS_0=np.take_along_axis(weights, four, 1))
    nodes = skeleton(gltf, joints)
    times = np.linspace(0, 1.2, 13)
    swing = np.sin(2 * np.pi * times / 1.2)
    def walk(degrees, stretch):
        tracks = []
        for leg in range(4):
            sign = 1 if leg in (0, 3) else -1
            tracks.append((nodes[3 + 2 * leg], "rotation", times, [turn((1, 0, 0), sign * degrees * s) for s in swing]))
            tracks.append((nodes[4 + 2 * leg], "rotation", times, [turn((1, 0, 0), degrees * abs(s)) for s in swing]))
            tracks.append((nodes[3 + 2 * leg], "scale", times, [(1, 1 + stretch * s * s, 1) for s in swing]))
        tracks.append((nodes[1], "rotation", times, [turn((0, 1, 0), degrees / 2 * s) for s in swing]))
        return tracks
    animate(gltf, "Survey", [(nodes[1], "rotation", times, [turn((0, 1, 0), 45 * s) for s in swing]),
                             (nodes[1], "scale", times, [(1, 1, 1 + 0.4 * s * s) for s in swing])])
    animate(gltf, "Walk", walk(25, 0.3))
    animate(gltf, "Run", walk(40, 0.9))
    gltf.write(file)


def lumberjack(file):
    """One primitive with rigid weights. finish.mjs inverts w except on the hat, at the top."""
    gltf = Gltf()
    maps = surface_maps(gltf, shapes.domes(8), 256, green=-1)
    gltf.list("materials", {"name": "Lumberjack", "doubleSided": True, "normalTexture": maps["normal"],
                            "pbrMetallicRoughness": {"baseColorTexture": maps["base"],
                                                     "metallicRoughnessTexture": maps["rough"]}})
    joints, parts, owner = [(None, (0, 0, 0)), (0, (0, 0.5, 0))], [], []
    parts.append(shapes.tube(24, 12, lambda t: 0.35 + 0.05 * np.sin(3 * t), 1))
    parts.append(shapes.zone(24, 12).moved((0, 0.85, 0), 0.25))
    hat = shapes.tube(16, 3, lambda t: 0.16 + 0 * t, 0.12).moved((0, 1.2, 0))
    parts.append(hat.charted((0.02, 0.02), (0.49, 0.49)))  # where the map is flat, so that w makes no difference
    owner += [0, 1, 1]
    for side in (-1, 1):
        for y, z, parent in ((0.4, 0, 0), (-0.5, 0, 0)):
            x = side * (0.5 if y > 0 else 0.2)
            joints.append((parent, (x, y, z)))
            parts.append(shapes.tube(16, 12, lambda t: 0.1 + 0 * t, 0.8).moved((x, y - 0.4, z)))
            owner.append(len(joints) - 1)
    mesh = shapes.joined(parts)
    bone = np.concatenate([np.full(len(p.position), o) for p, o in zip(parts, owner)])
    joint = np.stack([bone, 0 * bone, 0 * bone, 0 * bone], 1).astype(np.uint16)
    gltf.mesh(mesh, 0, name="Lumberjack", node={"skin": 0}, JOINTS_0=joint,
              WEIGHTS_0=np.tile([1.0, 0, 0, 0], (len(bone), 1)))
    nodes = skeleton(gltf, joints)
    times = np.linspace(0, 5, 21)
    swing = np.sin(2 * np.pi * times / 2.5)
    def poses(degrees):
        return [(nodes[2 + k], "rotation", times, [turn((1, 0, 0), (1 if k in (0, 3) else -1) * degrees * s)
                                                   for s in swing]) for k in range(4)]
    animate(gltf, "Walk", poses(30))
    animate(gltf, "Poses", poses(70) + [(nodes[1], "rotation", times, [turn((0, 1, 0), 50 * s) for s in swing])])
    gltf.write(file)


def morph_stress(file):
    """A plate with eight targets, each of which raises a bump and stretches the texture on it."""
    gltf = Gltf()
    label, base, stripes = [gltf.image(shapes.checks(a, b, 4)) for a, b in (
        ((255, 255, 255), (220, 220, 220)), ((60, 60, 60), (90, 90, 90)), ((180, 180, 190), (90, 120, 180)))]
    gltf.list("materials", {"doubleSided": True, "name": "Base", "occlusionTexture": {**label, "texCoord": 1},
                            "pbrMetallicRoughness": {"baseColorTexture": base, "metallicFactor": 0,
                                                     "roughnessFactor": 0.4}})
    gltf.list("materials", {"doubleSided": True, "name": "TestMaterial", "pbrMetallicRoughness": {
        "baseColorTexture": stripes, "metallicFactor": 0, "roughnessFactor": 0.5}})
    def plate(k=None):
        def of(s, t):
            x, y = 4 * (s - 0.5), 1.0 * (t - 0.5)
            rise, push = 0 * x, 0 * x
            if k is not None:
                across = (x - (0.5 * k - 1.75)) / 0.3
                inside = np.maximum(0, 1 - across**2 - (y / 0.45)**2)**2
                rise, push = 0.04 * inside, 0.25 * inside * across
            return x + push, rise, -y
        return shapes.surface(of, 96, 24)
    flat = plate().charted((4, 1))  # square texels in the rest pose
    half = (0.3, 0.1, 0.15)
    box = shapes.rounded_box(half, 0.05, 8, lambda face: ((half[(face // 2 + 1) % 3], half[(face // 2 + 2) % 3]), (0, 0)))
    box = box.moved((0, -0.2, 0))
    none = np.zeros_like(box.position)
    primitives = [gltf.mesh(box, 0, TEXCOORD_1=box.uv), gltf.mesh(flat, 1, TEXCOORD_1=flat.uv)]
    primitives[0]["targets"] = [{"POSITION": gltf.add(none, bounds=True), "NORMAL": gltf.add(none)}] * 8
    primitives[1]["targets"] = [{"POSITION": gltf.add(bump.position - flat.position, bounds=True),
                                 "NORMAL": gltf.add(bump.normal - flat.normal)} for bump in map(plate, range(8))]
    gltf.root["meshes"] = [{"primitives": primitives, "weights": [0] * 8, "name": "plate"}]
    gltf.root["nodes"] = [{"mesh": 0, "name": "plate"}]
    gltf.root["scenes"] = [{"nodes": [0]}]
    times = np.linspace(0, 4, 33)
    def weights(of):
        return [[float(np.clip(of(t, k), 0, 1)) for k in range(8)] for t in times]
    animate(gltf, "Individuals", [(0, "weights", times, weights(lambda t, k: 1 - abs(2 * t - k)))])
    animate(gltf, "Pulse", [(0, "weights", times, weights(lambda t, k: np.sin(np.pi * t)**2))])
    animate(gltf, "TheWave", [(0, "weights", times, weights(lambda t, k: 0.5 + 0.5 * np.sin(2 * np.pi * (t / 2 - k / 8))))])
    gltf.write_embedded(file)


def make(folder, unfinished):
    fox(folder / "animated/Fox.glb")
    lumberjack(unfinished / "animated/lumberjack.glb")
    morph_stress(folder / "animated/MorphStressTest.gltf")
    return [{"file": "animated/lumberjack.glb", "tangents": "inverted below 1.13"}]
