"""Signals that guide a robot: EGMSetupAI, EGMSetupAO, EGMSetupGI."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rapidsim.controller.cell.cell import Cell
from rapidsim.controller.cell.sensors import SilentSensor
from rapidsim.frames.quaternion import from_zyx
from rapidsim.language.guidance import Purpose
from rapidsim.motion.guidance.feedback import Feedback
from rapidsim.motion.guidance.sensor import SensorAnswer


@dataclass(slots=True, eq=False)
class SignalSensor(SilentSensor):
    """Answers with the values of signals; implements `sensors.GuidanceSensor`.

    They are joints [deg]; or a pose: x, y, z [mm], then the angles about fixed x, y and z [deg]; or
    a path correction: x, y, z [mm]. A value without a signal is that at the start of the guidance.
    """

    cell: Cell
    signals: tuple[str, ...]
    """Names of the signals; empty for values without a signal."""
    purpose: Purpose
    _first: Feedback | None = None

    def exchange(self, feedback: Feedback) -> SensorAnswer | None:
        """Return the current values of the signals."""
        self._first = first = self._first or feedback
        values = [self.cell.signals.read(name) if name else None for name in self.signals]
        if self.purpose is Purpose.PATH_CORRECTION:
            return SensorAnswer(correction=tuple(value or 0.0 for value in values[:3]))
        if self.purpose is not Purpose.POSE:
            told = zip(values, first.joints, strict=False)
            joints = [here if value is None else value for value, here in told]
            return SensorAnswer(joints=(*joints, *first.joints[len(values) :]))
        places = zip(values[:3], first.position, strict=True)
        angles = values[3:]
        orientation = first.orientation
        if any(angle is not None for angle in angles):
            x, y, z = (math.radians(angle or 0.0) for angle in angles)
            orientation = from_zyx(z, y, x)
        position = tuple(here if value is None else value for value, here in places)
        return SensorAnswer(position=position, orientation=orientation)

    def end(self, feedback: Feedback) -> None:
        """Discard the first feedback: the next guidance begins elsewhere."""
        del feedback
        self._first = None
