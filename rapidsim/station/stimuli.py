"""The tables [[stimulus]]: changes of inputs from outside the program. A gripper is five lines:

[[stimulus]]
when = "doGrip = 1"
after = 0.4
set = { diGripped = 1 }
pulse = 2.0
"""

from __future__ import annotations

from rapidsim.controller.cell.description import Stimulus
from rapidsim.station.declared_tables import read_when
from rapidsim.station.toml_reader import Reader, Table, is_number

_KEYS = ("at", "every", "when", "after", "set", "pulse")
_LEAST_PERIOD_S = 0.001


def read_stimuli(reader: Reader, tables: Table) -> tuple[Stimulus, ...]:
    """Read the list; errors are collected in the reader."""
    stimuli = []
    for path, table in reader.tables(tables, "stimulus"):
        reader.note_unknown_keys(path, table, _KEYS)
        at_s = reader.not_negative(table, path, "at")
        every_s = reader.positive(table, path, "every")
        when = read_when(reader, table, path, "when")
        after_s = reader.not_negative(table, path, "after")
        pulse_s = reader.positive(table, path, "pulse")
        if "when" in table and ("at" in table or "every" in table):
            reader.wrong(path, "`when` waits for signals, `at` and `every` for the clock; give one")
        elif not {"when", "at", "every"} & set(table):
            reader.wrong(path, "give `at`, `every` or `when`")
        if after_s is not None and "when" not in table:
            reader.wrong(f"{path}.after", "it needs `when`; with the clock, use `at`")
        if every_s is not None and every_s < _LEAST_PERIOD_S:
            reader.wrong(f"{path}.every", f"at least {_LEAST_PERIOD_S:g} s is needed")
        if every_s is not None and pulse_s is not None and pulse_s >= every_s:
            reader.wrong(f"{path}.pulse", f"{pulse_s:g} s is not shorter than every, {every_s:g} s")
        values = _values(reader, path, table)
        stimuli.append(Stimulus(values, at_s, every_s, when, after_s or 0.0, pulse_s))
    return tuple(stimuli)


def _values(reader: Reader, path: str, table: Table) -> dict[str, float]:
    values = reader.table(table, "set", f"{path}.set")
    if not values:
        reader.wrong(f"{path}.set", "name signals and their values, as in { diReady = 1 }")
    found = {}
    for name, value in values.items():
        if is_number(value) or isinstance(value, bool):
            found[name] = float(value)
        else:
            reader.wrong(f"{path}.set.{name}", "a number is needed")
    return found
