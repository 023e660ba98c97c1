#!/usr/bin/env python3
"""header_examples.py SOURCES OUT COMPILER...: every public header begins with an example. Writes all examples to OUT,
as functions that have a scene, a view and arrays of a mesh, and checks that the compiler accepts the file."""
import pathlib
import re
import subprocess
import sys

WITHOUT = {"packed.hpp", "packed_only.hpp", "vector.hpp", "covector.hpp", "portable.hpp", "gpu_meshes.hpp", "result.hpp",
           "triangle.hpp"}  # core headers used by the examples of core.hpp, frame.hpp and tangents.hpp
sources, out = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
headers = sorted(sources.glob("src/*/include/cotan/*.hpp"))
text = ["#include <cstdio>", "#include <memory>", *(f"#include <cotan/{h.name}>" for h in headers),
        "namespace { int fail(const std::string&) { return 2; } cotan::Scene scene; cotan::View view;",
        "std::vector<glm::vec3> positions, normals; std::vector<glm::vec2> texcoords; std::vector<std::uint32_t> indices; }"]
wrong = []
for header in headers:
    comment = re.match(r"(?://[^\n]*\n)+", header.read_text())
    lines = [line[7:] for line in (comment.group().splitlines() if comment else []) if line.startswith("//     ")]
    if not lines:
        if header.name not in WITHOUT:
            wrong.append(f"{header.relative_to(sources)} does not begin with an example")
        continue
    code = "\n".join(lines)
    if "int main(" in code:
        text.append(code.replace("int main(", f"int main_{header.stem}("))
    else:
        text.append(f"int example_{header.stem}()\n{{\n#line 1 \"{header.name}\"\n{code}\n    return 0;\n}}")
out.parent.mkdir(parents=True, exist_ok=True)
out.write_text("\n".join(text) + "\n")
if len(headers) < 20:
    wrong.append("this test no longer finds the headers")
compiled = subprocess.run([*sys.argv[3:], "-std=c++20", "-fsyntax-only", "-Wall", "-Wno-unused", str(out)],
                          capture_output=True, text=True)
if compiled.returncode:
    wrong.append(compiled.stderr)
print(*wrong, sep="\n", end="\n" if wrong else "")
sys.exit(bool(wrong))
