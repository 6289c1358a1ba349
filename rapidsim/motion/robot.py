"""A robot: its kinematics with the limits, speeds and names that make it a product."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.kinematics import Kinematics


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
