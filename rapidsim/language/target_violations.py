"""Rule M501, which the check finds in the text and a run in computed values."""

from __future__ import annotations

from rapidsim.diagnostics import Severity, Violation

TOLERATED_NORM_ERROR = 1e-4
"""Deviation of the length of a quaternion from 1: seven digits of four numbers, rounded."""


class QuaternionNotUnit(Violation, code="M501"):
    target: str
    length: float
    refused: bool = False
    """Whether a move requires it and it is too far off for the move to be made."""
    valueless: bool = False
    """Whether the program has persistents without a value, which another task may set."""
    set_elsewhere: bool = False
    """Whether it has no value unless a statement elsewhere has been executed before."""

    @property
    def help(self) -> str | None:
        """Replacement to suggest; zeros have no direction that could be kept."""
        if self.valueless:
            return (
                "a persistent without an initial value has zeros unless another task gives it one: "
                "check or run all tasks together, or write a value"
            )
        if self.set_elsewhere:
            return (
                "if the program comes here first, nothing has set it: give it a value where it is "
                "declared, or do not move before it is set"
            )
        if self.length < TOLERATED_NORM_ERROR:
            return "teach it again, or write `[1,0,0,0]` for the orientation of the frame itself"
        return super().help

    @property
    def severity(self) -> Severity:
        """The controller stops at a move to no orientation."""
        return Severity.ERROR if self.refused else super().severity
