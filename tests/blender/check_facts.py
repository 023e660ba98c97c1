"""What the check reports and selects, and what the export writes and warns of."""

import math
import os

import bpy
import cotan
import facts
import numpy as np
from cotan_blender import gltf
from facts import baked, ball, degrees, make_mesh, moved, parts_of, select, square
from mathutils import Matrix


def said_lines():
    return [(line.kind, line.text) for line in bpy.context.window_manager.cotan_lines]


def selected(mesh):
    """Indices of the polygons selected in Edit Mode."""
    assert bpy.context.mode == "EDIT_MESH", bpy.context.mode
    bpy.ops.object.mode_set(mode="OBJECT")
    return [p.index for p in mesh.polygons if p.select]


def checked(each, kind="ALL"):
    select(each)
    assert bpy.ops.object.cotan_check(kind=kind) == {"FINISHED"}
    return said_lines()


def strip(uv_of, count=5):
    """Unit squares in a row; uv_of(index): the four uv of each."""
    vertices = [(x, y, 0) for x in range(count + 1) for y in (0, 1)]
    faces = [(2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1) for k in range(count)]
    made = make_mesh("strip", vertices, faces, [(0, 0)] * len(vertices))
    for polygon in made.data.polygons:
        for loop, uv in zip(polygon.loop_indices, uv_of(polygon.index)):
            made.data.uv_layers[0].data[loop].uv = uv
    return made


def corners(width=1.0, height=1.0, shear=0.0):
    return [(0, 0), (width, 0), (width + shear, height), (shear, height)]


def soundFacesAreNotReported():
    made = strip(lambda k: corners())
    messages = checked(made)
    assert messages[0] == ("", "'strip' has no material") or ("", "No face has a problem") in messages, messages
    assert bpy.context.mode == "OBJECT"


def facesWithoutAreaInUvAreSelected():
    made = strip(lambda k: corners(0 if k in (1, 4) else 1))
    messages = checked(made)
    assert messages[0][0] == "UV" and messages[0][1].startswith("2 faces have no area in uv"), messages
    assert selected(made.data) == [1, 4]


def stretchedFacesAreSelectedFromTheGivenAngle():
    # Stretched by s, a slope of 35 degrees along u is read as tan 35 * s: the angle between the two is known.
    stretch = 1.5
    off = math.degrees(math.atan(stretch * math.tan(math.radians(35)))) - 35
    made = strip(lambda k: corners(stretch if k == 2 else 1))
    for limit, expected in ((0.5, [2]), (20, [])):
        bpy.context.scene.cotan.degrees = limit
        messages = checked(made)
        found = selected(made.data) if expected else []
        assert found == expected and (messages[0][0] == "STRETCH") == bool(expected), (limit, messages, off)
    # The frame that keeps lengths scales both axes by their mean: the error is less than `off` but over a third of it.
    from cotan_blender import check

    uv = np.array([[(0, 1), (stretch, 1), (stretch, 0)]], np.float32)
    most = check._differences(np.array([[(0, 0, 0), (1, 0, 0), (1, 1, 0)]], np.float32), uv)
    assert off / 3 < most[0] <= off + 0.01, (most, off)


def nGonsAndFacesWithoutAreaAreSelected():
    outline = [(math.cos(a), math.sin(a), 0) for a in np.arange(6)]
    line, uv = [(3, 0, 0), (4, 0, 0), (5, 0, 0)], [(x, y) for x, y, _ in outline] + [(0, 0), (1, 0), (0, 1)]
    made = make_mesh("mixed", outline + line, [(0, 1, 2, 3, 4, 5), (6, 7, 8)], uv)
    messages = checked(made)
    assert {kind for kind, _ in messages if kind} == {"NGON", "AREA"}, messages
    assert selected(made.data) == [0, 1]
    checked(made, kind="NGON")
    assert selected(made.data) == [0]
    # The same from Edit Mode: a previous selection is replaced.
    bpy.ops.object.mode_set(mode="EDIT")
    checked(made, kind="AREA")
    assert selected(made.data) == [1]


def wavy_high(cells=96):
    """Crossing waves that extend beyond the square."""
    along = np.linspace(-1.2, 1.2, cells + 1)
    x, y = (a.ravel() for a in np.meshgrid(along, along))
    z = 0.04 * np.sin(9 * x + 4 * y) + 0.03 * np.sin(7 * y - 6 * x) + 0.02 * np.sin(13 * x + 2) * np.sin(11 * y)
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    faces = np.stack([first, first + 1, first + cells + 2, first + cells + 1], -1)
    return make_mesh("high", np.stack([x, y, z], -1), faces)


def mapProblemsAreReported():
    low, high = square(), wavy_high()
    baked(low, high, distance=2, width=128, height=128, bits="8")
    messages = [text for _, text in checked(low)]
    assert any(t.startswith("'low_normal': green points up") for t in messages), messages
    assert any("MikkTSpace" in t for t in messages), messages
    image = bpy.data.images["low_normal"]
    image.colorspace_settings.name = "sRGB"
    assert any("is read as a colour (sRGB)" in text for _, text in checked(low))
    image.colorspace_settings.name = "Non-Color"
    # Upside down: green is reversed.
    pixels = np.empty(128 * 128 * 4, np.float32)
    image.pixels.foreach_get(pixels)
    pixels[1::4] = 256 / 255 - pixels[1::4]
    image.pixels.foreach_set(pixels)
    image.update()
    assert any("green points down" in text and "Reverse it" in text for _, text in checked(low)), said_lines()
    baked(low, high, distance=2, frame="smooth")
    assert any("'low_normal' was baked for smooth" in text for _, text in checked(low)), said_lines()


def export(name, to="smooth", **arguments):
    bpy.context.scene.cotan.to_frame = to
    path = os.path.join(facts.FOLDER, name)
    assert bpy.ops.export_scene.cotan_gltf(filepath=path, **arguments) == {"FINISHED"}
    return path


def curved_hull():
    """A coarse hull with a baked map in its material, whose uv are stretched."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8)
    low = bpy.context.object
    low.name = "low"
    bpy.ops.object.shade_smooth()
    low.modifiers.new("triangles", "TRIANGULATE")
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5, radius=1)
    high = bpy.context.object
    high.name = "high"
    bpy.ops.object.shade_smooth()
    for vertex in high.data.vertices:
        vertex.co *= 1 + 0.04 * math.sin(8 * vertex.co.x) * math.sin(8 * vertex.co.z)
    return low, high


def theExportedMapEqualsABakeForItsFrame():
    low, high = curved_hull()
    directions = {}
    for frame in ("mikktspace", "smooth"):
        directions[frame] = baked(low, high, frame=frame, width=256, height=256, padding=0)
    # Baked for MikkTSpace and exported for smooth: covered texels equal those of a bake for smooth.
    baked(low, high, frame="mikktspace", width=256, height=256, padding=0)
    select(low)
    path = export("converted.glb")
    model, binary = parts_of(path)
    attributes = model["meshes"][0]["primitives"][0]["attributes"]
    assert "TANGENT" not in attributes and "TEXCOORD_0" in attributes
    view = model["bufferViews"][model["images"][0]["bufferView"]]
    picture = os.path.join(facts.FOLDER, "map.png")
    with open(picture, "wb") as file:
        file.write(binary[view.get("byteOffset", 0) :][: view["byteLength"]])
    pixels = cotan.read_image(picture)
    half = 2 ** (8 * pixels.itemsize - 1)
    found = (pixels[..., :3].astype(float) - half) / (half - 1)
    before, after = degrees(directions["mikktspace"], directions["smooth"]), degrees(found, directions["smooth"])
    assert np.median(before) > 0.5 and np.median(after) < 0.1, (np.median(before), np.median(after))
    # A map that was baked for the frame is kept.
    baked(low, high, frame="smooth", width=64, height=64)
    select(low)
    assert cotan.convert(gltf.exported(bpy.context, [low]), from_frame="smooth", to_frame="smooth").maps_converted == 0
    export("kept.glb")


def theMeasuredExportKeepsMapsAndNamesFrames():
    """What the library decides for the exported model is in the file; a map for another frame keeps its frame."""
    low, high = curved_hull()
    baked(low, high, frame="mikktspace", width=64, height=64)
    select(low)
    assert bpy.context.scene.cotan.bl_rna.properties["to_frame"].default == "MEASURED"
    decided = cotan.convert(gltf.exported(bpy.context, [low])).report["decisions"]
    assert [(d["reason"], d["meaning"]) for d in decided] == [("fits", "mikktspace")], decided
    model, _ = parts_of(export("measured.glb", "MEASURED"))
    (primitive,) = model["meshes"][0]["primitives"]
    assert "TANGENT" not in primitive["attributes"]
    assert primitive["extras"]["cotanFrame"] == decided[0]["frame"]
    assert "cotanFrame" not in model["materials"][0].get("extras", {})
    # With a larger limit a cheaper frame is near enough on this coarse hull.
    bpy.context.scene.cotan.max_degrees = 90
    model, _ = parts_of(export("loose.glb", "MEASURED"))
    assert model["meshes"][0]["primitives"][0]["extras"]["cotanFrame"] == "orthonormal"
    assert decided[0]["frame"] != "orthonormal", decided
    baked(low, high, frame="smooth", width=64, height=64)
    select(low)
    model, _ = parts_of(export("smooth.glb", "MEASURED"))
    assert model["materials"][0]["extras"]["cotanFrame"] == "smooth"


def theExportRestoresTheSelection():
    low, high = curved_hull()
    select(high, low)
    export("both.glb")
    assert bpy.context.view_layer.objects.active == low and set(bpy.context.selected_objects) == {low, high}
    assert len(parts_of(os.path.join(facts.FOLDER, "both.glb"))[0]["meshes"]) == 2
    select(low)
    export("one.glb")
    assert len(parts_of(os.path.join(facts.FOLDER, "one.glb"))[0]["meshes"]) == 1
    # The input of lint has no tangents either, whatever the converter would do with them.
    with open(os.path.join(facts.FOLDER, "seen.glb"), "wb") as file:
        file.write(gltf.exported(bpy.context, [low]))
    attributes = parts_of(file.name)[0]["meshes"][0]["primitives"][0]["attributes"]
    assert set(attributes) == {"POSITION", "NORMAL", "TEXCOORD_0"}, attributes


def mapped(each, uv=""):
    """Gives the object a material with a normal map."""
    from cotan_blender import nodes

    material = bpy.data.materials.new("mapped")
    each.data.materials.append(material)
    image = bpy.data.images.new("flat", 8, 8)
    image.colorspace_settings.name = "Non-Color"
    nodes.assign(material, image, uv)
    return material


def warned(each, *wanted, **arguments):
    messages = gltf.warnings(bpy.context, [each], **arguments)
    assert len(messages) == len(wanted) and all(text in line for text, line in zip(wanted, messages)), messages


def exportWarnsWhereBlenderIsSilent():
    warned(square("sound"))
    pentagon = [(math.cos(a), math.sin(a), 0) for a in np.arange(5)]
    ngon = make_mesh("ngon", pentagon, [(0, 1, 2, 3, 4)])
    warned(ngon, "1 faces of more than four corners: Blender silently writes no tangents")
    ngon.modifiers.new("cut", "TRIANGULATE")
    warned(ngon)
    warned(ngon, "more than four corners", "without its modifiers", apply_modifiers=False)
    bare = make_mesh("bare", pentagon[:3], [(0, 1, 2)])
    mapped(bare)
    warned(bare, "'bare' has no uv map: no program can show the normal map of 'mapped'")
    wide = square("wide", matrix=Matrix.Diagonal((1, 2, 1, 1)))
    warned(wide, "has a non-uniform scale")
    leaning = square("leaning")
    facts.set_custom_normals(leaning, (0.6, 0, 0.8))
    warned(leaning)
    if bpy.app.version < (4, 1, 0):
        leaning.data.use_auto_smooth = False
        warned(leaning, "'leaning' has custom normals, but its Auto Smooth is off")
    keyed = square("keyed")
    for name in ("Basis", "up"):
        keyed.shape_key_add(name=name)
    warned(keyed, "'keyed' has shape keys")
    warned(keyed, apply_modifiers=False)


def severalUvMapsAreNamed():
    low = square()
    low.data.uv_layers.new(name="second")
    material = mapped(low, "second")
    warned(low, "2 uv maps: its normal map is read with 'second', and programs that support only the first use 'UVMap'")
    reader = next(n for n in material.node_tree.nodes if n.type == "NORMAL_MAP")
    reader.uv_map = "UVMap"
    warned(low, "reads its normal map with uv 'second' and its tangents with 'UVMap'")


def mapsForTwoFramesAreNotMixed():
    one, other, high = square("one"), square("other", matrix=moved(5)), ball()
    baked(one, high, frame="smooth", distance=2)
    high.location.x = 5
    bpy.context.view_layer.update()
    baked(other, high, frame="mikktspace", distance=2)
    select(one, other)
    path = os.path.join(facts.FOLDER, "mixed.glb")
    found = facts.error_of(bpy.ops.export_scene.cotan_gltf, filepath=path)
    assert found.startswith("'one_normal' was baked for smooth and 'other_normal' for mikktspace"), found
    assert not os.path.exists(path)


facts.hold_all(__name__)
