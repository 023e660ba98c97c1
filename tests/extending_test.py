#!/usr/bin/env python3
"""extending_test.py SOURCES: adds a frame, an image format and a shader language to a copy of the sources, each in at
most two places, builds what uses them, and tries them. Prints what does not work."""
import pathlib
import shutil
import subprocess
import sys
import tempfile

SOURCES = pathlib.Path(sys.argv[1])
PROGRAM = r"""
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "cost/scalar_count.hpp"
#include "cotan/frame.hpp"
#include "cotan/image.hpp"
#include "cotan/shader_text.hpp"

using namespace cotan;
namespace text = cotan::shader_text;

static int wrong = 0;
static void expect(bool good, const char* what)
{
    if (!good)
        ++wrong, std::printf("not so: %s\n", what);
}

int main()
{
    const auto frame = frameFromName("planted");
    expect(frame && name(*frame) == "planted" && info(*frame).summary == "a frame of a test", "the frame has a name");
    if (frame) {
        const f32::cotan_frame f = evaluate(*frame, f32::cotan_vec3(0, 0, 1), {2, 0, 0}, {0, 3, 0}, {1, 0}, {0, 1});
        expect(std::abs(f.t.x - 1) < 1e-6f && std::abs(f.b.y - 1) < 1e-6f, "the frame is evaluated");
        for (const text::Language language : text::kLanguages) {
            const auto made = text::makeShaderText({.language = language, .frame = *frame});
            expect(made && made->text.find("cotan_frame_planted") != std::string::npos, "the frame is printed");
        }
        const int operations = cost::operationsOfRow("planted").total();
        expect(operations > 0 && operations == cost::operationsOfRow("unit").total(), "the frame's cost is counted");
    }
    const auto language = text::languageFromName("slang");
    expect(bool(language) && text::languageNames().find("slang") != std::string::npos, "the language has a name");
    if (language) {
        const auto made = text::makeShaderText({.language = *language, .frame = Frame::cotangent});
        expect(made && made->text.find("for Slang.") != std::string::npos, "the language is named on top");
        expect(made && made->text.find("float3 cotan_perturb_normal(") != std::string::npos, "its words are used");
        expect(made && made->text.find("normal_map.Sample(uv).xyz") != std::string::npos, "its sampling is shown");
    }
    const auto back = readImage(std::filesystem::path(__FILE__).parent_path() / "two.ppm");
    expect(bool(back), back ? "" : back.error().message.c_str());
    const unsigned char expected[] = {10, 20, 30, 255, 40, 50, 60, 255};
    expect(back && back->width == 2 && back->height == 1 && back->data.size() == sizeof expected
               && std::memcmp(back->data.data(), expected, sizeof expected) == 0,
           "the image is read");
    return wrong;
}
"""


def replace(file, before, after):
    text = file.read_text()
    if text.count(before) != 1:
        sys.exit(f"{file.relative_to(copy)}: expected once: {before}; found {text.count(before)} times")
    file.write_text(text.replace(before, after))


def add_frame():
    table, forms = copy / "src/core/include/cotan/frames.inc", copy / "shaders/cotan/history.h"
    rows = table.read_text()
    last = rows.rindex("COTAN_FRAME_ROW(")
    number = int(rows[last:].split("(")[1].split(",")[0]) + 1
    facts = rows[rows.index("COTAN_FRAME_ROW(7, unit, unit,"):].split('"unit"')[0].split("unit, unit,")[1]
    end = rows.index("#undef COTAN_FRAME_ROW")
    table.write_text(f'{rows[:end]}COTAN_FRAME_ROW({number}, planted, planted,{facts}"planted", "a frame of a test")\n{rows[end:]}')
    text = forms.read_text()
    begin = text.index("COTAN_FUNCTION cotan_frame cotan_frame_unit(")
    function = text[begin:text.index("\n}\n", begin) + 3]
    forms.write_text(text.replace(function, function + "\n" + function.replace("frame_unit", "frame_planted")))
    return [table, forms]


def add_language():
    names, table = copy / "src/shader_text/include/cotan/shader_text.hpp", copy / "src/shader_text/languages.cpp"
    replace(names, "};\ninline constexpr Language kLanguages[] = {", "    slang,\n};\ninline constexpr Language kLanguages[] = {")
    replace(names, "Language::cpp,  Language::godot};", "Language::cpp,  Language::godot, Language::slang};")
    replace(table, "};\nstatic_assert(std::size(kInfos)", """
    {.name = "slang",
     .title = "Slang",
     .sample = "normal_map.Sample(uv).xyz",
     .halfs = kHlslHalfs,
     .grammar = {.words = &Word::hlsl}},
};\nstatic_assert(std::size(kInfos)""")
    return [names, table]


def add_format():
    table = copy / "src/image/format_table.hpp"
    text = table.read_text()
    formats = int(text.split("std::array<ImageFormat, ")[1].split(">")[0])
    text = text.replace(f"std::array<ImageFormat, {formats}>", f"std::array<ImageFormat, {formats + 1}>")
    starts = int(text.split("std::array<ImageStart, ")[1].split(">")[0])
    text = text.replace(f"std::array<ImageStart, {starts}>", f"std::array<ImageStart, {starts + 1}>")
    table.write_text(text)
    replace(table, 'Format("TGA",', 'Format("PPM", {".ppm"}, "", "pnm", {&Format::reads}),\n        Format("TGA",')
    replace(table, '{{{"PNG",', '{{{"PPM", "P6"sv}, {"PNG",')
    return [table]


with tempfile.TemporaryDirectory() as folder:
    copy = pathlib.Path(folder) / "cotan"
    for name in ("CMakeLists.txt", "CITATION.cff", "cmake", "scripts", "src", "shaders", "apps"):
        source = SOURCES / name
        shutil.copytree(source, copy / name) if source.is_dir() else (copy.mkdir(exist_ok=True), shutil.copy(source, copy))
    for add in (add_frame, add_language, add_format):
        touched = add()
        if len(touched) > 2:
            sys.exit(f"{add.__name__}: touches {len(touched)} places")
    (copy / "added.cpp").write_text(PROGRAM)
    (copy / "two.ppm").write_bytes(b"P6\n2 1\n255\n" + bytes([10, 20, 30, 40, 50, 60]))
    with open(copy / "CMakeLists.txt", "a") as text:
        text.write("add_executable(added added.cpp apps/lab/cost/scalar_count.cpp)\n"
                   "target_include_directories(added PRIVATE apps/lab shaders)\n"
                   "target_link_libraries(added PRIVATE cotan_image cotan_shader_text cotan_core)\n")
    build = pathlib.Path(folder) / "build"
    options = ["-DCMAKE_BUILD_TYPE=Debug", "-DCMAKE_CXX_FLAGS_DEBUG=-O0", "-DCOTAN_TESTS=OFF", "-DCOTAN_INSTALL=OFF"]
    def run(command):
        done = subprocess.run(command, capture_output=True, text=True)
        if done.returncode:
            print(done.stdout[-6000:], done.stderr[-3000:], sep="\n")
            sys.exit(f"{command[0]}: exit code {done.returncode}")

    run(["cmake", "-G", "Ninja", "-S", copy, "-B", build, *options])
    run(["cmake", "--build", build, "--target", "added"])
    # The frame's pixel shader, by its own command: as a target it would build the renderer first. There is none if no
    # shader compiler is installed.
    pixel_shader = "apps/lab/cost/frame_planted.h"
    if f"{pixel_shader}:" in (build / "build.ninja").read_text().replace(" ", ":"):
        done = subprocess.run(["ninja", "-C", build, "-t", "commands", "-s", pixel_shader], capture_output=True, text=True, check=True)
        run(["sh", "-c", f"cd '{build}' && {done.stdout.splitlines()[-1]}"])
        if not (build / pixel_shader).is_file():
            sys.exit(f"{pixel_shader} was not made by: {done.stdout}")
    run([build / "added"])
    print("a frame, an image format and a shader language are added by two places each")
