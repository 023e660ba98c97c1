"""Runs one test script inside Blender, in the background and with separate settings:

    run.py [--window | --display] [--installed] LIBRARY TOOL SCRIPT [ARGUMENT ...]

LIBRARY: libcotan; TOOL: cotan. --window: with a window, on a display of Xvfb; --display: without a window, but with the
display, which Eevee needs. --installed: nothing of Cotan can be
imported, but there is a zip to install. Exit code 77 if something is missing."""
import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
root = here.parent.parent
parser = argparse.ArgumentParser()
parser.add_argument("--window", action="store_true")
parser.add_argument("--display", action="store_true")
parser.add_argument("--installed", action="store_true")
for name in ("library", "tool", "script"):
    parser.add_argument(name)
parser.add_argument("rest", nargs="*")
given = parser.parse_args()
blender = shutil.which("blender")  # before PATH is changed
for program in ["blender"] + ["xvfb-run"] * (given.window or given.display):
    if not shutil.which(program):
        print(f"skipped: {program} is missing (scripts/setup doors)")
        sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    environment = dict(os.environ, BLENDER_USER_RESOURCES=f"{folder}/user", LIBGL_ALWAYS_SOFTWARE="1")
    environment.pop("COTAN_LIBRARY", None)
    # Debian's Blender uses the first Python in PATH, and needs the system's, which has numpy.
    environment["PATH"] = os.pathsep.join(("/usr/bin", environment["PATH"]))
    paths = []
    if given.installed:
        built = dict(environment, LIBRARY=given.library)
        subprocess.run([root / "scripts/blender-addon", folder], env=built, check=True)
        environment["COTAN_ZIP"] = f"{folder}/cotan_blender.zip"
    else:
        paths = [str(root / "integrations/blender"), str(root / "bindings/python"), str(here)]
        environment.update(COTAN_LIBRARY=given.library, COTAN_TOOL=given.tool)
    command = [blender, "--factory-startup", "--python-exit-code", "1"]
    if given.window:
        command += ["--enable-event-simulate", "-p", "0", "0", "1280", "800"]
    else:
        command.append("-b")
    if given.window or given.display:
        command = ["xvfb-run", "-a", "-s", "-screen 0 1280x800x24", *command]
    command += ["--python-expr", f"import sys; sys.dont_write_bytecode = True; sys.path[:0] = {paths!r}"]
    sys.exit(subprocess.run([*command, "--python", here / given.script, "--", *given.rest], env=environment).returncode)
