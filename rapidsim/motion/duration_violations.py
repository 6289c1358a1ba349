"""What costs a cell time (family D); looked for where the station file sets a cycle budget."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class CycleOverBudget(Violation):
    """One cycle of main takes longer than the station file allows.

    The budget stands in `rapidsim.toml`, in seconds: `[check] cycle-budget = 12.5`. One cycle is
    run with inputs as the station file drives them; `rapidsim run` shows which lines cost the time,
    and ends with exit code 4 over the budget.

    ## Example

        MODULE example
          PROC main()
            WaitTime 3;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            WaitTime 0.3;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "D701"
    name: ClassVar[str] = "cycle-over-budget"
    template: ClassVar[str] = "one cycle takes {taken}; the budget is {budget_s:g} s"
    severity: ClassVar[Severity] = Severity.WARNING

    taken: str
    budget_s: float


@dataclass(frozen=True)
class AvoidableStop(Violation):
    """The robot stops at a point where it only goes straight on.

    A stop point costs braking, settling and starting again. Nothing happens here that would need
    the arm to stand: the next statement is a line in the same direction. A zone does the same.

    ## Example

        MODULE example
          CONST robtarget a:=[[700,-100,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ a,v500,fine,tool0;
            MoveL Offs(a,10,0,0),v500,fine,tool0;
            MoveL Offs(a,20,0,0),v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget a:=[[700,-100,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ a,v500,fine,tool0;
            MoveL Offs(a,10,0,0),v500,z1,tool0;
            MoveL Offs(a,20,0,0),v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "D702"
    name: ClassVar[str] = "avoidable-stop"
    template: ClassVar[str] = "the robot stops at `{target}` and goes straight on"
    severity: ClassVar[Severity] = Severity.NOTE

    target: str
