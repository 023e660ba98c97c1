"""The package itself: its search for the library, its installation, its docstrings and types."""

import inspect
import os
import pathlib
import shutil
import subprocess
import sys
import types
import typing

import pytest

import cotan

LIBRARY = os.environ.get("COTAN_LIBRARY", "")


def without(*names):
    """The environment variables of this process except `names`."""
    return {name: value for name, value in os.environ.items() if name not in names}


def run(program, package, **environment):
    """Output of a Python process that has the package in `package`."""
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
    """A copy of the package in a separate folder."""
    shutil.copytree(source / "bindings/python/cotan", tmp_path / "cotan", ignore=shutil.ignore_patterns("*.so*"))
    return tmp_path


def test_a_library_inside_the_package_comes_first(copy):
    inside = copy / "cotan" / "libcotan.so.0"
    inside.symlink_to(pathlib.Path(LIBRARY).resolve())
    assert run(SAY, copy, COTAN_LIBRARY="/nowhere/libcotan.so") == f"{inside} {cotan.__version__}"


def test_environment_variable_comes_second(copy):
    assert run(SAY, copy, COTAN_LIBRARY=LIBRARY) == f"{LIBRARY} {cotan.__version__}"


def test_system_library_comes_third(copy, tmp_path):
    (tmp_path / "libcotan.so.0").symlink_to(pathlib.Path(LIBRARY).resolve())
    assert run(SAY, copy, LD_LIBRARY_PATH=str(tmp_path)) == f"libcotan.so.0 {cotan.__version__}"


def test_missing_library_error_says_how_to_install(copy):
    said = run(SAY, copy, COTAN_LIBRARY="/nowhere/libcotan.so", LD_LIBRARY_PATH="")
    if said.startswith("libcotan.so.0 "):
        pytest.skip("skipped: this system has a libcotan")
    assert said.startswith("libcotan is missing") and "COTAN_LIBRARY" in said and "libcotan0" in said
    assert "/nowhere/libcotan.so" in said and "\n" not in said


def test_first_sufficient_library_is_loaded_and_others_are_named(monkeypatch):
    from cotan import _library

    least = _library.API_VERSION
    found = {"older": least - 1, "least": least, "newer": least + 1, "ancient": 0}
    prepared = []

    def opened(name):
        if name not in found:
            raise OSError("no such library")
        return types.SimpleNamespace(cotan_api_version=lambda: found[name], name=name)

    def taken(*names):
        prepared.clear()
        monkeypatch.setattr(_library, "_candidates", lambda: iter(names))
        library, candidate = _library._open()
        assert library.name == candidate and prepared == [candidate, (candidate, candidate)]
        return candidate

    monkeypatch.setattr(_library.ctypes, "CDLL", opened)
    monkeypatch.setattr(_library, "_declare", lambda library: prepared.append(library.name))
    monkeypatch.setattr(_library, "_read_elsewhere", lambda library, candidate: prepared.append((library.name, candidate)))
    assert taken("least", "newer") == "least"
    assert taken("newer", "least") == "newer"
    assert taken("missing", "older", "ancient", "newer", "least") == "newer"
    with pytest.raises(cotan.UnavailableError) as refused:
        taken("missing", "older", "ancient")
    expected = f"expected interface version {least} or later, found"
    assert str(refused.value).endswith(f"(missing: no such library; older: {expected} {least - 1}; ancient: {expected} 0)")


def test_other_libraries_are_refused_by_name(copy, tmp_path):
    (tmp_path / "text.so").write_text("this is no library")
    assert "text.so" in run(SAY, copy, COTAN_LIBRARY=str(tmp_path / "text.so"), LD_LIBRARY_PATH="")
    program = tmp_path / "old.c"
    program.write_text("int cotan_api_version(void) { return 2; }\n")
    subprocess.run(["cc", "-shared", "-fPIC", program, "-o", tmp_path / "old.so"], check=True)
    said = run(SAY, copy, COTAN_LIBRARY=str(tmp_path / "old.so"), LD_LIBRARY_PATH="")
    assert "expected interface version 9 or later, found 2" in said


def public():
    return [getattr(cotan, name) for name in cotan.__all__ if not inspect.ismodule(getattr(cotan, name))]


def test_everything_public_has_a_docstring():
    assert len(public()) > 35
    for thing in public():
        if callable(thing):
            assert inspect.getdoc(thing), thing


def test_everything_imported_is_listed_for_type_checkers():
    """Type checkers read __all__ and treat everything else as private."""
    imported = {name for name, thing in vars(cotan).items() if not name.startswith("_") and not inspect.ismodule(thing)}
    assert imported | {"__version__"} == set(cotan.__all__)


def test_everything_public_is_typed():
    assert (pathlib.Path(cotan.__file__).parent / "py.typed").exists()
    for thing in public():
        if inspect.isfunction(thing):
            hints = typing.get_type_hints(thing)
            assert set(hints) == {*inspect.signature(thing).parameters, "return"}, thing.__name__


def test_every_function_of_the_c_api_is_used(source):
    from cotan import _structs

    text = "".join(file.read_text() for file in (source / "bindings/python/cotan").glob("*.py") if file.name != "_structs.py")
    left_out = {name for name in _structs.FUNCTIONS if f'"{name}"' not in text and f".{name}" not in text}
    # cotan_bake_maps and the variants with progress cover these
    assert left_out == {"cotan_bake", "cotan_bake_models", "cotan_tangents", "cotan_smooth_cotangents"}


def test_examples_of_the_page_run(source, tmp_path, monkeypatch):
    import re

    import numpy as np

    from shapes import bumps, write_obj, write_stretched

    monkeypatch.chdir(tmp_path)
    write_obj("low.obj", bumps(4))
    write_obj("high.obj", bumps(24))
    (tmp_path / "model.glb").write_bytes(cotan.convert(write_stretched(tmp_path), to_frame="mikktspace").glb)
    cotan.write_image("rocks.png", np.full((16, 16, 3), 128, np.uint8))
    for page in ("docs/reference/python.md", "bindings/python/README.md"):
        blocks = re.findall(r"```python\n(.*?)```", (source / page).read_text(), re.S)
        assert blocks
        names = {"low": bumps(4), "high": bumps(24)}
        for block in blocks:
            exec(compile(block, page, "exec"), names)
