"""Makes the images of docs/how-to/blender.md from a window on a display without a GPU:

    xvfb-run -a -s "-screen 0 1280x1000x24" blender --factory-startup -p 0 0 1280 1000 \\
        --python integrations/blender/screenshots.py -- FOLDER

Needs the add-on on the path of Blender's Python, as in tests/blender/run.py, or the installed add-on.
Writes blender-bake.png, blender-progress.png and blender-check.png.
"""

import os
import sys
import time
import traceback

import bpy
import cotan_blender
from mathutils import Vector, noise

folder = sys.argv[sys.argv.index("--") + 1]
cotan_blender.panel.CotanPanel.bl_options = set()  # open
cotan_blender.register()
bpy.context.preferences.view.show_splash = False


def area_of(kind):
    return next((a for a in bpy.context.window_manager.windows[0].screen.areas if a.type == kind), None)


def within(kind):
    """A context override for operators in an area of this type."""
    window, area = bpy.context.window_manager.windows[0], area_of(kind)
    region = next(r for r in area.regions if r.type == "WINDOW")
    return bpy.context.temp_override(window=window, screen=window.screen, area=area, region=region)


def arrange():
    """Places a 3D view and an image editor side by side, and the properties at full height."""
    for kind in ("OUTLINER", "DOPESHEET_EDITOR"):
        with within(kind):
            bpy.ops.screen.area_close()
    with within("VIEW_3D"):
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.5)
    views = [a for a in bpy.context.window_manager.windows[0].screen.areas if a.type == "VIEW_3D"]
    max(views, key=lambda a: a.x).ui_type = "IMAGE_EDITOR"
    space = area_of("VIEW_3D").spaces.active
    space.shading.type = "MATERIAL"
    space.overlay.show_floor = space.overlay.show_axis_x = space.overlay.show_axis_y = space.overlay.show_cursor = False
    area_of("PROPERTIES").spaces.active.context = "OBJECT"


def stone():
    """A worn stone and a coarse hull of it at the same position."""
    for other in list(bpy.data.objects):
        bpy.data.objects.remove(other)
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=7)
    high = bpy.context.view_layer.objects.active
    high.name = "stone_high"
    for vertex in high.data.vertices:
        p = vertex.co.copy()
        bulge = 0.12 * noise.noise(1.6 * p)
        cracks = -0.045 * max(0.0, 1 - 14 * abs(noise.noise(2.2 * p + Vector((7, 3, 1)))))
        grain = 0.012 * noise.noise(13 * p) + 0.006 * noise.noise(31 * p)
        vertex.co = p * (1 + bulge + cracks + grain)
    bpy.ops.object.shade_smooth()
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=14)
    low = bpy.context.view_layer.objects.active
    low.name = "stone_low"
    for vertex in low.data.vertices:
        vertex.co *= 1 + 0.12 * noise.noise(1.6 * vertex.co)
    bpy.ops.object.shade_smooth()
    low.modifiers.new("Triangulate", "TRIANGULATE")
    material = bpy.data.materials.new("stone")
    if bpy.app.version < (5, 0, 0):  # later ones always do
        material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (0.35, 0.3, 0.25, 1)
    shader.inputs["Roughness"].default_value = 0.55
    low.data.materials.append(material)
    high.select_set(True)
    return high, low


def shoot(name):
    bpy.ops.screen.screenshot(filepath=os.path.join(folder, name))


def steps():
    """Yields the seconds to wait while the window is redrawn."""
    manager, settings = bpy.context.window_manager, bpy.context.scene.cotan
    arrange()
    with within("VIEW_3D"):
        high, low = stone()
        bpy.ops.view3d.view_selected()
    yield 2
    with within("PROPERTIES"):
        for _ in range(40):
            bpy.ops.view2d.scroll_down(deltay=-30)
    low.display_type = "WIRE"
    settings.width = settings.height = 4096
    settings.samples = "16"
    yield 1
    with within("PROPERTIES"):
        bpy.ops.object.cotan_bake("INVOKE_DEFAULT")
    while manager.cotan_progress < 40:
        yield 0.1
    with within("PROPERTIES"):
        bpy.ops.view2d.scroll_up(deltay=30)  # to the first field: the panel has shrunk
    yield 0.5
    shoot("blender-progress.png")
    while manager.cotan_running:
        yield 0.2
    settings.width = settings.height = 1024
    settings.samples = "4"
    with within("PROPERTIES"):
        bpy.ops.object.cotan_bake("INVOKE_DEFAULT")
    while manager.cotan_running:
        yield 0.2
    high.hide_set(True)
    low.display_type = "TEXTURED"
    area_of("IMAGE_EDITOR").spaces.active.image = bpy.data.images["stone_low_normal"]
    with within("IMAGE_EDITOR"):
        bpy.ops.image.view_all(fit_view=True)
    yield 4
    shoot("blender-bake.png")
    with within("PROPERTIES"):
        bpy.ops.object.cotan_check()
    yield 1
    with within("PROPERTIES"):
        for _ in range(60):
            bpy.ops.view2d.scroll_down(deltay=-30)
    yield 3
    shoot("blender-check.png")
    yield 1


def drive(run=steps(), state={"until": 0.0}):
    try:
        if time.monotonic() > state["until"]:
            state["until"] = time.monotonic() + next(run)
        return 0.05
    except StopIteration:
        code = 0
    except BaseException:
        traceback.print_exc()
        code = 1
    sys.stdout.flush()
    os._exit(code)


bpy.app.timers.register(drive)
