"""The material of examples/filament in Filament, judged by the formula of two rings, beside the tangents that Filament
computes (geometry::SurfaceOrientation).

    filament.py TOOL [FOLDER]

TOOL: cotan; FOLDER: where files and images are left. Exit code 77 if Filament is missing (scripts/try-engines gets it)."""

import pathlib
import shutil
import sys
import tempfile

import numpy as np
import ring

HERE = pathlib.Path(__file__).resolve().parent / "filament"
EXAMPLE = ring.ROOT / "examples/filament"
LIBRARIES = "-lfilament -lfilament_backend -lfilament_geometry -lfilament_utils"
END = "    material.roughness = materialParams.roughness;\n"
NUMBERS = "    material.postLightingColor = materialParams.part < 0.5 ? vec4(shading_normal, 1.0) : vec4(uv, 0.0, 1.0);\n"


def write_materials(tool, folder):
    """lit: as the README says; ours, own: numbers in the place of the lit colour."""
    given = ring.replaced((EXAMPLE / "cotan_normal_map.mat.in").read_text(), "@COTAN@", ring.functions(tool, "--lang", "glsl", "--frame", "orthonormal"))
    (folder / "lit.mat").write_text(given)
    ours = ring.replaced(ring.replaced(given, END, END + NUMBERS), "flipUV", "postLightingBlending : opaque,\n    flipUV")
    parameter = "        { type : float, name : metallic },"
    ours = ring.replaced(ours, parameter, "        { type : float, name : part },\n" + parameter)
    (folder / "ours.mat").write_text(ours)
    start, end = ours.index("    useNormal(cotan"), ours.index("    material.baseColor =")
    read = "    material.normal = texture(materialParams_normalMap, getUV0()).xyz * 2.0 - 1.0;\n"
    own = ring.replaced(ours[:start] + ours[end:], "    prepareMaterial(material);\n", read + "    prepareMaterial(material);\n")
    (folder / "own.mat").write_text(own)
    for name in ("lit", "ours", "own"):
        words = ("-a", "opengl", "-p", "desktop", "-o", f"{name}.filamat", f"{name}.mat")
        ring.run("filament", "matc", *words, folder=folder, log=folder / f"matc_{name}.txt", screen=False)


def write_maps(folder):
    for side, formula, mirrored, _ in ring.PAIR:
        (folder / side).mkdir(exist_ok=True)
        for array, part in zip(ring.ring_mesh(mirrored), ("position", "normal", "uv", "corners")):
            array.tofile(folder / side / part)
        for kind, shown, width, height in (("bumps", formula, 2048, 1024), ("flat", ring.flat, 4, 4)):
            ring.map_pixels(shown, width, height).tofile(folder / f"{kind}_{side}.raw")
    np.array([ring.matrix(x) for *_, x in ring.PAIR], np.float32).tofile(folder / "matrices")


def main(tool, folder):
    ring.need("filament")
    write_maps(folder)
    write_materials(tool, folder)
    shutil.copy(HERE / "measure.cpp", folder)
    compiler = f"c++ -std=c++17 -O1 -w -I$(ls -d /usr/include/filament-*) measure.cpp -o measure {LIBRARIES}"
    compiler += " && dpkg-query -W -f '${Version}' libfilament-dev"
    version = ring.run("filament", "sh", "-c", compiler, folder=folder, log=folder / "compiler.txt", screen=False).split("+")[0]
    results, pixels = {}, {}
    for name in ("ours", "own"):
        for kind in ring.MAPS:
            out = folder / f"{name}_{kind}.bin"
            said = ring.run("filament", folder / "measure", f"{name}.filamat", kind, 2, int(name == "own"), out, folder=folder, log=out.with_suffix(".txt"))
            assert "DONE" in said, said
            pixels[(name, kind)] = ring.parts_of(out)
            results.setdefault(name, {})[kind] = ring.judge_pair("Filament", kind, name, pixels[(name, kind)])
    ring.between("Filament", pixels[("ours", "bumps")], pixels[("own", "bumps")])
    ring.judge_ours(results["ours"], results["own"])
    ring.run("filament", folder / "measure", "lit.filamat", "bumps", 1, 0, folder / "lit.bin", folder=folder, log=folder / "lit.txt")
    ring.judge_lit(folder / "lit.bin")
    ring.judge_page("Filament", version, results["ours"], results["own"])
    print(f"holds: Filament {version} draws without tangents what the formula says")


if __name__ == "__main__":
    if len(sys.argv) > 2:
        main(sys.argv[1], pathlib.Path(sys.argv[2]).resolve())
    else:
        with tempfile.TemporaryDirectory() as place:
            main(sys.argv[1], pathlib.Path(place))
