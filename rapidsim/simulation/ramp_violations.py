"""What a run finds about AccSet's ramps (family R)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class RampWaits(Violation):
    r"""A higher ramp than before is asked for while the robot does not stop.

    A low ramp of AccSet smooths the motion over a longer time. In this model that time becomes
    shorter only where the robot stands: the higher ramp acts from the next stop point on, and until
    then the moves accelerate as gently as those before. A lower ramp acts at once.

    ## Example

        MODULE example
          PROC main()
            AccSet 100,50;
            MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,z50,tool0;
            AccSet 100,100;
            MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            AccSet 100,50;
            MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
            AccSet 100,100;
            MoveAbsJ [[20,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v1000,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "R113"
    name: ClassVar[str] = "ramp-waits"
    template: ClassVar[str] = (
        "AccSet asks for a ramp of {wanted:g} %, and this move still has {kept:g} %: in this model "
        "a higher ramp acts from the next stop point on"
    )
    severity: ClassVar[Severity] = Severity.NOTE

    wanted: float
    kept: float

    @property
    def help(self) -> str:
        """How the higher ramp acts at once."""
        return "end the move before in a stop point, or make the moves with the higher ramp first"
