"""The package installed without the network: as a wheel that contains the library, and from its sources."""

import os
import pathlib
import shutil
import subprocess
import sys

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


def test_wheel_with_the_library_works_after_installation(source, tmp_path):
    needs("setuptools", "wheel", "pip")
    build = pathlib.Path(LIBRARY).resolve().parents[2]
    made = subprocess.run([source / "scripts/python-wheel", tmp_path, build], check=True, capture_output=True, text=True)
    wheel = pathlib.Path(made.stdout.strip())
    assert wheel.name.startswith(f"cotan-{cotan.__version__}-py3-none-linux_")
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
