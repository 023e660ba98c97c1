"""Maps compared with exact results: a square below spheres and tori, in all the ways that Blender makes meshes."""

import math
import os

import bpy
import cotan
import facts
import numpy as np
from facts import NEAR, baked, ball, degrees, directions, expect_sphere, make_mesh, moved, of_sphere, select, settings
from facts import square, texel_centres, torus
from mathutils import Euler, Matrix


def aSphereHasItsOwnNormals():
    x, y = texel_centres()
    for frame in ("mikktspace", "smooth", "cotangent", "orthonormal", "triangle", "vertex"):
        expect_sphere(baked(square(), ball(), frame=frame, distance=2), x, y)
        bpy.data.objects.remove(bpy.data.objects["low"])
        bpy.data.objects.remove(bpy.data.objects["high"])


def aTorusHasItsOwnNormals():
    x, y = texel_centres()
    bpy.context.scene.render.bake.cage_extrusion = 1  # the nearest surface could also be the lower half
    found = baked(square(), torus(), cage="BLENDER")
    r = np.hypot(x, y)
    side = (r - 0.6) / 0.3
    on = np.abs(side) < 0.9
    truth = np.stack([side * x / r, side * y / r, np.sqrt(np.maximum(1 - side * side, 0))], -1)
    assert on.sum() > 1000 and degrees(found[on], truth[on]).max() < 0.1, degrees(found[on], truth[on]).max()


def objectTransformsAreApplied():
    x, y = texel_centres()
    turned = moved(3, -2, 5) @ Euler((0.7, -1.1, 2.3)).to_matrix().to_4x4() @ Matrix.Scale(2.5, 4)
    # Both meshes have their own transforms; together they are the square and the sphere.
    high = ball(centre=(0, 0, -3), matrix=turned @ moved(0, 0, 3))
    low = square(matrix=turned)
    expect_sphere(baked(low, high, distance=5), x, y)


def mirroredObjectsKeepTheirBumps():
    x, y = texel_centres()
    mirrored = Matrix.Diagonal((-1, 1, 1, 1))
    expect_sphere(baked(square(matrix=mirrored), ball(centre=(0.25, 0.1, 0)), distance=2), x + 0.25, y - 0.1, least=500)
    # The reverse, too: a mirrored detailed mesh.
    bpy.data.objects.remove(bpy.data.objects["high"])
    high = ball("mirror", centre=(0.25, 0.1, 0), matrix=mirrored)
    expect_sphere(baked(square("other"), high, distance=2), x + 0.25, y - 0.1, least=500)


def stretchedDetailHasTheNormalsOfTheEllipsoid():
    x, y = texel_centres()
    found = baked(square(), ball(matrix=Matrix.Diagonal((1, 0.5, 1, 1))), distance=2)
    truth, inside = of_sphere(x, 2 * y)
    truth = truth * (1, 2, 1)
    assert inside.sum() > 500 and degrees(found[inside], truth[inside]).max() < NEAR


def instancesOfACollectionCount():
    x, y = texel_centres()
    high = ball()
    hidden = bpy.data.collections.new("parts")
    bpy.context.collection.objects.unlink(high)
    hidden.objects.link(high)
    empty = bpy.data.objects.new("placed", None)
    empty.instance_type, empty.instance_collection = "COLLECTION", hidden
    empty.matrix_world = moved(0.3, -0.2) @ Matrix.Scale(0.5, 4)
    bpy.context.collection.objects.link(empty)
    expect_sphere(baked(square(), empty, distance=2), x - 0.3, y + 0.2, 0.5, least=500)


def instancesOnVerticesCount():
    x, y = texel_centres()
    high = ball(radius=0.4, cells=64)
    parent = make_mesh("points", [(-0.5, 0, 0), (0.5, 0, 0)], [])
    parent.instance_type = "VERTS"
    high.parent = parent
    found = baked(square(), parent, distance=2)
    for centre in (-0.5, 0.5):
        truth, inside = of_sphere(x - centre, y, 0.4)
        assert inside.sum() > 300 and degrees(found[inside], truth[inside]).max() < 0.1


def instancesOfGeometryNodesCount():
    x, y = texel_centres()
    high = ball(radius=0.5, centre=(0, 0, 0), matrix=moved(9))
    placer = make_mesh("placer", [(0, 0, 0)], [], matrix=moved(0.2, -0.3))
    tree = bpy.data.node_groups.new("place", "GeometryNodeTree")
    if hasattr(tree, "interface"):  # since Blender 4.0
        tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    else:
        tree.outputs.new("NodeSocketGeometry", "Geometry")
    info, out = tree.nodes.new("GeometryNodeObjectInfo"), tree.nodes.new("NodeGroupOutput")
    info.inputs["Object"].default_value, info.inputs["As Instance"].default_value = high, True
    tree.links.new(info.outputs["Geometry"], out.inputs[0])
    placer.modifiers.new("place", "NODES").node_group = tree
    expect_sphere(baked(square(), placer, distance=2), x - 0.2, y + 0.3, 0.5, least=500)


def textAndCurvesCount():
    curve = bpy.data.curves.new("disc", "CURVE")
    curve.dimensions, curve.fill_mode = "2D", "BOTH"
    spline = curve.splines.new("POLY")
    spline.points.add(3)
    for point, (x, y) in zip(spline.points, ((-2, -2), (2, -2), (2, 2), (-2, 2))):
        point.co = (x, y, 0, 1)
    spline.use_cyclic_u = True
    disc = bpy.data.objects.new("disc", curve)
    disc.matrix_world = moved(z=-0.2) @ Matrix.Rotation(0.1, 4, "Y")
    bpy.context.collection.objects.link(disc)
    assert degrees(baked(square(), disc, distance=2), (math.sin(0.1), 0, math.cos(0.1))).max() < 0.01


def modifiersAreApplied():
    x, y = texel_centres()
    high = ball(centre=(-0.5, 0, 0), radius=0.45)
    array = high.modifiers.new("twice", "ARRAY")
    array.use_relative_offset, array.use_constant_offset, array.constant_offset_displace = False, True, (1, 0, 0)
    half = [(-1, -1, 0), (1, -1, 0), (1, 0, 0), (-1, 0, 0)]
    low = make_mesh("low", half, [(0, 1, 2, 3)], [(0, 0), (1, 0), (1, 0.5), (0, 0.5)])
    mirror = low.modifiers.new("both halves", "MIRROR")
    mirror.use_axis = (False, True, False)
    mirror.use_mirror_v = True
    found = baked(low, high, distance=2)
    for centre in (-0.5, 0.5):
        truth, inside = of_sphere(x - centre, y, 0.45)
        assert inside.sum() > 400 and degrees(found[inside], truth[inside]).max() < NEAR


def subdivisionUsesRenderLevelsAndIsRestored():
    high = make_mesh("high", [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2, 3)])
    subdivided = high.modifiers.new("fine", "SUBSURF")
    subdivided.levels, subdivided.render_levels, subdivided.show_viewport = 0, 4, False
    from cotan_blender import meshes

    for wanted, faces in ((True, 4**4), (False, 1)):
        with meshes.as_rendered(bpy.context, [high], wanted) as depsgraph:
            surface = meshes.high_surfaces([high], depsgraph)[0]
        assert len(surface.triangles) == 2 * faces, len(surface.triangles)
        assert (subdivided.levels, subdivided.show_viewport) == (0, False)


def shapeKeysAreMixedIn():
    x, y = texel_centres()
    high = ball()
    high.shape_key_add(name="Basis")
    key = high.shape_key_add(name="aside")
    for point in key.data:
        point.co.x += 0.6
    key.value = 0.5
    expect_sphere(baked(square(), high, distance=2), x - 0.3, y)


def theChosenUvMapCounts():
    x, y = texel_centres()
    low, high = square(), ball(centre=(0.3, 0.1, 0))
    turned = low.data.uv_layers.new(name="turned")  # rotated by 90 degrees: u along y, v against x
    for loop in low.data.loops:
        co = low.data.vertices[loop.vertex_index].co
        turned.data[loop.index].uv = ((co.y + 1) / 2, (1 - co.x) / 2)
    expect_sphere(baked(low, high, distance=2), x - 0.3, y - 0.1)
    found = baked(low, high, distance=2, uv_map="turned")
    # The image's x is the world's y and its y the world's -x, and normals follow.
    truth, inside = of_sphere(-y - 0.3, x - 0.1)
    truth = np.stack([truth[..., 1], -truth[..., 0], truth[..., 2]], -1)
    assert degrees(found[inside], truth[inside]).max() < NEAR
    reader = next(n for n in low.data.materials[0].node_tree.nodes if n.type == "NORMAL_MAP")
    assert reader.uv_map == "turned"
    texture = reader.inputs["Color"].links[0].from_node
    assert texture.inputs["Vector"].links[0].from_node.uv_map == "turned"


def customNormalsCount():
    high = square("high")
    leaning = (math.sin(0.3), 0, math.cos(0.3))
    facts.set_custom_normals(high, leaning)
    found = baked(square(), high, distance=1)
    assert degrees(found, leaning).max() < 0.02  # Blender stores them in 16 bits


def customNormalsOfTheSimpleMeshCount():
    # The surface is tilted by 0.2 from its normals, so the flat detail is tilted the opposite way.
    low = square()
    facts.set_custom_normals(low, (math.sin(0.2), 0, math.cos(0.2)))
    found = baked(low, square("high", half=4, z=0.01), frame="orthonormal", distance=1)
    assert degrees(found, (-math.sin(0.2), 0, math.cos(0.2))).max() < 0.02


def flatFacesStayFlat():
    # A roof over the y axis: if smooth, it would have one normal on the ridge.
    corners = [(-1, -1, 0), (0, -1, 0.5), (1, -1, 0), (1, 1, 0), (0, 1, 0.5), (-1, 1, 0)]
    roof = make_mesh("high", corners, [(0, 1, 4, 5), (1, 2, 3, 4)], smooth=False)
    found = baked(square(), roof, distance=1)
    assert degrees(found[:, :32], (-0.5, 0, 1)).max() < 0.01 and degrees(found[:, 32:], (0.5, 0, 1)).max() < 0.01


def nGonsAreTriangulatedLikeInBlender():
    # A concave pentagon: a fan from its first corner would leave it.
    outline = [(-1, -1), (1, -1), (1, 1), (0, -0.5), (-1, 1)]
    uv = [((x + 1) / 2, (y + 1) / 2) for x, y in outline]
    low = make_mesh("low", [(x, y, 0) for x, y in outline], [(0, 1, 2, 3, 4)], uv)
    found = baked(low, square("high", half=3, z=0.1), distance=1, width=128, height=128, bits="8")
    image = bpy.data.images["low_normal"]
    from cotan_blender import meshes

    with meshes.as_rendered(bpy.context, [low]) as depsgraph:
        surface = meshes.low_surface(low, depsgraph)
    corners = surface.positions[surface.triangles]
    area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2] / 2
    assert len(area) == 3 and (area > 0).all() and abs(area.sum() - 2.5) < 1e-6, area
    assert tuple(image.size) == (128, 128) and degrees(found, (0, 0, 1)).max() < 0.33  # 128 is 0.5 / 127.5


def eachMaterialCanHaveItsOwnMap():
    # Two adjacent faces that both cover the whole uv square; each has a hill of its own.
    outline = [(-2, -1), (0, -1), (0, 1), (-2, 1), (2, -1), (2, 1)]
    low = make_mesh("low", [(x, y, 0) for x, y in outline], [(0, 1, 2, 3), (1, 4, 5, 2)], [(0, 0)] * 6)
    for polygon in low.data.polygons:
        for loop, uv in zip(polygon.loop_indices, [(0, 0), (1, 0), (1, 1), (0, 1)]):
            low.data.uv_layers[0].data[loop].uv = uv
    for name in ("left", "right"):
        low.data.materials.append(bpy.data.materials.new(name))
    low.data.polygons[1].material_index = 1
    settings(each_material=True, distance=2)
    select(ball("a", (-1.2, 0, 0)), ball("b", (1.3, 0.2, 0)), low)
    assert bpy.ops.object.cotan_bake() == {"FINISHED"}
    x, y = texel_centres()
    expect_sphere(directions(bpy.data.images["low_left_normal"]), x + 0.2, y)
    expect_sphere(directions(bpy.data.images["low_right_normal"]), x - 0.3, y - 0.2)
    for name in ("left", "right"):
        used = [n.image.name for n in bpy.data.materials[name].node_tree.nodes if n.type == "TEX_IMAGE"]
        assert used == [f"low_{name}_normal"], used
    # One map for both materials, which both use.
    settings(each_material=False, distance=2)
    assert bpy.ops.object.cotan_bake() == {"FINISHED"}
    for name in ("left", "right"):
        used = [n.image.name for n in bpy.data.materials[name].node_tree.nodes if n.type == "TEX_IMAGE"]
        assert used == ["low_normal"], used


def raysFollowVertexColorsAndAMask():
    # Two cubes with hard edges, one mirrored, in a sphere: straight and averaged rays hit it elsewhere.
    mask = bpy.data.images.new("mask", 64, 64)
    red = np.zeros((64, 64, 4), np.float32)  # rows from the bottom: straight in the lower half
    red[:32, :, 0] = red[:, :, 3] = 1
    mask.pixels = red.ravel().tolist()
    for name, matrix in (("first", moved(1, 2, 3)), ("second", Matrix.Diagonal((-2, 2, 2, 1)))):
        bpy.ops.mesh.primitive_cube_add()
        low = bpy.context.object
        low.name = name
        bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=2)
        high = bpy.context.object
        bpy.ops.object.shade_smooth()
        low.matrix_world, high.matrix_world = matrix, matrix @ moved(0.2, 0.1)
        facts.painted(low, "Straight", (1, 0, 0))
        unnamed = facts.painted(low, "", (0, 1, 1), "POINT", "FLOAT_COLOR")

        def map_of(directions, **more):
            return baked(low, high, distance=4, directions=directions, **{"rays_mask": None, "rays_colors": "", **more})

        straight, averaged = map_of("STRAIGHT"), map_of("AVERAGED")
        apart, same = degrees(straight, averaged), 0.003  # a step of 16 bits
        assert apart[33:].max() > 5 and apart[:31].max() > 5
        active = map_of("VERTEX_COLOR")  # that without a name of its own
        assert degrees(active, averaged).max() < same
        assert degrees(map_of("VERTEX_COLOR", rays_colors=unnamed), averaged).max() < same
        assert degrees(map_of("VERTEX_COLOR", rays_colors="Straight"), straight).max() < same
        for directions in ("AUTO", "VERTEX_COLOR"):  # which the mask replaces
            both = map_of(directions, rays_mask=mask)
            assert degrees(both[33:], straight[33:]).max() < same
            assert degrees(both[:31], averaged[:31]).max() < same
        select(high, low)
        settings(directions="VERTEX_COLOR", rays_mask=None, rays_colors="Missing")
        text = facts.error_of(bpy.ops.object.cotan_bake)
        assert text == f"'{name}' has no color attribute 'Missing'", text
        settings(rays_mask=bpy.data.images.new("empty", 0, 0))
        empty = bpy.context.scene.cotan.rays_mask
        empty.source, empty.filepath = "FILE", os.path.join(facts.FOLDER, "nowhere.png")
        text = facts.error_of(bpy.ops.object.cotan_bake)
        assert text == f"'{empty.name}' has no pixels, or its file is missing", text


def two_hills():
    """A flat square above, and one tilted along x below, behind the simple mesh."""
    near = square("near", half=2, z=0.5)
    far = make_mesh("far", [(-2, -2, -0.8), (2, -2, -0.4), (2, 2, -0.4), (-2, 2, -0.8)], [(0, 1, 2, 3)])
    return near, far, (-0.1, 0, 1)


def blendersOwnCageCounts():
    near, far, leaning = two_hills()
    low, bake = square(), bpy.context.scene.render.bake
    # The nearer one is 0.5 above, the tilted one 0.4 to 0.8 below.
    flat = (0, 0, 1)
    for extrusion, distance, truth in ((0.6, 0, flat), (0.3, 0, leaning), (0.3, 1.3, leaning), (0.6, 0.2, flat)):
        for use_cage in (False, True):
            bake.cage_extrusion, bake.max_ray_distance, bake.use_cage = extrusion, distance, use_cage
            found = baked(low, near, far, cage="BLENDER")
            assert degrees(found, truth).max() < 0.01, (extrusion, distance, use_cage)
    # A ray of 0.9 from 0.3 above ends before the left half of the lower square: those texels are flat.
    bake.cage_extrusion, bake.max_ray_distance = 0.3, 0.9
    found = baked(low, near, far, cage="BLENDER")
    assert degrees(found[:, 40:], leaning).max() < 0.01 and degrees(found[:, :24], (0, 0, 1)).max() < 0.01
    # Extrusion is in the space of the simple mesh, as in Blender: twice the distance at twice the size.
    big = square("big", matrix=Matrix.Scale(2, 4))
    bake.cage_extrusion, bake.max_ray_distance = 0.29, 0
    assert degrees(baked(big, near, cage="BLENDER"), (0, 0, 1)).max() < 0.01
    bake.use_cage, bake.cage_object, bake.max_ray_distance = True, square("cage", z=0.45), 0
    assert degrees(baked(low, near, far, cage="BLENDER"), leaning).max() < 0.01
    bake.cage_object.location.z = 0.1
    bpy.context.view_layer.update()
    assert degrees(baked(low, near, far, cage="BLENDER"), (0, 0, 1)).max() < 0.01


def aMeshIsACage():
    near, far, leaning = two_hills()
    low = square()
    assert degrees(baked(low, near, far, cage="MESH", cage_object=square("cage", z=1)), (0, 0, 1)).max() < 0.01
    bpy.data.objects["cage"].location.z = -0.4  # from 0.6 above to 0.6 below: the right half of the tilted square
    bpy.context.view_layer.update()
    found = baked(low, far, cage="MESH")
    assert degrees(found[:, 40:], leaning).max() < 0.01 and degrees(found[:, :24], (0, 0, 1)).max() < 0.01
    bpy.data.objects.remove(bpy.data.objects["cage"])
    one = make_mesh("cage", [(0, 0, 1), (1, 0, 1), (0, 1, 1)], [(0, 1, 2)])
    settings(cage="MESH", cage_object=one)
    select(near, low)
    text = facts.error_of(bpy.ops.object.cotan_bake)
    assert text.startswith("The cage 'cage' has 3 vertices, 'low' has 4"), text


def theMapEqualsThatOfTheCommandLine():
    # A hull of few faces around a bumpy ball, tilted in the world, whose uv have many charts.
    bpy.ops.mesh.primitive_uv_sphere_add(segments=20, ring_count=12, radius=1.02)
    low = bpy.context.object
    low.name = "low"
    bpy.ops.object.shade_smooth()
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=6)
    high = bpy.context.object
    high.name = "high"
    bpy.ops.object.shade_smooth()
    for vertex in high.data.vertices:
        vertex.co *= 1 + 0.03 * math.sin(9 * vertex.co.x) * math.sin(7 * vertex.co.y + 5 * vertex.co.z)
    for each in (low, high):
        each.modifiers.new("triangles", "TRIANGULATE")
        each.matrix_world = moved(1, 2, 3) @ Euler((0.3, 0.4, 0.5)).to_matrix().to_4x4()
    files = facts.exported("low", low), facts.exported("high", high)
    for frame in ("mikktspace", "smooth", "cotangent"):
        ours = baked(low, high, frame=frame, width=256, height=256, samples="4")  # the default of both
        out = os.path.join(facts.FOLDER, f"{frame}.png")
        words = ["--frame", frame, "--size", "256x256", "--bits", "16", "--padding", "-1", "--tangents", "generated"]
        facts.command("bake", "--low", files[0], "--high", files[1], *words, "-o", out)
        theirs = (cotan.read_image(out)[..., :3].astype(float) - 32768) / 32767
        off = degrees(ours, theirs)
        assert off.mean() < 0.01, (frame, off.mean(), off.max())
        assert degrees(ours, (0, 0, 1)).mean() > 1  # so that the comparison means something


def baked_by_cycles(low, high, size=128):
    """The same by Blender's own baker: (size, size, 3), rows from the top."""
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 1, False
    image = bpy.data.images.new("cycles", size, size, float_buffer=True)
    image.colorspace_settings.name = "Non-Color"
    nodes = low.material_slots[0].material.node_tree.nodes
    nodes.active = nodes.new("ShaderNodeTexImage")
    nodes.active.image = image
    select(high, low)
    bpy.ops.object.bake(type="NORMAL", use_selected_to_active=True, margin=0, use_clear=True, cage_extrusion=0.1)
    values = np.empty(size * size * 4, np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(size, size, 4)[::-1, :, :3].astype(float) * 2 - 1


def theMapMatchesThatOfCycles():
    bpy.ops.mesh.primitive_uv_sphere_add(segments=20, ring_count=12)
    low = bpy.context.object
    bpy.ops.object.shade_smooth()
    low.modifiers.new("triangles", "TRIANGULATE")
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=6)
    high = bpy.context.object
    bpy.ops.object.shade_smooth()
    for vertex in high.data.vertices:
        vertex.co *= 1 + 0.03 * math.sin(9 * vertex.co.x) * math.sin(7 * vertex.co.y + 5 * vertex.co.z)
    turned = moved(1, 2, 3) @ Euler((0.3, 0.4, 0.5)).to_matrix().to_4x4()
    for matrix in (turned, turned @ Matrix.Diagonal((-1.5, 1.5, 1.5, 1))):
        low.matrix_world = high.matrix_world = matrix
        bpy.context.view_layer.update()
        bpy.context.scene.render.bake.cage_extrusion = 0.1
        ours = baked(low, high, width=128, height=128, cage="BLENDER")
        theirs = baked_by_cycles(low, high)
        both = np.abs(np.linalg.norm(theirs, axis=-1) - 1) < 0.01
        off = degrees(ours[both], theirs[both])
        # The rims of charts are filled differently; everywhere else rays and tangents are equal to 16 bits.
        assert both.mean() > 0.8 and np.median(off) < 0.01 and np.quantile(off, 0.95) < 0.1, np.median(off)


facts.hold_all(__name__)
