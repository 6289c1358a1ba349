"""Findings of a run about bodies that touch or come near each other (family C)."""

from __future__ import annotations

from rapidsim.diagnostics import Diagnostic, Violation


class Collision(Violation, code="C101"):
    first: str
    second: str
    time_s: float
    deep: str
    """Penetration depth for the message; empty if it was not computed."""
    also: str
    """The other bodies that hit the same one on that move; empty for none."""


class LowClearance(Violation, code="C102"):
    first: str
    second: str
    distance_mm: float
    clearance_mm: float
    time_s: float


class NotJudged(Violation, code="C103"):
    subject: str


class LeftInTheAir(Violation, code="C105"):
    part: str
    time_s: float
    below: str
    """Body below it and its distance, for the message."""
    suggestion: str


class NothingGripped(Violation, code="C106"):
    gripper: str
    time_s: float
    nearest: str
    """The nearest part and its distance, for the message."""


class PlaceOccupied(Violation, code="C107"):
    part: str
    occupant: str
    """The part that is there, and the place, for the message."""
    time_s: float


class CollisionNotRun(Violation, code="C104"):
    first: str
    second: str
    percent: float
    deep: str
    suggestion: str
    """Suggested remedy; empty without one."""


def time_of_contact_s(finding: Diagnostic) -> float | None:
    """When a finding about bodies in a run holds; None for other findings."""
    found = finding.violation
    timed = (Collision, LowClearance, LeftInTheAir, NothingGripped, PlaceOccupied)
    return found.time_s if isinstance(found, timed) else None


def is_of_parts(finding: Diagnostic) -> bool:
    """Whether a finding depends on all that has happened to a part of the cell before."""
    return isinstance(finding.violation, (LeftInTheAir, NothingGripped, PlaceOccupied))


def is_of_cell(finding: Diagnostic) -> bool:
    """Whether a finding depends on all robots of a cell: it is one of bodies in a run."""
    return finding.code.startswith("C") and not isinstance(finding.violation, CollisionNotRun)
