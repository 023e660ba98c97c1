"""OBJ, PLY, STL and COLLADA files that take much time or memory, for fuzz/bombs.py."""
import struct

import bomb_images as pictures
from bomb_gltf import LIMIT, written

OBJ_TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"


def obj_usemtl(r, folder):
    """A group or a material for each face, with the same or different positions."""
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
    """One triangle repeated many times."""
    return written(folder, "bomb.obj", OBJ_TRIANGLE + r.choice(["f 1 2 3\n", "f 1/1 2/2 3/3\n"]) * r.randint(40_000, 60_000))


def obj_polygon(r, folder):
    """A polygon with very many corners: a comb, a spiral, a star or noise."""
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
    """Long lines, many names, many vertices without faces."""
    return written(folder, "bomb.obj", r.choice(["v " + "0" * 900_000, "g " + "a " * 450_000, "\n" * 900_000, "l " + "1 " * 400_000,
                                                  OBJ_TRIANGLE + "f 1 2 3 \\\n" * 100_000, "mtllib a.mtl\n" * 70_000]))


def ply_equal(r, folder):
    """One triangle repeated many times, or a polygon with many corners, in binary."""
    polygon = r.random() < 0.4
    count = r.randint(100_000, 240_000)
    corners = struct.pack(f"<I{count}i", count, *(k % 3 if r.random() < 0.5 else k % 1000 for k in range(count)))
    faces = [corners] if polygon else [struct.pack("<Iiii", 3, 0, 1, 2)] * (count // 4)
    vertices = [struct.pack("<3f", r.random(), r.random(), 0) for _ in range(1000)]
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\nproperty float x\nproperty float y\n"
            f"property float z\nelement face {len(faces)}\nproperty list uint int vertex_indices\nend_header\n")
    return written(folder, "bomb.ply", head.encode() + b"".join(vertices) + b"".join(faces))


def ply_grid(r, folder):
    """Vertex and face counts that the data does not match."""
    count = r.choice([70_000, 10_000_000])
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {count}\nproperty float x\nproperty float y\nproperty float z\n"
            f"element face {count}\nproperty list uchar int vertex_indices\nend_header\n")
    return written(folder, "bomb.ply", head.encode() + struct.pack("<3f", 0, 0, 1) * 40_000 + b"\3" + b"\0" * 400_000)


def stl_equal(r, folder):
    """One triangle repeated many times, or triangles without area."""
    same = r.random() < 0.6
    count = r.randint(10_000, 19_000)
    faces = [struct.pack("<12fH", 0, 0, 1, *((0, 0, 0, 1, 0, 0, 0, 1, 0) if same else [r.random()] * 9), 0) for _ in range(count)]
    return written(folder, "bomb.stl", b"\0" * 80 + struct.pack("<I", count) + b"".join(faces))


def stl_solids(r, folder):
    """Text with many solids."""
    solid = ("solid a{k}\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 {k}\nvertex 0 1 0\nendloop\nendfacet\n"
             "endsolid a{k}\n")
    same = r.random() < 0.5
    return written(folder, "bomb.stl", "".join(solid.format(k=0 if same else k) for k in range(r.randint(4000, 7500))))


def collada(r, folder):
    """Many instances of one geometry, or many geometries."""
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
    """Nested entities, or library nodes that each instantiate the next one twice."""
    if r.random() < 0.5:
        entities = "".join(f'<!ENTITY e{k} "{f"&e{k - 1};" * 10}">' for k in range(1, 12))
        return written(folder, "bomb.dae", f'<?xml version="1.0"?><!DOCTYPE a [<!ENTITY e0 "aaaa">{entities}]><COLLADA version="1.4.1">&e11;</COLLADA>')
    depth = r.randint(12, 40)
    nodes = "".join(f'<node id="n{k}">{f"<instance_node url=#n{k + 1}/>".replace("#", chr(34) + "#").replace("/>", chr(34) + "/>") * 2}</node>'
                    for k in range(depth))
    return written(folder, "bomb.dae", '<?xml version="1.0"?><COLLADA version="1.4.1"><asset/><library_nodes>' + nodes
                   + f'<node id="n{depth}"/></library_nodes><library_visual_scenes><visual_scene id="s"><node><instance_node url="#n0"/></node>'
                   '</visual_scene></library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>')


def ply_polygon(r, folder):
    """One polygon with up to 200,000 corners: a comb, a spiral, a star or noise."""
    from math import cos, sin
    corners, vertices = r.randint(100_000, 200_000), r.choice([500, 20_000, 60_000])
    make = r.choice([lambda k: (32_000 * k / vertices, 30_000 * (k % 2)),
                     lambda k: (k / 2 * cos(k / 9), k / 2 * sin(k / 9)),
                     lambda k: ((1 + k % 2) * 15_000 * cos(6.2831 * k / vertices), (1 + k % 2) * 15_000 * sin(6.2831 * k / vertices)),
                     lambda k: (r.uniform(-32_000, 32_000), r.uniform(-32_000, 32_000))])
    points = [make(k) for k in range(vertices)]
    order = [r.randrange(vertices) for _ in range(corners)] if r.random() < 0.3 else [k % vertices for k in range(corners)]
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty short x\nproperty short y\nproperty short z\n"
            "element face 1\nproperty list uint ushort vertex_indices\nend_header\n")
    return written(folder, "bomb.ply", head.encode() + b"".join(struct.pack("<3h", int(x), int(y), 0) for x, y in points)
                   + struct.pack(f"<I{corners}H", corners, *order))


def ply_web(r, folder):
    """Many triangles between few vertices, in binary or text."""
    vertices, count = r.randint(50, 250), r.randint(100_000, 230_000)
    text = r.random() < 0.3
    head = (f"ply\nformat {'ascii' if text else 'binary_little_endian'} 1.0\nelement vertex {vertices}\nproperty float x\n"
            f"property float y\nproperty float z\nelement face {count // 3 if text else count}\n"
            "property list uchar uchar vertex_indices\nend_header\n")
    points = [[r.random() for _ in range(3)] for _ in range(vertices)]
    faces = [[r.randrange(vertices) for _ in range(3)] for _ in range(count // 3 if text else count)]
    if text:
        return written(folder, "bomb.ply", head + "".join("{:.4f} {:.4f} {:.4f}\n".format(*p) for p in points)
                       + "".join("3 {} {} {}\n".format(*f) for f in faces))
    return written(folder, "bomb.ply", head.encode() + b"".join(struct.pack("<3f", *p) for p in points)
                   + b"".join(bytes([3, *f]) for f in faces))


def obj_groups(r, folder):
    """25,000 groups of one triangle each, all at the same position."""
    count = 25_000
    lines = ["mtllib m.mtl\n", OBJ_TRIANGLE, "vn 0 0 1\n"]
    (folder / "m.mtl").write_text("".join(f"newmtl m{k}\nKd 1 {k / 20} 1\n" for k in range(20)))
    change = r.choice([0, 1, 20])
    for k in range(count):
        lines.append(f"g g{k}\n" + (f"usemtl m{k % change}\n" if change else "") + "f 1/1/1 2/2/1 3/3/1\n")
    return written(folder, "bomb.obj", "".join(lines))


def obj_numbers(r, folder):
    """Unused vertices, and numbers that are slow to parse."""
    word = r.choice(["v 1e-300 1e-300 1e300\n", "v 0." + "1" * 300 + " 1 1\n", "vn 0 0 1\n", "vt 0 0\n", "p 1\n", "v 1 1 1\n"])
    return written(folder, "bomb.obj", OBJ_TRIANGLE + "f 1 2 3\n" + word * (900_000 // len(word)))


def collada_polygon(r, folder):
    """A polygon with very many corners, or very many equal triangles."""
    corners = r.randint(50_000, 150_000)
    equal = r.random() < 0.5
    counts = " ".join(["3"] * (corners // 3)) if equal else str(corners)
    order = "0 1 2 " * (corners // 3) if equal else " ".join(str(r.randrange(500)) for _ in range(corners))
    points = " ".join(f"{r.random():.3f}" for _ in range(1500))
    return written(folder, "bomb.dae", '<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
                   f'<asset/><library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="1500">{points}</float_array>'
                   '<technique_common><accessor source="#a" count="500" stride="3"><param name="X" type="float"/><param name="Y" '
                   'type="float"/><param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input '
                   f'semantic="POSITION" source="#p"/></vertices><polylist count="{corners // 3 if equal else 1}"><input semantic="VERTEX" '
                   f'source="#v" offset="0"/><vcount>{counts}</vcount><p>{order}</p></polylist></mesh></geometry></library_geometries>'
                   '<library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"/></node></visual_scene>'
                   '</library_visual_scenes><scene><instance_visual_scene url="#s"/></scene></COLLADA>')
