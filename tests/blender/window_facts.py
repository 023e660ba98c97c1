"""With a window: the panel is drawn, a bake shows its progress, Esc stops it, and the window stays responsive.

    window_facts.py"""

import os
import sys
import time
import traceback

import bpy
import cotan_blender
import facts

cotan_blender.panel.CotanPanel.bl_options = set()  # open
drawn = set()


def noting(real):
    def draw(self, context):
        real(self, context)
        drawn.add(self.bl_idname)

    return draw


for each in cotan_blender.panel.CLASSES:
    each.draw = noting(each.draw)
cotan_blender.register()
bpy.ops.wm.read_homefile(use_factory_startup=True)
for other in list(bpy.data.objects):
    bpy.data.objects.remove(other)


def context():
    window = bpy.context.window_manager.windows[0]
    area = next(a for a in window.screen.areas if a.type == "PROPERTIES")
    region = next(r for r in area.regions if r.type == "WINDOW")
    area.spaces.active.context = "OBJECT"
    return dict(window=window, area=area, region=region, screen=window.screen)


def steps():
    """Each yield returns to the window; it gives the maximum time in seconds, and a condition to wait for."""
    manager = bpy.context.window_manager
    high, low = facts.ball(cells=64), facts.square()
    facts.select(high, low)
    yield 0.5, None
    facts.settings(width=256, height=256, distance=2)
    with bpy.context.temp_override(**context()):
        assert bpy.ops.object.cotan_bake("INVOKE_DEFAULT") == {"RUNNING_MODAL"}
    assert manager.cotan_running
    yield 20, lambda: not manager.cotan_running
    image = bpy.data.images["low_normal"]
    assert tuple(image.size) == (256, 256) and low.data.materials[0].node_tree
    # Esc stops a bake that would take minutes at once, and nothing of it remains.
    low.data.materials.clear()
    bpy.data.images.remove(image)
    facts.settings(width=8192, height=8192, samples="16", distance=2)
    with bpy.context.temp_override(**context()):
        bpy.ops.object.cotan_bake("INVOKE_DEFAULT")
    yield 30, lambda: manager.cotan_progress > 0
    assert manager.cotan_running and manager.cotan_progress < 100
    yield 0.5, None
    window = manager.windows[0]
    start = time.monotonic()
    window.event_simulate(type="ESC", value="PRESS", x=400, y=400)
    window.event_simulate(type="ESC", value="RELEASE", x=400, y=400)
    yield 20, lambda: not manager.cotan_running
    assert time.monotonic() - start < 10, "Esc takes too long"
    assert not bpy.data.images.get("low_normal") and not low.data.materials
    # Another bake runs to the end after the stopped one.
    facts.settings(width=64, height=64, samples="1", distance=2)
    with bpy.context.temp_override(**context()):
        bpy.ops.object.cotan_bake("INVOKE_DEFAULT")
    yield 20, lambda: not manager.cotan_running
    assert bpy.data.images["low_normal"]
    for mask in (None, bpy.data.images.new("mask", 4, 4)):  # the fields that some settings add
        facts.settings(maps={"normal", "id"}, id_by="VERTEX_COLOR", directions="VERTEX_COLOR", rays_mask=mask)
        drawn.clear()
        context()["area"].tag_redraw()
        yield 5, lambda: "OBJECT_PT_cotan_bake" in drawn
    bpy.ops.object.cotan_check()
    yield 1, None
    assert drawn == {panel.bl_idname for panel in cotan_blender.panel.CLASSES}, drawn


def leave(code):
    sys.stdout.flush()
    os._exit(code)  # a modal operator may be running


def drive(state={"run": steps(), "until": 0.0, "waits_for": None}):
    try:
        waits_for = state["waits_for"]
        late = time.monotonic() > state["until"]
        if waits_for is not None and not waits_for():
            assert not late, "waited in vain"
            return 0.05
        if waits_for is None and not late:
            return 0.05
        seconds, state["waits_for"] = next(state["run"])
        state["until"] = time.monotonic() + seconds
        return 0.05
    except StopIteration:
        print("[ OK ] the window shows the bake, and Esc stops it")
        leave(0)
    except BaseException:
        print(f"[FAIL] the window\n{traceback.format_exc()}")
        leave(1)


bpy.app.timers.register(drive)
