"""Maps of other kinds than normals, compared with those of Blender's own baker: Suzanne with a texture, from a
subdivided one with two materials."""

import math
import os

import bpy
import cotan
import facts
import numpy as np
from facts import FOLDER, exported, material_with_nodes, select

SIZE, OUT = 256, 0.2  # OUT: how far in front of the low mesh rays start


def _suzanne(name, levels):
    bpy.ops.mesh.primitive_monkey_add(size=2)
    made = bpy.context.object
    made.name = name
    made.modifiers.new("finer", "SUBSURF").levels = levels
    bpy.ops.object.modifier_apply(modifier="finer")
    bpy.ops.object.shade_smooth()
    return made


def _material(name, roughness, color, image=None):
    """Its colour, or an image on the mesh's uv, is also the light that it emits."""
    material = material_with_nodes(name)
    tree = material.node_tree
    inputs = tree.nodes["Principled BSDF"].inputs
    light = inputs["Emission" if "Emission" in inputs else "Emission Color"]
    inputs["Emission Strength"].default_value = 1
    inputs["Roughness"].default_value, inputs["Metallic"].default_value = roughness, 0
    for slot in (inputs["Base Color"], light):
        slot.default_value = (*color, 1)
        if image:
            node = tree.nodes.new("ShaderNodeTexImage")
            node.image = image
            tree.links.new(node.outputs["Color"], slot)
    return material


def _made_by_cycles(kind, low, high, samples, **more):
    """(SIZE, SIZE, 4) rows from the top; alpha 1 where a ray hit."""
    scene = bpy.context.scene
    scene.cycles.samples = samples
    image = bpy.data.images.new(kind, SIZE, SIZE, float_buffer=True, alpha=True)
    image.generated_color = (0, 0, 0, 0)
    image.colorspace_settings.name = "Non-Color"
    low.data.materials[0].node_tree.nodes.active.image = image
    select(high, low)
    bpy.ops.object.bake(type=kind, use_selected_to_active=True, cage_extrusion=OUT, margin=0, use_clear=True, **more)
    values = np.empty(SIZE * SIZE * 4, np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(SIZE, SIZE, 4)[::-1].astype(float)


def _inside(mask):
    """Texels whose neighbours are also in the mask: rims of charts are filled differently."""
    shifts = [(y, x) for y in (-1, 0, 1) for x in (-1, 0, 1)]
    return np.all([np.roll(mask, shift, (0, 1)) for shift in shifts], axis=0)


def mapsMatchThoseOfCycles():
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.use_denoising = "CYCLES", False
    scene.world = bpy.data.worlds.new("world")
    scene.world.light_settings.distance = 1000  # of occlusion
    grid = bpy.data.images.new("grid", 128, 128)
    grid.generated_type, grid.file_format = "COLOR_GRID", "PNG"
    grid.filepath_raw = os.path.join(FOLDER, "grid.png")
    grid.save()
    high, low = _suzanne("high", 3), _suzanne("low", 1)
    high.data.materials.append(_material("skin", 0.3, (0, 0, 0), bpy.data.images.load(grid.filepath_raw)))
    high.data.materials.append(_material("cap", 0.8, (0.1, 0.4, 0.9)))
    for face in high.data.polygons:
        face.material_index = int(face.center.z > 0.3)
    select(low)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.uv.smart_project(angle_limit=math.radians(66), island_margin=0.02)
    bpy.ops.object.mode_set(mode="OBJECT")
    low.data.materials.append(material_with_nodes("low"))
    tree = low.data.materials[0].node_tree
    tree.nodes.active = tree.nodes.new("ShaderNodeTexImage")
    files = [exported("low", low), exported("high", high)]
    # Kind, the same in Blender, and bars of the median and the 95th percentile. Positions are in floats on both sides.
    # Colours differ at the steps of the texture by the pixel filter; occlusion by its noise of 256 rays: 0.03 at 0.5.
    for kind, theirs, middle, most, more in (
        ("position", "POSITION", 2e-4, 5e-4, {}),
        ("roughness", "ROUGHNESS", 1e-6, 1e-6, {}),
        ("emissive", "EMIT", 2e-4, 0.05, {}),
        ("base-color", "DIFFUSE", 2e-4, 0.05, {"pass_filter": {"COLOR"}}),
        ("ao", "AO", 0.012, 0.05, {}),
    ):
        samples = {"position": 1, "ao": 256}.get(kind, 16)
        if kind == "base-color":  # since Blender 4, what a surface reflects is missing in its diffuse colour
            for shader in [m.node_tree.nodes["Principled BSDF"] for m in high.data.materials]:
                shader.inputs["Specular" if "Specular" in shader.inputs else "Specular IOR Level"].default_value = 0
        ours = cotan.bake(
            *files, kind=kind, size=SIZE, bits=32, padding=-1, extrusion=OUT, max_distance=1, mask=True, ao_rays=256,
            samples=samples if samples == 16 else 1,
        )  # fmt: skip
        made = _made_by_cycles(theirs, low, high, samples, **more)
        both = _inside((ours.mask[..., 1] > 170) & (made[..., 3] > 0.99))
        wanted = made[..., [0, 2, 1]] * (1, 1, -1) if kind == "position" else made[..., :3]  # y is up
        off = np.abs(ours.map[..., :3] - wanted).max(-1)[both]
        median, high_end, mean = np.median(off), np.quantile(off, 0.95), off.mean()
        print(f"{kind}: {both.sum()} texels, median {median:.5f}, 95 % {high_end:.4f}, mean {mean:.5f}", flush=True)
        assert both.sum() > 15000 and median < middle and high_end < most, kind


facts.hold_all(__name__)
