"""Shared fixtures of the Python tests. CTest runs them (tests/python.cmake) and passes the paths of the library and the
command line in environment variables."""

import os
import pathlib
import subprocess

import pytest


@pytest.fixture(scope="session")
def source():
    """Path of the repository."""
    return pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture(scope="session")
def command():
    """Runs the command line: command("map", "detect", file). Returns its standard output."""
    tool = os.environ.get("COTAN_TOOL")
    if not tool or not os.path.exists(tool):
        pytest.skip("skipped: COTAN_TOOL names no cotan")

    def run(*words):
        done = subprocess.run([tool, *map(str, words)], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run


@pytest.fixture(scope="session")
def data(source):
    """data(name): a file that the repository does not contain; the test is skipped if it is missing. The rule is that of
    dataFile in tests/test_data.hpp."""

    def find(name):
        shared = source.parent / "shared/data" / name
        both = os.environ.get("COTAN_TEST_DATA") != "fetched"
        file = shared if both and shared.exists() else source / "build/data" / name
        if not file.exists():
            pytest.skip(f"skipped: {name} is missing: run scripts/test-data")
        return file

    return find


def pytest_unconfigure(config):
    """For CTest: exits with 77 and the reason as the last line if all tests were skipped."""
    reporter = config.pluginmanager.get_plugin("terminalreporter")
    skipped = reporter.stats.get("skipped", []) if reporter else []
    if skipped and not any(reporter.stats.get(kind) for kind in ("passed", "failed", "error")):
        print(f"skipped: {skipped[0].longrepr[2].split('skipped: ')[-1]}", flush=True)
        os._exit(77)
