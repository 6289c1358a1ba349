"""What a run finds about the smoothing of the command (family R)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class CornerTooFast(Violation):
    """The smoothed motion passes a corner faster than the axes can turn.

    A controller smooths its command. Here the smoothing moves the arm along its path, so that it
    stays exactly on it: times are those of a controller, but in tight corners some axis would have
    to accelerate more than it can. A controller smooths each axis by itself and rounds the corner.
    Said from three times the acceleration on, once for a run.

    ## Example

        MODULE example
          CONST robtarget p:=[[700,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p,v500,fine,tool0;
            MoveL Offs(p,0,200,0),v500,z1,tool0;
            MoveL Offs(p,150,200,0),v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget p:=[[700,0,700],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p,v500,fine,tool0;
            MoveL Offs(p,0,200,0),v500,z50,tool0;
            MoveL Offs(p,150,200,0),v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "R116"
    name: ClassVar[str] = "corner-too-fast"
    template: ClassVar[str] = (
        "smoothed along the path, the arm passes this corner with {load:.1f} times the "
        "acceleration of axis {axis}{others}"
    )
    severity: ClassVar[Severity] = Severity.NOTE

    load: float
    axis: int
    others: str
    """How many more such corners there are; empty for none."""

    @property
    def help(self) -> str:
        """How to see what an arm does instead."""
        return (
            'a controller rounds it: `[motion] smoothing = "axes"` in rapidsim.toml shows by how '
            "much; larger zones or less speed ask for less"
        )
