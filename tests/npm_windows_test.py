#!/usr/bin/env python3
"""npm_windows_test.py TARBALL TOOL NODE [FACT...]: the command of the npm package, run under Wine by NODE, a node.exe, takes
the names of files that Windows has, and does with them what the tool of this system does. Exit code 77: Wine, the tarball
or npm is missing."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
import npm_tool_test  # noqa: E402
from npm_tool_test import Package, expect, files_of, rounded  # noqa: E402


class WindowsPackage(Package):
    def __init__(self, tarball, tool, node, folder):
        super().__init__(tarball, tool, folder)
        self.node = node
        self.environment = {**os.environ, "WINEPREFIX": str(self.folder / "wine"), "WINEDEBUG": "-all", "NODE_SKIP_PLATFORM_CHECK": "1"}
        self.cli = self.windows(self.install / "node_modules" / "cotan" / "cli.mjs")
        self.wine("map", "--help", folder=self.folder)  # Wine makes its prefix, and tells of it

    @staticmethod
    def windows(path):
        return f"Z:{path}".replace("/", "\\")

    def wine(self, *words, folder):
        """Node.js under Wine cannot write to pipes of this system."""
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            run = subprocess.run(["wine", self.node, self.cli, *words], cwd=folder, env=self.environment, stdin=subprocess.DEVNULL, stdout=out, stderr=err, timeout=300, check=False)
            for file in (out, err):
                file.seek(0)
            run.stdout, run.stderr = out.read(), err.read()
            return run

    def close(self):
        for server in ("wineserver", "/usr/lib/wine/wineserver64"):
            if shutil.which(server):
                subprocess.run([server, "-k"], env=self.environment, check=False)
                return


# Each with names of this system: "@" is the folder of the files, "%" that of the outputs.
LINES = """
map detect @rocks.png
map info @rocks.png @colors.png --json %info.json
map info @folder
map convert @rocks.png --from directx --to opengl -o %fixed.png
map convert @rocks.png --from directx --to opengl -o %again.png --json -
map convert @rocks.png --from directx --to opengl -o @rocks.png
map convert @rocks.png --from directx --to opengl -o %missing/fixed.png
map convert @cut.png --from directx --to opengl -o %never.png
map convert @missing.png --from directx --to opengl -o %never.png
map blend @rocks.png @grain.png -o %blended.png
map mips @rocks.png -o %mips.ktx2
lint @panel.gltf --json %lint.json
lint @painted.obj --normal-map @rocks.png
lint @no_buffer.gltf
lint @cut.glb
convert @room.gltf -o %room.gltf
convert @m.glb -o %m.glb
convert @m.glb -o @m.glb
bake --high @high.obj --low @low.obj --cage @cage.obj --size 32 -o %baked.png --json %baked.json
bake --high @high.obj --low @low.obj --size 32 --maps normal,ao --ao-rays 4 -o %several.png
tangents @low.obj -o %low.glb
shader --lang hlsl --frame smooth -o %normal.hlsl
render @m.glb --size 64x48 --device reference --base-color @colors.png -o %picture.png
"""


def commandsTakeNamesOfWindows(package):
    """Names with backslashes, drives, both, a drive's own folder, and no folder at all."""
    for number, (source, target) in enumerate((("in\\", "out\\"), ("C", "C"), ("..\\W\\in\\", ".\\out\\"), ("Z:in\\", "Z:out\\"), ("in/", "out\\"))):
        both = []
        for name in (f"w{number}", f"l{number}"):
            folder = package.folder / name / "W"
            (folder / "out").mkdir(parents=True)
            files = package.inputs(f"{name}/W/in")
            shutil.copy(files / "rocks.png", files / "folder" / "x.png")
            both.append(folder)
        ours, theirs = both
        if source == "C":
            source, target = (package.windows(ours / name) + "\\" for name in ("in", "out"))
        for line in LINES.strip().split("\n"):
            if number and line.split()[0] in ("bake", "render"):
                continue  # which take seconds
            a = package.wine(*[word.replace("@", source).replace("%", target) for word in line.split()], folder=ours)
            b = package.run(package.tool, [word.replace("@", "in/").replace("%", "out/") for word in line.split()], theirs)
            expect(a.returncode == b.returncode, f"{line}: exit code {a.returncode}, natively {b.returncode}: {a.stderr.decode()}")
            for what, one, other in (("prints", a.stdout, b.stdout), ("says", a.stderr, b.stderr)):
                one, other = rounded(one.decode()), rounded(other.decode())
                plain = one.replace("\\\\", "\\").replace(source, "in/").replace(target, "out/").replace("\\", "/")
                expect(plain == other, f"{line} with {source}: {what}\n{one[:600]}\n  natively\n{other[:600]}")
                expect(not any(name in one for name in ("/Z:", "Z:/", "W/in/", "out/")) or "/" in source, f"{line} with {source}: other names than typed: {one[:600]}")
        here, there = files_of(ours), files_of(theirs)
        expect(set(here) == set(there), f"{source}: other files: {set(here) ^ set(there)}")
        differing = {name for name in here if here[name] != there.get(name) and not name.endswith(".json")}
        expect(not differing, f"{source}: files differ: {differing}")


def namesOfDevicesAndSharesAreRefusedInOneLine(package):
    folder = package.inputs("refused")
    (folder / "a").mkdir()
    for name, text in (("CON.png", "the device CON"), ("a\\nul.png", "the device NUL"), ("COM1.png", "the device COM1"), ("Z:aux.png", "the device AUX"),
                       ("Z:\\no\\n.png", "Z:\\no\\n.png: the folder Z:\\no does not exist"), ("\\\\server\\share\\n.png", "\\\\server\\share\\n.png: the folder \\\\server\\share does not exist")):
        run = package.wine("map", "convert", "rocks.png", "--from", "directx", "--to", "opengl", "-o", name, folder=folder)
        expect(run.returncode == 4 and text in run.stderr.decode() and run.stderr.count(b"error:") == 1, f"{name}: {run.returncode} {run.stderr.decode()}")
    run = package.wine("map", "convert", "rocks.png", "--from", "directx", "--to", "opengl", "-o", "a\\contour.png", folder=folder)
    expect(run.returncode == 0 and (folder / "a" / "contour.png").exists(), run.stderr.decode())
    expect(not list(folder.rglob(".cotan-*")), "unfinished files are left")


def referencesOfModelsStayInTheirFolder(package):
    folder = package.inputs("references")
    (folder / "model").mkdir()
    (folder / "model" / "sub").mkdir()
    shutil.copy(folder / "rocks.png", folder / "model" / "sub" / "rocks.png")
    shutil.copy(folder / "painted.obj", folder / "model")
    (folder / "model" / "painted.mtl").write_text((folder / "painted.mtl").read_text() + "norm sub\\rocks.png\n")
    good = package.wine("lint", "model\\painted.obj", "--json", "good.json", folder=folder)
    expect(good.returncode in (0, 1) and b"rocks.png" not in good.stderr, good.stderr.decode())
    for reference in ("..\\rocks.png", package.windows(folder / "rocks.png"), "Z:/" + str(folder / "rocks.png")[1:]):
        (folder / "model" / "painted.mtl").write_text((folder / "painted.mtl").read_text() + f"norm {reference}\n")
        bad = package.wine("lint", "model\\painted.obj", folder=folder)
        expect(b"rocks.png" in bad.stderr, f"{reference} is read: {bad.returncode} {bad.stderr.decode()}")


FACTS = (commandsTakeNamesOfWindows, namesOfDevicesAndSharesAreRefusedInOneLine, referencesOfModelsStayInTheirFolder)
if __name__ == "__main__":
    tarball, tool, node = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
    missing = [name for name in ("wine", "npm") if not shutil.which(name)] + [str(file) for file in (tarball, node) if not file.exists()]
    if missing:
        print(f"skipped: {missing[0]} is missing")
        sys.exit(77)
    for fact in [f for f in FACTS if f.__name__ in sys.argv[4:]] or FACTS:
        before = len(npm_tool_test.wrong)
        with tempfile.TemporaryDirectory() as place:
            package = WindowsPackage(tarball, tool, node, place)
            try:
                fact(package)
            finally:
                package.close()
        print(fact.__name__, "fails" if len(npm_tool_test.wrong) > before else "holds", flush=True)
    print(*npm_tool_test.wrong, sep="\n", end="\n" if npm_tool_test.wrong else "")
    sys.exit(bool(npm_tool_test.wrong))
