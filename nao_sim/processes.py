"""Processes that end with the one that started them, and a way to end that cleans up behind itself."""

from __future__ import annotations

import os
import signal
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

_LOOK_S = 1.0


class Stopped(BaseException):
    """This process was asked to end: by Ctrl-C, or by SIGTERM.

    Like ``KeyboardInterrupt`` no ``except Exception`` holds it up, and what cleans up on the way out does.

    Attributes:
        exit_code: 128 and the signal's number, as shells have it.
    """

    def __init__(self, number: int) -> None:
        super().__init__(f"stopped by {signal.Signals(number).name}")
        self.exit_code = 128 + number


@contextmanager
def stopped_by_signals() -> Iterator[None]:
    """Turn Ctrl-C and SIGTERM into :class:`Stopped` while the block runs; in the main thread only."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(number: int, _: FrameType | None) -> None:
        # A second one must not interrupt the cleaning up.
        for each in (signal.SIGINT, signal.SIGTERM):
            signal.signal(each, signal.SIG_IGN)
        raise Stopped(number)

    before = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def end_with_parent(parent: int) -> None:
    """Let this worker process end when its parent does, however that ends; call it once in each worker.

    A parent that is killed cannot tell its workers, which would wait for work for ever.

    Args:
        parent: its process id; asking the system for it may come too late.
    """

    def watch() -> None:
        while os.getppid() == parent:
            time.sleep(_LOOK_S)
        os._exit(1)

    # Ctrl-C in a terminal reaches the workers, too; it is the parent's to answer.
    if threading.current_thread() is threading.main_thread():
        signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=watch, name="parent", daemon=True).start()


@contextmanager
def joblib_workers() -> Iterator[None]:
    """Make joblib's workers end with this process; for work that is started inside the block."""
    import joblib

    with joblib.parallel_config(backend="loky", initializer=end_with_parent, initargs=(os.getpid(),)):
        yield


def end_children() -> None:
    """End this process's own worker processes now."""
    import multiprocessing

    for child in multiprocessing.active_children():
        child.terminate()
    try:
        from joblib.externals.loky import reusable_executor
    except ImportError:
        return
    executor = reusable_executor._executor
    if executor is not None:
        executor.shutdown(wait=False, kill_workers=True)


def alive(pid: int) -> bool:
    """Return whether a process of this number is there."""
    try:
        os.kill(pid, 0)
    except ProcessLookupError:
        return False
    except (PermissionError, OverflowError):
        return True
    return True
