"""Findings about the limits of an arm (family K) and invalid motion data (family M).

Motion provides the facts; its callers add the source position. Units are RAPID's.
"""

from __future__ import annotations

from collections.abc import Sequence

from rapidsim.diagnostics import Severity, Violation

_LISTED_CONFIGURATIONS = 4
"""A pose has up to 32 configurations, most of them whole turns of axes away."""
_NAME_IT = "name yours with --robot or as `model` under [robot] in rapidsim.toml"


class UnreachableTarget(Violation, code="K601"):
    target: str
    robot: str
    reason: str
    suggestion: str | None = None
    taken_by_default: bool = False
    """Whether no file specifies the arm: then all targets out of its reach are one finding."""
    other_text: int = 0
    """Number of other targets that are reported with it."""

    @property
    def is_reported_once(self) -> bool:
        """True if the arm is a default, which then is the common cause."""
        return self.taken_by_default

    def with_others(self, merged: Sequence[Violation]) -> UnreachableTarget:
        """Merge the others into this one, with their number."""
        return UnreachableTarget(
            self.target, self.robot, self.reason, self.suggestion, True, len(merged)
        )

    @property
    def message(self) -> str:
        """Message with the first target, and the number of others."""
        if not self.other_text:
            return super().message
        more = f"{self.other_text} more target{'s' if self.other_text > 1 else ''}"
        return super().message.replace("cannot be", f"and {more} cannot be", 1)

    @property
    def help(self) -> str | None:
        """Suggestion that would bring the target into reach, if known."""
        if self.taken_by_default:
            return f"nothing names the arm, {self.robot} is only the default: {_NAME_IT}"
        return self.suggestion


class JointOutOfRange(Violation, code="K602"):
    target: str
    robot: str
    reason: str
    is_of_joints: bool = False
    """Whether the target specifies positions of axes."""

    @property
    def case(self) -> str:
        """Case of the rule: a target, or a jointtarget."""
        return "joint target" if self.is_of_joints else "target"


class ConfigurationNotReachable(Violation, code="K603"):
    target: str
    stored: str
    assumed: str
    working: tuple[str, ...]
    past_limit: str = ""
    """Description of the limit that prevents the stored turn; empty if no turn is near."""
    continues: bool = False
    """Whether only cf1, cf4 or cf6 differ: then a run uses the nearest and continues."""

    @property
    def severity(self) -> Severity:
        """Warning if the run continues."""
        return Severity.WARNING if self.continues else super().severity

    @property
    def message(self) -> str:
        """Message with the joint and the limit that decide."""
        why = f"configuration {self.stored}: {self.past_limit};"
        old = f"configuration {self.stored};"
        return super().message.replace(old, why, 1) if self.past_limit else super().message

    @property
    def help(self) -> str:
        """Suggestion of valid configurations, the nearest to the arm first."""
        if len(self.working) == 1:
            return f"only {self.working[0]} reaches it with this tool and work object"
        listed = ", ".join(self.working[:_LISTED_CONFIGURATIONS])
        more = len(self.working) - _LISTED_CONFIGURATIONS
        return f"reached by, nearest first: {listed}{f' and {more} more' if more > 0 else ''}"


class MainAxesSwitched(Violation, code="K619"):
    target: str
    before: int
    after: int
    reason: str


class WristTurnsFar(Violation, code="K620"):
    target: str
    axis: int
    turn_deg: float


class ConfigurationChangesOnLine(Violation, code="K606"):
    target: str
    stored: str
    arrives: str
    continues: bool = False
    """Whether only cf1, cf4 or cf6 differ: then a run continues."""

    @property
    def severity(self) -> Severity:
        """Warning if the run continues."""
        return Severity.WARNING if self.continues else super().severity


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
    reason: str
    is_simulated: bool = True
    """Whether paths of the arm are simulated; if not, a controller may execute this one."""

    @property
    def severity(self) -> Severity:
        """Warning if the path is not simulated, because then it is no error of the program."""
        return super().severity if self.is_simulated else Severity.WARNING


class PathThroughSingularity(Violation, code="K614"):
    target: str
    percent: float
    distance_mm: float
    reason: str


class PathConfiguration(Violation, code="K615"):
    target: str
    percent: float
    distance_mm: float
    reason: str


class TooLittleTime(Violation, code="K612"):
    programmed_s: float
    needed_s: float


class CircleUncertain(Violation, code="M506"):
    target: str
    reason: str


class ExternalAxisMissing(Violation, code="M520"):
    target: str
    axis: str
    unit: str


class ExternalAxisUnknown(Violation, code="M521"):
    target: str
    axes: str


class NothingMovesTool(Violation, code="M522"):
    target: str
    reason: str


class CoordinationImpossible(Violation, code="M523"):
    target: str
    reason: str


class OrientationDeviates(Violation, code="K613"):
    target: str
    switch: str
    angle_deg: float
    location: str
