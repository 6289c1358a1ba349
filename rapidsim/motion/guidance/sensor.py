"""A sensor's answer, as sent in mm and degrees, and in m and rad.

The only module besides `configurations/targets.py` that converts a program's units to the arm's.
"""

from __future__ import annotations

from typing import Annotated, TypeAlias

import numpy as np

from rapidsim.frames.transform import Array, Transform, matrix_from_quaternion
from rapidsim.json_records.declarations import OrAbsent, ValueForm
from rapidsim.values import value_class

MM = 1e-3
_LEAST_NORM = 1e-6
_Part: TypeAlias = Annotated[tuple[float, ...], ValueForm.OPTIONAL]


@value_class(frozen=True, slots=True)
class SensorAnswer:
    """Last message of a sensor; missing parts are empty."""

    joints: _Part = ()
    """Goal of the arm's axes, followed by the external axes [deg]."""
    position: _Part = ()
    """Goal of the TCP, x, y, z [mm]."""
    orientation: _Part = ()
    """Goal of the TCP, q1..q4."""
    joint_speed: _Part = ()
    """[deg/s]"""
    tcp_speed: _Part = ()
    """x, y, z [mm/s], rx, ry, rz [deg/s]."""
    correction: _Part = ()
    """Requested offset of the TCP from its path: x, y, z of path coordinates [mm]."""
    values: _Part = ()
    r"""For \DataFromSensor."""
    digital: OrAbsent[bool] = None
    r"""For \DIFromSensor."""


def radians(degrees: tuple[float, ...], count: int) -> Array | None:
    """Return the first `count` axes [rad]; None if some are missing."""
    return None if len(degrees) < count else np.radians(np.array(degrees[:count]))


def pose_of(answer: SensorAnswer) -> tuple[Array | None, Array | None]:
    """Return position (3,) [m] and rotation (3, 3) of the goal; None for missing parts."""
    position = MM * np.array(answer.position) if len(answer.position) == 3 else None
    rotation = None
    if len(answer.orientation) == 4:
        quaternion = np.array(answer.orientation)
        if (norm := float(np.linalg.norm(quaternion))) > _LEAST_NORM:
            rotation = matrix_from_quaternion(quaternion / norm)
    return position, rotation


def twist_of(answer: SensorAnswer) -> Array | None:
    """Return the speed of the TCP (6,) [m/s, rad/s]; None if missing."""
    if len(answer.tcp_speed) != 6:
        return None
    twist = np.array(answer.tcp_speed)
    return np.concatenate([MM * twist[:3], np.radians(twist[3:])])


def in_degrees(joints: Array) -> tuple[float, ...]:
    """Return axes (n,) [rad] in the unit sent [deg]."""
    return tuple(np.degrees(joints).tolist())


def in_millimetres(pose: Transform) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return a pose as sent: x, y, z [mm] and q1..q4."""
    return tuple((pose.translation / MM).tolist()), tuple(pose.quaternion.tolist())
