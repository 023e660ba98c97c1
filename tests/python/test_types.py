"""Type checks of programs that call the package: none fails `mypy --strict`, except those with mistakes."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import typing

import pytest

import cotan
from cotan import words


@pytest.fixture(scope="module")
def check(source, tmp_path_factory):
    """Lines that mypy --strict prints: one list for each program."""
    found = shutil.which("mypy") or (os.access("/usr/bin/mypy", os.X_OK) and "/usr/bin/mypy")
    if not found:
        pytest.skip("skipped: no mypy here (Debian's package mypy)")
    folder = tmp_path_factory.mktemp("types")

    def run(programs):
        files = [folder / f"program{number}.py" for number in range(len(programs))]
        for file, program in zip(files, programs):
            file.write_text(program)
        # Silent: nothing is reported about the inside of an installed package.
        done = subprocess.run(
            [found, "--strict", "--follow-imports=silent", "--python-executable", sys.executable]
            + ["--cache-dir", folder / "cache", *files],
            capture_output=True,
            text=True,
            env={**os.environ, "MYPYPATH": str(source / "bindings/python")},
            cwd=folder,
        )
        lines = done.stdout.splitlines()
        said = [[line for line in lines if line.startswith(file.name + ":")] for file in files]
        assert any(said) == (done.returncode != 0), done.stdout + done.stderr
        return said

    return run


def test_examples_of_the_page_pass_type_checks(source, check):
    prelude = "import numpy as np\nimport cotan\nlow: cotan.Mesh\nhigh: cotan.Mesh\n"
    blocks, programs = [], []
    for page in ("docs/reference/python.md", "bindings/python/README.md"):
        for block in re.findall(r"```python\n(.*?)```", (source / page).read_text(), re.S):
            declared = re.sub(r"^(low|high): cotan.Mesh\n", "", prelude, flags=re.M) if re.search(r"^low = ", block, re.M) else prelude
            blocks.append(block)
            programs.append(declared + block)
    assert len(blocks) > 5
    for block, said in zip(blocks, check(programs)):
        assert said == [], block


def test_misspelt_values_fail_type_checks(check):
    right = """
import cotan
from cotan.words import Frame
baked = cotan.bake("a.obj", "b.obj", size=(4, 4), frame="smooth", kind="ao", convention="unity,xy")
frame: Frame = cotan.frames()[0]
advice = cotan.lint("m.glb", frame="triangle").advice
if advice is not None:
    cotan.convert("m.glb", to_frame=advice)
try:
    cotan.render("m.glb", size=64, frame="auto", up="z")
except FileNotFoundError as error:
    print(error.filename)
except cotan.Error as error:
    print(error.file, error.field)
"""
    assert check([right]) == [[]]
    mistakes = (
        'cotan.bake("a.obj", "b.obj", frame="smoth")',
        'cotan.bake("a.obj", "b.obj", kind="normals")',
        'cotan.render("m.glb", frame="mikktspac")',
        'cotan.render("m.glb", up="x")',
        'cotan.lint("m.glb", frame="unit")',
        'cotan.map_blend("a.png", "b.png", mode="overlay")',
        'cotan.tangents(cotan.Mesh([[0, 0, 0]], [0, 0, 0]), kind="smooth")',
        'cotan.shader("cg")',
        'cotan.convert(1)',
    )
    for wrong, said in zip(mistakes, check([f"import cotan\n{wrong}\n" for wrong in mistakes])):
        assert len(said) >= 1 and ".py:2: error" in said[0], (wrong, said)


def taken(command, option):
    """The words that the program lists as valid when it gets an invalid one."""
    run = subprocess.run([os.environ["COTAN_TOOL"], command, option, "zzz"], capture_output=True, text=True)
    said = re.search(r"expected ([a-z, -]+); found 'zzz'", run.stderr)
    assert said, run.stderr
    return re.split(", | or ", said[1])


def test_typed_values_equal_those_of_the_program(command):
    assert list(typing.get_args(words.Frame)) == cotan.frames()
    bake, convert = command("bake", "--help"), command("map", "convert", "--help")
    for kind in typing.get_args(words.BakeKind):
        assert kind in bake
    bake_options = {"Search": "--search", "IdBy": "--id-by", "HighNormals": "--high-normals", "TangentOrigin": "--tangents", "Up": "--up"}
    for name, option in bake_options.items():
        assert taken("bake", option) == list(typing.get_args(getattr(words, name))), name
    presets = re.search(r"gltf[a-z0-9, ]*source", re.sub(r"\s+", " ", convert))
    assert presets and set(typing.get_args(words.Preset)) == set(presets[0].split())
    assert taken("lint", "--frame") == list(typing.get_args(words.Reading))
