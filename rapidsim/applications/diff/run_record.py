"""Parts of a run that are compared, read from the object of `rapidsim run --format json`.

The object may come from a file, also of another version.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from rapidsim.controller.journal.events import EventKind
from rapidsim.files import InputError
from rapidsim.json_records.reading import WrongValueError, read_partially
from rapidsim.report.run.json_report import RunReport
from rapidsim.report.run.records import MoveRecord, WaitRecord
from rapidsim.simulation.results.event_values import EventRecord
from rapidsim.simulation.results.simulation import End
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class RunStep:
    """A move or a wait."""

    task: str
    routine: str
    text: str
    """The instruction, and its target or condition."""
    start_s: float
    end_s: float

    @property
    def seconds(self) -> float:
        """Duration [s]."""
        return self.end_s - self.start_s

    @property
    def key(self) -> tuple[str, str, str]:
        """Name of the step, in the form in which RAPID compares names."""
        return self.task.lower(), self.routine.lower(), self.text.lower()


@value_class(frozen=True, slots=True)
class SignalChange:
    """A signal that a task has set."""

    signal: str
    time_s: float
    value: float


@value_class(frozen=True, slots=True)
class RunRecord:
    """The compared parts of a run."""

    time_s: float
    end: End
    robot: str
    motion_model: str
    """"" in runs of version 0.1."""
    steps: tuple[RunStep, ...]
    """Moves and waits in order of time."""
    signals: tuple[SignalChange, ...]
    findings: tuple[tuple[str, str, str], ...]
    """Severity, code and message."""


@value_class(frozen=True, slots=True)
class _SignalDetails:
    """Details of an event of a signal."""

    signal: str
    value: float


_OUTSIDE = "cell"
"""Task of events that no program causes."""


def read_run_record(report: object, name: str) -> RunRecord:
    """Return the record of a run.

    Args:
        report: The object, which another version may have written.
        name: Name of its file, for messages.

    Raises:
        InputError: If it is not the object of a run.
    """
    try:
        return _record(read_partially(RunReport, report))
    except WrongValueError as error:
        raise InputError(
            f"{name} is not a saved run: {error}", "`rapidsim run --format json` prints one"
        ) from None


def _record(report: RunReport) -> RunRecord:
    moves = [_step(one, _short(one.to or "")) for one in report.moves]
    waits = [_step(one, one.awaited) for one in report.waits]
    return RunRecord(
        time_s=report.time_s,
        end=report.end,
        robot=report.robot,
        motion_model=report.models.motion or "",
        steps=tuple(sorted((*moves, *waits), key=lambda step: step.start_s)),
        signals=tuple(_signal_changes(report.events)),
        findings=tuple((one.severity.value, one.code, one.message) for one in report.diagnostics),
    )


def _signal_changes(events: Sequence[EventRecord]) -> Iterator[SignalChange]:
    for number, event in enumerate(events):
        if event.kind == EventKind.SIGNAL and event.task != _OUTSIDE:
            path = ((None, "events"), number)
            found = read_partially(_SignalDetails, event.details, path)
            yield SignalChange(found.signal, event.time_s, found.value)


def _step(step: MoveRecord | WaitRecord, to: str) -> RunStep:
    text = f"{step.instruction} {to}"
    return RunStep(step.task, step.routine, text, step.start_s, step.end_s)


def _short(target: str) -> str:
    return "*" if not target or target.startswith("[") else target
