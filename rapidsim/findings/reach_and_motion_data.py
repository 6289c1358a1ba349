"""What an arm cannot do (family K) and what is wrong with motion data (family M).

The facts come from motion; whoever knows the source line binds them to it. Units are RAPID's.
"""

from __future__ import annotations

from rapidsim.diagnostics import Violation

_LISTED_CONFIGURATIONS = 4
"""A pose has up to 32, most of them whole turns of axes away."""


class UnreachableTarget(Violation, code="K601"):
    target: str
    robot: str
    why: str
    cure: str | None = None

    @property
    def help(self) -> str | None:
        """What would bring it into reach, when that is known."""
        return self.cure


class JointOutOfRange(Violation, code="K602"):
    target: str
    robot: str
    why: str


class ConfigurationNotReachable(Violation, code="K603"):
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
        return f"reached by, nearest first: {listed}{f' and {more} more' if more > 0 else ''}"


class ConfigurationChangesOnLine(Violation, code="K606"):
    target: str
    stored: str
    arrives: str


class PathNotReachable(Violation, code="K604"):
    target: str
    percent: float
    distance_mm: float
    why: str


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


class OrientationDeviates(Violation, code="K613"):
    target: str
    switch: str
    angle_deg: float
    where: str
