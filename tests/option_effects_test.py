#!/usr/bin/env python3
"""Each option of each command changes the result, and each of its words differently.

  option_effects_test.py TOOL COMMAND    (map with its subcommands; `others`: commands without a separate test)

The options are those that --help lists, and their words those that the tool names when it refuses a wrong one, so new
options and words must be tried here, too. For each option, a command runs without it and with each of its words: any two
runs must write different files or, if they write none, print different text. Words that another option of the line
excludes must be refused.
"""
import itertools
import json
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile

from output_bytes import SKIPPED, TEXTS, steady
from output_inputs import make_inputs

WITH_GROUND = "render room.gltf --device reference --size 48x30 -o out.png"
RENDER = WITH_GROUND + " --ground off"  # the ground's shadow is half of the time
COMPARE_WITH_GROUND = "compare room.gltf --device reference --size 40x25 --frames cotangent,smooth -o out"
COMPARE = COMPARE_WITH_GROUND + " --ground off"
BAKE = "bake --high high.obj --low low.obj --size 24x24 -o out.png"
SHADER = "shader --lang glsl --frame cotangent"

# Command lines with the options that are tried on each. `|` separates the words of an option; `*` stands for the words that
# the tool names. Prefixes of words: `~` the default; `=` changes nothing, since it only affects how the work is done; `!` is
# refused here; `&` words with equal results: paper-transpose is paper-nodet with other rounding, invisible here; a kernel of
# three texels reads one texel beyond the border, where clamp and mirror agree; and a map that fits the new frame as well as
# a converted one is kept. A flag has no words.
CASES = [
    (RENDER, {
        "--size": "40x30 | thumbnail", "--view": "~shaded | !mask | *", "--up": "~y | *", "--exposure": "~auto | 0.3 | 2",
        "--camera": "~front | left | right | top | bottom | back | fit | 0 | 1 | orbit:40,20 | 1,2,4,0,0.2,0 | 1,2,4,0,0.2,0,20 | 1,2,4,0,0.2,0,h3",
        "--normal-map": "as-directx.png | rough.png", "--base-color": "rocks.png | rough.png", "--metallic-roughness": "rocks.png | mask.png",
        "--occlusion": "rocks.png | mask.png", "--height-map": "height.png | mask.png", "--variant": "cloth | sign", "--turntable": "2 | 3", "--environment": "~studio | sky.hdr | *",
        "--environment-rotation": "40 | 200", "--environment-intensity": "0.5 | 3", "--shading": "~pbr | *",
        "--samples": "~4 | 1 | 16", "--tone-mapping": "~neutral | *", "--specular-antialiasing": "", "--edges": "~none | *",
        "--no-normal-maps": "", "--point-sampled": "", "--memory": "=800",
        "--threads": "=1 | =3", "--list-frames": ""}),
    (RENDER + " --normal-map rocks.png", {"--convention": "~gltf,exact | gltf | directx | slope", "--material": "~-1 | 0 | 1"}),
    (RENDER + " --height-map height.png", {"--height-depth": "0.05 | 0.2", "--material": "~-1 | 0 | 1"}),
    (RENDER + " --view mask --mask mask.png", {"--mask": "rocks.png | rough.png", "--material": "~-1 | 0 | 1"}),
    (RENDER + " --animation turn --time 0.6", {"--animation": "bend | ~0 | ~turn", "--time": "0.2 | 0.9 | ~0.6"}),
    (RENDER + " --animation turn", {"--frames": "0..1 | 1..3 | 0..3"}),
    (WITH_GROUND, {"--ground": "~on | *"}),
    (WITH_GROUND + " --environment evening", {"--background": "~blur | *", "--no-shadows": ""}),
    (RENDER + " --frame vertex", {"--tangents": "~stored | *"}),
    ("render room.gltf --device reference --size 48x30 --view normal --ground off -o out.exr", {"--frame": "~auto | ~orthonormal | &paper-nodet,paper-transpose | *"}),
    ("render room.gltf --device reference --size 48x30 --view normal --ground off -o out.exr", {"--max-degrees": "~0.3 | 0.000001"}),
    ("render plain.gltf --size 48x30 -o out.png", {"--shadow-softness": "0 | 30 | 60", "--device": "reference"}),
    ("render --device reference --size 48x30 -o out.png --normal-map rocks.png --shape plane", {"--shape": "~plane | *"}),
    ("render panel.gltf --device reference --size 16x10 --turntable 2 -o out.webp", {"--rate": "~24 | 5 | 7"}),
    (COMPARE, {
        "--frames": "cotangent,exact | exact,smooth", "--size": "30x20", "--camera": "~front | left | 1", "--up": "~y | *", "--exposure": "~auto | 2",
        "--normal-map": "as-directx.png", "--base-color": "rocks.png", "--metallic-roughness": "rocks.png", "--occlusion": "rocks.png",
        "--height-map": "height.png", "--variant": "cloth | sign", "--environment": "~studio | *", "--environment-rotation": "40", "--environment-intensity": "3",
        "--shading": "~pbr | *", "--samples": "~4 | 1", "--tone-mapping": "~neutral | *", "--specular-antialiasing": "",
        "--edges": "~none | *", "--no-normal-maps": "", "--point-sampled": "",
        "--memory": "=800", "--threads": "=1 | =3", "--list-frames": ""}),
    (COMPARE + " --normal-map rocks.png", {"--convention": "~gltf,exact | gltf | directx", "--material": "~-1 | 1"}),
    (COMPARE + " --height-map height.png", {"--height-depth": "0.05 | 0.2"}),
    (COMPARE + " --animation turn --time 0.6", {"--animation": "bend | ~turn", "--time": "0.2 | 0.9"}),
    (COMPARE_WITH_GROUND, {"--ground": "~on | *"}),
    (COMPARE_WITH_GROUND + " --environment evening", {"--background": "~blur | *", "--no-shadows": ""}),
    ("compare room.gltf --device reference --size 40x25 --frames auto,exact -o out", {"--max-degrees": "~0.3 | 0.000001"}),
    ("compare room.gltf --device reference --size 40x25 --frames vertex,exact -o out", {"--tangents": "~stored | *"}),
    ("compare plain.gltf --size 48x30 --frames cotangent,smooth -o out", {"--shadow-softness": "0 | 30", "--device": "reference"}),
    ("compare --device reference --size 48x30 --frames cotangent,smooth -o out --normal-map rocks.png --shape plane", {"--shape": "~plane | *"}),
    ("lint room.gltf", {"--normal-map": "grain.png | as-directx.png", "--details": "", "--limit": "0.01 | 80", "--memory": "=800"}),
    ("lint room.gltf", {"--max-degrees": "~0.3 | 0.000001"}),
    ("lint room.gltf --details", {"--distance": "2 | 20"}),
    ("lint low.ply", {"--up": "~y | =z"}), # no figure depends on the orientation
    ("lint room.gltf --normal-map rocks.png", {"--convention": "~gltf,exact | gltf | directx", "--material": "~-1 | 1"}),
    ("lint room.gltf --limit 0.01", {"--frame": "~orthonormal | *"}),
    ("lint room.gltf", {"--strict": "!"}),
    ("lint mirrored.obj", {"--limit-area": "20 | 80"}),
    ("map info rocks.png height.png", {"--memory": "=800", "--threads": "=1 | =3"}),
    ("map detect rocks.png as-directx.png", {"--memory": "=800", "--threads": "=1 | =3"}),
    ("map convert rocks.png --from gltf --to directx -o out.png", {
        "--from": "~biased | slope | opengl", "--to": "gltf | directx,biased | directx,xy | directx,slope | directx,stereographic | !directx,signed",
        "--bits": "~auto | ~8 | 16", "--normalise": "", "--strength": "~1 | 0.5 | -1", "--threads": "=1 | =3", "--memory": "=800",
        "--list-frames": ""}),
    ("map convert rocks.png --from gltf --to directx -o out.exr", {"--bits": "~auto | ~float | !8 | !16 | *"}),
    ("map convert rocks.png --from gltf --to directx --strength 0.5 -o out.png", {"--dither": ""}),
    ("map convert rocks.png --from gltf --to directx -o out.ktx2", {"--compress": "~none | *", "--mips": ""}),
    ("map convert rocks.png --from gltf --to directx,xy -o out.ktx2", {"--swizzle": "~auto | ~rg | &ra,rrrg | *"}),
    ("map convert rocks.png --from gltf --to directx,xy --for mobile -o out.ktx2 --max-degrees 0.5", {"--max-degrees": "2 | 0.3", "--for": "desktop | ~mobile | !web"}),
    ("map convert rocks.png --from gltf --to object --mesh panel.gltf -o out.png", {"--mesh": "high.obj | room.gltf", "--frame": "~smooth | &paper-nodet,paper-transpose | &mikktspace,area-weighted | !cotangent-2013 | !nonperspective | !paper-orthogonal | *"}),
    ("map convert rocks.png --from gltf --to object --mesh room.gltf -o out.png", {"--material": "~-1 | 0 | 1"}),
    ("map convert rocks.png --from gltf --to object --mesh panel.gltf --frame vertex -o out.png", {"--tangents": "~stored | *"}),
    ("map convert rocks.png --from gltf --to object --mesh low.ply -o out.png", {"--up": "~y | *"}),
    ("map diff rocks.png as-directx.png --from gltf --to gltf -o out.png", {"--from": "directx | slope", "--to": "directx | slope", "--mask": "mask.png", "--threads": "=1 | =3",
                                                    "--memory": "=800"}),
    ("map from-height height.png -o out.png", {
        "--kernel": "*", "--wrap": "~repeat | &clamp,mirror | *", "--strength": "~1 | 2 | -1", "--to": "~gltf,exact | gltf | directx | slope | xy",
        "--bits": "~auto | ~16 | !half | !float | *",
        "--threads": "=1 | =3", "--memory": "=800"}),
    ("map from-height height.png --bits 8 -o out.png", {"--dither": ""}),
    ("map from-height height.png --range 0.1 --metres 3 -o out.png", {"--metres": "2 | 2x1", "--range": "0.4 | 0.2"}),
    ("map to-height rocks.png --from gltf -o out.exr", {"--from": "opengl | directx | ~biased", "--kernel": "*", "--metres": "2 | 2x3", "--free": "",
                                                       "--bits": "~auto | ~float | !8 | !16 | *", "--threads": "=1 | =3", "--memory": "=800"}),
    ("map blend rocks.png grain.png --from gltf --to gltf -o out.png", {
        "--from": "opengl | directx | slope", "--detail-from": "~gltf | directx | slope", "--to": "directx | slope", "--mode": "*",
        "--strength": "~1 | 0.5 | -1", "--mask": "mask.png | rough.png", "--tiles": "~1 | 2 | 2x3", "--bits": "~8 | 16", "--dither": "",
        "--threads": "=1 | =3", "--memory": "=800"}),
    ("map mips rocks.png --from gltf --to gltf -o out.dds", {
        "--from": "opengl | directx | slope", "--to": "directx", "--model": "*", "--roughness": "0.2 | 0.8",
        "--threads": "=1 | =3", "--memory": "=800"}),
    ("map mips rocks.png --from gltf --to gltf -o out.ktx2", {"--compress": "*"}),
    ("map mips rocks.png --from gltf --to gltf,xy -o out.ktx2", {"--swizzle": "~auto | ~rg | &ra,rrrg | *"}),
    ("map mips rocks.png --from gltf -o out.exr", {"--keep-lengths": "", "--bits": "~auto | ~float | !8 | !16 | *"}),
    (BAKE, {
        "--high": "low.obj | low.stl", "--low": "room.gltf", "--size": "16 | 24x20", "--kind": "~normal | !base-color | !roughness | !metallic | !roughness-metallic | !emissive | *", "--frame": "~mikktspace | !cotangent-2013 | !nonperspective | !paper-orthogonal | *",
        "--max-distance": "0.001 | 0.02", "--high-normals": "~smooth | curved | face",
        "--samples": "~4 | 1 | 16", "--convention": "~gltf,exact | gltf | directx | xy", "--unsigned": "~exact | *", "--dither": "", "--bits": "~8 | 16",
        "--padding": "~0 | 1 | -1", "--mask": "seen.png", "--per-object": "", "--verify": "checked", "--threads": "=1 | =3", "--memory": "=800",
        "--udim": "~1001 | !1002 | all", "--list-frames": ""}),
    (BAKE + " --kind object-normal", {"--up": "~y | *", "--high-up": "~y | *"}),
    ("bake --high layers.obj --low low.obj --size 24x24 -o out.png", {"--search": "~first | *", "--extrusion": "0.001 | 0.02", "--cage": "cage.obj"}),
    ("bake --high layers.obj --low flat.obj --size 24x24 -o out.png", {"--rays": "~auto | averaged | straight | !vertex-color", "--rays-mask": "rocks.png | mask.png"}),
    ("bake --high low.stl --high high.obj --low low.obj --size 24x24 -o out.png", {"--match-by-name": ""}),
    ("bake --high low.stl --high high.obj --low low.obj --size 24x24 --kind ao --match-by-name -o out.png", {"--ao-occluders": "all"}),
    (BAKE + " --verify checked", {"--device": "reference"}),
    ("bake --high tile_high.obj --low tile.obj --size 24x24 -o out.png", {"--wrap": ""}),
    ("bake --high high.obj --low room.gltf --size 24x24 -o out.ktx2", {"--compress": "~none | *"}),
    ("bake --high high.obj --low room.gltf --size 24x24 -o out.png", {"--object": "part-0 | part-5", "--material": "~-1 | 0 | 5"}),
    ("bake --high high.obj --low panel.gltf --frame vertex --size 24x24 -o out.png", {"--tangents": "~stored | *"}),
    ("bake --high panel.gltf --low low.obj --high-normals map --size 24x24 -o out.png", {"--high-map": "grain.png | ~rocks.png", "--high-frame": "~mikktspace | &paper-nodet,paper-transpose | =area-weighted | !cotangent-2013 | !nonperspective | !paper-orthogonal | *"}),
    ("bake --high panel.gltf --low low.obj --high-normals map --high-map rocks.png --size 24x24 -o out.png", {"--high-convention": "~gltf,exact | gltf | directx | slope"}),
    ("bake --high high.obj --low low.obj --size 16x16 --kind ao -o out.png", {"--ao-rays": "~64 | 9 | 250"}),
    ("bake --high high.obj --low low.obj --size 16x16 --kind thickness --ao-rays 9 --bits 32 -o out.exr", {"--thickness-distance": "0.01 | 0.1"}),
    ("bake --high high.obj --low low.obj --size 16x16 --kind curvature -o out.png", {"--curvature-radius": "0.001 | 0.1"}),
    ("bake --high high.obj --high layers.obj --low low.obj --size 16x16 --kind id -o out.png", {"--id-by": "~material | object | !vertex-color"}),
    ("bake --high high.obj --low low.obj --size 16x16 --ao-rays 9 -o out.png", {"--pack": "R=ao,G=height | R=height,A=0.5 | R=height,A=0.25 | !R=normal | !orm"}),
    ("bake --high room.gltf --low room.gltf --size 16x16 -o out.png", {"--kind": "base-color | roughness | metallic | roughness-metallic | emissive"}),
    ("bake --high high.obj --low low.obj --size 16x16 -o out.png", {"--maps": "height | normal,ao | position,curvature,thickness"}),
    ("convert panel.gltf --from-frame mikktspace --to-frame smooth -o out.glb", {
        "--from-frame": "~mikktspace | &paper-nodet,paper-transpose | =area-weighted | &cotangent,paper-full,exact,smooth,triangle | !cotangent-2013 | !nonperspective | !paper-orthogonal | *", "--to-frame": "~smooth | !cotangent-2013 | !nonperspective | !paper-orthogonal | *", "--bits": "~8 | *", "--unsigned": "~biased | *", "--keep-maps": "", "--keep-tangents": "",
        "--tangents": "~stored | *", "--verify": "checked", "--threads": "=1 | =3", "--memory": "=800", "--list-frames": ""}),
    ("convert panel.gltf -o out.glb", {"--max-degrees": "~0.3 | 0.000001", "--compress": "~none | *"}),
    ("convert panel.gltf --from-frame mikktspace --to-frame triangle -o out.glb", {"--provoking": "*"}),
    ("convert panel.gltf --from-frame mikktspace --to-frame smooth -o out.glb --verify checked", {"--device": "reference"}),
    ("tangents panel.gltf --replace -o out.glb", {"--frame": "~mikktspace | !smooth | *"}),
    ("tangents panel.gltf -o out.glb", {"--replace": "", "--threads": "=1 | =3"}),
    (SHADER, {
        "--lang": "~glsl | *", "--frame": "*", "--form": "~fused | total | area | seen", "--preset": "gltf | directx | unity", "--green": "*", "--channels": "*", "--unsigned": "*",
        "--uv-sets": "~1 | 2 | 3 | 4", "--differences": "*", "--set": "gradient | blend | light | environment", "--list-frames": ""}),
    ("shader --lang glsl --frame triangle", {"--stage": "*"}),
    ("shader --lang godot", {"--functions": "", "--two-sided": ""}),
    ("accuracy --tables degenerate,signs --csv out.csv", {"--tables": "half | signs", "--scene": "!nothing", "--frames": "cotangent | smooth,exact", "--threads": "=1 | =3"}),
    ("accuracy --tables signs", {"--csv": "out.csv", "--list": "", "--list-frames": "", "--against": "!rocks.png"}),
    ("figures --only mirrored --size 32x24 -o out", {"--only": "*", "--size": "40x24", "--device": "reference", "--threads": "=1 | =3"}),
]
GROUPS = ["render", "compare", "bake", "convert", "map"]
# Options and commands with tests in other files.
OPTIONS_ELSEWHERE = {"--help", "--json", "--quiet", "--output", "--overwrite"}  # help_test, json_fields_test.py, cli_test, files_test
ELSEWHERE = {"accuracy": {"--device"}}  # accuracy_command_test: the table that is drawn takes minutes
COMMANDS_ELSEWHERE = {"view", "cost", "batch", "help"}  # these need a screen, drivers, time: view_window_test, cost_report_test, batch_command_test


known = {}  # results by command: many options are compared with the same one


def run(tool, inputs, words):
    """Exit code, errors, and the files that a command wrote, or its printed output if it wrote none."""
    if tuple(words) not in known:
        known[tuple(words)] = run_again(tool, inputs, words)
    return known[tuple(words)]


def run_again(tool, inputs, words):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for path in inputs.iterdir():
            shutil.copy2(path, folder / path.name)
        before = set(folder.rglob("*"))
        done = subprocess.run([tool, *words], cwd=folder, capture_output=True, text=True, timeout=120, check=False)
        written = {str(p.relative_to(folder)): steady(p.read_text()) if p.suffix in TEXTS else p.read_bytes()
                   for p in sorted(folder.rglob("*")) if p.is_file() and p not in before}
        return done.returncode, done.stderr.strip(), written or steady(done.stdout + done.stderr)


def with_option(base, option, word):
    words = base.split()
    if option in words:
        words[words.index(option) + 1] = word
        return words
    return [*words, option, *([word] if word else [])]


def options_of(tool, command):
    text = subprocess.run([tool, *command.split(), "--help"], capture_output=True, text=True, check=True).stdout
    return set(re.findall(r"^  (?:-\w, )?(--[a-z0-9-]+)", text, re.M))


def commands_of(tool, command=""):
    text = subprocess.run([tool, *command.split(), "--help"], capture_output=True, text=True, check=True).stdout
    if " COMMAND [OPTIONS]" not in text:
        return [command]
    names = re.findall(r"^  ([a-z][a-z-]*) ", text.split("Examples:")[0], re.M)
    return [c for name in names for c in commands_of(tool, f"{command} {name}".strip())]


def words_named(refusal, option):
    """The words of an option, from `--x: expected [one of] a, b or c; found ...`."""
    found = re.search(re.escape(option) + r": expected (?:one of )?(.*?); found", refusal)
    return [w for w in re.split(r",? or |, ", found[1]) if re.fullmatch(r"[a-z0-9.-]+", w)] if found else []


def try_option(tool, inputs, base, option, words):
    """Problems of an option, one per line, and the number of words tried."""
    wanted = [w.strip() for w in words.split("|")]
    usual = {w[1:] for w in wanted if w.startswith("~")}
    same = {w[1:] for w in wanted if w.startswith("=")}
    refused = {w[1:] for w in wanted if w.startswith("!")}
    equals = [set(w[1:].split(",")) for w in wanted if w.startswith("&")]
    tried = [w for w in wanted if w and w[0] not in "~=*!&"]
    if "*" in wanted:
        refusal = run(tool, inputs, with_option(base, option, "nonsense!"))[1]
        named = words_named(refusal, option)
        if len(named) < 2:
            return [f"{base} {option}: expected the words in the refusal; found {refusal}"], 0
        tried += [w for w in named if w not in usual | refused and w not in tried]
    results, wrong = {"(without)": run(tool, inputs, base.split())}, []
    for word in refused:
        code, errors, _ = run(tool, inputs, with_option(base, option, word))
        if code not in (1, 2) or "error: " not in errors:
            wrong.append(f"{base} {option} {word}: expected a refusal; found exit code {code}, {errors}")
    for word in [*tried, *usual, *same] if words else [""]:
        results[word] = run(tool, inputs, with_option(base, option, word))
    for word, (code, errors, result) in results.items():
        if code not in (0, 5) or not result:
            wrong.append(f"{base} {option} {word}: exit code {code}, {errors or 'nothing written'}")
    first = results["(without)"][2]
    for word in usual | same:
        if results[word][2] != first:
            wrong.append(f"{base}: the same with {option} {word}; the result differs")
    # A default that is one of the words without a mark: one word may give the result of leaving the option out.
    apart = {w: r[2] for w, r in results.items() if w not in usual | same}
    equal = [pair for pair in itertools.combinations(apart, 2) if apart[pair[0]] == apart[pair[1]]]
    for pair in itertools.chain.from_iterable(itertools.combinations(sorted(e), 2) for e in equals):
        if results[pair[0]][2] != results[pair[1]][2]:
            wrong.append(f"{base}: {option} {pair[0]} and {pair[1]} differ")
    equal = [pair for pair in equal if not any(set(pair) <= e for e in equals)]
    if "*" in wanted and not usual and len(equal) == 1 and "(without)" in equal[0]:
        equal = []
    wrong += [f"{base}: {option} {a or '(flag)'} and {b or '(flag)'} give the same" for a, b in equal]
    return wrong, len(results) - 1 + len(refused)


def command_of(base):
    return " ".join(base.split()[:2] if base.startswith("map ") else base.split()[:1])


def main(tool, group):
    tool, wrong, tried = str(pathlib.Path(tool).resolve()), [], 0
    of_group = lambda base: base.split()[0] == group or group == "others" and base.split()[0] not in GROUPS
    if platform.machine() != "x86_64":
        print("skipped: it was made on x86-64")
        return SKIPPED
    for command in filter(of_group, commands_of(tool)):
        here = {option for base, options in CASES if command_of(base) == command for option in options}
        if command not in COMMANDS_ELSEWHERE:
            wrong += [f"{command} {option}: is tried by no line of this file" for option in sorted(options_of(tool, command) - here - OPTIONS_ELSEWHERE - ELSEWHERE.get(command, set()))]
    with tempfile.TemporaryDirectory() as name:
        inputs = pathlib.Path(name)
        make_inputs(inputs)
        drawn = subprocess.run([tool, *"render --shape plane --size 8 -o probe.png --json -".split()], cwd=inputs, check=True, capture_output=True, text=True)
        (inputs / "probe.png").unlink()
        if json.loads(drawn.stdout)["device"] == "reference":
            print("skipped: no Vulkan device, from which the reference renderer would differ")
            return SKIPPED
        subprocess.run([tool, *"map convert rocks.png --from gltf --to directx -o as-directx.png".split()], cwd=inputs, check=True, capture_output=True)
        jobs = [(base, option, words) for base, options in CASES for option, words in options.items() if of_group(base)]
        for lines, count in (try_option(tool, inputs, *job) for job in jobs):
            wrong += lines
            tried += count
    print(*wrong, sep="\n", end="\n" if wrong else "")
    print(f"{len(jobs)} options with {tried} words, {len(wrong)} of them wrong")
    return 1 if wrong or not tried else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
