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
from typing import Annotated

from rapidsim.controller.cell.description import (
    FIRST_ROBOT,
    GROUP_WIDTH,
    CrossConnection,
    SignalDeclaration,
    SignalKind,
    Status,
)
from rapidsim.json_records.declarations import AboveZero, Level, OneOf, noun, whole_number
from rapidsim.station.declared_tables import read_records, values_of
from rapidsim.station.toml_reader import Reader, Table
from rapidsim.values import value_class

_NO_KIND = f"unknown signal type `{{}}`; expected {', '.join(SignalKind)}"
_LIMIT_KEYS = ("width", "min", "max")
_LIMIT_KEYS_OF_KIND = {
    SignalKind.GI: ("width",),
    SignalKind.GO: ("width",),
    SignalKind.AI: ("min", "max"),
    SignalKind.AO: ("min", "max"),
}


@value_class(frozen=True, slots=True)
class SignalTable:
    """A signal of the table [signals]."""

    type: Annotated[SignalKind | None, OneOf(_NO_KIND)] = None
    value: Level | None = None
    """Its initial value."""
    width: Annotated[AboveZero | None, whole_number(1, GROUP_WIDTH)] = None
    """Number of bits of a group."""
    min: float | None = None
    """Lowest logical value of an analog signal."""
    max: float | None = None
    """Highest logical value of an analog signal."""
    system: Annotated[Status | None, noun("a known status")] = None
    """The controller state that a system output shows."""
    task: str | None = None
    """The task whose state it shows; None for any."""
    unit: str | None = None
    """The mechanical unit whose state it shows; None for the first robot."""


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
    signal = SignalTable(**values_of(reader, SignalTable, table, path))
    kind = signal.type or (backup.kind if backup and not table.get("type") else None)
    if kind is None:
        if "type" not in table:
            reader.wrong(f"{path}.type", _NO_KIND.format(""))
        return None
    if backup is not None and backup.kind is not kind:
        backup = None
    lowest, highest = _limits(reader, path, kind, signal, backup)
    for key in _LIMIT_KEYS:
        if key in table and key not in _LIMIT_KEYS_OF_KIND.get(kind, ()):
            reader.wrong(f"{path}.{key}", f"a {kind.value} has no such key")
    value = signal.value
    if value is None:
        value = 0.0 if backup is None or "value" in table else backup.value
    if not (lowest is None or value >= lowest) or not (highest is None or value <= highest):
        reader.wrong(f"{path}.value", f"{value:g} is outside its limits {lowest} .. {highest}")
    status = signal.system or (backup.status if backup and "system" not in table else None)
    if status is None and "system" not in table:
        for key in ("task", "unit"):
            if key in table:
                reader.wrong(f"{path}.{key}", 'it needs `system`, as in system = "TaskExecuting"')
    if status is None:
        return SignalDeclaration(name, kind, value, lowest, highest)
    task = signal.task or (backup.task if backup else None)
    unit = signal.unit or (backup.unit if backup else FIRST_ROBOT)
    return SignalDeclaration(name, kind, status.at_start, lowest, highest, status, task, unit)


def _limits(
    reader: Reader,
    path: str,
    kind: SignalKind,
    signal: SignalTable,
    backup: SignalDeclaration | None,
) -> tuple[float | None, float | None]:
    """Return the lowest and highest value of a signal; analog ones may have no limits."""
    known = (None, None) if backup is None else (backup.lowest, backup.highest)
    if kind in (SignalKind.GI, SignalKind.GO):
        if backup is not None and signal.width is None:
            return known
        return 0.0, 2.0 ** (signal.width or GROUP_WIDTH) - 1.0
    if kind not in (SignalKind.AI, SignalKind.AO):
        return 0.0, 1.0
    lowest = known[0] if signal.min is None else signal.min
    highest = known[1] if signal.max is None else signal.max
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
