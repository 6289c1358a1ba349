"""Answers of a sensor become goals: units, frames, selected axes, speeds, path corrections."""

from __future__ import annotations

import math

import numpy as np
import pytest
from motion_programs import HOME, ROBOT, TOOL

from rapidsim.frames.rotation_vectors import rotation_from_vector, vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.guidance.goals import Band, JointGoal, PoseGoal
from rapidsim.motion.guidance.joint_law import (
    BRAKING_SHARE,
    CYCLE_S,
    GuidedAxes,
    JointMotion,
    LowPass,
    Tuning,
)
from rapidsim.motion.guidance.path_correction import PathCorrection
from rapidsim.motion.guidance.sensor import (
    SensorAnswer,
    in_degrees,
    in_millimetres,
    pose_of,
    radians,
    twist_of,
)

FLANGE_FROM_TCP = Transform(TOOL.rotation, TOOL.translation)
SENSOR = Transform(rotation_from_vector(np.array([0.2, -0.1, 0.7])), np.array([0.3, -0.2, 0.1]))
FRAME = Transform(rotation_from_vector(np.array([0.0, 0.4, -0.3])), np.array([0.1, 0.1, 0.1]))
AFTER = Transform(rotation_from_vector(np.array([0.1, 0.0, 0.0])), np.array([0.0, 0.01, 0.0]))
ALL = (True,) * 6


def pose_goal(
    chosen: tuple[bool, ...] = ALL, filters: tuple[float, ...] = (), offset: Transform = AFTER
) -> PoseGoal:
    near = np.full(6, 1e-3)
    band = Band(np.array(chosen), -near, near)
    return PoseGoal(
        ROBOT.kinematics, TOOL.inverse(), SENSOR, FRAME, offset, band, filters, HOME.copy()
    )


def sent(pose: Transform, offset: Transform = AFTER) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """What a sensor sends for base_from_tcp."""
    return in_millimetres(SENSOR.inverse() @ pose @ offset.inverse())


def require_pose(goal: PoseGoal, joints: Array, pose: Transform) -> None:
    tcp = goal.tcp(joints)
    assert tcp.translation == pytest.approx(pose.translation, abs=1e-9)
    assert tcp.rotation == pytest.approx(pose.rotation, abs=1e-9)


def moved(vector: tuple[float, ...], turn: tuple[float, ...]) -> Transform:
    """The TCP at home, moved and turned in the correction frame."""
    start = ROBOT.forward(HOME) @ FLANGE_FROM_TCP
    frame = FRAME.rotation
    return Transform(
        rotation_from_vector(frame @ np.array(turn)) @ start.rotation,
        start.translation + frame @ np.array(vector),
    )


def test_parts_of_an_answer_are_converted_or_missing() -> None:
    assert radians((90.0, -45.0, 7.0), 2) == pytest.approx([math.pi / 2, -math.pi / 4])
    assert radians((90.0,), 2) is None
    assert in_degrees(np.array([math.pi, -1.0])) == pytest.approx((180.0, -57.29577951))
    position, rotation = pose_of(SensorAnswer(position=(100.0, -20.0, 3.0)))
    assert position == pytest.approx([0.1, -0.02, 0.003])
    assert rotation is None
    half = math.sqrt(0.5)
    position, rotation = pose_of(SensorAnswer(orientation=(3.0 * half, 0.0, 0.0, 3.0 * half)))
    assert position is None
    assert rotation == pytest.approx(np.array([[0, -1, 0], [1, 0, 0], [0, 0, 1]]), abs=1e-12)
    assert pose_of(SensorAnswer(position=(1.0, 2.0), orientation=(0.0,) * 4)) == (None, None)
    twist = twist_of(SensorAnswer(tcp_speed=(10.0, 20.0, -30.0, 90.0, -180.0, 45.0)))
    wanted = [0.01, 0.02, -0.03, math.pi / 2, -math.pi, math.pi / 4]
    assert twist == pytest.approx(wanted)
    assert twist_of(SensorAnswer(tcp_speed=(1.0, 2.0))) is None
    millimetres, quaternion = in_millimetres(Transform(np.eye(3), np.array([0.1, 0.2, -0.3])))
    assert millimetres == pytest.approx((100.0, 200.0, -300.0))
    assert quaternion == (1.0, 0.0, 0.0, 0.0)


def test_a_pose_of_the_sensor_is_a_goal_in_base() -> None:
    goal = pose_goal()
    assert not goal.accept(SensorAnswer(joints=(1.0,)))
    wanted = moved((0.03, -0.02, 0.01), (0.1, 0.0, -0.05))
    position, orientation = sent(wanted)
    assert goal.accept(SensorAnswer(position=position, orientation=orientation))
    found = goal.goal(HOME)
    assert found is not None
    require_pose(goal, found[0], wanted)
    assert not found[1].any()
    assert goal.is_met(found[0])
    assert not goal.is_met(HOME)


def test_what_a_sensor_does_not_send_is_kept() -> None:
    wanted, start = moved((0.03, -0.02, 0.01), (0.1, 0.0, -0.05)), moved((0, 0, 0), (0, 0, 0))
    identity = Transform.identity()
    position, orientation = sent(wanted, identity)
    only_place, only_turn = pose_goal(offset=identity), pose_goal(offset=identity)
    assert only_place.accept(SensorAnswer(position=position))
    assert only_turn.accept(SensorAnswer(orientation=orientation))
    for goal, pose in (
        (only_place, Transform(start.rotation, wanted.translation)),
        (only_turn, Transform(wanted.rotation, start.translation)),
    ):
        found = goal.goal(HOME)
        assert found is not None
        require_pose(goal, found[0], pose)


@pytest.mark.parametrize(
    "chosen", [(True,) * 3 + (False,) * 3, (False, True, False) * 2, (False,) * 3 + (True,) * 3]
)
def test_axes_that_are_not_selected_keep_their_start(chosen: tuple[bool, ...]) -> None:
    goal = pose_goal(chosen)
    vector, turn = (0.03, -0.02, 0.01), (0.05, 0.0, 0.0)
    position, orientation = sent(moved(vector, turn))
    assert goal.accept(SensorAnswer(position=position, orientation=orientation))
    found = goal.goal(HOME)
    assert found is not None
    kept = np.where(chosen, [*vector, *turn], 0.0).tolist()
    require_pose(goal, found[0], moved(tuple(kept[:3]), tuple(kept[3:])))
    assert goal.is_met(found[0])


def test_a_speed_of_the_tcp_is_a_speed_of_the_axes() -> None:
    goal = pose_goal()
    twist = (20.0, -10.0, 5.0, 4.0, -6.0, 8.0)
    assert goal.accept(SensorAnswer(tcp_speed=twist))
    found = goal.goal(HOME)
    assert found is not None
    aimed, speed = found
    assert aimed == pytest.approx(HOME, abs=1e-9)
    before = goal.tcp(HOME)
    after = goal.tcp(HOME + CYCLE_S * speed)
    moves = (after.translation - before.translation) / CYCLE_S
    turns = vector_from_rotation(after.rotation @ before.rotation.T) / CYCLE_S
    assert moves == pytest.approx(SENSOR.rotation @ np.array([0.02, -0.01, 0.005]), abs=1e-9)
    assert turns == pytest.approx(SENSOR.rotation @ np.radians([4.0, -6.0, 8.0]), abs=1e-9)
    # A speed is of one answer only.
    assert not goal.accept(SensorAnswer())
    found = goal.goal(HOME)
    assert found is not None
    assert not found[1].any()


def test_a_pose_that_is_out_of_reach_is_no_goal() -> None:
    goal = pose_goal()
    assert goal.accept(SensorAnswer(position=(9e3, 0.0, 0.0)))
    assert goal.goal(HOME) is None
    # Neither is one that the arm reaches, but not a cycle later.
    goal = pose_goal()
    assert goal.accept(SensorAnswer(tcp_speed=(1e6, 0.0, 0.0, 0.0, 0.0, 0.0)))
    assert goal.goal(HOME) is None


def test_a_pose_passes_its_filters_in_place_and_turn() -> None:
    goal = pose_goal(filters=(10.0, 20.0))
    wanted, start = moved((0.03, -0.02, 0.01), (0.1, 0.0, -0.05)), moved((0, 0, 0), (0, 0, 0))
    position, orientation = sent(wanted)
    goal.accept(SensorAnswer(position=position, orientation=orientation))
    full = vector_from_rotation(wanted.rotation @ start.rotation.T)
    filtered = LowPass((10.0, 20.0), np.zeros(1))
    for _ in range(20):
        share = filtered.follow(np.ones(1))
        found = goal.goal(HOME)
        assert found is not None
        tcp = goal.tcp(found[0])
        way = tcp.translation - start.translation
        assert way == pytest.approx(share * (wanted.translation - start.translation), abs=1e-9)
        turn = vector_from_rotation(tcp.rotation @ start.rotation.T)
        assert turn == pytest.approx(share * full, abs=1e-9)


def test_joints_and_their_speeds_count_for_selected_axes() -> None:
    start = np.array([0.1, 0.2])
    near = np.full(2, 0.01)
    goal = JointGoal(Band(np.array([True, False]), -near, near), (), start)
    assert goal.accept(SensorAnswer(joints=(20.0, 30.0), joint_speed=(5.0, 6.0)))
    found = goal.goal(start)
    assert found is not None
    assert found[0] == pytest.approx([np.radians(20.0), 0.2])
    assert found[1] == pytest.approx([np.radians(5.0), 0.0])
    assert goal.is_met(np.array([np.radians(20.0), 1.0]))
    assert not goal.is_met(start)
    # The goal stays, the speed does not.
    assert not goal.accept(SensorAnswer(joints=(1.0,)))
    found = goal.goal(start)
    assert found is not None
    assert found[0] == pytest.approx([np.radians(20.0), 0.2])
    assert not found[1].any()
    assert goal.accept(SensorAnswer(joint_speed=(5.0, 6.0)))


def test_a_filter_covers_of_the_rest_what_its_frequency_says() -> None:
    share = 1.0 - math.exp(-2.0 * math.pi * 10.0 * CYCLE_S)
    two, none = LowPass((10.0, 10.0), np.zeros(1)), LowPass((0.0,), np.zeros(1))
    assert none.follow(np.ones(1)) == pytest.approx([1.0])
    assert two.follow(np.ones(1)) == pytest.approx([share**2])
    first, second = share * (2.0 - share), share**2
    assert two.follow(np.ones(1)) == pytest.approx([second + share * (first - second)])


@pytest.mark.parametrize("gain", [2.0, 20.0, 1e9])
def test_a_goal_is_approached_in_proportion_near_it_and_brakeably_further_off(gain: float) -> None:
    # From high speed an axis takes in one cycle whatever speed the law wants.
    brakes, wide = BRAKING_SHARE * 10.0, np.full(1, 1e6)
    used = min(gain, 0.5 / CYCLE_S)
    meet = brakes / used**2
    for remaining in (-3.0 * meet, -meet, -0.3 * meet, 0.0, 0.5 * meet, 2.0 * meet, 10.0 * meet):
        size = abs(remaining)
        wanted = used * size if size <= meet else math.sqrt(2.0 * brakes * (size - 0.5 * meet))
        signed = math.copysign(wanted, remaining)
        axes = GuidedAxes(-wide, wide, wide, np.full(1, 10.0))
        motion = JointMotion(axes, np.zeros(1), np.full(1, signed))
        motion.towards(np.full(1, remaining), Tuning(gain), np.zeros(1))
        assert motion.speed == pytest.approx([signed], rel=1e-9)
        assert motion.joints == pytest.approx([signed * CYCLE_S], rel=1e-9)


def offsets_of(correction: PathCorrection, x: Array, z: Array, cycles: int) -> Array:
    rows = (np.tile(x, (cycles, 1)), np.tile(z, (cycles, 1)), np.ones(cycles, dtype=bool))
    return np.array(correction.follow(*rows))


def test_a_path_is_corrected_in_its_own_coordinates() -> None:
    # x along the path, y the cross product of the tool's z and x, z that of x and y.
    x = np.array([0.6, 0.8, 0.0])
    tool_z = np.array([0.3, 0.1, -0.9])
    y = np.cross(tool_z, x) / np.linalg.norm(np.cross(tool_z, x))
    correction = PathCorrection(10.0, ())
    assert not correction.accept(SensorAnswer(correction=(1.0, 2.0)))
    assert not correction.has_answer
    assert correction.accept(SensorAnswer(correction=(7.0, 2.0, -3.0)))
    assert correction.has_answer
    offsets = offsets_of(correction, x, tool_z, 800)
    assert offsets[-1] == pytest.approx(0.002 * y - 0.003 * np.cross(x, y), abs=1e-7)
    steps = np.diff(offsets, axis=0, prepend=np.zeros((1, 3))) / CYCLE_S
    assert np.abs(steps).max() <= 0.25
    assert np.abs(np.diff(steps, axis=0)).max() / CYCLE_S <= 2.5 + 1e-9
    # Where the tool points along the path, y is that of before.
    assert offsets_of(correction, x, x, 1)[-1] == pytest.approx(offsets[-1], abs=1e-6)
    # Cycles that are not corrected lead back to the path.
    rows = (np.tile(x, (800, 1)), np.tile(tool_z, (800, 1)), np.zeros(800, dtype=bool))
    assert correction.follow(*rows)[-1] == pytest.approx(np.zeros(3), abs=1e-7)


def test_an_offset_comes_to_rest_where_it_can() -> None:
    correction = PathCorrection(10.0, ())
    correction.accept(SensorAnswer(correction=(0.0, 20.0, 0.0)))
    last = offsets_of(correction, np.eye(3)[0], np.eye(3)[2], 20)
    before = float(np.linalg.norm(last[-1] - last[-2])) / CYCLE_S
    rest = np.array(correction.rest())
    assert len(rest) == math.ceil(before / (2.5 * CYCLE_S) - 1e-6)
    assert correction.rest() == []
