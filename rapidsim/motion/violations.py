"""What an arm cannot do (family K) and what is wrong with motion data (family M).

The facts come from motion; whoever knows the source line binds them to it. Units are RAPID's.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from rapidsim.diagnostics import Severity, Violation


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
        "`{target}` cannot be reached in its stored configuration {stored}; {taken} was taken"
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
        return f"it is reached, nearest first, by {', '.join(self.working)}"


@dataclass(frozen=True)
class PathNotReachable(Violation):
    """Both ends of a move are reachable and the way between them is not.

    A line may pass through places the arm cannot hold the tool: too near the base, past a joint
    limit, through a singularity. The message says where on the way.
    """

    code: ClassVar[str] = "K604"
    name: ClassVar[str] = "linear-path-not-reachable"
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
        return "add a point between, use MoveJ for this stretch, or start in another configuration"


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

    code: ClassVar[str] = "K605"
    name: ClassVar[str] = "too-little-time"
    template: ClassVar[str] = "the move takes {needed_s:.3f} s; `\\T` gives it {programmed_s:g} s"
    severity: ClassVar[Severity] = Severity.WARNING

    programmed_s: float
    needed_s: float


@dataclass(frozen=True)
class QuaternionNotUnit(Violation):
    """An orientation is not a unit quaternion.

    Targets are written with six or seven digits, so the length of the four numbers is 1 but for
    rounding. When it is not, the numbers were typed or computed wrongly, or the data was never
    given a value.
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
