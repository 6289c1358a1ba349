"""Findings that only a run can make (family R)."""

from __future__ import annotations

from rapidsim.diagnostics import Diagnostic, Violation

FAMILY_OF_RUNS = "R"


def is_of_runs(finding: Diagnostic) -> bool:
    """Whether a finding belongs to this family."""
    return finding.code.startswith(FAMILY_OF_RUNS)


class UncaughtError(Violation, code="R101"):
    subject: str
    event: str | None = None
    """The controller's event for the error."""

    @property
    def cf(self) -> str | None:
        """The controller's event for the error instead of the rule's."""
        return self.event


class QuestionUnanswered(Violation, code="R102"):
    prompt: str
    default: str


class AnswerNotANumber(Violation, code="R103"):
    prompt: str
    answer: str
    default: str


class AnswerNotAChoice(Violation, code="R105"):
    prompt: str
    answer: str
    default: str


class EndlessWait(Violation, code="R106"):
    subject: str
    suggestion: str | None = None

    @property
    def help(self) -> str | None:
        """Suggestion of an event that ends the wait, normally an input."""
        return self.suggestion or super().help


class NotDeclaredHere(Violation, code="R140"):
    subject: str


class RoutineNotSimulated(Violation, code="R104"):
    routine: str
    treated_as: str


class AcceptedWithoutEffect(Violation, code="R119"):
    routine: str
    treated_as: str


class ProgramStopped(Violation, code="R107"):
    instruction: str


class ConveyorNotConnected(Violation, code="R131"):
    conveyor: str


class BackwardNotExecuted(Violation, code="R108"):
    routine: str


class MessageDiscarded(Violation, code="R120"):
    queue: str
    data_type: str


class CutOff(Violation, code="R109"):
    subject: str


class TrapStorms(Violation, code="R110"):
    subject: str


class WorldZoneReached(Violation, code="R111"):
    subject: str


class OutputBeforeTarget(Violation, code="R117"):
    signal: str
    distance_mm: float
    target: str
    times: str
    """Number of occurrences for the message; empty for one."""


class MoveWithoutStorePath(Violation, code="R130"):
    instruction: str


class RampWaits(Violation, code="R113"):
    wanted: float
    achieved: float


class BeltNotFollowed(Violation, code="R132"):
    conveyor: str
    time_s: float
    reason: str


class NobodyGuides(Violation, code="R150"):
    device: str


class CornerTooFast(Violation, code="R116"):
    load: float
    limit: str
    """The exceeded limit, such as `torque of axis 2`."""
    other_text: str
    """Number of other such corners, for the message; empty for none."""


class CornerSpeedUncertain(Violation, code="R118"):
    limit: str
    """The limit that is reached in the corner, such as `torque of axis 2`."""
    difference: str
    """Difference of a controller's speed and time."""
    other_text: str
    """Number of other such corners, for the message; empty for none."""


class NobodyAnswers(Violation, code="R112"):
    place: str


class NobodyConnects(Violation, code="R115"):
    port: int
