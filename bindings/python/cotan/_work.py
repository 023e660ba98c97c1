"""Long calls: their progress, and how Ctrl-C ends them."""

import threading
from collections.abc import Callable
from typing import Any

from . import _structs as structs

Progress = Callable[[float], Any]  # the caller's function: gets the fraction done; returning False stops
_SECONDS = 0.05  # interval between calls of the caller's progress function


def long_call(work, progress=None):
    """Returns work(told); `told` is the callback to pass to the library as `progress`.

    The work runs on its own thread, so that the calling thread can receive Ctrl-C and call `progress`. If either stops
    the work, this function waits until the library has returned and no longer uses its arguments. Without a progress
    function, calls from threads other than the main one cannot be stopped and run directly.
    """
    fraction, stop = 0.0, False

    def told(_, done):
        nonlocal fraction
        fraction = max(fraction, done)
        return int(stop)

    callback = structs.Progress(told)
    if progress is None and threading.current_thread() is not threading.main_thread():
        return work(callback)

    result, failure, ended = None, None, threading.Event()

    def run():
        nonlocal result, failure
        try:
            result = work(callback)
        except BaseException as error:
            failure = error
        finally:
            ended.set()

    thread = threading.Thread(target=run, name="cotan")
    thread.start()
    try:
        while not ended.wait(_SECONDS):
            if progress is not None and progress(min(fraction, 1.0)) is False:
                stop = True
                break
    except BaseException:  # Ctrl-C, or what `progress` raised
        stop = True
        _wait(ended)
        raise
    _wait(ended)
    thread.join()
    if failure is not None:
        raise failure
    if progress is not None and not stop:
        progress(1.0)
    return result


def _wait(ended):
    """Waits until the work has ended, even on Ctrl-C, since it writes into our memory."""
    while not ended.is_set():
        try:
            ended.wait()
        except KeyboardInterrupt:
            pass
