# Runs inside Blender: loads LOW and HIGH (OBJ files) and bakes the normals with Cycles. Run by bench/against-blender,
# it prints the wall-clock and processor seconds of the bake alone:
# blender -b --factory-startup -P blender_bake.py -- LOW HIGH SIZE THREADS [FOLDER]
# FOLDER receives the image, blender.png, and the meshes as Blender had them, low.obj and high.obj.
import os
import resource
import sys
import time

import bpy


def load(file):
    before = set(bpy.data.objects)
    if hasattr(bpy.ops.wm, "obj_import"):
        bpy.ops.wm.obj_import(filepath=file)
    else:
        bpy.ops.import_scene.obj(filepath=file)
    made = [o for o in bpy.data.objects if o not in before and o.type == "MESH"]
    if len(made) != 1:
        sys.exit(f"{file}: expected one mesh, found {len(made)}")
    # Merges vertices that the file splits at seams and uses Blender's own normals: Blender bakes the file's normals
    # only if faces are marked smooth, which changes them.
    bpy.context.view_layer.objects.active = made[0]
    if made[0].data.has_custom_normals:
        bpy.ops.mesh.customdata_custom_splitnormals_clear()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.remove_doubles(threshold=1e-7)
    bpy.ops.object.mode_set(mode="OBJECT")
    if bpy.app.version < (4, 1, 0):
        made[0].data.use_auto_smooth = False
    for polygon in made[0].data.polygons:
        polygon.use_smooth = True
    return made[0]


def keep(thing, file):
    bpy.ops.object.select_all(action="DESELECT")
    thing.select_set(True)
    bpy.ops.wm.obj_export(filepath=file, export_selected_objects=True, export_normals=True, export_uv=True,
                          export_materials=False)


# Creates a scene with both meshes, selected for a bake, and an image for Cycles. Returns low, high and the image.
def prepare(low_file, high_file, size, threads):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 1
    scene.cycles.use_denoising = False
    if threads > 0:
        scene.render.threads_mode = "FIXED"
        scene.render.threads = threads
    low, high = load(low_file), load(high_file)
    image = bpy.data.images.new("baked", size, size, float_buffer=False)
    image.colorspace_settings.name = "Non-Color"
    material = bpy.data.materials.new("low")
    if bpy.app.version < (5, 0, 0):  # later ones always do
        material.use_nodes = True
    node = material.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    material.node_tree.nodes.active = node
    low.data.materials.clear()
    low.data.materials.append(material)
    bpy.ops.object.select_all(action="DESELECT")
    high.select_set(True)
    low.select_set(True)
    bpy.context.view_layer.objects.active = low
    return low, high, image


# A twentieth of the diagonal of the high mesh's box, the default distance of `cotan bake`.
def reach_of(high):
    return 0.05 * sum(d * d for d in high.dimensions) ** 0.5


def bake_with_cycles(high):
    reach = reach_of(high)
    bpy.ops.object.bake(type="NORMAL", use_selected_to_active=True, cage_extrusion=reach, max_ray_distance=2 * reach,
                        margin=0, use_clear=True)


# Returns the wall-clock and processor seconds of a call.
def timed(call):
    start, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_SELF)
    call()
    after = resource.getrusage(resource.RUSAGE_SELF)
    return time.perf_counter() - start, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    low_file, high_file, size, threads = sys.argv[sys.argv.index("--") + 1:][:4]
    folder = "".join(sys.argv[sys.argv.index("--") + 5:])
    low, high, image = prepare(low_file, high_file, int(size), int(threads))
    wall, used = timed(lambda: bake_with_cycles(high))
    if folder:
        image.filepath_raw = os.path.join(folder, "blender.png")
        image.file_format = "PNG"
        image.save()
        keep(low, os.path.join(folder, "low.obj"))
        keep(high, os.path.join(folder, "high.obj"))
    print(f"blender-bake {wall:.3f} {used:.3f}")


if __name__ == "__main__":
    main()
