#!/usr/bin/env python3
"""constants.py SOURCES: unity builds compile the files of a part as one. Prints constants that two files of a folder
define, and fails if there are any. Headers are left to compilers."""
import collections
import pathlib
import re
import sys

DEFINED = re.compile(r"^(?:static )?(?:constexpr|const) [^=({;]*?\b(k[A-Z]\w*)\b(?:\[[^\]]*\])?\s*(?:=|\{)", re.M)

sources = pathlib.Path(sys.argv[1])
files = sorted([*sources.glob("src/**/*.cpp"), *sources.glob("apps/**/*.cpp")])
found, looked = False, 0
for folder in sorted({file.parent for file in files}):
    places = collections.defaultdict(set)
    for file in folder.glob("*.cpp"):
        for name in DEFINED.findall(file.read_text(encoding="utf-8")):
            places[name].add(file.name)
            looked += 1
    for name, where in sorted(places.items()):
        if len(where) > 1:
            found = True
            print(f"{folder.relative_to(sources)}: {name} is defined in {', '.join(sorted(where))}: expected one of them")
if looked < 100:
    sys.exit(f"expected at least 100 constants in {sources}; found {looked}")
sys.exit(found)
