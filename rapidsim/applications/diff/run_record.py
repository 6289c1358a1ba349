"""Parts of a run that are compared, read from the object of `rapidsim run --format json`.

The object may come from a file: this module, and no other, checks every value.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from rapidsim.files import InputError
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


_OUTSIDE = "cell"
"""Task of events that no program causes."""
_NEEDED = object()


def read_run_record(report: object, name: str) -> RunRecord:
    """Return the record of a run.

    Args:
        report: The object.
        name: Name of its file, for messages.

    Raises:
        InputError: If it is not the object of a run.
    """
    try:
        return _record(_Object(report, "it"))
    except _WrongValueError as error:
        raise InputError(
            f"{name} is not a saved run: {error}", "`rapidsim run --format json` prints one"
        ) from None


class _WrongValueError(ValueError):
    """A value that is invalid in the object of a run; the message describes it."""


class _Object:
    """Typed access to the values of a JSON object."""

    def __init__(self, value: object, path: str) -> None:
        if not isinstance(value, Mapping):
            raise _WrongValueError(f"{path} is not an object")
        self._values: Mapping[str, object] = value
        self._path = path

    def text(self, key: str, default: object = _NEEDED) -> str:
        """Return a string."""
        value = self._value(key, default)
        if not isinstance(value, str):
            raise _WrongValueError(f"{self._at(key)} is not text")
        return value

    def number(self, key: str) -> float:
        """Return a finite number."""
        value = self._value(key, _NEEDED)
        if not isinstance(value, int | float):
            raise _WrongValueError(f"{self._at(key)} is not a number")
        try:
            number = float(value)
        except OverflowError:
            number = math.inf
        if not math.isfinite(number):
            raise _WrongValueError(f"{self._at(key)} is not a finite number")
        return number

    def objects(self, key: str, default: object = _NEEDED) -> list[_Object]:
        """Return a list of objects."""
        values = self._value(key, default)
        if not isinstance(values, list | tuple):
            raise _WrongValueError(f"{self._at(key)} is not a list")
        return [_Object(one, f"{self._at(key)}[{n}]") for n, one in enumerate(values)]

    def child(self, key: str) -> _Object:
        """Return an object; empty if it is missing or null."""
        return _Object(self._value(key, None) or {}, self._at(key))

    def _value(self, key: str, default: object) -> object:
        value = self._values.get(key)
        if value is None and default is _NEEDED:
            raise _WrongValueError(f"{self._at(key)} is missing")
        return default if value is None else value

    def _at(self, key: str) -> str:
        return key if self._path == "it" else f"{self._path}.{key}"


def _record(report: _Object) -> RunRecord:
    end = report.text("end")
    if end not in [one.value for one in End]:
        raise _WrongValueError(f"end is `{end}`, which no run has")
    moves = [_step(one, _short(one.text("to", ""))) for one in report.objects("moves")]
    waits = [_step(one, one.text("for")) for one in report.objects("waits", ())]
    changes = (
        SignalChange(one.text("signal"), one.number("time_s"), one.number("value"))
        for one in report.objects("events")
        if one.text("kind") == "signal" and one.text("task", "") != _OUTSIDE
    )
    findings = report.objects("diagnostics", ())
    return RunRecord(
        time_s=report.number("time_s"),
        end=End(end),
        robot=report.text("robot", ""),
        motion_model=report.child("models").text("motion", ""),
        steps=tuple(sorted((*moves, *waits), key=lambda step: step.start_s)),
        signals=tuple(changes),
        findings=tuple(
            (one.text("severity"), one.text("code"), one.text("message")) for one in findings
        ),
    )


def _step(step: _Object, to: str) -> RunStep:
    return RunStep(
        step.text("task"),
        step.text("routine", ""),
        f"{step.text('instruction')} {to}",
        step.number("start_s"),
        step.number("end_s"),
    )


def _short(target: str) -> str:
    return "*" if not target or target.startswith("[") else target
