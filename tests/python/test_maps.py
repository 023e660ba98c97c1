"""Maps as arrays against the command line on files, to the bit, and against mathematics."""

import json
import pathlib
import pickle

import numpy as np
import pytest

import cotan


def relief(side=96):
    """Heights of smooth, periodic bumps, and their slopes per texel."""
    x, y = np.meshgrid(np.arange(side), np.arange(side))
    a, b = 2 * np.pi / side * 3, 2 * np.pi / side * 2
    height = 2 * np.sin(a * x + 0.3) * np.cos(b * y) + np.cos(2 * b * y + a * x)
    along_x = 2 * a * np.cos(a * x + 0.3) * np.cos(b * y) - a * np.sin(2 * b * y + a * x)
    along_y = -2 * b * np.sin(a * x + 0.3) * np.sin(b * y) - 2 * b * np.sin(2 * b * y + a * x)
    return height, along_x, along_y


def normal_map(green_up=True, dtype=np.uint8):
    _, along_x, along_y = relief()
    normals = np.dstack([-along_x, along_y if green_up else -along_y, np.ones_like(along_x)])
    normals /= np.linalg.norm(normals, axis=2)[..., None]
    middle, scale = {np.uint8: (128, 127), np.uint16: (32768, 32767), np.float32: (0.5, 0.5)}[dtype]
    coded = middle + scale * normals
    return (coded if dtype == np.float32 else np.round(coded)).astype(dtype)


@pytest.fixture
def files(tmp_path):
    """A map and a detail as PNG files, and as the arrays that these contain."""
    base, detail = normal_map(), normal_map(dtype=np.uint16)[::2, ::2]
    cotan.write_image(tmp_path / "base.png", base)
    cotan.write_image(tmp_path / "detail.png", detail)
    return tmp_path, cotan.read_image(tmp_path / "base.png"), cotan.read_image(tmp_path / "detail.png")


def test_images_round_trip_through_files(tmp_path):
    for dtype, name in ((np.uint8, "a.png"), (np.uint16, "b.png"), (np.float32, "c.exr")):
        given = normal_map(dtype=dtype)
        cotan.write_image(tmp_path / name, given)
        read = cotan.read_image(tmp_path / name)
        assert read.dtype == dtype and (read[..., :3] == given).all()
        assert (read[..., 3] == (1 if dtype == np.float32 else np.iinfo(dtype).max)).all()
    with pytest.raises(cotan.UsageError, match="extension"):
        cotan.write_image(tmp_path / "a.txt", normal_map())
    with pytest.raises(cotan.OutputError):
        cotan.write_image(tmp_path / "nowhere" / "a.png", normal_map())
    with pytest.raises(cotan.InputError, match="no such file") as caught:
        cotan.read_image(tmp_path / "missing.png")
    assert caught.value.file == str(tmp_path / "missing.png")
    (tmp_path / "text.png").write_text("this is no picture")
    with pytest.raises(cotan.InputError, match="expected"):
        cotan.read_image(tmp_path / "text.png")


@pytest.mark.parametrize("green_up, word", [(True, "up"), (False, "down")])
def test_green_is_detected_from_the_relief(green_up, word, tmp_path, command):
    found = cotan.detect(normal_map(green_up))
    assert (found.green, found.confidence) == (word, "certain")
    assert np.sign(found.agreement) == (1 if green_up else -1) and found.reason
    cotan.write_image(tmp_path / "map.png", normal_map(green_up))
    assert command("map", "detect", tmp_path / "map.png").startswith(f"green: {word}")
    assert cotan.detect(tmp_path / "map.png") == found


def test_undecidable_values_are_none():
    flat = cotan.detect(np.full((32, 32, 3), 128, np.uint8))
    assert (flat.green, flat.swapped, flat.confidence) == ("undecidable", None, "none")
    assert cotan.describe(np.full((32, 32, 3), 128, np.uint8)).zero is None


def test_describe_reports_the_statistics_of_a_map():
    info = cotan.describe(normal_map())
    assert (info.content, info.zero, info.transfer, info.invalid) == ("tangent space", 128, "linear", 0)
    _, along_x, along_y = relief()
    tilt = np.degrees(np.arctan(np.hypot(along_x, along_y))).mean()
    assert abs(info.mean_tilt - tilt) < 0.5  # half a code is 0.3 degrees
    assert abs(info.mean_length - 1) < 0.01 and info.mean[2] > 0.5


def test_conversion_equals_the_command_line(files, command):
    folder, base, _ = files
    for source, to, bits in (("gltf", "directx", 8), ("opengl", "unity,xy", 16), ("gltf", "directx,biased", 8)):
        out = folder / "out.png"
        command("map", "convert", folder / "base.png", "--from", source, "--to", to, "--bits", bits, "-o", out)
        assert (cotan.map_convert(base, source, to, bits) == cotan.read_image(out)).all(), (source, to)


CHANNELS = {
    "xy.png": [], "ag.png": ["--swizzle", "ag"], "ra.png": ["--swizzle", "ra"],
    "rg.ktx2": [], "bc5.ktx2": ["--compress", "bc5"], "bc5.dds": ["--compress", "bc5"],
}  # fmt: skip


def damaged(kind, pixels):
    """The map as a wrong export stores it."""
    made = pixels.copy()
    if kind == "srgb":
        x = pixels[..., :3] / 255
        made[..., :3] = np.round(255 * np.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055))
    else:
        made[..., :3] = pixels[..., [2, 1, 0] if kind == "bgr" else [1, 0, 2]]
    return made


@pytest.mark.parametrize("stored, shift", [("opengl", 0), ("directx", 31)])
def test_maps_are_read_as_by_the_command_line(stored, shift, tmp_path, command):
    """Two channels wherever they are, and broken maps; stated and found; from files and from arrays."""
    given = np.roll(normal_map(stored == "opengl"), shift, axis=1)
    cotan.write_image(tmp_path / "given.png", given)
    cases = []
    for name, words in CHANNELS.items():
        to = ("--to", f"{stored},xy", *words, "-o", tmp_path / name)
        command("map", "convert", tmp_path / "given.png", "--from", stored, *to)
        stated = [stored] if name.startswith("bc5") else []  # these files say that they have two channels
        cases += [(name, source) for source in (*stated, f"{stored},xy", "auto")]
    for kind in ("srgb", "bgr", "grb"):
        cotan.write_image(tmp_path / f"{kind}.png", damaged(kind, given))
        cases += [(f"{kind}.png", f"{stored},{kind}"), (f"{kind}.png", "auto")]
    out = tmp_path / "out.png"
    for name, source in cases:
        words = ("--from", source, "--to", "unity", "--bits", 8, "-o", out, "--overwrite", "--quiet")
        command("map", "convert", tmp_path / name, *words)
        wanted = cotan.read_image(out)
        for map in (tmp_path / name, cotan.read_image(tmp_path / name)):
            assert (cotan.map_convert(map, source, "unity", bits=8) == wanted).all(), (name, source)
        if source != "auto":
            continue
        words = ("--from", source, "--to", "opengl", "--compress", "bc7", "--mips", "-o", tmp_path / "blocks.ktx2")
        command("map", "convert", tmp_path / name, *words, "--overwrite", "--quiet")
        made = cotan.map_texture(tmp_path / name, source, "opengl", "bc7")
        assert made.data == (tmp_path / "blocks.ktx2").read_bytes(), (name, source)
    with pytest.raises(cotan.InputError, match="auto: expected a normal map whose green can be told"):
        cotan.map_convert(np.full((32, 32, 3), (128, 128, 255), np.uint8), "auto", "opengl")


@pytest.mark.parametrize("name", CHANNELS)
def test_two_channels_are_blended_and_filtered_as_by_the_command_line(name, files, command):
    folder, base, _ = files
    words = ("--from", "gltf", "--to", "gltf,xy", *CHANNELS[name], "-o", folder / name)
    command("map", "convert", folder / "base.png", *words)
    map, words = folder / name, ("--from", "gltf,xy", "--quiet")
    command("map", "blend", map, map, *words, "--bits", 8, "-o", folder / "out.png")
    assert (cotan.map_blend(map, map, "gltf,xy", bits=8) == cotan.read_image(folder / "out.png")).all()
    command("map", "to-height", map, *words, "--bits", "float", "-o", folder / "height.exr")
    assert (cotan.map_to_height(map, "gltf,xy") == cotan.read_image(folder / "height.exr")[..., 0]).all()
    command("map", "mips", map, *words, "-o", folder / "level.png")
    for number, level in enumerate(cotan.map_mips(cotan.read_image(map), "gltf,xy")):
        assert (level.map == cotan.read_image(folder / f"level_{number}.png")).all(), number
        assert (level.roughness == cotan.read_image(folder / f"level_roughness_{number}.png")).all(), number


def test_green_is_reversed_between_opengl_and_directx(files):
    _, base, _ = files
    turned = cotan.map_convert(base, "opengl", "directx")
    assert (turned[..., 1] == 256 - base[..., 1].astype(int)).all()
    assert (cotan.map_convert(turned, "directx", "opengl") == base).all()


def test_heights_become_the_normals_of_their_slopes():
    height, along_x, along_y = relief(256)
    normals = np.dstack([-along_x, along_y, np.ones_like(along_x)])  # rows run down, green up
    normals /= np.linalg.norm(normals, axis=2)[..., None]
    made = cotan.map_from_height(height.astype(np.float32), 1.0, bits=32)[..., :3] * 2 - 1
    assert np.abs(made - normals).max() < 2e-3  # error of central differences for a wave of 64 texels
    back = cotan.map_to_height(cotan.map_from_height(height.astype(np.float32), 1.0, bits=32))
    assert np.abs(back - (height - height.mean())).max() < 0.05
    assert abs(back.mean()) < 1e-4


def test_heights_from_files_equal_the_command_line(tmp_path, command):
    height = relief()[0]
    grey = np.round((height - height.min()) / np.ptp(height) * 65535).astype(np.uint16)
    cotan.write_image(tmp_path / "height.png", grey)
    # 2 m across 96 texels, 5 cm from black to white.
    command("map", "from-height", tmp_path / "height.png", "--metres", 2, "--range", 0.05, "-o", tmp_path / "map.png")
    made = cotan.map_from_height(tmp_path / "height.png", 0.05 * 96 / 2, bits=16)
    assert (made == cotan.read_image(tmp_path / "map.png")).all()


def test_blending_equals_the_command_line(files, command):
    folder, base, _ = files
    cotan.write_image(folder / "over.png", base[::-1])
    for mode in ("reoriented", "whiteout", "udn", "slopes", "linear"):
        command("map", "blend", folder / "base.png", folder / "over.png", "--mode", mode, "-o", folder / "out.png")
        made = cotan.map_blend(base, folder / "over.png", mode=mode, convention="opengl")
        assert (made == cotan.read_image(folder / "out.png")).all(), mode


def test_levels_halve_to_one_texel_and_stay_unit():
    levels = cotan.map_mips(normal_map(dtype=np.uint16))
    assert [level.map.shape[0] for level in levels] == [96, 48, 24, 12, 6, 3, 1]
    first = levels[0].map[..., :3].astype(int) - normal_map(dtype=np.uint16)
    assert np.abs(first).max() <= 1  # normalised again
    last = (levels[-1].map[0, 0, :3].astype(float) - 32768) / 32767
    assert abs(np.linalg.norm(last) - 1) < 1e-3 and last[2] > 0.99  # a periodic relief has no mean tilt
    assert levels[-1].roughness[0, 0, 0] > levels[0].roughness[0, 0, 0]


def test_zero_in_floats_is_one_half_not_128_of_255():
    flat = np.full((2, 2, 3), 128, np.uint8)
    floats = cotan.map_convert(flat, "gltf,exact", "gltf,exact", bits=32)
    assert (floats[..., :2] == 0.5).all()
    divided = cotan.map_convert((flat / 255).astype(np.float32), "gltf,exact", "gltf,exact", bits=16)
    assert (divided[..., :2] == 32896).all()  # 0.50196: a third of a degree


@pytest.mark.parametrize("value", [np.nan, np.inf, -0.1, 1.5, 255.0])
def test_floats_out_of_range_are_refused_with_row_and_column(value, files):
    _, base, _ = files
    bad = np.full((4, 6, 3), 0.5, np.float32)
    bad[2, 3, 1] = value
    expected = "found (nan|inf) at row 2, column 3" if not np.isfinite(value) else "floats from 0 to 1 as gltf(,exact)? stores them"
    for call in (
        lambda: cotan.map_convert(bad, "gltf", "directx"),
        lambda: cotan.map_to_height(bad),
        lambda: cotan.map_mips(bad),
        lambda: cotan.map_blend(bad, base),
        lambda: cotan.map_blend(base, bad),
    ):
        with pytest.raises(cotan.InputError, match=expected):
            call()
    if not np.isfinite(value):
        with pytest.raises(cotan.InputError, match="height: expected finite numbers"):
            cotan.map_from_height(bad, 1.0)


def test_floats_in_the_range_of_the_convention_are_accepted():
    signed = np.zeros((4, 4, 3), np.float32)
    signed[..., 0], signed[..., 2] = -0.6, 0.8
    made = cotan.map_convert(signed, "gltf,signed", "gltf", bits=8)
    assert (made[0, 0, :3] == (51, 128, 230)).all()
    slopes = np.full((4, 4, 3), 2.5, np.float32)
    cotan.map_convert(slopes, "unity,slope", "gltf", bits=8)


def test_missing_and_unwritable_files_raise_errors_of_python_too(tmp_path):
    for call in (
        lambda: cotan.read_image(tmp_path / "gone.png"),
        lambda: cotan.load(tmp_path / "gone.obj"),
        lambda: cotan.convert(tmp_path / "gone.glb"),
        lambda: cotan.detect(tmp_path / "gone.png"),
    ):
        with pytest.raises(FileNotFoundError, match="no such file") as caught:
            call()
        error = caught.value
        assert isinstance(error, cotan.InputError) and isinstance(error, cotan.MissingFileError)
        assert error.errno == 2 and pathlib.Path(error.filename).name.startswith("gone.")
        again = pickle.loads(pickle.dumps(error))
        assert str(again) == str(error) and again.file == error.file and again.errno == 2
    (tmp_path / "text.png").write_text("no picture")
    with pytest.raises(cotan.InputError) as broken:
        cotan.read_image(tmp_path / "text.png")
    assert not isinstance(broken.value, OSError)
    with pytest.raises(OSError, match="nowhere does not exist") as unwritten:
        cotan.write_image(tmp_path / "nowhere" / "a.png", normal_map())
    assert isinstance(unwritten.value, cotan.OutputError) and str(unwritten.value) == unwritten.value.args[0]


WORDS = [  # compress, to, swizzle
    ("none", "gltf,exact", "auto"), ("bc3", "gltf,xy", "ag"), ("bc5", "gltf", "rg"), ("bc5", "unity,xy,exact", "auto"),
    ("bc5-snorm", "gltf,xy", "auto"), ("bc7", "directx", "auto"), ("uastc", "gltf", "auto"), ("eac-rg11", "gltf,xy", "auto"),
    ("astc-4x4", "gltf", "auto"), ("astc-6x6", "gltf,xy", "rrrg"), ("astc-8x8", "opengl,xy", "ag"),
]  # fmt: skip


@pytest.mark.parametrize("compress, to, swizzle", WORDS)
def test_textures_have_the_bytes_and_the_degrees_of_the_command_line(compress, to, swizzle, tmp_path, command):
    given = normal_map(dtype=np.uint16)[:45, :70]  # no whole blocks
    cotan.write_image(tmp_path / "map.png", given)
    for container in ("ktx2", "dds") if compress in ("none", "bc3", "bc5", "bc5-snorm", "bc7") else ("ktx2",):
        for mips in (True, False):
            file = tmp_path / f"map.{container}"
            words = ["--from", "gltf,exact", "--to", to, "--compress", compress, "--swizzle", swizzle]
            command("map", "convert", tmp_path / "map.png", *words, *["--mips"][:mips], "-o", file)
            made = cotan.map_texture(given, "gltf,exact", to, compress, swizzle, container, mips)
            assert made.data == file.read_bytes()
            assert made.levels == (7 if mips else 1)
            heat = tmp_path / "diff.json"
            command("map", "diff", tmp_path / "map.png", file, "--from", "gltf,exact", "--to", read_as(to, compress), "--json", heat)
            degrees = json.loads(heat.read_text())["angles"]
            assert abs(made.mean_degrees - degrees["mean_degrees"]) < 1e-6 and abs(made.percentile99_degrees - degrees["percentile99_degrees"]) < 1e-6
            assert 0 < made.mean_degrees < 3


def read_as(to, compress):
    """The convention that `map convert` names for the file."""
    two = compress in ("bc3", "bc5", "bc5-snorm", "eac-rg11") and "xy" not in to
    exact = compress == "bc5-snorm" and "exact" not in to
    return to + (",xy" if two else "") + (",exact" if exact else "")


def test_textures_are_refused_in_the_words_of_the_caller():
    given = normal_map()
    for wrong, words in (
        ({"compress": "bc6"}, r"compress: expected one of none, bc3"),
        ({"compress": "astc-4x4", "container": "dds"}, r"compress: astc-4x4 is for .ktx2 files"),
        ({"container": "png"}, r"container: expected ktx2 or dds, found 'png'"),
        ({"compress": "bc7", "to": "gltf,xy"}, r"to: bc7 holds x, y and z"),
        ({"swizzle": "ra", "compress": "bc5"}, r"swizzle: expected one of auto, rg"),
        ({"frame": "sideways"}, r"frame: expected one of"),
        ({"to": "gltf,objectspace"}, r"to: "),
    ):
        with pytest.raises(cotan.UsageError, match=words):
            cotan.map_texture(given, **wrong)


def test_a_texture_of_a_file_keeps_the_frame_that_it_is_told(tmp_path, command):
    cotan.write_image(tmp_path / "map.png", normal_map())
    made = cotan.map_texture(tmp_path / "map.png", frame="smooth", compress="bc5")
    assert b"cotanFrame\0smooth\0" in made.data
    assert b"cotanFrame" not in cotan.map_texture(tmp_path / "map.png", compress="bc5").data
