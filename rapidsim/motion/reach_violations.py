"""What checking finds about moves that a run would make without a word (families K and M)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class NearSingularity(Violation):
    r"""A line or arc passes so near a singularity that the arm slows down to half or less.

    Near axis 5 = 0 (wrist), near the stretched or folded arm (elbow) and with the wrist over axis 1
    (shoulder), a small way of the tool asks for a large turn of one or two axes. The controller
    slows down, or stops with this event. Tilt the tool, move the work object, or go with MoveJ.

    ## Example

        MODULE example
          CONST robtarget a:=[[780,10,850],[0.7071068,0,0.7071068,0],[0,0,-1,1],
            [9E9,9E9,9E9,9E9,9E9,9E9]];
          CONST robtarget b:=[[780,10,1050],[0.7071068,0,0.7071068,0],[0,1,-2,1],
            [9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ a,v500,fine,tool0;
            MoveL b,v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget a:=[[780,10,850],[0.7071068,0,0.7071068,0],[0,0,-1,1],
            [9E9,9E9,9E9,9E9,9E9,9E9]];
          CONST robtarget b:=[[780,10,1050],[0.7071068,0,0.7071068,0],[0,1,-2,1],
            [9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ a,v500,fine,tool0;
            MoveJ b,v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K605"
    name: ClassVar[str] = "near-singularity"
    template: ClassVar[str] = (
        "the way to `{target}` comes near the {which} singularity at {percent:.0f} %: "
        "axis {axis} allows {possible_percent:.0f} % of the programmed speed there"
    )
    severity: ClassVar[Severity] = Severity.WARNING
    cf: ClassVar[str | None] = "ABB 50026"

    target: str
    which: str
    percent: float
    axis: int
    possible_percent: float

    @property
    def help(self) -> str:
        """The usual ways out."""
        ways = {
            "wrist": "tilt the tool so that axis 5 stays away from 0, or use MoveJ",
            "elbow": "bring the work object nearer, so that the arm is not stretched",
            "shoulder": "keep the wrist away from the line above axis 1",
        }
        return ways[self.which]


@dataclass(frozen=True)
class ConfigurationChangesOnLine(Violation):
    """A line or arc does not arrive in the configuration that its target stores.

    The arm cannot change its configuration on a line: it arrives on the branch, and with the turns
    of axes 4 and 6, that the way from the start gives. With ConfL on the controller stops.

    ## Example

        MODULE example
          CONST robtarget a:=[[700,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          CONST robtarget b:=[[700,200,600],[0,0,1,0],[0,2,2,1],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ a,v500,fine,tool0;
            MoveL b,v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget a:=[[700,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          CONST robtarget b:=[[700,200,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ a,v500,fine,tool0;
            MoveL b,v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K606"
    name: ClassVar[str] = "config-change-on-linear"
    template: ClassVar[str] = (
        "the way to `{target}` arrives in configuration {arrives}, not in the stored {stored}"
    )
    severity: ClassVar[Severity] = Severity.WARNING
    cf: ClassVar[str | None] = "ABB 50080"

    target: str
    stored: str
    arrives: str

    @property
    def help(self) -> str:
        """The usual ways out."""
        return f"store {self.arrives}, go there with MoveJ, or switch the check off with ConfL\\Off"


@dataclass(frozen=True)
class LowJointMargin(Violation):
    """An axis stands within five degrees of its limit at a target.

    It works here. On the real cell, calibration, another tool or a work object that stands a little
    otherwise takes those degrees.

    ## Example

        MODULE example
          PROC main()
            MoveAbsJ [[0,0,0,0,113,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            MoveAbsJ [[0,0,0,0,100,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K607"
    name: ClassVar[str] = "low-joint-margin"
    template: ClassVar[str] = (
        "at `{target}` axis {axis} stands at {degrees:.1f} deg, "
        "{margin:.1f} deg from its limit of {limit:g} deg"
    )
    severity: ClassVar[Severity] = Severity.NOTE

    target: str
    axis: int
    degrees: float
    margin: float
    limit: float


@dataclass(frozen=True)
class AxisSpeedLimits(Violation):
    r"""The programmed speed cannot be kept: an axis would have to turn faster than it can.

    The arm makes the move, slower. Where the tool turns a lot on a short way, a longer way or less
    turning helps; elsewhere the programmed speed says more than the cell does.

    ## Example

        MODULE example
          CONST robtarget a:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ a,v500,fine,tool0;
            MoveL RelTool(a,0,0,50\Rz:=80),v2000,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget a:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ a,v500,fine,tool0;
            MoveL RelTool(a,0,0,50),v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K609"
    name: ClassVar[str] = "joint-speed-limited"
    template: ClassVar[str] = (
        "axis {axis} cannot keep up with the {programmed:g} mm/s to `{target}`: "
        "{possible:.0f} mm/s at {percent:.0f} % of the way"
    )
    severity: ClassVar[Severity] = Severity.NOTE

    target: str
    axis: int
    programmed: float
    possible: float
    percent: float


@dataclass(frozen=True)
class ZoneTooLarge(Violation):
    """A zone is larger than half of a move at it, and the controller makes it smaller.

    Corner paths must not overlap, so none takes more than half of a move. The corner is sharper and
    slower than the zone says.

    ## Example

        MODULE example
          CONST robtarget a:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ a,v500,fine,tool0;
            MoveL Offs(a,0,60,0),v500,z100,tool0;
            MoveL Offs(a,100,60,0),v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget a:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ a,v500,fine,tool0;
            MoveL Offs(a,0,60,0),v500,z20,tool0;
            MoveL Offs(a,100,60,0),v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "M504"
    name: ClassVar[str] = "zone-too-large"
    template: ClassVar[str] = (
        "a zone of {zone:g} mm is more than half of the {length:.1f} mm {which} it; "
        "{used:.1f} mm are used"
    )
    severity: ClassVar[Severity] = Severity.NOTE

    zone: float
    length: float
    which: str
    """`before` or `after`."""
    used: float


@dataclass(frozen=True)
class ZeroLengthMove(Violation):
    """A move goes where the robot is already.

    It costs a stop or a corner and moves nothing. Often the wrong target was copied.

    ## Example

        MODULE example
          CONST robtarget a:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ a,v500,z10,tool0;
            MoveL a,v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget a:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ Offs(a,0,0,50),v500,z10,tool0;
            MoveL a,v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "M505"
    name: ClassVar[str] = "zero-length-move"
    template: ClassVar[str] = "the robot stands at `{target}` already: the move has no length"
    severity: ClassVar[Severity] = Severity.NOTE

    target: str


@dataclass(frozen=True)
class JointWindUp(Violation):
    r"""Each round of a loop leaves axis 4 or 6 a whole turn further.

    With ConfL or ConfJ off the arm goes the short way from target to target, and the turns add up.
    The program works for some rounds, and then the axis is at its limit: at the end of the shift.
    Turn the axis back with a MoveAbsJ or MoveJ in each round, or keep the configuration monitored.

    ## Example

        MODULE example
          CONST robtarget p:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p,v500,fine,tool0;
            ConfL\Off;
            WHILE TRUE DO
              MoveL p,v500,fine,tool0;
              MoveL RelTool(p,0,0,-50\Rz:=120),v20,fine,tool0;
              MoveL RelTool(p,0,0,-80\Rz:=240),v20,fine,tool0;
            ENDWHILE
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget p:=[[700,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            ConfL\Off;
            WHILE TRUE DO
              MoveJ p,v500,fine,tool0;
              MoveL RelTool(p,0,0,-50\Rz:=120),v20,fine,tool0;
              MoveL RelTool(p,0,0,-80\Rz:=240),v20,fine,tool0;
            ENDWHILE
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K608"
    name: ClassVar[str] = "joint-wind-up"
    template: ClassVar[str] = (
        "axis {axis} stands {turned:.0f} deg further each time the program comes to `{target}`: "
        "at {first:.0f}, then at {second:.0f} deg; its limit is {limit:.0f} deg"
    )
    severity: ClassVar[Severity] = Severity.WARNING
    cf: ClassVar[str | None] = "ABB 50027"

    target: str
    axis: int
    turned: float
    first: float
    second: float
    limit: float
