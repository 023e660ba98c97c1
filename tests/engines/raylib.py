"""The shader of examples/raylib in raylib, judged by the formula of two rings, beside the tangents of GenMeshTangents.

    raylib.py TOOL [FOLDER]

TOOL: cotan; FOLDER: where files and images are left. Exit code 77 if raylib is missing (scripts/try-engines gets it)."""

import pathlib
import shutil
import sys
import tempfile

import ring

HERE = pathlib.Path(__file__).resolve().parent / "raylib"
EXAMPLE = ring.ROOT / "examples/raylib"
LIT = "finalColor = vec4(color.rgb * (0.1 + 0.8 * max(dot(n, normalize(light)), 0.0)), color.a);"
NUMBERS = "finalColor = part == 0 ? vec4(n, 1.0) : vec4(fragTexCoord, 0.0, 1.0);"


def write_shaders(tool, folder):
    """normal_map.*: as the README says; ours.*: with the normal in the place of the colour; own.* and example.*: with the
    tangents of raylib, as they are stored, and as raylib's own examples read them, without their sign."""
    given = folder / "normal_map.fs"
    given.write_text("#version 330\n" + ring.functions(tool, "--lang", "glsl", "--frame", "orthonormal") + (EXAMPLE / "normal_map.fs").read_text())
    vertex = (EXAMPLE / "normal_map.vs").read_text()
    (folder / "normal_map.vs").write_text(vertex)
    measured = ring.replaced(given.read_text(), LIT, NUMBERS)
    measured = ring.replaced(measured, "uniform vec4 colDiffuse;", "uniform vec4 colDiffuse;\nuniform int part;\nin vec4 tangent;")
    (folder / "ours.fs").write_text(measured.replace("in vec4 tangent;", ""))
    (folder / "ours.vs").write_text(vertex)
    vertex = vertex.replace("out vec3 fragNormal;", "out vec3 fragNormal;\nin vec4 vertexTangent;\nout vec4 tangent;")
    vertex = ring.replaced(vertex, "    gl_Position", "    tangent = vec4(mat3(matModel) * vertexTangent.xyz, vertexTangent.w);\n    gl_Position")
    call = "cotan_perturb_normal(fragNormal, fragPosition, fragTexCoord, texture(texture2, fragTexCoord).xyz)"
    for name, sign in (("own", "-tangent.w"), ("example", "1.0")):
        (folder / f"{name}.vs").write_text(vertex)
        lines = f"""normalize(fragNormal);
    vec3 t = normalize(tangent.xyz - dot(tangent.xyz, n) * n);
    vec3 m = texture(texture2, fragTexCoord).xyz * 2.0 - 1.0;
    n = normalize(t * m.x + cross(n, t) * {sign} * m.y + n * m.z)"""
        (folder / f"{name}.fs").write_text(ring.replaced(measured, call, lines))


def main(tool, folder):
    ring.need("raylib")
    ring.write_pair(folder)
    write_shaders(tool, folder)
    shutil.copy(HERE / "measure.c", folder)
    ring.run("raylib", "cc", "-O1", "-Wall", "measure.c", "-o", "measure", "-lraylib", "-lm", folder=folder, log=folder / "compiler.txt", screen=False)
    results = {}
    for name in ("ours", "own", "example"):
        results[name] = {}
        for kind in ring.MAPS:
            out = folder / f"{name}_{kind}.bin"
            words = (f"{kind}.gltf", f"{name}.vs", f"{name}.fs", out, 2, int(name != "ours"))
            said = ring.run("raylib", folder / "measure", *words, folder=folder, log=out.with_suffix(".txt"))
            assert "DONE" in said and "WARNING: SHADER" not in said, said
            results[name][kind] = ring.judge_pair("raylib", kind, name, ring.parts_of(out))
    version = said.split("\nraylib ")[1].splitlines()[0]
    ring.between("raylib", *(ring.parts_of(folder / f"{name}_bumps.bin") for name in ("ours", "own")))
    ring.judge_ours(results["ours"], results["own"])
    # raylib's examples drop the sign, and so lean far off where uv are mirrored.
    assert results["example"]["bumps"]["right"][0] > 10
    ring.run("raylib", folder / "measure", "bumps.gltf", "normal_map.vs", "normal_map.fs", folder / "lit.bin", 0, 0, folder=folder, log=folder / "lit.txt")
    ring.judge_lit(folder / "lit.bin")
    ring.judge_page("raylib", version, results["ours"], results["own"])
    print(f"holds: raylib {version} draws without tangents what the formula says")


if __name__ == "__main__":
    if len(sys.argv) > 2:
        main(sys.argv[1], pathlib.Path(sys.argv[2]).resolve())
    else:
        with tempfile.TemporaryDirectory() as place:
            main(sys.argv[1], pathlib.Path(place))
