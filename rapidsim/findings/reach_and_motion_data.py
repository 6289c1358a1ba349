"""What an arm cannot do (family K) and what is wrong with motion data (family M).

The facts come from motion; whoever knows the source line binds them to it. Units are RAPID's.
"""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.diagnostics import Severity, Violation

_LISTED_CONFIGURATIONS = 4
"""A pose has up to 32, most of them whole turns of axes away."""
_NAME_IT = "name yours with --robot or as `model` under [robot] in rapidsim.toml"


class UnreachableTarget(Violation, code="K601"):
    target: str
    robot: str
    why: str
    cure: str | None = None
    taken_by_default: bool = False
    """Whether nothing names the arm: then all targets out of its reach are one finding."""
    others: int = 0
    """How many more are told with it."""

    @property
    def is_told_once(self) -> bool:
        """Where the arm is a guess, what is wrong is the guess."""
        return self.taken_by_default

    def with_others(self, others: Sequence[Violation]) -> UnreachableTarget:
        """This one, and how many more there are."""
        return UnreachableTarget(self.target, self.robot, self.why, self.cure, True, len(others))

    @property
    def message(self) -> str:
        """The first target, and how many more."""
        if not self.others:
            return super().message
        more = f"{self.others} more target{'s' if self.others > 1 else ''}"
        return super().message.replace("cannot be", f"and {more} cannot be", 1)

    @property
    def help(self) -> str | None:
        """What would bring it into reach, when that is known."""
        if self.taken_by_default:
            return f"nothing names the arm, {self.robot} is only the default: {_NAME_IT}"
        return self.cure


class JointOutOfRange(Violation, code="K602"):
    target: str
    robot: str
    why: str
    is_of_joints: bool = False
    """Whether the target gives positions of axes."""

    @property
    def case(self) -> str:
        """A target, or one of joints."""
        return "joint target" if self.is_of_joints else "target"


class ConfigurationNotReachable(Violation, code="K603"):
    target: str
    stored: str
    taken: str
    working: tuple[str, ...]
    past_limit: str = ""
    """What keeps the arm from the stored turn, in words; empty if no turn is near."""
    goes_on: bool = False
    """Whether only cf1, cf4 or cf6 differ: then a run takes the nearest and goes on."""

    @property
    def severity(self) -> Severity:
        """A run that goes on is not stopped by it."""
        return Severity.WARNING if self.goes_on else super().severity

    @property
    def message(self) -> str:
        """With the joint and the limit that decide."""
        why = f"configuration {self.stored}: {self.past_limit};"
        old = f"configuration {self.stored};"
        return super().message.replace(old, why, 1) if self.past_limit else super().message

    @property
    def help(self) -> str:
        """The configurations that work, the nearest to the arm first."""
        if len(self.working) == 1:
            return f"only {self.working[0]} reaches it with this tool and work object"
        listed = ", ".join(self.working[:_LISTED_CONFIGURATIONS])
        more = len(self.working) - _LISTED_CONFIGURATIONS
        return f"reached by, nearest first: {listed}{f' and {more} more' if more > 0 else ''}"


class MainAxesSwitched(Violation, code="K619"):
    target: str
    before: int
    after: int
    why: str


class WristTurnsFar(Violation, code="K620"):
    target: str
    axis: int
    turn_deg: float


class ConfigurationChangesOnLine(Violation, code="K606"):
    target: str
    stored: str
    arrives: str
    goes_on: bool = False
    """Whether only cf1, cf4 or cf6 differ: then a run goes on."""

    @property
    def severity(self) -> Severity:
        """A run that goes on is not stopped by it."""
        return Severity.WARNING if self.goes_on else super().severity


class PastLimitByRounding(Violation, code="K621"):
    target: str
    configuration: str
    axis: int
    value: str
    excess: str


class PathNotReachable(Violation, code="K604"):
    target: str
    percent: float
    distance_mm: float
    why: str
    is_simulated: bool = True
    """Whether paths of the arm are simulated; if not, the controller may make this one."""

    @property
    def severity(self) -> Severity:
        """What is not simulated is no error of the program."""
        return super().severity if self.is_simulated else Severity.WARNING


class PathThroughSingularity(Violation, code="K614"):
    target: str
    percent: float
    distance_mm: float
    why: str


class PathConfiguration(Violation, code="K615"):
    target: str
    percent: float
    distance_mm: float
    why: str


class TooLittleTime(Violation, code="K612"):
    programmed_s: float
    needed_s: float


class CircleUncertain(Violation, code="M506"):
    target: str
    why: str


class ExternalAxisMissing(Violation, code="M520"):
    target: str
    axis: str
    unit: str


class ExternalAxisUnknown(Violation, code="M521"):
    target: str
    axes: str


class NothingMovesTool(Violation, code="M522"):
    target: str
    why: str


class CoordinationImpossible(Violation, code="M523"):
    target: str
    why: str


class OrientationDeviates(Violation, code="K613"):
    target: str
    switch: str
    angle_deg: float
    where: str
