#!/usr/bin/env python3
"""npm_tool_test.py TARBALL TOOL [FACT...]: the command of the npm package, installed in an empty folder and run by
Node.js, does what the tool of this system does. Exit code 77: the tarball has not been built, or npm is missing."""
import hashlib
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from output_bytes import steady  # noqa: E402
from output_inputs import make_inputs  # noqa: E402

wrong = []


def expect(holds, what):
    if not holds:
        wrong.append(what)


class Package:
    """The package in an empty folder, and the native tool."""

    def __init__(self, tarball, tool, folder):
        self.folder, self.tool = pathlib.Path(folder), str(tool)
        self.install = self.folder / "installed"
        self.install.mkdir()
        subprocess.run(["npm", "install", "--offline", "--no-audit", "--no-fund", "--silent", str(tarball)], cwd=self.install, check=True)
        self.command = self.install / "node_modules" / ".bin" / "cotan"

    def run(self, program, words, folder, **more):
        more.setdefault("timeout", 300)
        more.setdefault("stdin", subprocess.DEVNULL)
        return subprocess.run([program, *map(str, words)], cwd=folder, env={**os.environ, "HOME": str(folder)}, capture_output=True, check=False, **more)

    def inputs(self, name):
        folder = self.folder / name
        folder.mkdir()
        make_inputs(folder)
        subprocess.run([self.tool, "convert", "panel.gltf", "-o", "m.glb"], cwd=folder, check=True, capture_output=True)
        (folder / "empty.png").write_bytes(b"")
        (folder / "cut.png").write_bytes((folder / "rocks.png").read_bytes()[:700])
        (folder / "text.png").write_text("no image\n")
        (folder / "cut.glb").write_bytes((folder / "m.glb").read_bytes()[:900])
        (folder / "broken.gltf").write_text('{"asset": {"version": "2.0"}, "meshes": 3}')
        (folder / "no_buffer.gltf").write_text((folder / "panel.gltf").read_text().replace("panel.bin", "nothing.bin"))
        (folder / "nothing.obj").write_text("v 0 0\nf 1 2 9\n")
        shutil.copy(folder / "m.glb", folder / "модель ü 日本.glb")
        (folder / "folder").mkdir()
        return folder


# What both tools do alike, line by line: exit code, texts, and files.
LINES = """
help lint
help map convert
help bake
map --help
convert --help
lint
lint --nothing m.glb
lint m.glb --threads many
lint missing.glb
lint cut.glb
lint broken.gltf
lint no_buffer.gltf
lint nothing.obj
lint folder
lint m.glb
lint m.glb --json report.json
lint room.gltf --json -
lint plain.gltf --threads 3
lnit m.glb
map detct rocks.png
map detect rocks.png
map detect rocks.png --json -
map detect missing.png
map detect empty.png
map detect cut.png
map detect text.png
map detect folder
map info rocks.png colors.png --json info.json
map info grain.png
map convert rocks.png --from directx --to opengl -o fixed.png
map convert rocks.png --from directx --to opengl -o missing/fixed.png
map convert rocks.png --from directx --to opengl -o rocks.png
map convert rocks.png --from directx --to opengl -o folder
map convert rocks.png --from nonsense --to opengl -o never.png
map convert cut.png --from directx --to opengl -o never.png
map convert rocks.png --from directx --to opengl
map mips rocks.png -o mips.ktx2
map blend rocks.png grain.png -o blended.png
map from-height height.png --strength 7 -o normals.png
map from-height height.png --metres 0x1 --range 0.05 -o never.png
map from-height height.png --metres 2x1.5e0 --range 1e-2 -o metres.png
map to-height rocks.png -o height_again.png
map diff rocks.png fixed.png
convert m.glb -o out.glb
convert m.glb -o out.glb --json -
convert модель ü 日本.glb -o öut 日本.glb
convert room.gltf -o room_out.gltf
convert m.glb -o m.glb
convert m.glb -o missing/out.glb
convert cut.glb -o never.glb
bake --high high.obj --low low.obj --size 64 -o baked.png
bake --high high.obj --low low.obj --size 32 --kind ao --ao-rays 16 -o ao.png --json ao.json
bake --high missing.obj --low low.obj -o never.png
bake --high high.obj --low nothing.obj -o never.png
bake --high high.obj --low low.obj --size 0x5 -o never.png
tangents low.obj -o tangents.glb
tangents missing.obj -o never.glb
shader --lang hlsl --frame orthonormal
shader --lang glsl --frame cotangent -o frame.glsl
shader --lang wgsl --frame smooth --json -
shader --lang cobol
compare m.glb --size 64x48 --device reference
render m.glb --size 64x48 --device reference -o picture.png
render m.glb --size 64x48 --device reference --camera 1e2,0,0,0,0,0,x -o never.png
render cut.glb --device reference -o never.png
"""
SPACED = "модель ü 日本.glb", "öut 日本.glb"  # names that have spaces


def words_of(line):
    for number, name in enumerate(SPACED):
        line = line.replace(name, f"@{number}")
    return [SPACED[int(word[1:])] if word[0] == "@" else word for word in line.split()]


def rounded(text):
    """Without times; numbers with seven digits, because each C library has another arc cosine."""
    return re.sub(r"-?[0-9]+\.[0-9]+(e-?[0-9]+)?", lambda number: f"{float(number[0]):.7g}", steady(text))


def files_of(folder):
    return {str(path.relative_to(folder)): hashlib.sha256(rounded(path.read_text()).encode() if path.suffix == ".json" else path.read_bytes()).hexdigest()
            for path in sorted(folder.rglob("*")) if path.is_file()}


def commandLinesGiveTheSameTextsCodesAndFiles(package):
    ours, theirs = package.inputs("npm"), package.inputs("native")
    codes, known = set(), set()
    for line in LINES.strip().split("\n"):
        words = words_of(line)
        a, b = package.run(package.command, words, ours), package.run(package.tool, words, theirs)
        codes.add(b.returncode)
        expect(a.returncode == b.returncode, f"{line}: exit code {a.returncode}, natively {b.returncode}: {a.stderr.decode()}")
        for what, one, other in (("prints", a.stdout, b.stdout), ("says", a.stderr, b.stderr)):
            expect(rounded(one.decode()) == rounded(other.decode()), f"{line}: {what}\n{one.decode()[:600]}\n  natively\n{other.decode()[:600]}")
        here, there = files_of(ours), files_of(theirs)
        differing = {name for name in {**here, **there} if here.get(name) != there.get(name)}
        expect(differing <= known, f"{line}: files differ: {differing - known}")
        known |= differing
    expect({0, 1, 2, 4} <= codes, f"the table has the exit codes {codes}")


def itRunsByNpxInAnEmptyFolder(package):
    shutil.copy(package.inputs("npx") / "rocks.png", package.install)
    run = package.run("npx", ["--offline", "cotan", "map", "detect", "rocks.png"], package.install)
    expect(run.returncode == 0 and b"green: up" in run.stdout, f"{run.returncode} {run.stdout.decode()} {run.stderr.decode()}")


def whatOnlyTheNativeToolHasIsSaidInOneLine(package):
    folder = package.inputs("left out")
    (folder / "jobs.txt").write_text("map detect rocks.png\n")
    (folder / "model.fbx").write_bytes(b"Kaydara FBX Binary  \0")
    (folder / "picture.exr").write_bytes(bytes.fromhex("762f310102000000") + bytes(64))
    for words in (["view", "m.glb"], ["m.glb"], ["batch", "jobs.txt"], ["accuracy"], ["figures"], ["cost"], ["lint", "model.fbx"],
                  ["map", "info", "picture.exr"], ["render", "m.glb", "--device", "vulkan", "-o", "n.png"]):
        run = package.run(package.command, words, folder)
        expect(run.returncode == 3 and run.stderr.count(b"\n") == 1 and b"native tool" in run.stderr, f"{words}: {run.returncode} {run.stderr.decode()}")
    for word in ("--help", "--version"):
        run = package.run(package.command, [word], folder)
        expect(run.returncode == 0 and b"Only the native tool has" in run.stdout, f"{word}: {run.stdout.decode()[:400]}")


def aSignalEndsItAndLeavesNoUnfinishedFile(package):
    folder = package.inputs("signals")
    for number in (signal.SIGINT, signal.SIGTERM):
        run = subprocess.Popen([package.command, "render", "room.gltf", "--device", "reference", "--size", "3000x3000", "--turntable", "40", "-o", "turn.png"],
                               cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        for _ in range(600):
            if list(folder.glob(".cotan-*")) or run.poll() is not None:
                break
            time.sleep(0.05)
        seen = list(folder.glob(".cotan-*"))
        began = time.monotonic()
        run.send_signal(number)
        run.wait(60)
        expect(seen, "no unfinished file was seen: this test no longer interrupts")
        expect(run.returncode == -number and time.monotonic() - began < 5, f"{number}: exit code {run.returncode} after {time.monotonic() - began:.1f} s")
        expect(not list(folder.glob(".cotan-*")), f"{number}: {list(folder.glob('.cotan-*'))} are left")


def pipesAndTerminalsAreTakenForWhatTheyAre(package):
    folder = package.inputs("pipes")
    ours, native = (package.run(program, ["map", "info", "/dev/stdin"], folder, stdin=None, input=b"P") for program in (package.command, package.tool))
    expect((ours.returncode, ours.stderr) == (native.returncode, native.stderr), f"a pipe as input: {ours.stderr.decode()}, natively {native.stderr.decode()}")
    script = "cotan shader --lang hlsl --frame smooth | head -1; echo ${PIPESTATUS[0]}"
    run = package.run("bash", ["-c", script.replace("cotan", str(package.command), 1)], folder)
    expect(run.stdout.endswith(b"\n0\n") and not run.stderr, f"a closed pipe: {run.stdout.decode()} {run.stderr.decode()}")
    run = package.run("bash", ["-c", f"{package.command} shader --lang hlsl --frame smooth > /dev/full"], folder)
    expect(run.returncode == 4 and b"no space left" in run.stderr, f"a full disk: {run.returncode} {run.stderr.decode()}")
    run = package.run("bash", ["-c", f"{package.command} map info rocks.png --json - | wc -c"], folder)
    native = package.run(package.tool, ["map", "info", "rocks.png", "--json", "-"], folder)
    expect(int(run.stdout) == len(native.stdout), "a pipe gets all of a report")


def outputsAreThoseOfTheTables(package):
    """The tables of output_bytes.py, which hold what this system's tool makes. The arc cosine of angles in images of
    errors is that of another C library, and Embree rounds otherwise where it traces images of the high model: their
    last bits may differ, and nothing else."""
    wrapper = package.folder / "cotan"
    wrapper.write_text(f'#!/bin/sh\nexec "{package.command}" "$@"\n')
    wrapper.chmod(0o755)
    for table, least in (("maps", 50), ("meshes", 20), ("shader_text", 80), ("pictures", 10)):
        run = subprocess.run([sys.executable, HERE / "output_bytes.py", wrapper, HERE / "output_bytes" / f"{table}.txt", "--where-built"], capture_output=True, text=True, check=False)
        lines = run.stdout.split("\n")
        compared = next((line for line in lines if " commands compared" in line), "0")
        differing = [name for line in lines if line.startswith("    ") for name in line.split(",") if "error-" not in name and "/high-" not in name]
        print(table, compared, flush=True)
        expect(int(compared.split()[0]) >= least and not differing, f"{table}: {run.stdout}{run.stderr}")


def thePackageHasItsLicencesAndIsSmall(package):
    root = package.install / "node_modules" / "cotan"
    licences = (root / "wasm" / "cli.licences.txt").read_text()
    for name in ("png", "zlib", "webp", "jpeg", "libfmt", "libglm", "nlohmann"):
        expect(name in licences, f"no licence of {name}")
    manifest = json.loads((root / "package.json").read_text())
    expect(manifest["bin"] == {"cotan": "cli.mjs"} or manifest["bin"] == {"cotan": "./cli.mjs"}, str(manifest.get("bin")))
    size = pathlib.Path(sys.argv[1]).stat().st_size
    print(f"tarball: {size} bytes")
    expect(size < 6_000_000, f"the tarball has {size} bytes")


FACTS = (itRunsByNpxInAnEmptyFolder, commandLinesGiveTheSameTextsCodesAndFiles, whatOnlyTheNativeToolHasIsSaidInOneLine,
         aSignalEndsItAndLeavesNoUnfinishedFile, pipesAndTerminalsAreTakenForWhatTheyAre, thePackageHasItsLicencesAndIsSmall, outputsAreThoseOfTheTables)
if __name__ == "__main__":
    if not pathlib.Path(sys.argv[1]).exists() or not shutil.which("npm"):
        print("skipped: the package with the command has not been built (scripts/npm-package build/npm build/web-libraries)")
        sys.exit(77)
    for fact in [f for f in FACTS if f.__name__ in sys.argv[3:]] or FACTS:
        before = len(wrong)
        with tempfile.TemporaryDirectory() as place:
            fact(Package(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), place))
        print(fact.__name__, "fails" if len(wrong) > before else "holds", flush=True)
    print(*wrong, sep="\n", end="\n" if wrong else "")
    sys.exit(bool(wrong))
