"""The results of a comparison: changes of the program, of times, of outputs, of findings."""

from __future__ import annotations

from typing import TypeAlias

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
    """Such as `trans.x`; the parameter of an argument; "" for a value as a whole."""
    old: Literal | None
    """None where it is new."""
    new: Literal | None
    """None where it is gone."""
    unit: str = ""


@value_class(frozen=True, slots=True)
class ProgramChange:
    """One change of the program, as a robot programmer sees it."""

    kind: str
    """`target`, `tool`, `work object`, `speed`, `zone`, `signal`, `data`, `statement`, `routine`,
    `type` or `module`."""
    name: str
    """Of the data or the routine; of an argument, as the program writes it now."""
    message: str
    routine: str | None = None
    """Where it is used, if it is a statement."""
    old: SourcePosition | None = None
    """None where it is new."""
    new: SourcePosition | None = None
    """None where it is gone."""
    values: tuple[ComponentChange, ...] = ()
    """The values before and after."""


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
    """None where it is new."""
    new: str | None
    """None where it is gone."""
    unit: str = ""
    note: str = ""
    """The distance between both, where the values do not show it."""


@value_class(frozen=True, slots=True)
class TimeChange:
    """A line or routine whose time changed."""

    task: str
    routine: str
    what: str
    """The instruction and what it moves to or waits for; empty for a whole routine."""
    before_s: float | None
    """None where it was not run."""
    after_s: float | None
    """None where it is not run."""

    @property
    def delta_s(self) -> float:
        """By how much its time grew."""
        return (self.after_s or 0.0) - (self.before_s or 0.0)


@value_class(frozen=True, slots=True)
class OutputChange:
    """A change in when or how a signal is set."""

    signal: str
    message: str


@value_class(frozen=True, slots=True)
class FindingChange:
    """A finding that is new or gone."""

    is_new: bool
    code: str
    severity: str
    message: str
    routine: str | None
    at: SourcePosition | None


@value_class(frozen=True, slots=True)
class RunChange:
    """The differences between two runs."""

    before_s: float
    after_s: float
    ends: tuple[str, str]
    """How they ended."""
    routines: tuple[TimeChange, ...] = ()
    lines: tuple[TimeChange, ...] = ()
    outputs: tuple[OutputChange, ...] = ()
    motion_models: tuple[str, str] = ("", "")
    """Versions of the motion model; "" where nothing names it."""
    robots: tuple[str, str] = ("", "")
    """The arms."""
    errors: tuple[str | None, str | None] = (None, None)
    """What stopped them, where an error did."""

    @property
    def other_model(self) -> str:
        """The note that times differ because the motion models do; "" otherwise."""
        before, after = (model or "1" for model in self.motion_models)
        if before == after:
            return ""
        return f"times of motion model {before} stand against those of {after}"

    @property
    def is_same(self) -> bool:
        """Whether the runs are the same except for rounding."""
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
    """None where one side does not run, or nobody asked."""
    no_run_reason: str | None = None
    paths: tuple[tuple[tuple[float, ...], ...], tuple[tuple[float, ...], ...]] = ((), ())
    """The TCP of both sides over time [mm], for a picture; empty where nothing ran."""
    configuration: tuple[ConfigurationChange, ...] = ()
    not_compared: tuple[str, ...] = ()
    """What only one side has, in words."""

    @property
    def is_same(self) -> bool:
        """Whether nothing differs."""
        runs_alike = self.run is None or self.run.is_same
        return not (self.changes or self.findings or self.configuration) and runs_alike
