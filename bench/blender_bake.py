# Run by bench/against-blender inside Blender: bakes the normals of HIGH onto LOW (OBJ files) with Cycles and prints
# the seconds of the bake alone. blender -b --factory-startup -P blender_bake.py -- LOW HIGH SIZE THREADS [PICTURE]
import resource
import sys
import time

import bpy

low_file, high_file, size, threads = sys.argv[sys.argv.index("--") + 1:][:4]
picture = sys.argv[sys.argv.index("--") + 5:]
size, threads = int(size), int(threads)


def load(file):
    before = set(bpy.data.objects)
    if hasattr(bpy.ops.wm, "obj_import"):
        bpy.ops.wm.obj_import(filepath=file)
    else:
        bpy.ops.import_scene.obj(filepath=file)
    made = [o for o in bpy.data.objects if o not in before and o.type == "MESH"]
    if len(made) != 1:
        sys.exit(f"{file}: expected one mesh, found {len(made)}")
    for polygon in made[0].data.polygons:
        polygon.use_smooth = True
    return made[0]


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
# A twentieth of the high mesh's box either way, as `cotan bake` has it.
reach = 0.05 * sum(d * d for d in high.dimensions) ** 0.5
start = time.perf_counter()
processor = resource.getrusage(resource.RUSAGE_SELF)
bpy.ops.object.bake(type="NORMAL", use_selected_to_active=True, cage_extrusion=reach, max_ray_distance=2 * reach,
                    margin=0, use_clear=True)
after = resource.getrusage(resource.RUSAGE_SELF)
wall = time.perf_counter() - start
used = after.ru_utime + after.ru_stime - processor.ru_utime - processor.ru_stime
if picture:
    image.filepath_raw = picture[0]
    image.file_format = "PNG"
    image.save()
print(f"blender-bake {wall:.3f} {used:.3f}")
