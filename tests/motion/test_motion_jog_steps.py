"""What an operator asks of an arm that stands: steps, solutions of a pose, postures to look at."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from motion_programs import HOME, ROBOT, TOOL

from rapidsim.frames.rotation_vectors import rotation_from_vector, vector_from_rotation
from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.configurations.jog_steps import JogArm, JogFrame, JogStep
from rapidsim.motion.configurations.pose_solutions import solve_pose, solve_pose_as
from rapidsim.motion.configurations.postures import Posture, Postures
from rapidsim.motion.configurations.singularities import differential
from rapidsim.motion.kinematics.closed_form.opw_geometry import OpwGeometry
from rapidsim.motion.robot.robot import load_robot

FRAME = Transform(rotation_from_vector(np.array([0.3, -0.2, 0.5])), np.array([0.2, 0.1, 0.0]))
ARM = JogArm(ROBOT, TOOL.inverse(), HOME)
SHARES = np.array([0.0, 0.5, 1.0])


def joints_along(step: JogStep | str, arm: JogArm = ARM) -> Array:
    assert isinstance(step, JogStep), step
    joints = arm.along(step, SHARES)
    assert not isinstance(joints, str), joints
    return joints


@pytest.mark.parametrize("axis", range(3))
def test_a_step_along_a_frame_is_straight_and_keeps_the_tool(axis: int) -> None:
    joints = joints_along(ARM.step(FRAME, axis, -20.0))
    tcp = ROBOT.forward(joints) @ TOOL
    way = -0.02 * SHARES[:, None] * FRAME.rotation[:, axis]
    assert tcp.translation == pytest.approx(ARM.base_from_tcp.translation + way, abs=1e-9)
    assert tcp.rotation == pytest.approx(np.tile(ARM.base_from_tcp.rotation, (3, 1, 1)), abs=1e-9)
    assert joints[0] == pytest.approx(HOME, abs=1e-9)


@pytest.mark.parametrize("axis", range(3, 6))
def test_a_turn_about_a_frame_keeps_the_tcp(axis: int) -> None:
    tcp = ROBOT.forward(joints_along(ARM.step(FRAME, axis, 8.0))) @ TOOL
    assert tcp.translation == pytest.approx(
        np.tile(ARM.base_from_tcp.translation, (3, 1)), abs=1e-9
    )
    turned = vector_from_rotation(tcp.rotation @ ARM.base_from_tcp.rotation.T)
    wanted = math.radians(8.0) * SHARES[:, None] * FRAME.rotation[:, axis - 3]
    assert turned == pytest.approx(wanted, abs=1e-9)


def test_a_step_of_an_axis_turns_it_alone() -> None:
    joints = joints_along(ARM.step(None, 2, 12.0))
    wanted = np.tile(HOME, (3, 1))
    wanted[:, 2] += math.radians(12.0) * SHARES
    assert joints == pytest.approx(wanted, abs=1e-12)


@pytest.mark.parametrize(
    ("frame", "axis", "distance", "reason"),
    [
        (None, 5, 30.0, None),
        (None, 5, -30.01, "a step is at most 30 degrees or 200 mm"),
        (None, 6, 1.0, "there is no axis 7"),
        (None, -1, 1.0, "there is no axis 0"),
        (FRAME, 2, -200.0, None),
        (FRAME, 0, 200.1, "a step is at most 30 degrees or 200 mm"),
        (FRAME, 3, 30.0, None),
        (FRAME, 3, 31.0, "a step is at most 30 degrees or 200 mm"),
        (FRAME, 6, 1.0, "there is no axis 7"),
        (FRAME, 1, math.nan, "a step is at most 30 degrees or 200 mm"),
    ],
)
def test_steps_have_a_longest_length(
    frame: Transform | None, axis: int, distance: float, reason: str | None
) -> None:
    step = ARM.step(frame, axis, distance)
    assert (step if isinstance(step, str) else None) == reason


def test_frames_are_those_of_their_names() -> None:
    world, wobj = FRAME, TOOL
    frames = {one: ARM.base_from_frame(one, world, lambda: wobj) for one in JogFrame}
    assert frames[JogFrame.JOINTS] is None
    assert frames[JogFrame.WORLD] is world
    assert frames[JogFrame.WOBJ] is wobj
    tool, base = frames[JogFrame.TOOL], frames[JogFrame.BASE]
    assert tool is not None
    assert base is not None
    assert tool.rotation == pytest.approx((ROBOT.forward(HOME) @ TOOL).rotation)
    assert np.array_equal(base.rotation, np.eye(3))


def test_a_panel_has_the_reasons_of_both_senses() -> None:
    """At its upper limit an axis only goes back; stretched, the arm only goes back."""
    joints = HOME.copy()
    joints[0] = ROBOT.upper[0] - math.radians(1.0)
    at_limit = JogArm(ROBOT, TOOL.inverse(), joints)
    steps = at_limit.steps(None, 10.0, 4.0)
    assert not isinstance(steps, str)
    assert [one["axis"] for one in steps] == [1, 2, 3, 4, 5, 6]
    assert {one["size"] for one in steps} == {4.0}
    reasons = [one["reasons"] for one in steps]
    assert reasons[0] == [None, "joint 1 over by 0.2 deg at its upper limit"]
    assert reasons[1:] == [[None, None]] * 5
    steps = at_limit.steps(FRAME, 10.0, 4.0)
    assert not isinstance(steps, str)
    assert [one["size"] for one in steps] == [10.0] * 3 + [4.0] * 3
    assert at_limit.steps(FRAME, 201.0, 4.0) == "a step is at most 30 degrees or 200 mm"

    stretched = JogArm(ROBOT, Transform.identity(), np.radians([0.0, 80.0, -78.0, 0.0, 30.0, 0.0]))
    away = Transform(np.eye(3), np.zeros(3))
    outside = stretched.step(away, 0, 100.0)
    assert isinstance(outside, JogStep)
    reason = stretched.reason_against(outside)
    assert reason is not None
    assert "beyond reach" in reason
    inside = stretched.step(away, 0, -20.0)
    assert isinstance(inside, JogStep)
    assert stretched.reason_against(inside) is None


def test_a_step_through_a_singularity_is_impossible() -> None:
    near = np.radians([0.0, -10.0, 20.0, 90.0, 0.05, 0.0])
    arm = JogArm(ROBOT, Transform.identity(), near)
    across = [arm.step(Transform.identity(), axis, size) for axis in (1, 2) for size in (30, -30)]
    reasons = {arm.reason_against(one) for one in across if isinstance(one, JogStep)}
    assert "the arm would pass a singularity" in reasons


def test_what_stands_says_its_room_and_its_configuration() -> None:
    standing = JogArm(ROBOT, TOOL.inverse(), HOME).standing()
    assert standing["configuration"] == confdata_of(ROBOT.kinematics, HOME).tolist()
    lower, upper = np.degrees(HOME - ROBOT.lower), np.degrees(ROBOT.upper - HOME)
    assert standing["room"] == [
        [pytest.approx(a, abs=0.006), pytest.approx(b, abs=0.006)]
        for a, b in zip(lower, upper, strict=True)
    ]
    assert standing["singularities"] == []
    endless = replace(ROBOT.joints[0], lower=-math.inf, upper=math.inf)
    robot = replace(ROBOT, joints=(endless, *ROBOT.joints[1:]))
    flat = np.radians([0.0, -10.0, 20.0, 10.0, 0.0, 20.0])
    standing = JogArm(robot, TOOL.inverse(), flat).standing()
    assert isinstance(standing["room"], list)
    assert standing["room"][0] == [None, None]
    assert standing["singularities"] == ["wrist"]


def test_a_pose_is_solved_in_every_configuration_or_with_the_reason() -> None:
    pose = ROBOT.forward(HOME)
    found = solve_pose(ROBOT, pose, everything=False)
    assert found.reason is None
    assert all(one.within_limits for one in found.solutions)
    assert len({one.confdata[3] for one in found.solutions}) == len(found.solutions)
    every = solve_pose(ROBOT, pose, everything=True)
    assert len(every.solutions) > len(found.solutions)
    for one in every.solutions:
        assert one.distance == pytest.approx(0.0, abs=1e-9)
        assert one.angle == pytest.approx(0.0, abs=1e-7)
        excess = (one.joints < ROBOT.lower - 1e-9) | (one.joints > ROBOT.upper + 1e-9)
        assert one.within_limits is not bool(excess.any())
    far = Transform(pose.rotation, np.array([5.0, 0.0, 0.0]))
    beyond = solve_pose(ROBOT, far, everything=True)
    assert beyond.solutions == ()
    assert beyond.reason is not None
    assert "beyond reach" in beyond.reason


def test_a_configuration_that_is_no_solution_says_why() -> None:
    pose = ROBOT.forward(HOME)
    cf1, cf4, cf6, cfx = confdata_of(ROBOT.kinematics, HOME).tolist()
    there = solve_pose_as(ROBOT, pose, (cf1, cf4, cf6, cfx))
    assert there.reason is None
    assert there.solutions[0].joints == pytest.approx(HOME, abs=1e-9)
    wrong = solve_pose_as(ROBOT, pose, (cf1 + 1, cf4, cf6 - 2, cfx))
    assert wrong.reason == (
        f"on branch cfx {cfx} cf1 is {cf1}, not {cf1 + 1}, cf6 is {cf6}, not {cf6 - 2}"
    )
    none = solve_pose_as(ROBOT, pose, (cf1, cf4, cf6, 8))
    assert (none.solutions, none.reason) == ((), "cfx 8 is not a branch; this arm has 0 to 7")
    far = Transform(pose.rotation, np.array([5.0, 0.0, 0.0]))
    beyond = solve_pose_as(ROBOT, far, (cf1, cf4, cf6, cfx))
    assert beyond.solutions == ()
    assert str(beyond.reason).startswith(f"branch cfx {cfx} does not reach the pose: ")
    # The other configurations put some axis over its limit.
    reasons = [
        solve_pose_as(ROBOT, pose, one.confdata).reason
        for one in solve_pose(ROBOT, pose, everything=True).solutions
        if not one.within_limits
    ]
    assert reasons
    assert all(reason is not None and "limit" in reason for reason in reasons)


LENGTHS = OpwGeometry(0.1, -0.05, 0.02, 0.3, 0.4, 0.38, 0.08)


@pytest.mark.parametrize(
    ("point", "said"),
    [
        ((0.02, 0.5, 0.4), None),
        ((0.01, 0.01, 0.4), "it comes no nearer to axis 1 than 20 mm, not 14.1"),
        (
            (0.0, 1.2, 0.3),
            "the stretched arm puts it 783.3 mm from axis 2, the target asks for 1099.8 mm",
        ),
        (
            (0.1, 0.02, 0.31),
            "the folded arm puts it no nearer to axis 2 than 16.7 mm, the target asks for 10.0 mm",
        ),
    ],
)
def test_the_length_that_keeps_a_wrist_from_a_point(
    point: tuple[float, float, float], said: str | None
) -> None:
    assert LENGTHS.limiting_length(*point) == said


def shown(joints: Array, name: str = "irb1600", tool: Transform = TOOL) -> Postures:
    robot = load_robot(name)
    rows = Posture(joints, "a"), Posture(np.zeros(len(joints)), "b")
    lines = differential(robot.kinematics, joints, tool)
    return Postures(robot, FRAME, tool, rows, "t", lines)


def test_frames_of_a_posture_end_at_its_tcp() -> None:
    view = shown(np.radians([10.0, 20.0, -30.0, 40.0, 50.0, 60.0]))
    for row, posture in enumerate(view.rows):
        frames, flange = view.frames(row), FRAME @ view.robot.forward(posture.joints)
        assert len(frames) == 8
        assert frames[6].translation == pytest.approx(flange.translation)
        assert frames[7].translation == pytest.approx((flange @ TOOL).translation)
    assert view.world_from_tcp.translation == pytest.approx(view.frames(0)[7].translation)
    names, poses = zip(*view.relative_frames, strict=True)
    assert names == tuple(
        f"T({a},{b})" for a, b in zip(range(7), [*range(1, 7), "TCP"], strict=True)
    )
    product = FRAME
    for pose in poses:
        product = product @ pose
    assert product.translation == pytest.approx(view.world_from_tcp.translation)
    assert product.rotation == pytest.approx(view.world_from_tcp.rotation)
    far = max(
        float(np.linalg.norm(view.frames(row).translation - FRAME.translation, axis=1).max())
        for row in range(2)
    )
    assert view.size == pytest.approx(far)


@pytest.mark.parametrize(
    ("name", "degrees", "tool", "moves"),
    [
        ("irb1600", (25, 70, -88, 0, 90, 0), TOOL, True),
        ("irb1600", (-136, 66, -157, 178, 1, -135), Transform.identity(), False),
        ("rvm1", (136, 97, -24, 16, -90), Transform.identity(), True),
    ],
)
def test_the_weakest_direction_is_that_of_the_least_singular_value(
    name: str, degrees: tuple[float, ...], tool: Transform, moves: bool
) -> None:
    view = shown(np.radians(degrees), name, tool)
    assert view.differential is not None
    assert view.weakest is not None
    direction, said = view.weakest
    jacobian = view.differential.jacobian
    values, vectors = np.linalg.eigh(jacobian @ jacobian.T)
    # Directions that too few joints never move come first.
    least = 6 - len(degrees)
    velocity, turning = np.split(vectors[:, least], 2)
    wanted = FRAME.rotation @ (velocity if moves else turning)
    assert abs(direction @ wanted) == pytest.approx(np.linalg.norm(wanted), rel=1e-5)
    assert np.linalg.norm(direction) == pytest.approx(1.0)
    words = "moved least" if moves else "turned least about this"
    assert said == f"{words}: singular value {math.sqrt(values[least]):.3g}"
    assert replace(view, differential=None).weakest is None
