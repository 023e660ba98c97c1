"""Images in other formats, under 1 MB, that decompress to very many pixels, for fuzz/bombs.py. Each maker takes a
random.Random and returns bytes."""
import struct

from bomb_images import deflated


def exr(r):
    """OpenEXR with zeros in ZIP or RLE blocks."""
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
    """Radiance HDR with old run-length encoding, four bytes for any number of pixels."""
    side = r.choice([2048, 6000, 12_000])
    row = b"\x80\x80\x80\x80" + struct.pack("4B", 1, 1, 1, (side - 1) % 256) + struct.pack("4B", 1, 1, 1, (side - 1) // 256)
    return f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {side} +X {side}\n".encode() + row * side


def dds(r):
    """DDS with blocks of eight bytes per 16 pixels, or a header that claims more data."""
    side = r.choice([1024, 1152, 16_384])
    letters = r.choice([b"DXT1", b"ATI1"])
    head = struct.pack("<4s7I44x", b"DDS ", 124, 0x81007, side, side, side * side // 2, 0, r.choice([1, 15, 0xffffffff]))
    head += struct.pack("<2I4s5I", 32, 4, letters, 0, 0, 0, 0, 0) + struct.pack("<5I", 0x1000, 0, 0, 0, 0)
    return head + b"\0" * min(side * side // 2, 900_000)


def zstd(size):
    """Compresses zeros as blocks of one repeated byte, four bytes per 128 KiB."""
    out = b"\x28\xb5\x2f\xfd\xa0" + struct.pack("<I", size)
    while size > 0:
        part = min(size, 1 << 17)
        size -= part
        out += struct.pack("<I", (size == 0) | 1 << 1 | part << 3)[:3] + b"\0"
    return out


def ktx2(r):
    """KTX2 with one level, compressed by zstd or zlib."""
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


class _Bits:
    """A stream of bits, the lowest of each byte first."""

    def __init__(self):
        self.bits, self.count = 0, 0

    def put(self, value, size):
        self.bits |= value << self.count
        self.count += size

    def table(self, symbols):
        """A Huffman table of BasisLZ in which one symbol, or a power of two of them, has codes of equal length."""
        length = max(1, (len(symbols) - 1).bit_length())
        self.put(symbols[-1] + 1, 14), self.put(21, 5)
        for entry in (17, 18, 19, 20, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15, 16):
            self.put(int(entry == length or (entry == 0 and len(symbols) <= symbols[-1])), 3)
        for symbol in range(symbols[-1] + 1):
            self.put(int(symbol in symbols and len(symbols) <= symbols[-1]), 1)

    def code(self, symbols, symbol):
        for k in reversed(range(max(1, (len(symbols) - 1).bit_length()))):
            self.put(symbols.index(symbol) >> k & 1, 1)

    def groups(self, value, size):
        while True:
            self.put(value & ((1 << size) - 1) | (value >> size > 0) << size, size + 1)
            value >>= size
            if value == 0:
                return

    def bytes(self):
        return self.bits.to_bytes(-(-self.count // 8), "little")


def ktx2_runs(r):
    """ETC1S in KTX2: one block from the stream, and runs for all others."""
    width, height = r.choice([(4096, 4096), (12_000, 12_000), (16_384, 8192), (16_384, 300)])
    across, down = -(-width // 8), -(-height // 8)  # groups of 2 x 2 blocks
    endpoints, selectors, tables, slice_ = _Bits(), _Bits(), _Bits(), _Bits()
    for _ in range(4):
        endpoints.table([0])
    endpoints.put(0, 1), endpoints.put(0, 4)  # colour and intensity of one endpoint
    selectors.put(4, 3), selectors.put(0xe4e4e4e4, 32)
    sources, codes = [0, 19, 85, 256], [0, 2]  # left; from the stream, left, above, left; above; a run
    for symbols in (sources, [0], codes, [63]):
        tables.table(symbols)
    tables.put(1, 13)
    slice_.code(sources, 19), slice_.code([0], 0), slice_.code(codes, 0)
    slice_.code(codes, 2), slice_.put(0, 1), slice_.groups(-(-width // 4) * -(-height // 4) - 4, 7)  # 3 more than that
    slice_.code(sources, 0), slice_.code(sources, 256), slice_.groups(across - 5, 4)
    slice_.code(sources, 85), slice_.code(sources, 256), slice_.groups(across * (down - 1) - 4, 4)
    parts = [part.bytes() for part in (endpoints, selectors, tables)]
    data = slice_.bytes()
    shared = struct.pack("<2H4I", 1, 1, *map(len, parts), 0) + struct.pack("<5I", 0, 0, len(data), 0, 0) + b"".join(parts)
    block = struct.pack("<HHHHBBBB4B8B", 0, 0, 2, 40, 163, 1, 1, 0, 3, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0) + struct.pack("<HBBIII", 0, 63, 0, 0, 0, 0xffffffff)
    described = struct.pack("<I", 4 + len(block)) + block
    at = 12 + 36 + 32 + 24
    head = b"\xabKTX 20\xbb\r\n\x1a\n" + struct.pack("<9I", 0, 1, width, height, 0, 0, 1, 1, 1)
    head += struct.pack("<4I2Q", at, len(described), 0, 0, at + len(described), len(shared))
    return head + struct.pack("<3Q", at + len(described) + len(shared), len(data), 0) + described + shared + data


def webp_of(width, height):
    """Lossless WebP of one colour: no bits per pixel."""
    bits, count = 0, 0

    def put(value, size):
        nonlocal bits, count
        bits |= value << count
        count += size
    put(width - 1, 14), put(height - 1, 14), put(1, 1), put(0, 3)  # alpha, version
    put(0, 1), put(0, 1), put(0, 1)                              # no transform, cache, groups
    for symbol in (128, 128, 255, 255, 0):                       # one-symbol codes: green, red, blue, alpha, distance
        put(1, 1), put(0, 1), put(1, 1), put(symbol, 8)
    data = b"\x2f" + bits.to_bytes(count // 8 + 1, "little")
    data += b"\0" * (len(data) % 2)
    return b"RIFF" + struct.pack("<I", 12 + len(data)) + b"WEBPVP8L" + struct.pack("<I", len(data)) + data


def webp_lossless(r):
    """Lossless WebP of one colour."""
    return webp_of(*r.choice([(16_383, 16_383), (8192, 8192), (16_383, 4000), (12_000, 10_000)]))


def gif(r):
    """GIF with many frames that cover the whole canvas."""
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
    """TIFF with deflated strips, or with very many images or strips."""
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


def exr_channels(r):
    """OpenEXR with hundreds of unused channels."""
    side, channels = r.choice([(512, 2000), (2048, 100), (4096, 12)])
    names = sorted(["R", "G", "B"] + [f"x{k}" for k in range(channels)])

    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data
    listed = b"".join(c.encode() + b"\0" + struct.pack("<IIII", r.choice([1, 2]), 0, 1, 1) for c in names)
    box = struct.pack("<4i", 0, 0, side - 1, side - 1)
    head = (b"\x76\x2f\x31\x01\2\0\0\0" + attribute(b"channels", b"chlist", listed + b"\0") + attribute(b"compression", b"compression", b"\3")
            + attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box)
            + attribute(b"lineOrder", b"lineOrder", b"\0") + attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
            + attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0))
            + attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)) + b"\0")
    size = sum(side * (4 if struct.unpack("<I", listed[k:k + 4])[0] == 2 else 2) * 16 for k in offsets_of(listed))
    block = deflated([(b"\0" + b"\x80" * (size - 1), 1)])
    count = min(-(-side // 16), 900_000 // (len(block) + 16))
    at = len(head) + 8 * (-(-side // 16))
    table = b"".join(struct.pack("<Q", at + k * (len(block) + 8)) for k in range(-(-side // 16)))
    return head + table + b"".join(struct.pack("<iI", 16 * k, len(block)) + block for k in range(count))


def offsets_of(listed):
    """Returns the offset of each channel's type in a channel list."""
    at, found = 0, []
    while at < len(listed):
        at = listed.index(b"\0", at) + 1
        found.append(at)
        at += 16
    return found


def exr_tiles(r):
    """OpenEXR with tiles of the same few bytes."""
    side, tile = r.choice([(8192, 64), (16_384, 256), (8192, 16)])

    def attribute(name, kind, data):
        return name + b"\0" + kind + b"\0" + struct.pack("<I", len(data)) + data
    listed = b"".join(c + b"\0" + struct.pack("<IIII", 1, 0, 1, 1) for c in (b"B", b"G", b"R")) + b"\0"
    box = struct.pack("<4i", 0, 0, side - 1, side - 1)
    head = (b"\x76\x2f\x31\x01\2\2\0\0" + attribute(b"channels", b"chlist", listed) + attribute(b"compression", b"compression", b"\3")
            + attribute(b"dataWindow", b"box2i", box) + attribute(b"displayWindow", b"box2i", box)
            + attribute(b"lineOrder", b"lineOrder", b"\0") + attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1))
            + attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0))
            + attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1))
            + attribute(b"tiles", b"tiledesc", struct.pack("<IIB", tile, tile, 0)) + b"\0")
    across = side // tile
    block = deflated([(b"\0" + b"\x80" * (tile * tile * 6 - 1), 1)])
    at = len(head) + 8 * across * across
    table = b"".join(struct.pack("<Q", at + k * (len(block) + 20)) for k in range(across * across))
    blocks = b"".join(struct.pack("<4iI", k % across, k // across, 0, 0, len(block)) + block
                      for k in range(min(across * across, 900_000 // (len(block) + 20))))
    return (head + table + blocks)[:990_000]


def hdr_runs(r):
    """Radiance HDR with new run-length encoding: two bytes per 127 pixels of a component."""
    width = r.choice([2048, 8192, 16_384])
    run = b"".join(bytes([128 + min(127, width - x), 128]) for x in range(0, width, 127))
    row = b"\2\2" + struct.pack(">H", width) + run * 4
    height = min(r.choice([2048, 8192]), 900_000 // len(row))
    return f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + row * height


def dds_blocks(r):
    """DDS with BC7, BC6H or BC5 blocks, also as an array or a cube."""
    side, images = r.choice([(512, 1), (960, 1), (64, 200), (16_384, 1)]), r.choice([0, 6])
    form, array = r.choice([95, 98, 83]), side[1]
    head = struct.pack("<4s7I44x", b"DDS ", 124, 0x81007, side[0], side[0], side[0] * side[0], 0, r.choice([1, 15]))
    head += struct.pack("<2I4s5I", 32, 4, b"DX10", 0, 0, 0, 0, 0) + struct.pack("<5I", 0x401008, 0xfe00 if images else 0, 0, 0, 0)
    head += struct.pack("<5I", form, 3, 4 if images else 0, array, 0)
    return head + bytes([r.randrange(256)]) * min(side[0] * side[0] * array, 920_000)


def ktx2_blocks(r):
    """KTX2 with BC blocks compressed by zstd, with mip levels."""
    side = r.choice([4096, 8192, 16_384])
    levels = []
    for k in range(r.choice([1, 8])):
        levels.append(max(side >> k, 4) ** 2)
    form, model = r.choice([(145, 134), (143, 133), (139, 131)])  # BC7, BC6H, BC4
    block_bytes = 8 if form == 139 else 16
    levels = [size * block_bytes // 16 for size in levels]
    sample = struct.pack("<HBBIII", 0, 8 * block_bytes - 1, 0, 0, 0, 0xffffffff)
    block = struct.pack("<HHHHBBBB4B8B", 0, 0, 2, 24 + 16, model, 1, 1, 0, 3, 3, 0, 0, block_bytes, 0, 0, 0, 0, 0, 0, 0) + sample
    described = struct.pack("<I", 4 + len(block)) + block
    at = 12 + 36 + 32 + 24 * len(levels)
    head = b"\xabKTX 20\xbb\r\n\x1a\n" + struct.pack("<9I", form, 1, side, side, 0, 0, 1, len(levels), 2)
    head += struct.pack("<4I2Q", at, len(described), 0, 0, 0, 0)
    packed, data_at, index = b"", at + len(described), b""
    for size in levels:
        data = zstd(size)
        index += struct.pack("<3Q", data_at + len(packed), len(data), size)
        packed += data
    return head + index + described + packed


def webp_frames(r):
    """WebP with thousands of frames of one colour, each covering the whole canvas."""
    side, count = r.choice([(64, 20_000), (4096, 5000), (16_000, 3)])
    still = webp_of(side, side)[12:]

    def number(value):
        return struct.pack("<I", value)[:3]
    frame = number(0) * 2 + number(side - 1) * 2 + number(10) + b"\0" + still
    frame = b"ANMF" + struct.pack("<I", len(frame)) + frame
    body = b"VP8X" + struct.pack("<I", 10) + b"\x12\0\0\0" + number(side - 1) * 2 + b"ANIM" + struct.pack("<IIH", 6, 0, 0)
    body += frame * min(count, 900_000 // len(frame))
    return b"RIFF" + struct.pack("<I", 4 + len(body)) + b"WEBP" + body


def gif_packed(r):
    """GIF with one image of zeros, compressed by LZW."""
    side = r.choice([4096, 16_000])
    bits, count, width, known = 0, 0, 3, 6
    out = bytearray()

    def put(code):
        nonlocal bits, count
        bits |= code << count
        count += width
        while count >= 8:
            out.append(bits & 255)
            bits >>= 8
            count -= 8
    left, length = side * side, 1
    put(4)
    put(0)
    left -= 1
    while left > 0:
        if known == 4096 or length + 1 > left:
            put(4)
            put(0)
            left -= 1
            width, known, length = 3, 6, 1
            continue
        length += 1
        put(known)
        left -= length
        known += 1
        if known == 1 << width and width < 12:
            width += 1
    put(5)
    out.append(bits & 255)
    blocks = b"".join(bytes([len(out[k:k + 255])]) + out[k:k + 255] for k in range(0, len(out), 255))
    head = b"GIF89a" + struct.pack("<HHBBB", side, side, 0x80, 0, 0) + b"\0\0\0\xff\xff\xff"
    return (head + b"," + struct.pack("<HHHHB", 0, 0, side, side, 0) + b"\2" + blocks)[:950_000] + b"\0;"


def tiff_packbits(r):
    """TIFF with PackBits strips or tiles, two bytes per 128."""
    width, height = r.choice([(8192, 6000), (4096, 4096), (16_384, 3000)])
    tiled = r.random() < 0.5
    rows = 256 if tiled else 64
    across = -(-width // 256) if tiled else 1
    count = -(-height // rows) * across
    strip = b"\x81\0" * (rows * (256 if tiled else width) // 128)
    data = b"II*\0" + struct.pack("<I", 8 + len(strip) + 8 * count) + strip
    offsets = 8 + len(strip)
    data += struct.pack(f"<{count}I", *[8] * count) + struct.pack(f"<{count}I", *[len(strip)] * count)
    fields = [(256, 4, 1, width), (257, 4, 1, height), (258, 3, 1, 8), (259, 3, 1, 32_773), (262, 3, 1, 1), (277, 3, 1, 1)]
    if tiled:
        fields += [(322, 4, 1, 256), (323, 4, 1, 256), (324, 4, count, offsets), (325, 4, count, offsets + 4 * count)]
    else:
        fields += [(273, 4, count, offsets), (278, 4, 1, rows), (279, 4, count, offsets + 4 * count)]
    fields.sort()
    return (data + struct.pack("<H", len(fields)) + b"".join(struct.pack("<HHII", *field) for field in fields) + struct.pack("<I", 0))


MAKERS = {
    "exr": (exr, "exr"), "exr_channels": (exr_channels, "exr"), "exr_tiles": (exr_tiles, "exr"), "hdr": (hdr, "hdr"),
    "hdr_runs": (hdr_runs, "hdr"), "dds": (dds, "dds"), "dds_blocks": (dds_blocks, "dds"), "ktx2": (ktx2, "ktx2"),
    "ktx2_runs": (ktx2_runs, "ktx2"),
    "ktx2_blocks": (ktx2_blocks, "ktx2"), "webp": (webp_lossless, "webp"), "webp_frames": (webp_frames, "webp"), "gif": (gif, "gif"),
    "gif_packed": (gif_packed, "gif"), "bmp": (bmp, "bmp"), "tga": (tga, "tga"), "tiff": (tiff, "tif"),
    "tiff_packbits": (tiff_packbits, "tif"),
}
