#!/usr/bin/env python3
"""The Vulkan renderer draws the same as the reference renderer, for each `render` of tests/output_bytes/pictures.txt.

  two_renderers_test.py TOOL TABLE

Vulkan's validation layer is enabled if it is installed, and must report nothing. The renderers share only the text of
their shaders, not the projection, the rasterizer or the order of layers. Filtering of maps depends on the device, so
that both read the nearest texel of mip level 0.
"""
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from output_bytes import SKIPPED, png_pixels
from output_inputs import make_inputs

# Limits in 8-bit levels. Devices filter environments: the overcast one differs by 1.03 levels. An edge whose distance
# to a sample is below rounding gives a different pixel.
MEAN, LARGE, MANY = 1.5, 12, 0.02  # the mean difference, and the fraction of pixels that may differ by more than LARGE
LAYERS = {"VK_INSTANCE_LAYERS": "VK_LAYER_KHRONOS_validation"}
OWN = ("--rate", "--shadow-softness")


def pixels(path):
    data = path.read_bytes()
    width, height = int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")
    channels = {0: 1, 2: 3, 4: 2, 6: 4}[data[25]]
    return png_pixels(data)[-width * height * channels:], channels


def difference(a, b):
    """Returns the mean difference in levels, and the fraction of pixels that differ by more than LARGE."""
    (first, channels), (second, others) = pixels(a), pixels(b)
    if channels != others or len(first) != len(second):
        return 255.0, 1.0
    apart = [abs(x - y) for x, y in zip(first, second)]
    large = sum(max(apart[i:i + channels]) > LARGE for i in range(0, len(apart), channels))
    return sum(apart) / len(apart), large * channels / len(apart)


def main(tool, table):
    lines = [line.split()[1:] for line in pathlib.Path(table).read_text().splitlines() if line.startswith("cotan render ")]
    lines = [w for w in lines if "--device" in w and w[w.index("-o") + 1].endswith(".png") and "--frames" not in w and not set(OWN) & set(w)]
    wrong, drawn, flat = [], 0, 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        make_inputs(folder)
        run = lambda words, **more: subprocess.run([tool, *words], cwd=folder, capture_output=True, text=True, timeout=120, check=False,
                                                   env={**os.environ, **more})
        probe = run(["render", "--shape", "plane", "--size", "8", "-o", "probe.png", "--json", "-"])
        if probe.returncode or json.loads(probe.stdout)["device"] == "reference":
            print(f"skipped: no Vulkan device: {probe.stderr.strip()}")
            return SKIPPED
        layers = LAYERS if run(["render", "--shape", "plane", "--size", "8", "-o", "layer.png"], **LAYERS).returncode == 0 else {}
        for words in lines:
            words += [] if "--point-sampled" in words else ["--point-sampled"]
            at = words.index("--device")
            output = words[words.index("-o") + 1]
            on_device = words[:at] + words[at + 2:]
            on_device[on_device.index("-o") + 1] = "device-" + output
            one, two = run(words), run(on_device, **layers)
            said = " ".join(on_device)
            if one.returncode or two.returncode:
                wrong.append(f"{said}: exit codes {one.returncode}, {two.returncode}: {one.stderr}{two.stderr}".strip())
                continue
            if re.search(r'on reference|"device": "reference"', two.stdout):
                wrong.append(f"{said}: the reference renderer drew it, too")
            if re.search(r"validation|VUID", two.stdout + two.stderr, re.I):
                wrong.append(f"{said}: {two.stdout}{two.stderr}".strip())
            mean, many = difference(folder / output, folder / ("device-" + output))
            drawn += 1
            flat += len(set(pixels(folder / output)[0])) < 4
            if mean > MEAN or many > MANY:
                wrong.append(f"{said}: a mean difference of {mean:.2f} levels, {100 * many:.1f} % of the pixels by more than {LARGE}")
    print(*wrong, sep="\n", end="\n" if wrong else "")
    print(f"{drawn} images by both renderers, {len(wrong)} wrong, {flat} nearly empty{'' if layers else '; no validation layer is installed'}")
    return 1 if wrong or drawn < 50 or flat > 2 else 0


if __name__ == "__main__":
    sys.exit(main(str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2]))
