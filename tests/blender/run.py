"""One script of facts inside Blender, in the background and with settings of its own:

    run.py [--window] LIBRARY TOOL SCRIPT [ARGUMENT ...]

LIBRARY: libcotan; TOOL: cotan. --window: with a window, on a display of Xvfb. Exit code 77 where something is missing.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
root = here.parent.parent
arguments = sys.argv[1:]
window = arguments[:1] == ["--window"]
library, tool, script, *rest = arguments[window:]
for program in ["blender"] + ["xvfb-run"] * window:
    if not shutil.which(program):
        print(f"skipped: {program} is missing (scripts/setup doors)")
        sys.exit(77)
with tempfile.TemporaryDirectory() as folder:
    environment = dict(
        os.environ,
        BLENDER_USER_RESOURCES=folder,
        COTAN_LIBRARY=library,
        COTAN_TOOL=tool,
        COTAN_ROOT=str(root),
        PYTHONPATH=os.pathsep.join(map(str, (root / "integrations/blender", root / "bindings/python", here))),
        PYTHONDONTWRITEBYTECODE="1",
        LIBGL_ALWAYS_SOFTWARE="1",
    )
    command = ["blender", "--factory-startup", "--python-use-system-env", "--python-exit-code", "1"]
    if window:
        command = ["xvfb-run", "-a", "-s", "-screen 0 1280x800x24", *command, "-p", "0", "0", "1280", "800", "--enable-event-simulate"]
    else:
        command.insert(1, "-b")
    sys.exit(subprocess.run([*command, "--python", str(here / script), "--", *rest], env=environment).returncode)
