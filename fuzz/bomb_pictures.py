"""Pictures under 1 MB of very many pixels, scans, chunks or frames, for fuzz/bombs.py. Each maker takes a random.Random
and returns bytes."""
import struct
import zlib


def deflated(parts, head=True):
    """The zlib stream of parts, each (bytes, how often)."""
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
    """colour: 0 grey, 2 RGB, 4 grey and alpha, 6 RGBA. row: its bytes, cut or filled up with zeros."""
    size = -(-width * bits * PNG_CHANNELS[colour] // 8)
    row = row[:size] + b"\0" * (size - len(row))
    parts = [(b"\0" + row, height)]
    if interlaced:  # about as many bytes; the rows of a pass are short
        parts = []
        for x0, y0, dx, dy in ((0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)):
            w, h = -(-(width - x0) // dx), -(-(height - y0) // dy)
            if w > 0 and h > 0:
                parts.append((b"\0" * (1 + -(-w * bits * PNG_CHANNELS[colour] // 8)), h))
    head = struct.pack(">IIBBBBB", width, height, bits, colour, 0, 0, interlaced)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + between + chunk(b"IDAT", deflated(parts)) + chunk(b"IEND", b""))


def wide_png(r):
    """PNG of as many pixels as fit, 1 to 16 bits."""
    bits, colour = r.choice([(1, 0), (8, 0), (8, 2), (16, 2), (8, 6), (16, 6)])
    side = int((r.uniform(0.3, 0.9) * 1e9 * 8 / bits / PNG_CHANNELS[colour]) ** 0.5)
    shape = r.choice([1, 1, 16])
    return png(min(side * shape, 900_000), side // shape, bits, colour, b"")


def largest_png(r):
    """PNG of the largest picture that is read."""
    side = r.choice([8192, 12_000, 16_384])
    return png(side, side, r.choice([1, 8]), 0, bytes([r.choice([0, 128, 255])]) * side)


def interlaced_png(r):
    """PNG of seven passes."""
    side = r.choice([4096, 8192, 12_000])
    return png(side, side, 8, 0, b"", interlaced=1)


def chunks_png(r):
    """PNG of tens of thousands of chunks, or packed text of gigabytes."""
    if r.random() < 0.5:
        between = chunk(r.choice([b"tEXt", b"prVt", b"sPLT"]), b"a\0b") * 60_000
    else:
        between = chunk(b"zTXt", b"a\0\0" + deflated([(b"\0" * (1 << 20), 400)])) * 2
    return png(64, 64, 8, 2, b"", between=between)


def marker(code, data):
    return bytes([0xff, code]) + struct.pack(">H", len(data) + 2) + data


def jpeg_head(code, width, height, components):
    tables = marker(0xdb, b"\0" + b"\1" * 64)
    tables += marker(0xc4, b"\0" + b"\1" + b"\0" * 15 + b"\0")  # DC: "0" is no difference
    sampled = b"".join(bytes([k + 1, 0x11, 0]) for k in range(components))
    return b"\xff\xd8" + tables + marker(code, struct.pack(">BHHB", 8, height, width, components) + sampled)


def flat_jpeg(r):
    """Baseline JPEG, two bits for a block of 64 pixels."""
    side = r.choice([4096, 8192, 11_000])
    blocks = (-(-side // 8)) ** 2
    ac = marker(0xc4, b"\x10" + b"\1" + b"\0" * 15 + b"\0")  # AC: "0" ends the block
    return (jpeg_head(0xc0, side, side, 1) + ac + marker(0xda, b"\1\1\0\0\x3f\0") + b"\0" * (blocks * 2 // 8) + b"\xff\xd9")


def progressive_jpeg(r):
    """Progressive JPEG of scans that each say nothing about the whole picture."""
    side = r.choice([1024, 2048, 4096, 8192])
    blocks = (-(-side // 8)) ** 2
    ac = marker(0xc4, b"\x10" + b"\1" + b"\0" * 15 + b"\xe0")  # "0" and 14 bits: a run of 16384 empty blocks or more
    bits = ("0" + "1" * 14) * (-(-blocks // 32767))
    data = bytes(int(bits[k:k + 8].ljust(8, "1"), 2) for k in range(0, len(bits), 8)).replace(b"\xff", b"\xff\0")
    scan = marker(0xda, b"\1\1\0\1\x3f\0") + data
    count = min(r.choice([20, 90, 5000]), 700_000 // len(scan))
    first = marker(0xda, b"\1\1\0\0\0\0") + b"\0" * (-(-blocks // 8))
    return jpeg_head(0xc2, side, side, 1) + first + ac + scan * count + b"\xff\xd9"


def exr(r):
    """OpenEXR of zeros in ZIP or RLE blocks."""
    width, height = r.choice([(16_384, 2048), (8192, 8192), (4096, 16_384), (16_000, 10_000)])
    channels = r.choice(["Y", "BGR", "ABGR", "ABGRZ"])
    packing = r.choice([1, 3])
    lines = 16 if packing == 3 else 1

    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data
    listed = b"".join(c.encode() + b"\0" + struct.pack("<IIII", 1, 0, 1, 1) for c in sorted(set(channels))) + b"\0"
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    head = (b"\x76\x2f\x31\x01\2\0\0\0" + attribute(b"channels", b"chlist", listed) + attribute(b"compression", b"compression", bytes([packing]))
            + attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box)
            + attribute(b"lineOrder", b"lineOrder", b"\0") + attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
            + attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0))
            + attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0")
    size = width * 2 * len(set(channels))

    def packed(rows):
        if packing == 3:
            return deflated([(b"\0" + b"\x80" * (size * rows - 1), 1)])
        return b"\x7f\0" * (size // 128 + 1)
    block = packed(lines)
    count = -(-height // lines)
    at = len(head) + 8 * count
    table, blocks = [], []
    for k in range(count):
        data = block if (k + 1) * lines <= height else packed(height - k * lines)
        table.append(struct.pack("<Q", at))
        blocks.append(struct.pack("<iI", k * lines, len(data)) + data)
        at += len(blocks[-1])
    return head + b"".join(table) + b"".join(blocks)


def hdr(r):
    """Radiance of old runs, four bytes for any number of pixels."""
    side = r.choice([2048, 6000, 12_000])
    row = b"\x80\x80\x80\x80" + struct.pack("4B", 1, 1, 1, (side - 1) % 256) + struct.pack("4B", 1, 1, 1, (side - 1) // 256)
    return f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {side} +X {side}\n".encode() + row * side


def dds(r):
    """DDS of blocks, eight bytes for 16 pixels, or a head that promises more."""
    side = r.choice([1024, 1152, 16_384])
    letters = r.choice([b"DXT1", b"ATI1"])
    head = struct.pack("<4s7I44x", b"DDS ", 124, 0x81007, side, side, side * side // 2, 0, r.choice([1, 15, 0xffffffff]))
    head += struct.pack("<2I4s5I", 32, 4, letters, 0, 0, 0, 0, 0) + struct.pack("<5I", 0x1000, 0, 0, 0, 0)
    return head + b"\0" * min(side * side // 2, 900_000)


def zstd(size):
    """Zeros by blocks of one repeated byte, four bytes for 128 KiB."""
    out = b"\x28\xb5\x2f\xfd\xa0" + struct.pack("<I", size)
    while size > 0:
        part = min(size, 1 << 17)
        size -= part
        out += struct.pack("<I", (size == 0) | 1 << 1 | part << 3)[:3] + b"\0"
    return out


def ktx2(r):
    """KTX2 in zstd or zlib, of one level."""
    width, height = r.choice([(4096, 4096), (12_000, 12_000), (16_384, 8192), (16_384, 300)])
    scheme = r.choice([2, 3])
    size = width * height * 4
    data = zstd(size) if scheme == 2 else deflated([(b"\0" * (1 << 20), min(size >> 20, 800))])
    samples = b"".join(struct.pack("<HBBII2I"[:0] + "<HBBIII", 8 * k, 7, 15 if k == 3 else k, 0, 0, 255) for k in range(4))
    block = struct.pack("<HHHHBBBB4B8B", 0, 0, 2, 24 + 16 * 4, 1, 1, 1, 0, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0) + samples
    described = struct.pack("<I", 4 + len(block)) + block
    at = 12 + 36 + 32 + 24
    head = b"\xabKTX 20\xbb\r\n\x1a\n" + struct.pack("<9I", 37, 1, width, height, 0, 0, 1, 1, scheme)
    head += struct.pack("<4I2Q", at, len(described), 0, 0, 0, 0) + struct.pack("<3Q", at + len(described), len(data), size)
    return head + described + data


def webp_lossless(r):
    """WebP without loss of one colour: no bit for a pixel."""
    width, height = r.choice([(16_383, 16_383), (8192, 8192), (16_383, 4000), (12_000, 10_000)])
    bits, count = 0, 0

    def put(value, size):
        nonlocal bits, count
        bits |= value << count
        count += size
    put(width - 1, 14), put(height - 1, 14), put(1, 1), put(0, 3)  # alpha, version
    put(0, 1), put(0, 1), put(0, 1)                              # no transform, cache, groups
    for symbol in (128, 128, 255, 255, 0):                       # a code of one symbol each: green, red, blue, alpha, distance
        put(1, 1), put(0, 1), put(1, 1), put(symbol, 8)
    data = b"\x2f" + bits.to_bytes(count // 8 + 1, "little")
    data += b"\0" * (len(data) % 2)
    return b"RIFF" + struct.pack("<I", 12 + len(data)) + b"WEBPVP8L" + struct.pack("<I", len(data)) + data


def gif(r):
    """GIF of many frames of the whole canvas."""
    side = r.choice([64, 1000, 16_000])
    head = b"GIF89a" + struct.pack("<HHBBB", side, side, 0x80, 0, 0) + b"\0\0\0\xff\xff\xff"
    frame = b"," + struct.pack("<HHHHB", 0, 0, side, side, 0) + b"\2\2\x4c\1\0"
    return head + frame * r.choice([1, 40_000]) + b";"


def bmp(r):
    """BMP in runs of 255 pixels."""
    side = r.choice([4096, 8192, 12_000])
    row = (b"\xff\0" * (side // 255) + bytes([side % 255, 0]) + b"\0\0")
    data = (row * side)[:900_000] + b"\0\1"
    return (b"BM" + struct.pack("<IHHI", 54 + 1024 + len(data), 0, 0, 54 + 1024)
            + struct.pack("<IiiHHIIiiII", 40, side, side, 1, 8, 1, len(data), 0, 0, 256, 0) + b"\0\0\0\0" * 256 + data)


def tga(r):
    """TGA in runs of 128 pixels."""
    side = r.choice([2048, 4000, 5000])
    runs = side * side // 128
    return struct.pack("<BBBHHBHHHHBB", 0, 0, 11, 0, 0, 0, 0, 0, side, side, 8, 0) + (b"\xff\x80" * runs)[:900_000]


def tiff(r):
    """TIFF of deflated strips, or of very many pictures or strips."""
    width, height = r.choice([(8192, 8192), (16_384, 16_384), (16_384, 1000)])
    strips = r.choice([1, 8, 1000])
    rows = -(-height // strips)
    count = -(-height // rows)
    bits = r.choice([8, 16])
    strip = deflated([(b"\0" * (width * bits // 8), rows)])
    pictures = r.choice([1, 300])
    data = b"II*\0" + struct.pack("<I", 8 + len(strip) + 8 * count) + strip
    offsets = 8 + len(strip)
    data += struct.pack(f"<{count}I", *[8] * count) + struct.pack(f"<{count}I", *[len(strip)] * count)
    one = count == 1
    fields = [(256, 4, 1, width), (257, 4, 1, height), (258, 3, 1, bits), (259, 3, 1, 8), (262, 3, 1, 1),
              (273, 4, count, 8 if one else offsets), (277, 3, 1, 1), (278, 4, 1, rows),
              (279, 4, count, len(strip) if one else offsets + 4 * count)]
    for k in range(pictures):
        after = len(data) + 2 + 12 * len(fields) + 4
        data += struct.pack("<H", len(fields)) + b"".join(struct.pack("<HHII", *field) for field in fields)
        data += struct.pack("<I", after if k + 1 < pictures else 0)
    return data


MAKERS = {
    "png_wide": (wide_png, "png"), "png_largest": (largest_png, "png"), "png_interlaced": (interlaced_png, "png"),
    "png_chunks": (chunks_png, "png"), "jpeg_flat": (flat_jpeg, "jpg"), "jpeg_scans": (progressive_jpeg, "jpg"), "exr": (exr, "exr"),
    "hdr": (hdr, "hdr"), "dds": (dds, "dds"), "ktx2": (ktx2, "ktx2"), "webp": (webp_lossless, "webp"), "gif": (gif, "gif"),
    "bmp": (bmp, "bmp"), "tga": (tga, "tga"), "tiff": (tiff, "tif"),
}
