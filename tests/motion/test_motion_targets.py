"""From targets to the flange and back: every way in which tool and work object can be held."""

from math import pi, radians

import numpy as np
import pytest

from rapidsim.frames.rotation_vectors import rotation_from_vector
from rapidsim.frames.transform import Transform
from rapidsim.language.data import (
    NO_EXTERNAL_AXES,
    TOOL0,
    WOBJ0,
    ConfData,
    Orient,
    Pos,
    Pose,
    RobTarget,
    ToolData,
    WobjData,
)
from rapidsim.motion.configurations import targets
from rapidsim.motion.robot.external_axes import ExternalAxis
from rapidsim.motion.robot.robot import load_robot

ROBOT = load_robot("irb1600")
STANDS = Transform(rotation_from_vector(np.array([0.1, -0.2, 0.7])), np.array([0.4, 1.0, 0.5]))
AT = np.array([1.0, 0.2, 0.6])
TILTED = Transform(rotation_from_vector(np.array([0.3, 0.1, 0.0])), AT)
AXES = (
    ExternalAxis("TRACK", "a", True, -1.0, 3.0, 1.0, 4.0, carries="robot", direction=(1.0, 2.0, 0)),
    ExternalAxis(
        "STN1",
        "b",
        False,
        -pi,
        pi,
        1.0,
        4.0,
        carries="wobj",
        direction=(1.0, 0.0, 0.0),
        world_from_user=Transform(np.eye(3), AT),
    ),
    ExternalAxis("STN1", "c", False, -pi, pi, 1.0, 4.0, carries="wobj", world_from_user=TILTED),
)
SOMEWHERE = Pose(Pos(30.0, -40.0, 120.0), Orient(0.9238795, 0.0, 0.3826834, 0.0))
ELSEWHERE = Pose(Pos(500.0, 100.0, 700.0), Orient(0.5, 0.5, -0.5, 0.5))
IN_HAND = ToolData(True, SOMEWHERE, TOOL0.tload)
STATIONARY = ToolData(False, ELSEWHERE, TOOL0.tload)
ON_TABLE = WobjData(False, True, "", ELSEWHERE, SOMEWHERE)
ON_UNIT = WobjData(False, False, "stn1", ELSEWHERE, SOMEWHERE)
PART = WobjData(True, True, "", SOMEWHERE, SOMEWHERE)


@pytest.mark.parametrize(
    ("tool", "wobj"),
    [(IN_HAND, ON_TABLE), (IN_HAND, ON_UNIT), (STATIONARY, PART)],
    ids=["in the hand", "positioner", "stationary"],
)
@pytest.mark.parametrize("values", [(0.0, 0.0, 0.0), (0.7, 0.5, -2.0)])
def test_a_target_leads_back_to_the_joints_it_was_made_from(
    tool: ToolData, wobj: WobjData, values: tuple[float, ...]
) -> None:
    placed = targets.placement(tool, wobj, STANDS.inverse(), AXES)
    assert isinstance(placed, targets.Placement)
    joints, external = np.array([0.3, 0.2, -0.1, 0.5, 0.6, -0.7]), np.array(values)
    curve_from_tcp = placed.standing_at(ROBOT.kinematics, joints, external)
    pose = targets.pose(placed.curve_from_object.inverse() @ curve_from_tcp)
    target = RobTarget(pose.trans, pose.rot, ConfData(0, 0, 0, 0), NO_EXTERNAL_AXES)
    back = placed.base_from_flange(ROBOT.kinematics, placed.curve_from_tcp(target), external)
    assert back.matrix == pytest.approx(ROBOT.forward(joints).matrix, abs=1e-9)


def test_the_inner_axis_of_a_positioner_rides_on_the_outer() -> None:
    placed = targets.placement(IN_HAND, ON_UNIT, STANDS.inverse(), AXES)
    assert isinstance(placed, targets.Placement)
    origin = RobTarget(Pos(0, 0, 0), Orient(1, 0, 0, 0), ConfData(0, 0, 0, 0), NO_EXTERNAL_AXES)
    tcp_from_flange = targets.tcp_from_flange(IN_HAND)

    def object_at(*values: float) -> Transform:
        flange = placed.base_from_flange(
            ROBOT.kinematics, placed.curve_from_tcp(origin), np.array(values)
        )
        return STANDS @ flange @ tcp_from_flange.inverse()

    still = object_at(0.0, 0.0, 0.0)
    assert still.matrix == pytest.approx((TILTED @ targets.transform(SOMEWHERE)).matrix)
    # The outer axis is level and goes through the user frame: half a turn puts it upside down.
    turned = object_at(0.0, pi, 0.0)
    flip = np.diag([1.0, -1.0, -1.0])
    assert turned.translation - AT == pytest.approx(flip @ (still.translation - AT))
    # The inner axis stands upright while the outer is at 0, and is carried over by it.
    inner = object_at(0.0, pi, radians(90.0))
    quarter = rotation_from_vector(np.array([0.0, 0.0, pi / 2]))
    assert inner.translation - AT == pytest.approx(flip @ quarter @ (still.translation - AT))


def test_a_track_moves_the_base_and_not_the_object() -> None:
    on_track = np.array([0.5, 0.0, 0.0])
    there = targets.world_from_base_at(AXES, STANDS, on_track[None])[0]
    way = there.translation - STANDS.translation
    assert way == pytest.approx(0.5 * np.array([1.0, 2.0, 0.0]) / 5**0.5)
    placed = targets.placement(IN_HAND, ON_TABLE, STANDS.inverse(), AXES)
    assert isinstance(placed, targets.Placement)
    target = RobTarget(Pos(0, 0, 0), Orient(1, 0, 0, 0), ConfData(0, 0, 0, 0), NO_EXTERNAL_AXES)
    pose = placed.curve_from_tcp(target)
    stays = [
        world_from_base @ placed.base_from_flange(ROBOT.kinematics, pose, values)
        for world_from_base, values in ((STANDS, np.zeros(3)), (there, on_track))
    ]
    assert stays[0].matrix == pytest.approx(stays[1].matrix, abs=1e-12)


@pytest.mark.parametrize(("tool", "wobj"), [(IN_HAND, PART), (STATIONARY, ON_TABLE)])
def test_what_nothing_moves_is_no_set_up(tool: ToolData, wobj: WobjData) -> None:
    refused = targets.placement(tool, wobj, Transform.identity())
    assert isinstance(refused, targets.NotSimulatedFrame)
    assert "the robot holds" in refused.reason


def test_the_world_is_wobj0() -> None:
    placed = targets.placement(TOOL0, WOBJ0, Transform.identity())
    assert isinstance(placed, targets.Placement)
    assert placed.carrier is None
    assert placed.curve_from_object.matrix == pytest.approx(np.eye(4))
