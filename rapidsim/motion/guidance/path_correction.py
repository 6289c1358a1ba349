"""Path corrections by a sensor: path coordinates, filter, gain, limits.

x is along the path, y the cross product of the tool's z and x, z that of x and y. A sensor corrects
y and z. As for guidance, ABB publishes no control law: here the correction passes the filters of
its configuration, the offset follows it as the axes of `joint_law` do, and turns with the path.

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
"""No direction of the way off changes faster [m/s] and [m/s2]; ours, for ABB gives none."""
_LEAST_SINE: Final = 1e-6
"""A tool that points along its path does not say which way y is."""


@value_class(slots=True, eq=False)
class PathCorrection:
    """The offset of a TCP from its path over time; `follow` advances it."""

    gain: float
    """Speed [m/s] per m that is left: Kp."""
    filters_hz: tuple[float, ...]
    has_answer: bool = False
    """Whether the sensor has said anything."""
    _wanted: Array = field(init=False)
    """In path coordinates [m]."""
    _filter: LowPass = field(init=False)
    _motion: JointMotion = field(init=False)
    _axes: Array = field(init=False)
    """base_from_path (3, 3), where the path led last."""
    _goal: Array = field(init=False)

    def __post_init__(self) -> None:
        """Begin on the path."""
        free = np.full(3, np.inf)
        limits = GuidedAxes(-free, free, np.full(3, _FASTEST), np.full(3, _HARDEST))
        self._wanted = self._goal = np.zeros(3)
        self._filter = LowPass(self.filters_hz, np.zeros(3))
        self._motion = JointMotion(limits, np.zeros(3), np.zeros(3))
        self._axes = np.zeros((3, 3))

    def accept(self, answer: SensorAnswer) -> bool:
        """Take an answer of the sensor; whether it was a correction."""
        if len(answer.correction) != 3:
            return False
        _, y, z = answer.correction
        self._wanted, self.has_answer = MM * np.array([0.0, y, z]), True
        return True

    def follow(self, directions: Array, tool_z: Array, counts: Array) -> list[Array]:
        """Advance by one cycle per row; the offset (3,) [m] at the end of each, in base.

        Args:
            directions: Path directions at the end of each cycle (k, 3), in base; 0 for none.
            tool_z: The tool's z (k, 3), likewise.
            counts: Whether (k,) the path is corrected there.
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
        """Bring the offset to rest at its current value; the offset at the end of each cycle."""
        ways = []
        while not self._motion.is_at_rest:
            self._motion.at_speed(np.zeros(3))
            ways.append(self._motion.joints)
        return ways

    def _turn(self, x: Array, tool_z: Array) -> None:
        """Take the coordinates of another place; those of the last one, if it says none."""
        y = np.cross(tool_z, x)
        if (sine := float(np.linalg.norm(y))) > _LEAST_SINE:
            y /= sine
            self._axes = np.stack([x, y, np.cross(x, y)], axis=-1)
