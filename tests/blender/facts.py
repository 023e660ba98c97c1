"""Tests inside Blender: each is a function that asserts a fact, on an empty scene."""

import inspect
import json
import os
import struct
import subprocess
import sys
import tempfile
import traceback

import bpy
import cotan_blender
import numpy as np
from mathutils import Matrix

TOOL = os.environ["COTAN_TOOL"]
FOLDER = tempfile.mkdtemp()  # Blender deletes its own folder for temporary files whenever a file is opened


class Skipped(Exception):
    """Raised by a fact that this version of Blender cannot show; the text says why."""


def hold_all(module):
    """Runs the module's functions without arguments, each on an empty scene. Names with an underscore are helpers. Ends
    Blender with exit code 1 if one fails."""
    functions = filter(inspect.isfunction, vars(sys.modules[module]).values())
    own = [function for function in functions if function.__module__ == module]
    facts = [fact for fact in own if not inspect.signature(fact).parameters and "_" not in fact.__name__]
    cotan_blender.register()
    failed = skipped = 0
    for fact in facts:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        try:
            fact()
            print(f"[ OK ] {fact.__name__}", flush=True)
        except Skipped as why:
            skipped += 1
            print(f"[SKIP] {fact.__name__}: {why}", flush=True)
        except BaseException:
            failed += 1
            print(f"[FAIL] {fact.__name__}\n{traceback.format_exc()}", flush=True)
    cotan_blender.unregister()
    print(f"{len(facts) - failed - skipped} of {len(facts)} facts hold, {skipped} skipped", flush=True)
    if failed:
        sys.exit(1)


def error_of(call, **arguments):
    """The error that an operator reports: one sentence without a traceback; "" if it succeeds."""
    try:
        call(**arguments)
        return ""
    except RuntimeError as error:
        text = str(error).strip()
        assert text.startswith("Error: ") and "\n" not in text and "Traceback" not in text, text
        return text[len("Error: ") :]


def make_mesh(name, vertices, faces, uv=None, matrix=None, smooth=True):
    """A mesh object. uv: (u, v) of each vertex, v up."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(map(float, v)) for v in vertices], [], [tuple(map(int, f)) for f in faces])
    if uv is not None:
        layer = mesh.uv_layers.new(name="UVMap")
        for loop in mesh.loops:
            layer.data[loop.index].uv = uv[loop.vertex_index]
    mesh.polygons.foreach_set("use_smooth", [smooth] * len(mesh.polygons))
    mesh.update()
    made = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(made)
    if matrix is not None:
        made.matrix_world = matrix
    return made


def painted(thing, name, color, domain="CORNER", kind="BYTE_COLOR"):
    """Gives the object's mesh a colour attribute and makes it the active one. color: linear (red, green, blue), of all
    vertices or for each. Blender names one without a name itself. Returns its name."""
    layer = thing.data.color_attributes.new(name=name, type=kind, domain=domain)
    values = np.ones((len(layer.data), 4), np.float32)
    values[:, :3] = color
    layer.data.foreach_set("color", values.ravel())
    thing.data.color_attributes.active_color = thing.data.color_attributes[layer.name]
    return layer.name


def material_with_nodes(name):
    """A new material with a Principled BSDF. Blender 6 has no use_nodes."""
    material = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0, 0):
        material.use_nodes = True
    return material


def set_custom_normals(thing, normal):
    """Gives all corners of the object this normal. Before Blender 4.1, they count only with Auto Smooth."""
    if bpy.app.version < (4, 1, 0):
        thing.data.use_auto_smooth = True
    thing.data.normals_split_custom_set([normal] * len(thing.data.loops))


def square(name="low", half=1.0, z=0.0, matrix=None):
    """A square in the plane z; its uv fill the unit square: u along x, v along y."""
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    uv = [((x + 1) / 2, (y + 1) / 2) for x, y in corners]
    return make_mesh(name, [(half * x, half * y, z) for x, y in corners], [(0, 1, 2, 3)], uv, matrix)


def ball(name="high", centre=(0, 0, 0), radius=1.0, cells=128, matrix=None):
    """The upper part of a sphere, to 71 degrees from the top, smooth: a grid of quads without a pole."""
    along = np.tan(np.linspace(-1, 1, cells + 1) * np.radians(71))
    x, y = (a.ravel() for a in np.meshgrid(along, along))
    ways = np.stack([x, y, np.ones(len(x))], -1)
    vertices = np.array(centre) + radius * ways / np.linalg.norm(ways, axis=1, keepdims=True)
    first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
    faces = np.stack([first, first + 1, first + cells + 2, first + cells + 1], -1)
    return make_mesh(name, vertices, faces, matrix=matrix)


def torus(name="high", major=0.6, minor=0.3, segments=256):
    """A smooth torus around z."""
    bpy.ops.mesh.primitive_torus_add(
        major_segments=segments, minor_segments=segments // 2, major_radius=major, minor_radius=minor
    )
    made = bpy.context.object
    made.name = name
    bpy.ops.object.shade_smooth()
    return made


def select(*things):
    """Selects only these objects and makes the last one active."""
    for other in bpy.context.selected_objects:
        other.select_set(False)
    for each in things:
        each.select_set(True)
    bpy.context.view_layer.objects.active = things[-1] if things else None


def settings(**wanted):
    """Sets the panel's settings; by default small 16-bit maps of the texels' centres, without padding."""
    s = bpy.context.scene.cotan
    for name, value in {"width": 64, "height": 64, "bits": "16", "samples": "1", "padding": -1, **wanted}.items():
        setattr(s, name, value)
    return s


def baked(low, *highs, **wanted):
    """Bakes with the operator and returns the map as directions: (height, width, 3), rows from the top."""
    settings(**wanted)
    select(*highs, low)
    assert bpy.ops.object.cotan_bake(which="ACTIVE") == {"FINISHED"}
    return directions(bpy.data.images[f"{low.name}_normal"])


def directions(image):
    """Decodes texels as Blender does, x to the right, y up the image."""
    width, height = image.size
    values = np.empty(width * height * 4, np.float32)
    image.pixels.foreach_get(values)
    codes = values.reshape(height, width, 4)[::-1, :, :3].astype(np.float64)
    return 2 * codes - 1


def degrees(one, other):
    """Angle between directions of any length."""
    one, other = np.asarray(one, float), np.asarray(other, float)
    cosine = (one * other).sum(-1) / (np.linalg.norm(one, axis=-1) * np.linalg.norm(other, axis=-1))
    return np.degrees(np.arccos(np.clip(cosine, -1, 1)))


def texel_centres(size=64, half=1.0):
    """x and y of the centres of a map's texels on square(): (size, size) each, rows from the top."""
    along = ((np.arange(size) + 0.5) / size * 2 - 1) * half
    return np.meshgrid(along, -along)


def command(*arguments):
    """Runs the command-line tool."""
    done = subprocess.run([TOOL, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def exported(name, *things):
    """Writes a .glb of these objects with Blender's exporter."""
    select(*things)
    path = os.path.join(FOLDER, f"{name}.glb")
    bpy.ops.export_scene.gltf(filepath=path, export_format="GLB", use_selection=True, export_apply=True)
    return path


def parts_of(path):
    """The JSON and the binary chunk of a .glb."""
    with open(path, "rb") as file:
        data = file.read()
    length = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20 : 20 + length]), data[28 + length :]


def moved(x=0.0, y=0.0, z=0.0):
    return Matrix.Translation((x, y, z))


# A sphere of 128 cells has normals about 0.01 degrees off between vertices, and 16 bits add 0.002.
NEAR = 0.03


def of_sphere(x, y, radius=1.0):
    """Unit normals of a centred sphere seen from above, and whether each point is well inside its rim."""
    inside = x * x + y * y < (0.9 * radius) ** 2
    z = np.sqrt(np.maximum(radius * radius - x * x - y * y, 0))
    return np.stack([x, y, z], -1) / radius, inside


def expect_sphere(found, x, y, radius=1.0, least=1000):
    truth, inside = of_sphere(x, y, radius)
    assert inside.sum() > least, inside.sum()
    assert degrees(found[inside], truth[inside]).max() < NEAR, degrees(found[inside], truth[inside]).max()
