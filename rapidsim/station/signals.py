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

from rapidsim.controller.cell.description import (
    FIRST_ROBOT,
    GROUP_WIDTH,
    CrossConnection,
    SignalDeclaration,
    SignalKind,
    Status,
)
from rapidsim.station.declared_tables import read_when
from rapidsim.station.toml_reader import Reader, Table, is_number

_KEYS = ("type", "value", "width", "min", "max", "system", "task", "unit")
_CROSS_KEYS = ("set", "from", "after")
_KINDS = ", ".join(kind.value for kind in SignalKind)


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
    crosses = []
    for path, table in reader.tables(tables, "cross"):
        reader.note_unknown_keys(path, table, _CROSS_KEYS)
        result = reader.text(table, path, "set")
        condition = read_when(reader, table, path, "from")
        if result is None or condition is None:
            reader.wrong(path, 'both are needed: set = "doLamp", from = "doRun and not diFault"')
            continue
        after_s = reader.not_negative(table, path, "after")
        crosses.append(CrossConnection(result, condition, after_s or 0.0))
    for number, cross in enumerate(crosses):
        if follows_itself(cross, crosses):
            reader.wrong(f"cross {number + 1}", f"`{cross.result}` depends on itself")
    results = {cross.result.lower() for cross in crosses}
    return (*(cross for cross in defaults if cross.result.lower() not in results), *crosses)


def _signal(
    reader: Reader, path: str, name: str, table: Table, backup: SignalDeclaration | None
) -> SignalDeclaration | None:
    reader.note_unknown_keys(path, table, _KEYS)
    text = reader.text(table, path, "type") or ("" if backup is None else backup.kind.value)
    if text.lower() not in list(SignalKind):
        reader.wrong(f"{path}.type", f"unknown signal type `{text}`; expected {_KINDS}")
        return None
    kind = SignalKind(text.lower())
    if backup is not None and backup.kind is not kind:
        backup = None
    lowest, highest = _limits(reader, path, kind, table, backup)
    start = table.get("value", 0.0 if backup is None else backup.value)
    value = float(start) if is_number(start) or isinstance(start, bool) else None
    if value is None:
        reader.wrong(f"{path}.value", "a number is needed")
    elif not (lowest is None or value >= lowest) or not (highest is None or value <= highest):
        reader.wrong(f"{path}.value", f"{value:g} is outside its limits {lowest} .. {highest}")
    status = _status(reader, path, table, backup)
    task = reader.text(table, path, "task") or (backup.task if backup else None)
    unit = reader.text(table, path, "unit") or (backup.unit if backup else FIRST_ROBOT)
    if status is None:
        return SignalDeclaration(name, kind, value or 0.0, lowest, highest)
    return SignalDeclaration(name, kind, status.at_start, lowest, highest, status, task, unit)


def _status(
    reader: Reader, path: str, table: Table, backup: SignalDeclaration | None
) -> Status | None:
    """Read the status that a system output shows; None for other signals."""
    text = reader.text(table, path, "system")
    if text is None and backup is not None and backup.status is not None:
        return backup.status
    if text is None:
        for key in ("task", "unit"):
            if key in table:
                reader.wrong(f"{path}.{key}", 'it needs `system`, as in system = "TaskExecuting"')
        return None
    for status in Status:
        if status.lower() == text.lower():
            return status
    reader.wrong(f"{path}.system", f"`{text}` is not a known status", f"known: {', '.join(Status)}")
    return None


def _limits(
    reader: Reader,
    path: str,
    kind: SignalKind,
    table: Table,
    backup: SignalDeclaration | None,
) -> tuple[float | None, float | None]:
    """Return the lowest and highest value of a signal; analog ones may have no limits."""
    allowed: tuple[str, ...] = ()
    limits: tuple[float | None, float | None] = (0.0, 1.0)
    known = (None, None) if backup is None else (backup.lowest, backup.highest)
    if kind in (SignalKind.GI, SignalKind.GO):
        allowed = ("width",)
        width = reader.positive(table, path, "width") or float(GROUP_WIDTH)
        if width != int(width) or width > GROUP_WIDTH:
            reader.wrong(f"{path}.width", f"a whole number from 1 to {GROUP_WIDTH} is needed")
            width = float(GROUP_WIDTH)
        limits = (0.0, 2.0**width - 1.0)
        if backup is not None and "width" not in table:
            limits = known
    elif kind in (SignalKind.AI, SignalKind.AO):
        allowed = ("min", "max")
        lowest, highest = (reader.number(table, path, key) for key in ("min", "max"))
        limits = (
            known[0] if "min" not in table else lowest,
            known[1] if "max" not in table else highest,
        )
        if limits[0] is not None and limits[1] is not None and limits[0] >= limits[1]:
            reader.wrong(f"{path}.min", f"{limits[0]:g} is not below max, {limits[1]:g}")
    for key in ("width", "min", "max"):
        if key in table and key not in allowed:
            reader.wrong(f"{path}.{key}", f"a {kind.value} has no such key")
    return limits


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
