"""No command replaces what it reads: every option of --help that names an output is given every input of its command, the
first one by several names of the file; and in the place of every file that a command writes there is a link to an input.

Usage: overwrite_walk_test.py COTAN GROUP, where GROUP is a word of GROUPS. Expects exit code 1 or 4, one line of errors,
and every input byte for byte as it was."""
import itertools
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from output_inputs import make_inputs

SKIPPED = 77
# A command with all its options that name files. Words that are files in the folder are inputs, with the files that they
# name themselves. All options of --help that name files are here: those not in READS name outputs.
CASES = [
    "view panel.gltf --normal-map grain.png --base-color colors.png --metallic-roughness rough.png --occlusion mask.png "
    "--height-map height.png --view mask --mask rocks.png --high high.obj --environment studio --size 64x48 --samples 1 --device reference --play session.txt --record out.txt --json out.json",
    "render panel.gltf --normal-map grain.png --base-color colors.png --metallic-roughness rough.png --occlusion mask.png "
    "--height-map height.png --view mask --mask rocks.png --size 16x12 --samples 1 --device reference -o out.png --json out.json",
    "render --shape plane --environment sky.hdr --size 16x12 --samples 1 --device reference -o out.png --json out.json",
    "render painted.obj --size 16x12 --samples 1 --device reference -o out.exr --json out.json",
    "render panel.gltf --size 16x12 --samples 1 --device reference --turntable 3 -o out.gif",
    "render panel.gltf --size 16x12 --samples 1 --device reference --turntable 3 -o out.webp",
    "render low.stl --size 16x12 --samples 1 --device reference -o out.tif --json out.json",
    "compare panel.gltf --normal-map grain.png --base-color colors.png --metallic-roughness rough.png --occlusion mask.png "
    "--height-map height.png --frames smooth,exact --size 16x12 --samples 1 --device reference -o out --json out.json",
    "lint panel.gltf --normal-map grain.png --json out.json",
    "map info rocks.png grain.png --json out.json",
    "map detect rocks.png grain.png --json out.json",
    "map convert rocks.png --from gltf --to object --mesh low.ply -o out.png --json out.json",
    "map convert rocks.png --from gltf --to directx --compress bc5 -o out.ktx2 --json out.json",
    "map diff rocks.png stones.png --from gltf --to gltf --mask rocks.png -o out.png --json out.json",
    "map from-height height.png -o out.tga --json out.json",
    "map to-height rocks.png --from gltf -o out.exr --json out.json",
    "map blend rocks.png grain.png --mask mask.png --from gltf --to gltf -o out.png --json out.json",
    "map mips rocks.png --from gltf -o out.dds --json out.json",
    "map mips rocks.png --from gltf -o out.png --json out.json",
    "bake --high panel.gltf --low low.obj --high-normals map --high-map rocks.png --cage cage.obj --size 16x16 --mask seen.png "
    "--verify checked --device reference -o out.png --json out.json",
    "bake --high layers.obj --low flat.obj --rays-mask mask.png --size 16x16 -o out.png --json out.json",
    "bake --high high.obj --low plain.gltf --size 16x16 -o out.gltf --json out.json",
    "bake --high high.obj --low room.gltf --per-object --size 8x8 -o out.png --json out.json",
    "convert panel.gltf --from-frame mikktspace --to-frame smooth --verify checked --device reference -o other/out.gltf --json out.json",
    "convert room.gltf --from-frame mikktspace --to-frame smooth -o out.glb --json out.json",
    "tangents plain.gltf -o out.gltf --json out.json",
    "shader --lang glsl --frame smooth -o out.glsl --json out.json",
    "accuracy --tables signs --against old.csv --csv out.csv -o out.md --json out.json",
    "figures --only mirrored --size 32x24 --device reference -o out --json out.json",
    "cost --cards cards.csv --no-timing -o out.md --csv out.csv --write-cards made.csv --json out.json",
    "batch jobs.jsonl --jobs 1 --store kept -o out.html --json out.json",
]
READS = {"--normal-map", "--base-color", "--metallic-roughness", "--occlusion", "--height-map", "--environment", "--play", "--mesh", "--high", "--low",
         "--high-map", "--rays-mask", "--cage", "--cards", "--against"}
MASKS_READ = {("map blend", "--mask"), ("map diff", "--mask"), ("render", "--mask"), ("view", "--mask")}  # the option is written by `bake`
GROUPS = {"look": ["view", "render", "compare", "lint"], "map": ["map"], "make": ["bake", "convert", "tangents", "shader"],
          "others": ["accuracy", "figures", "cost", "batch", "help"]}
NO_FILES = {"help"}
NUMBERED = ["--turntable", "mips", "--per-object"]  # with these, -o x.png writes x_0.png and so on, and not x.png
JOBS = [["map", "convert", "rocks.png", "--from", "gltf", "--to", "directx", "-o", "made.png"], ["lint", "panel.gltf"]]
SESSION = "0 wait\n0 do picture saved.png\n0 do window window.png\n0 do report report.txt\n0 do picture saved.png\n"


def make_all_inputs(tool, folder):
    make_inputs(folder)
    (folder / "jobs.jsonl").write_text("".join(json.dumps({"command": words}) + "\n" for words in JOBS))
    (folder / "session.txt").write_text(SESSION)
    (folder / "sub").mkdir()
    (folder / "other").mkdir()
    shutil.copy(folder / "rocks.png", folder / "stones.png")
    subprocess.run([tool, *"accuracy --tables signs --csv old.csv -o old.md".split()], cwd=folder, check=True, capture_output=True)
    (folder / "old.md").unlink()
    shutil.copy(pathlib.Path(__file__).resolve().parent.parent / "docs/explanation/cost.csv", folder / "cards.csv")


def files_named_in(path):
    """The files beside a file that it names: buffers and images of glTF, materials of OBJ, commands of jobs."""
    if path.suffix == ".gltf":
        root = json.loads(path.read_text())
        return [entry["uri"] for kind in ("buffers", "images") for entry in root.get(kind, []) if not entry["uri"].startswith("data:")]
    if path.suffix in (".obj", ".mtl"):
        return re.findall(r"^(?:mtllib|map_Kd|norm) (\S+)", path.read_text(), re.M)
    return [w for words in JOBS for w in words] if path.suffix == ".jsonl" else []


def inputs_of(words, folder):
    found, left = [], list(words)
    while left:
        name = left.pop(0)
        if (folder / name).is_file() and name not in found:
            found.append(name)
            left += files_named_in(folder / name)
    return found


def help_of(tool, command):
    return subprocess.run([tool, *command.split(), "--help"], capture_output=True, text=True, check=True).stdout


def commands_of(tool, command=""):
    text = help_of(tool, command)
    if " COMMAND [OPTIONS]" not in text:
        return [command]
    names = re.findall(r"^  ([a-z][a-z-]*) ", text.split("Examples:")[0], re.M)
    return [c for name in names for c in commands_of(tool, f"{command} {name}".strip())]


def command_of(words):
    return " ".join(words[:2]) if words[0] == "map" else words[0]


def outputs_named_in(tool, command):
    """The options that name outputs, as words of a command line."""
    text = help_of(tool, command)
    files = re.findall(r"^  (?:(-\w), )?(--[a-z0-9-]+) \S*(?:FILE|PATH|FOLDER|DIR)", text, re.M)
    return {short or long for short, long in files if long not in READS and (command, long) not in MASKS_READ}


class Folder:
    """A copy of the inputs, in which a command runs."""

    def __init__(self, inputs):
        self.temporary = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.temporary.name) / "work"
        shutil.copytree(inputs, self.path)
        self.before = self.contents()

    def contents(self):
        return {str(p.relative_to(self.path)): p.read_bytes() for p in sorted(self.path.rglob("*")) if p.is_file()}

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.temporary.cleanup()

    def run(self, tool, words):
        return subprocess.run([tool, *words], cwd=self.path, capture_output=True, text=True, timeout=120, check=False)

    def lost(self, names):
        """Inputs that are not as they were."""
        now = self.contents()
        return [name for name in names if now.get(name) != self.before[name]]


def spellings(folder, name):
    """Other names of a file, and links to it."""
    os.link(folder / name, folder / "hard")
    (folder / "soft").symlink_to(name)
    (folder / "folder").symlink_to(".")
    return [name, f"./sub/../{name}", str(folder / name), "hard", "soft", f"folder/{name}"]


def verdict(done, where, lost, codes):
    wrong = [f"{where}: {name} was overwritten" for name in lost]
    lines = done.stderr.strip().split("\n") if done.returncode != 0 else []
    notes = [line for line in lines if line.startswith("cotan: warning: ") and "would overwrite" not in line]
    if done.returncode not in codes or lines and not (len(lines) == len(notes) + 1 and lines[-1].startswith("cotan: error: ")):
        wrong.append(f"{where}: expected exit code {codes} and one line; found {done.returncode}, {done.stderr.strip() or 'no line'}")
    return wrong


def try_options(tool, source, words, inputs):
    wrong, tried = [], 0
    for at, option in enumerate(words):
        if option not in outputs_named_in(tool, command_of(words)):
            continue
        for number, name in enumerate(inputs):
            for spelling in range(1 if number else 6):
                with Folder(source) as folder:
                    given = spellings(folder.path, name)[spelling]
                    changed = [*words[:at + 1], given, *words[at + 2:]]
                    done = folder.run(tool, changed)
                    codes = {0, 1, 4} if given.endswith(".png") and any(word in words for word in NUMBERED) else {1, 4}
                    wrong += verdict(done, " ".join(changed), folder.lost(inputs), codes)
                    tried += 1
    return wrong, tried


def try_written_files(tool, source, words, inputs):
    """Runs the command, then with links to its inputs in the places of the files that it wrote."""
    with Folder(source) as folder:
        done = folder.run(tool, words)
        wrong = [f"{' '.join(words)}: exit code {done.returncode}: {done.stderr.strip()}"] if done.returncode not in (0, 5) else []
        wrong += [f"{' '.join(words)}: {name} was overwritten" for name in folder.lost(folder.before)]
        written = [name for name in folder.contents() if name not in folder.before]
    tried, link = 0, itertools.cycle((os.link, os.symlink))
    if not written:
        wrong.append(f"{' '.join(words)}: wrote nothing")
    # Every file and every input, not every pair of them.
    pairs = zip(*[itertools.islice(itertools.cycle(some), max(len(written), len(inputs))) for some in (written, inputs)]) if written else ()
    for place, name in pairs:
        codes = {1, 4}
        if words[0] == "batch":
            if place == "made.png" and name != "jobs.jsonl":
                if name != "rocks.png":
                    continue  # a job may write what the next one reads
                codes = {2}  # only this job fails
        with Folder(source) as folder:
            (folder.path / place).parent.mkdir(parents=True, exist_ok=True)
            next(link)(folder.path / name, folder.path / place)
            done = folder.run(tool, words)
            if (folder.path / place).read_bytes() == folder.before[name]:
                codes.add(0)  # another name was chosen, or the file, a lock, is only opened
            wrong += verdict(done, f"{' '.join(words)} with {place} -> {name}", folder.lost(inputs), codes)
            tried += 1
    return wrong, tried


class Display:
    """Xvfb on a free display, for `view`."""

    def __enter__(self):
        for name in ("DISPLAY", "WAYLAND_DISPLAY"):
            os.environ.pop(name, None)
        os.environ["DBUS_SESSION_BUS_ADDRESS"] = "unix:path=/nowhere"
        if not shutil.which("Xvfb"):
            self.server = None
            return self
        ours, theirs = os.pipe()
        self.server = subprocess.Popen(["Xvfb", "-nolisten", "tcp", "-displayfd", str(theirs)], pass_fds=[theirs], stderr=subprocess.DEVNULL)
        os.close(theirs)
        with os.fdopen(ours) as number:
            os.environ["DISPLAY"] = ":" + number.readline().strip()
        return self

    def __exit__(self, *_):
        if self.server:
            self.server.terminate()
            self.server.wait()


def main(tool, group):
    tool, wrong, tried, left_out = str(pathlib.Path(tool).resolve()), [], 0, []
    of_group = lambda command: command.split()[0] in GROUPS[group]
    here = [c for c in commands_of(tool) if c not in NO_FILES]
    wrong += [f"{c}: is in no group of this test" for c in here if not any(c.split()[0] in words for words in GROUPS.values())]
    cases = [case.split() for case in CASES if of_group(case)]
    for command in filter(of_group, here):
        given = {word for words in cases if command_of(words) == command for word in words}
        wrong += [f"{command} {option}: is tried by no line of this file" for option in outputs_named_in(tool, command) - given]
    with tempfile.TemporaryDirectory() as name, Display() as display:
        source = pathlib.Path(name)
        make_all_inputs(tool, source)
        for words in cases:
            inputs = inputs_of(words, source)
            if command_of(words) not in here or words[0] == "view" and not display.server:
                left_out.append(words[0])
                continue
            for lines, count in (try_options(tool, source, words, inputs), try_written_files(tool, source, words, inputs)):
                wrong += lines
                tried += count
    print(*wrong, sep="\n", end="\n" if wrong else "")
    print(f"{tried} command lines, {len(wrong)} of them wrong" + (f"; not here: {', '.join(left_out)}" if left_out else ""))
    return 1 if wrong else 0 if tried else SKIPPED


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
