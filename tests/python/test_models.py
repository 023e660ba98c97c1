"""glTF models: judged and converted, against mathematics and, to the bit, against the command line."""

import json
import os
import subprocess
import sys

import numpy as np
import pytest

import cotan
from shapes import CODES, degrees, stretched_gltf, write_stretched


@pytest.fixture
def model(tmp_path):
    return write_stretched(tmp_path)


# The map's one texel after rounding to 8 bits, and its error in the frame `cotangent`, which halves slopes along u.
STORED = (CODES.astype(float) - 128) / 127
OFF = degrees(STORED, STORED * [0.5, 1, 1])


def test_lint_states_the_error_of_each_frame(model):
    found = cotan.lint(model)
    assert abs(found.cotangent_degrees - OFF) < 0.01 and abs(found.orthonormal_degrees) < 0.01
    assert (found.primitives, found.maps, found.distrust_stored) == (1, 1, False)
    assert found.report["primitives"][0]["triangles"] == 2
    assert found.recommendation == found.report["recommendation"]


def test_lint_equals_the_command_line(model, command):
    said = json.loads(command("lint", model, "--json", "-", "--quiet"))
    found = cotan.lint(model)
    for name in ("recommendation", "distance", "primitives", "maps", "fits", "warnings"):
        assert found.report[name] == said[name], name
    far = cotan.lint(model, distance=5)
    assert far.report["distance"] == 5


def test_a_limit_makes_lint_a_check(model):
    assert cotan.lint(model).passed is None
    assert cotan.lint(model, limit=OFF + 1, frame="cotangent").passed is True
    found = cotan.lint(model, limit=OFF - 1, frame="cotangent")
    assert found.passed is False
    assert [f["kind"] for f in found.report["check"]["failures"]] == ["reading"]
    assert cotan.lint(model, limit=OFF - 1).passed is True  # for the frame orthonormal


def test_lint_is_equal_for_files_bytes_and_loaded_models(model, tmp_path):
    texel = (tmp_path / "the map.png").read_bytes()
    beside = {"plane.bin": (tmp_path / "plane.bin").read_bytes(), "the map.png": texel}
    expected = cotan.lint(model)
    assert cotan.lint(model.read_bytes(), beside=beside) == expected
    assert cotan.lint(bytearray(model.read_bytes()), beside=beside) == expected
    assert cotan.lint(cotan.load(model)) == expected
    assert cotan.lint(str(model)) == expected


def test_without_a_map_degrees_are_none_not_0(model):
    plain = json.loads(model.read_text())
    del plain["materials"][0]["normalTexture"]
    model.write_text(json.dumps(plain))
    assert cotan.lint(model).cotangent_degrees is None and cotan.lint(model).advice is None
    converted = cotan.convert(model)
    assert (converted.maps_converted, converted.maps_kept, converted.worst_degrees_after) == (0, 0, None)


def test_lint_reads_other_formats_too(tmp_path):
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert cotan.lint(tmp_path / "a.obj").primitives == 1


def test_convert_makes_the_texel_twice_as_steep_and_drops_tangents(model, tmp_path):
    done = cotan.convert(model, tmp_path / "out.glb", to_frame="cotangent")
    assert done.glb is None and (done.maps_converted, done.maps_kept, done.tangent_bytes_dropped) == (1, 0, 64)
    assert done.worst_degrees_after < 0.5 < done.worst_degrees_before
    whole = (tmp_path / "out.glb").read_bytes()
    length = int.from_bytes(whole[12:16], "little")
    document = json.loads(whole[20 : 20 + length])
    assert "TANGENT" not in document["meshes"][0]["primitives"][0]["attributes"]
    view = document["bufferViews"][document["images"][0]["bufferView"]]
    start = 28 + length + view.get("byteOffset", 0)
    (tmp_path / "new.png").write_bytes(whole[start : start + view["byteLength"]])
    texel = (cotan.read_image(tmp_path / "new.png")[4, 4, :3].astype(float) - 128) / 127
    assert degrees(texel, STORED * [2, 1, 1]) < 0.5  # half a code is 0.3 degrees


@pytest.mark.parametrize(
    "options",
    [{"to_frame": "smooth"}, {"to_frame": "cotangent", "bits": 16}, {"to_frame": "orthonormal", "tangents": "generated"},
     {"to_frame": "cotangent", "keep_tangents": True}, {"keep_maps": True}, {}, {"max_degrees": 0.01},
     {"tangents": "generated"}],
    ids=lambda o: " ".join(map(str, o.values())),
)  # fmt: skip
def test_convert_writes_the_bytes_of_the_command_line(options, model, command, tmp_path):
    words = []
    for name, value in options.items():
        words += [f"--{name.replace('_', '-')}"] + ([] if value is True else [str(value)])
    command("convert", model, "-o", tmp_path / "expected.glb", *words)
    cotan.convert(model, tmp_path / "out.glb", **options)
    assert (tmp_path / "out.glb").read_bytes() == (tmp_path / "expected.glb").read_bytes()
    assert cotan.convert(model, **options).glb == (tmp_path / "expected.glb").read_bytes()


def test_frames_are_chosen_within_the_limit(model):
    """On a flat square orthonormal is right, whatever the limit; lint says the same."""
    converted = cotan.convert(model)
    assert (converted.maps_converted, converted.maps_kept, converted.tangent_bytes_dropped) == (0, 1, 64)
    (decision,) = converted.report["decisions"]
    assert (decision["frame"], decision["reason"], decision["meaning"]) == ("orthonormal", "fits", "stored")
    (predicted,) = cotan.lint(model, max_degrees=1e-3).report["decisions"]
    assert {**predicted, "primitive": 0} == decision
    for wrong in (0, -1, 181, float("nan"), "little"):
        for work in (cotan.lint, cotan.convert):
            with pytest.raises(cotan.UsageError, match="max_degrees"):
                work(model, max_degrees=wrong)


def test_keep_maps_requires_a_frame_without_tangents(model):
    converted = cotan.convert(model, keep_maps=True)
    assert (converted.maps_converted, converted.maps_kept) == (0, 1)
    assert converted.tangent_bytes_dropped > 0
    assert cotan.Conversion(model, keep_maps=True).images == []
    for wrong, message in (
        ({"to_frame": "mikktspace"}, "to: expected a frame without tangents"),
        ({"bits": 16}, "bits: expected 0 where maps are kept"),
    ):
        with pytest.raises(cotan.UsageError, match=message):
            cotan.convert(model, keep_maps=True, **wrong)


def test_inputs_are_replaced_only_with_overwrite(model, tmp_path):
    cotan.convert(model, tmp_path / "out.glb")
    before = (tmp_path / "out.glb").read_bytes()
    os.link(tmp_path / "out.glb", tmp_path / "link.glb")
    with pytest.raises(cotan.UsageError, match="overwrite") as caught:
        cotan.convert(tmp_path / "out.glb", tmp_path / "link.glb", from_frame="cotangent", to_frame="mikktspace")
    assert caught.value.field == "out" and (tmp_path / "out.glb").read_bytes() == before
    cotan.convert(tmp_path / "out.glb", tmp_path / "out.glb", "mikktspace", "cotangent", overwrite=True)
    assert (tmp_path / "out.glb").read_bytes() != before


def test_failed_conversion_leaves_no_file(model, tmp_path):
    (tmp_path / "out.glb").write_bytes(b"older")
    (tmp_path / "the map.png").write_bytes(b"broken")
    names = sorted(os.listdir(tmp_path))
    with pytest.raises(cotan.InputError) as caught:
        cotan.convert(model, tmp_path / "out.glb")
    assert caught.value.file == str(model) and "map.png" in str(caught.value)
    with pytest.raises(cotan.UsageError, match="glb"):
        cotan.convert(model, tmp_path / "out.txt")
    with pytest.raises(cotan.OutputError, match="folder"):
        cotan.convert(model, tmp_path / "nowhere" / "out.glb")
    assert sorted(os.listdir(tmp_path)) == names and (tmp_path / "out.glb").read_bytes() == b"older"


def test_errors_name_file_field_expected_and_found(model, tmp_path):
    document = json.loads(model.read_text())
    document["accessors"][3]["count"] = 3
    model.write_text(json.dumps(document))
    for call in (cotan.lint, cotan.convert, cotan.load, cotan.render):
        with pytest.raises(cotan.InputError) as caught:
            call(model)
        error = caught.value
        assert (error.file, error.field) == (str(model), "meshes[0].primitives[0].TEXCOORD_0")
        assert (error.expected, error.found) == ("accessors[3] with 4 elements", "3")


@pytest.mark.parametrize("content", [b"", b"{", b"glTF", b"glTF\x02\0\0\0\xff\xff\xff\xff", b"\0" * 100, b"[]"])
def test_errors_of_broken_files_and_bytes_are_one_line(content, tmp_path):
    for name in ("a.glb", "a.gltf"):
        (tmp_path / name).write_bytes(content)
        for call in (cotan.lint, cotan.convert, cotan.load, cotan.render):
            with pytest.raises(cotan.InputError) as caught:
                call(tmp_path / name)
            assert caught.value.file == str(tmp_path / name) and "\n" not in str(caught.value)
    for call in (cotan.lint, cotan.convert, cotan.render):
        with pytest.raises(cotan.InputError):
            call(content)


def test_missing_files_and_folders_are_named(tmp_path):
    for call in (cotan.lint, cotan.convert, cotan.load, cotan.render):
        for file in (tmp_path / "missing.glb", tmp_path):
            with pytest.raises(cotan.InputError) as caught:
                call(file)
            assert caught.value.file == str(file)
    for call in (cotan.lint, cotan.convert, cotan.render):
        with pytest.raises(cotan.UsageError, match="path or bytes"):
            call(3)


def test_only_files_in_the_folder_of_the_model_are_read(model, tmp_path):
    (tmp_path / "inside").mkdir()
    (tmp_path / "outside.bin").write_bytes((tmp_path / "plane.bin").read_bytes())
    for name in ("plane.bin", "the map.png"):
        (tmp_path / name).rename(tmp_path / "inside" / name)
    (tmp_path / "inside/link.bin").symlink_to(tmp_path / "outside.bin")
    document = json.loads(model.read_text())
    for uri in ("plane.bin", "../outside.bin", str(tmp_path / "outside.bin"), "link.bin"):
        document["buffers"][0]["uri"] = uri
        (tmp_path / "inside/plane.gltf").write_text(json.dumps(document))
        for call in (cotan.lint, cotan.convert):
            if uri == "plane.bin":
                call(tmp_path / "inside/plane.gltf")
                continue
            with pytest.raises(cotan.InputError, match="outside.bin|link.bin"):
                call(tmp_path / "inside/plane.gltf")


def test_exceptions_of_the_callers_files_are_raised(model):
    class Broken(dict):
        def __contains__(self, key):
            raise ZeroDivisionError(key)

    for call in (cotan.lint, cotan.convert, cotan.render):
        with pytest.raises(ZeroDivisionError):
            call(model.read_bytes(), beside=Broken(a=b""))
        with pytest.raises(cotan.InputError, match="plane.bin"):
            call(model.read_bytes())


def test_real_models_convert_as_on_the_command_line(data, command, tmp_path):
    model = data("models/NormalTangentMirrorTest/NormalTangentMirrorTest.glb")
    command("convert", model, "--to-frame", "smooth", "-o", tmp_path / "expected.glb")
    assert cotan.convert(model, to_frame="smooth").glb == (tmp_path / "expected.glb").read_bytes()


def test_models_keep_their_warnings(model):
    document = json.loads(model.read_text())
    document["extensionsUsed"] = ["EXT_nobody_knows"]
    model.write_text(json.dumps(document))
    loaded, expected = cotan.load(model), cotan.lint(model).report["warnings"]
    assert loaded.warnings == expected
    assert isinstance(np.array(loaded.warnings), np.ndarray)


def test_decoders_and_encoders_of_the_caller_are_called(model, tmp_path):
    expected = cotan.convert(model, to_frame="cotangent").glb
    asked = []

    def decode(name, content):
        asked.append(name)
        (tmp_path / "asked.png").write_bytes(content)
        return cotan.read_image(tmp_path / "asked.png")

    def encode(picture):
        asked.append(picture.shape)
        cotan.write_image(tmp_path / "written.png", picture)
        return (tmp_path / "written.png").read_bytes()

    converted = cotan.convert(model, to_frame="cotangent", decode=decode, encode=encode)
    # What was encoded is decoded, too: the report says what the encoder lost.
    assert asked[0].endswith("the%20map.png") and asked[1:] == [(8, 8, 4), asked[0]]
    (tmp_path / "a.glb").write_bytes(expected)
    (tmp_path / "b.glb").write_bytes(converted.glb)
    assert cotan.lint(tmp_path / "a.glb").cotangent_degrees == cotan.lint(tmp_path / "b.glb").cotangent_degrees

    def broken(*_):
        raise ZeroDivisionError

    for own in ({"decode": broken}, {"encode": broken}):
        with pytest.raises(ZeroDivisionError):
            cotan.convert(model, to_frame="cotangent", **own)
    with pytest.raises(cotan.UsageError, match="decode: expected shape"):
        cotan.convert(model, decode=lambda name, content: np.zeros(3, np.uint8))


def test_the_decoder_gets_the_same_name_when_frames_are_chosen_and_the_map_stays(model, tmp_path):
    asked = []

    def decode(name, content):
        asked.append(name)
        (tmp_path / "asked.png").write_bytes(content)
        return cotan.read_image(tmp_path / "asked.png")

    done = cotan.convert(model, decode=decode)
    assert done.maps_kept == 1 and done.report["decisions"][0]["frame"] == "orthonormal"
    assert len(asked) == 2 and all(name.endswith("the%20map.png") for name in asked)


def test_conversion_in_two_steps_equals_one_call(model, tmp_path):
    def png(picture):
        cotan.write_image(tmp_path / "step.png", picture)
        return (tmp_path / "step.png").read_bytes()

    conversion = cotan.Conversion(model, to_frame="cotangent")
    assert [p.shape for p in conversion.images] == [(8, 8, 4)]
    with pytest.raises(cotan.UsageError):
        conversion.end()
    with pytest.raises(cotan.UsageError):
        conversion.set(1, b"")
    conversion.set(0, png(conversion.images[0]))
    steps, whole = conversion.end(), cotan.convert(model, to_frame="cotangent", encode=png)
    assert len(steps.glb) == len(whole.glb) and steps.worst_degrees_after == whole.worst_degrees_after
    assert steps.report["maps"] == whole.report["maps"]


def test_images_of_a_model_are_listed_as_stored(model, tmp_path):
    stored = (tmp_path / "the map.png").read_bytes()
    for maps_only in (False, True):
        assert [content for _, content in cotan.model_images(model, maps_only)] == [stored]


def run(program):
    """Output of the program in a separate Python process, which must succeed."""
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


LOAD = """
import cotan, ctypes, sys
from cotan._library import library
{before}
try:
    cotan.load({file!r})
    print("read")
except cotan.Error as error:
    print(type(error).__name__, error.file, str(error))
"""


def test_failing_reader_process_is_one_line_error(tmp_path):
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    file = str(tmp_path / "a.obj")
    assert run(LOAD.format(before="", file=file)) == "read\n"
    before = 'library().cotan_set_reader(1, (ctypes.c_char_p * 1)(b"/bin/false"), None, 0)'
    said = run(LOAD.format(before=before, file=file))
    assert said.startswith(f"InputError {file} {file}: the reader of OBJ files") and said.count("\n") == 1, said
    assert run(LOAD.format(before="library(); library().cotan_set_reader(0, None, None, 0)", file=file)) == "read\n"


def test_a_file_that_crashes_its_reader_is_an_input_error(data):
    file = str(data("found/cycle.fbx"))
    said = run(LOAD.format(before="", file=file))
    assert said.startswith(f"InputError {file} ") and said.count("\n") == 1, said
