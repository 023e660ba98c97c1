"""Baking from arrays and files, against mathematics and, to the bit, against the command line."""

import numpy as np
import pytest

import cotan
from shapes import bumps, slope, square, write_obj


def test_a_slope_of_one_in_ten_tilts_by_a_tenth():
    rise = 0.1
    baked = cotan.bake(square(), slope(rise), size=16, max_distance=0.5)
    normal = np.array([-rise, 0, 1]) / np.hypot(rise, 1)
    assert np.abs(baked.map[..., :3].astype(float) - (128 + 127 * normal)).max() <= 0.5
    assert (baked.map[..., 3] == 255).all()
    assert (baked.texels, baked.covered, baked.missed, baked.twice) == (256, 256, 0, 0)
    assert abs(baked.ray_distance - 0.5) < 1e-6 and baked.warnings == [] and baked.mask is None


def test_green_direction_follows_the_convention():
    tilted = slope(0.2)
    tilted.positions = tilted.positions[:, [1, 0, 2]] * np.float32([1, 1, 1])
    tilted.normals = np.ascontiguousarray(tilted.normals[:, [1, 0, 2]])  # rises towards +y, up in the image
    tilted.indices = tilted.indices.reshape(-1, 3)[:, ::-1].ravel()
    leaning = 0.2 / np.hypot(0.2, 1)
    for convention, code in (("gltf", 127.5 - 127.5 * leaning), ("opengl", 128 - 127 * leaning), ("directx", 128 + 127 * leaning),
                             ("blender", 127.5 - 127.5 * leaning), ("unreal", 127.5 + 127.5 * leaning)):  # fmt: skip
        baked = cotan.bake(square(), tilted, size=8, convention=convention, max_distance=1)
        assert np.abs(baked.map[..., 1].astype(float) - code).max() <= 0.5, convention


def test_what_crosses_the_border_of_a_tile_comes_in_with_wrap():
    step = slope(0.1)
    step.positions = step.positions * np.float32([0.13, 0.07, 0.2]) + np.float32([0.95, 0.5, 0.05])  # over the right border
    without = cotan.bake(square(), [square(), step], size=16)
    wrapped = cotan.bake(square(), [square(), step], size=16, wrap=True)
    assert [line[:5] for line in without.warnings] == ["wrap:"] and wrapped.warnings == []
    assert (without.map[:, :2, 0] == 128).all() and (wrapped.map[7, :2, 0] < 128).all()
    assert (wrapped.map[:, 4:13] == without.map[:, 4:13]).all()


def test_heights_are_in_units_of_the_positions():
    baked = cotan.bake(square(), slope(0.1), size=8, kind="height", bits=32, max_distance=0.5)
    x = (np.arange(8) + 0.5) / 8
    np.testing.assert_allclose(baked.map[..., 0], np.tile(0.1 * (x - 0.5), (8, 1)), atol=1e-6)


def test_an_open_plane_is_not_occluded():
    baked = cotan.bake(square(), slope(0), size=8, kind="ao", ao_rays=16)
    assert (baked.map[..., :3] == 255).all()


OPTIONS = [
    {},
    {"frame": "cotangent", "bits": 16, "samples": 4},
    {"frame": "mikktspace", "convention": "directx", "dither": True},
    {"frame": "vertex", "tangents": "generated", "padding": -1},
    {"kind": "ao", "ao_rays": 4, "padding": 3},
    {"kind": "object-normal", "high_normals": "face"},
    {"max_distance": 0.011},
]


@pytest.mark.parametrize("options", OPTIONS, ids=lambda o: " ".join(map(str, o.values())) or "defaults")
def test_arrays_and_files_bake_the_bytes_of_the_command_line(options, command, tmp_path):
    low, high = bumps(4), bumps(40)
    files = write_obj(tmp_path / "low.obj", low), write_obj(tmp_path / "high.obj", high)
    words = []
    for name, value in options.items():
        words += [f"--{name.replace('_', '-')}"] + ([] if value is True else [value])
    out, mask = tmp_path / "out.png", tmp_path / "mask.png"
    command("bake", "--low", files[0], "--high", files[1], "--size", "96x64", "-o", out, "--mask", mask, *words)
    expected, became = cotan.read_image(out), cotan.read_image(mask)
    for a, b in (files, (low, high), (cotan.load(files[0]), cotan.load(files[1])), (low, files[1])):
        baked = cotan.bake(a, b, size="96x64", mask=True, **options)
        assert baked.map.dtype == expected.dtype
        assert (baked.map == expected).all() and (baked.mask == became).all()


SEVERAL = ["normal", "ao", "curvature", "R=height,G=ao,A=0.5"]


def test_maps_of_one_call_are_those_of_the_command_and_each_alone(command, tmp_path):
    low, high = bumps(4), [bumps(40), slope(0.1, "plate")]
    files = [write_obj(tmp_path / f"{n}.obj", m) for n, m in (("low", low), ("high", high[0]), ("plate", high[1]))]
    command("bake", "--low", files[0], "--high", files[1], "--high", files[2], "--size", 48, "--samples", 4, "--ao-rays", 9,
            "--maps", ",".join(SEVERAL[:3]), "--pack", SEVERAL[3], "-o", f"{tmp_path}/maps/")  # fmt: skip
    options = {"size": 48, "samples": 4, "ao_rays": 9, "mask": True}
    shares = []
    maps = cotan.bake_maps(low, high, SEVERAL, progress=shares.append, **options)
    assert list(maps) == SEVERAL and shares == sorted(shares) and shares[-1] == 1
    rays = 0
    for word, name in zip(SEVERAL, ("normal", "ao", "curvature", "packed")):
        alone = cotan.bake(low, high, **{"pack" if "=" in word else "kind": word}, **options)
        for expected in (cotan.read_image(tmp_path / "maps" / f"{name}.png"), alone.map):
            np.testing.assert_array_equal(maps[word].map, expected)
        assert (maps[word].mask == alone.mask).all() and np.ptp(maps[word].map[..., :2]) > 0, word
        assert (maps[word].unit, maps[word].covered) == (alone.unit, alone.covered)
        rays = max(rays, alone.rays)
    # One trace: as many rays as the map alone that needs most.
    assert {baked.rays for baked in maps.values()} == {rays}


def test_maps_of_one_call_have_bits_and_arrays_of_their_own():
    low, high = square(), slope(0.1)
    into = [np.zeros((8, 8, 4), np.float32), np.zeros((8, 8, 4), np.uint8)]
    maps = cotan.bake_maps(low, high, ["height", "normal"], size=8, samples=1, bits=(32, 8), out=into)
    assert [baked.map is array for baked, array in zip(maps.values(), into)] == [True, True]
    for word, bits in (("height", 32), ("normal", 8)):
        np.testing.assert_array_equal(maps[word].map, cotan.bake(low, high, size=8, samples=1, kind=word, bits=bits).map)
    for words, options, field in (
        (["normal", "glossy"], {}, "maps[1]"),
        (["ao", "normal", "ao"], {}, "maps[2]"),
        (["normal", 5], {}, "maps[1]"),
        ("normal", {}, "maps"),
        ([], {}, "maps"),
        (["normal", "ao"], {"bits": [8]}, "bits"),
        (["normal", "ao"], {"bits": [8, 9]}, "bits"),
        (["normal", "ao"], {"out": into[1:]}, "out"),
        (["normal", "ao"], {"out": into}, "out[0]"),
        (["normal", "ao"], {"samples": 3}, "samples"),
    ):
        with pytest.raises(cotan.UsageError) as caught:
            cotan.bake_maps(low, high, words, size=8, **options)
        assert caught.value.field == field, str(caught.value)
    with pytest.raises(cotan.StoppedError):
        cotan.bake_maps(bumps(4), bumps(40), ["ao", "normal"], size=512, progress=lambda done: False)


def test_several_maps_take_the_keywords_of_one():
    import inspect

    one, several = (inspect.signature(function).parameters for function in (cotan.bake, cotan.bake_maps))
    own = {"maps", "kind", "pack", "bits", "out"}
    assert [p for name, p in several.items() if name not in own] == [p for name, p in one.items() if name not in own]


def test_triangles_on_other_tiles_are_named_unless_the_tile_was_chosen():
    other = square()
    other.texcoords = other.texcoords + np.float32([1, 0])
    said = cotan.bake([square(), other], slope(0.1), size=8, samples=1, max_distance=1).warnings
    assert said == ["udim: the low mesh also has triangles on tiles 1002: they are not baked"]
    for udim in (1001, 1002):
        assert cotan.bake([square(), other], slope(0.1), size=8, samples=1, max_distance=1, udim=udim).warnings == []


def test_names_pair_as_in_a_bake():
    low, high = ["wall_low", "wall_low.001", "door.lo", "alone_low"], ["wall_high.001", "Wall_HIGH", "door_hi_a", "door_hi_b"]
    pairs, notes = cotan.pair_names(low, high)
    assert pairs == [[1], [0], [2, 3], []] and notes == []
    assert cotan.pair_names(["a_low"], ["b_high"]) == ([[]], ["no low mesh has the name of 'b_high': not baked"])
    assert cotan.pair_names([], []) == ([], [])
    assert [cotan.name_role(n) for n in ("a_low", "lp_a.001", "aHigh", "a.cage", "pillow")] == ["low", "low", "high", "cage", ""]
    with pytest.raises(cotan.UsageError, match="low"):
        cotan.pair_names([1], [])


def test_pairs_shade_only_themselves_unless_asked():
    def at(name, z, size, offset):
        mesh = square(name)
        mesh.positions = mesh.positions * np.float32([size, size, 1]) + np.float32([0, 0, z])
        mesh.texcoords = mesh.texcoords * np.float32([0.5, 1]) + np.float32([offset, 0])
        return mesh

    low = [at("a_low", 0, 1, 0), at("b_low", 0.01, 1, 0.5)]
    high = [at("a_high", 0, 9, 0), at("b_high", 0.01, 9, 0)]  # b covers the sky of a
    options = {"size": 8, "kind": "ao", "match_by_name": True}
    assert (cotan.bake(low, high, **options).map[..., 0] == 255).all()
    shaded = cotan.bake(low, high, ao_occluders="all", **options).map[..., 0]
    assert (shaded[:, :4] < 20).all() and (shaded[:, 4:] == 255).all()


def lying(mesh):
    """The mesh as a z-up program stores it: y becomes z."""
    turned = [np.c_[v[:, 0], -v[:, 2], v[:, 1]].astype(np.float32) for v in (mesh.positions, mesh.normals)]
    return cotan.Mesh(turned[0], mesh.indices, turned[1], mesh.texcoords)


def test_meshes_with_z_up_bake_the_same_map(command, tmp_path):
    low, high = square(), bumps()
    options = {"size": 32, "kind": "object-normal"}
    standing = cotan.bake(low, high, **options).map
    write_obj(tmp_path / "low.obj", lying(low))
    write_obj(tmp_path / "high.obj", high)
    both = cotan.bake(lying(low), lying(high), up="z", **options).map
    one = cotan.bake(tmp_path / "low.obj", high, up="z", high_up="y", **options).map
    loaded = cotan.bake(cotan.load(tmp_path / "low.obj", up="z"), cotan.Model(lying(high), up="z"), **options).map
    for turned in (both, one, loaded):
        assert np.abs(turned.astype(int) - standing).max() <= 1  # rotating by 90 degrees rounds
    with pytest.raises(cotan.UsageError, match="up: expected y or z, found 'x'"):
        cotan.load(tmp_path / "low.obj", up="x")
    command("bake", "--low", tmp_path / "low.obj", "--high", tmp_path / "high.obj", "-o", tmp_path / "map.png", "--up",
            "z", "--high-up", "y", "--size", 32, "--kind", "object-normal")  # fmt: skip
    assert (cotan.read_image(tmp_path / "map.png") == one).all()


def test_cage_and_names_work_as_on_the_command_line(command, tmp_path):
    # Two squares side by side in uv, one above the other in space: without names both hit the nearer surface.
    def half(name, z, offset):
        mesh = square(name)
        mesh.positions = mesh.positions + np.float32([0, 0, z])
        mesh.texcoords = mesh.texcoords * np.float32([0.5, 1]) + np.float32([offset, 0])
        return mesh

    low = [half("a_low", 0, 0), half("b_low", 0.05, 0.5)]
    high = [slope(0.1, "a_high"), slope(-0.1, "b_high")]
    apart = cotan.bake(low, high, size=32, frame="smooth", match_by_name=True).map
    # u is half as dense as v, the longer gradient, whose length is one: slopes along u double.
    lean = 127 * 0.2 / np.hypot(0.2, 1)
    assert np.abs(apart[..., 0] - np.repeat([128 - lean, 128 + lean], 16)).max() <= 0.5
    with pytest.raises(cotan.InputError, match="b_low"):
        cotan.bake(low, high[:1], size=8, match_by_name=True)
    hints = cotan.bake(low, high, size=8).warnings
    assert hints == [
        "match_by_name: the names of the meshes pair, such as 'a_low' with 'a_high'; with it each is baked from its own only"
    ]

    cage = bumps(4)
    cage.positions = cage.positions + 0.05 * cage.normals
    files = [write_obj(tmp_path / f"{n}.obj", m) for n, m in (("low", bumps(4)), ("high", bumps(40)), ("cage", cage))]
    command("bake", "--low", files[0], "--high", files[1], "--cage", files[2], "--size", "64x64", "-o", tmp_path / "out.png")
    expected = cotan.read_image(tmp_path / "out.png")
    for caged in (cage, files[2]):
        assert (cotan.bake(bumps(4), bumps(40), cage=caged, size=64).map == expected).all()
    # Rays from 2 above reach equally far below, or as far as cage_reach says.
    above, flat, below = square(), square(), square()
    above.positions = above.positions + np.float32((0, 0, 2))
    below.positions = below.positions - np.float32((0, 0, 1))
    for reach, missed in ((0, 0), (2.9, 256), (3.1, 0)):
        assert cotan.bake(flat, below, cage=above, cage_reach=reach, size=16).missed == missed
    with pytest.raises(cotan.InputError, match="cage") as caught:
        cotan.bake(bumps(4), bumps(40), cage=square(), size=8)
    assert caught.value.field == "cage"


def test_normal_map_of_the_detailed_mesh_is_baked(command, tmp_path):
    tilt = np.zeros((8, 8, 4), np.uint8)
    tilt[:] = [128 + 38, 128, 249, 255]  # 0.3, 0, 0.95
    cotan.write_image(tmp_path / "tilt.png", tilt)
    files = [write_obj(tmp_path / f"{n}.obj", m) for n, m in (("low", square()), ("high", square()))]
    command("bake", "--low", files[0], "--high", files[1], "--high-normals", "map", "--high-map", tmp_path / "tilt.png",
            "--size", "8x8", "-o", tmp_path / "out.png")  # fmt: skip
    expected = cotan.read_image(tmp_path / "out.png")
    assert np.abs(expected[..., :3].astype(int) - tilt[..., :3]).max() <= 1
    for high_map in (tilt, tmp_path / "tilt.png", [tilt]):
        baked = cotan.bake(square(), square(), size=8, high_normals="map", high_map=high_map)
        assert (baked.map == expected).all()
    with pytest.raises(cotan.UsageError) as caught:
        cotan.bake(square(), square(), size=8, high_map=tilt)
    assert caught.value.field == "high_normals"


def test_two_channels_of_a_detailed_mesh_are_read_wherever_they_are(command, tmp_path):
    phase = 2 * np.pi * np.arange(64) / 64
    x, y = np.meshgrid(0.4 * np.sin(phase), 0.4 * np.cos(2 * phase))
    codes = np.round(128 + 127 * np.dstack([x, y, np.sqrt(1 - x * x - y * y), np.ones_like(x)])).astype(np.uint8)
    r, g, full = codes[..., 0], codes[..., 1], np.full_like(codes[..., 0], 255)
    wanted = cotan.bake(square(), square(), size=32, high_normals="map", high_map=codes).map.astype(int)
    files = [write_obj(tmp_path / f"{n}.obj", m) for n, m in (("low", square()), ("high", square()))]
    for name, words, channels in (
        ("middle blue", "opengl", (r, g, np.full_like(r, 128), full)),
        ("rg", "opengl,xy", (r, g, full, full)),
        ("ag", "opengl,xy", (full, g, full, r)),
        ("grey and alpha", "opengl,xy", (r, r, r, g)),
    ):
        map, out = np.dstack(channels), tmp_path / "out.png"
        cotan.write_image(tmp_path / "map.png", map)
        made = cotan.bake(square(), square(), size=32, high_normals="map", high_map=map, high_convention=words).map
        assert np.abs(made - wanted).max() <= 2, name  # z is rounded
        command("bake", "--low", files[0], "--high", files[1], "--high-normals", "map", "--high-map", tmp_path / "map.png",
                "--high-convention", words, "--size", 32, "-o", out, "--quiet")  # fmt: skip
        assert (cotan.read_image(out) == made).all(), name


def test_material_number_selects_triangles(command, tmp_path):
    low = write_obj(tmp_path / "low.obj", square())
    lines = low.read_text().splitlines()
    (tmp_path / "low.mtl").write_text("newmtl a\nnewmtl b\n")
    low.write_text("\n".join(["mtllib low.mtl", *lines[:-2], "usemtl a", lines[-2], "usemtl b", lines[-1]]) + "\n")
    covered = []
    for material in (-1, 0, 1):
        command("bake", "--low", low, "--high", low, "--material", material, "--size", "16x16", "--samples", 1, "--padding", -1,
                "-o", tmp_path / "out.png")  # fmt: skip
        baked = cotan.bake(low, low, material=material, size=16, samples=1, padding=-1)
        assert (baked.map == cotan.read_image(tmp_path / "out.png")).all()
        covered.append(baked.covered)
    assert covered[0] == 256 and covered[1] + covered[2] == 256 and min(covered) > 100


def test_missing_normals_are_smooth():
    bare = bumps(40)
    bare.normals = None
    with_normals = cotan.bake(bumps(4), bumps(40), size=64, bits=32).map
    without = cotan.bake(bumps(4), bare, size=64, bits=32).map
    a, b = with_normals[..., :3] * 2 - 1, without[..., :3] * 2 - 1
    apart = np.degrees(np.arccos(np.clip((a * b).sum(2) / np.linalg.norm(a, axis=2) / np.linalg.norm(b, axis=2), -1, 1)))
    assert 0 < np.mean(apart) < 0.5  # facets 1/40 wide on waves with slopes up to 0.21


def test_errors_in_files_name_the_file(tmp_path):
    (tmp_path / "broken.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n")
    with pytest.raises(cotan.InputError) as caught:
        cotan.bake(tmp_path / "broken.obj", square(), size=8)
    assert caught.value.file == str(tmp_path / "broken.obj") and "\n" not in str(caught.value)
    with pytest.raises(cotan.InputError, match="no such file"):
        cotan.bake(square(), tmp_path / "missing.obj", size=8)
    with pytest.raises(cotan.InputError):
        cotan.bake(square(), tmp_path, size=8)
    with pytest.raises(cotan.InputError) as caught:
        cotan.bake(square(), square(), size=8, udim=1005)
    assert caught.value.field == "udim"


def test_example_bakes_the_map_of_the_command_line(source, command, tmp_path):
    import runpy
    import sys

    low, high = write_obj(tmp_path / "low.obj", bumps(4)), write_obj(tmp_path / "high.obj", bumps(40))
    words, sys.argv = sys.argv, ["bake.py", str(low), str(high), str(tmp_path / "example.png")]
    try:
        runpy.run_path(str(source / "examples/python/bake.py"), run_name="__main__")
    finally:
        sys.argv = words
    command("bake", "--low", low, "--high", high, "--frame", "smooth", "--size", "512x512", "-o", tmp_path / "out.png")
    assert (cotan.read_image(tmp_path / "example.png") == cotan.read_image(tmp_path / "out.png")).all()


def test_errors_in_meshes_name_keyword_or_mesh():
    bare, flat = square("panel_low"), np.full((4, 4, 3), 128, np.uint8)
    bare.texcoords = None
    for call, field in (
        (lambda: cotan.bake([square(), bare], slope(0.1), size=8), "low"),
        (lambda: cotan.bake(square("a_low"), slope(0.1), size=8, match_by_name=True), "match_by_name"),
        (lambda: cotan.bake(square(), slope(0.1, "bumps"), size=8, high_normals="map", high_map=flat), "bumps"),
        (lambda: cotan.bake(square(), slope(0.1), size=8, high_normals="map"), "meshes"),
        (lambda: cotan.bake(cotan.Model(bare), slope(0.1), size=8), "panel_low"),
    ):
        with pytest.raises(cotan.InputError) as caught:
            call()
        assert caught.value.field == field, str(caught.value)


def test_colours_of_meshes_are_ids_and_steer_rays():
    # Two squares that meet in a hard edge, under one large square: rays along their normals hit it elsewhere than averaged.
    half = np.float32([[0, 0], [1, 0], [1, 1], [0, 1]])
    left, right = np.c_[-half[:, 0], half[:, 1], -half[:, 0]], np.c_[half[:, 0], half[:, 1], -half[:, 0]]
    normals = np.repeat(np.float32([[-1, 0, 1], [1, 0, 1]]) / np.sqrt(np.float32(2)), 4, axis=0)
    uv = np.r_[half * [0.5, 1], half * [0.5, 1] + [0.5, 0]]
    indices = [0, 2, 1, 0, 3, 2, 4, 5, 6, 4, 6, 7]
    over = bumps()
    purple = np.tile([0.5, 0, 1, 1], (len(over.positions), 1))
    high = cotan.Mesh((over.positions - [0.5, 0, 0]) * [3, 1, 1] + [0, 0, 0.1], over.indices, over.normals, colors=purple)

    def map_of(red, **options):
        colors = None if red is None else np.tile(np.float32([red, 0.5, 0, 1]), (8, 1))
        low = cotan.Mesh(np.r_[left, right], indices, normals, uv, colors=colors)
        return cotan.bake(low, high, size=16, padding=-1, max_distance=3, **options).map

    straight, averaged = map_of(None, rays="straight"), map_of(None, rays="averaged")
    assert np.abs(straight.astype(int) - averaged).max() > 9
    for red, wanted in ((1, straight), (0, averaged)):
        assert np.abs(map_of(red, rays="vertex-color").astype(int) - wanted).max() <= 1
    ids = map_of(None, kind="id", id_by="vertex-color")[..., :3].reshape(-1, 3)
    assert {tuple(code) for code in ids} - {(0, 0, 0)} == {(188, 0, 255)}  # sRGB of one half is 187.5
    with pytest.raises(cotan.InputError, match="rays: expected vertex colours in the low mesh; found none"):
        map_of(None, rays="vertex-color")
    with pytest.raises(cotan.UsageError, match=r"colors: expected shape \(4, 4\), found \(4, 3\)"):
        cotan.Mesh(square().positions, [0, 1, 2], colors=np.zeros((4, 3)))
