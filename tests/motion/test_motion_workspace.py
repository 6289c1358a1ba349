"""The workspace of arms, and points that an arm reaches."""

import numpy as np
import pytest

from rapidsim.frames.transform import Transform, matrix_from_quaternion
from rapidsim.motion.configurations.reachability import unreachable_reason
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.waypoints.random_points import posture_points, reached_points
from rapidsim.motion.workspace import ArmWorkspace, workspace_of

TOOL = Transform(np.eye(3), np.array([0.0, 0.0, 0.16]))


def test_the_kr_10_has_the_volume_of_its_data_sheet() -> None:
    """Its maker gives 5.14 m3 and 1101 mm for the wrist centre, 80 mm behind the flange.

    All postures of axes 2 and 3 in steps of 0.08 deg, in cells of 2 mm, fill 5.0138 m3 in front of
    axis 1, which turns by 340 deg; with what the arm reaches behind itself it is 5.2249 m3.
    """
    wrist = Transform(np.eye(3), np.array([0.0, 0.0, -0.08]))
    found = workspace_of(load_robot("kr10"), wrist)
    assert isinstance(found, ArmWorkspace)
    assert found.volume == pytest.approx(5.14, rel=0.02)
    assert found.volume == pytest.approx(5.2249, rel=0.003)
    assert found.extent[1] == pytest.approx(1.1012, abs=1e-4)
    assert np.degrees(found.swept) == pytest.approx(360.0)


def test_what_is_in_the_section_is_reached() -> None:
    """The furthest row of the RV-M1 is what its stretched arm gives."""
    found = workspace_of(load_robot("rvm1"))
    assert isinstance(found, ArmWorkspace)
    assert found.extent[1] == pytest.approx(0.250 + 0.160 + 0.072, abs=2.0 * found.cell)
    assert found.heights[0] < 0.0 < found.heights[-1]


@pytest.mark.parametrize("any_attitude", [False, True])
def test_points_of_a_shell_are_reached(any_attitude: bool) -> None:
    robot = load_robot("kr10")
    shell = (0.4, 1.0)
    places, turned, drawn = reached_points(robot, TOOL, shell, 200, 5, any_attitude=any_attitude)
    assert len(places) == len(turned) == 200
    assert drawn > 200
    flange = Transform(matrix_from_quaternion(turned), places) @ TOOL.inverse()
    assert all(unreachable_reason(robot, flange[row]) is None for row in range(200))
    assert ((np.linalg.norm(places, axis=1) > 0.4) & (np.linalg.norm(places, axis=1) < 1.0)).all()
    again = reached_points(robot, TOOL, shell, 200, 5, any_attitude=any_attitude)
    assert np.array_equal(again[0], places)


def test_a_shell_out_of_reach_is_given_up() -> None:
    places, _, drawn = reached_points(load_robot("rvm1"), TOOL, (2.0, 3.0), 2, 0, any_attitude=True)
    assert len(places) == 0
    assert drawn >= 800


def test_postures_are_within_the_limits() -> None:
    robot = load_robot("irb1600")
    joints, tcp = posture_points(robot, TOOL, 50, 1)
    assert ((joints >= robot.lower) & (joints <= robot.upper)).all()
    assert (robot.forward(joints) @ TOOL).translation == pytest.approx(tcp.translation)
