"""Matrices, and frames, circles and tool centre points that fit measured positions: laws."""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from laws import examples
from library_controller import CONF, RecordingController, call

from rapidsim.frames import quaternion
from rapidsim.language.data import (
    NO_EXTERNAL_AXES,
    TOOL0,
    JointTarget,
    Orient,
    Pos,
    RobJoint,
    RobTarget,
    ToolData,
    WobjData,
)
from rapidsim.language.errors import RapidError
from rapidsim.language.reference import Box

ANGLES = st.floats(-170.0, 170.0)


def turned(about: tuple[float, float, float], degrees: float) -> Orient:
    half = math.radians(degrees) / 2.0
    length = math.dist(about, (0.0, 0.0, 0.0))
    return Orient(math.cos(half), *(math.sin(half) * part / length for part in about))


def at(position: tuple[float, float, float]) -> RobTarget:
    return RobTarget(Pos(*position), Orient(1.0, 0.0, 0.0, 0.0), CONF, NO_EXTERNAL_AXES)


def errors() -> tuple[Box[float], Box[float]]:
    return Box(-1.0), Box(-1.0)


CORNERS = ((0.0, 0.0, 0.0), (300.0, 0.0, 0.0), (0.0, 200.0, 0.0), (10.0, 20.0, 150.0))


@examples()
@given(ANGLES, st.floats(-1000.0, 1000.0))
def test_a_frame_is_found_again_from_positions(angle: float, x: float) -> None:
    rotation = turned((1.0, 2.0, 3.0), angle)
    moved = [
        at(tuple(np.add(quaternion.rotate(rotation, corner), (x, 7.0, -3.0)))) for corner in CORNERS
    ]
    worst, mean = errors()
    frame = call("DefAccFrame", [at(one) for one in CORNERS], moved, 4.0, worst, mean)
    assert frame.trans == pytest.approx((x, 7.0, -3.0), abs=1e-3)
    assert abs(np.dot(frame.rot, rotation)) == pytest.approx(1.0, abs=1e-6)
    assert 0.0 <= mean.value <= worst.value < 1e-3


def test_positions_on_a_line_have_no_frame() -> None:
    line = [at((float(x), 0.0, 0.0)) for x in range(4)]
    with pytest.raises(RapidError, match="on a line"):
        call("DefAccFrame", line, line, 4.0, *errors())


@given(ANGLES, st.floats(10.0, 500.0))
def test_a_circle_is_found_again_from_points(angle: float, radius: float) -> None:
    rotation = turned((3.0, -1.0, 1.0), angle)
    points = [
        Pos(
            *np.add(
                quaternion.rotate(
                    rotation, (radius * math.cos(turn), radius * math.sin(turn), 0.0)
                ),
                (5.0, 6.0, 7.0),
            )
        )
        for turn in (0.0, 0.7, 1.9, 3.0, 4.4)
    ]
    centre, found, normal = Box(Pos(0, 0, 0)), Box(0.0), Box(Pos(0, 0, 0))
    worst, index = Box(-1.0), Box(0.0)
    call("FitCircle", points, centre, found, normal, max_err=worst, index_worst=index)
    assert centre.value == pytest.approx((5.0, 6.0, 7.0), abs=1e-3)
    assert found.value == pytest.approx(radius, rel=1e-6)
    axis = quaternion.rotate(rotation, (0.0, 0.0, 1.0))
    assert abs(np.dot(normal.value, axis)) == pytest.approx(1.0, abs=1e-6)
    assert worst.value < 1e-3
    assert index.value in (1.0, 2.0, 3.0, 4.0, 5.0)


def test_a_turning_axis_has_z_along_it_and_x_through_the_first_position() -> None:
    positions = [at((100.0 * math.cos(t), 100.0 * math.sin(t), 50.0)) for t in (0.5, 1.5, 2.5, 4.0)]
    worst, mean = errors()
    frame = call("CalcRotAxFrameZ", positions, 4.0, at((0.0, 0.0, -10.0)), worst, mean)
    assert frame.trans == pytest.approx((0.0, 0.0, 50.0), abs=1e-3)
    z = quaternion.rotate(frame.rot, (0.0, 0.0, 1.0))
    x = quaternion.rotate(frame.rot, (1.0, 0.0, 0.0))
    assert z == pytest.approx((0.0, 0.0, -1.0), abs=1e-6)
    assert x == pytest.approx((math.cos(0.5), math.sin(0.5), 0.0), abs=1e-6)


@dataclass
class Pointing(RecordingController):
    """An arm whose axis 1 says how it points with a tool at one place."""

    def target_at(self, joints: JointTarget, tool: ToolData, wobj: WobjData) -> RobTarget:
        rotation = turned((1.0, joints.robax.rax_1, 2.0), 40.0 * joints.robax.rax_1)
        place = np.subtract((800.0, 0.0, 500.0), quaternion.rotate(rotation, (10.0, -20.0, 200.0)))
        return at(tuple(place))._replace(rot=rotation)


def test_a_tool_centre_point_is_where_all_positions_meet() -> None:
    joints = [JointTarget(RobJoint(float(n), 0, 0, 0, 0, 0), NO_EXTERNAL_AXES) for n in range(4)]
    tool = Box(TOOL0)
    worst, mean = errors()
    Pointing().call("MToolTCPCalib", *joints, tool, worst, mean)
    assert tool.value.tframe.trans == pytest.approx((10.0, -20.0, 200.0), abs=1e-3)
    assert worst.value < 1e-3


def test_equations_are_solved_and_with_too_many_of_them_best() -> None:
    x = [0.0, 0.0]
    call("MatrixSolve", [[2.0, 1.0], [1.0, 3.0]], [5.0, 10.0], x)
    assert x == pytest.approx([1.0, 3.0])
    call("MatrixSolve", [[1.0, 0.0], [1.0, 0.0], [0.0, 1.0]], [1.0, 3.0, 7.0], x)
    assert x == pytest.approx([2.0, 7.0])
    with pytest.raises(RapidError, match="rank 1"):
        call("MatrixSolve", [[1.0, 2.0], [2.0, 4.0]], [1.0, 2.0], x)
    with pytest.raises(RapidError, match="1 equations, 2 unknowns"):
        call("MatrixSolve", [[1.0, 2.0], [2.0, 4.0]], [1.0, 2.0], x, a_m=1.0)


@given(st.lists(st.floats(-9.0, 9.0), min_size=12, max_size=12))
def test_factors_multiply_to_the_matrix(numbers: list[float]) -> None:
    a = np.array(numbers).reshape(4, 3)
    square = [[0.0] * 4 for _ in range(4)]
    tall, small = [[0.0] * 3 for _ in range(4)], [[0.0] * 3 for _ in range(3)]
    values = [0.0] * 3
    call("MatrixSolveQR", a.tolist(), square, tall)
    q, r = np.array(square), np.array(tall)
    assert q @ r == pytest.approx(a, abs=1e-9)
    assert q.T @ q == pytest.approx(np.eye(4), abs=1e-9)
    assert np.tril(r, -1) == pytest.approx(np.zeros((4, 3)), abs=1e-9)
    call("MatrixSVD", a.tolist(), tall, values, small, econ=True)
    u, v = np.array(tall), np.array(small)
    assert u @ np.diag(values) @ v.T == pytest.approx(a, abs=1e-9)
    assert values == sorted(values, reverse=True)


def test_a_part_larger_than_the_matrix_is_refused() -> None:
    x = [0.0] * 2
    with pytest.raises(RapidError, match="3 x 2 of a matrix that is 2 x 2"):
        call("MatrixSolve", [[1.0, 2.0], [2.0, 4.0]], [1.0, 2.0], x, a_m=3.0)
