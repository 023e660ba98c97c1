"""The scripts of the repository, as someone calls them who does not know them: scripts_test.py SOURCES BUILD.

Each refuses arguments that it does not know with one line of usage and exit code 1, and starts nothing. The programs and
folders of a build that scripts, workflows and pages name are those that the build makes."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

from tracked import tracked

SOURCES, BUILD = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
# Programs that a script may not start before it has checked its arguments.
STARTED = ("cmake ninja ctest cpack npm npx node emcc apt-get apt sudo debootstrap blender f3d xvfb-run gcc g++ c++ clang++ "
           "clang-format clang-tidy oiiotool valgrind wine pip dpkg-deb git-clone mount chroot perf gdb "
           "buildah patchelf sha256sum").split()
# Maintainer scripts of Debian, which dpkg calls, and scripts that are parts of one test.
NOT_OURS = ("cmake/packages/", "tests/")


def scripts():
    names = [name for name in tracked(SOURCES) if os.access(SOURCES / name, os.X_OK)]
    return [name for name in names if not name.startswith(NOT_OURS)]


def refusesUnknownArguments():
    wrong = []
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        (folder / "bin").mkdir()
        for program in STARTED:
            stub = folder / "bin" / program
            stub.write_text(f"#!/bin/sh\necho {program} >> {folder}/started\nexit 1\n")
            stub.chmod(0o755)
        environment = dict(os.environ, PATH=f"{folder}/bin:{os.environ['PATH']}")
        for name in scripts():
            for words in (["--no-such-option"], ["-x"], ["--help", "--help"], ["a"] * 12):
                if words[0] == "a" and takes_a_list(name):
                    continue
                run = subprocess.run([SOURCES / name, *words], cwd=folder, env=environment, capture_output=True, text=True,
                                     timeout=60, stdin=subprocess.DEVNULL)
                started = (folder / "started").read_text().split() if (folder / "started").exists() else []
                (folder / "started").unlink(missing_ok=True)
                said = run.stdout + run.stderr
                if is_argparse(said) and run.returncode in (0, 2) and not started:
                    continue  # argparse of Python: several lines, exit code 2, or 0 for --help
                if run.returncode != 1 or started or said.count("\n") != 1 or not said.startswith("usage: "):
                    wrong.append(f"{name} {' '.join(words[:3])}: exit code {run.returncode}, started {started}: {said.strip()[:200]}")
    assert not wrong, "\n" + "\n".join(wrong)


def takes_a_list(name):
    return any("..." in line and (name.split("/")[-1] in line or "usage" in line) for line in (SOURCES / name).read_text().splitlines())


def is_argparse(said):
    return said.startswith("usage: ") and "[-h]" in said


def what_builds_make():
    """Paths in a build folder: those of this build, and of the programs that other builds make as well."""
    listed = subprocess.run(["ninja", "-C", BUILD, "-t", "targets", "all"], capture_output=True, text=True, check=True).stdout
    made = {line.split(": ")[0] for line in listed.splitlines()}
    for folder in ("bench", "tests", "fuzz"):  # COTAN_BENCHMARKS=ON; programs that lack a library here
        text = "".join(f.read_text() for f in (SOURCES / folder).glob("*.cmake")) + (SOURCES / folder / "CMakeLists.txt").read_text()
        made |= {f"{folder}/{name}" for name in re.findall(r"(?:add_executable|cotan_test)\((\w+)", text)}
    made |= {f"fuzz/{name}" for name in made if name.endswith(("_fuzz", "_replay"))}
    # The preset windows-tool names its files as Windows does.
    made |= {f"{path}.exe" for path in made if path.startswith("bin/")} | {"src/c/cotan.dll", "src/c/libcotan.dll.a"}
    made |= {str(f.relative_to(BUILD)) for f in (BUILD / "share").rglob("*")}
    return made | {str(folder) for path in made for folder in pathlib.PurePath(path).parents} | {"CMakeCache.txt", "compile_commands.json"}


# Written by scripts, not by the build.
BY_SCRIPTS = ("found", "corpus", "logs", "debs", "cpack.txt", "npm", "web", "data", "data-npm", "models-npm", "models-made", "models-made.part")


def namesWhatTheBuildMakes():
    made, wrong, count = what_builds_make(), [], 0
    for name in tracked(SOURCES):
        if not re.match(r"(scripts|bench|docs|\.ci|\.github|bindings|integrations)/|run-|[A-Z]+\.md", name) or name == "CHANGELOG.md":
            continue
        text = (SOURCES / name).read_bytes().decode("utf-8", "replace")
        for path in re.findall(r"(?:build/(?:dev|release|asan|tsan)|\$\{?build\}?)/([\w./-]*[\w])(?![\w/$*{])", text):
            count += 1
            if path not in made and path.split("/")[0] not in BY_SCRIPTS:
                wrong.append(f"{name} names {path}, which no build makes")
    assert count > 20, f"only {count} paths found"
    assert not wrong, "\n" + "\n".join(wrong)


if __name__ == "__main__":
    for fact in (refusesUnknownArguments, namesWhatTheBuildMakes):
        fact()
        print("holds:", fact.__name__)
