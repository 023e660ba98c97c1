"""Runs docs/tutorials/blender-to-godot.md from start to end: Blender bakes and exports the stone, Godot 3 imports and
draws it.

    to_godot.py LIBRARY TOOL [IMAGE]

LIBRARY: libcotan; TOOL: cotan; IMAGE: where Godot's image is saved, such as docs/pictures/tutorial-stone-godot.png.
Exit code 77 if a program is missing."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
library, tool, *image = sys.argv[1:]
for program in ("blender", "godot3", "xvfb-run"):
    if not shutil.which(program):
        print(f"skipped: {program} is missing (scripts/setup doors)")
        sys.exit(77)
os.environ["COTAN_LIBRARY"] = library
sys.path.insert(0, str(ROOT / "bindings/python"))
sys.dont_write_bytecode = True
import cotan  # noqa: E402
import numpy as np  # noqa: E402


def godot(folder, *words):
    """Starts Godot on its own display, in a process group that can be ended as a whole."""
    screen = ["xvfb-run", "-a", "-s", "-screen 0 640x480x24"]
    environment = dict(os.environ, HOME=str(folder), LIBGL_ALWAYS_SOFTWARE="1")
    return subprocess.Popen([*screen, "godot3", "--path", str(folder), *words], env=environment, start_new_session=True,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)  # fmt: skip


def imported(folder):
    """Lets Godot's editor import the files of the folder, and ends the editor, which does not exit by itself."""
    editor = godot(folder, "--editor")
    wanted = [".import/stone.glb-*.scn", ".import/stone_normal.png-*.stex"]
    try:
        for _ in range(240):
            if all(list(folder.glob(pattern)) for pattern in wanted):
                time.sleep(1)  # for the files written beside them
                return
            if editor.poll() is not None:
                break
            time.sleep(0.5)
        raise AssertionError("Godot's editor imported nothing")
    finally:
        os.killpg(editor.pid, signal.SIGKILL)
        editor.communicate()


def drawn(folder, *words):
    """Brightness of Godot's image, 0 to 255, rows from the top."""
    file = folder / "drawn.png"
    run = godot(folder, f"--image={file}", *words)
    said, _ = run.communicate(timeout=120)
    assert "DONE" in said, said
    return cotan.read_image(str(file))[..., :3].astype(float).mean(axis=-1)


with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    subprocess.run([sys.executable, HERE / "run.py", library, tool, "lesson_facts.py", name], check=True)
    for file in (ROOT / "tests/godot_stone").iterdir():
        shutil.copy(file, folder)
    subprocess.run([tool, "shader", "--lang", "godot", "--preset", "godot", "-o", folder / "cotan.shader", "--quiet"], check=True)
    imported(folder)
    carved = drawn(folder)
    if image:
        shutil.copy(folder / "drawn.png", image[0])
    plain = drawn(folder, "--flat")
    stone = np.abs(plain - plain[2, 2]) > 8
    assert 0.2 < stone.mean() < 0.8, stone.mean()
    changed = (np.abs(carved - plain) > 16)[stone].mean()
    assert changed > 0.1, changed
    print(f"holds: the carved stone of Blender is in Godot ({100 * changed:.0f} % of its pixels differ from the plain one)")
