"""Uses of a baked map: pairs by name, the nodes that read it, the .blend and the files that store it."""

import os

import bpy
import cotan
import facts
import numpy as np
from cotan_blender import bake, images, pairs
from facts import baked, ball, directions, expect_sphere, material_with_nodes, moved, select, settings, square
from facts import texel_centres, torus


def pairsAreFoundByName():
    x, y = texel_centres()
    names = (("door_low", "door_high"), ("bolt.lo", "Bolt.HI.001"), ("Wall_low", "wall_high_a"))
    for number, (low, high) in enumerate(names):
        square(low, matrix=moved(4 * number))
        ball(high, matrix=moved(4 * number), centre=(0.1 * number, 0, 0))
    ball("wall_high_b", centre=(-0.8, 0.8, 0), radius=0.15, matrix=moved(8))
    torus("unrelated")
    settings(distance=2)
    select()
    assert bpy.ops.object.cotan_bake(which="NAMES") == {"FINISHED"}
    for number, low in enumerate(("door_low", "bolt.lo", "Wall_low")):
        found = directions(bpy.data.images[f"{low}_normal"])
        expect_sphere(found, x - 0.1 * number, y)
    expect_sphere(found, x + 0.8, y - 0.8, 0.15, least=50)
    # Blender's numbers on both sides: each copy has its own detail, and a selection changes no pair.
    for number, (rise, ending) in enumerate(((0.1, ""), (-0.1, ".001"))):
        square(f"copy_low{ending}", matrix=moved(12))
        ball(f"copy_high{ending}", matrix=moved(12), centre=(rise, 0, 0))
    select(bpy.data.objects["copy_low.001"])
    assert bpy.ops.object.cotan_bake(which="NAMES") == {"FINISHED"}
    assert "copy_low_normal" not in bpy.data.images
    expect_sphere(directions(bpy.data.images["copy_low.001_normal"]), x + 0.1, y)
    # Only selected objects count, and one without a counterpart does not stop the others.
    for image in list(bpy.data.images):
        bpy.data.images.remove(image)
    square("alone_low")
    select(bpy.data.objects["door_low"], bpy.data.objects["alone_low"])
    assert bpy.ops.object.cotan_bake(which="NAMES") == {"FINISHED"}
    assert [i.name for i in bpy.data.images] == ["door_low_normal"]
    select(bpy.data.objects["alone_low"])
    found = facts.error_of(bpy.ops.object.cotan_bake, which="NAMES")
    assert found.startswith("There is no visible object named like 'alone_low'"), found


def chosenMapsAreBakedAndOnlyNormalsAreAssigned():
    x, y = texel_centres()
    low, high = square(z=-0.5), ball()
    low.data.materials.append(material_with_nodes("worn"))
    for _ in range(2):  # a second bake replaces the images
        baked(low, high, distance=4, extrusion=2, maps={"normal", "position", "height", "bent-normal"})
    names = [f"low_{word}" for word in ("bent_normal", "height", "normal", "position")]
    assert sorted(i.name for i in bpy.data.images) == names, [i.name for i in bpy.data.images]
    reader = low.data.materials[0].node_tree.nodes["Principled BSDF"].inputs["Normal"].links[0].from_node
    assert reader.inputs["Color"].links[0].from_node.image.name == "low_normal"
    frames = {i.name: i.get("cotan_frame") for i in bpy.data.images}
    assert frames == dict(zip(names, ("mikktspace", None, "mikktspace", None))), frames

    def values(name):
        image = bpy.data.images[name]
        found = np.empty(64 * 64 * 4, np.float32)
        image.pixels.foreach_get(found)
        return found.reshape(64, 64, 4)[::-1, :, :3]

    inside = x * x + y * y < 0.9 * np.sin(np.radians(71)) ** 2
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    # The axes are Blender's, and the box is that of the ball.
    vertices = np.array([v.co for v in high.data.vertices])
    lowest, size = vertices.min(axis=0), np.ptp(vertices, axis=0)
    position = values("low_position")
    for component, truth in enumerate((x, y, z)):
        off = np.abs(position[..., component] - (truth - lowest[component]) / size[component])
        assert off[inside].max() < 0.002, component  # facets, and rounding
    height = values("low_height")[..., 0][inside]
    assert np.corrcoef(height, z[inside])[0, 1] > 0.9999
    settings(maps=set())
    assert facts.error_of(bpy.ops.object.cotan_bake, which="ACTIVE").startswith("No map is chosen")


def mapsOfTheSameTexelsAreBakedInOneCallAsEachAlone():
    # Two faces with materials of their own, both over the whole uv square: two bakes of three maps.
    outline = [(-2, -1), (0, -1), (0, 1), (-2, 1), (2, -1), (2, 1)]
    low = facts.make_mesh("low", [(x, y, 0) for x, y in outline], [(0, 1, 2, 3), (1, 4, 5, 2)], [(0, 0)] * 6)
    for polygon, name in zip(low.data.polygons, ("left", "right")):
        for loop, uv in zip(polygon.loop_indices, [(0, 0), (1, 0), (1, 1), (0, 1)]):
            low.data.uv_layers[0].data[loop].uv = uv
        low.data.materials.append(material_with_nodes(name))
        polygon.material_index = len(low.data.materials) - 1
    highs = ball("a", (-1.2, 0, -0.5), cells=32), ball("b", (1.3, 0.2, -0.5), cells=32)
    kinds, calls, own = {"normal", "ao", "position"}, [], cotan.bake_maps

    def counted(*arguments, **keywords):
        calls.append(keywords["maps"])
        return own(*arguments, **keywords)

    def images_of(*words):
        s = settings(each_material=True, distance=2, samples="1", maps=set(words))
        select(*highs, low)
        outcome = bake.Outcome()
        shares = list(bake.run(bpy.context, s, pairs.by_selection(bpy.context)[0], outcome))
        assert not outcome.failures and shares == sorted(shares) and 0 <= shares[0] and shares[-1] <= 1, shares
        assert max(shares) > 0.5, "the second bake goes on where the first one ended"
        return {image.name: images.pixels_of(image) for image in outcome.made}

    cotan.bake_maps = counted
    try:
        together = images_of(*kinds)
        assert [sorted(call) for call in calls] == [sorted(kinds)] * 2, calls
        assert sorted(together) == [f"low_{m}_{k}" for m in ("left", "right") for k in sorted(kinds)], together.keys()
        for kind in kinds:
            for name, pixels in images_of(kind).items():
                assert np.array_equal(pixels, together[name]) and np.ptp(pixels[..., :3]) > 0.1, name
    finally:
        cotan.bake_maps = own
    for name in ("left", "right"):
        used = [n.image.name for n in bpy.data.materials[name].node_tree.nodes if n.type == "TEX_IMAGE"]
        assert used == [f"low_{name}_normal"], used


def whatWasWrittenBeforeAMapFailedIsKept():
    low, high, own = square(), ball(), cotan.write_image

    def failing(file, pixels):
        if "ao" in os.path.basename(file):
            raise cotan.OutputError(f"{file}: the disk is full")
        own(file, pixels)

    settings(distance=2, maps={"normal", "ao"})
    select(high, low)
    cotan.write_image = failing
    try:
        assert bpy.ops.object.cotan_bake(which="ACTIVE") == {"FINISHED"}
    finally:
        cotan.write_image = own
    assert [image.name for image in bpy.data.images] == ["low_normal"]


def aCageIsMadeWhereRaysStartAndIsUsed():
    x, y = texel_centres()
    low, high = square("door_low.001", half=2, matrix=moved(1, 2, 3)), ball(matrix=moved(1, 2, 3))
    select(low)
    settings(extrusion=1.5)
    for _ in range(2):  # the second replaces the first
        assert bpy.ops.object.cotan_cage() == {"FINISHED"}
    cages = [o for o in bpy.data.objects if "cage" in o.name]
    assert [o.name for o in cages] == ["door_cage.001"], cages
    assert cages[0].matrix_world == low.matrix_world
    assert all(abs(v.co.z - 1.5) < 1e-6 for v in cages[0].data.vertices)
    found = baked(low, high)
    assert bpy.context.scene.cotan.cage == "MESH" and bpy.context.scene.cotan.cage_object == cages[0]
    expect_sphere(found, 2 * x, 2 * y, least=300)
    select()
    bpy.context.view_layer.objects.active = None
    assert facts.error_of(bpy.ops.object.cotan_cage).startswith("No mesh is active")


def theNormalNodeReadsTheMap():
    low, high = square(), ball()
    material = material_with_nodes("worn")
    low.data.materials.append(material)
    baked(low, high, distance=2)
    nodes = material.node_tree.nodes

    def chain():
        reader = nodes["Principled BSDF"].inputs["Normal"].links[0].from_node
        return reader, reader.inputs["Color"].links[0].from_node

    reader, texture = chain()
    assert (reader.type, texture.type, texture.image.name) == ("NORMAL_MAP", "TEX_IMAGE", "low_normal")
    assert texture.image.colorspace_settings.name == "Non-Color" and texture.image.packed_file
    assert (texture.image.is_float, tuple(texture.image.size)) == (True, (64, 64))
    count = len(nodes)
    baked(low, high, distance=2, bits="8")  # again: the same nodes with the new image, and no other image
    assert len(nodes) == count and chain()[1].image.is_float is False and len(bpy.data.images) == 1
    # With a Bump node in between, the map goes before it.
    bump = nodes.new("ShaderNodeBump")
    for link in list(nodes["Principled BSDF"].inputs["Normal"].links):
        material.node_tree.links.remove(link)
    material.node_tree.links.new(bump.outputs["Normal"], nodes["Principled BSDF"].inputs["Normal"])
    baked(low, high, distance=2)
    assert nodes["Principled BSDF"].inputs["Normal"].links[0].from_node == bump
    assert bump.inputs["Normal"].links[0].from_node.type == "NORMAL_MAP"
    settings(assign=False)
    bpy.data.objects.remove(low)
    other = square("other")
    baked(other, high, distance=2, assign=False)
    assert not other.data.materials and bpy.data.images["other_normal"]


def mapsAreSavedAsFiles():
    low, high = square(), ball()
    folder = os.path.join(facts.FOLDER, "maps")
    os.mkdir(folder)
    for bits, depth in (("8", 24), ("16", 96)):
        found = baked(low, high, distance=2, bits=bits, store="FILE", folder=folder)
        path = os.path.join(folder, "low_normal.png")
        image = bpy.data.images["low_normal"]
        assert os.path.isfile(path) and image.packed_file is None and bpy.path.abspath(image.filepath) == path
        again = cotan.read_image(path)
        assert again.dtype == (np.uint8 if bits == "8" else np.uint16) and image.depth == depth, image.depth
        stored = 2 * again[..., :3].astype(float) / (2 ** int(bits) - 1) - 1
        assert np.abs(stored - found).max() < 1e-4
    # A file that belongs to no image is not replaced without permission.
    bpy.data.images.remove(bpy.data.images["low_normal"])
    assert "already exists" in facts.error_of(bpy.ops.object.cotan_bake)
    bpy.context.scene.cotan.overwrite = True
    assert bpy.ops.object.cotan_bake() == {"FINISHED"}


def mapsOfOneNameAreKeptApart():
    # Object "a" with the material "b_c", and object "a_b" with "c": both maps would be "a_b_c_normal".
    x, y = texel_centres()
    high = ball()
    for thing, material in (("a", "b_c"), ("a_b", "c")):
        outline = [(-2, -1), (0, -1), (0, 1), (-2, 1), (2, -1), (2, 1)]
        low = facts.make_mesh(thing, [(u, v, 0) for u, v in outline], [(0, 1, 2, 3), (1, 4, 5, 2)], [(0, 0)] * 6)
        for polygon in low.data.polygons:
            for loop, uv in zip(polygon.loop_indices, [(0, 0), (1, 0), (1, 1), (0, 1)]):
                low.data.uv_layers[0].data[loop].uv = uv
        for name in (material, "rest"):
            low.data.materials.append(bpy.data.materials.new(name))
        low.data.polygons[1].material_index = 1
        settings(distance=2, each_material=True)
        select(high, low)
        assert bpy.ops.object.cotan_bake() == {"FINISHED"}
    used = [next(n.image.name for n in bpy.data.materials[m].node_tree.nodes if n.type == "TEX_IMAGE") for m in ("b_c", "c")]
    assert used == ["a_b_c_normal", "a_b_c_normal.001"], used
    # Two names of objects that are one name of a file.
    folder = os.path.join(facts.FOLDER, "names")
    os.mkdir(folder)
    for thing, lean in (("lid x", 0.2), ("lid_x", -0.2)):
        high.location = (lean, 0, 0)
        baked(square(thing), high, distance=2, store="FILE", folder=folder)
    files = [os.path.basename(bpy.data.images[f"{name}_normal"].filepath) for name in ("lid x", "lid_x")]
    assert files == ["lid_x_normal.png", "lid_x_normal-2.png"] and sorted(os.listdir(folder)) == sorted(files), files
    # A second bake of one replaces its own map only.
    high.location = (0.3, 0, 0)
    baked(bpy.data.objects["lid_x"], high, distance=2, store="FILE", folder=folder)
    assert len([image for image in bpy.data.images if "cotan_of" in image]) == 6 and len(os.listdir(folder)) == 2
    expect_sphere(directions(bpy.data.images["lid_x_normal"]), x - 0.3, y)
    expect_sphere(directions(bpy.data.images["lid x_normal"]), x - 0.2, y)


def mapsSurviveSavingAndOpening():
    folder = os.path.join(facts.FOLDER, "project")
    os.mkdir(folder)
    blend, elsewhere = os.path.join(folder, "scene.blend"), os.path.join(facts.FOLDER, "moved")
    bpy.ops.wm.save_as_mainfile(filepath=blend)
    packed = baked(square("packed"), ball(), distance=2, frame="smooth")
    filed = baked(square("filed"), bpy.data.objects["high"], distance=2, store="FILE", folder="//")
    bpy.ops.wm.save_mainfile()
    os.rename(folder, elsewhere)
    bpy.ops.wm.open_mainfile(filepath=os.path.join(elsewhere, "scene.blend"))
    for name, expected, frame in (("packed", packed, "smooth"), ("filed", filed, "smooth")):
        image = bpy.data.images[f"{name}_normal"]
        assert (directions(image) == expected).all() and image["cotan_frame"] == frame
        assert image.colorspace_settings.name == "Non-Color"


facts.hold_all(__name__)
