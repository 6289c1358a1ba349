"""Findings of a check about moves that a run would execute silently (families K and M)."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class NearSingularity(Violation, code="K605"):
    target: str
    which: str
    percent: float
    axis: int
    possible_percent: float

    @property
    def help(self) -> str:
        """Suggestion for the kind of singularity."""
        ways = {
            "wrist": "tilt the tool so that axis 5 stays away from 0, or use MoveJ",
            "elbow": "bring the work object nearer, so that the arm is not stretched",
            "shoulder": "keep the wrist away from the line above axis 1",
        }
        return ways[self.which]


class LowJointMargin(Violation, code="K607"):
    target: str
    axis: int
    degrees: float
    margin: float
    limit: float
    measure: str


class ConfigurationQuarterOff(Violation, code="K622"):
    target: str
    stored: str
    reached: str


class Overload(Violation, code="M524"):
    subject: str
    """Overloaded part, with its verb."""
    mass_kg: float
    robot: str
    rated_kg: float


class AxisSpeedLimits(Violation, code="K609"):
    target: str
    axis: int
    programmed: float
    possible: float
    percent: float


class ZoneTooLarge(Violation, code="M504"):
    zone: float
    length: float
    which: str
    """`before` or `after`."""
    used: float


class ZeroLengthMove(Violation, code="M505"):
    target: str


class JointWindUp(Violation, code="K608"):
    target: str
    axis: int
    turned: float
    first: float
    second: float
    limit: float
