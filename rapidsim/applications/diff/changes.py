"""Results of a comparison: changes of the program, of times, of outputs, of findings."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from rapidsim.diagnostics import Severity
from rapidsim.json_records.declarations import Key, OutputRecord
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class SourcePosition:
    """A position in a file."""

    file: str
    line: int


Literal: TypeAlias = bool | float | str


@value_class(frozen=True, slots=True)
class ComponentChange:
    """A component of a value that differs."""

    component: str
    """Name, such as `trans.x`; the parameter of an argument; "" for a value as a whole."""
    old: Literal | None
    """None if the component is new."""
    new: Literal | None
    """None if the component was removed."""
    unit: str = ""


@value_class(frozen=True, slots=True)
class ProgramChange:
    """One change of the program, in the terms of a robot programmer."""

    kind: str
    """`target`, `tool`, `work object`, `speed`, `zone`, `signal`, `data`, `statement`, `routine`,
    `type` or `module`."""
    name: str
    """Name of the data or the routine; of an argument, its current text."""
    message: str
    routine: str | None = None
    """Routine of a changed statement; None for other changes."""
    old: SourcePosition | None = None
    """None if the item is new."""
    new: SourcePosition | None = None
    """None if the item was removed."""
    values: tuple[ComponentChange, ...] = ()
    """Values before and after."""


@value_class(frozen=True, slots=True)
class ConfigurationChange:
    """One change of system parameters, options or a station file."""

    source: str
    """The domain, such as `EIO`; `BACKINFO` or `station`."""
    type: str
    """The type of the instance, such as `EIO_SIGNAL`."""
    name: str
    """The name of the instance, or the path of the table."""
    key: str
    """The attribute; "" for a whole instance."""
    old: str | None
    """None if the attribute is new."""
    new: str | None
    """None if the attribute was removed."""
    unit: str = ""
    note: str = ""
    """Distance between both values, if the values do not show it."""


@value_class(frozen=True, slots=True)
class TimeChange:
    """A line or routine whose time changed."""

    task: str
    routine: str
    what: str
    """The instruction and its target or condition; empty for a whole routine."""
    before_s: float | None
    """None if it was not executed before."""
    after_s: float | None
    """None if it is no longer executed."""

    @property
    def delta_s(self) -> float:
        """Increase of its time."""
        return (self.after_s or 0.0) - (self.before_s or 0.0)


@value_class(frozen=True, slots=True)
class OutputChange:
    """A change of the times or values of a signal."""

    signal: str
    message: str


@value_class(frozen=True, slots=True)
class FindingChange:
    """A new or removed finding."""

    is_new: bool
    code: str
    severity: Annotated[str, Severity]
    message: str
    routine: str | None
    at: SourcePosition | None


@value_class(frozen=True, slots=True)
class RunChange:
    """Differences between two runs."""

    before_s: float
    after_s: float
    ends: tuple[str, str]
    """Ends of the runs."""
    errors: tuple[str | None, str | None] = (None, None)
    """Code and message of the errors that stopped the runs; null for other ends."""
    robots: tuple[str, str] = ("", "")
    """Arms of the runs."""
    motion_models: tuple[str, str] = ("", "")
    """Versions of the motion model; empty if a saved run names none."""
    routines: tuple[TimeChange, ...] = ()
    lines: tuple[TimeChange, ...] = ()
    outputs: tuple[OutputChange, ...] = ()
    """Signals whose times or values changed."""

    @property
    def other_model(self) -> str:
        """Note that times differ because the motion models do; "" otherwise."""
        before, after = (model or "1" for model in self.motion_models)
        if before == after:
            return ""
        return f"times of motion model {before} are compared with those of {after}"

    @property
    def is_same(self) -> bool:
        """Whether the runs are equal except for rounding."""
        return (
            not (self.routines or self.lines or self.outputs)
            and self.ends[0] == self.ends[1]
            and self.robots[0] == self.robots[1]
        )


@value_class(frozen=True, slots=True)
class Comparison:
    """All differences between two sides."""

    names: tuple[str, str]
    changes: tuple[ProgramChange, ...]
    findings: tuple[FindingChange, ...]
    run: RunChange | None
    """Differences of the runs; None if a side has no run, or no run was requested."""
    no_run_reason: str | None = None
    paths: tuple[tuple[tuple[float, ...], ...], tuple[tuple[float, ...], ...]] = ((), ())
    """Paths of the TCP of both sides [mm], for a picture; empty if nothing was run."""
    configuration: tuple[ConfigurationChange, ...] = ()
    not_compared: tuple[str, ...] = ()
    """Notes on parts that only one side has."""
    recordings_differ: bool = False
    """Whether the sides are recordings of different content."""

    @property
    def is_same(self) -> bool:
        """Whether there is no difference."""
        runs_alike = self.run is None or self.run.is_same
        changes = self.changes or self.findings or self.configuration or self.recordings_differ
        return not changes and runs_alike


@value_class(frozen=True, slots=True)
class ComparisonReport(OutputRecord):
    """The object that `rapidsim diff --format json` prints."""

    names: tuple[str, str]
    """A and B, as the user named them."""
    same: bool
    """Whether there is no difference: the exit code is 0, else 1."""
    configuration: tuple[ConfigurationChange, ...]
    """Changes of system parameters, options and station files."""
    not_compared: tuple[str, ...]
    """Notes on parts that only one side has."""
    changes: tuple[ProgramChange, ...]
    findings: tuple[FindingChange, ...]
    """New and removed findings."""
    run: RunChange | None
    """Null if a side has no run, or no run was requested."""
    no_run_reason: Annotated[str | None, Key("why_no_run")]
