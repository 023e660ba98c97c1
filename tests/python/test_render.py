"""Images as arrays: equal to those of `cotan render`, to the byte."""

import inspect

import numpy as np
import pytest

import cotan
from shapes import write_stretched


@pytest.fixture
def model(tmp_path):
    return write_stretched(tmp_path)


def words_of(options):
    words = []
    for name, value in options.items():
        words.append("--" + name.replace("_", "-"))
        if value is not True:
            words.append(",".join(map(str, value)) if isinstance(value, tuple) else value)
    return words


OPTIONS = [
    {"frame": "smooth"},
    {"view": "normal"},
    {"view": "error", "frame": "orthonormal"},
    {"view": "checker", "edges": "all"},
    {"camera": (1, 2, 3, 1, 0.5, 0), "environment": "none", "samples": 1},
    {"environment": "evening", "environment_rotation": -30.5, "background": "blur", "exposure": 1.5, "tone_mapping": "agx"},
    {"shading": "blinn-phong", "ground": "off", "no_normal_maps": True},
    {"tangents": "generated", "frame": "mikktspace"},
]


@pytest.mark.parametrize("options", OPTIONS, ids=lambda o: " ".join(map(str, o.values())))
def test_image_has_the_bytes_of_the_command_line(options, model, command, tmp_path):
    out = tmp_path / "out.png"
    command("render", model, "--size", "48x32", "--device", "reference", "-o", out, *words_of(options))
    picture = cotan.render(model, size=(48, 32), device="reference", **options)
    expected = cotan.read_image(out)
    assert picture.dtype == np.uint8 and (picture == expected).all()
    assert len(np.unique(picture.reshape(-1, 4), axis=0)) > 1  # the image is not empty


def test_floats_equal_those_of_an_exr_file(model, command, tmp_path):
    command("render", model, "--size", "48x32", "--device", "reference", "-o", tmp_path / "out.exr")
    picture = cotan.render(model, size="48x32", device="reference", floats=True)
    assert picture.dtype == np.float32 and (picture == cotan.read_image(tmp_path / "out.exr")).all()


def test_the_default_device_draws_as_the_command_line_does(model, command, tmp_path):
    command("render", model, "--size", "48x32", "-o", tmp_path / "out.png")
    assert (cotan.render(model, size=(48, 32)) == cotan.read_image(tmp_path / "out.png")).all()


def test_bytes_and_files_render_equally(model, tmp_path):
    expected = cotan.render(model, size=(48, 32), device="reference")
    beside = {"plane.bin": (tmp_path / "plane.bin").read_bytes(), "the map.png": (tmp_path / "the map.png").read_bytes()}
    assert (cotan.render(model.read_bytes(), size=(48, 32), device="reference", beside=beside) == expected).all()
    whole = cotan.convert(model, to_frame="mikktspace").glb
    drawn = cotan.render(memoryview(whole), size=(48, 32), device="reference")
    assert np.abs(drawn.astype(int) - expected).max() <= 3  # made for generated tangents: half a code apart


def test_own_maps_replace_those_of_the_model(model, command, tmp_path):
    flat = np.full((4, 4, 3), 128, np.uint8)
    flat[..., 2] = 255
    cotan.write_image(tmp_path / "flat.png", flat)
    picture = cotan.render(model, size=(48, 32), device="reference", view="normal", normal_map=tmp_path / "flat.png")
    plain = cotan.render(model, size=(48, 32), device="reference", view="normal", no_normal_maps=True)
    assert (picture == plain).all() and (picture != cotan.render(model, size=(48, 32), device="reference", view="normal")).any()


def test_normal_view_encodes_the_normal():
    eye = (0, 0, 3, 0, 0, 0, "h1")
    normals = cotan.render(shape="sphere", size=(33, 33), camera=eye, view="normal", device="reference", no_normal_maps=True)
    assert np.abs(normals[16, 16, :3].astype(int) - [128, 128, 255]).max() <= 1  # its centre faces the camera


def test_report_describes_the_render(model):
    report = {}
    cotan.render(model, size=(16, 16), device="reference", view="error", frame="cotangent", report=report)
    assert report["device"] == "reference" and report["triangles"] == 2 and report["warnings"] == []
    # The map is for MikkTSpace; cotangent halves slopes along u.
    assert report["frame_error"]["mean_degrees"] > 5, report["frame_error_against"]


def test_wrong_values_name_the_keyword():
    for options, field in (
        ({"samples": 3}, "samples"),
        ({"size": (0, 16)}, "size"),
        ({"size": (16, 16385)}, "size"),
        ({"size": "16x"}, "size"),
        ({"view": "nonsense"}, "view"),
        ({"frame": "nonsense"}, "frame"),
        ({"camera": "nonsense"}, "camera"),
        ({"environment_rotation": 1000}, "environment_rotation"),
        ({"exposure": -1}, "exposure"),
        ({"memory": 0}, "memory"),
        ({"time": 3.0}, "time"),
    ):
        with pytest.raises(cotan.UsageError) as caught:
            cotan.render(**options)
        assert caught.value.field == field and "--" not in str(caught.value), caught.value
        assert "\n" not in str(caught.value)
    with pytest.raises(cotan.UnavailableError, match="no such device"):
        cotan.render(shape="plane", size=(8, 8), device="no such device")


def test_values_cannot_inject_options(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for model in ("--help", "-o", "--size=8x8"):
        with pytest.raises(cotan.InputError, match="no such file"):
            cotan.render(model, size=(8, 8))
    with pytest.raises(cotan.UsageError):
        cotan.render(shape="plane --help")
    with pytest.raises(cotan.UsageError, match="zero bytes"):
        cotan.render(shape="plane\0")


def test_every_option_of_the_command_is_a_keyword(command):
    import re

    listed = set(re.findall(r"^  (?:-\w, )?--([a-z-]+)", command("render", "--help"), re.M))
    # Options for files and the terminal.
    elsewhere = {"help", "output", "json", "quiet", "overwrite", "frames", "rate", "turntable",
                 "list-frames"}
    keywords = {name.replace("_", "-") for name in inspect.signature(cotan.render).parameters}
    assert listed - elsewhere <= keywords
    assert keywords - listed == {"model", "floats", "report", "progress", "beside"}
