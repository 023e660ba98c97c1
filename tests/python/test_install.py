"""The package installed without the network: as a wheel that contains the library, and from its sources."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import zipfile

import pytest

import cotan

LIBRARY = os.environ.get("COTAN_LIBRARY", "")


def without(*names):
    """The environment variables of this process except `names`."""
    return {name: value for name, value in os.environ.items() if name not in names}


def installed(place, *words):
    """A virtual environment that sees numpy, with the package installed; returns its Python."""
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", "--without-pip", place], check=True)
    subprocess.run(
        [sys.executable, "-m", "pip", "--python", place / "bin/python", "install", "--quiet", "--no-index", "--no-deps",
         "--no-build-isolation", "--disable-pip-version-check", *words],
        check=True, env=without("PYTHONPATH"),
    )  # fmt: skip
    return place / "bin/python"


def needs(*modules):
    for module in modules:
        pytest.importorskip(module, reason=f"skipped: no {module} here")


SQUARE = """
import cotan, numpy as np
corners = np.float32([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
mesh = cotan.Mesh(corners, [[0, 1, 2], [0, 2, 3]], texcoords=corners[:, :2])
print(cotan.__file__, cotan.library_path(), cotan.bake(mesh, mesh, size=4).map[0, 0])
cotan.write_image("a.exr", np.zeros((2, 2, 4), np.float32))
print(cotan.read_image("a.exr").dtype)
"""


# What every Linux has whose glibc is as new as the wheel's name says.
SYSTEM = re.compile(r"(ld-linux-x86-64|lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s))\.so")


def needs_only_itself(wheel, folder):
    """Every library in the wheel needs libraries of the wheel and the system's alone, and no newer glibc than it says."""
    with zipfile.ZipFile(wheel) as packed:
        packed.extractall(folder)
    libraries = {path.name: path for path in (folder / "cotan").glob("lib*.so*")}
    assert len(libraries) > 1 and (folder / "cotan/licences/cotan.txt").exists()
    said = tuple(map(int, re.search(r"manylinux_(\d+)_(\d+)_", wheel.name).groups()))
    for name, path in libraries.items():
        listed = subprocess.run(["objdump", "-p", path], check=True, capture_output=True, text=True).stdout
        foreign = [one for one in re.findall(r"NEEDED +(\S+)", listed) if one not in libraries and not SYSTEM.match(one)]
        assert not foreign, f"{name} needs {foreign}"
        assert re.findall(r"RUNPATH +(\S+)", listed) == ["$ORIGIN"], name
        assert max((int(a), int(b)) for a, b in re.findall(r"GLIBC_(\d+)\.(\d+)", listed)) <= said, name


def test_wheel_with_the_library_works_after_installation(source, tmp_path):
    needs("setuptools", "wheel", "pip")
    build = pathlib.Path(LIBRARY).resolve().parents[2]
    made = subprocess.run([source / "scripts/python-wheel", tmp_path, build], check=True, capture_output=True, text=True)
    wheel = pathlib.Path(made.stdout.strip())
    assert wheel.name.startswith(f"cotan-{cotan.__version__}-py3-none-manylinux_2_")
    needs_only_itself(wheel, tmp_path / "unpacked")
    python = installed(tmp_path / "environment", wheel)
    variables = without("COTAN_LIBRARY", "PYTHONPATH")
    done = subprocess.run([python, "-c", SQUARE], env=variables, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    file, library, *rest = done.stdout.split()
    assert file.startswith(str(tmp_path / "environment")) and library == str(pathlib.Path(file).parent / "libcotan.so.0")
    assert " ".join(rest) == "[128 128 255 255] float32"


def test_pip_installs_the_sources_for_a_separate_library(source, tmp_path):
    needs("setuptools", "wheel", "pip")
    shutil.copytree(source / "bindings/python", tmp_path / "sources", ignore=shutil.ignore_patterns("build", "*.egg-info"))
    python = installed(tmp_path / "environment", tmp_path / "sources")
    done = subprocess.run([python, "-c", SQUARE], env=without("PYTHONPATH"), cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split()[1] == LIBRARY
