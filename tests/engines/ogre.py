"""The material of examples/ogre in OGRE, judged by the formula of two rings, beside the tangents of
Mesh::buildTangentVectors.

    ogre.py TOOL [FOLDER]

TOOL: cotan; FOLDER: where files and images are left. Exit code 77 if OGRE is missing (scripts/try-engines gets it)."""

import json
import pathlib
import shutil
import sys
import tempfile

import numpy as np
import ring

HERE = pathlib.Path(__file__).resolve().parent / "ogre"
EXAMPLE = ring.ROOT / "examples/ogre"
CALL = "cotan_perturb_normal(surfaceNormal, surfacePosition, uv, texture(normalMap, uv).xyz)"
LIT = "    color = texture(colorMap, uv) * "
NUMBERS = "    color = part < 0.5 ? vec4(n, 1.0) : part < 1.5 ? vec4(uv, 0.0, 1.0) : texture(colorMap, uv) * "
# As OGRE's shader library has it (SGX_FetchNormal, SGX_CalculateTBN): 2c - 1, and w times the cross product.
TANGENTS = """normalize(surfaceNormal);
    vec3 t = normalize(tangent.xyz - dot(tangent.xyz, n) * n);
    vec3 m = texture(normalMap, uv).xyz * 2.0 - 1.0;
    n = normalize(t * m.x + cross(n, t) * tangent.w * m.y + n * m.z)"""


def write_programs(tool, folder):
    """Those of the example as they are, and with numbers in the place of the colour: Ours, and Own with OGRE's tangents."""
    for file in EXAMPLE.glob("cotan_normal_map.*"):
        shutil.copy(file, folder)
    (folder / "cotan.glsl").write_text(ring.functions(tool, "--lang", "glsl", "--frame", "orthonormal"))
    ring.write_map(folder / "white.png", lambda u, v: np.ones((*u.shape, 3)), 4, 4)
    vertex, fragment, material, programs = ((EXAMPLE / f"cotan_normal_map.{kind}").read_text() for kind in ("vert", "frag", "material", "program"))
    fragment = ring.replaced(ring.replaced(fragment, LIT, NUMBERS), "uniform vec3 eye;", "uniform vec3 eye;\nuniform float part;")
    (folder / "ours.vert").write_text(vertex)
    (folder / "ours.frag").write_text(fragment)
    vertex = ring.replaced(vertex, "in vec2 uv0;", "in vec2 uv0;\nin vec4 tangent;\nout vec4 surfaceTangent;")
    (folder / "own.vert").write_text(ring.replaced(vertex, "    uv = uv0;", "    surfaceTangent = vec4(mat3(world) * tangent.xyz, tangent.w);\n    uv = uv0;"))
    fragment = ring.replaced(fragment, CALL, TANGENTS.replace("tangent.", "surfaceTangent."))
    (folder / "own.frag").write_text(ring.replaced(fragment, "in vec2 uv;", "in vec2 uv;\nin vec4 surfaceTangent;"))
    rings = ["import * from \"cotan_normal_map.material\"\n"]
    for name in ("ours", "own"):
        for kind, text in (("material", material), ("program", programs)):
            (folder / f"{name}.{kind}").write_text(text.replace("Cotan/", f"Cotan/{name}").replace("cotan_normal_map.", f"{name}."))
        rings.append(f'import * from "{name}.material"\n')
    for name in ("", "ours", "own"):
        for kind in ring.MAPS:
            for side, *_ in ring.PAIR:
                rings.append(f"material {name}_{kind}_{side} : Cotan/{name}NormalMap\n{{\n  set $normal_map {kind}_{side}.png\n  set $color_map white.png\n}}\n")
    (folder / "rings.material").write_text("".join(rings))


def main(tool, folder):
    ring.need("ogre")
    ring.write_pair(folder)
    write_programs(tool, folder)
    shutil.copy(HERE / "measure.py", folder)
    for side, _, mirrored, _ in ring.PAIR:
        (folder / side).mkdir(exist_ok=True)
        for array, part in zip(ring.ring_mesh(mirrored), ("position", "normal", "uv", "corners")):
            array.tofile(folder / side / part)
    jobs = [{"name": (name, kind), "rings": [side for side, *_ in ring.PAIR], "materials": [f"{name}_{kind}_{side}" for side, *_ in ring.PAIR],
             "matrices": [ring.matrix(x) for *_, x in ring.PAIR], "tangents": name == "own", "parts": 2 if name else 0,
             "out": f"{name or 'lit'}_{kind}.bin"}
            for name, kind in [(name, kind) for name in ("ours", "own") for kind in ring.MAPS] + [("", "bumps")]]  # fmt: skip
    plugins = ring.run("ogre", "sh", "-c", "ls -d /usr/lib/*/OGRE-14*", folder=folder, log=folder / "plugins.txt", screen=False).split()[-1]
    media = ring.run("ogre", "sh", "-c", "ls -d /usr/share/OGRE-14*/Media", folder=folder, log=folder / "media.txt", screen=False).split()[-1]
    whole = {"size": [ring.WIDTH, ring.HEIGHT], "eye": ring.EYE, "field": ring.FIELD, "plugins": plugins, "media": media, "jobs": jobs}
    (folder / "jobs.json").write_text(json.dumps(whole))
    said = ring.run("ogre", "python3", "measure.py", "jobs.json", folder=folder, log=folder / "measure.txt")
    assert "DONE" in said and "Error" not in said, [line for line in said.splitlines() if "Error" in line]
    version = said.split("\nOGRE ")[1].split()[0]
    results = {"ours": {}, "own": {}}
    for job in jobs[:-1]:
        name, kind = job["name"]
        results[name][kind] = ring.judge_pair("OGRE", kind, name, ring.parts_of(folder / job["out"]))
    ring.between("OGRE", *(ring.parts_of(folder / f"{name}_bumps.bin") for name in ("ours", "own")))
    ring.judge_ours(results["ours"], results["own"])
    ring.judge_lit(folder / "lit_bumps.bin")
    ring.judge_page("OGRE", version, results["ours"], results["own"])
    print(f"holds: OGRE {version} draws without tangents what the formula says")


if __name__ == "__main__":
    if len(sys.argv) > 2:
        main(sys.argv[1], pathlib.Path(sys.argv[2]).resolve())
    else:
        with tempfile.TemporaryDirectory() as place:
            main(sys.argv[1], pathlib.Path(place))
