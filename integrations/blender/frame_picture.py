"""Renders docs/pictures/blender-frame.jpg: a vase in detail, and a coarse one with a map for `cotangent`, with
Blender's own node and with Cotan's frame:

    blender -b --factory-startup --python-exit-code 1 --python integrations/blender/frame_picture.py -- FOLDER

Needs the add-on on the path of Blender's Python, as in tests/blender/run.py, or the installed add-on."""

import os
import sys

import bpy
import cotan_blender
import numpy as np
from mathutils import Euler

SHEAR = 0.2
WORDS = ("the detail", "its map, Blender's node", "its map, Cotan's frame")

cotan_blender.register()
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene


def vase(name, columns, rows, bosses):
    """Half a vase around z, seen from -y, with uv that run around it like a screw."""
    angle, z = (a.ravel() for a in np.meshgrid(np.linspace(-1.7, 1.7, columns + 1), np.linspace(-1, 1, rows + 1)))
    distance = 0.62 + 0.13 * np.sin(2.6 * z + 0.4)
    if bosses:
        distance += 0.05 * np.maximum(np.sin(7 * angle) * np.sin(10 * z), 0)
    points = np.stack([distance * np.sin(angle), -distance * np.cos(angle), z], -1)
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    faces = np.concatenate([[(f, f + 1, f + columns + 2), (f, f + columns + 2, f + columns + 1)] for f in first])
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points.tolist(), [], faces.tolist())
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    layer = mesh.uv_layers.new(name="UVMap")
    corner = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", corner)
    u, v = 0.5 + 0.16 * angle + SHEAR * z, 0.5 + 0.49 * z
    layer.data.foreach_set("uv", np.stack([u, v], -1)[corner].ravel())
    made = bpy.data.objects.new(name, mesh)
    scene.collection.objects.link(made)
    return made


def material(name):
    made = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0, 0):  # later ones always do
        made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (0.42, 0.2, 0.11, 1)
    shader.inputs["Roughness"].default_value = 0.45
    return made


def words(text, x):
    curve = bpy.data.curves.new(text, "FONT")
    curve.body, curve.align_x, curve.size = text, "CENTER", 0.17
    light = bpy.data.materials.new(text)
    if bpy.app.version < (5, 0, 0):
        light.use_nodes = True
    tree = light.node_tree
    emission = tree.nodes.new("ShaderNodeEmission")
    emission.inputs["Color"].default_value = (0.05, 0.05, 0.06, 1)
    tree.links.new(emission.outputs[0], next(n for n in tree.nodes if n.type == "OUTPUT_MATERIAL").inputs["Surface"])
    curve.materials.append(light)
    made = bpy.data.objects.new(text, curve)
    made.location, made.rotation_euler = (x, 0, -1.32), (np.pi / 2, 0, 0)
    scene.collection.objects.link(made)


high, low = vase("high", 700, 500, True), vase("low", 14, 10, False)
high.data.materials.append(material("detail"))
low.data.materials.append(material("coarse"))
settings = scene.cotan
settings.frame, settings.width, settings.height, settings.bits = "cotangent", 1024, 1024, "16"
high.select_set(True)
low.select_set(True)
bpy.context.view_layer.objects.active = low
bpy.ops.object.cotan_bake()
other = low.copy()
other.data = low.data.copy()
other.data.materials[0] = low.data.materials[0].copy()
scene.collection.objects.link(other)
high.select_set(False)
low.select_set(False)
other.select_set(True)
bpy.ops.object.cotan_frame()
for thing, text, x in zip((high, low, other), WORDS, (-1.9, 0, 1.9)):
    thing.location.x = x
    words(text, x)

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.type, camera.data.ortho_scale = "ORTHO", 5.7
camera.location, camera.rotation_euler = (0, -6, -0.14), (np.pi / 2, 0, 0)
sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy, sun.data.angle, sun.rotation_euler = 4, 0.02, Euler((0.75, -0.55, 0))
scene.collection.objects.link(camera)
scene.collection.objects.link(sun)
scene.camera = camera
scene.world = bpy.data.worlds.new("world")
if bpy.app.version < (5, 0, 0):
    scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.75, 0.77, 0.8, 1)
scene.world.node_tree.nodes["Background"].inputs[1].default_value = 0.5
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 96, False
scene.view_settings.view_transform = "Standard"
scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 1000, 470, 100
scene.render.image_settings.file_format, scene.render.image_settings.quality = "JPEG", 88
scene.render.filepath = os.path.join(sys.argv[sys.argv.index("--") + 1], "blender-frame.jpg")
bpy.ops.render.render(write_still=True)
