"""Frames, circles, spheres and tool centre points that fit measured positions best.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "DefAccFrame",
"FitCircle", "FitSphere", "CalcRotAxFrameZ", "MToolTCPCalib"; Kabsch (1976), A solution for the best
rotation to relate two sets of vectors.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from rapidsim.language.annotations import Num, Pers, Var
from rapidsim.language.controller import Motion
from rapidsim.language.data import TOOL0, WOBJ0, JointTarget, Orient, Pos, Pose, RobTarget, ToolData
from rapidsim.language.error_numbers import (
    ERR_FIT_POINTS_IN_LINE,
    ERR_FIT_TOO_FEW_POINTS,
    ERR_FIT_TOO_MANY_POINTS,
    ERR_FRAME,
    rapid_error,
)
from rapidsim.language.reference import Reference
from rapidsim.library.poses import from_axes, single_pos, unit
from rapidsim.library.table import routine, table
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.frames.transform import Array

_FLAT_MM = 1e-3
"""Tolerance: closer points define a line instead of a plane, or a plane instead of a sphere."""
_MOST_POINTS = 100
"""Maximum number of points for a circle or a sphere."""


@value_class(frozen=True, slots=True)
class _Circle:
    centre: Array
    normal: Array
    radius: float
    errors: Array
    """Distances (k,) [mm] of the points from the circle."""


def def_acc_frame(
    target_list_one: list[RobTarget],
    target_list_two: list[RobTarget],
    targets_in_list: Num,
    max_err: Var[Num],
    mean_err: Var[Num],
) -> Pose:
    """The frame that best maps the positions of the first list to those of the second.

    Raises:
        RapidError: ERR_FRAME for fewer than three positions, or positions on a line.
    """
    import numpy as np

    one = _positions(target_list_one, targets_in_list)
    two = _positions(target_list_two, targets_in_list)
    _plane(one)
    _plane(two)
    left, _, right = np.linalg.svd((one - one.mean(0)).T @ (two - two.mean(0)))
    turn = np.diag([1.0, 1.0, np.sign(np.linalg.det(right.T @ left.T))])
    rotation = right.T @ turn @ left.T
    trans = two.mean(0) - rotation @ one.mean(0)
    _write_errors(np.linalg.norm(one @ rotation.T + trans - two, axis=1), max_err, mean_err)
    return _pose(trans, rotation)


def fit_circle(
    points: list[Pos],
    center: Var[Pos],
    radius: Var[Num],
    normal: Var[Pos],
    *,
    num_points: Num | None = None,
    rms: Var[Num] | None = None,
    max_err: Var[Num] | None = None,
    index_worst: Var[Num] | None = None,
) -> None:
    """The circle through three points or more, so that the squares of the errors are least.

    Raises:
        RapidError: ERR_FIT_TOO_FEW_POINTS, ERR_FIT_TOO_MANY_POINTS, ERR_FIT_POINTS_IN_LINE.
    """
    circle = _circle(_fitted(points, num_points, least=3), ERR_FIT_POINTS_IN_LINE)
    center.value = Pos(*circle.centre.tolist())
    normal.value = Pos(*circle.normal.tolist())
    radius.value = circle.radius
    _write_fit(circle.errors, rms, max_err, index_worst)


def fit_sphere(
    points: list[Pos],
    center: Var[Pos],
    radius: Var[Num],
    *,
    num_points: Num | None = None,
    rms: Var[Num] | None = None,
    max_err: Var[Num] | None = None,
    index_worst: Var[Num] | None = None,
) -> None:
    """The sphere through four points or more, so that the squares of the errors are least.

    Raises:
        RapidError: ERR_FIT_TOO_FEW_POINTS, ERR_FIT_TOO_MANY_POINTS, ERR_FIT_POINTS_IN_LINE.
    """
    import numpy as np

    measured = _fitted(points, num_points, least=4)
    centred = measured - measured.mean(0)
    if np.linalg.svd(centred, compute_uv=False)[-1] < _FLAT_MM:
        raise rapid_error(ERR_FIT_POINTS_IN_LINE, "the positions lie in a plane, or on a line")
    # x2 + y2 + z2 = 2 a x + 2 b y + 2 c z + d, linear in the centre (a, b, c).
    rows = np.column_stack([2.0 * centred, np.ones(len(centred))])
    *centre, rest = np.linalg.lstsq(rows, (centred**2).sum(1), rcond=None)[0].tolist()
    radius.value = float(np.sqrt(rest + np.dot(centre, centre)))
    center.value = Pos(*(measured.mean(0) + centre).tolist())
    errors = np.abs(np.linalg.norm(centred - centre, axis=1) - radius.value)
    _write_fit(errors, rms, max_err, index_worst)


def calc_rot_ax_frame_z(
    target_list: list[RobTarget],
    targets_in_list: Num,
    positive_z_point: RobTarget,
    max_err: Var[Num],
    mean_err: Var[Num],
) -> Pose:
    """The frame of a turning axis: z along it, towards a point; x through the first position."""
    import numpy as np

    measured = _positions(target_list, targets_in_list)
    circle = _circle(measured)
    z = circle.normal
    if (np.array(positive_z_point.trans) - circle.centre) @ z < 0.0:
        z = -z
    x = measured[0] - circle.centre
    x = x - (x @ z) * z
    x = x / np.linalg.norm(x)
    _write_errors(circle.errors, max_err, mean_err)
    return _pose(circle.centre, np.column_stack([x, np.cross(z, x), z]))


def m_tool_tcp_calib(
    controller: Motion,
    pos1: JointTarget,
    pos2: JointTarget,
    pos3: JointTarget,
    pos4: JointTarget,
    tool: Pers[ToolData],
    max_err: Var[Num],
    mean_err: Var[Num],
) -> None:
    """The tool centre point that coincides in all four positions, stored in `tframe.trans`."""
    import numpy as np

    flanges = [controller.target_at(one, TOOL0, WOBJ0) for one in (pos1, pos2, pos3, pos4)]
    rotations = np.stack([_rotation(one) for one in flanges])
    places = np.array([one.trans for one in flanges])
    # R_i t - p = -x_i, for the tool centre point t in the flange and the point p in the base.
    rows = np.concatenate([np.hstack([one, -np.eye(3)]) for one in rotations])
    solution, _, rank, _ = np.linalg.lstsq(rows, -places.reshape(-1), rcond=1e-9)
    if rank < rows.shape[1]:
        raise rapid_error(ERR_FRAME, "the four positions turn the tool too little")
    trans, place = solution[:3], solution[3:]
    _write_errors(np.linalg.norm(rotations @ trans + places - place, axis=1), max_err, mean_err)
    frame = tool.value.tframe._replace(trans=single_pos(tuple(trans.tolist())))
    tool.value = tool.value._replace(tframe=frame)


def _positions(targets: Sequence[RobTarget], count: float) -> Array:
    import numpy as np

    return np.array([target.trans for target in targets[: _counted(count, targets)]])


def _fitted(points: Sequence[Pos], count: float | None, least: int) -> Array:
    """Points (k, 3) to fit a circle or a sphere to."""
    import numpy as np

    wanted = len(points) if count is None else count
    if wanted < least:
        raise rapid_error(ERR_FIT_TOO_FEW_POINTS, f"{wanted:g} points; at least {least} are needed")
    if wanted > min(len(points), _MOST_POINTS):
        most = f"the array has {len(points)}, and at most {_MOST_POINTS} are fitted"
        raise rapid_error(ERR_FIT_TOO_MANY_POINTS, f"{wanted:g} points; {most}")
    return np.array(points[: int(wanted)], dtype=np.float64)


def _counted(count: float, positions: Sequence[object]) -> int:
    """Number of positions of a list that are used."""
    if not 3 <= count <= len(positions):
        raise rapid_error(
            ERR_FRAME, f"{count:g} positions of a list of {len(positions)}; at least 3"
        )
    return int(count)


def _plane(points: Array, on_line: float = ERR_FRAME) -> tuple[Array, Array]:
    """Rows (3, 3): two directions in the plane of points and its normal; and the centred points."""
    import numpy as np

    centred = points - points.mean(0)
    _, spread, axes = np.linalg.svd(centred, full_matrices=True)
    if len(points) < 3 or spread[1] < _FLAT_MM:
        raise rapid_error(on_line, "the positions lie on a line, or at one place")
    return axes, centred


def _circle(points: Array, on_line: float = ERR_FRAME) -> _Circle:
    import numpy as np

    axes, centred = _plane(points, on_line)
    flat = centred @ axes[:2].T
    # x2 + y2 = 2 a x + 2 b y + c, linear in the centre (a, b).
    rows = np.column_stack([2.0 * flat, np.ones(len(flat))])
    a, b, c = np.linalg.lstsq(rows, (flat**2).sum(1), rcond=None)[0]
    radius = float(np.sqrt(c + a * a + b * b))
    in_plane = np.hypot(flat[:, 0] - a, flat[:, 1] - b) - radius
    normal = np.cross(axes[0], axes[1])
    errors = np.hypot(in_plane, centred @ normal)
    return _Circle(points.mean(0) + a * axes[0] + b * axes[1], normal, radius, errors)


def _write_fit(
    errors: Array,
    rms: Reference[float] | None,
    max_err: Reference[float] | None,
    index_worst: Reference[float] | None,
) -> None:
    if rms is not None:
        rms.value = float((errors**2).mean() ** 0.5)
    if max_err is not None:
        max_err.value = float(errors.max())
    if index_worst is not None:
        index_worst.value = float(errors.argmax() + 1)


def _write_errors(errors: Array, max_err: Reference[float], mean_err: Reference[float]) -> None:
    max_err.value = float(errors.max())
    mean_err.value = float(errors.mean())


def _pose(trans: Array, rotation: Array) -> Pose:
    x, y, z = (tuple(column) for column in rotation.T.tolist())
    return Pose(Pos(*trans.tolist()), Orient(*from_axes(x, y, z)))


def _rotation(target: RobTarget) -> Array:
    """The orientation of a target as a matrix, shape (3, 3)."""
    import numpy as np

    w, x, y, z = unit(target.rot)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


FITS = table(
    routine("DefAccFrame", def_acc_frame),
    routine(
        "FitCircle",
        fit_circle,
        r"Points \NumPoints Center Radius Normal \RMS \MaxErr \IndexWorst",
    ),
    routine(
        "FitSphere",
        fit_sphere,
        r"Points \NumPoints Center Radius \RMS \MaxErr \IndexWorst",
    ),
    routine("CalcRotAxFrameZ", calc_rot_ax_frame_z),
    routine("MToolTCPCalib", m_tool_tcp_calib, "Pos1 Pos2 Pos3 Pos4 Tool MaxErr MeanErr"),
)
