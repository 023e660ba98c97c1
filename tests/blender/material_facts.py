"""Maps of the detailed objects' materials, compared with the numbers that the materials have."""

import os

import bpy
import facts
import numpy as np
from cotan_blender import bake, images, pairs
from facts import ball, make_mesh, material_with_nodes, moved, select, settings, square
from mathutils import Euler, Matrix

ALL = {"base-color", "roughness", "metallic", "emissive", "id"}


def material(name, color=(0.8, 0.8, 0.8), roughness=0.5, metallic=0.0, light=(0, 0, 0), strength=1.0):
    made = material_with_nodes(name)
    inputs = made.node_tree.nodes["Principled BSDF"].inputs
    inputs["Base Color"].default_value = (*color, 1)
    inputs["Roughness"].default_value, inputs["Metallic"].default_value = roughness, metallic
    inputs["Emission" if "Emission" in inputs else "Emission Color"].default_value = (*light, 1)
    inputs["Emission Strength"].default_value = strength
    return made


def half(name, side, made=None, z=0.1):
    """A square above the left (-1) or the right (1) half of square(), which is larger than it."""
    thing = make_mesh(name, [(min(0, 3 * side), -3, z), (max(0, 3 * side), -3, z), (max(0, 3 * side), 3, z),
                             (min(0, 3 * side), 3, z)], [(0, 1, 2, 3)], [(0, 0), (1, 0), (1, 1), (0, 1)])  # fmt: skip
    if made is not None:
        thing.data.materials.append(made)
    return thing


def baked(low, *highs, **wanted):
    """The maps as 8-bit codes by their words, and what was said."""
    s = settings(**{"bits": "8", "samples": "1", "maps": ALL, "distance": 1, "width": 32, "height": 32, **wanted})
    select(*highs, low)
    outcome = bake.Outcome()
    for _ in bake.run(bpy.context, s, pairs.by_selection(bpy.context)[0], outcome):
        pass
    words = {image.name[len(low.name) + 1 :].replace("_", "-"): images.pixels_of(image) for image in outcome.made}
    return words, outcome


def srgb(linear):
    linear = np.minimum(np.asarray(linear, float), 1)
    return 255 * np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def expect_sides(pixels, left, right, off=0.51):
    """The left and the right half of a map; columns at the border may show either."""
    for side, wanted in ((pixels[:, :15], left), (pixels[:, 17:], right)):
        assert np.abs(side[..., :3].astype(float) - wanted).max() <= off, (side[0, 0], wanted)


def twoMaterialsAreCarriedOver():
    low, cap = square(), material("cap", (1, 1, 1), 0.8, 0.25, (0, 0.2, 3), 2)
    file = os.path.join(facts.FOLDER, "paint.png")
    paint = bpy.data.images.new("paint", 4, 4)
    paint.pixels = [51 / 255, 102 / 255, 204 / 255, 1] * 16
    paint.filepath_raw, paint.file_format = file, "PNG"
    paint.save()
    texture = cap.node_tree.nodes.new("ShaderNodeTexImage")
    texture.image = paint
    cap.node_tree.links.new(texture.outputs["Color"], cap.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
    skin = material("skin", (0.7, 0.1, 0.02), 0.3, 1)
    highs = half("a", -1, skin), half("b", 1, cap)
    finer = highs[1].modifiers.new("finer", "SUBSURF")
    finer.subdivision_type, finer.render_levels = "SIMPLE", 2
    # Colours at vertices that no node reads change nothing.
    if hasattr(highs[0].data, "color_attributes"):
        painted = highs[0].data.color_attributes.new("Col", "BYTE_COLOR", "CORNER")
        painted.data.foreach_set("color", [0.5, 0.5, 0.5, 1.0] * len(painted.data))
    before = [len(bpy.data.objects), len(bpy.data.meshes), len(bpy.data.materials)]
    maps, outcome = baked(low, *highs, assign=False)
    assert not outcome.failures and not outcome.notes, outcome
    assert maps.keys() == ALL
    expect_sides(maps["base-color"], srgb((0.7, 0.1, 0.02)), (51, 102, 204))
    expect_sides(maps["roughness"], 255 * 0.3, 255 * 0.8)
    expect_sides(maps["metallic"], 255, 255 * 0.25)
    expect_sides(maps["emissive"], 0, srgb((0, 0.4, 6)))
    expect_sides(maps["id"], (128, 0, 0), (0, 128, 0), 0)
    spaces = {image.name[4:]: image.colorspace_settings.name for image in outcome.made}
    assert spaces == {
        "base_color": "sRGB", "roughness": "Non-Color", "metallic": "Non-Color", "emissive": "sRGB", "id": "sRGB",
    }, spaces  # fmt: skip
    assert dict(bpy.data.images["low_id"]["cotan_ids"]) == {"skin": "#800000", "cap": "#008000"}
    assert [len(bpy.data.objects), len(bpy.data.meshes), len(bpy.data.materials)] == before
    assert bpy.context.view_layer.objects.active == low and set(bpy.context.selected_objects) == {low, *highs}


def idsOfObjectsAreTheirNames():
    low, made = square(), material("both")
    parts = half("left part", -1, made), half("right part", 1, made)
    maps, outcome = baked(low, *parts, maps={"id"}, id_by="OBJECT", assign=False)
    expect_sides(maps["id"], (128, 0, 0), (0, 128, 0), 0)
    assert dict(outcome.made[0]["cotan_ids"]) == {"left part": "#800000", "right part": "#008000"}
    maps, _ = baked(low, *parts, maps={"id"}, id_by="MATERIAL", assign=False)
    expect_sides(maps["id"], (128, 0, 0), (128, 0, 0), 0)


def idsOfVertexColorsAreThoseOfTheActiveOrTheNamedAttribute():
    # Each object has two attributes, of which the left one has one without a name.
    low, paint = square(), material("paint", (0.5, 0.25, 1))
    left, right = half("left", -1, paint), half("right", 1, paint)
    facts.painted(left, "Col", (1, 0, 0))
    unnamed = facts.painted(left, "", (0.2, 0.4, 0.8), "POINT", "FLOAT_COLOR")
    facts.painted(right, "Other", (0, 1, 0), "POINT")
    facts.painted(right, "Col", (0.1, 0.6, 0.3))
    blue, green = np.rint(srgb((0.2, 0.4, 0.8))), np.rint(srgb((0.1, 0.6, 0.3)))
    wanted = {"id_by": "VERTEX_COLOR", "assign": False}
    for name, of_left, of_right in (("", blue, green), ("Col", (255, 0, 0), green), (unnamed, blue, (255, 255, 255)),
                                    ("Other", (255, 255, 255), (0, 255, 0))):  # fmt: skip
        maps, outcome = baked(low, left, right, maps={"normal", "id"}, id_colors=name, **wanted)
        assert not outcome.failures and not outcome.notes, outcome
        expect_sides(maps["id"], of_left, of_right, 0)
        assert "cotan_ids" not in bpy.data.images["low_id"]
    # Beside maps of materials, of whose base colour they are no factor.
    maps, outcome = baked(low, left, right, maps=ALL - {"emissive"} | {"normal"}, id_colors="", **wanted)
    assert set(maps) == ALL - {"emissive"} | {"normal"} and not outcome.failures and not outcome.notes, outcome
    expect_sides(maps["id"], blue, green, 0)
    expect_sides(maps["base-color"], srgb((0.5, 0.25, 1)), srgb((0.5, 0.25, 1)))
    assert np.unique(maps["normal"][..., :3].reshape(-1, 3), axis=0).tolist() == [[128, 128, 255]]
    for name, why in (("Missing", "No detailed mesh has color attribute 'Missing'"),
                      ("", "No detailed mesh has vertex colors: paint some")):  # fmt: skip
        _, outcome = baked(low, left, right, maps={"normal", "id"}, id_colors=name, **wanted)
        assert not outcome.made and outcome.failures == [why], outcome
        for thing in (left, right):
            for layer in list(thing.data.color_attributes):
                thing.data.color_attributes.remove(layer)


def materialsOfObjectsCountBeforeThoseOfMeshes():
    low, high = square(), half("a", -1, material("of mesh"))
    twin = bpy.data.objects.new("b", high.data)
    bpy.context.collection.objects.link(twin)
    twin.matrix_world = moved(x=3)
    twin.material_slots[0].link = "OBJECT"
    twin.material_slots[0].material = material("of object", (0.05, 0.6, 0.9))
    maps, _ = baked(low, high, twin, maps={"base-color"}, assign=False)
    expect_sides(maps["base-color"], srgb((0.8, 0.8, 0.8)), srgb((0.05, 0.6, 0.9)))


def theShapeIsThatWithoutMaterials():
    # Sheared by a parent that is stretched, mirrored, an instance of a collection, a curve, and a mesh without faces.
    low = square()
    stretched = bpy.data.objects.new("stretched", None)
    stretched.matrix_world = Matrix.Diagonal((1.0, 0.6, 1.3, 1.0))
    sheared = ball("sheared", (0, 0, 0), 0.45, cells=32)
    sheared.matrix_world = Euler((0.2, 0.3, 0.9)).to_matrix().to_4x4()
    sheared.parent = stretched
    sheared.matrix_parent_inverse = Matrix.Identity(4)
    mirrored = ball("mirrored", (0.5, 0.4, 0), 0.35, cells=32, matrix=Matrix.Diagonal((-1, 1, 1, 1)))
    part = ball("part", (0, 0, 0), 0.3, cells=32)
    kept = bpy.data.collections.new("kept")
    bpy.context.collection.objects.unlink(part)
    kept.objects.link(part)
    placed = bpy.data.objects.new("placed", None)
    placed.instance_type, placed.instance_collection = "COLLECTION", kept
    placed.matrix_world = moved(0.5, -0.5)
    for thing in (stretched, placed):
        bpy.context.collection.objects.link(thing)
    for number, thing in enumerate((sheared, mirrored, part)):
        thing.data.materials.append(material(f"m{number}", (0.2 * number + 0.1, 0.5, 0.5)))
    curve = bpy.data.curves.new("disc", "CURVE")
    curve.dimensions, curve.fill_mode = "2D", "BOTH"
    line = curve.splines.new("POLY")
    line.points.add(3)
    for point, (x, y) in zip(line.points, ((-2, -2), (2, -2), (2, 2), (-2, 2))):
        point.co = (x, y, 0, 1)
    line.use_cyclic_u = True
    disc = bpy.data.objects.new("disc", curve)
    disc.matrix_world = moved(z=-0.3) @ Matrix.Rotation(0.1, 4, "Y")
    bpy.context.collection.objects.link(disc)
    curve.materials.append(material("m3", (0.9, 0.5, 0.5)))
    points = make_mesh("points", [(0, 0, 2)], [])
    highs = sheared, mirrored, placed, disc, points
    shape = {"normal", "position", "height"}
    alone, _ = baked(low, *highs, maps=shape, assign=False, distance=2)
    both, outcome = baked(low, *highs, maps=shape | ALL - {"emissive"}, assign=False, distance=2)
    assert not outcome.failures, outcome.failures
    assert outcome.notes == baked(low, *highs, maps=shape, assign=False, distance=2)[1].notes
    for word in shape:
        off = np.abs(both[word].astype(int) - alone[word])
        assert off.max() <= 1 and np.ptp(alone[word][..., 0]) > 50, (word, off.max())
    ids = {tuple(code) for code in both["id"][..., :3].reshape(-1, 3)}
    assert ids == {(128, 0, 0), (0, 128, 0), (128, 128, 0), (0, 0, 128)}, ids


def whatGltfLacksIsNamed():
    low, noisy, plain = square(), material("noisy"), material("plain", roughness=0.25)
    tree = noisy.node_tree
    noise = tree.nodes.new("ShaderNodeTexNoise")
    tree.links.new(noise.outputs["Color"], tree.nodes["Principled BSDF"].inputs["Base Color"])
    shaderless = material_with_nodes("shaderless")
    shaderless.node_tree.nodes.remove(shaderless.node_tree.nodes["Principled BSDF"])
    highs = half("a", -1, noisy), half("b", 1, plain), half("c", 1, shaderless, z=0.05)
    _, outcome = baked(low, *highs, maps={"base-color"}, assign=False)
    assert len(outcome.notes) == 2 and not outcome.failures, outcome
    assert outcome.notes[0].startswith("'noisy': 'Base Color' is neither a number nor an image"), outcome.notes
    assert outcome.notes[1].startswith("'shaderless' has no Principled BSDF"), outcome.notes
    maps, outcome = baked(low, *highs, maps={"roughness"}, assign=False)
    assert len(outcome.notes) == 1, outcome.notes
    expect_sides(maps["roughness"], 255 * 0.5, 255 * 0.25)


def detailWithoutMaterialsIsRefused():
    low = square()
    _, outcome = baked(low, half("bare", -1), half("naked", 1), maps={"normal", "base-color"})
    assert not outcome.made and len(outcome.failures) == 1, outcome
    assert "expected a base colour map" in outcome.failures[0] and "/" not in outcome.failures[0], outcome.failures


facts.hold_all(__name__)
