#!/usr/bin/env python3
"""one_way_test.py SOURCES FACT: some things are done in one way everywhere in src and apps. Prints each line that does
them in another way. Exceptions name their file, a part of their line, and the reason; unused ones are wrong, too."""
import pathlib
import re
import sys

ROOT = pathlib.Path(sys.argv[1])
CODE = (".cpp", ".hpp", ".h", ".inc", ".c")
wrong = []


def code_lines():
    """(file, number, line) of all code; comments are left out, texts are kept."""
    for top in ("src", "apps"):
        for path in sorted((ROOT / top).rglob("*")):
            if path.suffix in CODE and path.is_file():
                for number, line in enumerate(path.read_text().split("\n"), 1):
                    yield str(path.relative_to(ROOT)), number, re.sub(r'("(?:\\.|[^"\\])*")|//.*', lambda m: m[1] or "", line)


def only(pattern, instead, exceptions):
    """Expects the pattern nowhere but in the exceptions: (file, part of the line, reason)."""
    used, pattern = set(), re.compile(pattern)
    for name, number, line in code_lines():
        for found in pattern.finditer(line):
            known = [e for e in exceptions if e[0] == name and e[1] in line]
            used.update(known)
            if not known:
                wrong.append(f"{name}:{number}: {found[0].strip()}: {instead}")
    wrong.extend(f"{name}: '{part}' is an exception that is not there any more" for name, part, _ in set(exceptions) - used)


def filesAreOpenedForWritingByOneFunction():
    """OutputFile::open. An OutputFile is made by begin(), which compares the file with all inputs."""
    only(r'\bofstream|\bfstream\b(?!>)|\bfilebuf|\b(f|fre|fd|_wf?)open\s*\((?!.*"rbe?"\))|\bopenStream\s*\((?!.*"rb"\))|\bO_(WRONLY|RDWR|CREAT|TRUNC|APPEND)\b|\bcreat(64)?\s*\('
         r"|\bmk(o?s)?temp\b|\btmpfile\s*\(|ImageOutput::create\(|\bjpeg_stdio_dest|\bf?truncate(64)?\s*\(|\bresize_file|\bcopy_file"
         r"|\bfs::copy\b|\bfilesystem::copy\b|\brename(at2?)?\s*\(|::(sym)?link(at)?\s*\(|\bcreate_(hard_link|symlink)|\boutput_file\s*\(|\bsendfile|\bsystem\s*\(|\bpopen\s*\(",
         "write through OutputFile (src/files/output.hpp)", [
             ("src/files/output.cpp", '"w+b" : "wb"', "the function"),
             ("src/files/system/system.hpp", "openStream(", "opens for it"),
             ("src/files/system/system_posix.cpp", "openStream(", "likewise"),
             ("src/files/system/system_posix.cpp", "std::fopen(file.c_str(), (", "likewise"),
             ("src/files/system/system_windows.cpp", "openStream(", "likewise"),
             ("src/files/system/system_windows.cpp", "::_wfopen(", "likewise"),
             ("src/files/output.cpp", '"ab"', "a trial on the same temporary file, to learn why a library failed"),
             ("src/files/output.cpp", "fs::rename(part_", "the temporary file appears under its name"),
             ("src/image/oiio_write.cpp", "ImageOutput::create(", "writes to a CheckedFile, which holds an opened OutputFile"),
             ("apps/cotan/batch/file_lock_posix.cpp", "O_RDWR", "opens or makes a file that is locked, and writes nothing"),
             ("src/scene/environment/store_studio.cpp", "std::ofstream file(argv[1]", "a program of the build"),
         ])


def filesAreRemovedByTheirOwners():
    only(r"\bunlink(at)?\s*\(|\bDeleteFile[AW]?\s*\(|\bremove(_all)?\s*\(.*(path|file|work|part)|\brmdir\s*\(", "files that we have not made are not ours to remove", [
        ("src/files/output.cpp", "fs::remove(part_", "its own temporary file"),
        ("src/files/output.cpp", "fs::remove(path", "files that commitTogether has made"),
        ("src/files/output.cpp", "fs::remove(part", "temporary files of a process that has ended"),
        ("src/files/system/signals_posix.cpp", "::unlink(file)", "temporary files, on a signal"),
        ("src/files/system/signals_windows.cpp", "::DeleteFileW(file)", "likewise"),
        ("apps/cotan/batch/store.cpp", "fs::remove_all(", "folders of the store"),
        ("apps/cotan/batch/run.cpp", "fs::remove_all(at->work", "a folder of the store"),
    ])


def filesAreReadByReadersThatNoteThem():
    """readFileBytes, usableFileSize and readText, which call noteInput: an output can only be compared with inputs that are noted."""
    only(r'\bifstream|\b(fopen|openStream)\s*\(.*"rbe?"\)|\b_?O_RDONLY\b|\bopen\s*\([^)]*\.c_str\(\)\s*,\s*0\)|\bmmap\s*\(',
         "read through src/files/bytes.hpp", [
             ("src/files/bytes.cpp", 'openStream(file, "rb")', "the readers"),
             ("src/image/image_parts.cpp", 'openStream(file, "rb")', "openRows has called usableFileSize"),
             ("src/files/sandbox/child_windows.cpp", "_O_RDONLY", "the empty standard input of a child"),
             ("src/files/sandbox/process_posix.cpp", '"/dev/null"', "standard input of a child"),
             ("apps/cotan/batch/digest.cpp", "openStream(path, \"rb\")", "hashes files of jobs, which the batch has noted"),
             ("src/files/system/system_posix.cpp", '"/etc/os-release"', "the system's name"),
             ("src/core/large_array.hpp", "MAP_ANONYMOUS", "memory, not a file"),
         ])


def childProcessesAreAwaitedByOneFunction():
    """waitFor, which says when the system has discarded how a child ended."""
    only(r"\bwait(pid|id|3|4)\s*\(|(?<![\w.>])::wait\s*\(|SIGCHLD|SIGCLD", "wait by waitFor (src/files/children.hpp)", [
        ("src/files/children.hpp", "::wait4(", "the function"),
        ("src/files/system/program_posix.cpp", "::signal(SIGCHLD, SIG_DFL)", "undoes a parent's choice"),
    ])


def nothingDependsOnTheLocale():
    """A host program may have decimal commas, and letters of its own. {fmt}, from_chars and to_chars know no locale."""
    texts = "read texts, no numbers"
    only(r"\bstrto(d|f|ld)\b|\bsto(d|f|ld)\s*\(|\batof\b|\b[vfs]?n?w?scanf\b|\b[vfs]?n?printf\b|\bsetlocale\b|\bstd::locale\b|\bstrftime\b"
         r"|\bput_time\b|stringstream|<(iomanip|iostream|ostream|istream|cctype|ctype\.h|locale|locale\.h|clocale)>|\bimbue\b|\{:[^}\"]*L\}"
         r"|\b(std::|(?<![\w.:>]))(is(alpha|digit|alnum|space|print|upper|lower|xdigit|punct|cntrl|graph)|to(lower|upper))\s*\(",
         "use core/real_number.hpp, core/named_values.hpp or {fmt}", [
             ("src/image/png.cpp", 'snprintf(static_cast<char*>(png_get_error_ptr(png)), kPngMessage, "%s"', "a text"),
             ("src/core/locale_of_c.hpp", "locale.h>", "takes the locale away from libraries"),
             ("src/core/real_from_chars.hpp", "std::strto", "in the locale of C"),
             ("apps/viewer/window/glfw_window.cpp", 'std::setlocale(LC_NUMERIC, "C")', "the opposite: undoes what GTK chooses"),
             ("apps/viewer/window/glfw_window.cpp", "#include <clocale>", "the same"),
             ("src/scene/environment/store_studio.cpp", "std::fprintf(stderr", "a program of the build"),
             ("apps/lab/cost/machine_code.cpp", "strftime(", "digits only"),
             ("apps/viewer/dialog_posix.cpp", "stringstream folders(", texts),
             ("apps/viewer/event.cpp", "stringstream lines(", texts),
             ("apps/viewer/memory.cpp", "stringstream lines(", texts),
             ("apps/viewer/memory.cpp", "stringstream words(", texts),
             ("apps/cotan/common.cpp", "stringstream lines(", texts),
             ("apps/cotan/help/man_page.cpp", "stringstream words(", texts),
             ("apps/cotan/terminal/help_text.cpp", "stringstream words(", texts),
         ])


FACTS = (filesAreOpenedForWritingByOneFunction, filesAreRemovedByTheirOwners, filesAreReadByReadersThatNoteThem,
         childProcessesAreAwaitedByOneFunction, nothingDependsOnTheLocale)
if __name__ == "__main__":
    chosen = [f for f in FACTS if f.__name__ == sys.argv[2]] if len(sys.argv) > 2 else FACTS
    if not chosen:
        sys.exit(f"one_way_test: expected one of {', '.join(f.__name__ for f in FACTS)}; found {sys.argv[2]}")
    for fact in chosen:
        fact()
    if sum(1 for _ in code_lines()) < 50000:
        wrong.append("this test no longer finds the sources")
    print(*wrong, sep="\n", end="\n" if wrong else "")
    sys.exit(bool(wrong))
