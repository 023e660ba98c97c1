"""PNG and JPEG images, under 1 MB, with very many pixels, scans or chunks, for fuzz/bombs.py. Each maker takes a
random.Random and returns bytes."""
import struct
import zlib


def deflated(parts, head=True):
    """Returns the zlib stream of parts, each given as (bytes, repetitions)."""
    packer = zlib.compressobj(9, zlib.DEFLATED, 15 if head else -15)
    out = []
    for data, times in parts:
        at_once = max(1, min(times, (1 << 20) // max(len(data), 1)))
        for start in range(0, times, at_once):
            out.append(packer.compress(data * min(at_once, times - start)))
    return b"".join(out) + packer.flush()


def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


PNG_CHANNELS = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}


def png(width, height, bits, colour, row, interlaced=0, between=b""):
    """colour: 0 grey, 2 RGB, 4 grey and alpha, 6 RGBA. row: bytes of each row, truncated or padded with zeros."""
    size = -(-width * bits * PNG_CHANNELS[colour] // 8)
    row = row[:size] + b"\0" * (size - len(row))
    parts = [(b"\0" + row, height)]
    if interlaced:  # about as many bytes, because the rows of a pass are short
        parts = []
        for x0, y0, dx, dy in ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)):
            w, h = -(-(width - x0) // dx), -(-(height - y0) // dy)
            if w > 0 and h > 0:
                parts.append((b"\0" * (1 + -(-w * bits * PNG_CHANNELS[colour] // 8)), h))
    head = struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, interlaced)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + between + chunk(b"IDAT", deflated(parts)) + chunk(b"IEND", b""))


def wide_png(r):
    """PNG with as many pixels as fit, 1 to 16 bits."""
    bits, colour = r.choice([(1, 0), (8, 0), (8, 2), (16, 2), (8, 6), (16, 6)])
    side = int((r.uniform(0.3, 0.9) * 1e9 * 8 / bits / PNG_CHANNELS[colour]) ** 0.5)
    shape = r.choice([1, 1, 16])
    return png(min(side * shape, 900_000), side // shape, bits, colour, b"")


def largest_png(r):
    """PNG of the maximum size that is read."""
    side = r.choice([8192, 12_000, 16_384])
    return png(side, side, r.choice([1, 8]), 0, bytes([r.choice([0, 128, 255])]) * side)


def interlaced_png(r):
    """PNG with seven interlacing passes."""
    side = r.choice([4096, 8192, 12_000])
    return png(side, side, 8, 0, b"", interlaced=1)


def chunks_png(r):
    """PNG with tens of thousands of chunks, or with compressed text that unpacks to hundreds of megabytes."""
    if r.random() < 0.5:
        between = chunk(r.choice([b"tEXt", b"prVt", b"sPLT"]), b"a\0b") * 60_000
    else:
        between = chunk(b"zTXt", b"a\0\0" + deflated([(b"\0" * (1 << 20), 400)])) * 2
    return png(64, 64, 8, 2, b"", between=between)


def marker(code, data):
    return bytes([0xff, code]) + struct.pack(">H", len(data) + 2) + data


def jpeg_head(code, width, height, components):
    tables = marker(0xdb, b"\0" + b"\1" * 64)
    tables += marker(0xc4, b"\0" + b"\1" + b"\0" * 15 + b"\0")  # DC: "0" means no difference
    sampled = b"".join(bytes([k + 1, 0x11, 0]) for k in range(components))
    return b"\xff\xd8" + tables + marker(code, struct.pack(">BHHB", 8, height, width, components) + sampled)


def flat_jpeg(r):
    """Baseline JPEG with two bits per block of 64 pixels."""
    side = r.choice([4096, 8192, 11_000])
    blocks = (-(-side // 8)) ** 2
    ac = marker(0xc4, b"\x10" + b"\1" + b"\0" * 15 + b"\0")  # AC: "0" ends the block
    return (jpeg_head(0xc0, side, side, 1) + ac + marker(0xda, b"\1\1\0\0\x3f\0") + b"\0" * (blocks * 2 // 8) + b"\xff\xd9")


def progressive_jpeg(r):
    """Progressive JPEG with many scans, each covering the whole image without changing it."""
    side = r.choice([1024, 2048, 4096, 8192])
    blocks = (-(-side // 8)) ** 2
    ac = marker(0xc4, b"\x10" + b"\1" + b"\0" * 15 + b"\xe0")  # "0" and 14 ones: a run of 32767 empty blocks
    bits = ("0" + "1" * 14) * (-(-blocks // 32767))
    data = bytes(int(bits[k:k + 8].ljust(8, "1"), 2) for k in range(0, len(bits), 8)).replace(b"\xff", b"\xff\0")
    scan = marker(0xda, b"\1\1\0\1\x3f\0") + data
    count = min(r.choice([20, 90, 5000]), 700_000 // len(scan))
    first = marker(0xda, b"\1\1\0\0\0\0") + b"\0" * (-(-blocks // 8))
    return jpeg_head(0xc2, side, side, 1) + first + ac + scan * count + b"\xff\xd9"


def filtered_png(r):
    """PNG with 16 bits whose rows all use the slowest filter."""
    side = r.choice([4096, 5000, 7000])
    size = side * 8
    row = b"\4" + bytes([r.randrange(2)]) * size
    head = struct.pack(">IIBBBBB", side, side, 16, 6, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", deflated([(row, side)])) + chunk(b"IEND", b"")


def animated_png(r):
    """PNG with thousands of frames, each covering the whole canvas."""
    side, count = r.choice([64, 1000, 8192]), r.choice([10, 3000])
    data = deflated([(b"\0" * (3 * side + 1), side)])
    count = min(count, 900_000 // (len(data) + 100))
    head = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    out = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"acTL", struct.pack(">II", count + 1, 0))
    out += chunk(b"fcTL", struct.pack(">IIIIIHHBB", 0, side, side, 0, 0, 1, 10, 0, 0)) + chunk(b"IDAT", data)
    for k in range(count):
        out += chunk(b"fcTL", struct.pack(">IIIIIHHBB", 2 * k + 1, side, side, 0, 0, 1, 10, 0, 0))
        out += chunk(b"fdAT", struct.pack(">I", 2 * k + 2) + data)
    return out + chunk(b"IEND", b"")


def nearly_flat_png(r):
    """An ordinary flat normal map with a few deviating texels."""
    side = r.choice([4096, 8192])
    rows = []
    for _ in range(side // 64):
        marked = bytearray(bytes([128, 128, 255]) * side)
        for _ in range(r.choice([0, 5])):
            at = 3 * r.randrange(side - 20)
            marked[at:at + 30] = r.randbytes(30)
        rows += [(b"\0" + bytes(marked), 1), (b"\0" + bytes([128, 128, 255]) * side, 63)]
    head = struct.pack(">IIBBBBB", side, side, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", deflated(rows)) + chunk(b"IEND", b"")


def sampled_jpeg(r):
    """Baseline JPEG with four components of different sampling, with or without restart markers."""
    side = r.choice([2048, 4096, 8192])
    tables = marker(0xdb, b"\0" + b"\1" * 64) + marker(0xc4, b"\0" + b"\1" + b"\0" * 15 + b"\0")
    tables += marker(0xc4, b"\x10" + b"\1" + b"\0" * 15 + b"\0")
    first = r.choice([0x11, 0x22, 0x41])
    components = b"".join(bytes([k + 1, first if k == 0 else 0x11, 0]) for k in range(4))
    units = (-(-side // (8 * (first >> 4)))) * (-(-side // (8 * (first & 15))))
    bits = 2 * ((first >> 4) * (first & 15) + 3)
    rest = r.choice([0, 1000])
    data = b"\0" * (units * bits // 8 + 1)
    if rest:
        part = b"\0" * (-(-rest * bits // 8))
        data = b"".join(part + bytes([0xff, 0xd0 + k % 8]) for k in range(units // rest))
    head = b"\xff\xd8" + tables + marker(0xc0, struct.pack(">BHHB", 8, side, side, 4) + components)
    head += marker(0xdd, struct.pack(">H", rest)) if rest else b""
    scan = marker(0xda, b"\4" + b"".join(bytes([k + 1, 0]) for k in range(4)) + b"\0\x3f\0")
    return head + scan + data[:900_000] + b"\xff\xd9"


MAKERS = {
    "png_wide": (wide_png, "png"), "png_largest": (largest_png, "png"), "png_interlaced": (interlaced_png, "png"),
    "png_chunks": (chunks_png, "png"), "png_filtered": (filtered_png, "png"), "png_animated": (animated_png, "png"),
    "png_nearly_flat": (nearly_flat_png, "png"), "jpeg_flat": (flat_jpeg, "jpg"), "jpeg_scans": (progressive_jpeg, "jpg"),
    "jpeg_sampled": (sampled_jpeg, "jpg"),
}
