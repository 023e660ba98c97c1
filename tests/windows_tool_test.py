#!/usr/bin/env python3
"""windows_tool_test.py ZIP TOOL FACT: the release for Windows, unpacked in an empty folder and run under Wine, does what
the tool of this system does. Exit code 77: Wine is missing."""
import hashlib
import json
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from damaged_files import KINDS, breakText, damaged  # noqa: E402
from output_bytes import png_pixels  # noqa: E402
from windows_release import Display, expect, inputs, pixels, Release, sameHere, sha, wrong  # noqa: E402


def namesOfAllLettersAreReadAndWritten(release):
    folder = inputs(release, "Größe 法線 😀")
    model = folder / "m.glb"
    shutil.copy(model, folder / "модель ü.glb")
    run = release.run("convert", "модель ü.glb", "-o", "öut 日本.glb", "--json", "rёport.json", folder=folder)
    expect(run.returncode == 0, run.stderr.decode())
    expect((folder / "öut 日本.glb").exists(), "no output under its name: " + str(sorted(p.name for p in folder.iterdir())))
    expect("öut 日本.glb" in run.stdout.decode() + (folder / "rёport.json").read_text(), "the name is not said as it was given")
    missing = release.run("lint", "ничего.glb", folder=folder)
    expect(missing.returncode == 2 and "ничего.glb: no such file" in missing.stderr.decode(), missing.stderr.decode())


def backslashesDrivesAndLongNamesArePaths(release):
    folder = inputs(release, "paths")
    model = folder / "m.glb"
    deep = folder / "a" / ("b" * 120) / ("c" * 120)
    deep.mkdir(parents=True)
    shutil.copy(model, deep / "m.glb")
    for name in (f"Z:{model}".replace("/", "\\"), f".\\{model.name}", f"..\\paths\\{model.name}", str(model), str(deep / "m.glb").replace("/", "\\")):
        run = release.run("lint", name, "--json", "r.json", folder=folder)
        expect(run.returncode in (0, 1) and json.loads((folder / "r.json").read_text()), f"{name}: {run.stderr.decode()}")
        (folder / "r.json").unlink(missing_ok=True)


def namesOfDevicesAreNoFiles(release):
    folder = inputs(release, "devices")
    model = folder / "m.glb"
    for name, device in (("CON.glb", "CON"), ("nul.glb", "NUL"), ("a\\COM1.glb", "COM1"), ("lpt9 .glb", "LPT9")):
        (folder / "a").mkdir(exist_ok=True)
        run = release.run("convert", model.name, "-o", name, folder=folder)
        expect(run.returncode != 0 and f"the device {device}" in run.stderr.decode(), f"{name}: {run.returncode} {run.stderr.decode()}")
    run = release.run("convert", model.name, "-o", "console.glb", folder=folder)
    expect(run.returncode == 0, "console.glb is a file: " + run.stderr.decode())


def anInputIsNeverReplaced(release):
    folder = inputs(release, "inputs")
    model = folder / "m.glb"
    before = sha(model)
    for name in (model.name, model.name.upper(), f".\\{model.name}", f"Z:{model}"):
        if not (folder / name).exists() and name == model.name.upper():
            continue  # this file system tells cases apart, and Wine looks in it
        run = release.run("convert", model.name, "-o", name, folder=folder)
        expect(run.returncode != 0 and "is an input" in run.stderr.decode(), f"{name}: {run.returncode} {run.stderr.decode()}")
        expect(sha(model) == before, f"{name}: the input has changed")
    expect(not list(folder.glob(".cotan-*")), "unfinished files are left")


def theReaderOfUntrustedFilesIsAChild(release):
    folder = inputs(release, "child")
    for name, content in (("broken.webp", b"RIFF\x20\0\0\0WEBPVP8 \x10\0\0\0" + b"\xff" * 16), ("empty.webp", b"")):
        (folder / name).write_bytes(content)
        run = release.run("map", "info", name, folder=folder)
        here = subprocess.run([release.tool, "map", "info", name], cwd=folder, capture_output=True, check=False)
        expect((run.returncode, run.stderr) == (here.returncode, here.stderr), f"{name}: {run.returncode} {run.stderr.decode()} here {here.stderr.decode()}")
    internal = release.run("read-for-parent", folder=folder, stdin=subprocess.DEVNULL)
    good = release.run("bake", "--high", "high.obj", "--low", "low.obj", "--size", "32", "-o", "n.png", folder=folder)
    expect(good.returncode == 0, "models are read: " + good.stderr.decode())
    expect(internal.returncode == 1 and b"is internal" in internal.stderr, internal.stderr.decode())


def itNeedsNothingBesideIt(release):
    run = release.run("--version")
    expect(run.returncode == 0 and run.stdout.startswith(b"cotan "), run.stderr.decode())
    alone = release.folder / "alone"
    alone.mkdir()
    shutil.copy(release.programs / "cotan.exe", alone)
    run = subprocess.run(["wine", str(alone / "cotan.exe"), "shader", "--lang", "hlsl", "--frame", "smooth"], env=release.environment, cwd=alone, capture_output=True, timeout=120, check=False)
    expect(run.returncode == 0 and b"float3" in run.stdout and b"\r" not in run.stdout, run.stderr.decode())


def theLibraryDoesWhatItDoesHere(release):
    """The C example and a program that writes all formats of images, compiled against the header and the import library of
    the zip."""
    if not shutil.which("x86_64-w64-mingw32-gcc-posix"):
        return expect(False, "mingw-w64 is missing (scripts/setup doors)")
    folder, built = inputs(release, "library"), release.tool.parent.parent / "src" / "c"
    compress = ["bc5.x.dds", "bc7.x.ktx2", "uastc.x.ktx2"]
    outputs = [f"x.{kind}" for kind in IMAGES if kind not in ("dds", "ktx2", "jpg")] + compress
    shutil.copytree(folder, folder.parent / "library-here")
    for source, words in ((HERE.parent / "examples" / "c" / "main.c", []), (HERE / "c_formats.c", ["rocks.png", *outputs])):
        subprocess.run(["x86_64-w64-mingw32-gcc-posix", "-std=c99", "-O1", f"-I{release.programs}/include", source,
                        release.programs / "lib" / "libcotan.dll.a", "-o", release.programs / "program.exe"], check=True)
        subprocess.run(["gcc", "-std=c99", "-O1", f"-I{release.programs}/include", source, built / "libcotan.so", f"-Wl,-rpath,{built}", "-lm", "-o", release.folder / "program"], check=True)
        there = release.run(*words, program="program.exe", folder=folder)
        here = subprocess.run([release.folder / "program", *words], cwd=folder.parent / "library-here", capture_output=True, check=False)
        expect(there.returncode == here.returncode == 0 and there.stdout.replace(b"\r", b"") == here.stdout,
               f"{source.name}: {there.returncode} {there.stdout.decode()}{there.stderr.decode()}; here {here.returncode} {here.stdout.decode()}{here.stderr.decode()}")
        expect(words or b"baked" in here.stdout, "the example bakes")
    for name in outputs:
        files = [place / name for place in (folder, folder.parent / "library-here")]
        expect(all(file.exists() for file in files) and pixels(files[0]) == pixels(files[1]), f"the library writes another {name}")
    if not release.lacksAstc():  # its version may differ from that of this system
        release.run("rocks.png", "astc-4x4.x.ktx2", program="program.exe", folder=folder)
        release.run("map", "convert", "rocks.png", "--from", "opengl", "--to", "opengl", "--compress", "astc-4x4", "-o", "tool.ktx2", folder=folder)
        expect(sha(folder / "astc-4x4.x.ktx2") == sha(folder / "tool.ktx2"), "the library writes another texture of ASTC than the tool")


def theWheelHasThatLibrary(release):
    place = release.folder
    (place / "build" / "src" / "c").mkdir(parents=True)
    shutil.copy(release.programs / "cotan.dll", place / "build" / "src" / "c")
    made = subprocess.run([HERE.parent / "scripts" / "python-wheel", place / "wheel", place / "build"], capture_output=True, text=True, check=False)
    expect(made.returncode == 0, made.stderr)
    wheels = list((place / "wheel").glob("*.whl"))
    expect([w.name.endswith("-py3-none-win_amd64.whl") for w in wheels] == [True], f"wheels: {wheels}")
    with zipfile.ZipFile(wheels[0]) as wheel:
        expect(hashlib.sha256(wheel.read("cotan/cotan.dll")).hexdigest() == sha(release.programs / "cotan.dll"), "the wheel has another library")
        expect(not [name for name in wheel.namelist() if ".so" in name], "the wheel has a library of another system")


def suggestedCommandsRunInTheShell(release):
    """What `map detect` tells the user to run does what it says, typed at the prompt of cmd.exe. Wine's own replaces %NAME%
    after it has taken off each ^, as no other does: shell_words_test.cpp has such names."""
    folder, name = inputs(release, "suggested"), "R&D (1), it's ^50% done"
    subprocess.run([release.tool, "map", "convert", "rocks.png", "--from", "opengl", "--to", "directx", "-o", f"{name}.png"], cwd=folder, check=True, capture_output=True)
    told = release.run("map", "detect", f"{name}.png", folder=folder).stdout.decode()
    lines = [line.split(": ", 1)[1] for line in told.splitlines() if line.startswith("to fix it: ")]
    expect(len(lines) == 1 and lines[0].startswith("cotan map convert "), told)
    shell = subprocess.run(["wine", "cmd"], input="".join(line + "\r\n" for line in lines).encode(), cwd=folder, capture_output=True, timeout=300, check=False,
                           env={**release.environment, "WINEPATH": f"Z:{release.programs}".replace("/", "\\")})
    expect((folder / f"{name}-fixed.png").exists(), f"{lines} {shell.stdout.decode(errors='replace')} {shell.stderr.decode(errors='replace')}")


def theDeviceAndTheWindowShowWhatTheyShowHere(release):
    if not shutil.which("Xvfb"):
        return expect(False, "Xvfb is missing (scripts/setup test)")
    folder = inputs(release, "pictures")
    display = Display(release.environment)
    try:
        for model in ("room.gltf", "low.ply", "painted.obj", "m.glb"):
            words = ["render", model, "--size", "160x120", "--device", "llvmpipe", "--json", f"{model}.json", "-o"]
            run = release.run(*words, f"{model}.windows.png", folder=folder)
            expect(run.returncode == 0, f"{model}: {run.stderr.decode()}")
            subprocess.run([release.tool, *words, f"{model}.png", "--overwrite"], cwd=folder, check=True, capture_output=True, env=release.environment)
            expect(sha(folder / f"{model}.png") == sha(folder / f"{model}.windows.png"), f"{model}: another image on llvmpipe")
        (folder / "session.txt").write_text("0 do toggle interface\n0 do show checker\n0 wait\n0 do window FILE.png\n")
        for words in (["view", "room.gltf"], ["view", "rocks.png"]):
            seen = []
            for system in ("windows", "here"):
                (folder / f"{system}.txt").write_text((folder / "session.txt").read_text().replace("FILE", system))
                play = [*words, "--size", "200x150", "--play", f"{system}.txt", "--forget", "--overwrite", "--exposure", "1"]
                run = release.run(*play, folder=folder) if system == "windows" else subprocess.run([release.tool, *play], cwd=folder, capture_output=True, env=release.environment, check=False)
                expect(run.returncode == 0, f"{words} {system}: {run.stderr.decode()}")
                seen.append(sha(folder / f"{system}.png") if (folder / f"{system}.png").exists() else system)
            expect(seen[0] == seen[1], f"{words}: the window shows another image")
    finally:
        display.close()


IMAGES = ("exr", "tif", "hdr", "tga", "dds", "jpg", "ktx2", "png")


def imagesOfAllFormatsAreThoseOfThisSystem(release):
    folder = inputs(release, "images")
    for kind in IMAGES:
        sameHere(release, folder, ["map", "convert", "rocks.png", "--from", "opengl", "--to", "directx", "-o", f"x.{kind}"], f"x.{kind}")
        sameHere(release, folder, ["map", "convert", f"x.{kind}", "--from", "directx", "--to", "opengl", "-o", f"{kind}.png"], f"{kind}.png")
    for blocks, kind in (("bc5", "dds"), ("bc7", "ktx2"), ("uastc", "ktx2")):
        sameHere(release, folder, ["map", "convert", "rocks.png", "--from", "opengl", "--to", "opengl", "--compress", blocks, "-o", f"{blocks}.{kind}"], f"{blocks}.{kind}")
        sameHere(release, folder, ["map", "convert", f"{blocks}.{kind}", "--from", "opengl", "--to", "opengl", "-o", f"{blocks}.png"], f"{blocks}.png")


def texturesOfAstcAreThoseOfThisSystem(release):
    """The same bytes if both have one version of libastcenc. Another encodes otherwise, and since 4.7 rounds otherwise where
    it decodes: then both tools read both files alike to one of 255 steps, and they have lost the same but for a tenth."""
    folder, convert = inputs(release, "astc"), ["map", "convert", "--from", "opengl", "--to", "opengl"]
    if release.lacksAstc():
        run = release.run(*convert, "rocks.png", "--compress", "astc-6x6", "-o", "no.ktx2", folder=folder)
        expect(run.returncode == 3 and b"libastcenc" in run.stderr, run.stderr.decode())
        return print("ASTC is not compared: this release has none")
    for size in ("4x4", "6x6", "8x8"):
        run = release.run(*convert, "rocks.png", "--compress", f"astc-{size}", "-o", f"windows-{size}.ktx2", folder=folder)
        subprocess.run([release.tool, *convert, "rocks.png", "--compress", f"astc-{size}", "-o", f"here-{size}.ktx2"], cwd=folder, check=True, capture_output=True)
        expect(run.returncode == 0 and (folder / f"windows-{size}.ktx2").exists(), run.stderr.decode())
    versions = [re.search(rb"^astcenc (.*)", (release.programs / "libraries.txt").read_bytes(), re.MULTILINE)[1].decode(),
                subprocess.run(["dpkg-query", "-W", "-f=${Version}", "libastcenc-dev"], capture_output=True, text=True, check=False).stdout]
    print("libastcenc:", *versions)
    for size in ("4x4", "6x6", "8x8"):
        names = [f"{place}-{size}" for place in ("windows", "here")]
        for name in names:
            run = release.run(*convert, f"{name}.ktx2", "-o", f"{name}.png", folder=folder)
            subprocess.run([release.tool, *convert, f"{name}.ktx2", "-o", f"{name}-here.png"], cwd=folder, check=True, capture_output=True)
            expect(run.returncode == 0, run.stderr.decode())
            decoded = [png_pixels((folder / file).read_bytes()) for file in (f"{name}.png", f"{name}-here.png")]
            steps = max(abs(a - b) for a, b in zip(*decoded, strict=True))
            expect(steps <= (not versions[1].startswith(versions[0])), f"{name}: decoded otherwise by {steps} steps")
        lost = [json.loads(subprocess.run([release.tool, "map", "diff", "rocks.png", f"{name}.png", "--json", "-"], cwd=folder, capture_output=True, check=False).stdout)["angles"]["mean_degrees"] for name in names]
        same = sha(folder / f"{names[0]}.ktx2") == sha(folder / f"{names[1]}.ktx2")
        expect(same or (not versions[1].startswith(versions[0]) and abs(lost[0] / lost[1] - 1) < 0.1), f"astc-{size}: {versions}, degrees lost: {lost}")


def damagedFilesAreRefusedAsHere(release):
    """Cut, changed and stretched files of every format. Messages of OpenImageIO, whose version differs, may differ."""
    folder = inputs(release, "damaged")
    chance = random.Random(7)
    files = ["m.glb", "room.gltf", "low.ply", "painted.obj", "rocks.png"]
    for kind in IMAGES[:-1]:
        subprocess.run([release.tool, "map", "convert", "rocks.png", "--from", "opengl", "--to", "directx", "-o", f"x.{kind}"], cwd=folder, check=True, capture_output=True)
        files.append(f"x.{kind}")
    names = []
    for name in files:
        content = (folder / name).read_bytes()
        for kind in range(KINDS):
            names.append(f"bad{kind}-{name}")
            (folder / names[-1]).write_bytes(damaged(content, kind, chance))
        if name.endswith(("gltf", "obj")):
            names.append(f"text-{name}")
            (folder / names[-1]).write_text(breakText(content.decode(), chance))
    for name in names:
        refusedAsHere(release, folder, name)


def refusedAsHere(release, folder, name):
    """A file is refused as here: exit code, one line of error, no output; or read as here, and nothing is left over."""
    model = name.endswith(("glb", "gltf", "ply", "obj"))
    words = ["lint", name] if model else ["map", "convert", name, "--from", "opengl", "--to", "directx", "-o", f"{name}.png"]
    there = sameHere(release, folder, words, codeOnly=name.endswith(("exr", "tif", "hdr", "tga", "dds", "jpg")))
    errors = there.stderr.count(b"cotan: error: ")
    expect(errors == (there.returncode not in (0, 5)), f"{name}: {there.returncode}, {errors} errors: {there.stderr.decode()}")
    expect(model or (folder / f"{name}.png").exists() == (there.returncode == 0), f"{name}: an output of exit code {there.returncode}")
    expect(not list(folder.glob(".cotan-*")), f"{name}: unfinished files are left")


def bombsAreRefusedAsHere(release):
    """Small files that ask for much time or memory, of one seed."""
    sys.path.insert(0, str(HERE.parent / "fuzz"))
    import bombs
    for name in random.Random(11).sample(sorted(bombs.MAKERS), 12):
        folder = release.folder / name
        folder.mkdir()
        file = bombs.MAKERS[name](random.Random(f"{name} 11"), folder)
        start = time.monotonic()
        refusedAsHere(release, folder, file.name)
        expect(time.monotonic() - start < 120, f"{name}: {time.monotonic() - start:.0f} s")


def aBatchRunsAndKeepsItsResults(release):
    folder = inputs(release, "batch")
    jobs = [{"name": "one", "command": ["map", "convert", "rocks.png", "--from", "opengl", "--to", "directx", "-o", "ö.exr"]},
            {"name": "two", "command": ["map", "convert", "ö.exr", "--from", "directx", "--to", "opengl", "-o", "two.png"]},
            {"name": "late", "command": ["bake", "--high", "high.obj", "--low", "low.obj", "--size", "8192", "-o", "late.png"], "limit-time": 0.5},
            {"name": "large", "command": ["render", "room.gltf", "-o", "large.png"], "limit-memory": 30},
            {"name": "bad", "command": ["map", "info", "missing.png"]}]
    (folder / "jobs.jsonl").write_text("".join(json.dumps(job) + "\n" for job in jobs))
    words = ["batch", "jobs.jsonl", "--jobs", "2", "-o", "report.html", "--json", "r.json", "--overwrite"]
    states = {"one": "done", "two": "done", "late": "too slow", "large": "out of memory", "bad": "failed"}
    for kept in (False, True):
        run = release.run(*words, folder=folder)
        found = {job["name"]: job for job in json.loads((folder / "r.json").read_text())["jobs"]}
        expect(run.returncode == 2 and {name: job["state"] for name, job in found.items()} == states, f"{run.returncode} {run.stderr.decode()} {found}")
        expect(found["one"]["kept"] is kept and not found["late"]["kept"], "results: " + str({name: job["kept"] for name, job in found.items()}))
    expect((folder / "ö.exr").exists() and not list(folder.glob(".cotan-*")) and not list((folder / "report.store" / "work").glob("*/")), "files are left")
    (folder / "rocks.png").write_bytes((folder / "two.png").read_bytes() + b"changed")
    release.run(*words, folder=folder)
    found = {job["name"]: job for job in json.loads((folder / "r.json").read_text())["jobs"]}
    expect(not found["one"]["kept"], "an input has changed, and its job did not run")


def costsAreThoseOfThisSystem(release):
    """Counts, and the machine code of a card that Mesa's Radeon driver imagines: Wine's drivers read the variables of this
    system. A driver that crashes is not tried: Wine keeps its process."""
    if not shutil.which("Xvfb"):
        return expect(False, "Xvfb is missing (scripts/setup test)")
    folder, display = inputs(release, "cost"), Display(release.environment)
    try:
        release.environment.update({"RADV_FORCE_FAMILY": "NAVI21", "MESA_SHADER_CACHE_DISABLE": "true"})
        words = ["cost", "--no-timing", "--frames", "smooth-fused", "--device", "RADV", "--csv"]
        run = release.run(*words, "cost.csv", folder=folder)
        here = subprocess.run([release.tool, *words, "here.csv"], cwd=folder, env=release.environment, capture_output=True, check=False)
        expect((run.returncode, run.stderr) == (here.returncode, here.stderr), f"{run.returncode} {run.stderr.decode()} here {here.returncode} {here.stderr.decode()}")
        there, expected = ([line for line in (folder / name).read_text().splitlines() if "hash" not in line.lower()] for name in ("cost.csv", "here.csv"))
        expect(there == expected and len(there) > 30, f"{len(there)} lines; here {len(expected)}: {sorted(set(there) ^ set(expected))[:6]}")
        print("cost:", len(there), "lines, exit code", run.returncode)
        expect(re.match(rb"Machine: Windows \d+\.\d+\.\d+, x86_64\.", run.stdout), run.stdout.decode()[:200])
    finally:
        display.close()
    inside = release.run("price-for-parent", "1", folder=folder, program="cotan-lab.exe", stdin=subprocess.DEVNULL)
    expect(inside.returncode == 1 and b"is internal" in inside.stderr, inside.stderr.decode())


def outputsAreThoseOfThisSystem(release):
    """The tables of output_bytes.py, which hold what this system's tool makes. The arc cosine of angles in pictures of
    errors is that of Windows' C library: their last bits may differ. Targa files name another version of OpenImageIO:
    imagesOfAllFormatsAreThoseOfThisSystem compares the rest of them. Embree rounds otherwise, which bakes of 32 bits
    show. Nothing else may differ."""
    wrapper = release.folder / "wine-cotan"
    wrapper.write_text(f'#!/bin/sh\nexec wine "{release.programs}/cotan.exe" "$@"\n')
    wrapper.chmod(0o755)
    for table in ("maps", "meshes", "shader_text", "pictures"):
        run = subprocess.run([sys.executable, HERE / "output_bytes.py", wrapper, HERE / "output_bytes" / f"{table}.txt", "--where-built"], env=release.environment, capture_output=True, text=True, check=False)
        lines = run.stdout.split("\n")
        print(table, *[line for line in lines if " commands compared" in line])
        known = re.compile(r"error-|\.tga \(changed\)|bake-\w+\.exr \(changed\)")
        differing = [name for line in lines if line.startswith("    ") for name in line.split(",") if not known.search(name)]
        compared = int(next((line for line in lines if " commands compared" in line), "0").split()[0])
        expect(compared >= 10 and not differing, f"{table}: {run.stdout}{run.stderr}")


FACTS = (namesOfAllLettersAreReadAndWritten, backslashesDrivesAndLongNamesArePaths, namesOfDevicesAreNoFiles, anInputIsNeverReplaced,
         theReaderOfUntrustedFilesIsAChild, itNeedsNothingBesideIt, theLibraryDoesWhatItDoesHere, theWheelHasThatLibrary,
         theDeviceAndTheWindowShowWhatTheyShowHere, imagesOfAllFormatsAreThoseOfThisSystem, texturesOfAstcAreThoseOfThisSystem, damagedFilesAreRefusedAsHere, bombsAreRefusedAsHere, suggestedCommandsRunInTheShell,
         aBatchRunsAndKeepsItsResults, costsAreThoseOfThisSystem, outputsAreThoseOfThisSystem)
if __name__ == "__main__":
    if not shutil.which("wine"):
        print("skipped: wine is missing (scripts/setup doors)")
        sys.exit(77)
    chosen = [f for f in FACTS if f.__name__ in sys.argv[3:]] or FACTS
    for fact in chosen:
        with tempfile.TemporaryDirectory() as folder:
            release, before = Release(sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), folder), len(wrong)
            try:
                fact(release)
            finally:
                release.close()
        print("\n".join([f"{fact.__name__} {'fails' if wrong[before:] else 'holds'}", *wrong[before:]]), flush=True)
    sys.exit(bool(wrong))
