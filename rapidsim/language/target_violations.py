"""Rule M501, which the check finds in the text and a run in values that were computed."""

from __future__ import annotations

from rapidsim.diagnostics import Violation

TOLERATED_NORM_ERROR = 1e-4
"""How far the length of a quaternion may be from 1: seven digits of four numbers, rounded."""


class QuaternionNotUnit(Violation, code="M501"):
    target: str
    length: float
