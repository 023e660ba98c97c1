"""Shows normal maps with the frames of Cotan, in viewport and renders, by nodes that every Blender has: a modifier
stores for each face corner the directions in which u and v grow, and a node group in the materials makes the frame."""

import bpy

from . import nodes
from .refused import Refused

SHOWN = ("orthonormal", "cotangent", "triangle")  # frames that the node group can have
GROUP = "Cotan Normal Map"
MODIFIER = "Cotan Frame"
_VERSION = 1  # of the trees: those of other versions are not used again


class _Tree:
    """A new node tree that is filled by calls. Operands are sockets, numbers, or tuples of three numbers."""

    def __init__(self, name, kind, inputs, outputs):
        """inputs, outputs: (name, type of socket, default value or None)."""
        self.tree = bpy.data.node_groups.new(name, kind)
        self.tree["cotan_version"] = _VERSION
        for each, in_out, sockets in ((inputs, "INPUT", "inputs"), (outputs, "OUTPUT", "outputs")):
            for label, socket, value in each:
                if hasattr(self.tree, "interface"):  # since Blender 4.0
                    made = self.tree.interface.new_socket(label, in_out=in_out, socket_type=socket)
                else:
                    made = getattr(self.tree, sockets).new(socket, label)
                if value is not None:
                    made.default_value = value
        self.given = self.node("NodeGroupInput")

    def node(self, kind, operands=(), **properties):
        """A node. operands: of its inputs, by name or by number."""
        made = self.tree.nodes.new(kind)
        made.location = (160 * (len(self.tree.nodes) // 6), -180 * (len(self.tree.nodes) % 6))
        for name, value in properties.items():
            setattr(made, name, value)
        for key, operand in dict(operands).items():
            socket = made.inputs[key] if isinstance(key, int) else _enabled(made.inputs, key)
            if isinstance(operand, bpy.types.NodeSocket):
                self.tree.links.new(operand, socket)
            else:
                socket.default_value = operand
        return made

    def vector(self, operation, *operands):
        operands = dict(enumerate(operands))
        if operation == "SCALE":
            operands[3] = operands.pop(1)
        made = self.node("ShaderNodeVectorMath", operands, operation=operation)
        return made.outputs["Value" if operation in ("DOT_PRODUCT", "LENGTH") else "Vector"]

    def number(self, operation, *operands):
        return self.node("ShaderNodeMath", enumerate(operands), operation=operation).outputs[0]

    def parts(self, vector):
        return self.node("ShaderNodeSeparateXYZ", {0: vector}).outputs


def _enabled(sockets, name):
    """The socket of this name that is shown: before Blender 4.1 there is one for each type of data."""
    return next(socket for socket in sockets if socket.name == name and socket.enabled)


def _kept(trees, **properties):
    """The tree of this version with these properties, if the file has it."""
    wanted = {"cotan_version": _VERSION, **properties}
    return next((t for t in trees if t.library is None and all(t.get(k) == v for k, v in wanted.items())), None)


def directions_of(uv_map):
    """A geometry node tree that stores, at each face corner, the directions in which u and v of the uv map grow, as
    attributes cotan_u and cotan_v: the longer has length 1, both are 0 where uv have no area. cotan_frame is 1
    everywhere. A triangle has the same at its three corners, and nothing else of the mesh changes."""
    kept = _kept(bpy.data.node_groups, cotan_uv=uv_map)
    if kept is not None:
        return kept
    geometry = [("Geometry", "NodeSocketGeometry", None)]
    make = _Tree(f"{MODIFIER} {uv_map}"[:50], "GeometryNodeTree", geometry, geometry)
    make.tree["cotan_uv"] = uv_map
    place = make.node("GeometryNodeInputPosition").outputs[0]
    read = make.node("GeometryNodeInputNamedAttribute", {"Name": uv_map}, data_type="FLOAT_VECTOR")

    def towards(offset):
        """Edge and difference of uv from each corner to another of its face."""
        other = make.node("GeometryNodeOffsetCornerInFace", {"Offset": offset}).outputs[0]
        found = []
        for field in (place, _enabled(read.outputs, "Attribute")):
            at = make.node("GeometryNodeFieldAtIndex", data_type="FLOAT_VECTOR", domain="CORNER")
            make.tree.links.new(other, at.inputs["Index"])
            make.tree.links.new(field, _enabled(at.inputs, "Value"))
            found.append(make.vector("SUBTRACT", _enabled(at.outputs, "Value"), field))
        return found

    (e1, d1), (e2, d2) = towards(1), towards(-1)
    (u1, v1, _), (u2, v2, _) = make.parts(d1), make.parts(d2)
    area = make.number("SUBTRACT", make.number("MULTIPLY", u1, v2), make.number("MULTIPLY", u2, v1))
    along_u = make.vector("SUBTRACT", make.vector("SCALE", e1, v2), make.vector("SCALE", e2, v1))
    along_v = make.vector("SUBTRACT", make.vector("SCALE", e2, u1), make.vector("SCALE", e1, u2))
    longest = make.number("MAXIMUM", make.vector("LENGTH", along_u), make.vector("LENGTH", along_v))
    scale = make.number("DIVIDE", make.number("SIGN", area), longest)  # 0 for 0 / 0
    mesh = make.given.outputs[0]
    for name, kind, value in (
        ("cotan_u", "FLOAT_VECTOR", make.vector("SCALE", along_u, scale)),
        ("cotan_v", "FLOAT_VECTOR", make.vector("SCALE", along_v, scale)),
        ("cotan_frame", "FLOAT", 1.0),
    ):
        domain = "CORNER" if kind == "FLOAT_VECTOR" else "POINT"
        store = make.node("GeometryNodeStoreNamedAttribute", data_type=kind, domain=domain)
        make.tree.links.new(mesh, store.inputs["Geometry"])
        _enabled(store.inputs, "Name").default_value = name
        if kind == "FLOAT":
            _enabled(store.inputs, "Value").default_value = value
        else:
            make.tree.links.new(value, _enabled(store.inputs, "Value"))
        mesh = store.outputs["Geometry"]
    make.node("NodeGroupOutput", {0: mesh})
    return make.tree


def group_of(frame):
    """A shader node group that reads a normal map with a frame of SHOWN (docs/reference/conventions.md). Its inputs:
    Color, the texel; Strength, as in Blender's Normal Map node; Green, 1 up or -1 down; Normal, for meshes without the
    modifier."""
    kept = _kept(bpy.data.node_groups, cotan_frame=frame)
    if kept is not None:
        return kept
    number, vector = "NodeSocketFloat", "NodeSocketVector"
    inputs = [
        ("Color", "NodeSocketColor", (0.5, 0.5, 1, 1)),
        ("Strength", number, 1),
        ("Green", number, 1),
        ("Normal", vector, None),
    ]
    name = GROUP if frame == SHOWN[0] else f"{GROUP}, {frame}"
    make = _Tree(name, "ShaderNodeTree", inputs, [("Normal", vector, None)])
    make.tree["cotan_frame"] = frame
    color, strength, green, otherwise = list(make.given.outputs)[:4]

    def world(name):
        read = make.node("ShaderNodeAttribute", attribute_name=name).outputs["Vector"]
        spaces = {"vector_type": "VECTOR", "convert_from": "OBJECT", "convert_to": "WORLD"}
        return make.node("ShaderNodeVectorTransform", {0: read}, **spaces).outputs[0]

    # n points outwards; Blender's points to the viewer.
    seen = make.node("ShaderNodeNewGeometry")
    side = make.number("MULTIPLY_ADD", seen.outputs["Backfacing"], -2.0, 1.0)
    n = make.vector("SCALE", seen.outputs["Normal"], side)
    along_u, along_v = world("cotan_u"), world("cotan_v")
    area = make.vector("CROSS_PRODUCT", along_u, along_v)
    handed = make.number("SIGN", make.vector("DOT_PRODUCT", n, area))  # -1: mirrored, 0: no frame
    if frame == "orthonormal":
        outwards = make.vector("SCALE", n, make.vector("DOT_PRODUCT", n, along_u))
        t = make.vector("NORMALIZE", make.vector("SUBTRACT", along_u, outwards))
        t = make.vector("SCALE", t, make.number("ABSOLUTE", handed))
        b = make.vector("SCALE", make.vector("CROSS_PRODUCT", n, t), handed)
    else:
        t, b = make.vector("CROSS_PRODUCT", along_v, n), make.vector("CROSS_PRODUCT", n, along_u)
        sized = (along_u, along_v) if frame == "triangle" else (t, b)
        longest = make.number("MAXIMUM", *(make.vector("LENGTH", each) for each in sized))
        scale = make.number("DIVIDE", handed, longest)  # 0 for 0 / 0
        t, b = make.vector("SCALE", t, scale), make.vector("SCALE", b, scale)
    x, y, z = make.parts(make.vector("MULTIPLY_ADD", color, (2, 2, 2), (-1, -1, -1)))
    flat = make.number("MINIMUM", make.number("MAXIMUM", strength, 0.0), 1.0)
    z = make.number("MULTIPLY_ADD", make.number("SUBTRACT", z, 1.0), flat, 1.0)
    x = make.number("MULTIPLY", x, strength)
    y = make.number("MULTIPLY", make.number("MULTIPLY", y, strength), green)
    tilted = make.vector("ADD", make.vector("SCALE", t, x), make.vector("SCALE", b, y))
    turned = make.vector("SCALE", make.vector("ADD", tilted, make.vector("SCALE", n, z)), side)
    # Without the modifier: the normal that is given, else the surface's own.
    there = make.node("ShaderNodeAttribute", attribute_name="cotan_frame").outputs["Fac"]
    other = make.vector("MULTIPLY_ADD", seen.outputs["Normal"], (1e-6, 1e-6, 1e-6), otherwise)
    mixed = make.vector("ADD", other, make.vector("SCALE", make.vector("SUBTRACT", turned, other), there))
    make.node("NodeGroupOutput", {0: make.vector("NORMALIZE", mixed)})
    return make.tree


def _frame_for(image):
    """The frame that shows an image: the one that it was baked for, or the one that reads maps for MikkTSpace."""
    made_for = image.get("cotan_frame", "mikktspace")
    return SHOWN[0] if made_for == "mikktspace" else made_for


def _insert(material, reader, texture):
    """Puts the group between the Normal Map node and what it is linked to."""
    tree, group = material.node_tree, nodes.frame_group(material)
    if group is None:
        group = tree.nodes.new("ShaderNodeGroup")
        group.location = (reader.location.x, reader.location.y + 200)
        group.node_tree = group_of(_frame_for(texture.image))
        tree.links.new(texture.outputs["Color"], group.inputs["Color"])
        tree.links.new(reader.outputs["Normal"], group.inputs["Normal"])
        strength = reader.inputs["Strength"]
        group.inputs["Strength"].default_value = strength.default_value
        if strength.is_linked:
            tree.links.new(strength.links[0].from_socket, group.inputs["Strength"])
        nodes.link_normal(material, group)
    _follow(material)


def _follow(material):
    """Gives the material's group the frame and the green of its map. Returns sentences."""
    group, (reader, texture) = nodes.frame_group(material), nodes.map_of(material)
    if group is None or texture is None or texture.image is None or material.library is not None:
        return []
    frame = _frame_for(texture.image)
    if frame not in SHOWN:
        _take_out(material)
        return [f"'{material.name}' is shown with Blender's own node: nodes cannot have the frame {frame}"]
    group.node_tree = group_of(frame)
    group.label = group.node_tree.name
    group.inputs["Green"].default_value = -1.0 if nodes.reads_green_down(reader) else 1.0
    return []


def follow(image):
    """The same for all materials that read the image, after it was baked again. Returns sentences."""
    said = []
    for material in bpy.data.materials:
        texture = nodes.map_of(material)[1]
        if texture is not None and texture.image == image:
            said += _follow(material)
    return said


def _take_out(material):
    """Links the Normal Map node again, with the strength of the group, and removes the group."""
    group, reader = nodes.frame_group(material), nodes.map_of(material)[0]
    if reader is not None:
        reader.inputs["Strength"].default_value = group.inputs["Strength"].default_value
        nodes.link_normal(material, reader)
    material.node_tree.nodes.remove(group)


def _users(context, things, materials):
    """These objects, and all others of the scene that show one of the materials."""
    meshes = [o for o in context.scene.objects if o.type == "MESH"]
    return [o for o in meshes if o in things or any(slot.material in materials for slot in o.material_slots)]


def _is_ours(modifier):
    return modifier.type == "NODES" and modifier.node_group is not None and "cotan_uv" in modifier.node_group


def _store_directions(thing):
    """Adds the modifier to an object, or brings it up to date. Returns sentences."""
    shown = [slot.material for slot in thing.material_slots if nodes.frame_group(slot.material) is not None]
    readers = [reader for reader, _ in map(nodes.map_of, shown) if reader is not None]
    uv_maps = list(dict.fromkeys(nodes.uv_name(thing, reader) for reader in readers))
    if not uv_maps:
        return []
    if thing.library is not None or uv_maps == [""]:
        why = "comes from a library file" if thing.library is not None else "has no uv map"
        return [f"'{thing.name}' {why}: it is shown with Blender's own node"]
    modifier = next(filter(_is_ours, thing.modifiers), None)
    if modifier is None:
        modifier = thing.modifiers.new(MODIFIER, "NODES")
    modifier.node_group, modifier.show_expanded = directions_of(uv_maps[0]), False
    if len(uv_maps) == 1:
        return []
    return [f"'{thing.name}' reads normal maps with {len(uv_maps)} uv maps: only those with '{uv_maps[0]}' are right"]


def use_cotans(context, things):
    """Shows the normal maps of these objects with the frames that they were baked for, orthonormal for MikkTSpace.
    Returns the materials, and sentences. Raises Refused if there is none that can be shown so."""
    found, said = [], []
    for material in dict.fromkeys(slot.material for thing in things for slot in thing.material_slots):
        reader, texture = nodes.map_of(material)
        if texture is None or texture.image is None:
            continue
        name, frame = texture.image.name, _frame_for(texture.image)
        if material.library is not None:
            said.append(f"The material '{material.name}' comes from a library file: make it local first")
        elif frame not in SHOWN:
            said.append(f"'{name}' was baked for {frame}: nodes can have {', '.join(SHOWN[:-1])} or {SHOWN[-1]}")
        else:
            _insert(material, reader, texture)
            found.append(material)
    if not found:
        raise Refused(said[0] if said else "No selected mesh has a material whose Normal Map node reads an image")
    for thing in _users(context, things, found):
        said += _store_directions(thing)
    return found, said


def use_blenders(context, things):
    """Undoes use_cotans. Returns the materials, and no sentences. Raises Refused if none is shown so."""
    materials = dict.fromkeys(slot.material for thing in things for slot in thing.material_slots)
    found = [m for m in materials if nodes.frame_group(m) is not None and m.library is None]
    if not found:
        raise Refused("No selected mesh has a material that is shown with a frame of Cotan")
    users = _users(context, things, found)
    for material in found:
        _take_out(material)
    for thing in users:
        if thing.library is None and not any(nodes.frame_group(slot.material) for slot in thing.material_slots):
            for modifier in list(filter(_is_ours, thing.modifiers)):
                thing.modifiers.remove(modifier)
    return found, []
