"""Which way green of a map points, where the Normal Map node of a material says so (since Blender 5)."""

import os
import types

import bpy
import cotan
import facts
import numpy as np
from cotan_blender import gltf, nodes
from cotan_blender.refused import Refused
from facts import ball, baked, directions, expect_sphere, moved, parts_of, square, texel_centres


def material_with(image, down, name):
    """A material that reads the image as a normal map. down: in a node that takes green as pointing down. Blenders
    without such nodes get one that only the add-on believes to be one."""
    material = bpy.data.materials.new(name)
    nodes.assign(material, image, "")
    if nodes.HAS_CONVENTION:
        nodes.map_of(material)[0].convention = "DIRECTX" if down else "OPENGL"
    elif down:
        nodes.map_of(material)[0].name = "DirectX"
    return material


class believed:
    """Makes the add-on believe that nodes named DirectX take green as pointing down, where there is no such property."""

    def __enter__(self):
        self.own = nodes.reads_green_down
        if not nodes.HAS_CONVENTION:
            nodes.reads_green_down = lambda reader: reader.name == "DirectX"

    def __exit__(self, *_):
        nodes.reads_green_down = self.own


def hill(name, up):
    """A map of a hill: the image, whose green points up or down."""
    across, along = np.meshgrid((np.arange(64) - 31.5) / 32, (np.arange(64) - 31.5) / 32)  # rows from the bottom
    normal = np.stack([across, along, np.ones_like(across)], -1) * np.exp(-across**2 - along**2)[..., None]
    normal[..., 2] = 1
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    codes = np.ones((64, 64, 4))
    codes[..., :3] = np.rint((normal * (1, 1 if up else -1, 1) + 1) * 127.5) / 255  # as Blender reads them
    image = bpy.data.images.new(name, 64, 64)
    image.colorspace_settings.name = "Non-Color"
    image.pixels.foreach_set(codes.ravel().astype(np.float32))
    image.update()
    image.pack()
    return image


def maps_in(model):
    """The normal map of each material of a .glb, by the material's name: rows from the top, bytes."""
    path = os.path.join(facts.FOLDER, "seen.glb")
    with open(path, "wb") as file:
        file.write(model)
    tree, binary = parts_of(path)
    found = {}
    for material in tree["materials"]:
        image = tree["images"][tree["textures"][material["normalTexture"]["index"]]["source"]]
        view = tree["bufferViews"][image["bufferView"]]
        with open(f"{path}.png", "wb") as file:
            file.write(binary[view.get("byteOffset", 0) :][: view["byteLength"]])
        found[material["name"]] = cotan.read_image(f"{path}.png")
    return found


def aNodeWithoutTheConventionTakesGreenAsPointingUp():
    material = bpy.data.materials.new("plain")
    assert not nodes.reads_green_down(types.SimpleNamespace())
    assert nodes.read_green_up(material, types.SimpleNamespace()) == []
    for before, said in (("OPENGL", 0), ("DIRECTX", 1)):
        node = types.SimpleNamespace(convention=before)
        assert nodes.reads_green_down(node) == bool(said)
        messages = nodes.read_green_up(material, node)
        assert len(messages) == said and node.convention == "OPENGL", messages
        assert not said or messages[0].startswith("'plain' took green as pointing down (DirectX)"), messages


def eachMaterialIsExportedWithGreenUp():
    one, other = square("one"), square("other", matrix=moved(5))
    up, down = hill("up", True), hill("down", False)
    one.data.materials.append(material_with(up, False, "opengl"))
    other.data.materials.append(material_with(down, True, "directx"))
    with believed():
        found = maps_in(gltf.exported(bpy.context, [one, other]))
        messages = gltf.warnings(bpy.context, [one, other])
    assert found["opengl"].shape[:2] == (64, 64) and np.ptp(found["opengl"][..., 1]) > 60
    assert (found["opengl"] == found["directx"]).all(), "the same hill"
    assert cotan.detect(found["opengl"]).green == cotan.detect(found["directx"]).green == "up"
    assert [m.split(":")[0] for m in messages] == ["'directx' takes green as pointing down (DirectX)"], messages
    # The scene is as before.
    assert {i.name for i in bpy.data.images} == {"up", "down"}, list(bpy.data.images)
    for material, image in (("opengl", up), ("directx", down)):
        assert nodes.map_of(bpy.data.materials[material])[1].image == image


def oneImageInTwoMaterialsIsExportedAsEachReadsIt():
    one, other = square("one"), square("other", matrix=moved(5))
    image = hill("shared", True)
    one.data.materials.append(material_with(image, False, "opengl"))
    other.data.materials.append(material_with(image, True, "directx"))
    with believed():
        found = maps_in(gltf.exported(bpy.context, [one, other]))
        said = [gltf.detected(i, down) for i, down in gltf.normal_maps([one, other])]
    assert [cotan.detect(found[name]).green for name in ("opengl", "directx")] == ["up", "down"]
    assert [("Reverse it" in text) for text in said] == [False, True], said


def aMaterialOfALibraryIsExportedWithGreenUpOrRefused():
    material = material_with(hill("down", False), True, "theirs")
    material.use_fake_user = True
    path = os.path.join(facts.FOLDER, "theirs.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, to):
        to.materials = ["theirs"]
    low = square("low")
    low.data.materials.append(bpy.data.materials["theirs"])
    with believed():
        try:
            assert cotan.detect(maps_in(gltf.exported(bpy.context, [low]))["theirs"]).green == "up"
        except Refused as error:
            assert str(error).startswith("The material 'theirs' comes from a library file and takes green"), error
    assert nodes.map_of(bpy.data.materials["theirs"])[1].image.name == "down"
    assert [i.name for i in bpy.data.images] == ["down"], list(bpy.data.images)


def theCheckJudgesGreenAsTheNodeTakesIt():
    for up in (True, False):
        for down in (True, False):
            said = gltf.detected(hill("map", up), down)
            assert f"green points {'up' if up else 'down'}" in said, said
            assert ("Reverse it" in said) == (up == down), said
            other = "or set its Normal Map node to " + ("OpenGL" if down else "DirectX")
            assert (other in said) == (up == down and nodes.HAS_CONVENTION), said
            bpy.data.images.remove(bpy.data.images["map"])


def aBakeIsReadTheWayItWasBaked():
    if not nodes.HAS_CONVENTION:
        raise facts.Skipped(f"Blender {bpy.app.version_string} has no convention of Normal Map nodes")
    low, high, bystander = square("low"), ball("high"), square("bystander", matrix=moved(9))
    old = hill("low_normal", False)
    low.data.materials.append(material_with(old, True, "worn"))
    bystander.data.materials.append(material_with(old, True, "same image"))
    other = material_with(hill("other", False), True, "other image")
    found = baked(low, high, distance=2)
    expect_sphere(found, *texel_centres())  # green points up
    for name in ("worn", "same image"):
        reader, texture = nodes.map_of(bpy.data.materials[name])
        assert (texture.image.name, reader.convention) == ("low_normal", "OPENGL"), name
    assert nodes.map_of(other)[0].convention == "DIRECTX"
    assert (directions(bpy.data.images["low_normal"]) == found).all()
    assert bpy.data.images["other"].users == 1


facts.hold_all(__name__)
