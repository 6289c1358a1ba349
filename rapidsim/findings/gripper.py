"""Findings of a run about the protocol of a gripper (family I)."""

from __future__ import annotations

from rapidsim.diagnostics import Violation


class GripperActsInMotion(Violation, code="I810"):
    gripper: str
    action: str
    """`closes` or `opens`."""
    early_s: float
    """Time [s] until the arm is at rest."""
    distance_mm: float
    """Distance that the TCP travels in this time."""
    times: str = ""


class GripperActsTooSoon(Violation, code="I815"):
    gripper: str
    action: str
    """`closes` or `opens`."""
    distance_mm: float
    """Distance that the next move travels along the tool."""
    target: str
    times: str = ""


class GripperNotAwaited(Violation, code="I811"):
    gripper: str
    closed: str
    """The feedback, as the station spells it."""
    state: str
    """State of the feedback when the robot moves on."""
    times: str = ""


class GripperNeverOpens(Violation, code="I812"):
    gripper: str
    until: str
    """`the end of main`."""


class GripLoadMissing(Violation, code="I813"):
    gripper: str
    problem: str
    times: str = ""


class GripperOpensEmpty(Violation, code="I814"):
    gripper: str
    times: str = ""
