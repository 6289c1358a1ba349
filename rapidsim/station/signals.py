"""The tables [signals] and [[cross]]: the I/O configuration.

[signals]
diStart = { type = "di", value = 1 }
goProgram = { type = "go", width = 8 }
aoFlow = { type = "ao", min = 0, max = 10 }
doRuns = { type = "do", system = "TaskExecuting", task = "T_ROB1" }
[[cross]]
set = "doLamp"
from = "doRun and not diFault"
after = 0.4
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, Any

from rapidsim.controller.cell.description import (
    FIRST_ROBOT,
    GROUP_WIDTH,
    CrossConnection,
    SignalDeclaration,
    SignalKind,
    Status,
    SystemAction,
)
from rapidsim.json_records.declarations import AboveZero, Level, Needs, OneOf, noun, whole_number
from rapidsim.station.declared_tables import read_records, values_of
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class

_NO_KIND = f"unknown signal type `{{}}`; expected {', '.join(SignalKind)}"
_OF_GROUP, _OF_ANALOG = ("width",), ("min", "max")
_LIMIT_KEYS = {
    SignalKind.GI: _OF_GROUP,
    SignalKind.GO: _OF_GROUP,
    SignalKind.AI: _OF_ANALOG,
    SignalKind.AO: _OF_ANALOG,
}
_NO_SYSTEM = Needs("system", 'it needs `system`, as in system = "TaskExecuting"')


@value_class(frozen=True, slots=True)
class SignalEntry:
    """A signal of the table [signals]."""

    type: Annotated[SignalKind | None, OneOf(_NO_KIND)] = None
    """Digital, group or analog; input or output. Required without a backup."""
    value: Level = 0.0
    """Its initial value."""
    width: Annotated[AboveZero, whole_number(1, GROUP_WIDTH)] = GROUP_WIDTH
    """Number of bits of a group."""
    min: float | None = None
    """Lowest logical value of an analog signal."""
    max: float | None = None
    """Highest logical value of an analog signal."""
    system: Annotated[Status | None, noun("a known status")] = None
    """The controller state that a system output shows."""
    task: Annotated[str | None, _NO_SYSTEM] = None
    """The task whose state it shows; None for any."""
    unit: Annotated[str, _NO_SYSTEM] = FIRST_ROBOT
    """The mechanical unit whose state it shows."""
    action: Annotated[SystemAction | None, noun("a known action")] = None
    """The action of the controller that a system input, a `di`, causes when it becomes 1."""


def read_signals(
    reader: Reader, signals: Table, defaults: Sequence[SignalDeclaration] = ()
) -> tuple[SignalDeclaration, ...]:
    """Read the table; errors are collected in the reader.

    Args:
        reader: Reads the file.
        signals: The table.
        defaults: The signals of a backup: signals not in the table remain, and a key that a signal
            of the table lacks has the backup's value. Signals of the table are last.
    """
    backup = {signal.name.lower(): signal for signal in defaults}
    declared: dict[str, SignalDeclaration] = {}
    for name, value in signals.items():
        path = f"signals.{name}"
        if not isinstance(value, dict):
            reader.wrong(path, 'a table is needed, as in { type = "di", value = 0 }')
            continue
        signal = _signal(reader, path, name, value, backup.get(name.lower()))
        if signal is None:
            continue
        if name.lower() in declared:
            reader.wrong(path, f"`{declared[name.lower()].name}` is declared already")
        declared[name.lower()] = signal
    kept = (signal for name, signal in backup.items() if name not in declared)
    return (*kept, *declared.values())


def read_crosses(
    reader: Reader, tables: Table, defaults: Sequence[CrossConnection] = ()
) -> tuple[CrossConnection, ...]:
    """Read the list; errors, also circular connections, are collected in the reader.

    Connections of a backup are first, except for the signals that the list connects.
    """
    crosses = read_records(reader, tables, "cross", CrossConnection)
    for number, cross in enumerate(crosses):
        if follows_itself(cross, crosses):
            reader.wrong(f"cross {number + 1}", f"`{cross.result}` depends on itself")
    results = {cross.result.lower() for cross in crosses}
    return (*(cross for cross in defaults if cross.result.lower() not in results), *crosses)


def _signal(
    reader: Reader, path: str, name: str, table: Table, backup: SignalDeclaration | None
) -> SignalDeclaration | None:
    text = str(table.get("type") or "").lower()
    defaults = _entry_of(backup) if backup and text in ("", backup.kind) else {}
    signal = SignalEntry(**values_of(reader, SignalEntry, table, path, defaults=defaults))
    if signal.type is None:
        if "type" not in table:
            reader.wrong(f"{path}.type", _NO_KIND.format(""))
        return None
    for key in ("width", "min", "max"):
        if key in table and key not in _LIMIT_KEYS.get(signal.type, ()):
            reader.wrong(f"{path}.{key}", f"a {signal.type.value} has no such key")
    lowest, highest = _limits(reader, path, signal)
    value = signal.value
    if not (lowest is None or value >= lowest) or not (highest is None or value <= highest):
        reader.wrong(f"{path}.value", f"{value:g} is outside its limits {lowest} .. {highest}")
    status = signal.system
    if signal.action is not None and signal.type is not SignalKind.DI:
        reader.wrong(f"{path}.action", f"a {signal.type.value} causes no action; a di does")
    if status is None:
        cycle = backup.cycle if backup and backup.action is signal.action else ""
        return SignalDeclaration(
            name, signal.type, value, lowest, highest, action=signal.action, cycle=cycle
        )
    start = status.at_start
    return SignalDeclaration(
        name, signal.type, start, lowest, highest, status, signal.task, signal.unit
    )


def _entry_of(signal: SignalDeclaration) -> dict[str, Any]:
    """Return the fields of the entry of a signal."""
    fields = {
        "type": signal.kind,
        "value": signal.value,
        "width": signal.width,
        "min": signal.lowest,
        "max": signal.highest,
        "system": signal.status,
        "task": signal.task,
        "unit": signal.unit,
        "action": signal.action,
    }
    return {name: value for name, value in fields.items() if value is not None}


def _limits(reader: Reader, path: str, signal: SignalEntry) -> tuple[float | None, float | None]:
    """Return the lowest and highest value of a signal; analog ones may have no limits."""
    keys = None if signal.type is None else _LIMIT_KEYS.get(signal.type)
    if keys == _OF_GROUP:
        return 0.0, 2.0**signal.width - 1.0
    if keys != _OF_ANALOG:
        return 0.0, 1.0
    lowest, highest = signal.min, signal.max
    if lowest is not None and highest is not None and lowest >= highest:
        reader.wrong(f"{path}.min", f"{lowest:g} is not below max, {highest:g}")
    return lowest, highest


def follows_itself(cross: CrossConnection, crosses: Sequence[CrossConnection]) -> bool:
    """Whether a signal depends on itself through connections."""
    return cross.result.lower() in _sources(cross.result.lower(), crosses)


def _sources(signal: str, crosses: Sequence[CrossConnection]) -> set[str]:
    """Return the folded names of all signals that a signal depends on, directly or not."""
    found: set[str] = set()
    open_names = [signal]
    while open_names:
        name = open_names.pop()
        for cross in crosses:
            if cross.result.lower() == name:
                new = {one.lower() for one in cross.condition.signals()} - found
                found |= new
                open_names += sorted(new)
    return found
