"""A robot: its kinematics with the limits, speeds and names that make it a product."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from rapidsim.frames.transform import Array, Transform
from rapidsim.motion.catalogue import (
    CatalogueEntry,
    RobotError,
    arm_from_geometry,
    find_entry,
    robot_names,
)
from rapidsim.motion.kinematics import Branches, Kinematics

__all__ = ["Joint", "Robot", "RobotError", "load_robot", "robot_names"]


@dataclass(frozen=True, slots=True)
class Joint:
    """One axis."""

    name: str
    lower: float
    """[rad]"""
    upper: float
    """[rad]"""
    max_speed: float | None
    """[rad/s]; None where no source gives it."""


@dataclass(frozen=True, eq=False)
class Robot:
    """An arm."""

    name: str
    """Such as `irb1600-6-1.2`."""
    title: str
    """As its maker writes it: `ABB IRB 1600-6/1.2`."""
    joints: tuple[Joint, ...]
    kinematics: Kinematics
    urdf: Path | None
    """The description with link shapes, for the recording and for other tools."""
    payload_kg: float | None = None
    reach_m: float | None = None
    sources: tuple[str, ...] = ()

    @cached_property
    def lower(self) -> Array:
        """Lower joint limits (n,) [rad]."""
        return np.array([joint.lower for joint in self.joints])

    @cached_property
    def upper(self) -> Array:
        """Upper joint limits (n,) [rad]."""
        return np.array([joint.upper for joint in self.joints])

    def forward(self, joints: Array) -> Transform:
        """base_from_flange of joint vectors (..., n) [rad]; the flange of ABB arms is tool0."""
        return self.kinematics.forward(np.asarray(joints, dtype=np.float64))

    def inverse(self, base_from_flange: Transform) -> Branches:
        """All branches of poses (...,), before limits; `confdata.configurations` heeds those."""
        return self.kinematics.inverse(base_from_flange)


def load_robot(name_or_path: str | Path) -> Robot:
    """Load a robot from the catalogue by name or alias, or from a URDF by path.

    Raises:
        RobotError: If the name is not known, the file cannot be read, or the arm is of a kind
            that is not supported; the message says which.
    """
    text = str(name_or_path)
    if isinstance(name_or_path, Path) or text.lower().endswith((".urdf", ".xml")):
        # yourdfpy takes two seconds to import, which a robot of the catalogue need not pay.
        from rapidsim.motion.urdf import robot_parts_from_urdf  # noqa: PLC0415

        parts = robot_parts_from_urdf(Path(text))
        joints = tuple(
            Joint(name, lower, upper, speed)
            for name, (lower, upper), speed in zip(
                parts.joint_names, parts.limits, parts.max_speeds, strict=True
            )
        )
        return Robot(parts.name, parts.name, joints, parts.kinematics, Path(text), sources=(text,))
    return _from_entry(find_entry(text))


def _from_entry(entry: CatalogueEntry) -> Robot:
    return Robot(
        name=entry.name,
        title=entry.title,
        joints=tuple(
            Joint(name, lower, upper, speed)
            for name, (lower, upper), speed in zip(
                entry.joint_names, entry.limits, entry.max_speeds, strict=True
            )
        ),
        kinematics=arm_from_geometry(entry.geometry),
        urdf=entry.urdf,
        payload_kg=entry.payload_kg,
        reach_m=entry.reach_m,
        sources=entry.sources,
    )
