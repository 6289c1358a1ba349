"""The tables [[stimulus]]: changes of inputs from outside the program. A gripper that fails once:

[[stimulus]]
when = "doGrip = 1"
after = 0.4
set = { diGripped = 1 }
pulse = 2.0
skip = [2]
"""

from __future__ import annotations

from rapidsim.controller.cell.description import Stimulus
from rapidsim.station.declared_tables import as_record, values_of
from rapidsim.station.toml_reader import Reader, Table


def read_stimuli(reader: Reader, tables: Table) -> tuple[Stimulus, ...]:
    """Read the list; errors are collected in the reader."""
    stimuli = []
    for path, table in reader.tables(tables, "stimulus"):
        found = values_of(reader, Stimulus, table, path)
        note_wrong_times(reader, table, path, may_be_now=False)
        every_s, pulse_s = found.get("every_s"), found.get("pulse_s")
        if every_s is not None and pulse_s is not None and pulse_s >= every_s:
            reader.wrong(f"{path}.pulse", f"{pulse_s:g} s is not shorter than every, {every_s:g} s")
        stimuli.append(as_record(Stimulus, found))
    return tuple(stimulus for stimulus in stimuli if stimulus is not None)


def note_wrong_times(reader: Reader, table: Table, path: str, *, may_be_now: bool) -> None:
    """Record the wrong combinations of the keys that say when something happens."""
    if "when" in table and ("at" in table or "every" in table):
        reader.wrong(path, "`when` waits for signals, `at` and `every` for the clock; give one")
    elif not may_be_now and not {"when", "at", "every"} & set(table):
        reader.wrong(path, "give `at`, `every` or `when`")
    for key in {"nth", "skip"} & set(table):
        if not {"when", "every"} & set(table):
            reader.wrong(f"{path}.{key}", "it counts how often `when` is met, or `every`")
