#!/usr/bin/env python3
"""Compares docs/reference/json.md with the reports of commands: it must list every field of a report, and no other.

  json_fields_test.py TOOL DOCS          lists the fields that differ; exit code 1 if any does
  json_fields_test.py TOOL DOCS --rows   prints the rows that the tables lack, without meanings

How a table reads: `...` stands for the fields of a shape; `a.b[].c` is the member c of each item of the list b of the object a; NAME is any name; a field that
ends in ? is not in every report. A type that is the name of a shape stands for the object of that shape's table.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from output_inputs import make_inputs

HERE = pathlib.Path(__file__).resolve().parent

# Command lines that together write every field except those in UNSEEN.
COMMANDS = """
render panel.gltf --size 32x32 -o r.png --device reference
render panel.gltf --size 32x32 -o r.png --device reference --view error
compare panel.gltf --size 32x32 -o compared --device reference
compare low.obj --size 32x32 -o compared --device reference
bake --high high.obj --low low.obj --size 32x32 -o b.png --verify baked --device reference
bake --high high.obj --low low.obj --size 32x32 -o b.png --maps normal,curvature,position
bake --high high.obj --low low.obj --size 16 -o tile.png --maps curvature,position --udim 1001
bake --high room.gltf --low low.obj --size 16 -o ids.png --maps id,curvature,orm --ao-rays 4
bake --high high.obj --low low.obj --size 16 -o tiles.png --maps normal,curvature,position --udim all
bake --high high.obj --low low.obj --size 16 -o each.png --per-object --maps normal,curvature,position --verify each --device reference
tangents panel.gltf -o t.glb
tangents panel.gltf
tangents panel.gltf --frame smooth
convert panel.gltf --to-frame orthonormal -o c.glb --verify converted --device reference
convert panel.gltf --to-frame cotangent -o c.glb
convert panel.gltf --to-frame orthonormal --keep-tangents -o c.glb
convert panel.gltf -o c.glb
convert panel.gltf --compress uastc -o c.glb
lint c.glb --details
convert plain.gltf --to-frame mikktspace -o c.glb
convert panel.gltf --provoking first -o c.glb
lint panel.gltf --limit 0.01 --limit-area 0
lint plain.gltf --limit 90
lint low.obj
lint panel.gltf --details
map info rocks.png
map info b.png
map info height.png
map info rocks.png gone.png
map detect rocks.png
map detect height.png
map detect rocks.png gone.png
map convert rocks.png --from gltf --to directx -o o.png
map convert rocks.png --from gltf --to directx --max-degrees 1 --for mobile -o o.ktx2
map detect o.png
map diff rocks.png o.png
map from-height height.png -o fh.png
map to-height rocks.png -o th.png
map blend rocks.png grain.png -o bl.png
map mips rocks.png -o m.dds
shader --lang glsl --frame cotangent
accuracy --list
accuracy --tables flat --frames cotangent
figures --only mirrored -o figures --size 64x48 --device reference
cost --frames cotangent --no-timing
batch jobs.jsonl --store kept
""".strip().splitlines()

# Documented fields that only models, devices and windows which this test does not create would write.
UNSEEN = {
    "cotan-render": {"pose", "pose.animation", "pose.seconds", "note"},
    "cotan-compare": {"pose", "pose.animation", "pose.seconds"},
    "cotan-tangents": {"primitives[].cannot"},
    "cotan-convert": {"tangents.anisotropy"},
    "cotan-figures": {"figures[].numbers"},
    "cotan-cost": {"rows[].instructions_2006", "timing[]", "devices[]", "devices[].mesh", "devices[].pass", "devices[].resolve",
                   "devices[].vertex", "devices[].fragment", "devices[].beyond"},
}
NOT_RUN = {"cotan-view", "cotan-convert-result", "cotan-lint-result", "cotan-render-result"}  # the last three: tests/python


def kind_of(value):
    for kind, name in ((bool, "boolean"), (int, "integer"), (float, "number"), (str, "string"), (list, "list"), (dict, "object")):
        if isinstance(value, kind):
            return name
    return "null"


class Documented:
    """The tables of a page: fields of each report with their types, and the shapes that types may name."""

    def __init__(self, page):
        self.reports, self.versions, shapes, here = {}, {}, {}, None
        self.perhaps = set()  # members of shapes that some reports with the shape never have
        for line in page.read_text().splitlines():
            if heading := re.fullmatch(r"#+ (cotan-[a-z-]+), version (\d+)", line):
                here = self.reports.setdefault(heading[1], {})
                self.versions[heading[1]] = int(heading[2])
            elif heading := re.fullmatch(r"#+ Shape: ([a-z]+)", line):
                here = shapes.setdefault(heading[1], {})
            elif line.startswith("#"):
                here = None
            elif here is not None and (row := re.match(r"\| `([^`]+)` \| ([^|]+) \|", line)):
                here[row[1]] = row[2].strip()
        for name, fields in self.reports.items():
            self.reports[name] = {"format": "string", "version": "integer"} | self.expanded(fields, shapes)

    def expanded(self, fields, shapes):
        found = {}
        for field, types in fields.items():
            shape = types.removesuffix(" or null").removeprefix("list of ")
            if field == "...":  # all fields of the shape, as far as the report has them
                inside = self.expanded(shapes[shape], shapes)
                self.perhaps |= {name.rstrip("?") for name in inside if name.endswith("?") and "." not in name}
                found |= {name if "." in name or name.endswith("?") else name + "?": t for name, t in inside.items()}
                continue
            found[field] = types.replace(shape, "object") if shape in shapes else types
            inner = field.rstrip("?") + ("[]" if types.startswith("list of ") else "")
            for member, member_types in self.expanded(shapes.get(shape, {}), shapes).items():
                found[f"{inner}.{member}"] = member_types
                if member.endswith("?"):
                    self.perhaps.add(f"{inner}.{member}".replace("?", ""))
        return found


class Seen:
    """Fields of the reports of one format: their types, and whether every object that could have them had them."""

    def __init__(self, documented):
        # `a.NAME.b` matches any name there. Question marks are only at the ends of names.
        self.named = {field.replace("?", "") for field in documented if "NAME" in field}
        self.types, self.times = {}, {}

    def add(self, value, path=""):
        self.times[path] = self.times.get(path, 0) + 1
        self.types.setdefault(path, set()).add(kind_of(value))
        if isinstance(value, dict):
            anything = any(n == self.below(path, "NAME") or n.startswith(self.below(path, "NAME") + ".") for n in self.named)
            for name, member in value.items():
                self.add(member, self.below(path, "NAME" if anything else name))
        for item in value if isinstance(value, list) else ():
            self.add(item, path + "[]")

    @staticmethod
    def below(path, name):
        return f"{path}.{name}" if path else name


def parent_of(field):
    return field.removesuffix("[]") if field.endswith("[]") else field.rpartition(".")[0]


RENAMED = re.findall(r'\{"(\w+)", "(\w+)"\}', (HERE.parent / "src/files/old_fields.hpp").read_text())  # new name, old name


def without_old_fields(value):
    """The report without the old names of its fields, each of which must have the value of a new one."""
    if isinstance(value, list):
        return [without_old_fields(item) for item in value]
    if not isinstance(value, dict):
        return value
    old = {old for name, old in RENAMED if name in value and value.get(old) == value[name]}
    return {name: without_old_fields(member) for name, member in value.items() if name not in old}


def differences(name, page, reports):
    """Mistakes of a page about these reports, one sentence each."""
    documented = page.reports.get(name, {})
    seen = Seen(documented)
    for report in reports:
        seen.add(without_old_fields(report))
    rows, wrong = {}, []
    for field, types in documented.items():
        rows[field.replace("?", "")] = (field, types)
    for field, kinds in seen.types.items():
        if not field or field.endswith("[]"):
            continue
        if field not in rows:
            wrong.append(f"{name}: `{field}` ({'/'.join(sorted(kinds))}) is in a report and not on the page")
            continue
        allowed = set(rows[field][1].split(" or "))
        inside = {a.removeprefix("list of ").removesuffix("s") for a in allowed if a.startswith("list of ")}
        allowed = {"list" if a.startswith("list of ") else a for a in allowed} | ({"integer"} if "number" in allowed else set())
        if kinds - allowed:
            wrong.append(f"{name}: `{field}` is {'/'.join(sorted(kinds))} in a report and {rows[field][1]} on the page")
        items = seen.types.get(field + "[]", set()) - ({"integer"} if "number" in inside else set()) - {"list"}
        if items - inside:
            wrong.append(f"{name}: `{field}` holds {'/'.join(sorted(items))} in a report and is {rows[field][1]} on the page")
    unseen = UNSEEN.get(name, set())
    for field, (written, _) in rows.items():
        times, parents = seen.times.get(field, 0), seen.times.get(parent_of(field), 0)
        objects = parents if "object" in seen.types.get(parent_of(field), {"object"}) else 0
        if any(field == u or field.startswith((u + ".", u + "[")) for u in unseen):
            continue
        if times == 0 and objects > 0 and field not in page.perhaps:
            wrong.append(f"{name}: `{field}` is on the page and in no report")
        elif times < objects and not written.endswith("?") and "null" not in seen.types[parent_of(field)]:
            wrong.append(f"{name}: `{field}` is not in every report: write `{field}?`")
    return wrong


def run_all(tool, folder):
    """Reports of all commands, by format."""
    make_inputs(folder)
    jobs = [{"name": "a", "command": ["map", "info", "rocks.png"]}, {"name": "b", "command": ["lint", "plain.gltf"]},
            {"name": "c", "command": ["map", "info", "gone.png"]}]
    (folder / "jobs.jsonl").write_text("".join(json.dumps(job) + "\n" for job in jobs))
    reports, wrong = {}, []
    for line in COMMANDS:
        (folder / "report.json").unlink(missing_ok=True)
        words = [*line.split(), "--json", "report.json", "--overwrite", "--quiet"]
        run = subprocess.run([tool, *words], cwd=folder, capture_output=True, text=True, timeout=120, check=False)
        if run.returncode == 3:
            print(f"skipped: {line}: {run.stderr.strip()}")
            continue
        if not (folder / "report.json").exists():
            wrong.append(f"{line}: exit code {run.returncode}, no report: {run.stderr.strip()}")
            continue
        report = json.loads((folder / "report.json").read_text())
        if list(report)[:2] != ["format", "version"]:
            wrong.append(f"{line}: expected format and version first; found {list(report)[:2]}")
            continue
        words = line.split()
        command = " ".join(words[:2] if words[0] == "map" else words[:1])
        if report["format"] != "cotan-" + command.replace(" ", "-") or report["command"] != command:
            wrong.append(f"{line}: is called {report['format']}, command {report['command']}")
        reports.setdefault(report["format"], []).append(report)
    return reports, wrong


def main(arguments):
    rows = "--rows" in arguments
    arguments = [a for a in arguments if a != "--rows"]
    if len(arguments) != 2:
        print(__doc__, file=sys.stderr)
        return 1
    tool, page = os.path.abspath(arguments[0]), pathlib.Path(arguments[1])
    documented = Documented(page)
    with tempfile.TemporaryDirectory(prefix="cotan-json-") as folder:
        reports, wrong = run_all(tool, pathlib.Path(folder))
    for name, all_of_it in sorted(reports.items()):
        if rows:
            seen = Seen(documented.reports.get(name, {}))
            for report in all_of_it:
                seen.add(report)
            known = {f.replace("?", "") for f in documented.reports.get(name, {})}
            print(f"\n## {name}")
            for field, kinds in seen.types.items():
                if field and not field.endswith("[]") and field not in known:
                    print(f"| `{field}` | {' or '.join(sorted(kinds))} | |")
            continue
        if {r["version"] for r in all_of_it} != {documented.versions.get(name)}:
            wrong.append(f"{name}: version {all_of_it[0]['version']} in a report, {documented.versions.get(name)} on the page")
        wrong += differences(name, documented, all_of_it)
    missing = set(documented.reports) - set(reports) - NOT_RUN - {"cotan-cost"}
    wrong += [f"{name} is on the page and no command here writes it" for name in sorted(missing)]
    for line in wrong:
        print(line)
    return 1 if wrong and not rows else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
