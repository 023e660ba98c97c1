"""The files of the repository."""

import os
import pathlib
import subprocess


def tracked(sources):
    """The names of the files below the folder: those that git tracks or would add, or all but builds without git."""
    command = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    try:
        listed = subprocess.run(command, cwd=sources, capture_output=True, check=True).stdout
        names = [os.fsdecode(name) for name in listed.split(b"\0") if name]
    except (OSError, subprocess.CalledProcessError):
        names = [str(file.relative_to(sources)) for file in pathlib.Path(sources).rglob("*")]
        names = [name for name in names if name.split(os.sep)[0] not in (".git", "build", "out")]
    return sorted(name for name in set(names) if (pathlib.Path(sources) / name).is_file())
