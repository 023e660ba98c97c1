"""Runs jobs on a Dask cluster: a scheduler and four worker processes, one of which is killed during the run.

tests/batch_dask.py COTAN. Exit code 77: Dask is not installed."""

import collections
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time

try:
    import distributed
except ImportError as missing:
    print(f"skipped: {missing}; install python3-distributed")
    sys.exit(77)

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "bindings" / "python"))
import cotan.dask  # noqa: E402

TOOL = os.path.abspath(sys.argv[1])
PICTURES = 40


def write_jobs(file):
    jobs = [
        {
            "name": f"picture {i}",
            "command": ["render", "--shape", "plane", "--device", "reference", "--size", f"{128 + i}x128", "-o", f"out/{i}.png"],
        }
        for i in range(PICTURES)
    ]
    jobs.append({"name": "gone", "command": ["lint", "gone.glb"]})
    jobs.append({"name": "after", "command": ["map", "info", "out/7.png"]})
    file.write_text("".join(json.dumps(job) + "\n" for job in jobs))
    return [job["name"] for job in jobs]


def start(folder, *words):
    environment = {**os.environ, "PYTHONPATH": sys.path[0], "PYTHONDONTWRITEBYTECODE": "1"}
    log = open(folder / "dask.log", "a")
    return subprocess.Popen([sys.executable, "-m", *words], cwd=folder, env=environment, stdout=log, stderr=log)


def kill_in_the_middle(worker, store, killed):
    while len(list(store.glob("results/*/*.json"))) < PICTURES // 4:
        time.sleep(0.02)
    worker.send_signal(signal.SIGKILL)
    killed.append(len(list(store.glob("results/*/*.json"))))


def main(folder):
    wanted = write_jobs(folder / "jobs.jsonl")
    address_file = folder / "scheduler.json"
    processes = [
        start(folder, "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard",
              "--scheduler-file", str(address_file))
    ]
    try:
        workers = [
            start(folder, "distributed.cli.dask_worker", "--scheduler-file", str(address_file), "--no-nanny",
                  "--nthreads", "1", "--no-dashboard", "--local-directory", str(folder / "local"), "--name", f"w{i}")
            for i in range(4)
        ]
        processes += workers
        with distributed.Client(scheduler_file=str(address_file), timeout=60) as client:
            client.wait_for_workers(4, timeout=60)
            killed, shares = [], []
            killer = threading.Thread(target=kill_in_the_middle, args=(workers[1], folder / "r.store", killed), daemon=True)
            killer.start()
            report = cotan.dask.run(folder / "jobs.jsonl", folder / "r.html", client=client, tool=TOOL, progress=shares.append)
            killer.join()
            assert workers[1].wait() == -signal.SIGKILL
            assert killed[0] < len(wanted), "it was killed after the last job"
            assert shares[-1] == 1 and shares == sorted(shares), shares

            times = collections.Counter(job["name"] for job in report["jobs"])
            assert sorted(times) == sorted(wanted) and set(times.values()) == {1}, times
            wrong = [j for j in report["jobs"] if j["state"] != ("failed" if j["name"] == "gone" else "done")]
            assert not wrong, wrong
            assert report["jobs"][0]["name"] == "gone", "the worst comes first"
            assert (folder / "r.html").stat().st_size > 10000
            assert all((folder / "out" / f"{i}.png").exists() for i in range(PICTURES))
            assert not list(folder.glob("out/.cotan-*")), "unfinished files"

            # A second run keeps all results.
            before = time.monotonic()
            again = cotan.dask.run(folder / "jobs.jsonl", store=folder / "r.store", client=client, tool=TOOL)
            assert again["counts"] == report["counts"] and time.monotonic() - before < 30

            # Options in every spelling, and wrong ones in one line.
            for options in (["--jobs=2"], ["--jobs", "2"], ["--jobs=2", "--limit-time=600", "--quiet", "--again"]):
                counts = cotan.dask.run(folder / "jobs.jsonl", store=folder / "r.store", client=client, tool=TOOL, options=options)["counts"]
                assert counts == report["counts"], (options, counts)

            # Errors have the text of the command line.
            (folder / "bad.jsonl").write_text("{}\n")
            for words, error in (
                ({"jobs": folder / "bad.jsonl"}, cotan.InputError),
                ({"jobs": folder / "none.jsonl"}, cotan.InputError),
                ({"tool": "/no/such/tool"}, cotan.UnavailableError),
                ({"options": ["--limit-seconds", "x"]}, cotan.UsageError),
                ({"options": ["-j4"]}, cotan.UsageError),
                ({"options": ["--jobs 4"]}, cotan.UsageError),
                ({"options": ["--store=elsewhere"]}, cotan.UsageError),
            ):
                arguments = {"jobs": folder / "jobs.jsonl", "report": folder / "x.html", "client": client, "tool": TOOL, **words}
                try:
                    cotan.dask.run(**arguments)
                except error as told:
                    assert "\n" not in str(told) and str(told), told
                else:
                    raise AssertionError(f"{words}: no error")
            print(f"{len(times)} jobs, one of four workers killed after {killed[0]}: every one once in the report")
            print("dask", distributed.__version__)
    except BaseException:
        print((folder / "dask.log").read_text()[-4000:], file=sys.stderr)
        raise
    finally:
        for process in processes:
            process.kill()
            process.wait()


with tempfile.TemporaryDirectory() as temporary:
    main(pathlib.Path(temporary))
