"""The file of hosted CI is valid, and names what exists: python3 hosted_ci_test.py [CASE]. Exit code 77: no PyYAML."""

import os
import pathlib
import re
import sys

try:
    import yaml
except ImportError:
    print("skipped: PyYAML is missing (python3-yaml)")
    sys.exit(77)

HOME = pathlib.Path(__file__).resolve().parents[1]
FILE = HOME / ".github/workflows/ci.yml"
ROOT = yaml.safe_load(FILE.read_text(encoding="utf-8"))
STEPS = [step for job in ROOT["jobs"].values() for step in job["steps"]]


def file_has_the_keys_of_a_workflow():
    # YAML 1.1 reads the key `on` as true.
    assert set(ROOT) == {"name", True, "jobs"}, set(ROOT)
    for job in ROOT["jobs"].values():
        assert set(job) <= {"runs-on", "timeout-minutes", "strategy", "container", "steps"}, set(job)
        for step in job["steps"]:
            assert set(step) <= {"name", "run", "uses"} and ("run" in step) != ("uses" in step), step


def no_action_but_checkout_is_used():
    used = [step["uses"] for step in STEPS if "uses" in step]
    assert used and all(re.fullmatch(r"actions/checkout@v\d+", name) for name in used), used


def every_script_exists_and_both_are_run():
    words = [line.split()[0] for step in STEPS for line in step.get("run", "").splitlines() if line.strip()]
    scripts = [word for word in words if "/" in word]
    assert {"./run-demo", "./run-tests"} <= set(scripts), scripts
    for script in scripts:
        assert os.access(HOME / script, os.X_OK), script
    assert set(words) - set(scripts) <= {"apt-get", "git"}, words


def systems_are_those_that_setup_supports():
    job = ROOT["jobs"]["debian"]
    suites = job["strategy"]["matrix"]["suite"]
    assert job["container"] == "debian:${{ matrix.suite }}" and suites == ["bookworm", "trixie"], job
    accepted = re.search(r'case "\$suite" in (.*?)\)', (HOME / "scripts/try-suite").read_text(encoding="utf-8")).group(1)
    assert set(suites) <= set(accepted.split(" | ")), accepted
    assert "Debian 12 and 13" in (HOME / "scripts/setup").read_text(encoding="utf-8")


CASES = (file_has_the_keys_of_a_workflow, no_action_but_checkout_is_used, every_script_exists_and_both_are_run,
         systems_are_those_that_setup_supports)
for case in CASES:
    if sys.argv[1:] in ([], [case.__name__]):
        case()
        print("holds:", case.__name__)
