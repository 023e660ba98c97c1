"""Runs a file of jobs on a Dask cluster.

    import cotan.dask, distributed
    client = distributed.Client("scheduler:8786")
    report = cotan.dask.run("/farm/jobs.jsonl", "/farm/report.html", client=client)
    print(report["counts"], report["jobs"][0]["name"])         # the worst job comes first

Each task of the cluster is `cotan batch --shard K/N`. The store of results, the jobs and their files must have the same
paths on all workers. A worker that dies loses only its current job: Dask gives its task to another worker, which finds
the finished jobs in the store. See docs/how-to/batch.md.
"""

from __future__ import annotations

import json
import os
import pathlib
import subprocess
from typing import Any, Callable, Optional, Sequence, Union

from .errors import OutputError, StoppedError, UnavailableError, UsageError, error_of

__all__ = ["run"]

Path = Union[str, "os.PathLike[str]"]

_SHARDS_PER_THREAD = 4  # so that a slow one does not keep all others waiting
_NOT_DONE = (2, 5)  # exit codes: some jobs failed, or are over a limit
_OURS = {  # options of the tool, and the arguments that stand for them
    "--store": "store", "--shard": "shards", "-o": "report", "--output": "report", "--json": "report", "--merge": "report",
}


def run(
    jobs: Path,
    report: Optional[Path] = None,
    *,
    store: Optional[Path] = None,
    client: Any = None,
    tool: str = "cotan",
    shards: int = 0,
    options: Sequence[str] = (),
    progress: Optional[Callable[[float], bool]] = None,
) -> dict[str, Any]:
    """Runs the jobs of a file on the workers of a Dask cluster and returns the report of all jobs.

    jobs: the file, one job per line. report: the page to write; None: none. store: the folder of results; None: beside
    the report. client: a distributed.Client; None: the current one. tool: the program cotan, here and on the workers.
    shards: number of parts that the jobs are split into; 0: four for each thread of the cluster, at most one per job.
    options: more arguments of `cotan batch`, such as ["--limit-time", "600"] or ["--jobs=4"], the number of jobs that a
    task runs at a time, 1 by default; not those that the arguments of this function stand for. progress: called with the fraction done,
    0 to 1, after each shard; returning False stops.

    Returns the report of `cotan batch --json`: "counts" by state, "jobs" with the worst first. A failed job is a row of
    the report and raises no exception.

    Raises UsageError for options that this function sets itself, InputError for an invalid file of jobs, OutputError if the store is not writable, UnavailableError if the
    tool cannot be started here or on a worker, StoppedError if `progress` stopped the run, and distributed.KilledWorker
    if a task was lost with four workers.
    """
    import distributed

    if client is None:
        client = distributed.get_client()
    if report is None and store is None:
        raise UsageError("report, store: expected one of them; found none")
    if isinstance(options, str):
        raise UsageError(f"options: expected a list of words such as ['--jobs', '4'], found the text {options!r}")
    names = {word.partition("=")[0] for word in options}
    for name in sorted(names & _OURS.keys()):
        raise UsageError(f"options: expected no {name}, which the argument {_OURS[name]} stands for; found it")
    jobs = str(pathlib.Path(jobs).absolute())
    folder = pathlib.Path(store if store is not None else pathlib.Path(report).with_suffix(".store")).absolute()
    try:
        (folder / "results").mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise OutputError(f"{folder}: cannot create this folder: {error.strerror}") from error
    before = _merge(tool, jobs, folder, None)
    threads = sum(client.nthreads().values()) or 1
    count = shards or max(1, min(len(before["jobs"]), _SHARDS_PER_THREAD * threads))
    words = [tool, "batch", jobs, "--store", str(folder), "--quiet", *(word for word in options if word != "--quiet")]
    if "--jobs" not in names:
        words += ["--jobs", "1"]
    tasks = [
        client.submit(_shard, [*words, "--shard", f"{number}/{count}"], pure=False, key=f"cotan-{os.urandom(6).hex()}-{number}")
        for number in range(1, count + 1)
    ]
    try:
        for done, task in enumerate(distributed.as_completed(tasks), 1):
            task.result()
            if progress is not None and progress(done / count) is False:
                raise StoppedError("stopped by the caller")
    finally:
        client.cancel(tasks)
    return _merge(tool, jobs, folder, report)


def _start(words: Sequence[str]) -> "subprocess.CompletedProcess[str]":
    try:
        return subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", check=False)
    except OSError as error:
        raise UnavailableError(f"{words[0]}: cannot be started: {error.strerror}") from error


def _error(done: "subprocess.CompletedProcess[str]", jobs: str) -> Exception:
    lines = done.stderr.strip().splitlines() or [f"cotan ended with exit code {done.returncode}"]
    status = done.returncode if done.returncode in range(1, 6) else UnavailableError.status  # else a signal
    return error_of(status, lines[-1].removeprefix("cotan: error: "), [jobs])


def _shard(words: Sequence[str]) -> int:
    """Runs a shard on a worker. Failed jobs are rows of the report; only errors that end the whole shard are raised."""
    done = _start(words)
    if done.returncode != 0 and done.returncode not in _NOT_DONE:
        raise _error(done, words[2])
    return done.returncode


def _merge(tool: str, jobs: str, store: pathlib.Path, report: Optional[Path]) -> dict[str, Any]:
    words = [tool, "batch", jobs, "--merge", "--store", str(store), "--json", "-"]
    done = _start(words + (["-o", str(report)] if report is not None else []))
    if not done.stdout:
        raise _error(done, jobs)
    return json.loads(done.stdout)
