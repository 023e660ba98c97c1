"""Who publishes Cotan, in CITATION.cff, its one place: contact_test.py SOURCES. Nothing is named while it names nobody;
once it names a repository and an address, everything that is made of the sources names these."""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

from tracked import tracked

SOURCES = pathlib.Path(sys.argv[1]).resolve()
URL, MAIL = "https://forge.example/people/cotan", "people@forge.example"
FILLED = f'version: 0.2.0\nrepository-code: "{URL}"\ncontact:\n  - name: "The Cotan authors"\n    email: "{MAIL}"\nkeywords: [a]\n'
EMPTY = "version: 0.2.0\n# repository-code: \"https://...\"\n# contact:\n#     email: \"...\"\nreferences:\n  - email: other@forge.example\n"


def contact(folder, text, what):
    citation = folder / "CITATION.cff"
    citation.write_text(text)
    return subprocess.run([SOURCES / "scripts/contact", *what], env=dict(os.environ, COTAN_CITATION=str(citation)),
                          capture_output=True, text=True)


def printed(folder, text, what):
    run = contact(folder, text, [what])
    assert run.returncode == 0, run.stderr
    return run.stdout


def made_by_cmake(folder, text):
    """The files of the Debian packages that are made from the two values, and the values."""
    (folder / "CITATION.cff").write_text(text)
    script = folder / "made.cmake"
    script.write_text(f"""
macro(set_property)
endmacro()
include({SOURCES}/cmake/CotanContact.cmake)
foreach(file changelog copyright)
  configure_file({SOURCES}/cmake/packages/${{file}}.in {folder}/${{file}} @ONLY)
endforeach()
message("${{COTAN_REPOSITORY}}|${{COTAN_MAINTAINER}}|${{COTAN_PROJECT_URL_LINE}}")
""")
    run = subprocess.run(["cmake", "-P", script], env=dict(os.environ, COTAN_CITATION=str(folder / "CITATION.cff")),
                         capture_output=True, text=True, check=True)
    return run.stderr + (folder / "changelog").read_text() + (folder / "copyright").read_text()


def blender_addon(folder, text):
    (folder / "CITATION.cff").write_text(text)
    library = next(pathlib.Path("/lib").glob("*-linux-gnu/libz.so.1"))
    subprocess.run([SOURCES / "scripts/blender-addon", folder / "addon"], check=True, capture_output=True,
                   env=dict(os.environ, COTAN_CITATION=str(folder / "CITATION.cff"), LIBRARY=str(library)))
    shutil.unpack_archive(folder / "addon/cotan_blender.zip", folder / "unpacked")
    return [(folder / "unpacked/cotan_blender" / name).read_text() for name in ("__init__.py", "blender_manifest.toml")]


def nobodyIsNamedWhileNobodyPublishes(folder):
    assert printed(folder, EMPTY, "repository") == printed(folder, EMPTY, "email") == "\n"
    made = made_by_cmake(folder, EMPTY)
    assert "Unpublished build of Cotan <nobody@cotan.invalid>" in made, made
    assert not re.search("^Source:|Project-URL|@COTAN", made, re.M), made
    init, manifest = blender_addon(folder, EMPTY)
    assert "tracker_url" not in init and "website" not in manifest


def everythingNamesWhoPublishes(folder):
    assert printed(folder, FILLED, "repository") == URL + "\n" and printed(folder, FILLED, "email") == MAIL + "\n"
    made = made_by_cmake(folder, FILLED)
    for line in (f"Source: {URL}\n", f" -- The Cotan authors <{MAIL}>  ", f"Project-URL: Repository, {URL}\n"):
        assert line in made, line
    assert "invalid" not in made
    init, manifest = blender_addon(folder, FILLED)
    assert f'website = "{URL}"\n' in manifest, manifest
    assert f'    "tracker_url": "{URL}",\n    "category": "Render",\n}}' in init, init[:900]


def badValuesAreRefused(folder):
    for text, what in (('repository-code: "forge.example"\n', "repository"), ("repository-code: https://a b\n", "repository"),
                       ("contact:\n  - email: nobody\n", "email")):
        run = contact(folder, text, [what])
        assert run.returncode == 2 and run.stderr.count("\n") == 1 and "expected a" in run.stderr, run
    for words in ([], ["name"], ["email", "repository"], ["--help"]):
        run = contact(folder, FILLED, words)
        assert run.returncode == 1 and run.stderr.startswith("usage: ") and run.stderr.count("\n") == 1, run


def noFileSendsReadersToAnAddressThatIsNotFilledIn(folder):
    # No file of the repository has an address or a repository of Cotan of its own: all of these are made.
    wrong = re.compile(r"maintainers@|mail is not read|in the repository, or an issue|"
                       r"https?://[\w.-]+/[\w.-]*cotan[\w.-]*/|(github|gitlab)\.com/[\w-]+/cotan", re.I)
    for name in tracked(SOURCES):
        file = SOURCES / name
        if file.name != "contact_test.py":
            found = wrong.search(file.read_bytes().decode("utf-8", "replace"))
            assert not found, (name, found[0])
    for manifest in ("bindings/js/package.json", "web/package.json"):
        assert not {"repository", "bugs", "homepage"} & json.loads((SOURCES / manifest).read_text()).keys(), manifest


if __name__ == "__main__":
    for fact in (nobodyIsNamedWhileNobodyPublishes, everythingNamesWhoPublishes, badValuesAreRefused,
                 noFileSendsReadersToAnAddressThatIsNotFilledIn):
        with tempfile.TemporaryDirectory() as place:
            fact(pathlib.Path(place))
        print("holds:", fact.__name__)
