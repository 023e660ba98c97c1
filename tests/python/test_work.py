"""Long calls: progress, interruption by the caller and by Ctrl-C, threads, memory."""

import os
import pathlib
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest

import cotan
from shapes import bumps, slope, square, write_stretched


def test_progress_rises_to_one_on_the_calling_thread():
    shares, threads = [], set()

    def progress(done):
        shares.append(done)
        threads.add(threading.get_ident())

    cotan.bake(bumps(8), bumps(60), size=512, samples=16, progress=progress)
    assert threads == {threading.get_ident()}
    assert shares == sorted(shares) and shares[-1] == 1 and all(0 <= s <= 1 for s in shares)
    assert len(shares) > 1, "the work was too short to be told of"


def test_progress_never_falls_if_reported_out_of_order():
    from cotan._work import long_call

    def work(told):
        for share in (0.5, 0.2, 0.7, 0.6):
            told(None, share)
            time.sleep(0.15)
        return "done"

    shares = []
    assert long_call(work, shares.append) == "done"
    assert shares == sorted(shares) and {0.5, 0.7, 1.0} <= set(shares)


def calls(tmp_path):
    model = write_stretched(tmp_path)
    return {
        "bake": lambda progress: cotan.bake(bumps(8), bumps(60), size=2048, samples=16, progress=progress),
        "render": lambda progress: cotan.render(shape="teapot", size=(1600, 900), device="reference", progress=progress),
        "lint": lambda progress: cotan.lint(model, progress=progress),
        "convert": lambda progress: cotan.convert(model, progress=progress),
        "tangents": lambda progress: cotan.tangents(bumps(1000), threads=1, progress=progress),
        "smooth_cotangents": lambda progress: cotan.smooth_cotangents(bumps(1000), threads=1, progress=progress),
    }


@pytest.mark.parametrize("name", ["bake", "render", "tangents", "smooth_cotangents"])
def test_false_stops(name, tmp_path):
    with pytest.raises(cotan.StoppedError):
        calls(tmp_path)[name](lambda done: False)


@pytest.mark.parametrize("name", ["bake", "render", "tangents", "smooth_cotangents"])
def test_exceptions_of_progress_are_raised(name, tmp_path):
    def progress(done):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        calls(tmp_path)[name](progress)


@pytest.mark.parametrize("name", ["lint", "convert"])
def test_short_work_reports_one_at_its_end(name, tmp_path):
    shares = []
    calls(tmp_path)[name](shares.append)
    assert shares[-1] == 1


def test_stopped_bake_keeps_out_unchanged():
    out = np.full((2048, 2048, 4), 7, np.uint8)
    with pytest.raises(cotan.StoppedError):
        cotan.bake(bumps(8), bumps(60), size=2048, samples=16, out=out, progress=lambda done: False)
    assert (out == 7).all()


def test_stopped_tangents_keep_out_unchanged():
    mesh = bumps(1000)
    out = np.full((len(mesh.indices), 4), 7, np.float32)
    with pytest.raises(cotan.StoppedError):
        cotan.tangents(mesh, threads=1, out=out, progress=lambda done: False)
    assert (out == 7).all()


INTERRUPTED = """
import sys, time
sys.path.insert(0, {tests!r})
import cotan
from shapes import bumps
low, high = bumps(16), bumps(300)
print("ready", flush=True)
start = time.time()
try:
    {call}
    print("done")
except KeyboardInterrupt:
    print("interrupted")
"""


@pytest.mark.parametrize(
    "call",
    [
        "cotan.bake(low, high, size=4096, samples=16)",
        "cotan.bake(low, high, size=4096, samples=16, progress=lambda done: None)",
        "cotan.render(shape='teapot', size=(4096, 4096), device='reference')",
        "cotan.tangents(bumps(2000), threads=1)",
    ],
)
def test_ctrl_c_ends_long_calls(call, source):
    program = INTERRUPTED.format(tests=str(source / "tests/python"), call=call)
    process = subprocess.Popen([sys.executable, "-c", program], stdout=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "ready\n"
    time.sleep(0.4)
    process.send_signal(signal.SIGINT)
    start = time.time()
    rest = process.communicate(timeout=60)[0]
    assert rest == "interrupted\n" and time.time() - start < 10  # the whole call takes longer; two busy cores are slow


def test_other_threads_run_while_the_library_works():
    counted, ended = 0, threading.Event()

    def count():
        nonlocal counted
        while not ended.is_set():
            counted += 1
            time.sleep(0.001)

    mesh, thread = bumps(600), threading.Thread(target=count)
    thread.start()
    before, start = counted, time.time()
    cotan.tangents(mesh, threads=1)
    meanwhile, seconds = counted - before, time.time() - start
    ended.set()
    thread.join()
    assert meanwhile > max(2, 20 * seconds)  # a thousand per second on an idle machine; one in total if the GIL is held


def test_concurrent_threads_get_the_results_of_one():
    low, high = bumps(6), bumps(30)
    expected = cotan.bake(low, high, size=64).map
    results, failures = [], []

    def work():
        try:
            results.append(cotan.bake(low, high, size=64).map)
            with pytest.raises(cotan.UsageError):
                cotan.bake(low, high, size=64, frame="nonsense")
            cotan.tangents(high)
        except BaseException as error:
            failures.append(error)

    threads = [threading.Thread(target=work) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert not failures and len(results) == 8 and all((r == expected).all() for r in results)


def resident():
    with open("/proc/self/statm", encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20


def print_memory_of_a_loop(folder):
    folder = pathlib.Path(folder)
    model = write_stretched(folder)
    cotan.write_image(folder / "large.png", np.zeros((1024, 1024, 4), np.uint8))
    high = bumps(200)
    for _ in range(40):
        cotan.bake(square(), cotan.Model(high), size=64, mask=True)  # 2 MiB
        cotan.render(model, size=(32, 32), environment="none", device="reference", ground="off")
        cotan.lint(model)
        cotan.convert(model)
        cotan.read_image(folder / "large.png")  # 4 MiB
        cotan.load(model)
        for wrong in (lambda: cotan.load(folder / "missing.glb"), lambda: cotan.bake(square(), high, size=8, frame="x")):
            with pytest.raises(cotan.Error):
                wrong()
        print(resident())


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="skipped: no /proc here")
def test_memory_is_flat_in_a_loop(tmp_path):
    # One heap for all threads: glibc otherwise gives each thread its own, and those grow by turns for hundreds of turns.
    script = f"import test_work; test_work.print_memory_of_a_loop({str(tmp_path)!r})"
    run = subprocess.run([sys.executable, "-c", script], cwd=pathlib.Path(__file__).parent, capture_output=True, text=True,
                         env={**os.environ, "MALLOC_ARENA_MAX": "1", "PYTHONPATH": os.pathsep.join(map(os.path.abspath, sys.path))})
    assert run.returncode == 0, run.stderr
    used = [float(line) for line in run.stdout.split()]
    # 32 turns would lose 64 MiB or more; 3 are seen. The heap shrinks and grows by some 30 from turn to turn: its top is compared.
    assert len(used) == 40 and max(used[32:]) - max(used[:8]) < 20, used


def test_views_of_images_outlive_their_owner(tmp_path):
    gradient = np.arange(64 * 64 * 4, dtype=np.uint32).astype(np.uint8).reshape(64, 64, 4)
    cotan.write_image(tmp_path / "a.png", gradient)
    row = cotan.read_image(tmp_path / "a.png")[3]
    for _ in range(20):
        cotan.read_image(tmp_path / "a.png")
    assert (row == gradient[3]).all()
