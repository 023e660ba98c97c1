"""Jobs on a cluster, with a fake client and a fake tool that record their calls: no cluster is started."""

import json
import sys
import types

import pytest

import cotan
import cotan.dask

# Records its arguments. A merge prints a report with as many jobs as the file has lines; a shard exits with the code in
# "codes" for its number.
TOOL = """#!{python} -IS
import json, os, pathlib, signal, sys
words, folder = sys.argv[1:], pathlib.Path(sys.argv[0]).parent
with open(folder / "asked", "a") as asked:
    asked.write(json.dumps(words) + "\\n")
if "--merge" in words:
    if pathlib.Path(words[1]).name == "bad":
        print("cotan: error: bad:1: no JSON", file=sys.stderr)
        sys.exit(2)
    jobs = pathlib.Path(words[1]).read_text().splitlines()
    print(json.dumps({{"jobs": jobs, "page": words[words.index("-o") + 1] if "-o" in words else None}}))
else:
    code = json.loads((folder / "codes").read_text()).get(words[words.index("--shard") + 1].split("/")[0], 0)
    if code < 0:
        os.kill(os.getpid(), -code)
    if code:
        print("a note\\ncotan: error: what is wrong", file=sys.stderr)
    sys.exit(code)
"""


class Task:
    def __init__(self, work, words):
        self.work, self.words = work, words

    def result(self):
        return self.work(self.words)


class Client:
    def __init__(self, **threads):
        self.threads, self.keys, self.tasks, self.cancelled = threads, [], [], []

    def nthreads(self):
        return self.threads

    def submit(self, work, words, pure, key):
        assert pure is False  # the same arguments run again
        self.keys.append(key)
        self.tasks.append(Task(work, words))
        return self.tasks[-1]

    def cancel(self, tasks):
        self.cancelled += tasks


@pytest.fixture
def farm(tmp_path, monkeypatch):
    """run(jobs, ...) with a client of three threads in two workers, which is the current client."""
    tool = tmp_path / "tool"
    tool.write_text(TOOL.format(python=sys.executable))
    tool.chmod(0o755)
    present = Client(a=2, b=1)
    monkeypatch.setitem(
        sys.modules, "distributed", types.SimpleNamespace(as_completed=lambda tasks: list(reversed(tasks)), get_client=lambda: present)
    )

    class Farm:
        folder, client = tmp_path, present

        def run(self, count=2, codes=None, name="jobs", **more):
            (tmp_path / name).write_text("{}\n" * count)
            (tmp_path / "codes").write_text(json.dumps(codes or {}))
            (tmp_path / "asked").write_text("")
            more.setdefault("store", tmp_path / "s")
            return cotan.dask.run(tmp_path / name, tool=more.pop("tool", str(tool)), **more)

        def asked(self):
            return [json.loads(line) for line in (tmp_path / "asked").read_text().splitlines()]

    return Farm()


def test_each_part_is_one_task_and_the_report_covers_all(farm):
    folder = farm.folder
    shares = []
    report = farm.run(7, report=folder / "r.html", store=None, progress=shares.append, options=["--retries", "2"])
    assert report == {"jobs": ["{}"] * 7, "page": str(folder / "r.html")}
    assert shares == [k / 7 for k in range(1, 8)]
    merge = ["batch", str(folder / "jobs"), "--merge", "--store", str(folder / "r.store"), "--json", "-"]
    asked = farm.asked()
    assert asked[0] == merge
    assert asked[-1] == merge + ["-o", str(folder / "r.html")]
    shard = ["batch", str(folder / "jobs"), "--store", str(folder / "r.store"), "--quiet", "--retries", "2", "--jobs", "1"]
    assert asked[1:-1] == [shard + ["--shard", f"{k}/7"] for k in range(7, 0, -1)]
    assert (folder / "r.store" / "results").is_dir()
    assert len(set(farm.client.keys)) == 7
    assert farm.client.cancelled == farm.client.tasks


@pytest.mark.parametrize(
    "count, threads, more, parts",
    [
        (20, {"a": 2, "b": 1}, {}, 12),  # four per thread
        (12, {"a": 2, "b": 1}, {}, 12),
        (3, {"a": 2, "b": 1}, {}, 3),  # at most one per job
        (0, {"a": 2}, {}, 1),
        (20, {}, {}, 4),  # no worker has connected yet
        (20, {"a": 2}, {"shards": 5}, 5),
        (2, {"a": 2}, {"shards": 5}, 5),
    ],
)
def test_number_of_parts_follows_the_threads(farm, count, threads, more, parts):
    client = Client(**threads)
    assert farm.run(count, client=client, **more)["page"] is None
    assert [task.words[-1] for task in client.tasks] == [f"{k}/{parts}" for k in range(1, parts + 1)]
    assert not farm.client.tasks


@pytest.mark.parametrize("options", [["--jobs", "3"], ["--jobs=3"], ["--limit-time=9", "--jobs=3", "--retries", "2"]])
def test_concurrent_jobs_may_be_given_in_every_spelling(farm, options):
    farm.run(1, options=options)
    assert farm.asked()[1][5:] == options + ["--shard", "1/1"]


def test_quiet_is_given_once(farm):
    farm.run(1, options=("--quiet",))
    assert farm.asked()[1][4:] == ["--quiet", "--jobs", "1", "--shard", "1/1"]


@pytest.mark.parametrize(
    "options, text",
    [
        (["--store=elsewhere"], "options: expected no --store, which the argument store stands for; found it"),
        (["--store", "elsewhere"], "options: expected no --store, which the argument store stands for; found it"),
        (["--shard=1/2"], "options: expected no --shard, which the argument shards stands for; found it"),
        (["-o", "r.html"], "options: expected no -o, which the argument report stands for; found it"),
        (["--merge"], "options: expected no --merge, which the argument report stands for; found it"),
        ("--jobs=4", "options: expected a list of words such as ['--jobs', '4'], found the text '--jobs=4'"),
    ],
)
def test_options_that_the_arguments_stand_for_are_refused_before_anything_runs(farm, options, text):
    with pytest.raises(cotan.UsageError) as raised:
        farm.run(2, options=options)
    assert str(raised.value) == text
    assert farm.asked() == []


@pytest.mark.parametrize("answer, calls", [(False, 1), (True, 3), (None, 3), (0, 3)])
def test_only_false_from_progress_stops_the_run(farm, answer, calls):
    shares = []

    def progress(share):
        shares.append(share)
        return answer

    if answer is False:
        with pytest.raises(cotan.StoppedError, match="stopped by the caller"):
            farm.run(3, progress=progress)
    else:
        farm.run(3, progress=progress)
    assert len(shares) == calls
    assert farm.client.cancelled == farm.client.tasks


@pytest.mark.parametrize("code", [2, 5])
def test_unfinished_jobs_are_rows_of_the_report(farm, code):
    assert len(farm.run(2, codes={"1": code, "2": code})["jobs"]) == 2


@pytest.mark.parametrize(
    "code, error, text",
    [
        (1, cotan.UsageError, "what is wrong"),
        (3, cotan.UnavailableError, "what is wrong"),
        (4, cotan.OutputError, "what is wrong"),
        (6, cotan.UnavailableError, "what is wrong"),
        (-9, cotan.UnavailableError, "cotan ended with exit code -9"),
    ],
)
def test_failure_of_a_whole_part_is_raised(farm, code, error, text):
    with pytest.raises(error) as raised:
        farm.run(2, codes={"2": code})
    assert str(raised.value) == text
    assert farm.client.cancelled == farm.client.tasks


def test_missing_arguments_and_tools_are_named(farm):
    with pytest.raises(cotan.UsageError, match="report, store: expected one of them; found none"):
        farm.run(2, store=None)
    (farm.folder / "file").write_text("")
    with pytest.raises(cotan.OutputError, match="cannot create this folder"):
        farm.run(2, store=farm.folder / "file")
    with pytest.raises(cotan.UnavailableError, match="gone: cannot be started: No such file or directory"):
        farm.run(2, tool=str(farm.folder / "gone"))
    with pytest.raises(cotan.InputError) as raised:
        farm.run(2, name="bad")
    assert str(raised.value) == "bad:1: no JSON"
