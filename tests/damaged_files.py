"""Files that are damaged as a seed says: cut, with changed bytes, or with values that have changed places."""


def damaged(content, kind, chance):
    """The bytes after damage of a kind: 0 and 3: a few are changed, near the beginning or anywhere; 1: the end is missing;
    2: both; 4: bits are flipped; 5: two values of four bytes of the first 400 bytes have changed places; 6: a part is
    there twice; 7: a value of four bytes is as large as can be."""
    broken = bytearray(content[:chance.randrange(len(content))] if kind in (1, 2) else content)
    if kind in (0, 2, 3):
        for _ in range(1 + len(broken) // 400 if broken else 0):
            reach = min(len(broken), 400) if kind < 3 else len(broken)
            broken[chance.randrange(reach)] = chance.choice((0, 255, 128, 127, chance.randrange(256)))
    words = max(1, min(len(broken), 400) // 4)
    first, second = (4 * chance.randrange(words) for _ in range(2))
    if kind == 4:
        for _ in range(chance.randrange(1, 9)):
            broken[chance.randrange(len(broken))] ^= 1 << chance.randrange(8)
    if kind == 5:
        broken[first:first + 4], broken[second:second + 4] = broken[second:second + 4], broken[first:first + 4]
    if kind == 6:
        start, end = sorted(chance.randrange(len(broken)) for _ in range(2))
        broken[end:end] = broken[start:end]
    if kind == 7:
        broken[first:first + 4] = chance.choice((b"\xff\xff\xff\xff", b"\xff\xff\xff\x7f", b"\0\0\0\x80"))
    return bytes(broken)


KINDS = 8


def breakText(text, chance):
    """The text of a glTF or OBJ file with a number, a name or a bracket that has changed."""
    at = chance.randrange(len(text))
    numbers = [i for i, c in enumerate(text) if c.isdigit()]
    number = chance.choice(numbers) if numbers else at
    return chance.choice((text[:at], text[:at] + chance.choice("{}[],:\"/-") + text[at + 1:],
                          text[:number] + chance.choice(("-1", "4294967296", "1e999", "0", "null", "nan")) + text[number + 1:]))
