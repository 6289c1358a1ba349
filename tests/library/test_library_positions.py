"""Positions and frames: laws of the algebra, ground truth, refusals."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from library_controller import CONF, call
from reference_numbers import recorded

from rapidsim.frames import quaternion
from rapidsim.frames.transform import Transform, matrix_from_quaternion
from rapidsim.language import error_numbers as errors
from rapidsim.language.data import (
    IDENTITY_POSE,
    NO_EXTERNAL_AXES,
    WOBJ0,
    Orient,
    Pos,
    Pose,
    RobTarget,
)
from rapidsim.language.errors import RapidError
from rapidsim.language.single_precision import single

# Singles carry 7 digits; positions are within a metre, so this is a few units of the last one.
POSITION_TOLERANCE_MM = 1e-3
ROTATION_TOLERANCE_RAD = 2e-6

angles = st.floats(-180.0, 180.0, width=32)
lengths = st.floats(-1000.0, 1000.0, width=32)
positions = st.builds(Pos, lengths, lengths, lengths)
orientations = st.builds(lambda z, y, x: call("OrientZYX", z, y, x), angles, angles, angles)
poses = st.builds(Pose, positions, orientations)


def target(pos: Pos, rot: Orient = IDENTITY_POSE.rot) -> RobTarget:
    return RobTarget(pos, rot, CONF, NO_EXTERNAL_AXES)


def assert_same_orientation(a: Orient, b: Orient) -> None:
    assert quaternion.angle_between(a, b) < ROTATION_TOLERANCE_RAD


def assert_same(a: Pose, b: Pose) -> None:
    assert math.dist(a.trans, b.trans) < POSITION_TOLERANCE_MM
    assert_same_orientation(a.rot, b.rot)


@given(angles, st.floats(-89.0, 89.0, width=32), angles)
def test_euler_angles_undo_orient(z: float, y: float, x: float) -> None:
    orient = call("OrientZYX", z, y, x)
    for option, angle in (("z", z), ("y", y), ("x", x)):
        read = call("EulerZYX", orient, **{option: True})
        assert abs(math.remainder(read - angle, 360.0)) < 2e-3


@given(orientations)
def test_orient_undoes_euler_angles(orient: Orient) -> None:
    z, y, x = (call("EulerZYX", orient, **{axis: True}) for axis in "zyx")
    assert quaternion.angle_between(call("OrientZYX", z, y, x), orient) < 2e-5


@pytest.mark.parametrize("y", [90.0, -90.0])
@pytest.mark.parametrize("z", [0.0, 30.0, -120.0])
def test_euler_angles_at_their_singularity(y: float, z: float) -> None:
    orient = call("OrientZYX", z, y, 0.0)
    assert call("EulerZYX", orient, y=True) == pytest.approx(y, abs=0.03)
    assert call("EulerZYX", orient, x=True) == 0.0
    assert call("EulerZYX", orient, z=True) == pytest.approx(z, abs=1e-3)


def test_orient_zyx_turns_about_the_axes_it_names() -> None:
    half = single(math.sqrt(0.5))
    assert call("OrientZYX", 90.0, 0.0, 0.0) == Orient(half, 0.0, 0.0, half)
    assert call("OrientZYX", 0.0, 90.0, 0.0) == Orient(half, 0.0, half, 0.0)
    assert call("OrientZYX", 0.0, 0.0, 90.0) == Orient(half, half, 0.0, 0.0)


@given(poses, poses, poses)
def test_poses_are_a_group(a: Pose, b: Pose, c: Pose) -> None:
    assert_same(call("PoseMult", a, IDENTITY_POSE), a)
    assert_same(call("PoseMult", a, call("PoseInv", a)), IDENTITY_POSE)
    assert_same(call("PoseMult", call("PoseInv", a), a), IDENTITY_POSE)
    assert_same(
        call("PoseMult", call("PoseMult", a, b), c), call("PoseMult", a, call("PoseMult", b, c))
    )
    assert_same(
        call("PoseInv", call("PoseMult", a, b)),
        call("PoseMult", call("PoseInv", b), call("PoseInv", a)),
    )


@given(poses, poses)
def test_poses_multiply_like_transforms(a: Pose, b: Pose) -> None:
    product = Transform.from_quaternion(a.rot, a.trans) @ Transform.from_quaternion(b.rot, b.trans)
    ours = call("PoseMult", a, b)
    assert np.allclose(ours.trans, product.translation, atol=POSITION_TOLERANCE_MM)
    assert np.allclose(matrix_from_quaternion(np.array(ours.rot)), product.rotation, atol=1e-6)


@given(poses, positions)
def test_a_vector_in_a_frame_is_a_pose_without_orientation(frame: Pose, vector: Pos) -> None:
    product = call("PoseMult", frame, Pose(vector, IDENTITY_POSE.rot))
    assert math.dist(call("PoseVect", frame, vector), product.trans) < POSITION_TOLERANCE_MM


@given(poses, lengths, lengths, lengths, angles, angles, angles)
def test_rel_tool_composes_in_the_tool(
    pose: Pose, dx: float, dy: float, dz: float, rx: float, ry: float, rz: float
) -> None:
    start = target(pose.trans, pose.rot)
    moved = call("RelTool", start, dx, dy, dz, rx=rx, ry=ry, rz=rz)
    expected = pose
    for step in (
        Pose(Pos(dx, dy, dz), IDENTITY_POSE.rot),
        Pose(Pos(0.0, 0.0, 0.0), call("OrientZYX", 0.0, 0.0, rx)),
        Pose(Pos(0.0, 0.0, 0.0), call("OrientZYX", 0.0, ry, 0.0)),
        Pose(Pos(0.0, 0.0, 0.0), call("OrientZYX", rz, 0.0, 0.0)),
    ):
        expected = call("PoseMult", expected, step)
    assert_same(Pose(moved.trans, moved.rot), expected)
    assert (moved.robconf, moved.extax) == (start.robconf, start.extax)


@given(poses, lengths, lengths, lengths)
def test_offs_keeps_all_but_the_position(pose: Pose, x: float, y: float, z: float) -> None:
    start = target(pose.trans, pose.rot)
    moved = call("Offs", start, x, y, z)
    assert moved[1:] == start[1:]
    way = [after - before for after, before in zip(moved.trans, start.trans, strict=True)]
    assert np.allclose(way, (x, y, z), atol=POSITION_TOLERANCE_MM)


@given(positions, positions)
def test_products_of_vectors(a: Pos, b: Pos) -> None:
    cross = call("CrossProd", a, b)
    assert np.allclose(cross, np.cross(a, b), rtol=1e-6, atol=1e-1)
    assert call("DotProd", a, b) == pytest.approx(np.dot(a, b), rel=1e-6, abs=1e-3)
    assert call("Distance", a, b) == call("VectMagn", Pos(*(np.subtract(a, b).tolist())))


def test_three_points_define_a_frame() -> None:
    p1, p2, p3 = Pos(100.0, 100.0, 0.0), Pos(100.0, 300.0, 0.0), Pos(50.0, 150.0, 0.0)
    points = [target(p) for p in (p1, p2, p3)]
    quarter = call("OrientZYX", 90.0, 0.0, 0.0)
    assert_same(call("DefFrame", *points), Pose(p1, quarter))
    assert_same(call("DefFrame", *points, origin=1.0), Pose(p1, quarter))
    assert_same(call("DefFrame", *points, origin=2.0), Pose(p2, quarter))
    assert_same(call("DefFrame", *points, origin=3.0), Pose(Pos(100.0, 150.0, 0.0), quarter))


@given(poses)
def test_a_frame_is_found_from_its_own_points(frame: Pose) -> None:
    inside = (Pos(0.0, 0.0, 0.0), Pos(200.0, 0.0, 0.0), Pos(100.0, 300.0, 0.0))
    points = [target(call("PoseVect", frame, p)) for p in inside]
    found = call("DefFrame", *points)
    assert math.dist(found.trans, frame.trans) < POSITION_TOLERANCE_MM
    assert quaternion.angle_between(found.rot, frame.rot) < 1e-5


@given(poses, poses)
def test_a_displacement_takes_old_points_to_new(old: Pose, moved_by: Pose) -> None:
    inside = (Pos(0.0, 0.0, 0.0), Pos(200.0, 0.0, 0.0), Pos(100.0, 300.0, 0.0))
    before = [target(call("PoseVect", old, p)) for p in inside]
    after = [target(call("PoseVect", moved_by, p.trans)) for p in before]
    found = call("DefDFrame", *before, *after)
    for start, end in zip(before, after, strict=True):
        assert math.dist(call("PoseVect", found, start.trans), end.trans) < 0.05


@given(poses, poses, st.booleans())
def test_mirroring_twice_changes_nothing(plane: Pose, pose: Pose, mir_y: bool) -> None:
    mirror = WOBJ0._replace(uframe=plane)
    start = target(pose.trans, pose.rot)
    image = call("MirPos", start, mirror, mir_y=mir_y)
    again = call("MirPos", image, mirror, mir_y=mir_y)
    assert math.dist(again.trans, start.trans) < 10 * POSITION_TOLERANCE_MM
    assert quaternion.angle_between(again.rot, start.rot) < 1e-5


def test_mirroring_in_the_world_turns_z_round() -> None:
    down = call("OrientZYX", 0.0, 180.0, 0.0)
    image = call("MirPos", target(Pos(1.0, 2.0, 3.0), down), WOBJ0)
    assert image.trans == Pos(1.0, 2.0, -3.0)
    # The tool pointed down and now points up; its x axis is turned to keep the frame right-handed.
    assert np.allclose(quaternion.rotate(image.rot, (0.0, 0.0, 1.0)), (0.0, 0.0, 1.0), atol=1e-6)
    assert np.allclose(quaternion.rotate(image.rot, (0.0, 1.0, 0.0)), (0.0, 1.0, 0.0), atol=1e-6)


def test_products_of_recorded_quaternions() -> None:
    cases = recorded("irb120")["quaternion_algebra"]
    assert cases
    zero = Pos(0.0, 0.0, 0.0)
    for case in cases:
        a, b = Orient(*case["q_AB"]), Orient(*case["q_BC"])
        product = call("PoseMult", Pose(zero, a), Pose(zero, b)).rot
        assert_same_orientation(product, Orient(*case["product"]))
        vector = Pos(*case["B_r"])
        assert np.allclose(call("PoseVect", Pose(zero, a), vector), case["A_r"], atol=1e-6)
        assert np.allclose(matrix_from_quaternion(np.array(a)), case["R_AB"], atol=1e-8)


def test_recorded_quaternions_turn_vectors_as_their_matrices_do() -> None:
    cases = recorded("quat_to_matrix")
    checked = 0
    for case in cases.values():
        if not isinstance(case, dict) or "R" not in case:
            continue
        frame = Pose(Pos(0.0, 0.0, 0.0), call("NOrient", Orient(*map(float, case["q_in"]))))
        for axis in range(3):
            unit = Pos(*(float(i == axis) for i in range(3)))
            column = [row[axis] for row in case["R"]]
            assert np.allclose(call("PoseVect", frame, unit), column, atol=1e-6)
        checked += 1
    assert checked


REFUSED = [
    ("NOrient", (Orient(0.0, 0.0, 0.0, 0.0),), "ERR_ILLQUAT", "never assigned a value"),
    ("EulerZYX", (Orient(1.0, 0.0, 0.0, 0.0),), "ERR_ARGVALERR", "needs one of"),
    (
        "DefFrame",
        tuple(target(Pos(x, 0.0, 0.0)) for x in (0.0, 1.0, 2.0)),
        "ERR_FRAME",
        "lie on one line",
    ),
    ("DefFrame", (target(Pos(0.0, 0.0, 0.0)),) * 3, "ERR_FRAME", "lie on one line"),
]


@pytest.mark.parametrize(("name", "arguments", "error", "message"), REFUSED)
def test_refusal(name: str, arguments: tuple[object, ...], error: str, message: str) -> None:
    with pytest.raises(RapidError, match=message) as caught:
        call(name, *arguments)
    assert caught.value.errno == errors.NUMBERS[error]
