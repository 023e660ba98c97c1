"""Blocks of GPU textures, drawn at random by a seed, are decoded as a GPU does: Chromium's WebGL on SwiftShader judges."""
import base64
import json
import os
import shutil
import struct
import subprocess
import zlib

import numpy as np
import pytest

import cotan

CHROMIUM = shutil.which(os.environ.get("CHROMIUM", "chromium"))

# VkFormat, WebGL's extension and constant, block size, bytes, channels that are compared, tolerance in units of 1/255:
# none for ETC2 and BC6H; a step for ASTC, of whose 16 bits SwiftShader takes the upper 8, and libastcenc rounds; a step
# of 11 bits for EAC, which SwiftShader divides by another number than the specification's 2047, and to signed values it
# adds 4, which the specification and its conformance tests (dEQP) add to unsigned ones only; and a step of the stored 8
# bits for BC, whose interpolation GPUs may round.
S3TC, RGTC, BPTC = "WEBGL_compressed_texture_s3tc", "EXT_texture_compression_rgtc", "EXT_texture_compression_bptc"
ETC, ASTC = "WEBGL_compressed_texture_etc", "WEBGL_compressed_texture_astc"
STEP = 1.001
FORMATS = {
    "etc2": (147, ETC, 0x9274, (4, 4), 8, 3, 1e-3),
    "etc2-a1": (149, ETC, 0x9276, (4, 4), 8, 4, 1e-3),
    "etc2-rgba": (151, ETC, 0x9278, (4, 4), 16, 4, 1e-3),
    "eac-r11": (153, ETC, 0x9270, (4, 4), 8, 1, 255 / 2047),
    "eac-rg11": (155, ETC, 0x9272, (4, 4), 16, 2, 255 / 2047),
    "eac-r11-signed": (154, ETC, 0x9271, (4, 4), 8, 1, 255 * 5 / 1023),
    "eac-rg11-signed": (156, ETC, 0x9273, (4, 4), 16, 2, 255 * 5 / 1023),
    "bc1": (133, S3TC, 0x83F1, (4, 4), 8, 4, STEP),
    "bc3": (137, S3TC, 0x83F3, (4, 4), 16, 4, STEP),
    "bc4": (139, RGTC, 0x8DBB, (4, 4), 8, 1, STEP),
    "bc5": (141, RGTC, 0x8DBD, (4, 4), 16, 2, STEP),
    "bc4-signed": (140, RGTC, 0x8DBC, (4, 4), 8, 1, 255 / 127),
    "bc5-signed": (142, RGTC, 0x8DBE, (4, 4), 16, 2, 255 / 127),
    "bc6h": (143, BPTC, 0x8E8F, (4, 4), 16, 3, 1e-3),
    "bc6h-signed": (144, BPTC, 0x8E8E, (4, 4), 16, 3, 1e-3),
    "bc7": (145, BPTC, 0x8E8C, (4, 4), 16, 4, STEP),
}
SIZES = [(4, 4), (5, 4), (5, 5), (6, 5), (6, 6), (8, 5), (8, 6), (8, 8), (10, 5), (10, 6), (10, 8), (10, 10), (12, 10), (12, 12)]
FORMATS.update({f"astc-{w}x{h}": (157 + 2 * i, ASTC, 0x93B0 + i, (w, h), 16, 4, STEP) for i, (w, h) in enumerate(SIZES)})

PAGE = """<body><script>
const answer = [];
const gl = document.createElement('canvas').getContext('webgl2');
gl.getExtension('EXT_color_buffer_float');
const shader = (kind, text) => { const s = gl.createShader(kind); gl.shaderSource(s, '#version 300 es\\nprecision highp float;' + text); gl.compileShader(s); return s; };
const program = gl.createProgram();
gl.attachShader(program, shader(gl.VERTEX_SHADER, 'void main() { gl_Position = vec4(4 * (gl_VertexID & 1) - 1, 2 * (gl_VertexID & 2) - 1, 0, 1); }'));
gl.attachShader(program, shader(gl.FRAGMENT_SHADER, 'uniform sampler2D t; out vec4 c; void main() { c = texelFetch(t, ivec2(gl_FragCoord.xy), 0); }'));
gl.linkProgram(program); gl.useProgram(program);
for (const [extension, format, width, height, blocks] of JOBS) {
  gl.getExtension(extension);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.compressedTexImage2D(gl.TEXTURE_2D, 0, format, width, height, 0, Uint8Array.from(atob(blocks), c => c.charCodeAt(0)));
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST); gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  const texture = gl.getParameter(gl.TEXTURE_BINDING_2D), target = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, target); gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, width, height);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
  gl.bindTexture(gl.TEXTURE_2D, texture); gl.viewport(0, 0, width, height); gl.drawArrays(gl.TRIANGLES, 0, 3);
  const pixels = new Float32Array(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, gl.FLOAT, pixels);
  const error = gl.getError();
  let text = '';
  for (const byte of new Uint8Array(pixels.buffer)) text += String.fromCharCode(byte);
  answer.push(error ? error : btoa(text));
}
document.body.textContent = JSON.stringify(answer);
</script></body>"""


def judged(jobs, folder):
    """The texels that WebGL reads, for each job an array of shape (height, width, 4) from 0 to 1."""
    page = folder / "page.html"
    page.write_text(PAGE.replace("JOBS", json.dumps([[*job[:4], base64.b64encode(job[4]).decode()] for job in jobs])))
    dom = subprocess.run(
        [CHROMIUM, "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", f"--user-data-dir={folder}/profile", "--dump-dom", page.as_uri()],
        check=True, capture_output=True, text=True, timeout=200).stdout
    answers = json.loads(dom[dom.index("["):dom.rindex("]") + 1])
    assert len(answers) == len(jobs)
    assert all(isinstance(answer, str) for answer in answers), answers
    return [np.frombuffer(base64.b64decode(answer), np.float32).reshape(job[3], job[2], 4) for job, answer in zip(jobs, answers)]


def ktx2(vulkan, width, height, blocks):
    """A file of one level, without the descriptor, which Cotan does not read."""
    head = b"\xabKTX 20\xbb\r\n\x1a\n" + struct.pack("<9I4I2Q", vulkan, 1, width, height, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0)
    return head + struct.pack("<3Q", 104, len(blocks), len(blocks)) + blocks


def shares(name, difference, tolerance):
    return f"{name}: {np.mean(difference > tolerance):.4f} of the values are off by up to {difference.max():.3f} of 255 steps"


@pytest.mark.skipif(not CHROMIUM, reason="no chromium here")
def test_random_blocks_of_every_format_are_decoded_as_webgl_does(tmp_path):
    random = np.random.default_rng(20261129)
    jobs, files = [], []
    for name, (vulkan, extension, constant, (across, down), bytes_, _, _) in FORMATS.items():
        # WebGL wants whole blocks of BC; other formats also end inside of a block.
        # One block of ETC2 in twenty has the mode T, H or planar each, so that many blocks meet every bit of it.
        columns, rows = (40, 30) if extension == ETC else (7, 5)
        width, height = across * columns, down * rows
        if extension not in (S3TC, RGTC, BPTC):
            width, height = width - 1, height - 3
        blocks = random.integers(0, 256, columns * rows * bytes_, np.uint8).tobytes()
        jobs.append((extension, constant, width, height, blocks))
        files.append(tmp_path / f"{name}.ktx2")
        files[-1].write_bytes(ktx2(vulkan, width, height, blocks))
    for name, file, wanted in zip(FORMATS, files, judged(jobs, tmp_path)):
        *_, channels, tolerance = FORMATS[name]
        image = cotan.read_image(file)[..., :channels]
        wanted = wanted[..., :channels]
        if image.dtype == np.float32: # BC6H: relative to the value, beyond 1
            assert (wanted.min() < -1) == name.endswith("signed") and wanted.max() > 1000
            difference = 255.0 * np.abs(image - wanted) / np.maximum(1, np.abs(wanted))
        elif name.endswith("signed"): # 0 is 32768
            assert wanted.min() < -0.5
            difference = 255.0 * np.abs((image - 32768.0) / 32767 - wanted)
        else:
            difference = np.abs(image * (255.0 / np.iinfo(image.dtype).max) - 255.0 * wanted)
        assert difference.max() <= tolerance, shares(name, difference, tolerance)
        # Most random blocks of ASTC break its rules, for which all decoders give one colour.
        assert np.ptp(wanted[..., 0]) > 0.5 or name.startswith("astc"), name


def png_chunk(kind, content):
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))


@pytest.mark.skipif(not CHROMIUM, reason="no chromium here")
def test_signed_blocks_of_png_files_are_what_webgl_reads_whatever_colour_their_chunks_state(tmp_path, command):
    """An importer that took such a chunk for the encoding of the values stored a flat texel as -0.56."""
    x, y = np.meshgrid(np.linspace(-0.7, 0.7, 40), np.linspace(-0.7, 0.7, 32))
    normals = np.dstack([x, y, np.sqrt(1 - x * x - y * y)])
    normals[:8, :8] = 0, 0, 1
    cotan.write_image(tmp_path / "map.png", np.round(128 + 127 * normals).astype(np.uint8))
    plain = (tmp_path / "map.png").read_bytes()
    variants = {"none": b"", "srgb": png_chunk(b"sRGB", b"\0"), "gama": png_chunk(b"gAMA", struct.pack(">I", 45455)),
                "both": png_chunk(b"gAMA", struct.pack(">I", 100000)) + png_chunk(b"sRGB", b"\1")}  # fmt: skip
    files = {}
    for name, chunks in variants.items():
        (tmp_path / f"{name}.png").write_bytes(plain[:33] + chunks + plain[33:])  # after IHDR
        for ending in ("ktx2", "dds"):
            file = tmp_path / f"{name}.{ending}"
            command("map", "convert", tmp_path / f"{name}.png", "--from", "gltf,exact", "--to", "gltf,xy", "--compress", "bc5-snorm", "-o", file)
            files[name, ending] = file.read_bytes()
    for (name, ending), data in files.items():
        assert data == files["none", ending], name
    vulkan, width, height, blocks = levels(tmp_path / "none.ktx2")
    assert (vulkan, files["none", "dds"][148:]) == (142, blocks)
    (read,) = judged([(RGTC, 0x8DBE, width, height, blocks)], tmp_path)
    assert np.abs(read[:8, :8, :2]).max() == 0  # flat
    assert np.abs(read[..., :2] - normals[..., :2]).max() < 0.04 and np.abs(read[..., :2] - normals[..., :2]).mean() < 0.005
    for ending in ("ktx2", "dds"):
        image = (cotan.read_image(tmp_path / f"none.{ending}")[..., :2] - 32768.0) / 32767
        assert np.abs(image - read[..., :2]).max() < 1 / 127


TOOL = os.environ.get("COTAN_TOOL")


def levels(file):
    """VkFormat, width, height and the bytes of the largest level of a KTX2 file."""
    data = file.read_bytes()
    vulkan, _, width, height = struct.unpack_from("<4I", data, 12)
    start, length = struct.unpack_from("<2Q", data, 80)
    return vulkan, width, height, data[start:start + length]


def degrees(a, b):
    return np.degrees(np.arccos(np.clip(np.sum(a * b, axis=-1), -1, 1)))


def unit(x, y):
    return np.stack([x, y, np.sqrt(np.maximum(0, 1 - x * x - y * y))], axis=-1)


@pytest.mark.skipif(not CHROMIUM or not TOOL, reason="no chromium or no tool here")
def test_written_blocks_are_read_by_webgl_and_have_the_normals_of_the_map(tmp_path):
    random = np.random.default_rng(2026)
    width, height = 61, 47
    x, y = (np.kron(random.uniform(-0.4, 0.4, (7, 9)), np.ones((8, 8)))[:height, :width] + random.uniform(-0.1, 0.1, (height, width)) for _ in "xy")
    truth = unit(x, y)
    cotan.write_image(tmp_path / "map.png", np.rint((np.concatenate([truth, np.ones((height, width, 1))], axis=-1) * 0.5 + 0.5) * 65535).astype(np.uint16))
    names, jobs = [], []
    for word in ("bc5", "bc7", "eac-rg11", *(f"astc-{w}x{h}" for w, h in SIZES[:8])):
        for two in (True, False):
            if (word == "bc7" and two) or (word in ("bc5", "eac-rg11") and not two):
                continue
            file = tmp_path / f"{word}-{two}.ktx2"
            run = subprocess.run([TOOL, "map", "convert", tmp_path / "map.png", "--from", "gltf", "--to", "gltf,xy" if two else "gltf", "--compress", word, "-o", file],
                                 capture_output=True, text=True, check=False)
            assert run.returncode == 0, run.stderr
            vulkan, w, h, blocks = levels(file)
            assert (w, h) == (width, height)
            extension, constant = next((f[1], f[2]) for f in FORMATS.values() if f[0] == vulkan)
            if extension in (RGTC, BPTC): # WebGL wants whole blocks
                w, h = -(-w // 4) * 4, -(-h // 4) * 4
            names.append((word, two, file))
            jobs.append((extension, constant, w, h, blocks))
    errors = {}
    for (word, two, file), texels in zip(names, judged(jobs, tmp_path)):
        texels = 2.0 * texels[:height, :width] - 1
        swizzled = two and word.startswith("astc") # red, red, red, green
        read = unit(texels[..., 0], texels[..., 3 if swizzled else 1]) if two else texels[..., :3] / np.linalg.norm(texels[..., :3], axis=-1, keepdims=True)
        errors[word, two] = degrees(read, truth).mean()
        ours = cotan.read_image(file).astype(np.float64)
        ours = 2 * ours / (65535 if ours.max() > 255 else 255) - 1
        # Cotan reads the swizzle that it wrote: x is in red and y in green.
        own = unit(ours[..., 0], ours[..., 1]) if two else ours[..., :3] / np.linalg.norm(ours[..., :3], axis=-1, keepdims=True)
        assert degrees(own, read).max() < 1.5, (word, two) # a step of 8 bits in x, y and z at this tilt
    # Noise of a tenth: each format loses more than its rounding, and more with larger blocks.
    assert 0.1 < errors["bc5", True] < 1.5, errors
    assert 0.1 < errors["eac-rg11", True] < 1.3 * errors["bc5", True], errors
    for two in (True, False):
        sizes = [errors[f"astc-{n}x{n}", two] for n in (4, 5, 6, 8)]
        assert sizes == sorted(sizes), errors
        assert errors["astc-4x4", two] < 2 and errors["astc-8x8", two] < 8, errors
    assert all(errors[f"astc-{w}x{h}", True] < errors[f"astc-{w}x{h}", False] for w, h in SIZES[:8]), errors
