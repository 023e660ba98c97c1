"""Scenes that cannot be baked, checked or exported: each gives one plain sentence and changes nothing."""

import os

import bpy
import facts
from facts import ball, error_of, make_mesh, material_with_nodes, moved, select, settings, square

OUT = os.path.join(facts.FOLDER, "out.glb")


def expect(text, call, **arguments):
    before = (len(bpy.data.images), len(bpy.data.materials), bpy.context.mode)
    found = error_of(call, **arguments)
    assert found.startswith(text), f"expected '{text}', found '{found}'"
    assert before == (len(bpy.data.images), len(bpy.data.materials), bpy.context.mode)


def bake(**arguments):
    return bpy.ops.object.cotan_bake(**arguments)


def check(**arguments):
    return bpy.ops.object.cotan_check(**arguments)


def export(**arguments):
    return bpy.ops.export_scene.cotan_gltf(**arguments)


def anEmptyScene():
    expect("No object is active", bake)
    expect("No visible mesh is named like 'door_low'", bake, which="NAMES")
    expect("No object is active", check)
    expect("No mesh is selected", export, filepath=OUT)
    assert not os.path.exists(OUT)


def nothingIsSelected():
    square()
    select()
    expect("No object is active", bake)
    select(bpy.data.objects["low"])
    expect("No detailed mesh is selected", bake)


def theActiveObjectIsNoMesh():
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    bpy.context.collection.objects.link(camera)
    select(ball(), camera)
    expect("'Camera' is not a mesh", bake)
    expect("'Camera' is not a mesh", check)
    select(camera)
    expect("No mesh is selected", export, filepath=OUT)


def theDetailedObjectHasNoFaces():
    empty = bpy.data.objects.new("Empty", None)
    bpy.context.collection.objects.link(empty)
    settings()
    select(empty, square())
    expect("No faces remain of 'Empty'", bake)
    select(make_mesh("points", [(0, 0, 0)], []), bpy.data.objects["low"])
    expect("No faces remain of 'points'", bake)


def editMode():
    settings()
    select(ball(), square())
    bpy.ops.object.mode_set(mode="EDIT")
    expect("Go back to Object Mode first", bake)
    expect("Go back to Object Mode first", export, filepath=OUT)
    bpy.ops.object.mode_set(mode="OBJECT")


def noUv():
    settings()
    low = square()
    low.data.uv_layers.remove(low.data.uv_layers[0])
    select(ball(), low)
    expect("'low' has no uv map: unwrap it first", bake)
    low.data.uv_layers.new(name="other")
    settings(uv_map="missing")
    expect("'low' has no uv map 'missing', only 'other'", bake)


def uvWithoutArea():
    settings()
    low = square()
    for loop in low.data.uv_layers[0].data:
        loop.uv = (loop.uv[0], loop.uv[0])
    select(ball(), low)
    expect("The uv map 'UVMap' of 'low' has no area", bake)
    for k, loop in enumerate(low.data.uv_layers[0].data):
        loop.uv = (5 + k % 2, 5 + k // 2 % 2)
    expect("The uv map 'UVMap' of 'low' lies outside the square from 0 to 1", bake)
    low.data.uv_layers[0].data[0].uv = (float("nan"), 0)
    expect("The uv map 'UVMap' of 'low' has coordinates that are not finite", bake)


def noFaces():
    settings()
    low = make_mesh("low", [(0, 0, 0), (1, 0, 0)], [])
    select(ball(), low)
    expect("'low' has no faces", bake)
    expect("'low' has no faces", check)


def aModifierThatLeavesNothing():
    settings()
    low = square()
    mask = low.modifiers.new("all", "MASK")
    mask.vertex_group = low.vertex_groups.new(name="none").name
    select(ball(), low)
    expect("'low' has no faces, or none remain after its modifiers", bake)
    low.modifiers.clear()
    high = bpy.data.objects["high"]
    mask = high.modifiers.new("all", "MASK")
    mask.vertex_group = high.vertex_groups.new(name="none").name
    expect("No faces remain of 'high' after modifiers", bake)


def nonFinitePositions():
    settings()
    low, high = square(), ball()
    select(high, low)
    low.data.vertices[2].co.x = float("nan")
    expect("'low': 1 of its vertices have invalid positions (NaN, infinite or too far away), the first is number 2",
           bake)
    expect("'low' has vertices with invalid positions", export, filepath=OUT)
    assert bpy.ops.object.cotan_check() == {"FINISHED"}
    assert bpy.context.window_manager.cotan_lines[0].kind == "PLACE" and low.data.total_face_sel == 1
    bpy.ops.object.mode_set(mode="OBJECT")
    low.data.vertices[2].co = (1, 1, 0)
    high.data.vertices[7].co.y = float("nan")
    expect("'high': 1 of its vertices have invalid positions", bake)
    high.data.vertices[7].co.y = float("inf")  # Blender turns it into the largest float
    expect("'high': 1 of its vertices have invalid positions", bake)


def anObjectScaledToNothing():
    settings()
    low, high = square(), ball()
    low.scale.z = 0
    bpy.context.view_layer.update()
    select(high, low)
    expect("'low' has a scale of zero along an axis", bake)


def aLinkedLibrary():
    settings()
    low = square("linked")
    low.data.materials.append(bpy.data.materials.new("theirs"))
    path = os.path.join(facts.FOLDER, "library.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_factory_settings(use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, to):
        to.objects = ["linked"]
    low = to.objects[0]
    bpy.context.collection.objects.link(low)
    high = ball()
    settings()
    select(high, low)
    expect("The material 'theirs' comes from a library file", bake)
    settings(assign=False)
    assert bpy.ops.object.cotan_bake() == {"FINISHED"}  # only makes the map
    assert bpy.ops.object.cotan_check() == {"FINISHED"}
    select(low, high)
    assert error_of(bake).startswith("'high' has no uv map")  # a linked detailed mesh is fine; the next error follows


def noMaterialIsNoProblem():
    settings(distance=2)
    low = square()
    low.data.materials.append(None)
    select(ball(), low)
    assert bpy.ops.object.cotan_bake() == {"FINISHED"}
    assert low.material_slots[0].material.name == "low"


def aMaterialWithoutPrincipled():
    settings(distance=2)
    low = square()
    material = material_with_nodes("emits")
    material.node_tree.nodes.clear()
    low.data.materials.append(material)
    select(ball(), low)
    assert bpy.ops.object.cotan_bake() == {"FINISHED"}
    assert {n.type for n in material.node_tree.nodes} == {"TEX_IMAGE", "NORMAL_MAP"}


def filesThatCannotBeWritten():
    settings(store="FILE", folder="//")
    select(ball(), square())
    expect("The maps' folder is beside the .blend file, which is not saved yet", bake)
    settings(store="FILE", folder=os.path.join(facts.FOLDER, "missing"))
    expect("There is no folder", bake)
    select(bpy.data.objects["low"])
    expect("", export, filepath=OUT)
    assert os.path.exists(OUT)
    found = error_of(export, filepath=os.path.join(facts.FOLDER, "missing", "out.glb"))
    assert "missing" in found and "does not exist" in found, found


def oneFailureDoesNotStopTheOthers():
    settings(distance=2)
    square("a_low", matrix=moved(5))
    ball("a_high", matrix=moved(5))
    bad = square("b_low")
    bad.data.uv_layers.remove(bad.data.uv_layers[0])
    ball("b_high")
    select()
    assert bpy.ops.object.cotan_bake(which="NAMES") == {"FINISHED"}
    assert [i.name for i in bpy.data.images] == ["a_low_normal"]


def aMapTooLargeForMemory():
    settings(width=16384, height=16384)
    select(ball(), square())
    import resource

    limits = resource.getrlimit(resource.RLIMIT_AS)
    with open("/proc/self/statm") as file:
        used = int(file.read().split()[0]) * resource.getpagesize()
    resource.setrlimit(resource.RLIMIT_AS, (used + (256 << 20), limits[1]))
    try:
        found = error_of(bake)
    finally:
        resource.setrlimit(resource.RLIMIT_AS, limits)
    assert "memory" in found, found


facts.hold_all(__name__)
