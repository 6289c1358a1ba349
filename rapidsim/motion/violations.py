"""What an arm cannot do (family K) and what is wrong with motion data (family M).

The facts come from motion; whoever knows the source line binds them to it. Units are RAPID's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation

_LISTED_CONFIGURATIONS = 4
"""A pose has up to 32, most of them whole turns of axes away."""


@dataclass(frozen=True)
class UnreachableTarget(Violation):
    """The arm cannot bring the tool to the target in any configuration.

    The message says by how much: how far the wrist centre would have to be beyond what the arm can
    span, or which joint would have to turn past its limit. Move the work object, turn the tool, or
    choose a larger arm.

    ## Example

        MODULE example
          CONST robtarget far:=[[3000,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ far,v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget near:=[[800,0,500],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ near,v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K601"
    name: ClassVar[str] = "unreachable-target"
    template: ClassVar[str] = "`{target}` cannot be reached by {robot}: {why}"
    cf: ClassVar[str | None] = "ABB 50050"

    target: str
    robot: str
    why: str
    cure: str | None = None

    @property
    def help(self) -> str | None:
        """What would bring it into reach, when that is known."""
        return self.cure


@dataclass(frozen=True)
class JointOutOfRange(Violation):
    """A move asks an axis to turn past its limit.

    ## Example

        MODULE example
          PROC main()
            MoveAbsJ [[0,0,0,0,30,420],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            MoveAbsJ [[0,0,0,0,30,60],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K602"
    name: ClassVar[str] = "joint-limit"
    template: ClassVar[str] = "`{target}` asks {robot} for {why}"
    cf: ClassVar[str | None] = "ABB 50027"

    target: str
    robot: str
    why: str


@dataclass(frozen=True)
class ConfigurationNotReachable(Violation):
    """The axis configuration stored in a target does not put the tool there.

    The four numbers say in which quarter turns axes 1, 4 and 6 stand and which of the eight
    branches the arm takes. A target keeps them from where it was taught; when the work object, the
    tool or the target moves, they go stale. The controller stops with ConfJ or ConfL on; the run
    goes on with the nearest configuration that works.
    """

    code: ClassVar[str] = "K603"
    name: ClassVar[str] = "config-not-reachable"
    template: ClassVar[str] = (
        "`{target}` cannot be reached in its stored configuration {stored}; {taken} reaches it"
    )
    severity: ClassVar[Severity] = Severity.WARNING
    cf: ClassVar[str | None] = "ABB 50080"

    target: str
    stored: str
    taken: str
    working: tuple[str, ...]

    @property
    def help(self) -> str:
        """The configurations that work, the nearest to the arm first."""
        if len(self.working) == 1:
            return f"only {self.working[0]} reaches it with this tool and work object"
        listed = ", ".join(self.working[:_LISTED_CONFIGURATIONS])
        more = len(self.working) - _LISTED_CONFIGURATIONS
        return f"it is reached, nearest first, by {listed}{f' and {more} more' if more > 0 else ''}"


@dataclass(frozen=True)
class PathNotReachable(Violation):
    """Both ends of a move are reachable and the way between them is not.

    A line may pass through places where the arm cannot hold the tool: too near the base, too far
    away, past a joint limit. The message says where on the way.
    """

    code: ClassVar[str] = "K604"
    name: ClassVar[str] = "linear-path-not-reachable"
    template: ClassVar[str] = (
        "the way to `{target}` fails at {percent:.0f} % ({distance_mm:.1f} mm): {why}"
    )
    cf: ClassVar[str | None] = "ABB 50050"

    target: str
    percent: float
    distance_mm: float
    why: str

    @property
    def help(self) -> str:
        """The usual ways out."""
        return "add a point between, use MoveJ for this stretch, or start in another configuration"


@dataclass(frozen=True)
class PathThroughSingularity(Violation):
    r"""A line or arc goes through a singularity, where a wrist axis would have to jump.

    With axis 5 at 0, axes 4 and 6 turn about one line, and the smallest step of the tool may ask
    for half a turn of both. `SingArea \Wrist` interpolates the wrist axes instead: the TCP stays on
    its way and the tool deviates a little from its orientation.

    ## Example

        MODULE example
          VAR robtarget below;
          PROC main()
            MoveAbsJ [[0,0,0,0,15,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
            below:=CalcRobT([[0,10,0,0,-15,0],[9E9,9E9,9E9,9E9,9E9,9E9]],tool0);
            ConfL \Off;
            MoveL below,v200,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          VAR robtarget below;
          PROC main()
            MoveAbsJ [[0,0,0,0,15,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
            below:=CalcRobT([[0,10,0,0,-15,0],[9E9,9E9,9E9,9E9,9E9,9E9]],tool0);
            ConfL \Off;
            SingArea \Wrist;
            MoveL below,v200,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K614"
    name: ClassVar[str] = "path-through-singularity"
    template: ClassVar[str] = (
        "the way to `{target}` fails at {percent:.0f} % ({distance_mm:.1f} mm): {why}"
    )
    cf: ClassVar[str | None] = "ABB 50026"

    target: str
    percent: float
    distance_mm: float
    why: str

    @property
    def help(self) -> str:
        """The usual ways out."""
        return (
            r"`SingArea \Wrist` before the move lets the tool turn a little instead; "
            "or use MoveJ, or tilt the tool so that axis 5 stays off 0"
        )


@dataclass(frozen=True)
class PathConfiguration(Violation):
    """A line or arc does not lead from how the arm stands to how it would have to arrive.

    On a line the arm keeps its configuration: it cannot change from one side of its wrist, elbow
    or base axis to the other, and each axis arrives in the turn that it takes on the way.
    """

    code: ClassVar[str] = "K615"
    name: ClassVar[str] = "path-configuration"
    template: ClassVar[str] = (
        "the way to `{target}` fails at {percent:.0f} % ({distance_mm:.1f} mm): {why}"
    )
    cf: ClassVar[str | None] = "ABB 50436"

    target: str
    percent: float
    distance_mm: float
    why: str

    @property
    def help(self) -> str:
        """The usual ways out."""
        return "change the configuration with a MoveJ or MoveAbsJ before, or choose it for the end"


@dataclass(frozen=True)
class TooLittleTime(Violation):
    r"""A move has less time than the arm needs for it.

    `\T` gives the time of the whole move in place of a speed. The arm makes the move as fast as its
    axes allow, which takes longer, so whatever relies on the time is late.

    ## Example

        MODULE example
          PROC main()
            MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
            MoveAbsJ [[90,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500\T:=0.2,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PROC main()
            MoveAbsJ [[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500,fine,tool0;
            MoveAbsJ [[90,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]],v500\T:=2,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K612"
    name: ClassVar[str] = "too-little-time"
    template: ClassVar[str] = "the move takes {needed_s:.3f} s; `\\T` gives it {programmed_s:g} s"
    severity: ClassVar[Severity] = Severity.WARNING

    programmed_s: float
    needed_s: float


@dataclass(frozen=True)
class CircleUncertain(Violation):
    """The three points of a MoveC do not make a circle that can be trusted.

    Points too close to each other, points on a line, or an arc of more than 240 degrees let a small
    error of one point turn the whole circle. A full circle takes two MoveC.

    ## Example

        MODULE example
          CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p,v500,fine,tool0;
            MoveC Offs(p,0,50,0),Offs(p,0,100,0),v200,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST robtarget p:=[[900,0,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p,v500,fine,tool0;
            MoveC Offs(p,-50,50,0),Offs(p,0,100,0),v200,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "M506"
    name: ClassVar[str] = "movec-geometry"
    template: ClassVar[str] = "the move to `{target}` is no sure circle: {why}"
    cf: ClassVar[str | None] = "ABB 50063"

    target: str
    why: str


@dataclass(frozen=True)
class ExternalAxisMissing(Violation):
    """A target has no value for an external axis that is active.

    9E9 says that an axis is not connected. Where the station declares the axis and its mechanical
    unit is active, every target must say where it goes; the controller stops.
    """

    code: ClassVar[str] = "M520"
    name: ClassVar[str] = "external-axis-missing"
    template: ClassVar[str] = "`{target}` gives no value for {axis} of `{unit}`, which is active"
    cf: ClassVar[str | None] = "ABB 40512"

    target: str
    axis: str
    unit: str

    @property
    def help(self) -> str:
        """Both ways out."""
        return f"write the value in place of 9E9, or switch the unit off with DeactUnit {self.unit}"


@dataclass(frozen=True)
class ExternalAxisUnknown(Violation):
    """A target gives values for external axes that the station does not declare.

    The values are kept with the target and move nothing. Declare the axes in the station file, in
    tables `[[external_axis]]`, to simulate a track, a positioner or an axis of its own.

    ## Example

        MODULE example
          CONST jointtarget p:=[[0,0,0,0,30,0],[1500,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveAbsJ p,v500,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST jointtarget p:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveAbsJ p,v500,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "M521"
    name: ClassVar[str] = "external-axis-unknown"
    template: ClassVar[str] = "`{target}` gives {axes}, and no such external axis is declared"
    severity: ClassVar[Severity] = Severity.NOTE

    target: str
    axes: str

    @property
    def help(self) -> str:
        """What to do for a simulation of it."""
        return "the value moves nothing; declare the axis as [[external_axis]] in the station file"


@dataclass(frozen=True)
class NothingMovesTool(Violation):
    r"""Tool and work object are both in the robot's hand, or neither is.

    One of them is held by the robot and the other stands in the cell: a tool in the hand works on
    an object outside (`robhold` TRUE in the tool, FALSE in the work object), or an object in the
    hand is brought to a stationary tool (FALSE in the tool, TRUE in the work object).

    ## Example

        MODULE example
          PERS tooldata glue:=[FALSE,[[900,0,700],[1,0,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
          CONST robtarget p:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            MoveJ p,v500,fine,glue;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          PERS tooldata glue:=[FALSE,[[900,0,700],[0,1,0,0]],[1,[0,0,1],[1,0,0,0],0,0,0]];
          PERS wobjdata part:=[TRUE,TRUE,"",[[0,0,50],[1,0,0,0]],[[0,0,0],[1,0,0,0]]];
          CONST robtarget p:=[[0,0,0],[1,0,0,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          PROC main()
            ConfJ \Off;
            MoveJ p,v500,fine,glue\WObj:=part;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "M522"
    name: ClassVar[str] = "nothing-moves-tool"
    template: ClassVar[str] = "the move to `{target}`: {why}"

    target: str
    why: str

    @property
    def help(self) -> str:
        """What must be so."""
        return "exactly one of tool and work object has robhold TRUE"


@dataclass(frozen=True)
class OrientationDeviates(Violation):
    r"""SingArea lets the tool turn away from its programmed orientation.

    With `\Wrist` the wrist axes are interpolated along a line or arc and the TCP stays on it; with
    `\LockAxis4` axis 4 stays at 0 or half a turn in addition, so that the end of the move may be
    turned, too.

    ## Example

        MODULE example
          CONST jointtarget start:=[[0,0,0,20,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          VAR robtarget p;
          PROC main()
            p:=CalcRobT([[0,10,0,20,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]],tool0);
            MoveAbsJ start,v500,fine,tool0;
            SingArea \LockAxis4;
            ConfL \Off;
            MoveL p,v200,fine,tool0;
          ENDPROC
        ENDMODULE

    ## Fix

        MODULE example
          CONST jointtarget start:=[[0,0,0,20,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
          VAR robtarget p;
          PROC main()
            p:=CalcRobT([[0,10,0,20,40,0],[9E9,9E9,9E9,9E9,9E9,9E9]],tool0);
            MoveAbsJ start,v500,fine,tool0;
            SingArea \Off;
            ConfL \Off;
            MoveL p,v200,fine,tool0;
          ENDPROC
        ENDMODULE
    """

    code: ClassVar[str] = "K613"
    name: ClassVar[str] = "orientation-deviates"
    template: ClassVar[str] = (
        "`SingArea {switch}` turns the tool by up to {angle_deg:.1f} deg {where} `{target}`"
    )
    severity: ClassVar[Severity] = Severity.NOTE

    target: str
    switch: str
    angle_deg: float
    where: str
