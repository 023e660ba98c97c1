"""The material of examples/qtquick3d in Qt Quick 3D, judged by the formula of two rings, beside what Qt does with stored
tangents, with those of its importer, and without.

    qtquick3d.py TOOL [FOLDER]

TOOL: cotan; FOLDER: where files and images are left. Exit code 77 if Qt Quick 3D is missing (scripts/try-engines
gets it)."""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy as np
import ring

HERE = pathlib.Path(__file__).resolve().parent / "qtquick3d"
EXAMPLE = ring.ROOT / "examples/qtquick3d"
CALL = "side * cotan_perturb_normal(side * NORMAL, position, UV0, texture(normalTexture, UV0).xyz)"
# As Qt's qt_sampleNormalTexture.
TANGENTS = "normalize(mat3(TANGENT, BINORMAL, NORMAL) * (texture(normalTexture, UV0).xyz * 2.0 - 1.0))"
# The normal that lights are computed with, and uv, as bytes.
NUMBERS = """
SHARED_VARS {
    vec3 normal;
};
void DIRECTIONAL_LIGHT()
{
    SHARED.normal = NORMAL;
}
void POST_PROCESS()
{
    float x = part < 0.5 ? SHARED.normal.x : part < 1.5 ? SHARED.normal.y : part < 2.5 ? SHARED.normal.z
        : part < 3.5 ? UV0.x : part < 4.5 ? UV0.y : 0.25;
    COLOR_SUM = vec4(number_bytes(x), 1.0);
}
"""


def write_shaders(tool, folder):
    shutil.copy(EXAMPLE / "CotanMaterial.qml", folder)
    functions = ring.functions(tool, "--lang", "glsl", "--frame", "orthonormal", "--green", "along-v")
    given = functions + (EXAMPLE / "cotan_material_main.frag").read_text()
    (folder / "cotan_material.frag").write_text(given)
    (folder / "ours.frag").write_text(given + ring.NUMBER_BYTES + NUMBERS)
    (folder / "own.frag").write_text(ring.replaced(given, CALL, TANGENTS) + ring.NUMBER_BYTES + NUMBERS)


def import_rings(tool, folder):
    """Folders, made by Qt's importer: without tangents, its default, also inside out; with those that it computes; and with
    those of MikkTSpace, from the file."""
    subprocess.run([tool, "tangents", folder / "bumps.gltf", "-o", folder / "stored.glb", "--quiet"], check=True)
    computed = ["--calculateTangentSpace", "bumps.gltf"]
    for place, words in (("without", ["bumps.gltf"]), ("computed", computed), ("back", ["inside_out.gltf"]), ("stored", ["stored.glb"])):
        ring.run("qtquick3d", "/usr/lib/qt6/bin/balsam", "-o", place, *words, folder=folder, log=folder / f"balsam_{place}.txt")
    sizes = [(folder / place / "meshes/meshes_0__mesh.mesh").stat().st_size for place in ("without", "stored")]
    assert (sizes[1] - sizes[0]) // len(ring.ring_mesh()[0]) == 24, "a tangent and a binormal"


def quaternion(m):
    w = np.sqrt(1 + np.trace(m)) / 2
    return [w, *np.array([m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]]) / (4 * w)]


def jobs_of(api):
    """ours, own: the normals that the lights get, with the material and with Qt's function and stored tangents. The others
    are PrincipledMaterial in Qt's debug view of normals, which has 8 bits."""
    cases = [(name, place, kind, f"{name}.frag") for name, place in (("ours", "without"), ("own", "stored")) for kind in ring.MAPS]
    cases += [("back", "back", "bumps", "ours.frag")]
    cases += [(place, place, "bumps", "") for place in ("stored", "computed", "without")] + [("lit", "without", "bumps", "cotan_material.frag")]
    return [{"folder": place, "maps": [f"{kind}_{side}.png" for side, *_ in ring.PAIR], "shader": shader, "parts": 6 if name in ("ours", "own", "back") else 1,
             "lit": name == "lit", "normals": not shader, "name": name, "kind": kind, "out": f"{api}_{name}_{kind}.bin", "rotation": quaternion(ring.BASIS),
             "eye": ring.EYE, "field": ring.FIELD, "width": ring.WIDTH, "height": ring.HEIGHT} for name, place, kind, shader in cases]  # fmt: skip


def pixels_of(normal, u, v, inside):
    """As judge_pair takes them. Qt's v runs up."""
    return np.concatenate([normal, u[..., None], 1 - v[..., None], np.ones((*u.shape, 1))], axis=-1) * inside[..., None]


def draw(folder, api):
    """Returns Qt's version, and the results of each name."""
    jobs = jobs_of(api)
    (folder / "jobs.json").write_text(json.dumps(jobs))
    for attempt in (1, 2):  # once in 40 runs, right after Qt was installed, nothing was drawn
        try:
            said = ring.run("qtquick3d", "python3", "measure.py", folder=folder, log=folder / f"{api}.txt", QSG_RHI_BACKEND=api, QSG_RENDER_LOOP="basic")
            break
        except AssertionError as wrong:
            if attempt == 2 or "no image in 20 seconds" not in str(wrong):
                raise
            print(f"drawn once more: {str(wrong).splitlines()[-1]}")
    wrong = [line for line in said.splitlines() if "rror" in line or "ailed" in line]
    assert "DONE" in said and f"drawn GraphicsApi.{api}".lower() in said.lower() and not wrong, wrong or said
    results, pixels = {}, {}
    for job in jobs:
        file, name, kind = folder / job["out"], job["name"], job["kind"]
        if name == "lit":
            ring.judge_lit(file)
            continue
        if job["parts"] == 6:
            normal, *others = ring.read_bytes(file, ring.HEIGHT, ring.WIDTH)
            pixels[(name, kind)] = pixels_of(normal * (-1 if name == "back" else 1), *others)
        else:
            _, u, v, inside = ring.read_bytes(folder / f"{api}_ours_bumps.bin", ring.HEIGHT, ring.WIDTH)
            normal = np.frombuffer(file.read_bytes(), np.uint8).reshape(*u.shape, 3) / 127.5 - 1
            pixels[(name, kind)] = pixels_of(normal / np.linalg.norm(normal, axis=-1, keepdims=True), u, v, inside)
        results.setdefault(name, {})[kind] = ring.judge_pair(f"Qt Quick 3D, {api}", kind, name, pixels[(name, kind)])
    ring.between(f"Qt Quick 3D, {api}", pixels[("ours", "bumps")], pixels[("own", "bumps")])
    return said.split("\nQt ")[1].split()[0], results


def main(tool, folder):
    ring.need("qtquick3d")
    ring.write_pair(folder)
    write_shaders(tool, folder)
    import_rings(tool, folder)
    for name in ("Measure.qml", "measure.py"):
        shutil.copy(HERE / name, folder)
    for api in ("opengl", "vulkan"):
        version, results = draw(folder, api)
        # Qt has no anisotropic filter, so that a minified map is blurred.
        ring.judge_ours(results["ours"], results["own"], bumps_limit=0.75)
        assert all(abs(results["back"]["bumps"][side][0] - results["ours"]["bumps"][side][0]) < 0.001 for side, *_ in ring.PAIR)
        # The debug view of its material agrees with its function: 8 bits of a normal are 0.2 degrees.
        assert all(abs(results["stored"]["bumps"][side][0] - results["own"]["bumps"][side][0]) < 0.2 for side, *_ in ring.PAIR)
        # Without tangents it derives a frame without a sign; those that its importer computes have green downwards.
        assert results["without"]["bumps"]["right"][0] > 30 and results["without"]["bumps"]["left"][0] < 1
        assert all(results["computed"]["bumps"][side][0] > 30 for side, *_ in ring.PAIR)
        ring.judge_page("Qt Quick 3D", version, results["ours"], results["own"])
    print(f"holds: Qt Quick 3D {version} draws without tangents what the formula says, by OpenGL and Vulkan")


if __name__ == "__main__":
    if len(sys.argv) > 2:
        main(sys.argv[1], pathlib.Path(sys.argv[2]).resolve())
    else:
        with tempfile.TemporaryDirectory() as place:
            main(sys.argv[1], pathlib.Path(place))
