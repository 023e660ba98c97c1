"""The steps of docs/tutorials/blender-to-godot.md in Blender, with its example files. If a folder is given, the model
and its map are left there for Godot."""

import os
import pathlib
import shutil
import subprocess
import sys

import bpy
import cotan
import facts
import numpy as np
from facts import FOLDER, command, degrees, directions, select

LESSON = pathlib.Path(__file__).resolve().parents[2] / "docs/tutorials"
FILES = pathlib.Path(FOLDER) / "files"


def _imported(name):
    bpy.ops.wm.obj_import(filepath=str(FILES / f"{name}.obj"))
    return bpy.context.selected_objects[0]


def tutorialStoneBakesLikeTheCommandLineAndIsExportedWithoutTangents():
    subprocess.run([sys.executable, LESSON / "make-files", FILES], check=True)
    high, low = _imported("stone_high"), _imported("stone_low")
    scene = bpy.context.scene
    scene.cotan.frame, scene.cotan.width, scene.cotan.height = "orthonormal", 512, 512
    select(high, low)
    assert bpy.ops.object.cotan_bake(which="ACTIVE") == {"FINISHED"}
    image = bpy.data.images[f"{low.name}_normal"]
    found = directions(image)
    png = os.path.join(FOLDER, "stone_normal.png")
    command("bake", "--high", FILES / "stone_high.obj", "--low", FILES / "stone_low.obj", "--frame", "orthonormal",
            "--size", 512, "--convention", "blender", "-o", png)  # fmt: skip
    theirs = 2 * cotan.read_image(png)[..., :3].astype(float) / 255 - 1
    apart = degrees(found, theirs)
    assert np.median(apart) < 0.01 and np.percentile(apart, 99) < 1, (np.median(apart), np.percentile(apart, 99))

    model = os.path.join(FOLDER, "stone.glb")
    select(low)
    assert bpy.ops.export_scene.cotan_gltf(filepath=model) == {"FINISHED"}
    with open(model, "rb") as file:
        assert b"TANGENT" not in file.read()
    rest = sys.argv[sys.argv.index("--") + 1 :]
    if rest:
        shutil.copy(model, rest[0])
        shutil.copy(png, rest[0])


facts.hold_all(__name__)
