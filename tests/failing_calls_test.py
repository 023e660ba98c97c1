#!/usr/bin/env python3
"""If any call on a file fails, a command writes what it always writes, or prints one line and leaves nothing.

failing_calls_test.py TOOL [COMMAND LINE]

The library failing_calls.c beside this file is preloaded into the tool. Each command first runs without a fault, which
lists its calls on files of its folder: open, read, write, rename and so on. Then it runs once for each of these calls,
and that call fails. Of many equal calls in a row, such as the 200 writes of an EXR, only the first and last two and
each sixteenth fail. A process that the command starts counts its own calls, and fails at the same number. Last, each
format is written with file sizes limited to 512 bytes, which looks to a program like a full disk."""
import concurrent.futures
import itertools
import os
import pathlib
import resource
import shutil
import subprocess
import sys
import tempfile

from output_bytes import SKIPPED, TEXTS, steady
from output_inputs import make_inputs

COMMANDS = """
render panel.gltf --device reference --size 16x12 --ground off -o out.png
render painted.obj --device reference --size 16x12 --view normal -o out.png
render room.gltf --device reference --size 16x12 --view normal --json report.json -o out.tif
render --shape plane --device reference --size 16x12 --environment sky.hdr -o out.png
compare panel.gltf --device reference --size 16x12 --ground off --frames cotangent,smooth -o out
bake --high high.obj --low low.obj --cage cage.obj --size 8 --mask mask-out.png -o out.png
lint room.gltf --json report.json
convert panel.gltf --from-frame mikktspace --to-frame smooth -o out.glb
convert panel.gltf --from-frame mikktspace --to-frame smooth -o out.gltf
tangents plain.gltf -o out.glb
map convert rocks.png --from gltf --to directx -o out.png
map convert rocks.png --from gltf --to directx -o out.jpg
map from-height height.png -o out.exr
map mips grain.png -o out.dds
map mips grain.png -o out.png
"""
MOST_CALLS = 400
FORMATS = ["png", "tga", "jpg", "tif", "exr", "hdr", "dds", "ktx2"]  # of maps; GIF and WebP hold several images
MOST_BYTES = 512


def run(tool, library, inputs, words, call):
    """Exit code, errors, new files of the folder by name, and the names of all calls."""
    with tempfile.TemporaryDirectory() as name:
        folder, log = pathlib.Path(name) / "here", pathlib.Path(name) / "log"
        shutil.copytree(inputs, folder)
        before = {p: p.read_bytes() for p in folder.rglob("*") if p.is_file()}
        environment = {**os.environ, "LD_PRELOAD": library, "COTAN_FAIL_FOLDER": str(folder), "COTAN_FAIL_CALL": str(call), "COTAN_FAIL_LOG": str(log)}
        done = subprocess.run([tool, *words], cwd=folder, env=environment, capture_output=True, text=True, timeout=120, check=False)
        lost = [p.name for p, data in before.items() if not p.is_file() or p.read_bytes() != data]
        new = {}
        for path in sorted(p for p in folder.rglob("*") if p.is_file() and p not in before):
            new[str(path.relative_to(folder))] = steady(path.read_text(errors="replace")) if path.suffix in TEXTS else path.read_bytes()
        calls = max((line.split() for line in log.read_text().splitlines()), key=len, default=[]) if log.exists() else []
        return done.returncode, done.stderr, new, calls, lost


def tried_of(calls):
    """Numbers, from 1, of the calls that are made to fail."""
    begin = 1
    for _, equal in itertools.groupby(calls):
        count = len(list(equal))
        yield from (begin + i for i in range(count) if i < 2 or i >= count - 2 or i % 16 == 0)
        begin += count


def judge(line, call, outcome, usual):
    code, errors, new, _, lost = outcome
    said = [text for text in errors.splitlines() if text.startswith("cotan: error: ")]
    where = f"{line}, call {call}: "
    if lost:
        return f"{where}changed inputs {lost}"
    if code == 0:
        return "" if new == usual else f"{where}exit code 0, but other outputs: {sorted(new)}"
    if code not in (2, 3, 4) or len(said) != 1:
        return f"{where}exit code {code}, said: {errors.strip()}"
    if "report.json" in said[0]:  # the result is complete; only its report is missing
        new = {name: data for name, data in new.items() if data != usual[name]}
    return f"{where}exit code {code}, left {sorted(new)}" if new else ""


def without_room(tool, inputs, line):
    """What is wrong with a command that may write no file larger than 512 bytes."""
    def limit():
        resource.setrlimit(resource.RLIMIT_FSIZE, (MOST_BYTES, MOST_BYTES))
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name) / "here"
        shutil.copytree(inputs, folder)
        before = set(folder.rglob("*"))
        done = subprocess.run([tool, *line.split()], cwd=folder, capture_output=True, text=True, timeout=120, check=False, preexec_fn=limit)
        new = [p.name for p in folder.rglob("*") if p not in before]
        if done.returncode != 4 or done.stderr.count("cotan: error: ") != 1 or "no space left" not in done.stderr or done.stdout or new:
            return [f"{line}, of 512 bytes: exit code {done.returncode}, left {new}, said: {done.stdout}{done.stderr}".strip()]
    return []


def main(tool, only):
    lines = [only] if only else COMMANDS.split("\n")[1:-1]
    compiler = shutil.which("cc") or shutil.which("gcc")
    if not compiler:
        print("skipped: no C compiler for failing_calls.c")
        return SKIPPED
    wrong, tried, refused = [], 0, 0
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        library, inputs = str(pathlib.Path(name) / "failing_calls.so"), pathlib.Path(name) / "inputs"
        subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-o", library, str(pathlib.Path(__file__).parent / "failing_calls.c"), "-ldl"],
                       check=True)
        inputs.mkdir()
        make_inputs(inputs)
        for line in lines:
            code, errors, usual, calls, _ = run(tool, library, inputs, line.split(), 0)
            if code or not 3 <= len(calls) <= MOST_CALLS:
                wrong.append(f"{line}: exit code {code}, {len(calls)} calls: {errors}")
                continue
            numbers = list(tried_of(calls))
            outcomes = list(pool.map(lambda call: run(tool, library, inputs, line.split(), call), numbers))
            found = [text for call, outcome in zip(numbers, outcomes) if (text := judge(line, call, outcome, usual))]
            tried += len(numbers)
            refused += sum(outcome[0] != 0 for outcome in outcomes)
            wrong += found
        for ending in FORMATS if not only else []:
            wrong += without_room(tool, inputs, f"map convert rocks.png --from gltf --to directx -o out.{ending}")
        for ending in ("gif", "webp") if not only else []:
            wrong += without_room(tool, inputs, f"render room.gltf --turntable 2 --size 64 --device reference -o out.{ending}")
    print(*wrong, sep="\n", end="\n" if wrong else "")
    print(f"{tried} calls failed, {refused} runs said so, {len(wrong)} wrong")
    return 1 if wrong or refused < tried / 2 else 0


if __name__ == "__main__":
    sys.exit(main(str(pathlib.Path(sys.argv[1]).resolve()), " ".join(sys.argv[2:])))
