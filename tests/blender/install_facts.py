"""The add-on as a user gets it: the zip is installed, enabled, used and disabled by Blender's own operators."""

import os
import sys

import addon_utils
import bpy


def expect(holds, what):
    if not holds:
        print(f"[FAIL] {what}")
        sys.exit(1)


resources = os.environ["BLENDER_USER_RESOURCES"]
for name in ("cotan", "cotan_blender"):
    try:
        __import__(name)
        expect(False, f"{name} can be imported before anything is installed")
    except ImportError:
        pass
os.makedirs(resources, exist_ok=True)
bpy.ops.preferences.addon_install(filepath=os.environ["COTAN_ZIP"])
bpy.ops.preferences.addon_enable(module="cotan_blender")
expect(addon_utils.check("cotan_blender") == (True, True), "the add-on is enabled")
import cotan_blender

expect(cotan_blender.__file__.startswith(resources), "the add-on lies in the user's folder")
for thing in ("Cube", "Camera", "Light"):
    bpy.data.objects.remove(bpy.data.objects[thing])
bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
high = bpy.context.object
bpy.ops.mesh.primitive_uv_sphere_add()
low = bpy.context.object
high.select_set(True)
bpy.context.scene.cotan.width = bpy.context.scene.cotan.height = 64
expect(bpy.ops.object.cotan_bake() == {"FINISHED"}, "it bakes")
expect(tuple(bpy.data.images[f"{low.name}_normal"].size) == (64, 64), "the map is there")
from cotan_blender import cotan

expect(cotan.library_path().startswith(resources), "with the library from the zip")
expect(bpy.ops.object.cotan_check() == {"FINISHED"}, "it checks")
if bpy.context.mode != "OBJECT":
    bpy.ops.object.mode_set(mode="OBJECT")
out = os.path.join(resources, "out.glb")
expect(bpy.ops.export_scene.cotan_gltf(filepath=out) == {"FINISHED"} and os.path.getsize(out) > 1000, "it exports")
bpy.ops.preferences.addon_disable(module="cotan_blender")
expect(not hasattr(bpy.types.Scene, "cotan") and not hasattr(bpy.types, "OBJECT_PT_cotan"), "nothing of it is left")
expect("cotan_bake" not in dir(bpy.ops.object), "its operators are gone")
bpy.ops.preferences.addon_enable(module="cotan_blender")
expect(hasattr(bpy.types.Scene, "cotan"), "it can be enabled again")
print("[ OK ] installed, enabled, used, disabled")
