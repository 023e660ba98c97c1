"""Long calls: their progress, and how Ctrl-C ends them."""

import threading
from collections.abc import Callable
from typing import Any

from . import _structs as structs

Progress = Callable[[float], Any]  # of the caller: gets the share that is done; False stops
_SECONDS = 0.05  # between two calls of the caller's progress function


def long_call(work, progress=None):
    """What work(told) returns; `told` is for the library's `progress`.

    The work runs on a thread of its own, so that the caller's can hear Ctrl-C meanwhile and call `progress`. When
    either wants an end, the library is told so, and this returns once it has ended: nothing that it was given is in
    use any more. On other threads than the main one, without a progress function, nobody can ask for an end.
    """
    share, stop = 0.0, False

    def told(_, done):
        nonlocal share
        share = max(share, done)
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
            if progress is not None and progress(min(share, 1.0)) is False:
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
    """Until the work has ended, whatever is pressed: it writes into memory of ours."""
    while not ended.is_set():
        try:
            ended.wait()
        except KeyboardInterrupt:
            pass
