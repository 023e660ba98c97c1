"""Microsoft's compilers of HLSL take all that Cotan prints, without a warning: compilers_test.py SOURCES TOOL BUILD.

Every text gets an entry that calls each of its functions. BUILD: see run. Exit code 77: they cannot run here.
Left out: FXC without optimisation says "potentially uninitialized" (X4000) of functions that return early, such as
cotan_tone_of, although every path returns a value."""

import itertools
import pathlib
import re
import subprocess
import sys
import tempfile

import hlsl

SOURCES, TOOL, BUILD = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], sys.argv[3]
TOTAL = ("cotangent", "orthonormal", "gradient", "smooth", "triangle")
STAGES = {"ps": hlsl.pixel, "vs": hlsl.vertex, "cs": hlsl.compute}
# 2021 is DXC's default; -Gis: IEEE 754; 16-bit types need shader model 6.2.
WAYS = ([], ["-HV", "2018"], ["-HV", "202x"], ["-Gis"], ["-Od"], ["-enable-16bit-types"])
IEEE, FLOW = 1 << 13 | 1 << 15, 1 << 9 | 1 << 15  # flags of FXC: IEEE 754; no flow control


def printed(*words):
    return subprocess.run([TOOL, "shader", "--lang", "hlsl", "--quiet", *words], check=True, capture_output=True, text=True).stdout


def texts():
    """(name, stage, text)"""
    listed = subprocess.run([TOOL, "shader", "--list-frames"], check=True, capture_output=True, text=True).stdout
    frames = re.findall(r"^  ([a-z][a-z0-9-]+) ", listed, re.M)
    assert len(frames) == 16 and set(TOTAL) <= set(frames), frames
    for frame in frames:
        yield frame, "ps", printed("--frame", frame)
    for frame in TOTAL:
        yield f"{frame}, total", "ps", printed("--frame", frame, "--form", "total")
    for form in ("seen", "area"):
        yield form, "ps", printed("--frame", "cotangent", "--form", form)
    for stage, kind in (("fragment", "ps"), ("vertex", "vs"), ("mesh", "cs"), ("compute", "cs")):
        yield f"triangle, {stage}", kind, printed("--frame", "triangle", "--stage", stage)
    for sets, frame in itertools.product("234", ("cotangent", "gradient")):
        yield f"{frame}, {sets} maps", "ps", printed("--frame", frame, "--uv-sets", sets)
    for channels, unsigned, green in itertools.product(("3", "2", "stereographic", "slope"), ("exact", "exact16", "biased", "signed"), ("along-v", "against-v")):
        yield f"{channels} {unsigned} {green}", "ps", printed("--frame", "orthonormal", "--channels", channels, "--unsigned", unsigned, "--green", green)
    for stage in STAGES:
        caller = [] if stage == "ps" else ["--differences", "caller"]
        yield f"all, {stage}", stage, printed("--frame", "triangle", "--form", "total", "--set", "all", *caller)


def flat(file):
    """A file with the text of its includes."""
    return re.sub(r'^#include "(.+)"$', lambda m: flat(SOURCES / "shaders" / m[1]), file.read_text(), flags=re.M)


def triangle_jobs(folder):
    """examples/triangle/hlsl, with the mesh shader, which only DXC knows."""
    text = flat(SOURCES / "examples/triangle/hlsl/triangle.hlsl")
    (folder / "triangle.hlsl").write_text(text)
    (folder / "mesh.hlsl").write_text("#define MESH\n" + text)
    for stage, entries in {"vs": ("provokingVertex", "plainVertex"), "ps": ("shadeFlat", "shadeRead"), "cs": ("pack", "resolve")}.items():
        for entry in entries:
            yield ["dxc", f"triangle {entry} by DXC", "triangle.hlsl", entry, f"{stage}_6_0", "-Wall", "-Wextra"]
            yield ["fxc", f"triangle {entry} by FXC", "triangle.hlsl", entry, f"{stage}_5_0"]
    yield ["dxc", "triangle meshlet by DXC", "mesh.hlsl", "meshlet", "ms_6_5", "-Wall", "-Wextra"]
    yield ["dxc", "triangle mesh shadeFlat by DXC", "mesh.hlsl", "shadeFlat", "ps_6_5", "-Wall", "-Wextra"]


def jobs_of(folder):
    for number, (name, stage, text) in enumerate(texts()):
        file = f"{number}.hlsl"
        (folder / file).write_text(STAGES[stage](text))
        whole = name == "all, ps"
        for way in WAYS if whole else WAYS[:1]:
            model = "6_2" if way == ["-enable-16bit-types"] else "6_0"
            yield ["dxc", f"{name} by DXC {' '.join(way)}".strip(), file, "main", f"{stage}_{model}", "-Wall", "-Wextra", *way]
        yield ["fxc", f"{name} by FXC", file, "main", f"{stage}_5_0"]
        if whole:
            yield ["fxc", f"{name} by FXC, IEEE", file, "main", f"{stage}_5_0", IEEE]
            yield ["fxc", f"{name} by FXC, no flow", file, "main", f"{stage}_5_0", FLOW]
    yield from triangle_jobs(folder)


def planted(folder):
    """Texts with a fault each; both compilers must complain."""
    text = hlsl.pixel(printed("--frame", "orthonormal"))
    call = "cotan_decode(texel)"
    assert text.count(call) == 1
    faults = {"truncation": text.replace(call, "float4(cotan_decode(texel), 1.0)"), "a missing function": text.replace(call, "cotan_decoded(texel)")}
    for name, wrong in faults.items():
        (folder / f"{name}.hlsl").write_text(wrong)
        yield ["dxc", f"{name} by DXC", f"{name}.hlsl", "main", "ps_6_0"]
        yield ["fxc", f"{name} by FXC", f"{name}.hlsl", "main", "ps_5_0"]


def main(folder):
    jobs = list(jobs_of(folder))
    wrong = list(planted(folder))
    version, failed = hlsl.run(BUILD, folder, jobs + wrong)
    for _, name, *_ in wrong:
        assert hlsl.messages(folder, name), f"{name}: no complaint"
    bad = [f"{name}: {hlsl.messages(folder, name)[:1500]}" for _, name, *_ in jobs if name in failed or hlsl.messages(folder, name)]
    assert not bad, "\n\n".join(bad)
    page = (SOURCES / "docs/engines.md").read_text()
    assert f"DXC {version}" in page, f"docs/engines.md does not name DXC {version}"
    print(f"holds: DXC {version} and FXC compile {len(jobs)} times without a warning")


with tempfile.TemporaryDirectory() as place:
    main(pathlib.Path(place))
