"""Declarations for ctypes against those of cotan.h: a wrong offset would still read a number."""

import ctypes
import re
import subprocess

import pytest

import cotan
from cotan import _structs, errors
from cotan._library import API_VERSION, library


@pytest.fixture(scope="module")
def header(source):
    return (source / "src/c/include/cotan.h").read_text()


def test_every_struct_has_the_layout_of_a_c_compiler(source, header, tmp_path):
    named = set(re.findall(r"^typedef struct (cotan_\w+) \{", header, re.M))
    assert named == set(_structs.STRUCTS)
    lines = []
    for name, struct in _structs.STRUCTS.items():
        lines.append(f'printf("{name} %zu\\n", sizeof({name}));')
        for field, *_ in struct._fields_:
            lines.append(f'printf("{name}.{field} %zu %zu\\n", offsetof({name}, {field}), sizeof((({name}*)0)->{field}));')
    program = tmp_path / "layout.c"
    program.write_text("#include <stdio.h>\n#include <cotan.h>\nint main(void)\n{\n" + "\n".join(lines) + "\nreturn 0;\n}\n")
    subprocess.run(["cc", program, "-I", source / "src/c/include", "-o", tmp_path / "layout"], check=True)
    printed = subprocess.run([tmp_path / "layout"], check=True, capture_output=True, text=True).stdout.split("\n")
    expected = []
    for name, struct in _structs.STRUCTS.items():
        expected.append(f"{name} {ctypes.sizeof(struct)}")
        for field, *_ in struct._fields_:
            at = getattr(struct, field)
            expected.append(f"{name}.{field} {at.offset} {at.size}")
    assert printed[:-1] == expected


def test_every_member_of_the_header_is_declared(header):
    for name, struct in _structs.STRUCTS.items():
        body = re.search(rf"^typedef struct {name} \{{(.*?)^\}}", header, re.M | re.S)[1]
        body = re.sub(r"/\*.*?\*/", "", body, flags=re.S)
        members = [m for line in re.findall(r"([^;]+);", body) for m in _members(line)]
        assert members == [field for field, *_ in struct._fields_], name


def _members(declaration):
    function = re.search(r"\(\*(\w+)\)", declaration)
    if function:
        return [function[1]]
    return [re.search(r"(\w+)\s*(?:\[\d+\])?$", part.strip())[1] for part in declaration.split(",")]


def _kind_of(parameter):
    """The ctypes kind of a parameter in the header: its size, and whether it is a number, a text or a pointer."""
    parameter = parameter.strip()
    if "char*" in parameter and "char* const*" not in parameter:
        return "text"
    if "*" in parameter or re.match(r"cotan_(take|progress)", parameter):
        return "pointer"
    return re.sub(r"\s*\w+$", "", parameter)


def _kind_in_python(kind):
    names = {ctypes.c_int: "int", ctypes.c_size_t: "size_t", ctypes.c_double: "double", ctypes.c_char_p: "text"}
    return names.get(kind, "pointer")


def test_every_function_has_the_parameters_of_the_header(header):
    plain = re.sub(r"/\*.*?\*/", "", header, flags=re.S)
    found = dict(re.findall(r"^[a-z_]+(?: [a-z_]+)?\*? (cotan_\w+)\(([^;]*)\);", plain, re.M))
    assert set(found) == set(_structs.FUNCTIONS)
    for name, parameters in found.items():
        expected = [] if parameters == "void" else [_kind_of(p) for p in parameters.split(",")]
        declared = [_kind_in_python(kind) for kind in _structs.FUNCTIONS[name][1:]]
        # Text outputs are passed as the address of a buffer.
        declared = ["text" if e == "text" and d == "pointer" else d for e, d in zip(expected, declared)] + declared[len(expected) :]
        assert declared == expected, name


def test_versions_equal_those_of_the_library(header, source):
    assert cotan.__version__ == cotan.library_version()
    written = int(re.search(r"#define COTAN_API_VERSION (\d+)", header)[1])
    assert API_VERSION == written == library().cotan_api_version()


def test_every_status_has_its_own_exception(header):
    numbers = {int(n) for n in re.findall(r"^    COTAN_\w+ = (\d+)", header, re.M)} - {0}
    assert numbers == set(errors._OF_STATUS) and len(numbers) == len(set(errors._OF_STATUS.values()))
