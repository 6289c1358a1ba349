"""Laws of the small geometry that a recording is drawn with."""

from __future__ import annotations

import math

import numpy as np
import rerun.blueprint as rrb
from hypothesis import assume, given
from hypothesis import strategies as st

from rapidsim.frames.transform import matrix_from_quaternion
from rapidsim.recording.panels.legend import emptiest_corner
from rapidsim.recording.scene.arc import arc_through
from rapidsim.recording.scene.stick_figure import z_to

coordinate = st.floats(-2.0, 2.0)
point = st.tuples(coordinate, coordinate, coordinate).map(np.array)
angle = st.floats(0.2, 6.0)


@given(
    centre=point,
    radius=st.floats(0.01, 2.0),
    end_angle=angle,
    share=st.floats(0.1, 0.9),
    tilt=point,
)
def test_an_arc_stays_on_its_circle_and_goes_over_its_point(
    centre: np.ndarray, radius: float, end_angle: float, share: float, tilt: np.ndarray
) -> None:
    assume(float(np.linalg.norm(tilt)) > 0.1)
    x, y, z, w = z_to(tilt / np.linalg.norm(tilt))
    turn = matrix_from_quaternion(np.array([w, x, y, z]))

    def at(radians: float) -> np.ndarray:
        return centre + radius * (turn @ [math.cos(radians), math.sin(radians), 0.0])

    via = at(share * end_angle)
    arc = arc_through(at(0.0), via, at(end_angle), 400)
    assert np.allclose(arc[0], at(0.0), atol=1e-9)
    assert np.allclose(arc[-1], at(end_angle), atol=1e-6)
    assert np.allclose(np.linalg.norm(arc - centre, axis=1), radius, atol=1e-6)
    length = float(np.linalg.norm(np.diff(arc, axis=0), axis=1).sum())
    assert math.isclose(length, radius * end_angle, rel_tol=1e-3)
    assert np.linalg.norm(arc - via, axis=1).min() < 0.02 * radius


def test_points_on_a_line_give_the_line() -> None:
    start, via, end = (np.array([x, 0.0, 0.0]) for x in (0.0, 0.4, 1.0))
    assert np.array_equal(arc_through(start, via, end, 10), np.stack([start, via, end]))


@given(point)
def test_a_bar_points_where_it_shall(direction: np.ndarray) -> None:
    length = float(np.linalg.norm(direction))
    assume(length > 1e-3)
    x, y, z, w = z_to(direction / length)
    turned = matrix_from_quaternion(np.array([w, x, y, z])) @ [0.0, 0.0, 1.0]
    assert np.allclose(turned, direction / length, atol=1e-4)


def test_a_legend_stands_where_no_line_is() -> None:
    times = np.linspace(0.0, 1.0, 50)
    assert emptiest_corner(times, times[:, None], 0.2, 0.2) == rrb.Corner2D.LeftTop
    assert emptiest_corner(times, -times[:, None], 0.2, 0.2) == rrb.Corner2D.RightTop
    assert emptiest_corner(times, np.ones((50, 1)), 0.2, 0.2) == rrb.Corner2D.RightTop
