"""Path corrections by a sensor: path coordinates, filter, gain, limits.

x is along the path, y the cross product of the tool's z and x, z that of x and y. A sensor corrects
y and z. As for guidance, ABB publishes no control law: here the correction passes the filters of
its configuration, the offset follows it like the axes of `joint_law`, and turns with the path.

Source of the coordinates: Technical reference manual RAPID Instructions, Functions and Data types,
"CorrCon"; of what may be corrected: Application manual Externally Guided Motion.
"""

from __future__ import annotations

from dataclasses import field
from typing import Final

import numpy as np

from rapidsim.frames.transform import Array
from rapidsim.motion.guidance.joint_law import CYCLE_S, GuidedAxes, JointMotion, LowPass, Tuning
from rapidsim.motion.guidance.sensor import MM, SensorAnswer
from rapidsim.values import value_class

_FASTEST: Final = 0.25
_HARDEST: Final = 2.5
"""Limits of the offset's speed [m/s] and acceleration [m/s2]: our own, as ABB publishes none."""
_LEAST_SINE: Final = 1e-6
"""Sine below which the tool points along its path, so that y is undefined."""


@value_class(slots=True, eq=False)
class PathCorrection:
    """Offset of a TCP from its path over time; `follow` advances it."""

    gain: float
    """Speed [m/s] per m of remaining distance: Kp."""
    filters_hz: tuple[float, ...]
    has_answer: bool = False
    """Whether the sensor has sent anything."""
    _wanted: Array = field(init=False)
    """Correction in path coordinates [m]."""
    _filter: LowPass = field(init=False)
    _motion: JointMotion = field(init=False)
    _axes: Array = field(init=False)
    """base_from_path (3, 3) of the last cycle in which it was defined."""
    _goal: Array = field(init=False)

    def __post_init__(self) -> None:
        """Start on the path."""
        free = np.full(3, np.inf)
        limits = GuidedAxes(-free, free, np.full(3, _FASTEST), np.full(3, _HARDEST))
        self._wanted = self._goal = np.zeros(3)
        self._filter = LowPass(self.filters_hz, np.zeros(3))
        self._motion = JointMotion(limits, np.zeros(3), np.zeros(3))
        self._axes = np.zeros((3, 3))

    def accept(self, answer: SensorAnswer) -> bool:
        """Accept a message of the sensor; return whether it contained a correction."""
        if len(answer.correction) != 3:
            return False
        _, y, z = answer.correction
        self._wanted, self.has_answer = MM * np.array([0.0, y, z]), True
        return True

    def follow(self, directions: Array, tool_z: Array, counts: Array) -> list[Array]:
        """Advance by one cycle per row; return the offset (3,) [m] at the end of each, in base.

        Args:
            directions: Path directions at the end of each cycle (k, 3), in base; 0 for none.
            tool_z: The tool's z axis at the end of each cycle (k, 3), in base.
            counts: Mask (k,) of the cycles in which the path is corrected.
        """
        tuning, ways = Tuning(self.gain), list[Array]()
        for x, z, corrected in zip(directions, tool_z, counts, strict=True):
            self._turn(x, z)
            wanted = self._filter.follow(self._wanted if corrected else np.zeros(3))
            before, self._goal = self._goal, self._axes @ wanted
            self._motion.towards(self._goal, tuning, (self._goal - before) / CYCLE_S)
            ways.append(self._motion.joints)
        return ways

    def rest(self) -> list[Array]:
        """Bring the offset to rest at its current value; return the offsets, one per cycle."""
        ways = []
        while not self._motion.is_at_rest:
            self._motion.at_speed(np.zeros(3))
            ways.append(self._motion.joints)
        return ways

    def _turn(self, x: Array, tool_z: Array) -> None:
        """Update the path coordinates; keep the previous ones if y is undefined."""
        y = np.cross(tool_z, x)
        if (sine := float(np.linalg.norm(y))) > _LEAST_SINE:
            y /= sine
            self._axes = np.stack([x, y, np.cross(x, y)], axis=-1)
