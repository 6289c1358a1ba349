"""Tables of points: columns and units, and every mistake with its line and column."""

import numpy as np
import pytest

from rapidsim.files import InputError
from rapidsim.motion.waypoints.points_file import points_from_text

WRONG = {
    "a b\n1 2\n": ("points.csv:1: there is no column `a b`", "columns are"),
    "1,2,3\n": ("points.csv:1: the first line must name the columns", "x,y,z"),
    "x,y\n1,2\n": ("points.csv:1: column `z` is missing", "a point has x, y and z"),
    "x,y,z,pich\n1,2,3,4\n": ("points.csv:1: there is no column `pich`", "did you mean `pitch`?"),
    "x,y,z,q1,q2\n1,2,3,4,5\n": ("points.csv:1: column `q3` is missing", "scalar first"),
    "x,y,z,x\n1,2,3,4\n": ("points.csv:1: column `x` appears twice", None),
    "x,y,z,pitch,q1,q2,q3,q4\n1,2,3,4,1,0,0,0\n": ("both a quaternion and a pitch", None),
    "x,y,z\n1,2\n": ("points.csv:2: 2 fields, but the header names 3 columns", None),
    "x,y,z\n# a remark\n\n1,2,u\n": ("points.csv:4: column `z`: `u` is not a number", None),
    "x;y;z\n1;2;3,5\n": ("points.csv:2: column `z`: `3,5` is not a number", "point as `.`"),
    "x,y,z\n1,2,\n": ("points.csv:2: column `z`: there is no number", None),
    "x,y,z\n1,2,nan\n": ("points.csv:2: column `z`: `nan` is not a number", None),
    "x,y,z,q1,q2,q3,q4\n1,2,3,1,1,0,0\n": ("points.csv:2: the quaternion has length 1.414", None),
    "x,y,z,time\n1,2,3,0\n2,3,4,0\n": ("points.csv:3: column `time`: 0 follows 0", "rise"),
    "x,y,z,v1\n1,2,3,0\n": ("points.csv:1: column `v2` is missing", "all 6 joints"),
    "x,y,z,v7\n1,2,3,0\n": ("points.csv:1: column `v7`: the arm has 6 joints", None),
    "": ("points.csv is empty", "x,y,z"),
    "x,y,z\n": ("points.csv has no points, only a header", None),
}


@pytest.mark.parametrize(("text", "said"), WRONG.items(), ids=[str(n) for n in range(len(WRONG))])
def test_a_mistake_is_told_with_line_and_column(text: str, said: tuple[str, str | None]) -> None:
    with pytest.raises(InputError) as caught:
        points_from_text(text, "points.csv", 6)
    message, help = said
    assert message in caught.value.message
    assert (help or "") in (caught.value.help or "")


def test_units_are_those_of_the_shop_floor() -> None:
    text = "# made by hand\nX_mm;y;z;pitch_deg;time_s;v1;v2_deg_s\n\n1000;0;-500;90;0;180;0\n"
    points = points_from_text(text + "0;1;2;-90;2.5;0;90\n", "points.csv", 2)
    assert points.positions == pytest.approx(np.array([[1.0, 0.0, -0.5], [0.0, 0.001, 0.002]]))
    assert points.attitudes == pytest.approx(np.array([[np.pi / 2], [-np.pi / 2]]))
    assert points.times == pytest.approx([0.0, 2.5])
    assert points.speeds == pytest.approx(np.array([[np.pi, 0.0], [0.0, np.pi / 2]]))
    assert points.accelerations is None
    assert points.knots is None


def test_quaternions_are_made_unit() -> None:
    points = points_from_text("x,y,z,q1,q2,q3,q4\n0,0,0,0.70711,0,0.70711,0\n", "p.csv", 6)
    assert points.attitudes is not None
    assert np.linalg.norm(points.attitudes, axis=1) == pytest.approx([1.0], abs=1e-15)
