"""Mistakes drawn at random over all code: the work of `scripts/mutants --random N --seed S`."""
import collections
import concurrent.futures
import hashlib
import json
import pathlib
import random
import re
import shutil
import subprocess
import tempfile
import time

import mistakes
import plant
from plant import HOME, WORK

# Tests that may notice a mistake in a folder, the most likely first; `python:` and `c_api` run over the C library.
TESTS = {
    "apps/cotan": "words_test help_test cli_test command_line help_files:man help_files:words help_files:bash help_files:zsh help_files:fish output_bytes:maps output_bytes:meshes output_bytes:pictures map_command_test bake_command_test tangents_command_test judgement_command_test files_test batch_test batch_command_test",
    "apps/viewer": "viewer_test view_window_test",
    "bindings/js": "web",
    "bindings/python": "python:arrays python:bake python:maps python:models python:geometry python:render python:work python:json python:options python:package python:dask python:header",
    "shaders/cotan": "core_test tangents_test reference_test frame_table_test shader_text_test",
    "apps/lab": "figures_test accuracy_test cost_test report_test output_bytes:lab",
    "src/bake": "bake_test lint_test judgement_test convert_test auto_frame_test bake_command_test tangents_gltf_test python:bake",
    "src/c": "c_buffers_test c_facts c_api python:geometry python:maps python:bake python:models python:render python:options",
    "src/core": "core_test tangents_test loops_test map_test geometry_test bake_test",
    "src/files": "files_test sandbox_test report_test assimp_test map_command_test",
    "src/gltf": "gltf_test gltf_bad_test gltf_edit_test gltf_models_test tangents_gltf_test convert_test",
    "src/image": "image_test map_test gltf_test",
    "src/inspect": "viewer_test draw_test bake_command_test report_test",
    "src/maps": "map_test map_command_test",
    "src/model": "obj_test assimp_test gltf_test models_test",
    "src/picture": "words_test command_line viewer_test cli_test environment_test models_test",
    "src/render": "reference_test draw_test render_test figures_test output_bytes:pictures two_renderers",
    "src/scene": "geometry_test shapes_test gltf_test reference_test environment_test",
    "src/shader_text": "shader_text_test frame_table_test",
}
ENDINGS = (".cpp", ".hpp", ".h", ".py", ".js")
BROKEN = WORK / "not_compiling.txt"  # so that later runs over the same sources skip them
EQUIVALENT = HOME / "tests/mutation/equivalent.txt"
BAR = 0.85
# Tests that reach many folders: tried after those above, the fastest first.
OTHERS = """defaults_test accuracy_test geometry_test assimp_test obj_test bake_test batch_test c_buffers_test cli_test convert_test core_test cost_test draw_test
environment_test figures_test files_test frame_table_test gltf_bad_test gltf_edit_test gltf_models_test gltf_test help_test image_test
judgement_command_test judgement_test auto_frame_test lint_test map_command_test map_test models_test reference_test
render_test report_test sandbox_test shader_text_test shapes_test tangents_command_test tangents_gltf_test tangents_test viewer_test
words_test bake_command_test batch_command_test c_facts c_api command_line output_bytes:maps output_bytes:meshes output_bytes:pictures output_bytes:lab
output_bytes:shader_text json_fields python:arrays python:bake python:geometry
python:dask python:json python:maps python:models python:options python:package python:render python:types python:work view_window_test
option_effects:map option_effects:render option_effects:compare
option_effects:bake option_effects:convert option_effects:others two_renderers file_fields""".split()
MOST_OF_A_FILE = 6  # mistakes per file, so that none hides in the text of another


class Drawn:
    def __init__(self, seed, file, text, mistake):
        self.seed, self.file, self.mistake = seed, file, mistake
        self.part = "/".join(file.split("/")[:2])
        self.right = text[mistake.start:mistake.end]
        self.line = text.count("\n", 0, mistake.start) + 1
        self.script = file.endswith((".py", ".js"))
        words = lambda s: " ".join(s.split())
        self.said = f"{file}:{self.line}: {mistake.kind}: {words(self.right)[:100]} => {words(mistake.wrong)[:100]}"
        self.key = f"{hashlib.sha256(text.encode()).hexdigest()[:16]} {mistake.start} {mistake.kind} {words(mistake.wrong)}"
        source = text.split("\n")[self.line - 1]
        self.place = f"{file}: {words(source)[:160]}: {words(mistake.wrong)[:100]}"

    def meets(self, other):
        here, there = self.mistake, other.mistake
        return self.file == other.file and here.start < there.end + 1 and there.start < here.end + 1

    def planted(self):
        n, m = self.number, self.mistake
        if m.kind == "early return":
            return f"if (cotan_mutant({n})) {m.wrong} "
        if m.kind == "guard":
            return f"!cotan_mutant({n}) && ({self.right})"
        if m.statement:
            return f"{{ if (cotan_mutant({n})) {{ {m.wrong} }} else {{ {self.right} }} }}"
        return f"(cotan_mutant({n}) ? ({m.wrong}) : ({self.right}))"


def draw(count, seed, parts):
    """Draws lines uniformly from the code of `parts`, and for each a kind of mistake uniformly; none overlap."""
    unbuilt = re.compile(r"/no_\w+\.cpp$")  # used if a library is missing; scripts/try-optional builds them
    names = subprocess.run(["git", "-C", HOME, "ls-files", "src", "apps", "shaders/cotan", "bindings"], check=True,
                           capture_output=True, text=True).stdout.split()
    texts = {n: (HOME / n).read_text() for n in sorted(names) if n.endswith(ENDINGS) and not unbuilt.search(n) and "/".join(n.split("/")[:2]) in parts}
    lines = [(name, i + 1) for name, text in texts.items() for i in range(text.count("\n"))]
    dice, drawn, found, used = random.Random(seed), [], {}, collections.defaultdict(list)
    for name, line in dice.sample(lines, len(lines)):
        if len(drawn) == count:
            break
        if name not in found:
            found[name] = collections.defaultdict(list)
            for m in mistakes.mistakes_in(texts[name], script=name.endswith((".py", ".js"))):
                found[name][texts[name].count("\n", 0, m.start) + 1].append(m)
        here = found[name].get(line, [])
        if not here or len(used[name]) == MOST_OF_A_FILE:
            continue
        kind = dice.choice(sorted({m.kind for m in here}))
        mistake = dice.choice([m for m in here if m.kind == kind])
        if any(mistake.start < end + 1 and start < mistake.end + 1 for start, end in used[name]):
            continue
        used[name].append((mistake.start, mistake.end))
        drawn.append(Drawn(seed, name, texts[name], mistake))
    return drawn, texts


def planted_texts(drawn, texts):
    """For each changed file: the text with its mistakes, and the lines of each mistake in it."""
    changed, by_file = {}, collections.defaultdict(list)
    for d in drawn:
        if not d.script:
            by_file[d.file].append(d)
    for file, here in by_file.items():
        text, done, at, spans = "", 0, 1, {}
        for d in sorted(here, key=lambda d: d.mistake.start):
            text += texts[file][done:d.mistake.start]
            first = text.count("\n") + 1
            text += d.planted()
            spans[d.number] = range(first, text.count("\n") + 2)
            done = d.mistake.start if d.mistake.kind == "early return" else d.mistake.end
        changed[file] = (text + texts[file][done:], spans)
    return changed


COMPLAINT = re.compile(r"/(source|portable)/([^\s:]+):(\d+):\d+:\s+([^\n]*)")


def those_that_do_not_compile(output, changed):
    """Mistakes on lines that the compiler rejects; if it names none of them, all in the files that it names."""
    bad, files = set(), set()
    for block in re.split(r"\nFAILED: ", "\n" + output)[1:]:
        errors, mentioned, named = set(), set(), set()
        for root, file, line, what in COMPLAINT.findall(block):
            name = file if root == "source" else f"shaders/{file}"
            if name not in changed:
                continue
            named.add(name)
            at = int(line) - (0 if name.startswith("shaders/cotan/") else 1)
            here = {n for n, span in changed[name][1].items() if at in span}
            mentioned |= here
            if "error" in what:
                errors |= here
        bad |= errors or mentioned
        for name in set(re.findall(r"in function `.*?(\w+)\(", block)):  # uses a template without an instance
            errors |= within_function(name, changed)
        bad |= errors
        if not mentioned and not errors:  # errors in a header of fmt name the file only as the includer
            files |= named or {name for name in changed if f"/source/{name}" in block}
    return bad | {n for file in files for n in changed[file][1]}


def within_function(name, changed):
    """Mistakes in functions called `name`, which begin and end at column 0."""
    bad = set()
    for text, spans in changed.values():
        inside = False
        for at, line in enumerate(text.split("\n"), 1):
            inside = bool(re.match(rf"\w.*\b{name}\(", line)) or (inside and not re.match(r"\w|}", line))
            bad |= {n for n, span in spans.items() if inside and at in span}
    return bad


def check_headers(changed, jobs):
    """Compiler output for each changed header on its own, before all files that include it are compiled."""
    commands = {}
    for entry in json.loads((plant.BUILD / "compile_commands.json").read_text()):
        part = re.search(r"/(src|apps)/(\w+)/", entry["output"] if "output" in entry else entry["file"])
        if part:
            commands.setdefault(part[0].strip("/"), entry)

    def check(name):
        entry = commands.get("/".join(name.split("/")[:2]), commands["src/render"])
        words = entry["command"].split()
        words = words[1 if "ccache" in words[0] else 0:words.index("-o")]
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "header.cpp"
            file.write_text(f'#include "{plant.SOURCE / name}"\n')
            done = subprocess.run([*words, "-fsyntax-only", str(file)], cwd=entry["directory"], capture_output=True, text=True)
        return f"\nFAILED: {name}\n{done.stderr}" if done.returncode else ""

    headers = [name for name in changed if name.endswith((".hpp", ".h")) and not name.startswith("shaders/cotan/")]
    if any(name.startswith("shaders/cotan/") for name in changed):
        headers.append("src/core/include/cotan/portable.hpp")
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        return "".join(pool.map(check, headers))


def build_what_compiles(drawn, texts, targets, jobs):
    """Builds without the mistakes that do not compile; returns those that are built in, and the others."""
    known = set(BROKEN.read_text().split("\n")) if BROKEN.exists() else set()
    outside = [d for d in drawn if d.key in known]
    inside, headers_checked = [d for d in drawn if d.key not in known], bool(outside)
    for _ in range(20):
        changed = planted_texts(inside, texts)
        plant.copy_sources({name: text for name, (text, _) in changed.items()})
        plant.configure()
        output = "" if headers_checked else check_headers(changed, jobs)
        headers_checked = True
        if not output:
            code, output = plant.build(targets, jobs, go_on=True)
            if code == 0:
                return inside, outside
        (WORK / "build.txt").write_text(output)
        bad = those_that_do_not_compile(output, changed)
        print(f"{len(bad)} mistakes do not compile", flush=True)
        if not bad:
            raise SystemExit(f"mutants: the build fails, not by a mistake: {WORK / 'build.txt'}")
        outside += [d for d in inside if d.number in bad]
        BROKEN.write_text("\n".join(sorted(known | {d.key for d in outside})))
        inside = [d for d in inside if d.number not in bad]
    raise SystemExit("mutants: the build fails again and again")


class Web:
    """The npm package, assembled anew for each mistake; its modules are built once."""

    CASES = ("package_test.mjs", "gltf_transform_test.mjs", "three_test.mjs")

    def __init__(self):
        self.modules = HOME / "build/dev/web"
        self.npm = HOME / "build/dev/npm/node_modules"

    def missing(self):
        return not (list(self.modules.glob("npm/*.tgz")) and self.npm.exists())

    def run(self, drawn, texts, limit):
        with tempfile.TemporaryDirectory() as folder:
            place = pathlib.Path(folder)
            shutil.copytree(HOME / "bindings/js", place / "js")
            if drawn:
                target = place / "js" / drawn.file[len("bindings/js/"):]
                m = drawn.mistake
                target.write_text(texts[drawn.file][:m.start] + m.wrong + texts[drawn.file][m.end:])
            (place / "npm").mkdir()
            (place / "npm/node_modules").symlink_to(self.npm)
            tarball = next(self.modules.glob("npm/*.tgz"))
            version = tarball.name[len("cotan-"):-len(".tgz")]
            spent = 0.0
            outcome, took = plant.run("", 0, limit, command=["node", place / "js/build.mjs", self.modules, place / "web/npm", version])
            for case in self.CASES:
                if outcome or spent >= limit:
                    break
                arguments = [plant.library()] if case == self.CASES[0] else [self.npm]
                outcome, took = plant.run("", 0, limit, command=["node", "--expose-gc", HOME / "tests/web" / case, place / "web/npm" / tarball.name,
                                                                  *arguments])
                spent += took
            return outcome and f"{case}: {outcome}", spent


def try_python(drawn, texts, programs, limit):
    with tempfile.TemporaryDirectory() as folder:
        python = pathlib.Path(folder) / "python"
        shutil.copytree(HOME / "bindings/python", python)
        m, target = drawn.mistake, python / drawn.file[len("bindings/python/"):]
        wrong = "pass" if m.statement else m.wrong
        target.write_text(texts[drawn.file][:m.start] + wrong + texts[drawn.file][m.end:])
        return plant.try_mistake(0, programs, limit, python)


class Reach:
    """The tests that reach each mistake, by running each program without a mistake: only those tests can notice it."""

    def __init__(self, programs, jobs):
        self.tests, self.seconds, self.failing, longest = {}, {}, set(), 60
        with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
            for program, (tests, took, outcome) in zip(programs, pool.map(lambda p: plant.reach(p, longest), programs)):
                # Scales the tests' times to the CPU time of the program: on a busy machine the clock runs longer.
                clock = sum(s for _, s, _ in tests)
                scale = min(1, took / clock) if clock > 0 else 1
                self.tests[program], self.seconds[program] = [(name, s * scale, here) for name, s, here in tests], took
                if outcome:
                    self.failing.add(program)
                passed = f"{sum(not name.endswith('.*') for name, _, _ in tests)} tests in {took:.1f} s"
                print(f"{program}: {passed}{f', without a mistake: {outcome}' if outcome else ''}", flush=True)

    def programs(self, part, number, seconds):
        """Each program with the tests that reach a mistake, and its limit. The fastest tests come first, up to a third
        of the time. For scripts (number None) the programs of the part."""
        near, found = TESTS[part].split(), []
        for program in self.tests:
            here = [t for t in self.tests[program] if number in t[2]] if number else self.tests[program]
            if not here or not number and program not in near:
                continue
            chosen, took = [], 0.0
            for name, s, _ in sorted(here, key=lambda t: t[1]):
                if chosen and took + s > seconds / 3:
                    break
                chosen.append(name)
                took += s
            every = program not in self.failing and len(chosen) == len(self.tests[program]) or not here[0][0]
            word = program if every else program + ":" + ":".join(chosen)
            rank = near.index(program) if program in near else len(near)
            found.append((rank, took, word, 3 * min(self.seconds[program], took + 1) + 10))
        return [(word, most) for rank, took, word, most in sorted(found) if took < seconds]


def equivalents():
    """For each place: the reason why a mistake there has no visible effect."""
    if not EQUIVALENT.exists():
        return {}
    pairs = [line.rsplit(" -- ", 1) for line in EQUIVALENT.read_text().splitlines() if line.strip() and not line.startswith("#")]
    return {place.strip(): why for place, why in pairs}


def stale_equivalents():
    """The places whose line is no longer in its file."""
    stale = []
    for place in equivalents():
        file, _, mistake = place.partition(": ")
        lines = (HOME / file).read_text().splitlines() if (HOME / file).is_file() else []
        lines = [" ".join(line.split())[:160] for line in lines]
        if not any(len(line) > 3 and mistake.startswith(line + ": ") for line in lines):
            stale.append(place)
    return stale


def report(results, outside, known, seed):
    parts = sorted({d.part for d, _ in results} | {d.part for d in outside})
    count = lambda which: collections.Counter(d.part for d in which)
    noticed = count(d for d, outcome in results if outcome)
    same = count(d for d, outcome in results if not outcome and d.place in known)
    unnoticed = count(d for d, outcome in results if not outcome and d.place not in known)
    left_out = count(outside)
    print(f"\nseed {seed}\n{'part':<18}{'noticed':>8}{'unnoticed':>11}{'equivalent':>12}{'not compiling':>15}")
    for part in parts:
        print(f"{part:<18}{noticed[part]:>8}{unnoticed[part]:>11}{same[part]:>12}{left_out[part]:>15}")
    seen, missed = noticed.total(), unnoticed.total()
    print(f"{'all':<18}{seen:>8}{missed:>11}{same.total():>12}{left_out.total():>15}   {100 * seen / max(1, seen + missed):.0f} % noticed")
    return seen >= BAR * (seen + missed) and seen + missed > 0


def main(count, seed, beside, jobs, seconds, only, again):
    for part in only:
        if part not in TESTS:
            raise SystemExit(f"mutants: expected a folder ({', '.join(TESTS)}); found '{part}'")
    web, wanted = Web(), set(only or TESTS)
    if "bindings/js" in wanted and web.missing():
        print("bindings/js is left out: the npm package is not built (ctest --preset dev -R web_package)")
        wanted.remove("bindings/js")
    drawn = []
    for s in sorted({seed, *beside}, reverse=True):  # about a third does not compile
        more, texts = draw(count + count // 2, s, wanted)
        drawn += [d for d in more if not any(d.meets(other) for other in drawn)]
    for number, d in enumerate(drawn):
        d.number = number + 1
    parts = sorted({d.part for d in drawn})
    programs = [p for p in dict.fromkeys(" ".join(TESTS[part] for part in parts).split() + OTHERS) if p != "web"]
    targets = set().union(*map(plant.targets_of, programs)) | {"cotan_c", "cotan"}
    inside, outside = build_what_compiles(drawn, texts, targets, jobs)
    inside = [d for d in inside if d.seed == seed][:count]
    outside = [d for d in outside if d.seed == seed and d.number <= inside[-1].number]
    reach = Reach(programs, jobs)
    table, before = WORK / f"random-{seed}.tsv", {}
    if again:
        before = {row[3]: row[1] for row in (line.split("\t") for line in table.read_text().splitlines())}

    def judge(d):
        if before.get(d.place, "UNNOTICED") not in ("UNNOTICED", "equivalent"):
            return d, before[d.place], 0.0
        if d.part == "bindings/js":
            return d, *web.run(d, texts, 3 * seconds)
        chosen = reach.programs(d.part, None if d.script else d.number, seconds)
        if d.script:
            return d, *try_python(d, texts, chosen, seconds)
        return d, *plant.try_mistake(d.number, chosen, seconds)

    results, known, start = [], equivalents(), time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool, open(table, "w") as written:
        for d, outcome, took in pool.map(judge, inside):
            results.append((d, outcome))
            word = outcome or ("equivalent" if d.place in known else "UNNOTICED")
            reached = "" if d.script or reach.programs(d.part, d.number, 1e9) else " (no test comes to it)"
            print(d.number, word, f"{took:.1f}", d.place, d.said, sep="\t", file=written, flush=True)
            if word == "UNNOTICED":
                print(f"unnoticed{reached}: {d.said}", flush=True)
            if len(results) % 50 == 0:
                print(f"{len(results)} of {len(inside)} tried in {time.monotonic() - start:.0f} s", flush=True)
    return report(results, outside, known, seed)
