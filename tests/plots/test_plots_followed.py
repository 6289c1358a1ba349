"""Pictures of a trajectory without a program."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from rapidsim.colours import LIGHT
from rapidsim.frames.transform import Transform
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.waypoints.attitudes import attitude_rates
from rapidsim.motion.waypoints.follow import FollowedTrajectory, follow
from rapidsim.motion.waypoints.plan import Plan, Way
from rapidsim.motion.waypoints.points import Points
from rapidsim.plots import write
from rapidsim.plots.followed_pictures import (
    deviation_picture,
    orientation_picture,
    position_picture,
    write_followed_plots,
)
from rapidsim.plots.theme import themed

NAMES = ("way", "arm", "position", "joints", "deviation", "orientation")
QUARTER_TURN = np.array([[0.0, 0.0, 1.0, 0.0], [0.0, 0.5**0.5, 0.5**0.5, 0.0]])


def quarter_turn(way: Way = Way.LINE) -> FollowedTrajectory:
    positions = np.array([[0.7, -0.2, 0.5], [0.7, 0.2, 0.5]])
    made = follow(
        load_robot("irb1600"),
        Points(positions, QUARTER_TURN),
        QUARTER_TURN,
        Transform.identity(),
        Plan(way, speed=0.2, acceleration=100.0),
    )
    assert isinstance(made, FollowedTrajectory)
    return made


def test_all_are_written_for_an_arm_without_axis_speeds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The darkness of pictures is that of their theme; the pictures of a run are drawn in both.
    monkeypatch.setattr(write, "THEMES", (LIGHT,))
    robot, pitches = load_robot("rvm1"), np.zeros((2, 1))
    points = Points(np.array([[0.40, -0.1, 0.2], [0.42, 0.1, 0.3]]), pitches)
    made = follow(robot, points, pitches, Transform.identity(), Plan())
    assert isinstance(made, FollowedTrajectory)
    written = write_followed_plots(made, "wall.csv", tmp_path / "plots")
    assert {path.name for path in written} == {f"{name}.png" for name in NAMES}
    for path in written:
        picture = np.asarray(Image.open(path).convert("L"))
        assert np.count_nonzero(picture != picture[0, 0]) > 2000


def test_a_quarter_turn_goes_evenly_and_blended_linearly_does_not() -> None:
    """Rates 90.00 per stretch by slerp, 81.03 to 94.93 by a linear blend of the quaternions."""
    made = quarter_turn()
    rates = attitude_rates(made)
    assert rates.linear_rate is not None
    assert rates.linear_angle is not None
    stretch_s = made.duration
    middle = slice(3, -2)
    assert np.degrees(rates.rate[middle]) * stretch_s == pytest.approx(90.0, rel=3e-3)
    linear = np.degrees(rates.linear_rate[middle]) * stretch_s
    assert linear.max() == pytest.approx(94.93, rel=4e-3)
    assert linear.min() == pytest.approx(81.03, rel=2e-2)
    assert np.degrees([rates.angle[-1], rates.linear_angle[-1]]) == pytest.approx(90.0)
    with themed(LIGHT):
        upper, _, rate = orientation_picture(made, "turn", LIGHT).axes
    assert "norm is 1 within" in upper.get_title(loc="left")
    assert len(rate.lines) == 2


def test_ways_in_joint_space_have_no_linear_blend() -> None:
    rates = attitude_rates(quarter_turn(Way.JOINT))
    assert rates.linear_rate is None
    assert rates.angle[-1] == pytest.approx(np.pi / 2.0)


def test_position_and_deviation_show_what_was_driven() -> None:
    made = quarter_turn()
    with themed(LIGHT):
        x, y, _, speed = position_picture(made, "turn", LIGHT).axes
        (off,) = deviation_picture(made, "turn", LIGHT).axes
    assert np.asarray(x.lines[0].get_ydata()) == pytest.approx(700.0)
    assert np.asarray(y.lines[0].get_ydata())[[0, -1]] == pytest.approx([-200.0, 200.0])
    assert np.asarray(speed.lines[0].get_ydata()).max() == pytest.approx(200.0)
    assert "from the path asked for: at most" in off.get_title(loc="left")
