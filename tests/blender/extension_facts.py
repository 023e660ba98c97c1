"""The zip as an extension of Blender 4.2 and newer, after `blender --command extension install-file --enable`: it bakes
with the library inside, beside Blender's own Embree. scripts/try-carried runs it."""

import sys

import addon_utils
import bpy

NAME = "bl_ext.user_default.cotan_blender"


def expect(holds, what):
    if not holds:
        print(f"[FAIL] {what}")
        sys.exit(1)


expect(addon_utils.check(NAME) == (True, True), "the extension is enabled")
for thing in ("Cube", "Camera", "Light"):
    bpy.data.objects.remove(bpy.data.objects[thing])
bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=5)
high = bpy.context.object
bpy.ops.mesh.primitive_uv_sphere_add()
low = bpy.context.object
high.select_set(True)
bpy.context.scene.cotan.width = bpy.context.scene.cotan.height = 64
expect(bpy.ops.object.cotan_bake() == {"FINISHED"}, "it bakes")
image = bpy.data.images[f"{low.name}_normal"]
expect(tuple(image.size) == (64, 64) and min(image.pixels[:][2::4]) > 0.4, "the map has normals that point outwards")
expect("/extensions/user_default/" in sys.modules[f"{NAME}.cotan"].library_path(), "with the library inside")
with open("/proc/self/maps") as maps:
    embrees = {line.split()[-1].split("/")[-1] for line in maps if "/libembree" in line}
expect(len(embrees) == 2, f"beside Blender's own Embree: {embrees}")
print("[ OK ] the extension is enabled and bakes")
