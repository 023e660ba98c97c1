"""One build that holds many mistakes beside what is right; the variable COTAN_MUTANT chooses one when a program runs."""
import os
import pathlib
import re
import resource
import signal
import subprocess
import tempfile
import threading

HOME = pathlib.Path(__file__).resolve().parents[2]
WORK = HOME / "build" / "mutants"
SOURCE, BUILD, PORTABLE = WORK / "source", WORK / "build", WORK / "portable"

HEADER = """#pragma once
#include <cstdlib>
#include <type_traits>
inline const int cotanChosenMutant = std::getenv("COTAN_MUTANT") ? std::atoi(std::getenv("COTAN_MUTANT")) : 0;
constexpr bool cotan_mutant(int number) { return !std::is_constant_evaluated() && number == cotanChosenMutant; }
"""


def write_if_changed(path, data):
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_bytes() != data:
        path.write_bytes(data)


def copy_sources(texts):
    """The tree below SOURCE; the files of `texts` (name: text with its mistakes) in their place."""
    listed = subprocess.run(["git", "-C", HOME, "ls-files", "-co", "--exclude-standard"], check=True, capture_output=True, text=True)
    for name in listed.stdout.splitlines():
        data = (HOME / name).read_bytes() if (HOME / name).is_file() else None
        if data is None:
            continue
        portable = name.startswith("shaders/cotan/")
        if name in texts and portable:
            write_if_changed(PORTABLE / name[len("shaders/"):], texts[name].encode())
        elif name in texts:
            data = ('#include "cotan_mutant.hpp"\n' + texts[name]).encode()
        elif portable:
            (PORTABLE / name[len("shaders/"):]).unlink(missing_ok=True)
        elif name.endswith((".cpp", ".hpp")) and b'"cotan/portable_text.inc"' in data:
            data = b'#include "cotan_mutant.hpp"\n' + data
        elif name.startswith("tests/") and name.endswith(".cmake"):
            # The tool is built for the parts that ask for it.
            data = re.sub(rb"add_dependencies\((\w+)((?: \w+)*) cotan\)", lambda m: b"add_dependencies(" + m[1] + m[2] + b")" if m[2] else b"", data)
        write_if_changed(SOURCE / name, data)
        if os.access(HOME / name, os.X_OK):
            (SOURCE / name).chmod(0o755)
    write_if_changed(PORTABLE / "cotan_mutant.hpp", HEADER.encode())
    shared = WORK / "shared"
    if not shared.exists() and (HOME.parent / "shared").exists():
        shared.symlink_to(HOME.parent / "shared")


def configure():
    subprocess.run(["cmake", "-S", SOURCE, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
                    "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1", f"-DCMAKE_CXX_FLAGS=-w -iquote {PORTABLE}",
                    "-DCOTAN_WARNINGS_AS_ERRORS=OFF"], check=True, stdout=subprocess.DEVNULL)


def build(targets, jobs, go_on=False):
    """Exit code and output of the build; go_on: past what does not compile."""
    command = ["cmake", "--build", BUILD, "-j", str(jobs), "--target", *sorted(targets)] + (["--", "-k", "0"] if go_on else [])
    done = subprocess.run(command, stdout=subprocess.PIPE if go_on else None, stderr=subprocess.STDOUT if go_on else None, text=True)
    return done.returncode, done.stdout or ""


def command_of(program):
    """How a word of a list of tests is run: PROGRAM[:FILTER], python:FILE of tests/python, or c_api."""
    name, _, chosen = program.partition(":")
    if name == "python":
        return ["/usr/bin/python3", "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", HOME / f"tests/python/test_{chosen}.py"]
    if name == "c_api":
        return ["/usr/bin/python3", HOME / "tests/c_api_test.py", library(), HOME / "src/c/cotan.map"]
    return [BUILD / "tests" / name, "--gtest_fail_fast", "--gtest_brief=1"] + ([f"--gtest_filter={chosen}"] if chosen else [])


def library():
    return next(iter(sorted(BUILD.glob("**/libcotan.so*"))), BUILD / "libcotan.so")


def targets_of(program):
    name = program.partition(":")[0]
    return {"python": {"cotan_c", "cotan"}, "c_api": {"cotan_c"}}.get(name, {name})


def run(program, number, seconds, python=None, command=None):
    """What became of a test program, None where it passed, otherwise a word; and the processor's seconds."""
    limit = max(1, round(seconds))
    environment = dict(os.environ, COTAN_MUTANT=str(number), COTAN_LIBRARY=str(library()), COTAN_TOOL=str(BUILD / "bin/cotan"),
                       COTAN_SHARED_DATA=str(HOME.parent / "shared/data"), PYTHONDONTWRITEBYTECODE="1",
                       PYTHONPATH=str(python or HOME / "bindings/python"))
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen(command or command_of(program), cwd=BUILD / "tests", stdout=output, stderr=subprocess.DEVNULL,
                                   env=environment,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1)))
        hangs = threading.Timer(30 * limit, process.kill)  # what waits without using the processor
        hangs.start()
        _, status, usage = os.wait4(process.pid, 0)
        hangs.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        output.seek(0)
        text = output.read()
    took = usage.ru_utime + usage.ru_stime
    if process.returncode in (0, 77):
        return None, took
    if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return "does not end", took
    failed = re.search(rb"\[  FAILED  \] (\S+)|FAILED (\S+)", text)
    return (failed[1] or failed[2]).decode().rstrip(",") if failed else f"ends with {process.returncode}", took


def try_mistake(number, programs, limit, python=None):
    """The word of the first program that notices, or None; and the seconds that all took."""
    spent = 0.0
    for program in programs:
        if spent >= limit:
            break
        outcome, took = run(program, number, limit - spent, python)
        spent += took
        if outcome:
            return outcome, spent
    return None, spent
