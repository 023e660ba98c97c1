#!/usr/bin/env python3
"""Compiles the GLSL of docs/how-to/beyond.md with what `cotan shader` prints: page_snippets_test.py TOOL PAGE

Each block is the body of a shader of its own, or functions. Names that a block does not declare are those of the page's
first lines, of its earlier blocks, or inputs of the reader's program. Exit code 77 if glslangValidator is missing.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SETS = "gradient,space,mapping,parallax,blend,light"
INPUTS = """#version 450
layout(location = 0) in vec3 n;
layout(location = 1) in vec3 position;
layout(location = 2) in vec3 to_eye;
layout(location = 3) in vec3 to_light;
layout(location = 4) in vec3 p;
layout(location = 5) in vec2 uv;
layout(location = 6) in vec2 uv2;
layout(binding = 0) uniform sampler2D height_map;
layout(binding = 1) uniform sampler2D normal_map;
layout(binding = 2) uniform sampler2D decal_map;
layout(binding = 3) uniform sampler2D detail_map;
layout(binding = 4) uniform sampler2D map;
layout(binding = 5) uniform sampler2D decal_colour_map;
layout(binding = 6) uniform Inputs {
    mat4 clip_from_position;
    vec3 x, y, z, box_centre, ray, l, v;
    vec2 wind;
    float w, h, deep, depth, opacity, strength, r, time;
};
layout(location = 0) out vec4 color;
"""
# What the page declares before, or the reader has.
EARLIER = {
    "f": "cotan_frame f = cotan_frame_gradient(n, dFdx(position), dFdy(position), dFdx(uv), dFdy(uv));",
    "texel": "vec3 texel = texture(normal_map, uv).xyz;",
    "f2": "cotan_frame f2 = cotan_frame_gradient(n, dFdx(position), dFdy(position), dFdx(uv2), dFdy(uv2));",
    "unit": "float unit = 2.0;",
    "unit2": "float unit2 = 2.0;",
    "slope": "vec2 slope = vec2(0.1);",
    "below": "vec3 below = cotan_gradient_of_slope(f, vec2(0.1));",
    "cotan_relief_distance": "cotan_relief r = cotan_relief_start(f, to_eye, uv, depth, 16.0);",
    "dx": "vec2 dx = dFdx(uv);",
    "dy": "vec2 dy = dFdy(uv);",
    "normal": "vec3 normal = n;",
    "alpha": "float alpha = opacity;",
    "roughness": "float roughness = opacity;",
    "mean_texel": "vec3 mean_texel = vec3(0.5);",
    "filtered_texel": "vec3 filtered_texel = vec3(0.5);",
}


def compiled(source):
    """The compiler's output if it fails, else nothing."""
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder, "snippet.frag")
        file.write_text(source)
        run = subprocess.run(["glslangValidator", "-V", file, "-o", file.with_suffix(".spv")], capture_output=True, text=True)
        return run.stdout if run.returncode else ""


def main():
    if not shutil.which("glslangValidator"):
        print("skipped: there is no glslangValidator")
        return 77
    tool, page = sys.argv[1:]
    words = [tool, "shader", "--lang", "glsl", "--frame", "gradient", "--form", "total", "--set", SETS]
    text = subprocess.run(words, capture_output=True, text=True, check=True).stdout
    functions, failed = "", 0
    blocks = re.findall(r"```glsl\n(.*?)```", pathlib.Path(page).read_text(), re.S)
    for block in blocks:
        if re.match(r"\w+ \w+\([^)]*\)[^\n;]*\n\{", block):  # a function, which later blocks may call
            functions += block
            why = compiled(INPUTS + text + functions + "void main() { color = vec4(1.0); }\n")
        else:
            missing = []
            for name, line in EARLIER.items():  # `below` needs f
                used = block + "".join(line for other, line in EARLIER.items() if re.search(rf"\b{other}\b", block))
                if re.search(rf"\b{name}\b", used) and not re.search(rf"(\w+ |, ){name} =", block):
                    missing.append(line)
            body = "\n".join(missing) + "\n{\n" + block + "}\ncolor = vec4(1.0);"
            why = compiled(INPUTS + text + functions + "void main()\n{\n" + body + "\n}\n")
        if why:
            failed += 1
            print(block, why, sep="\n")
    print(f"{len(blocks)} blocks, {failed} do not compile")
    return 1 if failed or len(blocks) < 10 else 0


sys.exit(main())
