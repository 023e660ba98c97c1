"""The names of version 0.2 work in this version, and say what to write instead. Deleted with cotan/_old_names.py."""

import importlib

import numpy as np
import pytest

import cotan
from cotan import _old_names


@pytest.mark.parametrize("old", sorted(_old_names.NAMES))
def test_an_old_name_is_the_new_one_with_a_warning(old):
    with pytest.warns(DeprecationWarning, match=f"cotan.{old} is now called cotan.{_old_names.NAMES[old]}"):
        assert getattr(cotan, old) is getattr(cotan, _old_names.NAMES[old])


def test_the_old_module_can_be_imported():
    assert importlib.import_module("cotan.pictures") is importlib.import_module("cotan.images")
    with pytest.warns(DeprecationWarning):
        from cotan.pictures import read_picture
    assert read_picture is cotan.read_image


def test_old_arguments_are_the_new_ones(tmp_path):
    image = np.full((2, 3, 4), 7, np.uint8)
    with pytest.warns(DeprecationWarning, match="the argument picture is now called image"):
        cotan.write_image(file=tmp_path / "a.png", picture=image)
    assert (cotan.read_image(tmp_path / "a.png") == image).all()
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    with pytest.warns(DeprecationWarning, match="pictures is now called images"):
        assert cotan.load(tmp_path / "a.obj", pictures=False).warnings == cotan.load(tmp_path / "a.obj", images=False).warnings
    with pytest.raises(TypeError, match="picture"):
        cotan.write_image(tmp_path / "a.png", image=image, picture=image)


def test_the_images_of_a_conversion_have_their_old_name():
    conversion = object.__new__(cotan.Conversion)
    conversion.images = [1]
    with pytest.warns(DeprecationWarning, match="pictures is now called images"):
        assert conversion.pictures == [1]


def test_other_names_are_missing_as_in_any_module():
    assert not hasattr(cotan, "picture")
    with pytest.raises(ImportError, match="cannot import name 'no_such_thing'"):
        from cotan import no_such_thing  # noqa: F401
