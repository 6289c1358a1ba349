"""Verdict of a run: the only module that decides whether it succeeded, and its wording."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from enum import StrEnum
from pathlib import Path

from rapidsim.analysis.names.name_violations import AssumedData
from rapidsim.analysis.names.signal_violations import UnknownSignal
from rapidsim.diagnostics import Severity
from rapidsim.findings.collisions import NotJudged
from rapidsim.findings.reach_and_motion_data import (
    ConfigurationChangesOnLine,
    ConfigurationNotReachable,
)
from rapidsim.language.controller import ACCEPTED, STUB
from rapidsim.language.error_answers import ErrorOutcome, answer_words, shown_name
from rapidsim.simulation.results.simulation import End, Simulation
from rapidsim.station.task_kind import TaskKind
from rapidsim.values import value_class

_NAMED = 3
"""Most routines that a qualification names."""


class Level(StrEnum):
    """Severity of a verdict: the colour of the headline."""

    CLEAN = "clean"
    QUALIFIED = "qualified"
    FAILED = "failed"


class Failure(StrEnum):
    """Kind of failure, from which a command derives its exit code."""

    PROGRAM = "program"
    """The program or a robot stopped with an error, bodies collided, or a strict run is
    qualified."""
    LIMIT = "limit"
    """A limit of time ended the run."""
    ASSERTION = "assertion"
    """The run has ended, but an assertion or the cycle budget does not hold."""


@value_class(frozen=True, slots=True)
class Verdict:
    """Judgement of one run. Immutable."""

    failure: Failure | None
    """None if the run succeeded."""
    headline: str
    """End of the run with its qualifications, in one line."""
    level: Level
    qualifications: tuple[str, ...] = ()
    """Reservations about the result, short phrases in the order of `_QUALIFIERS`."""

    @property
    def ok(self) -> bool:
        """Whether the run succeeded."""
        return self.failure is None


def _skipped_calls(simulation: Simulation) -> Iterator[str]:
    skipped = simulation.skipped
    if skipped:
        count, names = sum(one.count for one in skipped), len(skipped)
        yield (
            f"{count} call{'s' * (count != 1)} of "
            f"{names} unknown routine{'s' * (names != 1)} skipped"
        )


def _calls_not_simulated(simulation: Simulation) -> Iterator[str]:
    done_otherwise = [
        one
        for one in simulation.unsimulated
        if not (one.is_unknown or one.treated_as == STUB or one.treated_as.startswith(ACCEPTED))
    ]
    match done_otherwise:
        case []:
            return
        case [one] if one.name.isidentifier():
            yield f"{one.count} call{'s' * (one.count != 1)} of {one.name} not simulated"
        case [*first, last] if len(done_otherwise) <= _NAMED:
            names = ", ".join(one.name for one in first)
            yield f"not simulated: {names}{' and ' * bool(first)}{last.name}"
        case [*several]:
            names = ", ".join(one.name for one in several[: _NAMED - 1])
            yield f"not simulated: {names} and {len(several) - _NAMED + 1} more"


def _assumed_names(simulation: Simulation) -> Iterator[str]:
    for kind, words in ((AssumedData, "name"), (UnknownSignal, "signal")):
        violations = (found.violation for found in simulation.diagnostics)
        assumed = {one.assumed_name.lower() for one in violations if isinstance(one, kind)}
        if assumed:
            yield f"{len(assumed)} undeclared {words}{'s' * (len(assumed) != 1)} assumed"


def _unjudged_bodies(simulation: Simulation) -> Iterator[str]:
    """Yield the number of bodies and moves that were not checked for contacts."""
    count = sum(isinstance(found.violation, NotJudged) for found in simulation.diagnostics)
    if count:
        yield f"{count} part{'s' * (count != 1)} of the cell not checked for collisions"


Qualifier = Callable[[Simulation], Iterator[str]]


def _early_ends(simulation: Simulation) -> Iterator[str]:
    """Errors at which the ERROR clause of main ended the program."""
    if simulation.end not in (End.ENDED, End.CYCLE_LIMIT):
        return
    normal = (task for task in simulation.tasks if task.kind is TaskKind.NORMAL)
    entries = {task.name: task.entry.lower() for task in normal}
    for tally in simulation.errors:
        error, clause = tally.error, tally.error.clause
        returned = error.outcome in (ErrorOutcome.RETURNED, ErrorOutcome.FELL_THROUGH)
        if returned and clause and clause.routine.lower() == entries.get(tally.task):
            times = f" {tally.count} times" if tally.count > 1 else ""
            span = error.raised.span
            place = f"{Path(span.file).name}:{span.line}"
            yield f"ended early{times}: {shown_name(error)} at {place} {answer_words(error)}"


def _other_configurations(simulation: Simulation) -> Iterator[str]:
    """Targets that a run reached in another configuration than the stored one."""
    targets = sum(
        isinstance(found.violation, ConfigurationNotReachable | ConfigurationChangesOnLine)
        and found.severity is Severity.WARNING
        for found in simulation.diagnostics
    )
    if targets:
        yield f"{targets} target{'s' if targets > 1 else ''} not in the stored configuration"


_QUALIFIERS: tuple[Qualifier, ...] = (
    _early_ends,
    _skipped_calls,
    _calls_not_simulated,
    _assumed_names,
    _other_configurations,
)
"""Functions that yield the qualifications of a run, in their order in headlines."""
_STRICT_QUALIFIERS: tuple[Qualifier, ...] = (_unjudged_bodies,)
"""Further qualifications, of strict runs only: elsewhere the warnings suffice."""
_WORDS = {
    End.ENDED: "ended as programmed",
    End.STOPPED: "stopped by the program",
    End.CYCLE_LIMIT: "ended after the requested cycles",
    End.TIME_LIMIT: "cut off",
    End.ERROR: "stopped with an error",
}
_QUALIFIED_END = "ended"
"""Replaces "ended as programmed" if the run is qualified."""


def run_verdict(
    simulation: Simulation, *, assertions_fail: bool = False, reservations: Sequence[str] = ()
) -> Verdict:
    """Return the verdict of a run.

    Args:
        simulation: The run; `Simulation.strict` decides whether qualifications fail it.
        assertions_fail: Whether an assertion or the cycle budget does not hold.
        reservations: Further qualifications.
    """
    qualifiers = (*_QUALIFIERS, *(_STRICT_QUALIFIERS if simulation.strict else ()))
    phrases = (phrase for qualify in qualifiers for phrase in qualify(simulation))
    qualifications = (*phrases, *reservations)
    failure = _failure(simulation, qualified=bool(qualifications), assertions_fail=assertions_fail)
    if failure in (Failure.PROGRAM, Failure.ASSERTION) or _has_cell_errors(simulation):
        level = Level.FAILED
    else:
        # A run that reached a limit is incomplete, not wrong.
        level = Level.QUALIFIED if failure or qualifications else Level.CLEAN
    return Verdict(failure, _headline(simulation, qualifications), level, qualifications)


def _failure(simulation: Simulation, *, qualified: bool, assertions_fail: bool) -> Failure | None:
    if simulation.end is End.ERROR:
        return Failure.PROGRAM
    if simulation.end is End.TIME_LIMIT:
        return Failure.LIMIT
    if _has_cell_errors(simulation) or (qualified and simulation.strict):
        return Failure.PROGRAM
    return Failure.ASSERTION if assertions_fail else None


def _assumed_stop(simulation: Simulation) -> str | None:
    """Position of the move that ended a run if all its errors rest on assumptions; else None."""
    if any(found.severity is Severity.ERROR for found in simulation.diagnostics):
        return None
    for found in reversed(simulation.diagnostics):
        if found.assumed and found.span and found.violation.rule.severity is Severity.ERROR:
            return f"{Path(found.span.file).name}:{found.span.line}"
    return None


def _headline(simulation: Simulation, qualifications: tuple[str, ...]) -> str:
    words = _WORDS[simulation.end]
    if simulation.end is End.ERROR and (place := _assumed_stop(simulation)):
        words = f"stopped at {place}, which the arm or frame assumed here does not allow,"
    if qualifications and simulation.end is End.ENDED:
        words = _QUALIFIED_END
    text = f"{words} after {simulation.time_s:.3f} s"
    if (cell := simulation.collisions) is not None:
        counts = (("collision", len(cell.crashes)), ("part error", len(cell.part_errors)))
        said = [f"{count} {name}{'s' if count > 1 else ''}" for name, count in counts if count]
        text += f", with {' and '.join(said)}" if said else ""
    return "; ".join((text, *qualifications))


def _has_cell_errors(simulation: Simulation) -> bool:
    """Whether bodies of the cell touch, or a part is not where the program takes or puts it."""
    cell = simulation.collisions
    return cell is not None and bool(cell.crashes or cell.part_errors)
