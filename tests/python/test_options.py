"""Every parameter that is also an option of the command line has the same effect as the option, to the byte."""

import inspect
import json
import os
import pathlib
import subprocess
import sys

import numpy as np
import pytest

import cotan

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from output_inputs import make_inputs, png  # noqa: E402

# Values tried for each parameter, alone or with others that it needs. Parameters that only affect how the work is done,
# or that pass data in memory, are tested in other files of this folder.
ELSEWHERE = {"threads", "memory", "progress", "report", "beside", "out", "decode", "encode", "overwrite", "device", "floats", "mask", "cage_reach", "wrap"}

RENDER = [
    {"max_degrees": 1e-6, "view": "normal"},
    *({"size": s} for s in ((30, 40), 36, "50x20")),
    *({"frame": f, "view": "normal"} for f in cotan.frames()),
    *({"view": v} for v in "tangent bitangent uv depth error checker density stretch shear mirrored w facing base-color alpha normal-map "
      "normal-map-red normal-map-green normal-map-blue roughness metallic occlusion emissive".split()),
    *({"camera": c} for c in ("left", 1, "orbit:30,50", (1, 2, 3, 0, 0.5, 0), (1, 2, 3, 0, 0.5, 0, 20), "1,2,3,0,0.5,0,h2")),
    *({"shape": s, "model": None, "normal_map": "rocks.png"} for s in ("plane", "sphere", "torus", "teapot")),
    {"up": "z"}, {"samples": 1}, {"samples": 16}, {"normal_map": "grain.png"}, {"normal_map": "grain.png", "convention": "directx"},
    {"normal_map": "grain.png", "material": 1}, {"base_color": "rocks.png"}, {"metallic_roughness": "colors.png"}, {"occlusion": "rocks.png"},
    {"height_map": "height.png"}, {"height_map": "height.png", "height_depth": 0.2}, {"view": "mask", "mask": "mask.png"},
    {"variant": "cloth"}, {"variant": 1}, {"animation": "turn"}, {"animation": 1, "time": 0.6}, {"animation": "turn", "time": 0.3},
    *({"edges": e, "view": "stretch"} for e in ("triangles", "seams", "all")), {"shading": "blinn-phong"},
    {"tangents": "generated", "frame": "vertex"},
    {"exposure": 0.5}, {"exposure": "auto", "environment": "overcast"}, *({"tone_mapping": t} for t in ("none", "aces", "agx")),
    *({"environment": e, "background": b} for e, b in (("evening", "blur"), ("overcast", "gradient"), ("none", "none"), ("sky.hdr", "environment"),
                                                       ("studio", "paper"))),
    {"environment_rotation": 70}, {"environment_intensity": 0.4}, {"ground": "on"}, {"shadow_softness": 40, "model": "plain.gltf", "ground": "on"},
    {"no_shadows": True, "model": "plain.gltf", "ground": "on"}, {"no_normal_maps": True},
    {"specular_antialiasing": True}, {"point_sampled": True},
]  # fmt: skip
DEPENDS_ON_VIEW = {"cotangent-2013", "nonperspective", "paper-orthogonal"}
FRAMES = [f for f in cotan.frames() if f not in DEPENDS_ON_VIEW]
MAPPED = {"high": "panel.gltf", "high_normals": "map"}
BAKE = [
    *({"size": s} for s in ((30, 20), 18)), *({"frame": f} for f in FRAMES), *({"kind": k} for k in ("object-normal", "height", "ao", "curvature", "position")),
    *({"kind": k, "ao_rays": 9, "size": 8} for k in ("bent-normal", "object-bent-normal", "thickness")),
    {"kind": "thickness", "thickness_distance": 0.05, "ao_rays": 9, "size": 8}, {"kind": "curvature", "curvature_radius": 0.05},
    *({"kind": k, "low": "room.gltf", "high": "room.gltf", "samples": 4} for k in ("base-color", "roughness", "metallic", "roughness-metallic", "emissive", "id")),
    {"pack": "orm", "low": "room.gltf", "high": "room.gltf", "size": 8, "ao_rays": 9}, {"pack": "R=height,G=curvature,A=0.5"},
    {"kind": "id", "id_by": "object", "low": "room.gltf", "high": "room.gltf"}, {"kind": "base-color", "bits": 16, "low": "room.gltf", "high": ["panel.gltf", "room.gltf"]},
    *({"convention": c} for c in ("directx", "unreal", "gltf,xy")), {"bits": 16}, {"samples": 1}, {"samples": 16}, {"padding": 2}, {"padding": -1},
    {"dither": True}, {"ao_rays": 9, "kind": "ao", "size": 8}, {"ao_occluders": "all", "kind": "ao", "size": 8, "match_by_name": True, "low": "room.gltf", "high": "room.gltf"}, {"search": "nearest", "high": "layers.obj"},
    *({"rays": r, "high": "layers.obj", "low": "flat.obj"} for r in ("auto", "averaged", "straight")), {"rays_mask": "mask.png", "high": "layers.obj", "low": "flat.obj"}, {"extrusion": 0.02, "high": "layers.obj"},
    {"max_distance": 0.001}, {"cage": "cage.obj", "high": "layers.obj"}, {"match_by_name": True, "low": "room.gltf", "high": "room.gltf"},
    {"material": 5, "low": "room.gltf"}, {"udim": 1001}, {"tangents": "generated", "low": "panel.gltf"}, {"high_normals": "curved"},
    {"high_normals": "face"}, MAPPED, *({**MAPPED, "high_frame": f} for f in FRAMES), {**MAPPED, "high_map": "grain.png"},
    {**MAPPED, "high_map": "grain.png", "high_convention": "directx"}, {"up": "z", "kind": "object-normal"}, {"up": "z", "high_up": "y"},
]  # fmt: skip
CONVERT = [
    *({"to_frame": f, "from_frame": "mikktspace"} for f in FRAMES), *({"to_frame": "smooth", "from_frame": f} for f in FRAMES),
    {"to_frame": "smooth", "tangents": "generated"}, {"to_frame": "smooth", "keep_tangents": True}, {"to_frame": "smooth", "bits": 16},
    {"to_frame": "smooth", "unsigned": "exact"}, {"to_frame": "smooth", "keep_maps": True}, {}, {"max_degrees": 40}, {"max_degrees": 0.001},
]  # fmt: skip
LINT = [{}, {"max_degrees": 5}, {"distance": 2.5}, {"limit": 0.01}, {"limit": 80, "frame": "exact"}, {"limit": 3, "frame": "stored"}, {"limit_area": 20}, {"limit_area": 0.5}]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("inputs")
    make_inputs(folder)
    return folder


@pytest.fixture(autouse=True)
def inside(folder, monkeypatch):
    monkeypatch.chdir(folder)


def words_of(options):
    words = []
    for name, value in options.items():
        if isinstance(value, list):  # the option is given several times
            words += words_of({name: value[0]}) + words_of({name: value[1]})
            continue
        words.append("--" + name.replace("_", "-"))
        if name == "size" and isinstance(value, tuple):
            words.append("x".join(map(str, value)))
        elif value is not True:
            words.append(",".join(map(str, value)) if isinstance(value, tuple) else value)
    return words


def names(options):
    return " ".join(f"{k}={v}" for k, v in options.items())


@pytest.mark.parametrize("options", RENDER, ids=names)
def test_render_equals_the_command_line(options, command, tmp_path):
    all_options = {"size": (48, 30), "device": "reference", "ground": "off", "model": "room.gltf", **options}
    model = all_options.pop("model")
    command("render", *([model] if model else []), "-o", tmp_path / "out.png", *words_of(all_options))
    np.testing.assert_array_equal(cotan.render(model, **all_options), cotan.read_image(tmp_path / "out.png"))


@pytest.mark.parametrize("options", BAKE, ids=names)
def test_bake_equals_the_command_line(options, command, tmp_path):
    options = {"low": "low.obj", "high": "high.obj", "size": 24, **options}
    command("bake", "-o", tmp_path / "out.png", "--mask", tmp_path / "mask.png", "--json", tmp_path / "report.json", *words_of(options))
    baked = cotan.bake(options.pop("low"), options.pop("high"), mask=True, **options)
    for own, file in ((baked.map, "out.png"), (baked.mask, "mask.png")):
        written = cotan.read_image(tmp_path / file)
        np.testing.assert_array_equal(own[..., : written.shape[2]], written)
    whole = json.loads((tmp_path / "report.json").read_text())
    map = whole["maps"][0]
    assert baked.unit == map.get("unit", 0)
    assert "box" not in map or [*baked.box] == pytest.approx(sum(map["box"], []))
    assert {name: "#%02x%02x%02x" % color for name, color in baked.ids.items()} == {i["name"]: i["color"] for i in map.get("ids", [])}
    assert (len(baked.ids) > 1) == (options.get("kind") == "id")
    report = whole["bake"]
    assert (baked.texels, baked.covered, baked.missed, baked.further, baked.nearer, baked.negative, baked.twice, baked.rays) == tuple(
        report[n] for n in ("texels", "covered", "missed", "further_away", "not_the_nearest", "negative_z", "claimed_twice", "rays"))  # fmt: skip
    assert (baked.disputed, baked.problems) == (report["disputed"], len(whole["problems"]))
    assert (baked.ray_distance, baked.ray_start) == (report["ray_distance"], report["ray_start"])


@pytest.mark.parametrize("options", CONVERT, ids=names)
def test_convert_equals_the_command_line(options, command, tmp_path):
    words = {k: v for k, v in options.items() if k != "bits"}
    command("convert", "panel.gltf", "-o", tmp_path / "a.glb", *words_of(words), *(["--bits", options["bits"]] if "bits" in options else []))
    cotan.convert("panel.gltf", tmp_path / "b.glb", **options)
    assert (tmp_path / "a.glb").read_bytes() == (tmp_path / "b.glb").read_bytes()


@pytest.mark.parametrize("options", LINT, ids=names)
def test_lint_equals_the_command_line(options, tmp_path):
    tool = os.environ.get("COTAN_TOOL")
    if not tool or not os.path.exists(tool):
        pytest.skip("skipped: COTAN_TOOL names no cotan")
    done = subprocess.run([tool, "lint", "room.gltf", "--json", tmp_path / "report.json", *map(str, words_of(options))], capture_output=True)
    found = cotan.lint("room.gltf", **options)
    report = json.loads((tmp_path / "report.json").read_text())
    shared = (set(found.report) & set(report)) - {"format"}
    assert {"primitives", "maps", "check"} <= shared
    assert {k: found.report[k] for k in shared} == {k: report[k] for k in shared}
    assert found.passed is (None if "limit" not in options and "limit_area" not in options else done.returncode == 0)


@pytest.mark.parametrize("function, tried", [(cotan.render, RENDER), (cotan.bake, BAKE), (cotan.convert, CONVERT), (cotan.lint, LINT)],
                         ids=["render", "bake", "convert", "lint"])  # fmt: skip
def test_every_parameter_is_tested(function, tried):
    named = {name for options in tried for name in options} | {"model", "low", "high"} | ELSEWHERE
    missing = set(inspect.signature(function).parameters) - named
    assert missing == set()


def test_defaults_equal_those_of_the_command_line(command, tmp_path):
    command("bake", "--low", "low.obj", "--high", "high.obj", "-o", tmp_path / "out.png")
    np.testing.assert_array_equal(cotan.bake("low.obj", "high.obj").map, cotan.read_image(tmp_path / "out.png"))
    command("render", "panel.gltf", "-o", tmp_path / "drawn.png")
    np.testing.assert_array_equal(cotan.render("panel.gltf"), cotan.read_image(tmp_path / "drawn.png"))


def test_memory_limits_the_images_of_a_render():
    png(pathlib.Path("large.png"), 1024, 512, 3, 8, lambda x, y, c: 255 if c == 2 else 128)  # 2 MiB of four bytes
    for memory, fits in ((1, False), (2, True)):
        draw = lambda: cotan.render("plain.gltf", size=16, device="reference", normal_map="large.png", memory=memory)  # noqa: B023
        if fits:
            draw()
        else:
            with pytest.raises(cotan.InputError, match="2097152 bytes, the limit is 1048576"):
                draw()


def test_non_square_map_keeps_its_size():
    png(pathlib.Path("wide.png"), 48, 24, 3, 8, lambda x, y, c: 255 if c == 2 else 100 + 3 * x if c == 0 else 128)
    pathlib.Path("wide.gltf").write_text(pathlib.Path("panel.gltf").read_text().replace("rocks.png", "wide.png"))
    done = cotan.convert("wide.gltf", from_frame="mikktspace", to_frame="smooth")
    assert [m["size"] for m in done.report["maps"]] == [[48, 24]] and done.maps_converted == 1
