"""Normal maps shown with the frames of Cotan, by nodes: rendered, read back and compared with a formula.

The low mesh is a barrel of a few triangles with sheared uv, one half mirrored and with a material of its own. The high
one is the same barrel with bumps: distance from the axis R(z) + h(angle, z). Two objects are rendered: the low mesh,
and a mirrored, rotated and smaller one with the same maps."""

import os

import bpy
import facts
import numpy as np
from cotan_blender import frames, gltf, meshes, nodes
from facts import baked, degrees, error_of, exported, make_mesh, material_with_nodes, parts_of, select, settings
from facts import square
from mathutils import Euler, Matrix

SIZE = 480
EEVEE = "BLENDER_EEVEE_NEXT" if (4, 2, 0) <= bpy.app.version < (5, 0, 0) else "BLENDER_EEVEE"
TURNED = facts.moved(1.1) @ Euler((0.2, 0.3, 0.4)).to_matrix().to_4x4() @ Matrix.Diagonal((-0.8, 0.8, 0.8, 1))


def _gradient(p):
    """The value and the gradient of distance - R(z) - h(angle, z), 0 on the high surface: outwards."""
    x, y, z = np.moveaxis(p, -1, 0)
    distance, angle = np.hypot(x, y), np.arctan2(x, -y)
    h, by_angle, by_z = (0.02 * f for f in (np.sin(12 * angle) * np.cos(9 * z), 12 * np.cos(12 * angle) * np.cos(9 * z),
                                            -9 * np.sin(12 * angle) * np.sin(9 * z)))  # fmt: skip
    across = np.stack([-y, x, 0 * x], -1) / distance[..., None]  # in which the angle grows
    slope = np.stack([x / distance, y / distance, 0 * x], -1) - across * (by_angle / distance)[..., None]
    slope[..., 2] = 0.6 * z - by_z
    return distance - (1 - 0.3 * z * z) - h, slope


def _truth(place, normal):
    """Normals of the high surface where the line from a point of the low one along its normal meets it."""
    along = np.zeros(len(place))
    for _ in range(12):
        value, slope = _gradient(place + along[:, None] * normal)
        along -= value / (slope * normal).sum(-1)
    slope = _gradient(place + along[:, None] * normal)[1]
    return slope / np.linalg.norm(slope, axis=-1, keepdims=True)


def _barrel(name, columns, rows, bumps=False):
    """Half a barrel around z, seen from -y. uv: the halves beside each other, mirrored, both sheared."""
    angle, z = (a.ravel() for a in np.meshgrid(np.linspace(-1, 1, columns + 1), np.linspace(-1, 1, rows + 1)))
    h = 0.02 * np.sin(12 * angle) * np.cos(9 * z) if bumps else 0
    distance = 1 - 0.3 * z * z + h
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    if bumps:
        faces = np.stack([first, first + 1, first + columns + 2, first + columns + 1], -1)
    else:
        faces = np.concatenate([[(f, f + 1, f + columns + 2), (f, f + columns + 2, f + columns + 1)] for f in first])
    made = make_mesh(name, np.stack([distance * np.sin(angle), -distance * np.cos(angle), z], -1), faces)
    if not bumps:
        layer = made.data.uv_layers.new(name="UVMap")
        for polygon in made.data.polygons:
            right = angle[list(polygon.vertices)].mean() > 0
            polygon.material_index = int(right)
            for loop in polygon.loop_indices:
                vertex = made.data.loops[loop].vertex_index
                u = 0.14 + 0.2 * (1 - abs(angle[vertex])) + 0.12 * z[vertex]
                layer.data[loop].uv = (1 - u if right else u, 0.5 + 0.48 * z[vertex])
    return made


def _scene(frame, **wanted):
    """The low mesh with two materials, whose maps are baked for this frame, and its mirrored copy."""
    low, high = _barrel("low", 10, 6), _barrel("high", 400, 400, bumps=True)
    for name in ("left", "right"):
        low.data.materials.append(material_with_nodes(name))
    settings(frame=frame, width=512, height=512, bits="16", padding=16, each_material=True, distance=0.2, **wanted)
    select(high, low)
    assert bpy.ops.object.cotan_bake() == {"FINISHED"}
    bpy.data.objects.remove(high)
    other = bpy.data.objects.new("other", low.data)
    low.matrix_world, other.matrix_world = Matrix.Translation((-1, 0, 0)), TURNED
    bpy.context.collection.objects.link(other)
    scene = bpy.context.scene
    scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(scene.camera)
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 4
    scene.camera.matrix_world = Matrix.Translation((0, -5, 0)) @ Euler((np.pi / 2, 0, 0)).to_matrix().to_4x4()
    return low, other


def _rendered(engine, source, reach=1):
    """Renders every material as an emission of a vector: (SIZE / 2, SIZE, 3), and where there is a surface. source:
    gives the socket of a material's node tree. reach: the largest component. Eevee stores light in 16 bits: 0.03
    degrees."""
    scene, outputs = bpy.context.scene, []
    scene.render.engine = engine
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = SIZE, SIZE // 2, 100
    scene.render.film_transparent, scene.render.filter_size, scene.render.use_compositing = True, 0.01, False
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.pixel_filter_type = 1, False, "BOX"
    scene.cycles.filter_width = 0.01
    scene.eevee.taa_render_samples = 1
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    for material in [m for m in bpy.data.materials if m.users]:
        tree = material.node_tree
        half, light = tree.nodes.new("ShaderNodeVectorMath"), tree.nodes.new("ShaderNodeEmission")
        half.operation = "MULTIPLY_ADD"  # light cannot be negative
        half.inputs[1].default_value, half.inputs[2].default_value = (0.5 / reach,) * 3, (0.5,) * 3
        tree.links.new(source(material), half.inputs[0])
        tree.links.new(half.outputs[0], light.inputs["Color"])
        out = next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL")
        outputs.append((tree, out.inputs["Surface"], out.inputs["Surface"].links[0].from_socket, (half, light)))
        tree.links.new(light.outputs[0], out.inputs["Surface"])
    scene.render.filepath = os.path.join(facts.FOLDER, "seen.exr")
    bpy.ops.render.render(write_still=True)
    for tree, surface, before, made in outputs:
        tree.links.new(before, surface)
        for node in made:
            tree.nodes.remove(node)
    image = bpy.data.images.load(scene.render.filepath)
    values = np.empty(SIZE * (SIZE // 2) * 4, np.float32)
    image.pixels.foreach_get(values)
    bpy.data.images.remove(image)
    values = values.reshape(SIZE // 2, SIZE, 4).astype(float)
    return (values[..., :3] * 2 - 1) * reach, values[..., 3] > 0.99


def _of_surface(name):
    """For _rendered: an output of the Geometry node."""

    def socket(material):
        tree = material.node_tree
        node = tree.nodes.get("seen") or tree.nodes.new("ShaderNodeNewGeometry")
        node.name = "seen"
        return node.outputs[name]

    return socket


def _of_normal(material):
    """For _rendered: the normal that the material is lit with."""
    return nodes.principled(material).inputs["Normal"].links[0].from_socket


def _wanted(low, other):
    """Normals of the high surface at the pixels, in the world, and the pixels that are far enough from the rims."""
    place, there = _rendered("CYCLES", _of_surface("Position"), 4)
    normal, _ = _rendered("CYCLES", _of_surface("Normal"))
    wanted, inside = np.ones_like(place), np.zeros_like(there)
    for thing in (low, other):
        on = there & ((place[..., 0] < 0) == (thing == low))
        matrix = np.array(thing.matrix_world)
        turn = matrix[:3, :3]
        own = (place[on] - matrix[:3, 3]) @ np.linalg.inv(turn).T
        direction = normal[on] @ turn
        truth = _truth(own, direction / np.linalg.norm(direction, axis=-1, keepdims=True)) @ np.linalg.inv(turn)
        wanted[on] = truth / np.linalg.norm(truth, axis=-1, keepdims=True)
        # Not beside the rims, nor on the seam of the halves, where a texel belongs to both.
        angle = np.abs(np.arctan2(own[:, 0], -own[:, 1]))
        inside[on] = (angle < 0.8) & (angle > 0.02) & (np.abs(own[:, 2]) < 0.85)
    return wanted, inside


def _measured(words, off):
    mean, high = off.mean(), np.percentile(off, 99)
    print(f"measured: {words}: mean {mean:.3f}, 99 % {high:.2f} degrees", flush=True)
    return mean


def _shown(engine, inside):
    found, there = _rendered(engine, _of_normal)
    assert there[inside].all()
    return found[inside]


def theFrameOfEachMapIsShownByCyclesAndEevee():
    for frame in ("mikktspace", *frames.SHOWN):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        low, other = _scene(frame)
        wanted, inside = _wanted(low, other)
        assert inside.sum() > 20000
        means, own = {}, {}
        for node in ("Blender", "Cotan"):
            if node == "Cotan":
                select(low)
                assert bpy.ops.object.cotan_frame() == {"FINISHED"}
                used = [nodes.frame_group(material).node_tree["cotan_frame"] for material in low.data.materials]
                assert used == 2 * [frame.replace("mikktspace", "orthonormal")], used
            for name, engine in (("Cycles", "CYCLES"), ("Eevee", EEVEE)):
                words = f"{name}, a map for {frame}, {node}'s node"
                found = _shown(engine, inside)
                means[name, node] = _measured(words, degrees(found, wanted[inside]))
                if node == "Blender":
                    own[name] = found
                elif frame == "mikktspace":
                    _measured(f"{words}, from Blender's own", degrees(found, own[name]))
        # The filter of a map of 512 x 512, also across edges where frames differ; in Eevee also 16 bits and mipmaps.
        for name, least in (("Cycles", 0.06), ("Eevee", 0.15)):
            theirs, ours = means[name, "Blender"], means[name, "Cotan"]
            if frame == "mikktspace":
                assert theirs < least and ours < theirs + 0.15, (name, means)
            else:
                assert ours < least, (name, means)
                assert theirs > 5 or (frame == "orthonormal" and theirs > ours), (name, means)


def _corners_of(thing):
    """Positions, uv, and the stored directions of each corner of an object's triangles, as it is evaluated."""
    depsgraph = bpy.context.evaluated_depsgraph_get()
    with meshes.mesh_of(thing.evaluated_get(depsgraph), depsgraph, layers=True) as mesh:
        corner = meshes.got(mesh.loops, "vertex_index", dtype=np.int32)
        stored = [meshes.got(mesh.attributes[name].data, "vector", 3) for name in ("cotan_u", "cotan_v")]
        return meshes.got(mesh.vertices, "co", 3)[corner], meshes.got(mesh.uv_layers[0].data, "uv", 2), *stored


def directionsAreThoseOfEachTriangle():
    chance = np.random.default_rng(7)
    vertices, uv = chance.normal(size=(90, 3)), chance.normal(size=(90, 2))
    uv[3:6] = uv[3]  # no area
    uv[6:9] = [(0, 0), (1, 2), (2, 4)]
    thing = make_mesh("low", vertices, np.arange(90).reshape(-1, 3), uv)
    thing.modifiers.new("frame", "NODES").node_group = frames.directions_of("UVMap")
    place, uv, along_u, along_v = (a.astype(float).reshape(30, 3, -1) for a in _corners_of(thing))
    for k in range(30):
        if k in (1, 2):
            assert not along_u[k].any() and not along_v[k].any(), k
            continue
        # The linear map of uv to the triangle: its columns are dP/du and dP/dv.
        wanted = np.linalg.solve(uv[k][1:] - uv[k][0], place[k][1:] - place[k][0])
        wanted /= np.linalg.norm(wanted, axis=-1).max()
        assert np.abs(along_u[k] - wanted[0]).max() < 1e-4 and np.abs(along_v[k] - wanted[1]).max() < 1e-4, k


def _one_square(texel, **changes):
    """A square whose material reads one colour as its normal map, shown with the frame of Cotan, and a camera above."""
    low = square(**changes)
    low.data.materials.append(material_with_nodes("plain"))
    image = bpy.data.images.new("map", 4, 4, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(np.tile(np.float32([*texel, 1]), 16))
    nodes.assign(low.data.materials[0], image, "")
    scene = bpy.context.scene
    scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(scene.camera)
    scene.camera.location = (0, 0, 3)
    select(low)
    assert bpy.ops.object.cotan_frame() == {"FINISHED"}
    return low


def _in_the_middle(engine):
    return _rendered(engine, _of_normal)[0][SIZE // 4, SIZE // 2]


def slopesLeanTheWayOfTheMap():
    for engine in ("CYCLES", EEVEE):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        low = _one_square((0.9, 0.7, 0.9))
        group, camera = nodes.frame_group(low.data.materials[0]), bpy.context.scene.camera
        way = np.array((0.8, 0.4, 0.8))
        assert degrees(_in_the_middle(engine), way) < 0.1
        group.inputs["Green"].default_value, group.inputs["Strength"].default_value = -1, 0.5  # as in Blender's node
        assert degrees(_in_the_middle(engine), (0.4, -0.2, 0.9)) < 0.1
        group.inputs["Green"].default_value, group.inputs["Strength"].default_value = 1, 1
        # From behind, the normal points to the viewer, and bumps are dents.
        camera.location, camera.rotation_euler = (0, 0, -3), (np.pi, 0, 0)
        assert degrees(_in_the_middle(engine), -way) < 0.1
        camera.location, camera.rotation_euler = (0, 0, 3), (0, 0, 0)
        # Without the modifier, Blender's own node is seen; without that, the surface.
        low.modifiers.clear()
        tree = low.data.materials[0].node_tree
        assert degrees(_in_the_middle(engine), way) < 0.1
        tree.links.remove(group.inputs["Normal"].links[0])
        assert degrees(_in_the_middle(engine), (0, 0, 1)) < 0.1


def stretchedUvAreFollowedAsTheFrameSays():
    for frame in frames.SHOWN:
        for across, along in ((1, 0.25), (0.25, 1)):
            bpy.ops.wm.read_factory_settings(use_empty=True)
            low = _one_square((0.9, 0.7, 0.9), matrix=Matrix.Scale(3, 4))
            for loop in low.data.uv_layers[0].data:
                loop.uv = (across * loop.uv[0], along * loop.uv[1])
            nodes.frame_group(low.data.materials[0]).node_tree = frames.group_of(frame)
            wanted = (0.8, 0.4, 0.8) if frame == "orthonormal" else (0.8 * across, 0.4 * along, 0.8)
            found = _in_the_middle("CYCLES")
            assert degrees(found, wanted) < 0.1, (frame, across, found)


def theModifierChangesNothingElse():
    low = _one_square((0.5, 0.5, 1))
    facts.set_custom_normals(low, (0.6, 0, 0.8))
    for name in ("with", "without"):
        if name == "without":
            low.modifiers.clear()
        found = _rendered("CYCLES", _of_surface("Normal"))[0][SIZE // 4, SIZE // 2]
        assert degrees(found, (0.6, 0, 0.8)) < 0.1, name


def aSecondBakeIsShownWithItsFrame():
    low, high = square(), facts.ball()
    baked(low, high, distance=2, frame="orthonormal")
    select(low)
    assert bpy.ops.object.cotan_frame() == {"FINISHED"}
    material = low.data.materials[0]
    assert nodes.frame_group(material).node_tree.name == "Cotan Normal Map" and len(low.modifiers) == 1
    baked(low, high, distance=2, frame="cotangent")
    group = nodes.frame_group(material)
    assert group.node_tree["cotan_frame"] == "cotangent"
    assert group.inputs["Color"].links[0].from_node.image.name == "low_normal"
    baked(low, high, distance=2, frame="smooth")  # nodes cannot have it
    assert nodes.frame_group(material) is None and nodes.map_of(material)[1].image["cotan_frame"] == "smooth"
    text = error_of(bpy.ops.object.cotan_frame)
    assert text == "'low_normal' was baked for smooth: nodes can have orthonormal, cotangent or triangle", text


def blendersNodeComesBack():
    low = _one_square((0.9, 0.7, 0.9))
    material, before = low.data.materials[0], len(bpy.data.node_groups)
    other = square("other")
    other.data.materials.append(material)
    select(low)
    assert bpy.ops.object.cotan_frame() == {"FINISHED"} and len(bpy.data.node_groups) == before
    assert [len(thing.modifiers) for thing in (low, other)] == [1, 1], "all meshes with the material"
    nodes.frame_group(material).inputs["Strength"].default_value = 0.25
    assert bpy.ops.object.cotan_frame(which="BLENDER") == {"FINISHED"}
    assert [len(thing.modifiers) for thing in (low, other)] == [0, 0]
    reader, texture = nodes.map_of(material)
    assert _of_normal(material).node == reader and texture.image.name == "map"
    assert reader.inputs["Strength"].default_value == 0.25
    text = error_of(bpy.ops.object.cotan_frame, which="BLENDER")
    assert text == "No selected mesh has a material that is shown with a frame of Cotan", text
    select(facts.ball("bare"))
    text = error_of(bpy.ops.object.cotan_frame)
    assert text == "No selected mesh has a material whose Normal Map node reads an image", text


def theExportIsTheSame():
    low = _one_square((0.9, 0.7, 0.9))
    material = low.data.materials[0]
    image = nodes.map_of(material)[1].image
    image.pack()
    nodes.frame_group(material).inputs["Strength"].default_value = 0.5
    models = [gltf.exported(bpy.context, [low])]
    group, reader = nodes.frame_group(material), nodes.map_of(material)[0]
    assert group is not None and _of_normal(material).node == group and reader.inputs["Strength"].default_value == 1
    own = parts_of(exported("own", low))[0]["materials"][0]
    assert "normalTexture" in own, "Blender's own exporter finds the map, too"
    assert bpy.ops.object.cotan_frame(which="BLENDER") == {"FINISHED"}
    models.append(gltf.exported(bpy.context, [low]))
    found = []
    for model in models:
        path = os.path.join(facts.FOLDER, "seen.glb")
        with open(path, "wb") as file:
            file.write(model)
        found.append(parts_of(path))
    assert found[0] == found[1] and found[0][0]["materials"][0]["normalTexture"]["scale"] == 0.5


def _error_of_frame(thing):
    select(thing)
    return error_of(bpy.ops.object.cotan_frame)


def whatComesFromALibraryStays():
    low = _one_square((0.9, 0.7, 0.9))
    assert bpy.ops.object.cotan_frame(which="BLENDER") == {"FINISHED"}
    nodes.map_of(low.data.materials[0])[1].image.pack()
    path = os.path.join(facts.FOLDER, "theirs.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, to):
        to.objects = ["low"]
    theirs = bpy.data.objects["low"]
    bpy.context.collection.objects.link(theirs)
    text = _error_of_frame(theirs)
    assert text == "The material 'plain' comes from a library file: make it local first", text
    own = square("own")
    own.data.materials.append(bpy.data.materials["plain"].copy())
    assert _error_of_frame(own) == "" and nodes.frame_group(own.data.materials[0]) is not None
    assert len(own.modifiers) == 1 and len(theirs.modifiers) == 0


def twoUvMapsAreNamed():
    low = _one_square((0.9, 0.7, 0.9))
    layer = low.data.uv_layers.new(name="second")
    layer.data.foreach_set("uv", np.float32([(0, 0), (0, 1), (1, 1), (1, 0)]).ravel())
    material = low.data.materials[0].copy()
    low.data.materials.append(material)
    nodes.map_of(material)[0].uv_map = "second"
    _, said = frames.use_cotans(bpy.context, [low])
    assert said == ["'low' reads normal maps with 2 uv maps: only those with 'UVMap' are right"], said
    nodes.map_of(low.data.materials[0])[0].uv_map = "second"
    assert frames.use_cotans(bpy.context, [low])[1] == [] and low.modifiers[0].node_group["cotan_uv"] == "second"
    while low.data.uv_layers:
        low.data.uv_layers.remove(low.data.uv_layers[0])
    assert frames.use_cotans(bpy.context, [low])[1] == ["'low' has no uv map: it is shown with Blender's own node"]


facts.hold_all(__name__)
