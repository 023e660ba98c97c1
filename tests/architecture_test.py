#!/usr/bin/env python3
"""architecture_test.py SOURCES FACT: checks a fact of docs/project/architecture.md, prints violations."""
import collections
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])
SRC = ROOT / "src"
MOST_FOLDERS, MOST_ARROWS, MOST_HEADERS = 13, 56, 30
MOST_LINES = {"src": 63_320, "apps": 30_900}  # of C++; a commit that raises one says why
WITHOUT_HEADER = {"c"}  # its header is cotan.h
INCLUDE = re.compile(r'^\s*#\s*include\s+[<"]([^">]+)[">]', re.M)

parts = sorted(p.name for p in SRC.iterdir() if p.is_dir())
files = [p for p in SRC.rglob("*") if p.suffix in (".cpp", ".hpp", ".h", ".inc")]
owner = {str(p.relative_to(p.parents[len(p.relative_to(SRC).parts) - 3])): p.relative_to(SRC).parts[0]
         for p in files if "/include/cotan/" in str(p)}
wrong = []


def part_of(include, file):
    """The part that owns the header; None for system headers, the portable text, and files in the same folder."""
    if include in owner:
        return owner[include]
    if (file.parent / include).is_file():
        return None
    first = include.split("/")[0]
    return first if "/" in include and first in parts else None


def arrows():
    """Part -> included part -> an example of a file that includes it."""
    found = collections.defaultdict(dict)
    for file in files:
        own = file.relative_to(SRC).parts[0]
        for include in INCLUDE.findall(file.read_text()):
            other = part_of(include, file)
            if other and other != own:
                found[own].setdefault(other, f"{file.relative_to(ROOT)} includes {include}")
    return found


def hasFewFolders():
    if len(parts) > MOST_FOLDERS:
        wrong.append(f"src has {len(parts)} folders: expected at most {MOST_FOLDERS}")


def hasFewLines():
    for folder, most in MOST_LINES.items():
        found = [p for p in (ROOT / folder).rglob("*") if p.suffix in (".cpp", ".hpp", ".h", ".inc")]
        count = sum(len(p.read_text().splitlines()) for p in found if "old_" not in p.name)  # old names go with the next version
        if not most * 0.9 < count <= most:
            wrong.append(f"{folder} has {count} lines of C++: expected at most {most}, and not far fewer: lower the limit")


def everySourceIsBuilt():
    count = 0
    for part in sorted(p for top in ("src", "apps") for p in (ROOT / top).iterdir() if p.is_dir()):
        text = "".join(p.read_text() for p in part.rglob("CMakeLists.txt"))
        for name in re.findall(r"\b(\w+_)\$\{COTAN_SYSTEM\}\.cpp\b", text):  # a file for each system
            text += f" {name}posix.cpp {name}windows.cpp"
        text = text.replace("program_${program}.cpp", "program_posix.cpp program_windows.cpp program_web.cpp")
        for file in part.rglob("*.cpp"):
            count += 1
            if not re.search(rf"\b{re.escape(file.stem)}\.cpp\b", text):
                wrong.append(f"{file.relative_to(ROOT)}: no CMakeLists.txt of its part names it")
    if count < 300:
        wrong.append(f"{count} sources: this test no longer finds them")


def hasFewDependencies():
    count = sum(len(others) for others in arrows().values())
    if count > MOST_ARROWS:
        wrong.append(f"{count} arrows between parts: expected at most {MOST_ARROWS}")
    if count < 30:
        wrong.append(f"{count} arrows between parts: this test no longer finds them")


def hasNoDependencyCycle():
    found, done = arrows(), []

    def visit(part, way):
        if part in way:
            circle = [*way[way.index(part):], part]
            wrong.append("a circle: " + "; ".join(found[a][b] for a, b in zip(circle, circle[1:])))
        elif part not in done:
            for other in sorted(found[part]):
                visit(other, [*way, part])
            done.append(part)

    for part in parts:
        visit(part, [])


def partsIncludeWhatTheyLink():
    for part, others in arrows().items():
        text = "".join(p.read_text() for p in (SRC / part).rglob("CMakeLists.txt"))
        links = set(re.findall(r"\bcotan_(\w+)", text))
        for other, place in sorted(others.items()):
            if other not in links:
                wrong.append(f"{place}, but src/{part}/CMakeLists.txt does not link cotan_{other}")


def eachPartHasOnePublicHeader():
    for part in parts:
        if part not in WITHOUT_HEADER and not (SRC / part / "include/cotan" / f"{part}.hpp").is_file():
            wrong.append(f"src/{part} has no include/cotan/{part}.hpp")
    headers = [p for p in SRC.glob("*/include/**/*") if p.is_file() and "old_" not in p.name]
    if len(headers) > MOST_HEADERS:
        wrong.append(f"{len(headers)} public headers: expected at most {MOST_HEADERS}")
    for header in headers:
        for include in INCLUDE.findall(header.read_text()):
            if part_of(include, header) and include not in owner:
                wrong.append(f"{header.relative_to(ROOT)} is public and includes {include}, which is not")


def fileNamesAreUnique():
    names = collections.defaultdict(list)
    for file in SRC.rglob("*"):
        if file.is_file() and file.name != "CMakeLists.txt":
            names[file.name].append(str(file.relative_to(ROOT)))
    for name, places in sorted(names.items()):
        if len(places) > 1:
            wrong.append(f"{name} occurs {len(places)} times: {', '.join(sorted(places))}")


def judgesAreIndependent():
    for folder, other in (("src/render/reference", "render/vulkan/"), ("src/render/vulkan", "render/reference/"),
                          ("apps/lab/truth", "bake/"), ("src", "lab/")):
        for file in (ROOT / folder).rglob("*.?pp"):
            for include in INCLUDE.findall(file.read_text()):
                if include.startswith(other):
                    wrong.append(f"{file.relative_to(ROOT)} includes {include}")


# Standard headers that other standard headers include in some versions of libstdc++ only, and names that need them.
OWN_HEADERS = {
    "algorithm": r"std::(ranges::)?(sort|stable_sort|(min|max|minmax)_element|minmax|find_if|find_if_not|all_of|any_of|"
                 r"none_of|count|count_if|copy_if|copy_n|transform|unique|remove_if|replace|fill_n|reverse|rotate|clamp|"
                 r"(lower|upper)_bound|equal_range|binary_search|nth_element|partial_sort|is_sorted|mismatch|search|"
                 r"adjacent_find|for_each|generate|shuffle|partition|merge|includes)\b|std::(min|max)\(\{",
    "numeric": r"std::(accumulate|iota|gcd|lcm|partial_sum|inner_product|reduce|exclusive_scan|midpoint)\b",
    "limits": r"std::numeric_limits",
}


def standardHeadersAreIncludedWhereUsed():
    for file in [p for top in ("src", "apps", "tests", "bench", "fuzz") for p in (ROOT / top).rglob("*.?pp")]:
        text = re.sub(r"//.*", "", file.read_text())
        for header, names in OWN_HEADERS.items():
            used = re.search(names, text)
            if used and header not in INCLUDE.findall(text):
                wrong.append(f"{file.relative_to(ROOT)} uses {used.group()} without <{header}>")


FACTS = (hasFewFolders, hasFewLines, everySourceIsBuilt, hasFewDependencies, hasNoDependencyCycle,
         partsIncludeWhatTheyLink, eachPartHasOnePublicHeader, fileNamesAreUnique, judgesAreIndependent,
         standardHeadersAreIncludedWhereUsed)
if __name__ == "__main__":
    chosen = [f for f in FACTS if f.__name__ == sys.argv[2]] if len(sys.argv) > 2 else FACTS
    if not chosen:
        sys.exit(f"architecture_test: expected one of {', '.join(f.__name__ for f in FACTS)}; found {sys.argv[2]}")
    for fact in chosen:
        fact()
    if not owner or len(files) < 300:
        wrong.append("this test no longer finds the sources")
    print(*wrong, sep="\n", end="\n" if wrong else "")
    sys.exit(bool(wrong))
