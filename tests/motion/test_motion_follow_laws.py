"""Laws of trajectories: profiles, splines, joint quintics, the sphere around the base."""

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from reference_numbers import recorded

from rapidsim import load_robot
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.waypoints.curves import BaseArc, SplineCurve, StraightLine
from rapidsim.motion.waypoints.follow import follow
from rapidsim.motion.waypoints.keep_out_sphere import ThroughBaseError, around, nearest, pushed_out
from rapidsim.motion.waypoints.piecewise_polynomials import Piecewise
from rapidsim.motion.waypoints.plan import JointsOverTime, Plan, Refused, quintic_motion
from rapidsim.motion.waypoints.points import Points, between, linear_turn_rates, turn
from rapidsim.motion.waypoints.quintic import overshoot, quintics
from rapidsim.motion.waypoints.random_points import shell_points
from rapidsim.motion.waypoints.spline import spline
from rapidsim.motion.waypoints.velocity_profiles import Profile, law

LENGTHS = st.floats(1e-4, 10.0)
SPEEDS = st.floats(1e-3, 5.0)
ACCELERATIONS = st.floats(1e-2, 50.0)
DOWN = np.array([0.0, 1.0, 0.0, 0.0])


@example(Profile.SCURVE, 5.0, 0.001, 5.0, 0.0)
@given(st.sampled_from(Profile), LENGTHS, SPEEDS, ACCELERATIONS, st.floats(0.0, 0.3))
def test_every_profile_ends_at_rest_within_its_limits(
    profile: Profile, length: float, speed: float, acceleration: float, ease: float
) -> None:
    made = law(profile, length, speed, acceleration, ease)
    ends = np.array([0.0, made.end])
    assert made.at(ends)[:, 0] == pytest.approx([0.0, length], abs=1e-9 * length)
    assert made.at(ends, 1)[:, 0] == pytest.approx([0.0, 0.0], abs=1e-6 * speed)
    peak_speed, peak_acceleration = float(made.peak(1)[0]), float(made.peak(2)[0])
    # A short ramp behind a long way begins and ends at times that are rounded.
    rounding = 1e-9 + 1e-15 * made.end * acceleration / speed
    assert peak_speed <= speed * (1.0 + rounding)
    assert peak_acceleration <= acceleration * (1.0 + rounding)
    # One of the two is used up: the profile is as fast as its shape allows.
    assert max(peak_speed / speed, peak_acceleration / acceleration) > 1.0 - rounding
    places = made.at(np.linspace(0.0, made.end, 200))[:, 0]
    assert (np.diff(places) >= -1e-12).all()


def test_the_quintic_profile_has_its_known_peaks() -> None:
    made = law(Profile.QUINTIC, 1.0, 1.875, 1e9)
    assert made.end == pytest.approx(1.0)
    assert made.peak(1) == pytest.approx([1.875])
    assert made.peak(2) == pytest.approx([5.7735026919])
    assert made.coefficients[0, :, 0] == pytest.approx([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])


@pytest.mark.parametrize("ease", [0.0, 0.1, 0.2, 0.3])
def test_the_sigmoid_peaks_at_the_speed_and_not_at_twice(ease: float) -> None:
    """The curve that predecessors drew, in a time in which it keeps the speed asked for."""
    table = recorded("trajectory_type_1_2")["smf_table"][str(ease)]
    made = law(Profile.SIGMOID, 1.0, 0.1, 1e9, ease)
    assert made.end == pytest.approx(2.0 * 1.0 / 0.1 / (1.0 - 2.0 * ease))
    assert made.peak(1) == pytest.approx([0.1])
    shape = made.at(np.array(table["x"]) * made.end)[:, 0]
    assert shape == pytest.approx(table["y"], abs=1e-9)


def test_overshoot_follows_from_the_end_conditions() -> None:
    example = recorded("quintic")["example_smoothstep"]
    knots = np.array([[1.0], [4.0]])
    made = quintics(np.array([5.0, 15.0]), knots, np.array([[6.0], [0.0]]), np.zeros((2, 1)))
    _, high = made.extremes()
    # The record was sampled; the true maximum lies 2e-6 higher.
    assert high[0, 0] == pytest.approx(example["q_max"], abs=1e-5)
    assert high[0, 0] >= example["q_max"]
    assert overshoot(made, knots) == pytest.approx([9.5317], abs=1e-4)
    assert made.at(np.array([example["t_at_max"]]))[0, 0] == pytest.approx(13.532, abs=5e-4)
    # Coefficients in time from 0, as recorded, against ours in time from the start.
    recorded_at = np.polynomial.polynomial.polyval(
        np.linspace(5.0, 15.0, 9), example["coeffs_a0_to_a5"]
    )
    assert made.at(np.linspace(5.0, 15.0, 9))[:, 0] == pytest.approx(recorded_at, abs=1e-9)


@given(st.integers(2, 7), st.integers(0, 2**32 - 1))
def test_quintics_pass_points_with_their_speeds_and_accelerations(count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    times = np.cumsum(rng.uniform(0.1, 2.0, count))
    joints, speeds, accelerations = rng.uniform(-2.0, 2.0, (3, count, 3))
    points = Points(
        rng.uniform(0.0, 1.0, (count, 3)),
        None,
        times=times,
        speeds=speeds,
        accelerations=accelerations,
    )
    made = quintic_motion(points, joints, Plan())
    assert isinstance(made, JointsOverTime)
    for moment in (made.passed, made.passed - 1e-12):
        inside = np.clip(moment, 0.0, made.trajectory.end)
        assert made.trajectory.at(inside) == pytest.approx(joints, abs=1e-6)
        assert made.trajectory.at(inside, 1) == pytest.approx(speeds, abs=1e-6)
        assert made.trajectory.at(inside, 2) == pytest.approx(accelerations, abs=1e-5)


def test_points_at_the_same_time_are_refused_by_number() -> None:
    points = Points(np.array([[0.1, 0.0, 0.0], [0.2, 0.0, 0.0], [0.2, 0.0, 0.0]]), None)
    refused = quintic_motion(points, np.array([[0.0], [1.0], [1.0]]), Plan())
    assert isinstance(refused, Refused)
    assert refused.message == "points 2 and 3 are to be passed at the same time"


@given(st.integers(2, 9), st.integers(0, 2**32 - 1))
def test_splines_pass_their_points_smoothly(count: int, seed: int) -> None:
    rng = np.random.default_rng(seed)
    knots = np.cumsum(rng.uniform(0.2, 2.0, count))
    values = rng.uniform(-1.0, 1.0, (count, 2))
    made = spline(knots, values)
    assert made.at(knots) == pytest.approx(values, abs=1e-9)
    inner = knots[1:-1]
    before = [np.nextafter(knot, -np.inf) for knot in inner]
    for derivative in (1, 2):
        left, right = made.at(np.array(before), derivative), made.at(inner, derivative)
        assert left == pytest.approx(right, abs=1e-6 * (1.0 + np.abs(right).max(initial=0.0)))
    third = 6.0 * made.coefficients[:, 3]
    if count > 3:
        assert third[0] == pytest.approx(third[1], abs=1e-6 * (1.0 + np.abs(third).max()))
        assert third[-1] == pytest.approx(third[-2], abs=1e-6 * (1.0 + np.abs(third).max()))


@pytest.mark.parametrize(
    ("count", "degree"), [(2, 1), (3, 1), (3, 2), (4, 3), (5, 3), (6, 1), (6, 2), (6, 3)]
)
def test_splines_give_polynomials_back(count: int, degree: int) -> None:
    knots = np.array([0.1, 0.3, 1.0, 1.1, 2.0, 3.5])[:count]
    made = spline(knots, (knots**degree)[:, None])
    x = np.linspace(0.1, knots[-1], 50)
    assert made.at(x)[:, 0] == pytest.approx(x**degree, abs=1e-12)


def test_places_on_a_spline_are_ways_along_it() -> None:
    """On a quarter circle of many points, where the length is known."""
    angle = np.linspace(0.0, 0.5 * np.pi, 40)
    positions = np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], axis=1)
    curve = SplineCurve(spline(angle, positions), spline(angle, np.tile(DOWN, (40, 1))))
    assert curve.length == pytest.approx(0.5 * np.pi, abs=1e-6)
    places = np.linspace(0.0, curve.length, 500)
    step = np.linalg.norm(np.diff(curve.at(places).translation, axis=0), axis=1)
    assert step == pytest.approx(np.full(499, step.mean()), rel=1e-6)


def line(start: Array, end: Array) -> StraightLine:
    return StraightLine(start, end, DOWN, DOWN, float(np.linalg.norm(end - start)))


def test_a_line_goes_around_the_sphere_and_nowhere_into_it() -> None:
    asked = line(np.array([0.6, -0.1, 0.05]), np.array([-0.5, 0.15, 0.1]))
    pieces = around(asked, 0.2)
    assert [type(piece) for piece in pieces] == [StraightLine, BaseArc, StraightLine]
    end = asked.start
    for piece in pieces:
        places = piece.at(np.linspace(0.0, piece.length, 300)).translation
        assert places[0] == pytest.approx(end, abs=1e-12)
        assert np.linalg.norm(places, axis=1).min() > 0.2 - 1e-12
        step = np.linalg.norm(np.diff(places, axis=0), axis=1)
        assert step.sum() == pytest.approx(piece.length, rel=1e-4)
        assert step == pytest.approx(np.full(299, step.mean()), rel=1e-6)
        end = places[-1]
    assert end == pytest.approx(asked.end, abs=1e-12)
    # The way round lies in the plane of line and base: it is the line pushed straight out.
    arc = pieces[1].at(np.linspace(0.0, pieces[1].length, 9)).translation
    assert arc @ np.cross(asked.start, asked.end) == pytest.approx(np.zeros(9), abs=1e-12)


def test_lines_outside_stay_and_lines_through_the_middle_are_refused() -> None:
    outside = line(np.array([0.6, 0.3, 0.0]), np.array([-0.6, 0.3, 0.0]))
    assert nearest(outside) == pytest.approx(0.3)
    assert around(outside, 0.2) == (outside,)
    point = line(np.array([0.6, 0.3, 0.2]), np.array([0.6, 0.3, 0.2]))
    assert nearest(point) == pytest.approx(0.7)
    knots = np.array([0.0, 1.0, 2.0])
    row = np.array([[0.6, 0.3, 0.0], [0.0, 0.3, 0.0], [-0.6, 0.3, 0.0]])
    curve = SplineCurve(spline(knots, row), spline(knots, np.tile(DOWN, (3, 1))))
    assert nearest(curve) == pytest.approx(0.3, abs=1e-6)
    arc = BaseArc(np.array([0.0, 0.4, 0.0]), np.array([0.4, 0.0, 0.0]), DOWN, DOWN, 0.2 * np.pi)
    assert nearest(arc) == pytest.approx(0.4)
    with pytest.raises(ThroughBaseError):
        around(line(np.array([0.6, 0.0, 0.0]), np.array([-0.6, 0.0, 0.0])), 0.2)
    with pytest.raises(ThroughBaseError):
        pushed_out(np.zeros((1, 3)), 0.2)
    moved = pushed_out(np.array([[0.05, 0.0, 0.0], [0.0, 0.5, 0.0]]), 0.2)
    assert moved == pytest.approx(np.array([[0.2, 0.0, 0.0], [0.0, 0.5, 0.0]]))


def test_linear_interpolation_of_quaternions_turns_unevenly() -> None:
    """A quarter turn: 81.03 to 94.93 deg for each unit, where slerp keeps 90."""
    ends, middle = np.degrees(linear_turn_rates(0.5 * np.pi))
    assert (ends, middle) == pytest.approx((81.02846845414, 94.93075576423))
    start, end = np.array([1.0, 0.0, 0.0, 0.0]), np.array([0.5**0.5, 0.0, 0.0, 0.5**0.5])
    share = np.linspace(0.0, 1.0, 2001)
    linear = start + share[:, None] * (end - start)
    for attitudes, low, high in (
        (linear / np.linalg.norm(linear, axis=1, keepdims=True), ends, middle),
        (between(start, end, share), 90.0, 90.0),
    ):
        rates = 2000.0 * np.degrees([turn(attitudes[k], attitudes[k + 1]) for k in range(2000)])
        assert rates.min() == pytest.approx(low, rel=5e-4)
        assert rates.max() == pytest.approx(high, rel=5e-4)


def test_points_in_a_shell_are_even_in_its_volume() -> None:
    points = shell_points(0.3, 0.9, 20_000, seed=4)
    radius = np.linalg.norm(points, axis=1)
    assert 0.3 <= radius.min() < 0.31
    assert 0.899 < radius.max() <= 0.9
    known = recorded("kr10")["points_in_shell_check"]["mean_radius_uniform_volume"]
    assert radius.mean() == pytest.approx(known, abs=4e-3)
    assert np.abs(points.mean(axis=0)).max() < 0.01
    assert (shell_points(0.3, 0.9, 20_000, seed=4) == points).all()
    octant = (points > 0.0) @ np.array([1, 2, 4])
    assert np.bincount(octant).min() > 20_000 / 8 * 0.9


@given(st.integers(0, 2**32 - 1), st.integers(1, 6), st.integers(0, 2))
def test_extremes_are_those_that_sampling_finds(seed: int, powers: int, derivative: int) -> None:
    rng = np.random.default_rng(seed)
    breaks = np.concatenate([[0.0], np.cumsum(rng.uniform(0.1, 3.0, 2))])
    made = Piecewise(breaks, rng.uniform(-1.0, 1.0, (2, powers, 3)))
    low, high = made.extremes(derivative)
    for piece in range(2):
        inside = np.linspace(breaks[piece], breaks[piece + 1], 2001)[:-1]
        values = made.at(inside, derivative)
        room = 1e-4 * (1.0 + np.abs(values).max())
        assert (low[piece] <= values.min(axis=0) + 1e-12).all()
        assert (high[piece] >= values.max(axis=0) - 1e-12).all()
        # At its end a piece may be steeper than a step shows.
        step = np.abs(np.diff(values, axis=0)).max(axis=0, initial=0.0)
        assert (low[piece] >= values.min(axis=0) - room - step).all()
        assert (high[piece] <= values.max(axis=0) + room + step).all()


@example((0.75, 0.0005, 1.1), (0.75, 0.0005, 0.8), 1.0)
@example((0.75, 0.03, 1.1), (0.75, 0.03, 0.8), 1.0)
@given(
    st.tuples(st.floats(0.4, 0.9), st.floats(-0.2, 0.2), st.floats(0.7, 1.2)),
    st.tuples(st.floats(0.4, 0.9), st.floats(-0.2, 0.2), st.floats(0.7, 1.2)),
    st.floats(0.05, 2.0),
)
def test_a_line_is_accepted_or_refused_however_finely_it_is_sampled(
    begin: tuple[float, float, float], end: tuple[float, float, float], speed: float
) -> None:
    if np.linalg.norm(np.subtract(begin, end)) < 0.02:
        return
    level = np.tile([0.5**0.5, 0.0, 0.5**0.5, 0.0], (2, 1))
    points = Points(np.array([begin, end]), level)
    plan = Plan(speed=speed)
    robot = load_robot("irb1600")
    found = [
        follow(robot, points, level, Transform.identity(), plan, dt=dt) for dt in (0.012, 0.03, 0.3)
    ]
    refused = [one.message for one in found if isinstance(one, Refused)]
    assert len(refused) in (0, len(found)), refused
    peaks = [one.joint_peaks for one in found if not isinstance(one, Refused)]
    for other in peaks[1:]:
        np.testing.assert_allclose(other, peaks[0], rtol=0.03, atol=0.02)
