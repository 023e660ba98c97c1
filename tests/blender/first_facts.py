"""Where detail is in front of other detail, the add-on's maps equal those of Blender's own baker."""

import bpy
import facts
import numpy as np
from facts import ball, baked, degrees, directions, make_mesh, material_with_nodes, moved, select, square

SIZE = 128


def _joined(*parts):
    select(*parts)
    bpy.ops.object.join()
    bpy.context.object.name = "high"
    return bpy.context.object


def _cube(name, half):
    corners = [(x, y, z) for x in (-half, half) for y in (-half, half) for z in (-half, half)]
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return make_mesh(name, corners, faces, smooth=False)


def _by_cycles(low, high, extrusion, use_cage):
    """Blender's own map of the same pair, with smooth directions if it uses a cage, else straight."""
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.device, scene.cycles.samples = "CYCLES", "CPU", 1
    scene.cycles.use_denoising = False
    image = bpy.data.images.new("cycles", SIZE, SIZE, float_buffer=False)
    image.colorspace_settings.name = "Non-Color"
    material = material_with_nodes("cycles")
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    material.node_tree.nodes.active = node
    low.data.materials.clear()
    low.data.materials.append(material)
    select(high, low)
    bpy.ops.object.bake(
        type="NORMAL", use_selected_to_active=True, use_cage=use_cage, cage_extrusion=extrusion, max_ray_distance=0,
        margin=0, use_clear=True,
    )  # fmt: skip
    return directions(image)


def _expect_the_same(low, high, extrusion, least):
    low.modifiers.new("three corners", "TRIANGULATE")
    for rays, use_cage in (("AVERAGED", True), ("AUTO", False)):
        _expect_the_same_with(low, high, extrusion, least, rays, use_cage)


def _expect_the_same_with(low, high, extrusion, least, rays, use_cage):
    found = baked(low, high, directions=rays, width=SIZE, height=SIZE, bits="8", assign=False)
    theirs = _by_cycles(low, high, extrusion, use_cage)
    known = np.linalg.norm(theirs, axis=-1) > 0.5
    known &= np.abs(theirs + 1).max(axis=-1) > 0.05  # black: no surface
    apart = degrees(found[known], theirs[known])
    # A texel on the rim of a part may fall on either side.
    assert known.sum() > 0.5 * SIZE * SIZE and (apart > 1).mean() < 0.01, ((apart > 1).mean(), known.sum())
    leaning = degrees(found[known], (0, 0, 1)) > 5
    assert leaning.mean() > least, leaning.mean()


def detachedPartsAreInBothMaps():
    parts = [square("ground", half=2)]
    for x in (-0.5, 0.5):
        for y in (-0.5, 0.5):
            parts.append(ball("part", centre=(0, 0, 0), radius=0.25, cells=48, matrix=moved(x, y, 0.02)))
    _expect_the_same(square(), _joined(*parts), 0.4, 0.1)


def partsDetachedFromACubeAreInBothMaps():
    parts = [_cube("block", 1)]
    for x in (-0.5, 0.5):
        parts.append(ball("part", centre=(0, 0, 0), radius=0.3, cells=48, matrix=moved(x, 0, 0.95)))
    low = _cube("low", 1)
    select(low)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(island_margin=0.02)
    bpy.ops.object.mode_set(mode="OBJECT")
    _expect_the_same(low, _joined(*parts), 0.5, 0.01)


def aPlateShowsItsUpperSide():
    plate = _cube("high", 1)
    plate.scale = (1, 1, 0.01)
    bpy.context.view_layer.update()
    low = square(z=-0.001)
    found = baked(low, plate, width=SIZE, height=SIZE)
    assert degrees(found, (0, 0, 1)).max() < 0.01
    found = baked(low, plate, cage="NEAREST", width=SIZE, height=SIZE)
    assert degrees(found, (0, 0, -1)).max() < 0.01  # the lower side, as in older versions


facts.hold_all(__name__)
