"""Timings laid end to end answer as each of them does."""

from __future__ import annotations

import numpy as np
from motion_programs import LIMITS, Programmer, path_of, zone

from rapidsim.motion.timing.planning import plan
from rapidsim.motion.trajectory.time_scalings import timings_of


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
    place, integral = together.place_and_integral(number, t)
    for k, one in enumerate(timings):
        at = number == k
        assert np.array_equal(place[at], one.s_at(t[at]))
        assert np.array_equal(integral[at], one.way_integral(t[at]))
        alone = timings_of([one]).place_and_integral(np.zeros(at.sum(), np.int64), t[at])
        assert np.array_equal(alone[0], place[at])
        assert np.array_equal(alone[1], integral[at])
