"""The release for Windows under Wine, beside the tool of this system: what windows_tool_test.py compares them with."""
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from output_inputs import make_inputs  # noqa: E402

wrong = []


def expect(holds, what):
    if not holds:
        wrong.append(what)


class Release:
    """The unpacked zip, in a folder whose name is not ASCII, and a new Wine prefix."""

    def __init__(self, packed, tool, folder):
        self.folder, self.tool = pathlib.Path(folder), tool
        with zipfile.ZipFile(packed) as archive:
            archive.extractall(self.folder / "Cotan für 日本")
        self.programs = next((self.folder / "Cotan für 日本").iterdir())
        self.environment = {**os.environ, "WINEPREFIX": str(self.folder / "wine"), "WINEDEBUG": "-all", "HOME": str(self.folder)}
        self.run("--version")  # Wine makes its prefix, and tells of it

    def run(self, *words, folder=None, program="cotan.exe", **more):
        return subprocess.run(["wine", str(self.programs / program), *map(str, words)], cwd=folder or self.folder,
                              env=self.environment, capture_output=True, timeout=300, check=False, **more)

    def lacksAstc(self):
        return b"no ASTC" in self.run("--version").stdout

    def close(self):
        for server in ("wineserver", "/usr/lib/wine/wineserver64"):
            if shutil.which(server):
                subprocess.run([server, "-k"], env=self.environment, check=False)
                return


def inputs(release, name):
    folder = release.folder / name
    folder.mkdir()
    make_inputs(folder)
    subprocess.run([release.tool, "convert", "panel.gltf", "-o", "m.glb"], cwd=folder, check=True, capture_output=True)
    return folder


def sha(path):
    return hashlib.sha256(pathlib.Path(path).read_bytes()).hexdigest()


class Display:
    """An X server of its own, for Wine's windows and its Vulkan."""

    def __init__(self, environment):
        reader, writer = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-displayfd", str(writer), "-screen", "0", "800x600x24"], pass_fds=[writer], stderr=subprocess.DEVNULL)
        os.close(writer)
        with os.fdopen(reader) as number:
            environment["DISPLAY"] = ":" + number.readline().strip()

    def close(self):
        self.server.kill()
        self.server.wait()


def sameHere(release, folder, words, output=None, codeOnly=False):
    """Runs a command under Wine and, in a folder beside it, here: exit code, text and output are equal."""
    here = folder.parent / (folder.name + "-here")
    if not here.exists():
        shutil.copytree(folder, here)
    there = release.run(*words, folder=folder)
    expected = subprocess.run([release.tool, *words], cwd=here, capture_output=True, check=False)
    same = there.returncode == expected.returncode
    if not codeOnly:
        said = re.sub(rb"^wine: .*\n", b"", there.stderr, flags=re.MULTILINE)  # its own device process crashes at times
        same = same and (there.stdout, said) == (expected.stdout, expected.stderr)
    expect(same, f"{words}: {there.returncode} {there.stdout.decode()}{there.stderr.decode()} here {expected.returncode} {expected.stdout.decode()}{expected.stderr.decode()}")
    if output:
        files = [place / output for place in (folder, here)]
        expect([file.exists() for file in files] == [True, True] and pixels(files[0]) == pixels(files[1]), f"{words}: another {output}")
    return there


def pixels(file):
    """The bytes of a file; of a Targa file without the two that name the version of OpenImageIO."""
    content = file.read_bytes()
    return content[:-54] + content[-52:] if file.suffix == ".tga" and content.endswith(b"TRUEVISION-XFILE.\0") else content
