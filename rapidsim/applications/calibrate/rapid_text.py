"""RAPID text of targets and tools of an arm, for generated programs."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.configurations.confdata import confdata_of
from rapidsim.motion.configurations.targets import pose, rob_joint
from rapidsim.motion.kinematics.arm import Kinematics

_DECIMALS = 6
_SEVENTH = 6
"""Index of the axis that RAPID counts as the first external one."""


def record(values: Iterable[float | str]) -> str:
    """Return an aggregate of numbers and of texts, which are aggregates themselves."""
    return f"[{','.join(one if isinstance(one, str) else number(one) for one in values)}]"


def number(value: float) -> str:
    """Return a numeric literal."""
    rounded = round(float(value), _DECIMALS)
    return f"{rounded:.{_DECIMALS}f}".rstrip("0").rstrip(".") if rounded else "0"


def joint_target(joints: Array, kinematics: Kinematics) -> str:
    """Return the jointtarget of joints (n,) [rad]."""
    return record([record(rob_joint(joints, kinematics)), _external(joints, kinematics)])


def rob_target(base_from_tcp: Transform, joints: Array, kinematics: Kinematics) -> str:
    """Return the robtarget of a pose with the configuration of joints (n,) [rad]."""
    conf = record(map(float, confdata_of(kinematics, joints)))
    position, orientation = map(record, pose(base_from_tcp))
    return record([position, orientation, conf, _external(joints, kinematics)])


def tool_data(flange_from_tcp: Transform, load_kg: float) -> str:
    """Return the tooldata of a tool that the robot holds, with its mass next to the flange."""
    frame = record(map(record, pose(flange_from_tcp)))
    load = record([max(load_kg, 0.001), "[0,0,1]", "[1,0,0,0]", 0.0, 0.0, 0.0])
    return record(["TRUE", frame, load])


def _external(joints: Array, kinematics: Kinematics) -> str:
    values = ["9E9"] * 6
    degrees = np.degrees(joints).tolist()
    if _SEVENTH in kinematics.rapid_axes:
        values[0] = number(degrees[list(kinematics.rapid_axes).index(_SEVENTH)])
    return record(values)
