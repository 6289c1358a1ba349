r"""What comes of circles that two wrist axes lead: CirPathMode \Wrist45, \Wrist46, \Wrist56."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


@dataclass(frozen=True)
class WristCircleFails(Violation):
    r"""Two wrist axes alone cannot lead the tool along a circle.

    With `CirPathMode \Wrist45`, `\Wrist46` or `\Wrist56` only the two axes named move. They must
    be able to tilt the z axis of the tool in every direction: axes 4 and 6 cannot with axis 5 at 0,
    and a tool in line with axis 6 is not moved by that axis. What they reach is small, so circles
    must be small, and each axis has its limits.

    ## Example

        MODULE example
          CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p,v500,fine,tool0;
            CirPathMode \Wrist56;
            MoveC Offs(p,1,1,0),Offs(p,2,0,0),v20,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p,v500,fine,tool0;
            CirPathMode \Wrist45;
            MoveC Offs(p,0.2,0.2,0),Offs(p,0.4,0,0),v20,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K616"
    name: ClassVar[str] = "wrist-circle-fails"
    template: ClassVar[str] = (
        "the wrist cannot lead the circle to `{target}` at {percent:.0f} % "
        "({distance_mm:.1f} mm): {why}"
    )

    target: str
    percent: float
    distance_mm: float
    why: str
    cure: str | None = None

    @property
    def help(self) -> str:
        """What could be done about the cause, or about an axis at its limit or about to jump."""
        return self.cure or (
            "start the circle in another posture, with that axis nearer to the middle of its "
            "range, take another pair of wrist axes, or let all axes make it with "
            r"CirPathMode \PathFrame"
        )


@dataclass(frozen=True)
class WristCircleTilted(Violation):
    r"""A circle that two wrist axes lead starts with the tool far from perpendicular to it.

    `CirPathMode \Wrist45`, `\Wrist46` and `\Wrist56` are meant for cutting thin sheets with the z
    axis of the tool nearly perpendicular to them. The more it leans, the further the TCP leaves the
    plane on the way. From 10 degrees on we say so; the controller's manual gives no number.

    ## Example

        MODULE example
          CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ RelTool(p,0,0,0\Ry:=15),v500,fine,tool0;
            CirPathMode \Wrist45;
            MoveC Offs(p,0.2,0.2,0),Offs(p,0.4,0,0),v20,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p,v500,fine,tool0;
            CirPathMode \Wrist45;
            MoveC Offs(p,0.2,0.2,0),Offs(p,0.4,0,0),v20,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K617"
    name: ClassVar[str] = "wrist-circle-tilted"
    template: ClassVar[str] = (
        "the tool stands {angle_deg:.1f} deg from perpendicular to the circle to `{target}`, which "
        "{pair} lead"
    )
    severity: ClassVar[Severity] = Severity.WARNING

    target: str
    angle_deg: float
    pair: str

    @property
    def help(self) -> str:
        """Both ways out."""
        return (
            "turn the start, so that the tool's z axis is perpendicular to the sheet, or use "
            r"CirPathMode \PathFrame"
        )


@dataclass(frozen=True)
class WristCircleDeviates(Violation):
    r"""On a circle that two wrist axes lead, the TCP leaves the plane and the tool turns.

    What follows the circle is where the z axis of the tool passes its plane. The TCP is a little
    beside, and the next line or joint move starts from there; another such circle goes on where the
    z axis passes the plane. Told where the tool turns by more than half a degree.

    ## Example

        MODULE example
          CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p,v500,fine,tool0;
            CirPathMode \Wrist45;
            MoveC Offs(p,4,4,0),Offs(p,8,0,0),v20,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p,v500,fine,tool0;
            CirPathMode \ObjectFrame;
            MoveC Offs(p,4,4,0),Offs(p,8,0,0),v20,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K618"
    name: ClassVar[str] = "wrist-circle-deviates"
    template: ClassVar[str] = (
        "on the circle to `{target}` {pair} take the TCP up to {off_plane_mm:.2f} mm out of the "
        "plane and turn the tool by up to {angle_deg:.1f} deg; it ends {off_end_mm:.2f} mm from "
        "the point"
    )
    severity: ClassVar[Severity] = Severity.NOTE

    target: str
    pair: str
    off_plane_mm: float
    angle_deg: float
    off_end_mm: float

    @property
    def help(self) -> str:
        """Where the program goes on, which the controller's manual leaves open."""
        return (
            "a line or joint move starts from where the TCP stands; another such circle goes on "
            "where the tool's z axis passes the plane"
        )
