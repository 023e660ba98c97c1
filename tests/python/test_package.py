"""The package itself: where it looks for the library, how it installs, what it says of itself."""

import inspect
import os
import pathlib
import shutil
import subprocess
import sys
import typing

import pytest

import cotan

LIBRARY = os.environ.get("COTAN_LIBRARY", "")


def without(*names):
    """The variables of this process but those."""
    return {name: value for name, value in os.environ.items() if name not in names}


def run(program, package, **environment):
    """What a Python that has the package in `package` prints."""
    variables = dict(without("COTAN_LIBRARY"), PYTHONPATH=str(package), **environment)
    done = subprocess.run([sys.executable, "-c", program], env=variables, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


SAY = """
import cotan
try:
    print(cotan.library_path(), cotan.library_version())
except cotan.UnavailableError as error:
    print(error)
"""


@pytest.fixture
def copy(source, tmp_path):
    """The package in a folder of its own."""
    shutil.copytree(source / "bindings/python/cotan", tmp_path / "cotan", ignore=shutil.ignore_patterns("*.so*"))
    return tmp_path


def test_a_library_inside_the_package_comes_first(copy):
    inside = copy / "cotan" / "libcotan.so.0"
    inside.symlink_to(pathlib.Path(LIBRARY).resolve())
    assert run(SAY, copy, COTAN_LIBRARY="/nowhere/libcotan.so") == f"{inside} {cotan.__version__}"


def test_then_the_one_that_the_variable_names(copy):
    assert run(SAY, copy, COTAN_LIBRARY=LIBRARY) == f"{LIBRARY} {cotan.__version__}"


def test_then_the_systems(copy, tmp_path):
    (tmp_path / "libcotan.so.0").symlink_to(pathlib.Path(LIBRARY).resolve())
    assert run(SAY, copy, LD_LIBRARY_PATH=str(tmp_path)) == f"libcotan.so.0 {cotan.__version__}"


def test_a_missing_library_is_said_when_it_is_needed_with_what_to_do(copy):
    said = run(SAY, copy, COTAN_LIBRARY="/nowhere/libcotan.so", LD_LIBRARY_PATH="")
    if said.startswith("libcotan.so.0 "):
        pytest.skip("skipped: this system has a libcotan")
    assert said.startswith("libcotan is missing") and "COTAN_LIBRARY" in said and "libcotan0" in said
    assert "/nowhere/libcotan.so" in said and "\n" not in said


def test_what_is_no_libcotan_is_said(copy, tmp_path):
    (tmp_path / "text.so").write_text("this is no library")
    assert "text.so" in run(SAY, copy, COTAN_LIBRARY=str(tmp_path / "text.so"), LD_LIBRARY_PATH="")
    program = tmp_path / "old.c"
    program.write_text("int cotan_api_version(void) { return 2; }\n")
    subprocess.run(["cc", "-shared", "-fPIC", program, "-o", tmp_path / "old.so"], check=True)
    said = run(SAY, copy, COTAN_LIBRARY=str(tmp_path / "old.so"), LD_LIBRARY_PATH="")
    assert "expected version 3 of its interface or later, found 2" in said


def public():
    return [getattr(cotan, name) for name in cotan.__all__ if not inspect.ismodule(getattr(cotan, name))]


def test_everything_public_says_what_it_does():
    assert len(public()) > 35
    for thing in public():
        if callable(thing):
            assert inspect.getdoc(thing), thing


def test_everything_public_is_typed():
    assert (pathlib.Path(cotan.__file__).parent / "py.typed").exists()
    for thing in public():
        if inspect.isfunction(thing):
            hints = typing.get_type_hints(thing)
            assert set(hints) == {*inspect.signature(thing).parameters, "return"}, thing.__name__


def test_every_function_of_the_c_api_is_reached(source):
    from cotan import _structs

    text = "".join(file.read_text() for file in (source / "bindings/python/cotan").glob("*.py") if file.name != "_structs.py")
    left_out = {name for name in _structs.FUNCTIONS if f'"{name}"' not in text and f".{name}" not in text}
    assert left_out == {"cotan_bake"}  # cotan_bake_models does it


def installed(place, *words):
    """A Python of its own that sees numpy, with the package in it."""
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
cotan.write_picture("a.exr", np.zeros((2, 2, 4), np.float32))
print(cotan.read_picture("a.exr").dtype)
"""


def test_a_wheel_that_carries_the_library_works_where_it_is_installed(source, tmp_path):
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


def test_pip_installs_the_sources_for_a_library_that_is_elsewhere(source, tmp_path):
    needs("setuptools", "wheel", "pip")
    shutil.copytree(source / "bindings/python", tmp_path / "sources", ignore=shutil.ignore_patterns("build", "*.egg-info"))
    python = installed(tmp_path / "environment", tmp_path / "sources")
    done = subprocess.run([python, "-c", SQUARE], env=without("PYTHONPATH"), cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split()[1] == LIBRARY
