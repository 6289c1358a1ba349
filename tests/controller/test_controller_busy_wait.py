"""When a program is looked at for iterations that repeat, and what is found."""

from __future__ import annotations

import math

import pytest

from rapidsim.controller.busy_wait import FIRST_LOOK, LONGEST_ROUND, SELDOM, BusyWaitDetector


class Program:
    """A program whose state repeats after some ticks, from a tick on."""

    def __init__(self, period: int, begins: int = 0) -> None:
        self.period, self.begins, self.used = period, begins, 0

    def state(self) -> list[object]:
        since = self.used - self.begins
        return ["loops", since % self.period] if since >= 0 else ["begins", self.used]


def found(program: Program, detector: BusyWaitDetector, until: int, done: object = 0) -> int | None:
    """Ticks of the iteration that is detected up to a tick."""
    while program.used < until:
        program.used += 1
        if detector.ticks_left(program.used) == 0:
            ticks = detector.observe(program.used, done)
            if ticks is not None:
                return ticks
    return None


@pytest.mark.parametrize("period", [1, 2, 7, 30])
def test_an_iteration_is_found_with_its_ticks(period: int) -> None:
    program = Program(period)
    detector = BusyWaitDetector(program.state)
    assert detector.ticks_left(10) == FIRST_LOOK - 10
    assert found(program, detector, FIRST_LOOK + period - 1) is None
    assert found(program, detector, FIRST_LOOK + LONGEST_ROUND) == period


def test_an_iteration_may_begin_later_than_the_look() -> None:
    program = Program(5, begins=FIRST_LOOK + 20)
    detector = BusyWaitDetector(program.state)
    assert found(program, detector, FIRST_LOOK + 24) is None
    assert found(program, detector, FIRST_LOOK + LONGEST_ROUND) == 5


def test_after_a_skip_it_looks_after_the_next_iteration() -> None:
    program = Program(5)
    detector = BusyWaitDetector(program.state)
    assert found(program, detector, FIRST_LOOK + 20) == 5
    detector.again(program.used, 5)
    assert detector.ticks_left(program.used) == 10
    assert found(program, detector, program.used + 10) is None
    assert found(program, detector, program.used + 20) == 5


def test_looks_without_result_become_rare_until_there_is_an_effect() -> None:
    program = Program(10**9)
    detector = BusyWaitDetector(program.state)
    left = []
    for _ in range(30):
        detector.note_failed_check(program.used)
        left.append(detector.ticks_left(program.used))
    assert left[:3] == [2 * FIRST_LOOK, 4 * FIRST_LOOK, 8 * FIRST_LOOK]
    assert left[-1] == SELDOM
    program.used += SELDOM
    assert detector.observe(program.used, "one effect") is None
    # An effect since then ends the look.
    program.used += 1
    assert detector.observe(program.used, "another") is None
    assert detector.ticks_left(program.used) == 2 * FIRST_LOOK


def test_too_long_an_iteration_and_too_large_a_state_are_given_up() -> None:
    program = Program(10**9)
    detector = BusyWaitDetector(program.state)
    assert found(program, detector, FIRST_LOOK) is None
    program.used = FIRST_LOOK + LONGEST_ROUND - 1
    assert detector.observe(program.used, 0) is None
    assert detector.ticks_left(program.used) == 0
    program.used += 1
    assert detector.observe(program.used, 0) is None
    assert detector.ticks_left(program.used) == 2 * FIRST_LOOK
    large = BusyWaitDetector(lambda: ["x", None])
    assert large.observe(FIRST_LOOK, 0) is None
    assert large.ticks_left(FIRST_LOOK) == SELDOM


def test_what_was_read_stays_for_the_shortest_time() -> None:
    detector = BusyWaitDetector(lambda: ["x"])
    assert detector.stable_until_s == math.inf
    for until_s in (5.0, 3.0, 4.0):
        detector.note_stable_until(until_s)
    assert detector.stable_until_s == 3.0
    detector.observe(FIRST_LOOK, 0)
    assert detector.stable_until_s == math.inf
