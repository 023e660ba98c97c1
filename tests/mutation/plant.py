"""One build that holds the correct code and many mistakes; COTAN_MUTANT chooses one at run time."""
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
SIZE = 4096  # maximum number of mistakes, with a byte each that tells whether a test program reaches it
SOURCE, BUILD, PORTABLE = WORK / "source", WORK / "build", WORK / "portable"

HEADER = """#pragma once
#include <cstdlib>
#include <type_traits>
// Declared here under other names, so that no name of the system's headers meets one of the sources.
extern "C" int cotan_mutant_open(const char*, int, ...) __asm__("open");
extern "C" void* cotan_mutant_map(void*, unsigned long, int, int, int, long) __asm__("mmap");
inline const int cotanChosenMutant = std::getenv("COTAN_MUTANT") ? std::atoi(std::getenv("COTAN_MUTANT")) : 0;
inline unsigned char* const cotanReachedMutants = [] {
    const char* name = std::getenv("COTAN_MUTANTS_REACHED");
    const int file = name ? cotan_mutant_open(name, 02000002) : -1;  // to read and write, and not for children
    void* bytes = file < 0 ? nullptr : cotan_mutant_map(nullptr, @SIZE@, 3, 1, file, 0);  // both, shared
    return bytes == reinterpret_cast<void*>(-1) ? nullptr : static_cast<unsigned char*>(bytes);
}();
inline bool cotan_mutant_now(int number) {
    if (cotanReachedMutants) {
        cotanReachedMutants[number] = 1;
    }
    return number == cotanChosenMutant;
}
constexpr bool cotan_mutant(int number) { return !std::is_constant_evaluated() && cotan_mutant_now(number); }
""".replace("@SIZE@", str(SIZE))


def write_if_changed(path, data):
    path.parent.mkdir(parents=True, exist_ok=True)
    if not path.exists() or path.read_bytes() != data:
        path.write_bytes(data)


def copy_sources(texts):
    """Copies the tree to SOURCE; the files of `texts` (name: text with its mistakes) replace the originals."""
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
            # The tool is built only for parts that need it.
            data = re.sub(rb"add_dependencies\((\w+)((?: \w+)*) cotan\)", lambda m: b"add_dependencies(" + m[1] + m[2] + b")" if m[2] else b"", data)
        if name == "tests/CMakeLists.txt":
            data = data.replace(b"add_executable(${name} ${TEST_SOURCES})", b"add_executable(${name} ${TEST_SOURCES} mutation/reached.cpp)")
        write_if_changed(SOURCE / name, data)
        if os.access(HOME / name, os.X_OK):
            (SOURCE / name).chmod(0o755)
    write_if_changed(PORTABLE / "cotan_mutant.hpp", HEADER.encode())
    shared = WORK / "shared"
    if not shared.exists() and (HOME.parent / "shared").exists():
        shared.symlink_to(HOME.parent / "shared")


def configure():
    subprocess.run(["cmake", "-S", SOURCE, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
                    "-DCMAKE_CXX_FLAGS_RELWITHDEBINFO=-O1", f"-DCMAKE_CXX_FLAGS=-w -fpermissive -Wno-narrowing -iquote {PORTABLE}",
                    "-DCOTAN_WARNINGS_AS_ERRORS=OFF", "-DCOTAN_UNITY=ON"], check=True, stdout=subprocess.DEVNULL)


def build(targets, jobs, go_on=False):
    """Exit code and output of the build; go_on: continues after compile errors."""
    command = ["cmake", "--build", BUILD, "-j", str(jobs), "--target", *sorted(targets)] + (["--", "-k", "0"] if go_on else [])
    done = subprocess.run(command, stdout=subprocess.PIPE if go_on else None, stderr=subprocess.STDOUT if go_on else None, text=True)
    return done.returncode, done.stdout or ""


def command_of(program):
    """Command for an entry of a test list: PROGRAM[:FILTER], python:FILE of tests/python, c_api, or an output check."""
    name, _, chosen = program.partition(":")
    if name == "python":
        return ["/usr/bin/python3", "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", HOME / f"tests/python/test_{chosen}.py"]
    if name == "c_api":
        return ["/usr/bin/python3", HOME / "tests/c_api_test.py", library(), HOME / "src/c/cotan.map"]
    if name == "output_bytes":
        return ["/usr/bin/python3", HOME / "tests/output_bytes.py", BUILD / "bin/cotan", HOME / f"tests/output_bytes/{chosen}.txt", "--first"]
    if name == "option_effects":
        return ["/usr/bin/python3", HOME / "tests/option_effects_test.py", BUILD / "bin/cotan", chosen]
    if name == "file_fields":
        return ["/usr/bin/python3", HOME / "tests/file_fields_test.py"]
    if name == "two_renderers":
        return ["/usr/bin/python3", HOME / "tests/two_renderers_test.py", BUILD / "bin/cotan", HOME / "tests/output_bytes/pictures.txt"]
    if name == "json_fields":
        return ["/usr/bin/python3", HOME / "tests/json_fields_test.py", BUILD / "bin/cotan",
                HOME / "docs/reference/json.md"]
    if name == "help_files":
        return ["/usr/bin/python3", HOME / "tests/help_files_test.py", BUILD / "bin/cotan", "-", chosen]
    if name == "command_line":
        return [HOME / "docs/reference/make-command-line", BUILD / "bin/cotan", BUILD / "share", "--check"]
    return [BUILD / "tests" / name, "--gtest_brief=1", "--gtest_fail_fast"] + ([f"--gtest_filter={chosen}"] if chosen else [])


def library():
    return next(iter(sorted(BUILD.glob("**/libcotan.so*"))), BUILD / "libcotan.so")


SCRIPTS = {"python": {"cotan_c", "cotan"}, "c_api": {"cotan_c"}, "output_bytes": {"cotan", "cotan_lab"}, "option_effects": {"cotan", "cotan_lab"}, "two_renderers": {"cotan"}, "file_fields": {"cotan_c"}, "json_fields": {"cotan"},
           "command_line": {"cotan"}, "help_files": {"cotan"}}


def targets_of(program):
    name = program.partition(":")[0]
    return SCRIPTS.get(name, {name})


def run(program, number, seconds, python=None, command=None, reached=None):
    """Outcome of a test program (None if it passed, otherwise a word) and its CPU seconds. reached: a file of SIZE
    bytes; the byte of each mistake that the program reaches becomes 1. A file beside it gets a line per test."""
    limit = max(1, round(seconds))
    environment = dict(os.environ, COTAN_MUTANT=str(number), COTAN_LIBRARY=str(library()), COTAN_TOOL=str(BUILD / "bin/cotan"),
                       PYTHONDONTWRITEBYTECODE="1", PYTHONPATH=str(python or HOME / "bindings/python"))
    if reached:
        environment["COTAN_MUTANTS_REACHED"] = str(reached)
    with tempfile.TemporaryFile() as output, tempfile.TemporaryDirectory() as folder:
        environment["TMPDIR"] = environment["TEST_TMPDIR"] = folder
        process = subprocess.Popen(command or command_of(program), cwd=BUILD / "tests", stdout=output, stderr=subprocess.DEVNULL,
                                   env=environment, start_new_session=True,
                                   preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 1)))
        waited = []
        hangs = threading.Timer(max(10 * limit, 180), lambda: (waited.append(True), process.kill()))  # waits use no CPU
        hangs.start()
        _, status, usage = os.wait4(process.pid, 0)
        hangs.cancel()
        process.returncode = os.waitstatus_to_exitcode(status)
        try:
            os.killpg(process.pid, signal.SIGKILL)  # children that are still running
        except ProcessLookupError:
            pass
        output.seek(0)
        text = output.read()
    took = usage.ru_utime + usage.ru_stime
    if process.returncode in (0, 77):
        return None, took
    if waited:
        return "waits for ever", took
    if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return "does not end", took
    failed = re.search(rb"\[  FAILED  \] (\S+)|FAILED (\S+)", text)
    return (failed[1] or failed[2]).decode().rstrip(",") if failed else f"{program.partition(':')[0]} ends with {process.returncode}", took


def reach(program, seconds):
    """Runs a program without a mistake. Returns name, seconds and numbers of reached mistakes for each test that passes
    (a script is one test named \"\"), the total seconds, and the outcome."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "reached"
        file.write_bytes(bytes(SIZE))
        command = command_of(program)
        if program.partition(":")[0] not in SCRIPTS:
            command = [c for c in command if c != "--gtest_fail_fast"]
        outcome, took = run(program, 0, seconds, command=command, reached=file)
        if not file.with_suffix(".tests").exists():
            here = {i for i, byte in enumerate(file.read_bytes()) if byte}
            return ([] if outcome else [("", took, here)]), took, outcome
        tests = []
        for line in file.with_suffix(".tests").read_text().splitlines():
            name, passed, milliseconds, numbers = line.split("\t")
            if passed == "1":
                tests.append((name, int(milliseconds) / 1000, {int(n) for n in numbers.split()}))
        return tests, took, outcome


def try_mistake(number, programs, limit, python=None):
    """The outcome of the first program that notices, or None, and the total seconds. programs: each with its limit."""
    spent = 0.0
    for program, most in programs:
        if spent >= limit:
            break
        outcome, took = run(program, number, min(most, limit - spent), python)
        if outcome == "does not end" and limit - spent < most:
            outcome = None  # stopped by the shared limit, not by its own
        spent += took
        if outcome:
            return outcome, spent
    return None, spent
