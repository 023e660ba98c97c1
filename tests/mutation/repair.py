"""Updates lines of tests/mutants.txt whose place in the sources has changed."""
import difflib
import re

TOKEN = re.compile(r"\w+|[^\w\s]")


def tokens(text):
    return TOKEN.findall(text)


def nearest(text, wanted):
    """The range of tokens in `text` most similar to `wanted`: (start, end)."""
    best, length = (0.0, 0, 0), len(wanted)
    matcher = difflib.SequenceMatcher(autojunk=False)
    matcher.set_seq2(wanted)
    known = set(wanted)
    for start in range(max(1, len(text) - length // 2)):
        window = text[start:start + length]
        if window[0] not in known or len(known.intersection(window)) < len(known) // 2:
            continue
        matcher.set_seq1(window)
        if matcher.quick_ratio() > best[0] and matcher.ratio() > best[0]:
            best = (matcher.ratio(), start, start + length)
    return best


def repaired(line, source):
    """The line with today's source text, or None if nothing there is similar. The mistake itself, after =>, is kept
    unchanged and needs a look."""
    text, _, wrong = line.partition("=>")
    before, _, rest = text.partition("@{")
    right, _, after = rest.partition("}@")
    old = [tokens(part) for part in (before, right, after)]
    wanted = sum(old, [])
    found = list(TOKEN.finditer(source))
    ratio, start, end = nearest([m.group() for m in found], wanted)
    if ratio < 0.7:
        return None
    # Start and end of the right part in the match, by the tokens that both share.
    window = [m.group() for m in found[start:end]]
    at = {}
    for a, b, size in difflib.SequenceMatcher(None, wanted, window, autojunk=False).get_matching_blocks():
        at.update({a + k: b + k for k in range(size)})
    first, last = len(old[0]), len(old[0]) + len(old[1]) - 1
    inside = [at[k] for k in range(first, last + 1) if k in at]
    if not inside:
        return None
    left = max((at[k] + 1 for k in range(first) if k in at), default=inside[0])
    right_end = min((at[k] - 1 for k in range(last + 1, len(wanted)) if k in at), default=inside[-1])
    spans = [m.span() for m in found[start:end]]
    cut = lambda a, b: " ".join(source[spans[a][0]:spans[b][1]].split()) if b >= a else ""
    parts = (cut(0, left - 1), cut(left, right_end), cut(right_end + 1, len(window) - 1))
    return f"{parts[0]} @{{{parts[1]}}}@ {parts[2]}".strip() + f" => {wrong.strip()}"


def patch(lines, sources):
    """A patch of tests/mutants.txt. lines: (line, file) of those that lost their place. sources: the texts by file."""
    out = ["--- tests/mutants.txt", "+++ tests/mutants.txt"]
    all_lines = sources["tests/mutants.txt"].splitlines()
    for line, file in lines:
        new = repaired(line, sources[file]) if file in sources else None
        if new and new != line:
            number = all_lines.index(line) + 1
            out += [f"@@ -{number} +{number} @@", f"-{line}", f"+{new}"]
    return out if len(out) > 2 else []
