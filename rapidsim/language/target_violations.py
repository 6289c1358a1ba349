"""Rule M501, which the check finds in the text and a run in values that were computed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation

TOLERATED_NORM_ERROR = 1e-4
"""How far the length of a quaternion may be from 1: seven digits of four numbers, rounded."""


@dataclass(frozen=True)
class QuaternionNotUnit(Violation):
    """An orientation is not a unit quaternion.

    Targets are written with six or seven digits, so the length of the four numbers is 1 but for
    rounding. When it is not, the numbers were typed or computed wrongly, or the data was never
    given a value. `rapidsim check --fix` divides by the length where it is not far off.

    ## Example

        MODULE example
          CONST robtarget p10:=[[900,0,600],[0,0,0.995,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p10,v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget p10:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p10,v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "M501"
    name: ClassVar[str] = "quaternion-not-unit"
    template: ClassVar[str] = "the orientation of `{target}` has length {length:.4f}, not 1"
    severity: ClassVar[Severity] = Severity.WARNING
    cf: ClassVar[str | None] = "ABB 50076"

    target: str
    length: float

    @property
    def help(self) -> str:
        """The function that cures it."""
        return "normalise it with NOrient, or write more digits"
