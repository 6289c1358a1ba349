"""When Python looks for garbage."""

from __future__ import annotations

import gc
import weakref
from collections import deque
from unittest.mock import patch

from rapidsim.syntax import garbage_collection
from rapidsim.syntax.garbage_collection import gc_for_server, gc_paused, gc_rarely


class _Connection:
    """What refers to itself, and so goes only when somebody looks for it."""

    def __init__(self) -> None:
        self.own = self


def _left_of(count: int) -> int:
    """How many of so many connections that have ended are still there."""
    ended = [weakref.ref(_Connection()) for _ in range(count)]
    return sum(one() is not None for one in ended)


def test_what_connections_leave_behind_does_not_pile_up_in_a_process_that_stays_on() -> None:
    with gc_rarely():
        assert _left_of(20_000) == 20_000
        with gc_for_server():
            assert _left_of(20_000) < 2_000
        assert _left_of(20_000) == 20_000


def test_what_ends_after_a_while_does_not_pile_up_either() -> None:
    thresholds, before = gc.get_threshold(), [list[int]() for _ in range(200_000)]
    recent = deque[_Connection](maxlen=5_000)
    gc.set_threshold(700, 2, 2)
    with gc_for_server():
        recent.extend(_Connection() for _ in range(40_000))
        kept = sum(type(one) is _Connection for one in gc.get_objects())
    gc.set_threshold(*thresholds)
    assert kept < len(before) / 10


def test_what_was_there_is_looked_through_again_when_the_process_goes_on_otherwise() -> None:
    thresholds, before = gc.get_threshold(), gc.get_freeze_count()
    with gc_for_server():
        assert gc.get_freeze_count() > before
    assert (gc.get_threshold(), gc.get_freeze_count()) == (thresholds, 0)


def test_frozen_objects_are_counted_once_and_stay_frozen() -> None:
    with gc_for_server(), patch.object(gc, "get_freeze_count", wraps=gc.get_freeze_count) as count:
        for _ in range(3):
            with gc_paused():
                pass
        assert count.call_count <= 1
        assert gc.get_freeze_count() > 0


def test_what_programs_leave_behind_does_not_pile_up() -> None:
    ended: list[weakref.ref[_Connection]] = []
    with patch.multiple(garbage_collection, _FEW=10_000, _made=0, _kept=0):
        for _ in range(2):
            with gc_paused():
                ended += [weakref.ref(_Connection()) for _ in range(10_000)]
    assert [one() is None for one in (ended[0], ended[-1])] == [True, False]
