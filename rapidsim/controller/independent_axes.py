"""Independent axes: turntables and conveyors that do not follow the path of the robot.

An axis keeps its own speed and acceleration; the moves of the path do not include it. Only its
timing is simulated: path and recording show it at its position before.

Source: Application manual Controller software, "Independent Axes".
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

_HARDLY = 1e-9


@dataclass(slots=True, eq=False)
class IndependentAxisState:
    """Implements `language.equipment.IndependentAxis`; all in RAPID's units, degrees or mm."""

    acceleration: float
    """[deg/s2 or mm/s2]"""
    turns: bool = True
    """Whether the axis is rotating; otherwise it is linear."""
    is_independent: bool = False
    _phases: list[tuple[float, float, float, float]] = field(default_factory=list)
    """Time of the start [s], position, speed and acceleration; the last has no end."""
    _target: float | None = None
    _wanted_speed: float = 0.0

    def take(self, position: float, now_s: float) -> None:
        """Make the axis independent, at rest at its position."""
        if not self.is_independent:
            self.is_independent = True
            self._phases = [(now_s, position, 0.0, 0.0)]

    def release(self) -> None:
        """Make the axis follow the path again."""
        self.is_independent = False

    def position(self, now_s: float) -> float:
        """Position at a time [s]."""
        return self._at(now_s)[0]

    def speed(self, now_s: float) -> float:
        """Speed at a time [s], negative backwards."""
        return self._at(now_s)[1]

    def is_at_target(self, now_s: float) -> bool:
        """Whether the axis rests at its target; always False without a target."""
        return self._target is not None and now_s >= self._phases[-1][0]

    def has_speed(self, now_s: float) -> bool:
        """Whether the axis moves at the requested speed."""
        return abs(abs(self.speed(now_s)) - abs(self._wanted_speed)) < _HARDLY

    def move_to(self, target: float, speed: float, acceleration: float, now_s: float) -> None:
        """Move to a position and stay there."""
        position, velocity = self._at(now_s)
        self._target, self._wanted_speed = target, speed
        self._phases = []
        time_s = now_s
        braking = velocity**2 / (2.0 * acceleration)
        way = target - position
        if velocity and (way * velocity < 0.0 or braking > abs(way)):
            time_s, position = self._change(time_s, position, velocity, 0.0, acceleration)
            velocity = 0.0
        way = target - position
        forward = math.copysign(1.0, way)
        now = abs(velocity)
        top = min(abs(speed), math.sqrt(acceleration * abs(way) + now**2 / 2.0))
        time_s, position = self._change(
            time_s, position, forward * now, forward * top, acceleration
        )
        rest = max(0.0, abs(target - position) - top**2 / (2.0 * acceleration))
        self._phases.append((time_s, position, forward * top, 0.0))
        if top > 0.0:
            time_s, position = time_s + rest / top, position + forward * rest
        time_s, _ = self._change(time_s, position, forward * top, 0.0, acceleration)
        self._phases.append((time_s, target, 0.0, 0.0))

    def move_at(self, speed: float, acceleration: float, now_s: float) -> None:
        """Move indefinitely at a speed, or stop with a speed of 0."""
        position, velocity = self._at(now_s)
        self._target, self._wanted_speed = None, speed
        self._phases = []
        time_s, position = self._change(now_s, position, velocity, speed, acceleration)
        self._phases.append((time_s, position, speed, 0.0))

    def _at(self, now_s: float) -> tuple[float, float]:
        since, position, velocity, acceleration = next(
            (phase for phase in reversed(self._phases) if phase[0] <= now_s), self._phases[0]
        )
        t = max(0.0, now_s - since)
        return position + velocity * t + acceleration * t * t / 2.0, velocity + acceleration * t

    def _change(
        self, time_s: float, position: float, begin: float, end: float, acceleration: float
    ) -> tuple[float, float]:
        """Add a change of speed; return the time and the position of its end."""
        takes_s = abs(end - begin) / acceleration
        self._phases.append((time_s, position, begin, math.copysign(acceleration, end - begin)))
        return time_s + takes_s, position + (begin + end) / 2.0 * takes_s
