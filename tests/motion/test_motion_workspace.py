"""The workspace of arms, and points that an arm reaches."""

import numpy as np
import pytest

from rapidsim.frames.transform import Transform, matrix_from_quaternion
from rapidsim.motion import workspace
from rapidsim.motion.configurations.reachability import unreachable_reason
from rapidsim.motion.robot.robot import load_robot
from rapidsim.motion.waypoints import reachability
from rapidsim.motion.waypoints.random_points import posture_points, reached_points
from rapidsim.motion.workspace import ArmWorkspace, workspace_of, wrist_workspace_of

TOOL = Transform(np.eye(3), np.array([0.0, 0.0, 0.16]))


def test_the_kr_10_has_the_volume_of_its_data_sheet() -> None:
    """Its maker gives 5.14 m3 and 1101 mm for the wrist centre, 80 mm behind the flange.

    All postures of axes 2 and 3 in steps of 0.08 deg, in cells of 2 mm, fill 5.0138 m3 in front of
    axis 1, which turns by 340 deg; with what the arm reaches behind itself it is 5.2249 m3.
    """
    found = wrist_workspace_of(load_robot("kr10"))
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


@pytest.mark.parametrize(
    ("reached", "begin", "end", "found"),
    [
        ("1000000000", 0.0, 3.0, "1111000000"),
        ("1000000000", -2.0, 1.0, "1100000011"),
        ("1000000000", -1.5, 1.5, "1100000001"),
        ("0000100000", -1.0, 1.0, "0001110000"),
        ("1000000000", 0.0, 10.0, "1111111111"),
        ("0000000000", -2.0, 3.0, "0000000000"),
    ],
)
def test_axis_1_turns_what_is_reached(reached: str, begin: float, end: float, found: str) -> None:
    cells = np.array([int(one) for one in reached], dtype=bool)[None, None]
    turned = workspace._turned(cells, begin, end)[0, 0]
    assert "".join(str(int(one)) for one in turned) == found


def test_a_hole_between_reached_cells_is_filled_and_an_edge_is_not_moved() -> None:
    cells = np.ones((4, 5, 1), dtype=bool)
    cells[1, 2], cells[:, 4] = False, False
    filled = workspace._closed(cells)
    assert filled[1, 2, 0]
    assert filled[:, :4].all()
    assert not filled[[0, 3], 4].any()
    sparse = np.zeros((4, 5, 1), dtype=bool)
    sparse[0, 0] = sparse[0, 2] = sparse[2, 1] = True
    assert np.array_equal(workspace._closed(sparse), sparse)


def test_the_volume_of_a_ring_is_that_of_its_cells() -> None:
    """Of a full cylinder, half of the cells on its edges count."""
    reached = np.zeros((10, 10, 4), dtype=bool)
    reached[:, :, :2] = True
    arm = ArmWorkspace(load_robot("rvm1"), 0.1, -0.5, reached, (0.0, 1.0, -0.5, 0.5))
    assert arm.swept == pytest.approx(np.pi)
    assert arm.radii == pytest.approx(0.05 + 0.1 * np.arange(10))
    assert arm.heights == pytest.approx(-0.45 + 0.1 * np.arange(10))
    rows = np.ones((10, 10))
    rows[[0, -1]] = rows[:, -1] = 0.5
    assert arm.volume == pytest.approx(float(np.sum(rows * arm.radii) * 0.01 * np.pi))
    assert arm.section.all()
    assert arm.above[:, :2].all()
    assert not arm.above[:, 2:].any()


def test_only_a_spherical_wrist_has_a_centre() -> None:
    assert wrist_workspace_of(load_robot("rvm1")) is None


@pytest.mark.parametrize(
    ("possible", "run"),
    [
        ("0011100110", (2, 4)),
        ("1100000111", (7, 11)),
        ("1000000000", (0, 0)),
        ("1111111111", (0, 9)),
        ("0111111111", (1, 9)),
        ("1111111110", (0, 8)),
        ("1101111011", (3, 6)),
    ],
)
def test_the_widest_range_of_pitches_may_pass_half_a_turn(
    possible: str, run: tuple[int, int]
) -> None:
    mask = np.array([int(one) for one in possible], dtype=bool)
    assert reachability._widest_run(mask) == run
