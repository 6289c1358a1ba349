"""Timings laid end to end answer as each of them does."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest
from motion_programs import LIMITS, Programmer, path_of, zone

from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.time_scaling import TimeScaling
from rapidsim.motion.trajectory import command as commands
from rapidsim.motion.trajectory.command import MotionCommand, Piece
from rapidsim.motion.trajectory.time_scalings import TimeScalings, timings_of


def test_all_at_once_is_one_by_one() -> None:
    programs = (
        Programmer().line((0.1, 0, 0)),
        Programmer().line((0.1, 0, 0), z=zone(10)).line((0, 0.1, 0)),
        Programmer().move((0.1, 0.2, 0, 0, 0.1, 0)),
    )
    timings = [plan(path_of(program), LIMITS) for program in programs]
    together = timings_of(timings)
    random = np.random.default_rng(1)
    number = random.integers(0, len(timings), 500)
    t = random.uniform(-0.1, 1.2, 500) * np.array([one.duration for one in timings])[number]
    # Ends, and all nodes of the second, where cells meet.
    t[:6], number[:6] = [0.0, 0.0, 0.0, *(one.duration for one in timings)], [0, 1, 2, 0, 1, 2]
    nodes = timings[1].times
    number, t = np.append(number, np.ones(len(nodes), np.int64)), np.append(t, nodes)
    # Integrals are counted from marks: of one of a single stretch that is its start.
    assert together.begin.tolist() == [0, 1, 2]
    way, once, twice = together.since_marks(number, t)
    for k, one in enumerate(timings):
        at = number == k
        assert way[at] == pytest.approx(one.s_at(t[at]) - one.s[0], abs=1e-15)
        assert once[at] == pytest.approx(one.parameter_integral(t[at]), abs=1e-15)
        alone = timings_of([one]).since_marks(np.zeros(at.sum(), np.int64), t[at])
        assert np.array_equal(alone, np.array([way[at], once[at], twice[at]]))
        fine = np.linspace(0.0, one.duration, 20_001)
        sums = np.cumsum(one.parameter_integral(fine)) * fine[1]
        assert np.interp(t[at], fine, sums) == pytest.approx(twice[at], abs=2e-5)


def test_marks_are_about_a_second_apart() -> None:
    slow = plan(path_of(Programmer().line((0.2, 0, 0), z=zone(10)).line((0, 0.2, 0))), LIMITS)
    long = replace(slow, speed=slow.speed / 10.0)
    apart = np.diff(long.times[long.marks])
    assert len(long.marks) > 5
    assert 0.0 < apart.min() <= apart.max() < 2.5
    stretches = timings_of([long])
    ends = long.times[stretches.last]
    counted = stretches.since_marks(np.arange(len(ends)), ends)
    before = long.times[long.marks]
    whole = long.parameter_integral(ends) - long.parameter_integral(before)
    at_mark = (long.s[long.marks] - long.s[0]) * (ends - before)
    assert counted[0].sum() == pytest.approx(long.s[-1] - long.s[0], abs=1e-12)
    assert counted[1] == pytest.approx(whole - at_mark, abs=1e-9)


def test_a_motion_that_repeats_is_laid_down_once(monkeypatch: pytest.MonkeyPatch) -> None:
    there, back = path_of(Programmer().line((0.1, 0, 0))), path_of(Programmer().line((-0.1, 0, 0)))
    pieces = [Piece(0.0, path, plan(path, LIMITS), 0.0, path.length) for path in (there, back)]
    laid: list[int] = []

    def counted(timings: Sequence[TimeScaling]) -> TimeScalings:
        laid.append(len(timings))
        return timings_of(timings)

    monkeypatch.setattr(commands, "timings_of", counted)
    command = MotionCommand()
    for turn in range(40):
        piece = pieces[turn % 2]
        command.append(replace(piece, start_time=command.end + 0.01))
    times = np.linspace(0.0, command.end, 2_000)
    places = command.place_at(times)
    assert laid == [2]
    starts, _ = command.starts(np.arange(1, 41))
    own = [pieces[turn % 2].timing.s_at(times - start) for turn, start in enumerate(starts)]
    assert places == pytest.approx(np.sum(own, axis=0), abs=1e-12)


def test_many_paths_are_evaluated_as_few_are(monkeypatch: pytest.MonkeyPatch) -> None:
    path = path_of(Programmer().line((0.1, 0, 0), z=zone(10)).line((0, 0.1, 0)))
    timing = plan(path, LIMITS)
    command = MotionCommand()
    for _ in range(10):
        command.append(Piece(command.end, path, timing, 0.0, path.length))
    times = np.random.default_rng(2).uniform(0.0, command.end, 200)
    at_once = command.joints_at(times)
    monkeypatch.setattr(commands, "_PIECES_AT_ONCE", 3)
    in_parts = command.copy().joints_at(times)
    assert in_parts == pytest.approx(at_once, abs=1e-12)
