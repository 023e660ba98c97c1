# Compares the add-on's bake with that of Cycles at one sample, both from pressing the button in Blender to the pixels
# of an image in Blender, with the same meshes, in alternation:
# blender -b --factory-startup -P bench/blender-addon.py -- LOW.obj HIGH.obj [SIZE] [RUNS]
# Prints the best wall-clock and processor seconds of each, their ratios, and the differences of the add-on's map from
# `cotan bake` of the same meshes as glTF, and from Cycles' map. Needs libcotan and cotan: COTAN_LIBRARY and COTAN, else those of
# build/release.
import os
import pathlib
import subprocess
import sys
import tempfile

import bpy

here = pathlib.Path(__file__).resolve().parent
root = here.parent
sys.path[:0] = [str(here), str(root / "integrations/blender"), str(root / "bindings/python")]
os.environ.setdefault("COTAN_LIBRARY", str(root / "build/release/src/c/libcotan.so"))

import blender_bake
import cotan
import cotan_blender
import numpy as np

low_file, high_file, size, runs = (sys.argv[sys.argv.index("--") + 1:] + ["4096", "3"])[:4]
size, runs = int(size), int(runs)
cotan_blender.register()
low, high, image = blender_bake.prepare(low_file, high_file, size, 0)
settings = bpy.context.scene.cotan
settings.width = settings.height = size
settings.samples = "1"  # as Cycles
settings.padding = -1  # Cycles' margin is 0 too
settings.distance = blender_bake.reach_of(high)


def bake_with_cotan():
    bpy.ops.object.cotan_bake()
    bpy.data.images[f"{low.name}_normal"].pixels[0]  # decoded, as Cycles leaves it


# Cycles writes into the image of the active node, so the add-on's node must not stay active.
def bake_with_cycles():
    nodes = low.data.materials[0].node_tree.nodes
    nodes.active = next(n for n in nodes if n.type == "TEX_IMAGE" and n.image == image)
    blender_bake.bake_with_cycles(high)


taken = {bake_with_cotan: [], bake_with_cycles: []}
for _ in range(runs):
    for bake in taken:
        taken[bake].append(blender_bake.timed(bake))
for column, what in enumerate(("wall-clock", "processor")):
    ours, theirs = (min(seconds[column] for seconds in taken[bake]) for bake in taken)
    print(f"blender-addon {what}: cotan {ours:.2f} s, Cycles {theirs:.2f} s: {theirs / ours:.1f} times as fast")

found = cotan_blender.images.pixels_of(bpy.data.images[f"{low.name}_normal"])
with tempfile.TemporaryDirectory() as folder:
    files = {}
    for name, thing in (("low", low), ("high", high)):
        files[name] = os.path.join(folder, f"{name}.glb")
        with open(files[name], "wb") as file:
            file.write(cotan_blender.gltf.exported(bpy.context, [thing]))
    map_file = os.path.join(folder, "map.png")
    tool = os.environ.get("COTAN", str(root / "build/release/bin/cotan"))
    subprocess.run([tool, "bake", "--low", files["low"], "--high", files["high"], "--frame", settings.frame,
                    "--size", f"{size}x{size}", "--samples", "1", "--padding", "-1", "--max-distance", str(settings.distance), "--quiet",
                    "--convention", "blender", "-o", map_file], check=True)
    wanted = cotan.read_image(map_file)
flat = (128, 128, 255, 255)


def compare(other, whose, mask):
    """Prints the angles between the add-on's map and another one, in the texels of the mask."""
    a, b = ((p[mask][:, :3].astype(np.float32) - 127.5) / 127.5 for p in (found, other))
    cosine = (a * b).sum(axis=1) / np.sqrt((a * a).sum(axis=1) * (b * b).sum(axis=1))
    errors = np.degrees(np.arccos(np.clip(cosine.astype(np.float64), -1, 1)))
    errors[(a == b).all(axis=1)] = 0
    mean, median, high = errors.mean(), np.median(errors), np.quantile(errors, 0.999)
    print(f"blender-addon: mean {mean:.4f}, median {median:.4f}, 99.9 % {high:.3f} degrees from {whose} over {len(errors)} "
          f"texels; {100 * (errors > 0).mean():.2f} % of them differ at all")  # fmt: skip


compare(wanted, "the command line's map", ((found != flat) | (wanted != flat)).any(axis=2))
cycles = cotan_blender.images.pixels_of(image)
both = (found != flat).any(axis=2) & (cycles[..., 3] > 0) & (cycles[..., :3] > 0).any(axis=2)
for axis in (0, 1):  # without the rims of charts, which the two fill differently
    both &= np.roll(both, 1, axis) & np.roll(both, -1, axis)
compare(cycles, "Cycles' map", both)
