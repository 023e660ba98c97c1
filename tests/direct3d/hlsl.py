"""What the tests of HLSL by Microsoft's compilers share: running them, and a shader that calls every function of a text."""

import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent


def run(build, folder, jobs):
    """Runs jobs (lists of words, see host.cpp) in a folder. Returns the version of DXC and the names of those that failed."""
    lines = "".join("\t".join(map(str, job)) + "\n" for job in jobs)
    done = subprocess.run([HERE / "run", build, folder], input=lines, stdout=subprocess.PIPE, text=True)
    if done.returncode == 77:
        print(done.stdout, end="")
        sys.exit(77)
    assert done.returncode == 0, done.stdout
    first, *rest = done.stdout.splitlines()
    said = dict(line.rsplit(" ", 1) for line in rest)
    assert list(said) == [str(job[1]) for job in jobs], f"{len(said)} of {len(jobs)} jobs ended; the last is {rest[-1:]}"
    return first.split()[1], [name for name, result in said.items() if result != "ok"]


def messages(folder, name):
    file = folder / f"{name}.txt"
    return file.read_text(errors="replace").strip("\0\r\n ") if file.exists() else ""


def functions_of(text):
    """(result, name, [(type, name)]) of each function."""
    found = re.findall(r"^(\w+) (\w+)\(([^)]*)\)\n\{", text, re.M)
    return [(result, name, [tuple(p.split()) for p in re.split(r",\s*", parameters) if p]) for result, name, parameters in found]


def structs_of(text):
    found = re.findall(r"^struct (\w+)\n\{\n(.*?)\n\};", text, re.M | re.S)
    return {name: re.findall(r"^    (\w+) (\w+);", body, re.M) for name, body in found}


def calls(text):
    """Statements that call every function with numbers from the buffer `given` and add all results to `sum`."""
    structs, lines, at = structs_of(text), [], [0]

    def value(kind):
        count = int(kind[-1]) if kind[-1].isdigit() else 1
        numbers = [f"given[base + {at[0] + k}]" for k in range(count)]
        at[0] += count
        return {"uint": f"asuint({numbers[0]})", "int": f"asint({numbers[0]})"}.get(kind, f"{kind}({', '.join(numbers)})")

    def argument(kind):
        if kind not in structs:
            return value(kind)
        name = f"a{at[0]}"
        fields = [(field, argument(inner)) for inner, field in structs[kind]]
        lines.append(f"{kind} {name};")
        lines.extend(f"{name}.{field} = {what};" for field, what in fields)
        return name

    def add(kind, what):
        if kind in structs:
            for inner, field in structs[kind]:
                add(inner, f"{what}.{field}")
        else:
            ones = {"float2": "float2(1.0, 1.0)", "float3": "float3(1.0, 1.0, 1.0)", "float4": "float4(1.0, 1.0, 1.0, 1.0)"}
            lines.append(f"sum += dot({what}, {ones[kind]});" if kind in ones else f"sum += float({what});")

    for result, name, parameters in functions_of(text):
        words = ", ".join(argument(kind) for kind, _ in parameters)
        at[0] += 1
        lines.append(f"{result} r{at[0]} = {name}({words});")
        add(result, f"r{at[0]}")
    return "\n".join("    " + line for line in lines)


def pixel(text):
    return f"{text}\nStructuredBuffer<float> given : register(t9);\nfloat4 main(float4 at : SV_Position) : SV_Target\n{{\n    uint base = uint(at.x);\n    float sum = 0.0;\n{calls(text)}\n    return float4(sum, sum, sum, 1.0);\n}}\n"


def vertex(text):
    return f"{text}\nStructuredBuffer<float> given : register(t9);\nfloat4 main(uint base : SV_VertexID) : SV_Position\n{{\n    float sum = 0.0;\n{calls(text)}\n    return float4(sum, sum, sum, 1.0);\n}}\n"


def compute(text):
    return f"{text}\nStructuredBuffer<float> given : register(t9);\nRWStructuredBuffer<float> results : register(u0);\n[numthreads(64, 1, 1)]\nvoid main(uint3 id : SV_DispatchThreadID)\n{{\n    uint base = id.x;\n    float sum = 0.0;\n{calls(text)}\n    results[base] = sum;\n}}\n"
