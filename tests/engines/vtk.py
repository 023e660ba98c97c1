"""The function of examples/vtk in VTK, judged by the formula of two rings, beside the tangents of VTK's glTF importer.

    vtk.py TOOL [FOLDER]

TOOL: cotan; FOLDER: where files and images are left. Exit code 77 if VTK is missing (scripts/try-engines gets it)."""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

import numpy as np
import ring

HERE = pathlib.Path(__file__).resolve().parent / "vtk"
EXAMPLE = ring.ROOT / "examples/vtk"


def main(tool, folder):
    ring.need("vtk")
    ring.write_pair(folder)
    shutil.copy(HERE / "measure.py", folder)
    shutil.copy(EXAMPLE / "cotan_vtk.py", folder)
    (folder / "cotan.glsl").write_text(ring.functions(tool, "--lang", "glsl", "--frame", "orthonormal", "--green", "along-v"))
    subprocess.run([tool, "tangents", folder / "bumps.gltf", "-o", folder / "stored.glb", "--quiet"], check=True)
    cases = [(whose, kind, f"{kind}.gltf") for whose in ("ours", "own") for kind in ring.MAPS]
    cases += [("back", "bumps", "inside_out.gltf"), ("stored", "bumps", "stored.glb")]
    jobs = [{"model": model, "kind": "own" if whose == "stored" else whose, "parts": 6, "out": f"{whose}_{kind}.bin"}
            for whose, kind, model in cases]  # fmt: skip
    jobs.append({"model": "bumps.gltf", "kind": "ours", "parts": 1, "out": "lit.bin"})
    whole = {"width": ring.WIDTH, "height": ring.HEIGHT, "eye": ring.EYE, "field": ring.FIELD, "number_bytes": ring.NUMBER_BYTES, "jobs": jobs}
    (folder / "jobs.json").write_text(json.dumps(whole))
    said = ring.run("vtk", "python3", "measure.py", folder=folder, log=folder / "measure.txt")
    assert "DONE" in said and "ERR|" not in said, said[-3000:]
    version = next(line.split()[1] for line in said.splitlines() if line.startswith("VTK "))
    results, pixels = {}, {}
    for whose, kind, _ in cases:
        normal, u, v, inside = ring.read_bytes(folder / f"{whose}_{kind}.bin", ring.HEIGHT, ring.WIDTH)
        # VTK's v runs up. It flips normals where it sees the back of a triangle.
        parts = (normal * (-1 if whose == "back" else 1), u[..., None], 1 - v[..., None], np.ones((*u.shape, 1)))
        pixels[(whose, kind)] = np.concatenate(parts, axis=-1) * inside[..., None]
        results.setdefault(whose, {})[kind] = ring.judge_pair("VTK", kind, whose, pixels[(whose, kind)])
    ring.between("VTK", pixels[("ours", "bumps")][:, : ring.WIDTH // 2], pixels[("own", "bumps")][:, : ring.WIDTH // 2])
    ring.judge_ours(results["ours"], results["own"])
    assert all(abs(results["back"]["bumps"][side][0] - results["ours"]["bumps"][side][0]) < 0.001 for side, *_ in ring.PAIR)
    # VTK keeps no sign with its tangents, neither with its own nor with those of the file.
    for whose in ("own", "stored"):
        assert results[whose]["bumps"]["left"][0] < 0.6 and results[whose]["bumps"]["right"][0] > 30, whose
    ring.judge_lit(folder / "lit.bin")
    ring.judge_page("VTK", version, results["ours"], results["own"])
    print(f"holds: VTK {version} draws without tangents what the formula says")


if __name__ == "__main__":
    if len(sys.argv) > 2:
        main(sys.argv[1], pathlib.Path(sys.argv[2]).resolve())
    else:
        with tempfile.TemporaryDirectory() as place:
            main(sys.argv[1], pathlib.Path(place))
