"""Interrupted commands clean up and report their progress."""

from __future__ import annotations

import ctypes
import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import sleep
from types import FrameType
from typing import NoReturn

_ARRIVAL_S = 0.05
"""Time [s] within which an interrupt that has been sent arrives."""
_AGAIN_S = 0.5
"""Time [s] from one interrupt to the next: one that arrives in a callback is lost."""


class Terminated(BaseException):
    """SIGTERM: like Ctrl-C, it unwinds the stack, so that no partial file remains."""


@contextmanager
def report_if_interrupted(so_far: Callable[[], str]) -> Iterator[None]:
    """Say how far the work in here was if Ctrl-C or SIGTERM breaks it off.

    Args:
        so_far: Tells it, in words to follow `interrupted` or `terminated`.
    """
    try:
        yield
    except (KeyboardInterrupt, Terminated) as broken_off:
        broken_off.args = (so_far(),)
        raise


class TimeOverError(Exception):
    """The work has taken longer than it may."""


class TimeOverInterrupt(KeyboardInterrupt):
    """Interrupt the work when its time is over; repeated in case a callback swallows it."""


@contextmanager
def limited_to(seconds: float | None) -> Iterator[None]:
    """Interrupt the work in here, as Ctrl-C does, after a time on the computer's clock.

    Args:
        seconds: None for no limit.

    Raises:
        TimeOverError: If it was interrupted; its argument is the progress.
    """
    if seconds is None:
        yield
        return
    lock, done, is_over = threading.Lock(), threading.Event(), threading.Event()
    thread = threading.get_ident()

    def interrupt() -> None:
        wait_s = seconds
        while not done.wait(wait_s):
            with lock:
                if not done.is_set():
                    is_over.set()
                    _interrupt(thread)
            wait_s = _AGAIN_S

    # Its handler is there as long as a signal may come.
    with _interruptible(thread):
        threading.Thread(target=interrupt, name="rapidsim --max-wall", daemon=True).start()
        try:
            try:
                yield
            finally:
                with lock:
                    done.set()
            if is_over.is_set():
                sleep(_ARRIVAL_S)
        except KeyboardInterrupt as interrupted:
            if not is_over.is_set():
                raise
            raise TimeOverError("".join(map(str, interrupted.args))) from None


@contextmanager
def _interruptible(thread: int) -> Iterator[None]:
    """Let a signal interrupt the main thread: not SIGINT, which background jobs ignore."""
    if not _takes_signals(thread):
        yield
        return
    before = signal.signal(signal.SIGALRM, _raise_time_over)
    try:
        yield
    finally:
        signal.signal(signal.SIGALRM, before)


def _takes_signals(thread: int) -> bool:
    return os.name == "posix" and thread == threading.main_thread().ident


def _interrupt(thread: int) -> None:
    """Raise `TimeOverInterrupt` in a thread, even in the main thread that waits for processes."""
    if _takes_signals(thread):
        signal.pthread_kill(thread, signal.SIGALRM)
        return
    exception = ctypes.py_object(TimeOverInterrupt)
    ctypes.pythonapi.PyThreadState_SetAsyncExc(ctypes.c_ulong(thread), exception)


def _raise_time_over(_number: int, _frame: FrameType | None) -> NoReturn:
    raise TimeOverInterrupt
