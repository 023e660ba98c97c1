"""Basis Universal in KTX2 is decoded as by Binomial's transcoder, bit for bit: random UASTC blocks, and maps written by its
encoder as UASTC and ETC1S."""
import json
import os
import pathlib
import shutil
import struct
import subprocess

import numpy as np
import pytest

import cotan

MODULES = os.environ.get("COTAN_NPM")
SCRIPT = pathlib.Path(__file__).parent.parent / "npm" / "basisu.mjs"
pytestmark = pytest.mark.skipif(not shutil.which("node") or not MODULES or not pathlib.Path(MODULES, "ktx2-encoder").exists(),
                                reason="no node, or its packages are not installed (see the test npm_packages)")

# The code of each mode of UASTC and its length (Khronos Data Format 1.4, table "UASTC Mode Index encoding"), where the
# partition pattern starts, its length, and the number of patterns.
MODES = [(0x01, 4), (0x35, 6), (0x1D, 5), (0x03, 5), (0x13, 5), (0x0B, 5), (0x1B, 5), (0x07, 5), (0x17, 5), (0x0F, 5),
         (0x02, 3), (0x00, 2), (0x06, 3), (0x1F, 5), (0x0D, 5), (0x05, 7), (0x15, 6), (0x25, 6), (0x09, 4)]
PATTERNS = {2: (20, 5, 30), 3: (20, 4, 11), 4: (20, 5, 30), 7: (20, 5, 19), 9: (28, 5, 30), 16: (29, 5, 30)}


def ktx2(width, height, blocks, channel_type):
    """UASTC of one level with its descriptor."""
    sample = struct.pack("<HBB3I", 0, 127, channel_type, 0, 0, 0xFFFFFFFF)
    descriptor = struct.pack("<2I2H8B8B", 44, 0, 2, 40, 166, 1, 1, 0, 3, 3, 0, 0, 16, *[0] * 7) + sample
    head = b"\xabKTX 20\xbb\r\n\x1a\n" + struct.pack("<9I4I2Q", 0, 1, width, height, 0, 0, 1, 1, 0, 104, len(descriptor), 0, 0, 0, 0)
    return head + struct.pack("<3Q", 104 + len(descriptor), len(blocks), len(blocks)) + descriptor + blocks


def block(random, mode, pattern=None):
    """128 random bits with the code of a mode, and of its patterns one that exists."""
    bits = int.from_bytes(random.bytes(16), "little")
    code, length = MODES[mode]
    bits = bits >> length << length | code
    if mode in PATTERNS:
        start, count, number = PATTERNS[mode]
        bits &= ~((1 << count) - 1 << start)
        bits |= (random.integers(number) if pattern is None else pattern) << start
    return bits.to_bytes(16, "little")


def judged(folder, jobs=()):
    (folder / "jobs.json").write_text(json.dumps([{"name": name, "width": texels.shape[1], "height": texels.shape[0], "options": options}
                                                  for name, texels, options in jobs]))
    for name, texels, _ in jobs:
        (folder / f"{name}.raw").write_bytes(np.ascontiguousarray(texels).tobytes())
    subprocess.run(["node", SCRIPT, MODULES, folder], check=True, stdout=subprocess.DEVNULL, timeout=250)


def wanted(folder, name, shape):
    return np.fromfile(folder / f"{name}.rgba", np.uint8).reshape(*shape, 4)


def test_random_uastc_blocks_of_all_modes_are_decoded_as_by_the_transcoder(tmp_path):
    random = np.random.default_rng(20261130)
    modes = np.concatenate([np.repeat(np.arange(19), 400), random.integers(0, 19, 400)])
    random.shuffle(modes)
    blocks = [block(random, mode) for mode in modes]
    blocks += [block(random, mode, pattern) for mode, (_, _, number) in PATTERNS.items() for pattern in range(number)]
    blocks += [block(random, 0)] * (-len(blocks) % 100)
    width, height = 4 * 100 - 1, 4 * len(blocks) // 100 - 2
    (tmp_path / "random.ktx2").write_bytes(ktx2(width, height, b"".join(blocks), 3))
    judged(tmp_path)
    image, truth = cotan.read_image(tmp_path / "random.ktx2"), wanted(tmp_path, "random", (height, width))
    met = {int(mode) for mode in modes}
    assert met == set(range(19)), met
    for mode in sorted(met): # by mode first, so that a failure names it
        here = np.kron(np.resize(modes, (-(-len(modes) // 100), 100))[:len(modes) // 100] == mode, np.ones((4, 4), bool))[:height, :width]
        rows = here.shape[0]
        assert np.array_equal(image[:rows][here], truth[:rows][here]), f"mode {mode}"
    assert np.array_equal(image, truth)


def test_uastc_blocks_that_the_transcoder_refuses_are_refused(tmp_path):
    random = np.random.default_rng(7)
    reserved = (int.from_bytes(random.bytes(16), "little") >> 7 << 7 | 0x45).to_bytes(16, "little")
    bad = {"mode": reserved, **{f"pattern{mode}": block(random, mode, number) for mode, (_, _, number) in PATTERNS.items()}}
    for name, data in bad.items():
        (tmp_path / f"{name}.ktx2").write_bytes(ktx2(4, 4, data, 3))
    (tmp_path / "good.ktx2").write_bytes(ktx2(4, 4, block(random, 3, 10), 3))
    judged(tmp_path)
    assert (tmp_path / "good.rgba").exists()
    cotan.read_image(tmp_path / "good.ktx2")
    for name in bad:
        assert not (tmp_path / f"{name}.rgba").exists(), name
        with pytest.raises(cotan.InputError, match="block 0, 0 has no mode or no partition pattern that exists"):
            cotan.read_image(tmp_path / f"{name}.ktx2")


def maps():
    """Names and texels: normals, two channels, colours with alpha, one channel, one colour, noise."""
    random = np.random.default_rng(3)
    y, x = np.mgrid[0:47, 0:61]
    slope = np.stack([0.4 * np.cos(x / 5), 0.3 * np.sin(y / 7 + x / 11), np.ones(x.shape)], -1)
    slope[..., :2] += random.uniform(-0.15, 0.15, (47, 61, 2))
    normal = np.rint((slope / np.linalg.norm(slope, axis=-1, keepdims=True) + 1) * 127.5)
    full = np.full((47, 61, 1), 255.0)
    found = {
        "normals": np.concatenate([normal, full], -1),
        "two": np.concatenate([normal[..., :1]] * 3 + [normal[..., 1:2]], -1),
        "alpha": np.stack([x * 4, y * 5, x * y % 256, 128 + 60 * np.sin(x / 3)], -1),
        "grey": np.concatenate([np.stack([x * 4] * 3, -1), full], -1),
        "flat": np.broadcast_to([128.0, 128, 255, 255], (47, 61, 4)),
        "noise": random.integers(0, 256, (47, 61, 4)),
    }
    return {name: texels.astype(np.uint8) for name, texels in found.items()}


KINDS = {
    "uastc": {"isUASTC": True, "needSupercompression": False},
    "uastc-zstd": {"isUASTC": True, "uastcLDRQualityLevel": 3, "enableRDO": True, "rdoQualityLevel": 2},
    "etc1s": {"isUASTC": False, "qualityLevel": 255, "compressionLevel": 2},
    "etc1s-mips": {"isUASTC": False, "qualityLevel": 20, "generateMipmap": True},
}


def compared(folder, sources):
    """Compares maps of all KINDS, and returns the colour models and numbers of slices that were met."""
    judged(folder, [(f"{name}-{kind}", texels, options) for name, texels in sources.items() for kind, options in KINDS.items()])
    met = set()
    for name, texels in sources.items():
        for kind in KINDS:
            file = folder / f"{name}-{kind}.ktx2"
            image, truth = cotan.read_image(file), wanted(folder, f"{name}-{kind}", texels.shape[:2])
            assert np.array_equal(image, truth), f"{file.name}: {np.mean(image != truth)} differ by up to {np.abs(image.astype(int) - truth).max()}"
            data = file.read_bytes()
            start = struct.unpack_from("<I", data, 48)[0]
            met.add((data[start + 12], (struct.unpack_from("<H", data, start + 10)[0] - 24) // 16))
    return met


def test_encoded_maps_are_decoded_as_by_the_transcoder(tmp_path):
    assert compared(tmp_path, maps()) == {(166, 1), (163, 1), (163, 2)} # UASTC; ETC1S without alpha and with


def test_encoded_maps_of_real_surfaces_are_decoded_as_by_the_transcoder(tmp_path, data):
    images = {name: cotan.read_image(data(f"textures/{name}.{kind}")) for name, kind in (("pmndrs_0001", "webp"), ("ornament_normal_gl", "png"))}
    compared(tmp_path, {name: (image[:128, :128] // (257 if image.dtype == np.uint16 else 1)).astype(np.uint8) for name, image in images.items()})


def test_two_channels_are_x_and_y(tmp_path):
    """The same files whose descriptors say RRRG, RRR and GGG instead of RGBA, RGB and AAA."""
    texels = maps()["two"]
    judged(tmp_path, [(kind, texels, options) for kind, options in KINDS.items()])
    for kind in KINDS:
        data = bytearray((tmp_path / f"{kind}.ktx2").read_bytes())
        start = struct.unpack_from("<I", data, 48)[0]
        if data[start + 12] == 166:
            data[start + 31] = 5
        else:
            data[start + 31], data[start + 47] = 3, data[start + 47] & 0xF0 | 4
        (tmp_path / "two.ktx2").write_bytes(data)
        image, truth = cotan.read_image(tmp_path / "two.ktx2"), wanted(tmp_path, kind, texels.shape[:2])
        assert np.array_equal(image[..., :2], truth[..., [0, 3]]), kind
        assert (image[..., 2] == 128).all() and (image[..., 3] == 255).all()
        assert np.abs(image[..., :2].astype(int) - texels[..., [0, 3]]).mean() < 12, kind # the map that was encoded


def test_maps_that_the_tool_writes_as_uastc_are_read_by_the_transcoder(tmp_path, command):
    """Bit for bit as here, and near the map: a wrong bit of a block's ends is tens of steps."""
    sources = {name: texels for name, texels in maps().items() if name in ("normals", "flat")}
    for name, texels in sources.items():
        cotan.write_image(tmp_path / f"{name}.png", texels)
        command("map", "convert", tmp_path / f"{name}.png", "--from", "gltf", "--to", "gltf", "--compress", "uastc",
                "-o", tmp_path / f"{name}.ktx2")
    judged(tmp_path)
    for name, texels in sources.items():
        truth = wanted(tmp_path, name, texels.shape[:2])
        assert np.array_equal(cotan.read_image(tmp_path / f"{name}.ktx2"), truth), name
        off = np.abs(truth[..., :3].astype(int) - texels[..., :3])
        assert off.mean() < (6 if name == "normals" else 0.6), name # noise of 19 steps; one colour is exact to a step
        assert (truth[..., 3] == 255).all()


def test_maps_of_the_tool_have_less_error_than_those_of_binomials_encoder(tmp_path, command):
    """In degrees, which the tool minimises: 7 % less on both maps; a fit of the ends that does nothing loses that."""
    y, x = np.mgrid[0:47, 0:61]
    slope = np.stack([0.5 * np.cos(x / 6), 0.4 * np.sin(y / 5 + x / 9), np.ones(x.shape)], -1)
    smooth = np.rint((slope / np.linalg.norm(slope, axis=-1, keepdims=True) + 1) * 127.5)
    sources = {"normals": maps()["normals"], "smooth": np.concatenate([smooth, np.full((47, 61, 1), 255.0)], -1).astype(np.uint8)}

    def degrees(image, texels):
        a, b = (v[..., :3] / 127.5 - 1.0 for v in (image, texels))
        cosine = (a * b).sum(-1) / np.linalg.norm(a, axis=-1) / np.linalg.norm(b, axis=-1)
        return np.degrees(np.arccos(np.clip(cosine, -1, 1))).mean()

    judged(tmp_path, [(name, texels, KINDS["uastc"]) for name, texels in sources.items()])
    for name, texels in sources.items():
        cotan.write_image(tmp_path / f"{name}.png", texels)
        command("map", "convert", tmp_path / f"{name}.png", "--from", "gltf", "--to", "gltf", "--compress", "uastc", "-o", tmp_path / "own.ktx2", "--overwrite")
        own, theirs = degrees(cotan.read_image(tmp_path / "own.ktx2"), texels), degrees(wanted(tmp_path, name, texels.shape[:2]), texels)
        assert 0 < own < 0.95 * theirs, f"{name}: {own} and {theirs}"
