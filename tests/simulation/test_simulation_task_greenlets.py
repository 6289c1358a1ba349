"""Tasks have enough frames of C of their own for what NumPy looks at."""

from __future__ import annotations

import ctypes
import sys
from collections.abc import Callable

import pytest
from greenlet import greenlet

from rapidsim.simulation.task_greenlets import task_greenlet

_LOOKED_AT = 10
"""Frames that NumPy asks `backtrace` for, its own among them; here those of ctypes are as many."""


def _is_left(made: Callable[[Callable[[], None]], greenlet]) -> bool:
    """Whether the innermost frames reach the first one of a greenlet."""
    libc = ctypes.CDLL(None)
    libc.backtrace_symbols.restype = ctypes.POINTER(ctypes.c_char_p)
    frames = (ctypes.c_void_p * _LOOKED_AT)()
    found: list[bytes] = []

    def look() -> None:
        count = libc.backtrace(frames, _LOOKED_AT)
        found.extend(libc.backtrace_symbols(frames, count)[:count])

    made(look).switch()
    assert len(found) == _LOOKED_AT
    return any(b"greenlet" in one for one in found)


@pytest.mark.skipif(sys.platform != "linux", reason="NumPy looks at frames of the GNU C library")
def test_numpy_sees_no_frame_that_is_not_of_the_task() -> None:
    """It ended a served controller on Python 3.13, after some seconds, with a violated segment."""
    assert not _is_left(task_greenlet)
    # Without calls through C it would.
    assert _is_left(greenlet)
