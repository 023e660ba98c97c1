"""The extension of scripts/blender-addon in Blender 4.2 or newer: installed by Blender's own command, then all tests of
tests/blender with the libraries that it carries.

    blender.py TOOL [FOLDER]

TOOL: cotan, with libcotan in ../src/c; FOLDER: where outputs are left. Exit code 77 if Blender is missing or older, as
Debian 12's, whose tests are those named Blender (scripts/try-engines gets newer ones)."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FACTS = ROOT / "tests/blender"


def skip(reason):
    print("skipped: " + reason)
    sys.exit(77)


def version():
    if not shutil.which("xvfb-run") or not shutil.which("blender"):
        skip("no Blender or no xvfb-run (scripts/try-engines)")
    said = subprocess.run(["blender", "--version"], capture_output=True, text=True).stdout
    found = re.search(r"^Blender (\d+)\.(\d+)\.(\d+)", said, re.MULTILINE)
    if not found or (int(found[1]), int(found[2])) < (4, 2):
        skip("blender is not Blender 4.2 or newer (scripts/try-engines)")
    return found[0].split()[1]


def carry_tool(tool, folder):
    """A copy of the tool with its libraries, for another Debian."""
    folder.mkdir()
    shutil.copy(tool, folder / "cotan-program")
    for line in subprocess.run(["ldd", tool], capture_output=True, text=True, check=True).stdout.splitlines():
        path = re.match(r"\t(\S+) => (/\S+) ", line)
        if path and not re.match(r"(lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s)|ld-linux.*)\.so", path[1]):
            shutil.copy(path[2], folder / path[1])
    script = folder / "cotan"
    script.write_text(f'#!/bin/sh\nLD_LIBRARY_PATH="{folder}" exec "{folder}/cotan-program" "$@"\n')
    script.chmod(0o755)
    return script


def ran(name, log, command, **more):
    """Runs a command; its output goes to the log, and the lines of its facts are printed."""
    both = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
    done = subprocess.run(command, stdin=subprocess.DEVNULL, text=True, **both, **more)
    log.write_text(done.stdout)
    print(f"{name}: exit code {done.returncode}" + (f", {log}" if done.returncode else ""))
    for line in done.stdout.splitlines():
        if line.startswith(("[SKIP]", "[FAIL]", "measured: ")) or "facts hold" in line:
            print(f"  {line}", flush=True)
    return done.returncode == 0


def main(tool, folder):
    name = version()
    library = pathlib.Path(tool).parent.parent / "src/c/libcotan.so"
    built = dict(os.environ, LIBRARY=str(library)) if library.exists() else os.environ
    subprocess.run([ROOT / "scripts/blender-addon", folder], env=built, check=True, stdout=subprocess.DEVNULL)
    package = folder / "cotan_blender.zip"
    user = dict(os.environ, BLENDER_USER_RESOURCES=str(folder / "user"), LC_ALL="C.UTF-8")
    results = []
    for number, (what, words) in enumerate((
        ("validated", ["--command", "extension", "validate", package]),
        ("installed", ["--command", "extension", "install-file", "--repo", "user_default", "--enable", package]),
        ("used", ["-b", "--python-exit-code", "1", "--python", FACTS / "extension_facts.py"]),
    )):  # fmt: skip
        results.append(ran(what, folder / f"{number}-{what}.txt", ["blender", *words], env=user))
    zipfile.ZipFile(package).extractall(folder / "unpacked")
    library = folder / "unpacked/cotan_blender/cotan/libcotan.so.0"
    carried = carry_tool(tool, folder / "tool")
    for line in (ROOT / "tests/blender.cmake").read_text().splitlines():
        fact = re.match(r"cotan_blender\((\w+) (\w+\.py)([^)]*)\)", line)
        if fact and fact[2] != "install_facts.py":  # needs the library from elsewhere
            command = [sys.executable, FACTS / "run.py", *fact[3].split(), library, carried, fact[2]]
            results.append(ran(fact[1], folder / f"{fact[1]}.txt", command))
    assert all(results), "some tests fail"
    print(f"holds: Blender {name} installs the extension and passes {len(results)} tests")


if __name__ == "__main__":
    if len(sys.argv) > 2:
        main(sys.argv[1], pathlib.Path(sys.argv[2]).resolve())
    else:
        with tempfile.TemporaryDirectory() as place:
            main(sys.argv[1], pathlib.Path(place))
