#!/usr/bin/env python3
"""Compares the manual pages and shell completions with --help and the tool itself, using the real shells.
help_files_test.py TOOL SHARE man|bash|zsh|fish|words; exit code 77 and a reason if the program needed is missing.
SHARE: the folder that the tool wrote with --help-files, or `-` to write one now."""
import os
import pathlib
import pty
import re
import select
import shutil
import subprocess
import sys
import tempfile
import time

tool, part = os.path.abspath(sys.argv[1]), sys.argv[3]
written = tempfile.TemporaryDirectory()
share = pathlib.Path(written.name if sys.argv[2] == "-" else sys.argv[2]).resolve()
if sys.argv[2] == "-":
    subprocess.run([tool, "--help-files", share], check=True)
FRAMES = "cotangent cotangent-2013 nonperspective paper-full paper-nodet paper-transpose paper-orthogonal unit orthonormal " \
    "gradient exact smooth vertex mikktspace triangle area-weighted".split()
# Valid words that need not be offered, because they are implied.
UNTOLD = {("shader", "--set"): {"frame"}}
# Options with names that cannot be listed.
FREE_NAMES = {("cost", "--device"), ("cost", "--name"), ("accuracy", "--scene")}


class Option:
    def __init__(self, line, command):
        # The help follows after two spaces or on the next line.
        names, self.value = re.match(r"  ((?:-\w, )?--?[\w-]+(?:, --[\w-]+)*) ?(\S*)", line).groups()
        self.names = names.split(", ")
        # Any word names a file, and the command would start its work.
        self.words = words_of(command, self.names[-1]) if self.value and not re.match("FILE|PATH", self.value) else []


def words_of(command, option):
    """The words of an option that accepts no others, from its error about an invalid word, before any work."""
    with tempfile.TemporaryDirectory() as folder:
        said = subprocess.run([tool, *command.split(), option, "zzz"], capture_output=True, text=True, cwd=folder,
                              timeout=60).stderr
    told = re.search(rf"error: {option}: expected ([\w, -]+); found 'zzz' \(see", said)
    words = re.split(", | or ", told.group(1)) if told else []
    return [] if any(" " in word for word in words) else words  # such as "a number from 0 to 1"


def help_of(command):
    return subprocess.run([tool, *command.split(), "--help"], capture_output=True, text=True, check=True,
                          env={**os.environ, "COLUMNS": "120"}).stdout


def lines_of(text, kind):
    """The lines that begin an entry of a list: commands, operands, options (dashes), or examples."""
    lists, _, examples = text.partition("\nExamples:\n")
    if kind == "examples":
        return re.findall(r"^  (\S.*)", examples, re.M)
    beginnings = {"commands": "[a-z]", "operands": "[A-Z]", "options": "-"}
    return re.findall(rf"^(  {beginnings[kind]}.*)", lists, re.M)


# Every command by its words, with its help.
commands, options, operands, examples, helps = {}, {}, {}, {}, {}


def read(command):
    text = helps[command] = help_of(command)
    commands[command] = [line.split()[0] for line in lines_of(text, "commands")]
    options[command] = [Option(line, command) for line in lines_of(text, "options")]
    operands[command] = [line.split()[0] for line in lines_of(text, "operands")]
    examples[command] = lines_of(text, "examples")
    for inner in commands[command]:
        read((command + " " + inner).strip())


read("")
assert len(commands) > 20


def need(program):
    if not shutil.which(program):
        print(f"skipped: {program} is missing (scripts/setup test)")
        sys.exit(77)


# ---- the manual ------------------------------------------------------------------------------------------------------


def plain(roff):
    return re.sub(r"\\f[BIR]|\\&", "", roff).replace("\\-", "-").replace("\\(aq", "'").replace("\\e", "\\")


def man():
    need("man")
    pages = {"-".join(["cotan", *command.split()]) + ".1": command for command in commands}
    assert set(pages) == {page.name for page in (share / "man/man1").iterdir()}, "a page for each command and no other"
    for page, command in pages.items():
        file = share / "man/man1" / page
        entries = re.findall(r"^\.TP\n(.*)\n", file.read_text(), re.M)
        named = [plain(line).split(" ")[0] if "--" not in plain(line) else plain(line) for line in entries]
        wanted = [name for option in options[command] for name in option.names]
        said = [name for line in named for name in re.findall(r"(?<!\w)--?[\w-]+", line)]
        assert said == wanted, f"{page}: {set(said) ^ set(wanted)}"
        assert [line for line in named if line in operands[command]] == operands[command], page
        for example in examples[command]:
            assert example in plain(file.read_text()), f"{page}: {example}"
        for inner in commands[command]:
            assert f"{page[:-2]}-{inner}(1)" in named, page
        wrong = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", file], capture_output=True, text=True,
                               env={**os.environ, "MANWIDTH": "80", "LC_ALL": "C.UTF-8"})
        assert wrong.returncode == 0 and not wrong.stderr, f"{page}: {wrong.stderr}"
        # For apropos and whatis.
        name = subprocess.run(["lexgrog", file], capture_output=True, text=True)
        assert name.returncode == 0 and page[:-2] + " - " in name.stdout, name.stdout


# ---- shells: each function maps beginnings of command lines to what the shell offers at their ends --------------------


def bash(lines, folder):
    script = f"set -u; . {share}/bash-completion/completions/cotan\n" + r"""
while IFS= read -r line; do
    # As readline does: words apart at blanks and at '='.
    read -ra COMP_WORDS <<< "${line//=/ = }"
    [[ $line != *[\ ] ]] || COMP_WORDS+=("")
    COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); COMPREPLY=()
    _cotan 2>/dev/null
    (( ${#COMPREPLY[@]} == 0 )) || printf '%s\n' "${COMPREPLY[@]}"
    echo ==
done
"""
    run = subprocess.run(["bash", "-c", script], input="\n".join(lines) + "\n", capture_output=True, text=True, cwd=folder)
    assert not run.stderr, run.stderr
    return [block.splitlines() for block in run.stdout.split("==\n")[:-1]]


def fish(lines, folder):
    need("fish")
    script = f"source {share}/fish/vendor_completions.d/cotan.fish\n"
    script += "".join(f"complete -C '{line}'\necho ==\n" for line in lines)
    home = tempfile.mkdtemp()
    run = subprocess.run(["fish", "--no-config", "-c", script], capture_output=True, text=True, cwd=folder,
                         env={**os.environ, "HOME": home, "XDG_DATA_HOME": home, "LC_ALL": "C.UTF-8"})
    shutil.rmtree(home)
    assert not run.stderr, run.stderr
    offered = [[line.split("\t")[0] for line in block.splitlines()] for block in run.stdout.split("==\n")[:-1]]
    # fish completes the whole word `--frame=x`.
    return [[re.sub(r"^--[\w-]+=", "", word) for word in words] for words in offered]


def zsh(lines, folder):
    need("zsh")
    place = pathlib.Path(tempfile.mkdtemp())
    (place / "setup").write_text(f"""
PS1= ; unsetopt beep list_beep
fpath=({share}/zsh/vendor-completions $fpath)
autoload -U compinit && compinit -D -u
zstyle ':completion:*' insert-tab false
compadd() {{
    if [[ ${{@[1,(i)(-|--)]}} == *-(O|A|D)* ]]; then builtin compadd "$@"; return; fi
    local -a hits
    builtin compadd -A hits "$@"
    (( $#hits )) && print -rl -- $hits >> {place}/now
    builtin compadd "$@"
}}
cotan_begin() {{ : > {place}/now }}
cotan_end() {{ mv {place}/now {place}/done }}
again() {{ compprefuncs=(cotan_begin) comppostfuncs=(cotan_end) }}
again
: > {place}/ready
""")
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(folder)
        os.environ.update(TERM="dumb", HOME=str(place))
        os.execvp("zsh", ["zsh", "-f", "-i"])

    def wait(name):
        late = time.time() + 60
        while not (place / name).exists():
            assert time.time() < late, "zsh does not answer"
            if select.select([terminal], [], [], 0.002)[0]:
                os.read(terminal, 65536)

    os.write(terminal, f". {place}/setup\n".encode())
    wait("ready")
    offered = []
    for line in lines:
        os.write(terminal, line.encode() + b"\t")
        wait("done")
        # A file may be offered by two tags; names are quoted.
        offered.append([word.replace("\\ ", " ") for word in dict.fromkeys((place / "done").read_text().splitlines())])
        (place / "done").unlink()
        os.write(terminal, b"\x15again\n")
    os.write(terminal, b"\x15exit\n")
    os.close(terminal)
    os.waitpid(process, 0)
    shutil.rmtree(place)
    return offered


def offers(shell):
    with tempfile.TemporaryDirectory() as folder:
        for file in ("a model.glb", "rocks.png"):
            (pathlib.Path(folder) / file).touch()
        (pathlib.Path(folder) / "pictures").mkdir()
        everything = {"a model.glb", "rocks.png", "pictures"}
        wanted = []  # (line, words offered at its end)
        for command, inner in commands.items():
            start = f"cotan {command} " if command else "cotan "
            operand = set(commands[""]) - {"help"} if command == "help" else everything if operands[command] else None
            wanted.append((start, set(inner) if inner else operand))
            # zsh offers options with two dashes only after one dash was typed.
            wanted.append((start + "--", {name for option in options[command] for name in option.names if name[:2] == "--"}))
            for option in options[command]:
                line = f"{start}{option.names[-1]} "
                if option.words:
                    wanted.append((line, set(option.words)))
                    wanted.append((f"{start}{option.names[-1]}={option.words[-1][:-1]}",
                                   {word for word in option.words if word.startswith(option.words[-1][:-1])}))
                elif option.value in ("PATH", "FILE"):
                    wanted.append((line, everything))
                elif option.value in ("FOLDER", "DIR"):
                    wanted.append((line, {"pictures"}))
        wanted += [
            ("cotan render --frame ", {"auto", *FRAMES}),
            ("cotan bake --frame ", set(FRAMES)),
            ("cotan render --frame orth", {"orthonormal"}),
            ("cotan render model.glb --frame=mik", {"mikktspace"}),
            ("cotan render -o ", everything),
            ("cotan render -o ro", {"rocks.png"}),
            ("cotan render --quiet --view normal-map-", {"normal-map-red", "normal-map-green", "normal-map-blue"}),
            ("cotan render --environment ", {"studio", "overcast", "evening", "none"} | everything),
            ("cotan map convert --from ", None),
            ("cotan shader --set tone,sha", {"shadow"}),
            ("cotan compare --frames cotangent,mikk", {"mikktspace"}),
            ("cotan map conv", {"convert"}),
            ("cotan frobnicate ", None),
            ("cotan render --size ", {"thumbnail", "720p", "1080p", "1440p", "2160p", "square"}),
            ("cotan bake --size ", set()),
        ]
        found = shell([line for line, _ in wanted], folder)
        assert len(found) == len(wanted)
        for (line, words), said in zip(wanted, found):
            # The last of words with commas; folders may have a slash.
            said = {re.sub(r".*,", "", word).removesuffix("/") for word in said}
            if words is None:
                continue
            # Between words, fish lists `-` options only on request; zsh also lists those of a folder.
            assert said == words, f"{line!r}: missing {words - said}, too many {said - words}"
        return len(wanted)


# ---- words: the tool accepts every word that is offered, by its error about an invalid one ----------------------------


def words():
    checked = 0
    with tempfile.TemporaryDirectory() as folder:
        for command in commands:
            if commands[command]:
                continue
            lines = [f"cotan {command} {option.names[-1]} " for option in options[command]]
            for option, offered in zip(options[command], bash(lines, folder)):
                if option.value in ("NAME", "WORDS", "NAMES", "A,B") and (command, option.names[-1]) not in FREE_NAMES:
                    assert offered, f"{command} {option.names[-1]} takes a name and offers none"
                listed = [word for word in offered if option.value in ("NAME", "WORDS", "NAMES", "A,B", "FRAME", "WAY", "WHO", "TEXT")]
                if not listed or option.words or (command, option.names[-1]) == ("cost", "--family"):
                    continue
                run = subprocess.run([tool, *example_without(command, option), option.names[-1], "zzz"], capture_output=True,
                                     text=True, cwd=folder)
                said = set(re.split(r"[^\w.-]+", run.stderr))
                # Some options check a file first, or the combination of words.
                if "expected" in run.stderr and "'zzz'" in run.stderr and said & set(listed):
                    assert run.returncode == 1 and set(listed) <= said, f"{command}: {set(listed) - said}: {run.stderr}"
                    checked += 1
                    # A plain list of all words: completion offers all of them.
                    told = re.search(r"expected (?:one of )?([\w., -]+); found 'zzz'", run.stderr)
                    names = re.split(", | or ", told.group(1)) if told else []
                    if all(re.fullmatch(r"[\w.-]+", name) for name in names):
                        kept = set(names) - set(listed) - UNTOLD.get((command, option.names[-1]), set())
                        assert not kept, f"{command} {option.names[-1]} also takes {kept}"
    assert checked > 30, checked
    return checked


def example_without(command, option):
    given = examples[command][0].split()[1:]
    for name in option.names:
        if name in given:
            at = given.index(name)
            del given[at:at + 2]
    return given


if part == "man":
    man()
elif part == "words":
    words()
else:
    print(offers({"bash": bash, "fish": fish, "zsh": zsh}[part]), "beginnings of command lines")
