"""Rules of test data, and scripts/test-data: python3 test_data_test.py [CASE]. Exit code 77: a case is skipped."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HOME = pathlib.Path(__file__).resolve().parents[1]
# The only files that know both folders.
RULES = {"tests/test_data.hpp", "tests/web/data.mjs", "tests/python/conftest.py", "tests/engines/godot.py", "tests/test_data_test.py"}


def one_rule_finds_all_data():
    for file in sorted((HOME / "tests").rglob("*")):
        name = str(file.relative_to(HOME))
        if file.suffix not in (".cpp", ".hpp", ".py", ".mjs", ".js", ".cmake", ".txt", ".in", ".sh") or name in RULES:
            continue
        text = file.read_text(encoding="utf-8")
        for word in ("SHARED_DATA", "../shared", "shared/data"):
            assert word not in text, f"{name}: {word}; find data by dataFile (tests/test_data.hpp)"


def the_rule_is_the_same_in_javascript_and_python():
    sys.path.insert(0, str(HOME / "tests/python"))
    for wanted in ("", "fetched"):
        environment = {**os.environ, "COTAN_TEST_DATA": wanted}
        for name in ("models", "found", "nothing/of-this-name"):
            shared = HOME.parent / "shared/data" / name
            expected = shared if wanted == "" and shared.exists() else HOME / "build/data" / name
            code = f"import {{dataFile}} from {json.dumps('file://' + str(HOME / 'tests/web/data.mjs'))}; console.log(dataFile({json.dumps(name)}))"
            found = subprocess.run(["node", "--input-type=module", "-e", code], env=environment, check=True,
                                   capture_output=True, text=True).stdout.strip()
            assert pathlib.Path(found).resolve() == expected.resolve(), (name, found, expected)
    text = (HOME / "tests/python/conftest.py").read_text(encoding="utf-8")
    assert 'os.environ.get("COTAN_TEST_DATA") != "fetched"' in text and 'source / "build/data" / name' in text
    text = (HOME / "tests/engines/godot.py").read_text(encoding="utf-8")
    assert 'os.environ.get("COTAN_TEST_DATA") != "fetched"' in text and 'ROOT / "build/data" / name' in text


def without_network_one_line_says_so_and_the_rest_is_made():
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place) / "data"
        environment = {**os.environ, "npm_config_registry": "http://127.0.0.1:9/", "npm_config_cache": place + "/cache",
                       "npm_config_fetch_retry_mintimeout": "10"}
        done = subprocess.run([HOME / "scripts/test-data", folder], env=environment, capture_output=True, text=True)
        assert done.returncode == 3, done.stderr
        assert re.fullmatch(r"test-data: not complete, tests that need the rest are skipped: .+\n", done.stderr), done.stderr
        assert (folder / "models/BoomBox/BoomBox.gltf").exists() and (folder / "bad/EXPECTED.tsv").exists()
        # A model whose tangents are still missing must not be found.
        assert not (folder / "models/TwoSidedPlane").exists() and not (folder / "unfinished").exists()
        assert not (folder / "made-from").exists(), "the next run tries again"


def what_is_fetched_is_pinned_by_checksums():
    lock = json.loads((HOME / "tests/test_data/package-lock.json").read_text(encoding="utf-8"))["packages"]
    for name, version in lock[""]["dependencies"].items():
        assert re.fullmatch(r"\d+\.\d+\.\d+", version), f"{name}: {version}"
        assert lock[f"node_modules/{name}"]["integrity"].startswith("sha512-"), name
    for line in (HOME / "tests/test_data/debian.sha256").read_text(encoding="utf-8").splitlines():
        assert re.fullmatch(r"[0-9a-f]{64}  [^/].*", line), line
    licences = (HOME / "docs/project/licences.md").read_text(encoding="utf-8")
    for name in ("@pmndrs/assets", "draco3d", "assimp-testmodels"):
        assert name in licences, f"docs/project/licences.md does not say what is fetched of {name}"


def the_data_are_complete():
    folder = HOME / "build/data"
    if not (folder / "made-from").exists():
        print("skipped: build/data is not complete: run scripts/test-data")
        sys.exit(77)
    for line in (HOME / "tests/test_data/originals.sha256").read_text(encoding="utf-8").splitlines():
        name = line.split("  ")[1]
        # Maps of which no test has a number are not made again.
        assert (folder / name).exists() or name.startswith("textures/"), f"nothing takes the place of {name}"
    for name in ("bad", "found"):
        rows = [line.split("\t") for line in (folder / name / "EXPECTED.tsv").read_text(encoding="utf-8").splitlines()
                if not line.startswith("#")]
        assert len(rows) >= 12, name
        for row in rows:
            assert (folder / name / row[0]).exists() and row[1] in ("reject", "accept", "warn", "either"), row


CASES = {case.__name__: case for case in (
    one_rule_finds_all_data, the_rule_is_the_same_in_javascript_and_python,
    without_network_one_line_says_so_and_the_rest_is_made, what_is_fetched_is_pinned_by_checksums, the_data_are_complete)}
for wanted in sys.argv[1:] or CASES:
    CASES[wanted]()
    print("holds:", wanted)
