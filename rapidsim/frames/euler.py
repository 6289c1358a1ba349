"""Euler angles in four named conventions, converted to and from rotations."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from types import MappingProxyType

import numpy as np

from rapidsim.frames.transform import Array

_LOCKED = 1e-9
"""Cosine or sine of the middle angle below which only the sum of the outer two is determined."""


class Convention(StrEnum):
    """Order of the three rotations of a frame."""

    ZYX = "zyx"
    """About z, the new y, the new x: RAPID's OrientZYX, KUKA's A, B, C."""
    XYZ = "xyz"
    """About x, the new y, the new z."""
    ZYZ = "zyz"
    """About z, the new y, the new z."""
    RPY = "rpy"
    """Roll, pitch, yaw about the fixed axes x, y, z: URDF, FANUC's W, P, R. Equal to `ZYX` with the
    angles in reverse order."""

    @property
    def names(self) -> tuple[str, str, str]:
        """Names of the three angles."""
        match self:
            case Convention.ZYX:
                return "rz", "ry", "rx"
            case Convention.XYZ:
                return "rx", "ry", "rz"
            case Convention.ZYZ:
                return "rz1", "ry", "rz2"
            case Convention.RPY:
                return "roll", "pitch", "yaw"


_AXES: Mapping[Convention, tuple[int, int, int]] = MappingProxyType(
    {
        Convention.ZYX: (2, 1, 0),
        Convention.XYZ: (0, 1, 2),
        Convention.ZYZ: (2, 1, 2),
        Convention.RPY: (2, 1, 0),
    }
)
"""Successive rotation axes of a frame; `RPY` has its angles in reverse order."""


def rotation_from_euler(angles: Array, convention: Convention) -> Array:
    """Return matrices (..., 3, 3) from angles (..., 3) [rad]."""
    angles = np.asarray(angles, dtype=np.float64)
    first, second, third = (angles[..., k] for k in range(3))
    if convention is Convention.RPY:
        first, third = third, first
    axes = _AXES[convention]
    turned: Array = _about(axes[0], first) @ _about(axes[1], second) @ _about(axes[2], third)
    return turned


def euler_from_rotation(rotation: Array, convention: Convention) -> Array:
    """Return angles (..., 3) [rad] from matrices (..., 3, 3).

    The middle angle is within a quarter turn, for `ZYZ` from 0 to half a turn. If only the sum of
    the other two is determined (gimbal lock), one of them is 0: the last of the three, for `RPY`
    the first.
    """
    r = np.asarray(rotation, dtype=np.float64)
    if convention is Convention.ZYZ:
        sine = np.hypot(r[..., 0, 2], r[..., 1, 2])
        locked = sine < _LOCKED
        # With z vertical only a rotation about z remains, mirrored at half a turn.
        up = np.where(r[..., 2, 2] < 0.0, -1.0, 1.0)
        alone = np.arctan2(up * r[..., 1, 0], up * r[..., 0, 0])
        first = np.where(locked, alone, np.arctan2(r[..., 1, 2], r[..., 0, 2]))
        second = np.arctan2(sine, r[..., 2, 2])
        third = np.where(locked, 0.0, np.arctan2(r[..., 2, 1], -r[..., 2, 0]))
    elif convention is Convention.XYZ:
        cosine = np.hypot(r[..., 0, 0], r[..., 0, 1])
        locked = cosine < _LOCKED
        alone = np.arctan2(r[..., 2, 1], r[..., 1, 1])
        first = np.where(locked, alone, np.arctan2(-r[..., 1, 2], r[..., 2, 2]))
        second = np.arctan2(r[..., 0, 2], cosine)
        third = np.where(locked, 0.0, np.arctan2(-r[..., 0, 1], r[..., 0, 0]))
    else:
        cosine = np.hypot(r[..., 0, 0], r[..., 1, 0])
        locked = cosine < _LOCKED
        alone = np.arctan2(-r[..., 0, 1], r[..., 1, 1])
        first = np.where(locked, alone, np.arctan2(r[..., 1, 0], r[..., 0, 0]))
        second = np.arctan2(-r[..., 2, 0], cosine)
        third = np.where(locked, 0.0, np.arctan2(r[..., 2, 1], r[..., 2, 2]))
    ordered = (third, second, first) if convention is Convention.RPY else (first, second, third)
    angles: Array = np.stack(ordered, axis=-1)
    return angles


def _about(axis: int, angle: Array) -> Array:
    """Return rotations (..., 3, 3) about one of the axes x, y, z."""
    cosine, sine = np.cos(angle), np.sin(angle)
    turn = np.zeros((*angle.shape, 3, 3))
    following, last = (axis + 1) % 3, (axis + 2) % 3
    turn[..., axis, axis] = 1.0
    turn[..., following, following] = turn[..., last, last] = cosine
    turn[..., last, following] = sine
    turn[..., following, last] = -sine
    return turn
