"""What users of Unity and Unreal install: engine_packages_test.py SOURCES TOOL GLSLANG [BUILD].

The engines cannot be run here. glslang compiles every function that they would, with stand-ins for the engines' own, and
with BUILD Microsoft's DXC and FXC compile the same under Wine, as the engines do (tests/direct3d/run; exit code 77: they
cannot run here). The files that describe the packages are checked for what they name."""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

SOURCES, TOOL, GLSLANG = pathlib.Path(sys.argv[1]).resolve(), sys.argv[2], sys.argv[3]
BUILD = sys.argv[4] if len(sys.argv) > 4 else None
HLSL = []  # (text, stage, entry) of all that Microsoft's compilers are to compile

UNITY = """
#define UNITY_EXPORT_REFLECTION
#define TEXTURE2D(name) Texture2D name
#define SAMPLER(name) SamplerState name
#define SAMPLE_TEXTURE2D(map, state, uv) map.Sample(state, uv)
#define CBUFFER_START(name) cbuffer name {
#define CBUFFER_END };
#define TRANSFORM_TEX(uv, name) (uv * name##_ST.xy + name##_ST.zw)
struct Light { float3 direction; float3 color; };
cbuffer Camera { float4x4 toWorld; float4x4 toClip; float3 eye; float3 sun; };
float3 TransformObjectToWorld(float3 p) { return mul(toWorld, float4(p, 1.0)).xyz; }
float3 TransformObjectToWorldNormal(float3 n) { return mul((float3x3)toWorld, n); }
float4 TransformWorldToHClip(float3 p) { return mul(toClip, float4(p, 1.0)); }
float3 GetCameraPositionWS() { return eye; }
float3 UnpackNormal(float4 texel) { return texel.xyz * 2.0 - 1.0; }
Light GetMainLight() { Light l; l.direction = sun; l.color = float3(1.0, 1.0, 1.0); return l; }
"""


def made(script, folder):
    subprocess.run([SOURCES / f"scripts/{script}", folder], env=dict(os.environ, TOOL=TOOL, SOURCE_DATE_EPOCH="1700000000"), check=True, stdout=subprocess.DEVNULL)


def compiles(text, stage="frag", entry="main"):
    """Compiles HLSL to SPIR-V."""
    with tempfile.TemporaryDirectory() as place:
        file = pathlib.Path(place) / "text.hlsl"
        file.write_text(text)
        run = subprocess.run([GLSLANG, "-D", "-V", "-S", stage, "-e", entry, "--source-entrypoint", entry, "-o", f"{place}/out", file], capture_output=True, text=True)
        assert run.returncode == 0, run.stdout + run.stderr + text
    HLSL.append((text, "ps" if stage == "frag" else "vs", entry))


def microsoftsCompilersTakeTheSame():
    sys.path.insert(0, str(SOURCES / "tests/direct3d"))
    import hlsl

    with tempfile.TemporaryDirectory() as place:
        folder, jobs = pathlib.Path(place), []
        for number, (text, stage, entry) in enumerate(HLSL):
            (folder / f"{number}.hlsl").write_text(text)
            jobs.append(["dxc", f"dxc{number}", f"{number}.hlsl", entry, f"{stage}_6_0"])
            jobs.append(["fxc", f"fxc{number}", f"{number}.hlsl", entry, f"{stage}_5_0"])
        assert len(jobs) >= 2 * 9
        _, failed = hlsl.run(BUILD, folder, jobs)
        bad = [f"{name}: {hlsl.messages(folder, name)}\n{HLSL[int(name[3:])][0]}" for _, name, *_ in jobs if name in failed or hlsl.messages(folder, name)]
        assert not bad, "\n".join(bad)


def included(text, folder):
    """Unity's includes: of this package its files, of Unity the stand-ins."""
    def file(match):
        name = match[1]
        ours = "Packages/com.cotan.normal-maps/"
        assert name.startswith(ours) or name in ("ShaderApiReflectionSupport.hlsl", "Packages/com.unity.render-pipelines.universal/ShaderLibrary/Lighting.hlsl"), name
        return included((folder / name[len(ours):]).read_text(), folder) if name.startswith(ours) else ""  # fmt: skip
    return re.sub(r'#include "([^"]+)"', file, text)


FRAGMENT = "float4 main(float3 n : A, float3 p : B, float2 uv : C) : SV_Target { %s }"


def unityHasAGuidForEachFileAndKeepsIt(folder):
    package = folder / "com.cotan.normal-maps"
    described = json.loads((package / "package.json").read_text())
    assert described["name"] == package.name and re.fullmatch(r"\d+\.\d+\.\d+", described["version"])
    for sample in described["samples"]:
        assert (package / sample["path"]).is_dir()
    guids = {}
    for path in sorted(package.rglob("*")):
        hidden = any(part.endswith("~") for part in path.relative_to(package).parts)
        if path.suffix == ".meta":
            assert path.with_suffix("").exists(), f"{path} belongs to nothing"
            guids[path.relative_to(package).as_posix()] = re.search(r"^guid: ([0-9a-f]{32})$", path.read_text(), re.M)[1]
        elif path.is_file() or not hidden:
            assert path.with_name(path.name + ".meta").exists(), f"{path} has no .meta"
    assert len(set(guids.values())) == len(guids) >= 8
    # A project refers to files by these numbers: they never change.
    assert guids["Runtime/Cotan.hlsl.meta"] == "34d144920c8b46ff3039bbaeb472cde5" and guids["Runtime/CotanNode.hlsl.meta"] == "f2dfd75c64a424be010cabce7edc8114"


def unitysFunctionsCompile(folder):
    package = folder / "com.cotan.normal-maps"
    node = (package / "Runtime/CotanNode.hlsl").read_text()
    signature = re.search(r"UNITY_EXPORT_REFLECTION\nfloat3 CotanNormalMap\(([^)]*)\)", node)[1]
    parameters = [word.split()[1] for word in signature.split(", ")]
    hinted = re.findall(r'^///<paramhints name = "(\w+)">$', node, re.M)
    assert hinted == parameters and "<sg:ProviderKey>Cotan.NormalMap</sg:ProviderKey>" in node
    for tag in set(re.findall(r"</?([\w:]+)", "\n".join(line for line in node.splitlines() if line.startswith("///")))):
        assert len(re.findall(rf"<{tag}[ >]", node)) == len(re.findall(rf"</{tag}>", node)), tag
    compiles(UNITY + included(node, package) + FRAGMENT % "return float4(CotanNormalMap(n, p, uv, float3(0, 0, 1)), 1);")
    custom = (package / "Runtime/CotanCustomFunction.hlsl").read_text()
    compiles(UNITY + included(custom, package) + FRAGMENT % "float3 r; Cotan_float(n, p, uv, float3(0, 0, 1), r); return float4(r, 1);")
    shader = (package / "Samples~/NormalMap/CotanNormalMap.shader").read_text()
    program = re.search(r"HLSLPROGRAM\n(.*?)ENDHLSL", shader, re.S)[1]
    for kind, stage in (("vertex", "vert"), ("fragment", "frag")):
        entry = re.search(rf"#pragma {kind} (\w+)", program)[1]
        compiles(UNITY + included(re.sub(r"#pragma.*", "", program), package), stage, entry)


def unrealsNodesReadEachOther(folder):
    text = (folder / "Cotan/MaterialNodes.txt").read_text()
    assert text.count("Begin Object") == text.count("End Object") == 15
    nodes = re.findall(r'^Begin Object Class=/Script/UnrealEd.\w+ Name="(\w+)"', text, re.M)
    expressions = re.findall(r'^   Begin Object Class=/Script/Engine.(\w+) Name="(\w+)"', text, re.M)
    whole = {f"/Script/Engine.{kind}'{node}.{name}'" for node, (kind, name) in zip(nodes, expressions)}
    read = re.findall(r'Expression="([^"]+)"\)?[,)]', text)
    assert len(read) == 5 and set(read) <= whole, (read, whole)
    guids = re.findall(r"Guid=([0-9A-F]{32})\b", text)
    assert len(set(guids)) == len(guids) == 10


def unrealsCodeCompilesInBothStages(folder):
    plugin = folder / "Cotan"
    described = json.loads((plugin / "Cotan.uplugin").read_text())
    assert re.fullmatch(r"\d+\.\d+\.\d+", described["VersionName"])
    for module in described["Modules"]:
        assert (plugin / "Source" / module["Name"] / f"{module['Name']}.Build.cs").exists()
    code = re.search(r'^      Code="(.*)"$', (plugin / "MaterialNodes.txt").read_text(), re.M)[1]
    code = code.replace("\\r\\n", "\n").replace("\\t", "\t").replace('\\"', '"').replace("\\\\", "\\")
    names = re.findall(r'InputName="(\w+)"', (plugin / "MaterialNodes.txt").read_text())
    assert names == ["Normal", "Position", "UV", "Texel"]
    # Unreal puts the code into a function. glslang accepts functions of a struct only outside of functions.
    inside = "float3 custom(float3 Normal, float3 Position, float2 UV, float3 Texel)\n{\n" + code + "\n}\n"
    start, end = code.split("} cotan;\n")
    whole = start + "};\nfloat3 custom(float3 Normal, float3 Position, float2 UV, float3 Texel)\n{\n    CotanFunctions cotan;\n" + end + "\n}\n"
    for stage in (0, 1):
        start = f"#define PIXELSHADER {stage}\n"
        body = FRAGMENT % "return float4(custom(n, p, uv, float3(0, 0, 1)), 1);"
        compiles(start + whole + body)
        HLSL.append((start + inside + body, "ps", "main"))
    functions = (plugin / "Shaders/Cotan.ush").read_text().replace("#pragma once\n", "")
    compiles(functions + FRAGMENT % "return float4(cotan_perturb_normal(n, p, uv, float3(0, 0, 1)), 1);")


def theSameCommitGivesTheSameBytes(folder):
    with tempfile.TemporaryDirectory() as place:
        again = pathlib.Path(place)
        made("unity-package", again)
        made("unreal-plugin", again)
        made("godot-addon", again)
        made("godot-addon", folder)
        made("bevy-crate", again)
        made("bevy-crate", folder)
        names = sorted(file.name for file in again.iterdir() if file.is_file())
        assert len(names) == 4, names
        for name in names:
            assert (again / name).read_bytes() == (folder / name).read_bytes(), name


with tempfile.TemporaryDirectory() as place:
    folder = pathlib.Path(place)
    made("unity-package", folder)
    made("unreal-plugin", folder)
    for fact in (unityHasAGuidForEachFileAndKeepsIt, unitysFunctionsCompile, unrealsNodesReadEachOther, unrealsCodeCompilesInBothStages, theSameCommitGivesTheSameBytes):
        fact(folder)
        print("holds:", fact.__name__)
if BUILD:
    microsoftsCompilersTakeTheSame()
    print("holds: microsoftsCompilersTakeTheSame")
