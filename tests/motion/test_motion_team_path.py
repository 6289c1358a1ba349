"""Paths that are travelled together: one parameter, each robot exactly on its own path."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from motion_programs import MODEL, ROBOT, Programmer, path_of, programs, zone

from rapidsim.frames.transform import Array
from rapidsim.motion.path.path import Path
from rapidsim.motion.path.shared_path import SharedPath, shared_path
from rapidsim.motion.path.shared_progress import PACE
from rapidsim.motion.timing.axis_limits import Limits, combined_limits, limits_of
from rapidsim.motion.timing.planning import plan
from rapidsim.motion.timing.time_scaling import TimeScaling

LIMITS = limits_of(ROBOT, MODEL)


def limits(count: int) -> Limits:
    return combined_limits([LIMITS] * count)


def lines(*lengths: float, millimetres: float = 20.0) -> Path:
    """Lines of some lengths [m], by turns along y and z."""
    program = Programmer()
    for k, length in enumerate(lengths):
        way = (0.0, length, 0.0) if k % 2 == 0 else (0.0, 0.0, length)
        program.line(way, z=zone(millimetres) if k < len(lengths) - 1 else None)
    return path_of(program)


def together(*paths: Path) -> SharedPath:
    team = shared_path(paths)
    assert isinstance(team, SharedPath)
    return team


def timing_of(team: Path) -> TimeScaling:
    return plan(team, limits(len(team.parts)))


def test_a_robot_alone_is_a_team_of_one() -> None:
    alone = lines(0.2, 0.1, 0.15)
    assert shared_path([alone]) is alone
    assert alone.parts == (alone,)


def test_a_team_of_two_equal_robots_takes_as_long_as_one() -> None:
    alone = lines(0.2, 0.1, 0.15)
    team = shared_path([alone, alone])
    assert timing_of(team).duration == pytest.approx(plan(alone, LIMITS).duration, rel=1e-3)
    s = np.linspace(0.0, team.length, 50)
    assert np.array_equal(team.parts[0].evaluate(s).joints, team.parts[1].evaluate(s).joints)
    assert np.abs(team.parts[0].joints_at(s) - team.parts[0].evaluate(s).joints).max() < 1e-11


def test_each_robot_begins_and_ends_its_segments_with_the_others() -> None:
    long, short = lines(0.2, 0.1, 0.15, millimetres=1.0), lines(0.1, 0.2, 0.05, millimetres=1.0)
    team = together(long, short)
    nominal = np.array([0.2, 0.2, 0.15]) / long.programmed.tcp
    assert team.lengths == pytest.approx(PACE * nominal, abs=1e-9)
    assert team.slowest.tolist() == [0, 1, 0]
    for part, own in zip(team.robots, (long, short), strict=True):
        at = part.progress.place(team.segment_starts, team.layout.piece_at(team.segment_starts))
        assert at == pytest.approx(own.segment_starts, abs=1e-3)
        assert part.travelled(np.array([team.length])) == pytest.approx(
            own.travelled(np.array([own.length])), abs=1e-12
        )


def test_a_robot_that_stands_takes_part() -> None:
    standing = path_of(Programmer().line((0.0, 0.0, 0.0), z=zone(10.0)).line((0.0, 0.0, 0.0)))
    moving = lines(0.2, 0.1)
    team = shared_path([standing, moving])
    speed = moving.programmed.tcp[0]
    assert team.stops == pytest.approx(PACE * moving.segment_starts[1:] / speed)
    points = team.parts[0].evaluate(np.linspace(0.0, team.length, 9))
    assert np.ptp(points.joints, axis=0).max() == 0.0
    nobody = shared_path([standing, standing])
    assert (nobody.length, timing_of(nobody).duration) == (0.0, 0.0)


def _same_count(a: Programmer, b: Programmer) -> list[Path]:
    count = min(len(a.segments), len(b.segments))
    cut = [
        [*one.segments[: count - 1], replace(one.segments[count - 1], zone=None)] for one in (a, b)
    ]
    return [path_of(one) for one in cut]


@examples(25)
@given(programs(), programs())
def test_derivatives_are_those_of_the_places(a: Programmer, b: Programmer) -> None:
    team = shared_path(_same_count(a, b))
    if team.length == 0.0:
        return
    bounds = team.layout.bounds
    middle, step = 0.5 * (bounds[1:] + bounds[:-1]), 1e-3 * np.diff(bounds)
    piece = np.arange(len(middle))
    rates = team.rates(middle, piece)
    width = LIMITS.max_speed.size
    for number in range(2):
        part = team.parts[number]
        own = rates.first[:, number * width : (number + 1) * width]
        places = [part.evaluate(middle + sign * step).joints for sign in (-1.0, 1.0)]
        slope = (places[1] - places[0]) / (2.0 * step)[:, None]
        # Where steps are too short, joints have too few digits.
        wide = step > 1e-6
        assert own[wide] == pytest.approx(slope[wide], abs=1e-3 * max(1.0, np.abs(slope).max()))


@examples(25)
@given(programs(), programs(), st.integers(2, 50))
def test_places_never_go_back_and_reach_both_ends(a: Programmer, b: Programmer, n: int) -> None:
    paths = _same_count(a, b)
    team = together(*paths)
    s: Array = np.linspace(0.0, team.length, 10 * n)
    for part, own in zip(team.robots, paths, strict=True):
        course = part.progress
        place = course.place(s, team.layout.piece_at(s))
        assert (np.diff(place) >= -1e-12).all()
        assert (place[0], place[-1]) == (0.0, pytest.approx(own.length, abs=1e-12))
        rate = course.rate(s, team.layout.piece_at(s))
        assert (rate >= -1e-9).all()
        assert (rate <= (1.0 + 1e-9) * own.programmed.tcp.max() / PACE).all()


def test_each_tcp_moves_as_its_own_path_says() -> None:
    team = together(lines(0.2, 0.1, 0.15), lines(0.1, 0.2, 0.05))
    s: Array = team.length * (np.arange(40, dtype=np.float64) + 0.5) / 40.0
    piece, step = team.layout.piece_at(s), 1e-5 * team.length
    for part in team.robots:
        first, second = part.tcp_derivatives(s, piece)
        before, now, after = (
            part.evaluate(s + sign * step).base_from_tcp.translation for sign in (-1.0, 0.0, 1.0)
        )
        inner = np.abs(np.subtract.outer(s, team.layout.bounds)).min(axis=1) > 2.0 * step
        assert first[inner] == pytest.approx(((after - before) / (2.0 * step))[inner], abs=1e-5)
        bend = (after - 2.0 * now + before) / step**2
        assert second[inner] == pytest.approx(bend[inner], abs=0.02 * max(1.0, np.abs(bend).max()))
