"""Mistakes that a fixed set of operators finds in the tokens of a file, as planted by `scripts/mutants --random`.

Works on text as scripts/format leaves it: binary operators have a space on both sides, template brackets have none.
"""
import re

TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
      | (?P<preprocessor>^[ \t]*\#(?:[^\n\\]|\\.)*(?:\\\n[^\n]*)*)
      | (?P<string>R"(?P<mark>[^(\s]*)\(.*?\)(?P=mark)"|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')
      | (?P<number>(?:0[xX][0-9a-fA-F']+|(?:\d[\d']*\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)[a-zA-Z]*)
      | (?P<name>[A-Za-z_]\w*)
      | (?P<operator><=>|<<=|>>=|->|::|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|[-+*/%&|^!~<>=?:;,.(){}\[\]])""",
    re.X | re.S | re.M,
)
SCRIPT_TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/|\#[^\n]*)
      | (?P<string>\"\"\".*?\"\"\"|`(?:[^`\\]|\\.)*`|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'|(?<=[(,=:]\s)/(?:[^/\\\n]|\\.)+/[a-z]*|(?<=\()/(?:[^/\\\n]|\\.)+/[a-z]*)
      | (?P<number>(?:0[xX][0-9a-fA-F]+|\d[\d_]*\.?\d*(?:[eE][-+]?\d+)?))
      | (?P<name>[A-Za-z_$][\w$]*)
      | (?P<operator>===|!==|=>|\*\*|//|->|\?\?|\?\.|\.\.\.|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|[-+*/%&|^!~<>=?:;,.(){}\[\]@])""",
    re.X | re.S,
)
PRECEDENCE = {"*": 5, "/": 5, "%": 5, "+": 6, "-": 6, "<<": 7, ">>": 7, "<=>": 8, "<": 9, "<=": 9, ">": 9, ">=": 9,
              "==": 10, "!=": 10, "&": 11, "^": 12, "|": 13, "&&": 14, "||": 15}
# Typical mistyped replacements.
OPERATORS = {"<": ("<=", ">"), "<=": ("<", ">="), ">": (">=", "<"), ">=": (">", "<="), "==": ("!=",), "!=": ("==",),
             "+": ("-",), "-": ("+",), "*": ("/",), "/": ("*",), "&&": ("||",), "||": ("&&",),
             "===": ("!==",), "!==": ("===",)}
NAMES = {"min": "max", "max": "min", "cotan_min": "cotan_max", "cotan_max": "cotan_min", "and": "or", "or": "and",
         "minimum": "maximum", "maximum": "minimum", "True": "False", "False": "True", "true": "false", "false": "true"}
MEMBERS = {"x": "y", "y": "x", "z": "x", "first": "second", "second": "first", "front": "back", "back": "front",
           "width": "height", "height": "width", "wrapU": "wrapV", "wrapV": "wrapU", "u": "v", "v": "u",
           "begin": "end", "lower_bound": "upper_bound", "minify": "magnify", "some": "every", "any": "all", "all": "any"}
KEYWORDS = frozenset("""return const auto using typedef static constexpr if for while switch case default break continue
struct class enum namespace template public private protected friend throw delete goto extern else do try catch inline
operator new sizeof co_return explicit virtual override requires typename union let var function import export from def
with raise assert pass lambda yield elif except finally global nonlocal in is not async await""".split())

# Functions whose arguments may be exchanged without effect.
EITHER_WAY = frozenset("dot min max cotan_dot cotan_min cotan_max distance ASSERT EXPECT swap".split())


class Token:
    def __init__(self, match):
        self.kind, self.text, self.start, self.end = match.lastgroup, match.group(), match.start(), match.end()
        if self.kind == "mark":
            self.kind = "string"


class Mistake:
    """text[start:end] becomes `wrong`. statement: replaces a statement, whose `right` is then run or not."""

    def __init__(self, kind, start, end, wrong, statement=False):
        self.kind, self.start, self.end, self.wrong, self.statement = kind, start, end, wrong, statement


def tokens_of(text, script):
    tokens = [Token(m) for m in (SCRIPT_TOKEN if script else TOKEN).finditer(text)]
    return [t for t in tokens if t.kind not in ("comment", "preprocessor")]


def partners_of(tokens):
    """For each bracket the index of its partner."""
    partners, open_ones = {}, []
    for i, t in enumerate(tokens):
        if t.kind == "operator" and t.text in "([{":
            open_ones.append(i)
        elif t.kind == "operator" and t.text in ")]}" and open_ones:
            j = open_ones.pop()
            partners[i], partners[j] = j, i
    return partners


class File:
    def __init__(self, text, script=False):
        self.text, self.script = text, script
        self.tokens = tokens_of(text, script)
        self.partners = partners_of(self.tokens)

    def between(self, i, j):
        return self.text[self.tokens[i].start:self.tokens[j].end]

    def is_binary(self, i):
        """Whether token i joins two values: it has spaces on both sides and a value before."""
        t = self.tokens[i]
        if t.kind != "operator" or i == 0 or i + 1 >= len(self.tokens):
            return False
        before = self.tokens[i - 1]
        value = before.kind in ("name", "number", "string") and before.text not in KEYWORDS or before.text in (")", "]", "}")
        return value and self.text[t.start - 1].isspace() and self.text[t.end:t.end + 1].isspace()

    def _ends_operand(self, i, weakest):
        t = self.tokens[i]
        if t.kind == "name":
            return t.text in KEYWORDS and t.text not in ("sizeof", "new")
        if t.kind != "operator":
            return False
        if t.text in (",", ";", "?", ":", "=", "{", "}", "(", "[", ")", "]") or t.text.endswith("=") and t.text not in PRECEDENCE:
            return True
        return self.is_binary(i) and PRECEDENCE.get(t.text, 99) > weakest

    def operands(self, i):
        """First and last token of the operands of binary operator i, or None."""
        strength = PRECEDENCE[self.tokens[i].text]
        first, j = None, i - 1
        while j >= 0:
            t = self.tokens[j]
            if t.text in (")", "]") or t.text == "}" and first == j + 1:
                j = self.partners.get(j, -1)
                if j < 0:
                    return None
            elif self._ends_operand(j, strength):
                break
            first, j = j, j - 1
        last, j = None, i + 1
        while j < len(self.tokens):
            t = self.tokens[j]
            if t.text in ("(", "[") or t.text == "{" and last is not None and self.tokens[last].kind == "name":
                j = self.partners.get(j, -1)
                if j < 0:
                    return None
            elif self._ends_operand(j, strength - 1):
                break
            last, j = j, j + 1
        return None if first is None or last is None else (first, last)

    def chain_start(self, i):
        """The first token of a.b(c)[d] whose last token is i."""
        while i > 0:
            t, before = self.tokens[i], self.tokens[i - 1]
            if t.text in (")", "]"):
                i = self.partners.get(i, i)
                if self.tokens[i - 1].kind == "name" and self.tokens[i - 1].text not in KEYWORDS or self.tokens[i - 1].text in (")", "]"):
                    i -= 1
                    continue
                return i
            if before.text in (".", "->", "::"):
                i -= 2
                continue
            return i
        return i

    def chain_end(self, i):
        """The last token of a.b(c)[d] whose first token is i."""
        if self.tokens[i].text == "(":
            i = self.partners.get(i, i)
        while i + 1 < len(self.tokens):
            after = self.tokens[i + 1]
            if after.text in ("(", "["):
                i = self.partners.get(i + 1, i + 1)
            elif after.text in (".", "->", "::") and i + 2 < len(self.tokens):
                i += 2
            else:
                return i
        return i


def number_mistakes(text):
    m = re.fullmatch(r"(\d[\d']*)([uUlLzZ]*)", text)
    if m:
        value, suffix = int(m[1].replace("'", "")), m[2]
        changed = {value + 1, value - 1, 2 * value, 0} - {value}
        return [f"{v}{suffix}" for v in sorted(changed) if v >= 0 or not suffix]
    m = re.fullmatch(r"((?:\d[\d']*\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)([fF]?)", text)
    if m:
        value = float(m[1].replace("'", ""))
        return [f"{v!r}{m[2]}" for v in sorted({2 * value, 0.0, value + 1} - {value})]
    return []


def _binary(f, i, found):
    t = f.tokens[i]
    if t.text not in OPERATORS or not f.is_binary(i):
        return
    kind = "comparison" if t.text[0] in "<>=!" else "boolean" if t.text in ("&&", "||") else "arithmetic"
    if f.script:
        found += [Mistake(kind, t.start, t.end, wrong) for wrong in OPERATORS[t.text]]
        return
    ends = f.operands(i)
    if t.text in ("+", "-") and any(n.kind == "string" for n in f.tokens[max(0, i - 1):i + 2]):
        return  # string concatenation, which has no other operators
    if ends:
        start, end = f.tokens[ends[0]].start, f.tokens[ends[1]].end
        for wrong in OPERATORS[t.text]:
            found.append(Mistake(kind, start, end, f.text[start:t.start] + wrong + f.text[t.end:end]))


def _names(f, i, found):
    t = f.tokens[i]
    before = f.tokens[i - 1].text if i else ""
    after = f.tokens[i + 1].text if i + 1 < len(f.tokens) else ""
    if t.text in NAMES and (after == "(" or t.text in ("and", "or", "True", "False", "true", "false")):
        if f.script or t.text in ("true", "false"):
            found.append(Mistake("name", t.start, t.end, NAMES[t.text]))
        elif after == "(":
            first = f.chain_start(i)
            last = f.partners.get(i + 1)
            if last:
                start, end = f.tokens[first].start, f.tokens[last].end
                found.append(Mistake("name", start, end, f.text[start:t.start] + NAMES[t.text] + f.text[t.end:end]))
    elif t.text in MEMBERS and before in (".", "->"):
        if f.script:
            found.append(Mistake("member", t.start, t.end, MEMBERS[t.text]))
            return
        first, last = f.chain_start(i), i
        if after == "(":
            last = f.partners.get(i + 1, i)
        start, end = f.tokens[first].start, f.tokens[last].end
        found.append(Mistake("member", start, end, f.text[start:t.start] + MEMBERS[t.text] + f.text[t.end:end]))


def _not(f, i, found):
    t = f.tokens[i]
    if t.text != "!" or i + 1 >= len(f.tokens):
        return
    if f.script:
        found.append(Mistake("boolean", t.start, t.end, ""))
    elif f.tokens[i + 1].kind == "name" or f.tokens[i + 1].text == "(":
        end = f.tokens[f.chain_end(i + 1)].end
        found.append(Mistake("boolean", t.start, end, f"bool({f.text[t.end:end]})"))


PARAMETER = re.compile(r"(?:const )?[A-Za-z_][\w:]*(?:<.*>)?(?:[&*]+ ?\w*| \w+(?: = .*|\[\w*\])?)$", re.S)


def looks_like(argument):
    """Syntactic kind of an argument: arguments of different kinds have different types."""
    return next((c for c in ('"', "'", "[", "{", "&", "nullptr") if argument.startswith(c)), "")


def _arguments(f, i, found):
    """Calls with neighbouring arguments exchanged."""
    if f.tokens[i].text != "(" or i < 1 or f.tokens[i - 1].kind != "name" or f.tokens[i - 1].text in KEYWORDS | EITHER_WAY:
        return
    first = f.chain_start(i - 1)
    if first and f.tokens[first - 1].kind == "name" and f.tokens[first - 1].text not in ("return", "else", "case", "throw", "await", "not", "in"):
        return  # a declaration
    close, j, parts, begin = f.partners.get(i), i + 1, [], i + 1
    if close is None:
        return
    while j <= close:
        t = f.tokens[j]
        if t.text in ("(", "[", "{") and j in f.partners:
            j = f.partners[j]
        elif t.text == "," or j == close:
            if j > begin:
                parts.append((f.tokens[begin].start, f.tokens[j - 1].end))
            begin = j + 1
        j += 1
    if not f.script and any(PARAMETER.match(f.text[a:b]) for a, b in parts):
        return  # a declaration
    for (a, b), (c, d) in zip(parts, parts[1:]):
        if f.text[a:b] != f.text[c:d] and (f.script or looks_like(f.text[a:b]) == looks_like(f.text[c:d])):
            swapped = f.text[c:d] + f.text[b:c] + f.text[a:b]
            if f.script:
                found.append(Mistake("arguments", a, d, swapped))
            else:
                start, end = f.tokens[first].start, f.tokens[close].end
                found.append(Mistake("arguments", start, end, f.text[start:a] + swapped + f.text[d:end]))


EXPRESSION = re.compile(r"(?:\+\+|--|\(?\*)?[A-Za-z_][\w:]*(?:\.|->|\(|\[|\s*(?:[-+*/%|&^]|<<|>>)?=(?!=)|\+\+|--)")


def early_return(text, line):
    """The return statement for the function around `line`, or None in a lambda, whose result type is not written."""
    lines = text[:line].split("\n")[:-1]
    indent = len(text) - line - len(text[line:].lstrip(" "))
    while lines:
        last = lines.pop()
        here = len(last) - len(last.lstrip(" "))
        if not last.strip() or here >= indent:
            continue
        indent = here
        if last.strip() == "{":
            header = []
            while lines and lines[-1].strip() and lines[-1].rstrip()[-1] not in ";}{" and not lines[-1].endswith("public:"):
                header.insert(0, lines.pop().strip())
            said = " ".join(header)
            named = re.match(r"(?:(?:static|inline|constexpr|virtual|friend) |template<[^()]*> ?)*([^(]*)\(", said)
            words = named[1].split() if named else []
            return None if not words else "return;" if "void" in words or len(words) == 1 else "return {};"
        if not re.match(r"(if|else|for|while|do|switch|case|default|try|\}|catch)\b|\} (else|catch)", last.strip()):
            return None
    return None


def _statement(f, i, found):
    """An omitted statement, an omitted guard, an early return."""
    t = f.tokens[i]
    before = f.tokens[i - 1].text if i else ";"
    line = f.text.rfind("\n", 0, t.start) + 1
    if f.text[line:t.start].strip() or before not in (";", "{", "}", ")", "else", ":") and not f.script:
        return
    if t.text == "if" and i + 1 < len(f.tokens) and f.tokens[i + 1].text == "(":
        close = f.partners.get(i + 1)
        condition = f.text[f.tokens[i + 1].end:f.tokens[close].start] if close else "="
        if " = " not in condition and ";" not in condition:
            wrong = "false" if f.script else f"false && ({condition})"
            found.append(Mistake("guard", f.tokens[i + 1].end, f.tokens[close].start, wrong))
        return
    if t.text in KEYWORDS or not EXPRESSION.match(f.text, t.start):
        return
    j = i
    while j < len(f.tokens) and f.tokens[j].text != ";":
        if f.tokens[j].text in ("(", "[", "{") and j in f.partners:
            j = f.partners[j]
        elif f.tokens[j].text in (")", "]", "}"):
            return
        j += 1
    if j >= len(f.tokens) or f.script and "\n\n" in f.text[t.start:f.tokens[j].end]:
        return
    end = f.tokens[j].end
    found.append(Mistake("statement", t.start, end, ";", statement=True))
    early = None if f.script or before in (")", "else") else early_return(f.text, line)
    if early:
        found.append(Mistake("early return", t.start, t.start, early, statement=True))


def constants(f):
    """Compile-time constants as (start, end): a mistake cannot be chosen there at run time."""
    spans = []
    for i, t in enumerate(f.tokens):
        if t.kind != "name" or t.text not in ("constexpr", "static_assert", "enum"):
            continue
        j = i + 1
        while t.text == "constexpr" and j < len(f.tokens) and f.tokens[j].text not in ("=", "{", "(", ";"):
            j += 1
        if t.text == "constexpr" and (j >= len(f.tokens) or f.tokens[j].text not in ("=", "{")):
            continue  # a function, or `if constexpr`
        while j < len(f.tokens) and f.tokens[j].text != ";":
            j = f.partners.get(j, j) + 1 if f.tokens[j].text in ("(", "[", "{") else j + 1
        if j < len(f.tokens):
            spans.append((t.start, f.tokens[j].end))
    return spans


FIXED = re.compile(r"^\s*(?:inline |static |export )*constexpr [^(]*(?:=|\{)|^\s*(?:static_assert|case |template|using |enum |import |from |@|export \{)|= (?:delete|default);|operator|array<[^;(]*,\s*\d+>")


def mistakes_in(text, script=False):
    """All mistakes that the operators produce in a text."""
    f = File(text, script)
    found = []
    for i, t in enumerate(f.tokens):
        _binary(f, i, found)
        if t.kind == "name":
            _names(f, i, found)
        elif t.kind == "number":
            found += [Mistake("constant", t.start, t.end, wrong) for wrong in number_mistakes(t.text)]
        _not(f, i, found)
        _arguments(f, i, found)
        if not (f.script and text.startswith(('"""', "#"))):
            _statement(f, i, found)
    fixed = [] if script else constants(f)
    found = [m for m in found if not any(start <= m.start < end for start, end in fixed)]
    return [m for m in found if not FIXED.search(text[text.rfind("\n", 0, m.start) + 1:text.find("\n", m.start)])]
