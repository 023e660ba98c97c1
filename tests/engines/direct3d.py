"""The printed HLSL, as FXC compiles it, drawn by Direct3D 11 under Wine and judged by the formula of two rings.

    direct3d.py TOOL BUILD [FOLDER]

TOOL: cotan; BUILD: see tests/direct3d/run; FOLDER: where files are left. Exit code 77 if it cannot run here."""

import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

import ring

sys.path.insert(0, str(ring.ROOT / "tests/direct3d"))
import hlsl  # noqa: E402

# Rows run down, against y of clip space, and ddy follows them. flipped: as engines draw into some render targets.
VERTEX = """StructuredBuffer<float> corners : register(t0);
struct Drawn { float4 at : SV_Position; float3 n : A; float3 p : B; float2 uv : C; };
Drawn drawn(uint k, float y)
{
    uint i = k * 8;
    Drawn d;
    d.n = float3(corners[i], corners[i + 1], corners[i + 2]);
    d.p = float3(corners[i + 3], corners[i + 4], corners[i + 5] - EYE);
    d.uv = float2(corners[i + 6], corners[i + 7]);
    float depth = -d.p.z;
    d.at = float4(d.p.x / (TANGENT * ASPECT), d.p.y / TANGENT * y, (depth - 1.0) * 20.0 / 19.0, depth);
    return d;
}
Drawn upright(uint k : SV_VertexID) { return drawn(k, 1.0); }
Drawn flipped(uint k : SV_VertexID) { return drawn(k, -1.0); }
"""
PIXEL = """
Texture2D<float4> maps : register(t1);
SamplerState kept : register(s0);
struct Seen { float4 at : SV_Position; float3 n : A; float3 p : B; float2 uv : C; };
struct Parts { float4 normal : SV_Target0; float4 uv : SV_Target1; };
Parts main(Seen i)
{
    Parts parts;
    parts.normal = float4(cotan_perturb_normal(i.n, i.p, i.uv, maps.Sample(kept, i.uv).xyz), 1.0);
    parts.uv = float4(i.uv, 0.0, 1.0);
    return parts;
}
"""


def vertices(mirrored, x):
    """Eight floats for each corner of each triangle: normal, position, uv."""
    position, normal, uv, corners = ring.ring_mesh(mirrored)
    rows = np.concatenate([normal @ ring.BASIS.T, position @ ring.BASIS.T + [x, 0, 0], uv], axis=1)
    return rows[corners].astype("<f4")


def rgba(pixels):
    return np.concatenate([pixels, np.full_like(pixels[..., :1], 255)], axis=-1).tobytes()


def image(folder, name):
    return np.frombuffer((folder / f"{name}.bin").read_bytes(), np.float32).reshape(2, ring.HEIGHT, ring.WIDTH, 4).astype(float)


def pair(folder, frame, kind, way):
    """Both rings, each drawn with its map, in the rows of an upright image."""
    halves = [image(folder, f"{way} {frame} {kind} {name}") for name, *_ in ring.PAIR]
    halves = [half[:, ::-1] if way == "flipped" else half for half in halves]
    whole = np.concatenate([halves[0][:, :, : ring.WIDTH // 2], halves[1][:, :, ring.WIDTH // 2 :]], axis=2)
    return np.concatenate([whole[0][..., :3], whole[1][..., :2], whole[0][..., 3:4]], axis=-1)


def main(tool, build, folder):
    size = f"static const float EYE = {ring.EYE}, TANGENT = {np.tan(np.radians(ring.FIELD / 2)):.9f}, ASPECT = {ring.WIDTH / ring.HEIGHT};\n"
    (folder / "vertex.hlsl").write_text(size + VERTEX)
    jobs = [["fxc", way, "vertex.hlsl", way, "vs_5_0"] for way in ("upright", "flipped")]
    counts = {}
    for name, formula, mirrored, x in ring.PAIR:
        rows = vertices(mirrored, x)
        counts[name] = len(rows)
        (folder / f"{name}.floats").write_bytes(rows.tobytes())
        (folder / f"bumps {name}.rgba").write_bytes(rgba(ring.map_pixels(formula, 2048, 1024)))
        (folder / f"flat {name}.rgba").write_bytes(rgba(ring.map_pixels(ring.flat, 4, 4)))
    text = ring.functions(tool, "--lang", "hlsl", "--frame", "orthonormal")
    shaders = {"orthonormal": text, "wrong": ring.replaced(text, "ddy_fine(uv)", "-ddy_fine(uv)")}  # the judge must see it
    for frame, functions in shaders.items():
        (folder / f"{frame}.hlsl").write_text(functions + PIXEL)
        jobs.append(["fxc", frame, f"{frame}.hlsl", "main", "ps_5_0"])
        for way in ("upright", "flipped"):
            for kind, (width, height) in (("bumps", (2048, 1024)), ("flat", (4, 4))):
                for name, *_ in ring.PAIR:
                    jobs.append(["draw", f"{way} {frame} {kind} {name}", f"{way}.dxbc", f"{frame}.dxbc", f"{name}.floats", counts[name],
                                 ring.WIDTH, ring.HEIGHT, f"{kind} {name}.rgba", width, height])  # fmt: skip
    _, failed = hlsl.run(build, folder, jobs)
    assert not failed, (failed, (folder / "wine.txt").read_text()[-2000:])
    results = {}
    for frame in shaders:
        for way in ("upright", "flipped"):
            for kind in ring.MAPS:
                results[frame, way, kind] = ring.judge_pair("Direct3D 11", kind, f"{frame} {way}", pair(folder, frame, kind, way))
    # Bumps: filtering a minified map, which Mesa 22.3 does more coarsely than 26.2; without an anisotropic filter 1.0.
    for way in ("upright", "flipped"):
        for name, *_ in ring.PAIR:
            assert results["orthonormal", way, "flat"][name][0] < 0.03 and results["orthonormal", way, "bumps"][name][0] < 0.65, (way, name)
            assert results["wrong", way, "bumps"][name][0] > 10, (way, name)
    version = re.search(r"wine-([0-9.]+)", subprocess.run(["wine", "--version"], capture_output=True, text=True).stdout)[1]
    ours = {kind: results["orthonormal", "upright", kind] for kind in ring.MAPS}
    ring.judge_page("Direct3D 11", f"Wine {version}", ours)
    print("holds: Direct3D 11 draws without tangents what the formula says, upright and upside down")


if __name__ == "__main__":
    if len(sys.argv) > 3:
        main(sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3]).resolve())
    else:
        with tempfile.TemporaryDirectory() as place:
            main(sys.argv[1], sys.argv[2], pathlib.Path(place))
