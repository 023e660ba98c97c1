#!/usr/bin/env python3
"""words_test.py SOURCES FACT: whether names, messages and pages use the field's terms. Prints each line that does not, with a better
word. Exceptions are words that the field uses in another meaning."""
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(sys.argv[1])
FOLDERS = ("src", "apps", "shaders", "bindings", "web", "integrations")
SUFFIXES = (".cpp", ".hpp", ".h", ".c", ".inc", ".frag", ".vert", ".comp", ".glsl", ".js", ".mjs", ".ts", ".py")
LEFT_OUT = re.compile(r"\.min\.js|bindings/js/three/shader_text\.js")  # not written by hand

# What a reader of the field would have to learn from us, and the field's term.
TERMS = [
    (r"surroundings", "environment"),
    (r"mend(s|ed|ing)?", "fix"),
    (r"hot spots?", "problem areas"),
    (r"turned normals?", "perturbed normals"),
    (r"stretched highlights?", "anisotropic highlights"),
    (r"(a|the|this|each|every|one|whole) pictures?(?! options?| of a model)", "image"),
    (r"over and over", "repeatedly"),
    (r"some [0-9]+", "about"),
    (r"the house", "architecture"),
    (r"nearness", "reversed depth"),
    (r"(a|the) shares? (of|that)", "fraction"),
    (r"so (many|much) (?!as|that)\w+", "the number"),
    (r"nobody (knows|sees|asks|reads|wants|needs|would)", "unknown, invisible, unused"),
    (r"(is|are|was|were) told", "given, requested"),
    (r"what is (told|left|asked|said|meant)", "a noun"),
    (r"throws? (a|no|the) shadows?", "casts"),
    (r"cut off at", "clamped to"),
    (r"(so|as) it shows(?=[.,;:]|$)", "a noun"),
]
# In hand-written pages also these, since pages do not speak of files and functions with such names.
PAGE_TERMS = [
    (r"(a|the|this) pictures?", "image"),
    (r"pictures", "images"),
    (r"shares? of the", "fraction, percent"),
    (r"so (many|much)", "the number"),
]
GENERATED = {f"docs/reference/{page}.md" for page in ("c", "cpp", "javascript", "command-line")}
# Identifiers that no longer exist, in any part of a name.
NAMES = re.compile(r"\w*(kMost[A-Z]|inWords|loadTold|Surroundings|Nearness|HotSpot|[a-z]Told|TurnedNormal)\w*|"
                   r"\b(Wish|Artist|Studio|Painter|Drawer)\b")
wrong, checked = [], 0


def compiled(terms):
    return [(re.compile(rf"\b({pattern})\b", re.I), better) for pattern, better in terms]


PATTERNS, PAGE_PATTERNS = compiled(TERMS), compiled(TERMS + PAGE_TERMS)


def sources():
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", *FOLDERS], capture_output=True, text=True)
    names = listed.stdout.split("\n") if listed.returncode == 0 else \
        [str(p.relative_to(ROOT)) for folder in FOLDERS for p in (ROOT / folder).rglob("*")]
    for name in names:
        path = ROOT / name
        if name and not LEFT_OUT.search(name) and path.suffix in SUFFIXES and path.is_file():
            yield name, path


def check(name, number, text, what, patterns=PATTERNS):
    for pattern, better in patterns:
        for found in pattern.finditer(text):
            wrong.append(f"{name}:{number}: {what} '{found.group(0)}'; write {better}")


def readSources():
    for name, path in sources():
        try:
            yield name, path, path.read_text()
        except UnicodeDecodeError:
            continue


def messagesUseTheTermsOfTheField():
    global checked
    for name, path, text in readSources():
        if name.startswith(("src/", "apps/", "bindings/python", "web/")):
            for number, line in enumerate(text.split("\n"), 1):
                for string in re.findall(r'"((?:\\.|[^"\\])*)"', line):
                    checked += " " in string
                    check(name, number, string, "message")


def namesUseTheTermsOfTheField():
    global checked
    for name, path, text in readSources():
        if path.suffix != ".py":
            for number, line in enumerate(text.split("\n"), 1):
                checked += 1
                for found in NAMES.finditer(re.sub(r'"(?:\\.|[^"\\])*"|//.*', "", line)):
                    wrong.append(f"{name}:{number}: name '{found.group(0)}'")


def pagesUseTheTermsOfTheField():
    global checked
    pages = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "SECURITY.md", "bindings/js/README.md", "bindings/python/README.md")]
    pages += sorted(page for folder in ("docs", "examples") for page in (ROOT / folder).rglob("*.md"))
    for page in pages:
        name = str(page.relative_to(ROOT))
        if name not in GENERATED:
            text = page.read_text().partition("<!-- cotan cost: from here")[0]
            text = re.sub(r"```[^`]*```|`[^`]*`|\]\([^)]*\)", "", text)
            checked += len(text.splitlines())
            check(name, 1, " ".join(text.split()), "page", PAGE_PATTERNS)


# The names of the last version, which are accepted once more: where they stand, and how each file writes them.
OLD_NAMES = {
    "src/c/include/cotan_old_names.h": r"#define (\w+) \w+",
    "src/c/old_names.cpp": r"cotan_status (\w+)\(",
    "src/files/old_fields.hpp": r'\{"\w+", "(\w+)"\}',
    "bindings/python/cotan/_old_names.py": r'^    "(\w+_\w+)": "\w+",$',
    "bindings/js/src/old_names.js": r"(\w+): \w+ }",
    "bindings/js/types/old_names.d.ts": r"export (?:type|const) (\w+)",
}


def documentsUseTheTermsOfTheField():
    """No page, header, typing or docstring of a door has a name of the last version."""
    global checked
    old = {name: set(re.findall(pattern, (ROOT / name).read_text(), re.M)) for name, pattern in OLD_NAMES.items()}
    wrong.extend(f"{name}: expected old names, found none" for name, found in old.items() if not found)

    def anyOf(part):
        return "|".join(sorted(word for name, found in old.items() if part in name for word in found))

    # Fields of reports and types of npm are ordinary words, too: fields are looked for in code, at the end of a path.
    everywhere = rf"\b(?:{anyOf('src/c')}|{anyOf('python')})\b"
    pages = rf"{everywhere}|\b(?:{anyOf('bindings/js')})\b|`(?:[^`\s]*[.\]])?(?:{anyOf('fields')})\??`"
    patterns = {".md": re.compile(pages), ".ts": re.compile(pages)}
    for folder in ("README.md", "docs", "examples", "bindings", "integrations", "src/c/include"):
        for page in [ROOT / folder] if folder.endswith(".md") else (ROOT / folder).rglob("*"):
            name = str(page.relative_to(ROOT))
            if page.suffix in (".md", ".ts", ".py", ".js", ".h", ".c", ".cpp") and not LEFT_OUT.search(name) and name not in OLD_NAMES:
                text = page.read_text()
                checked += text.count("\n")
                for found in patterns.get(page.suffix, re.compile(everywhere)).finditer(text):
                    wrong.append(f"{name}:{text.count(chr(10), 0, found.start()) + 1}: the old name {found.group(0)}")


FACTS = (documentsUseTheTermsOfTheField, messagesUseTheTermsOfTheField, namesUseTheTermsOfTheField, pagesUseTheTermsOfTheField)
if __name__ == "__main__":
    chosen = [f for f in FACTS if f.__name__ == sys.argv[2]] if len(sys.argv) > 2 else FACTS
    if not chosen:
        sys.exit(f"words_test: expected one of {', '.join(f.__name__ for f in FACTS)}; found {sys.argv[2]}")
    for fact in chosen:
        checked = 0
        fact()
        if checked < 3000:
            wrong.append(f"{fact.__name__}: only {checked} texts were checked; this test no longer finds them")
    print(*wrong, sep="\n", end="\n" if wrong else "")
    sys.exit(bool(wrong))
