"""The files that `rapidsim run` writes: refused before a long run rather than after it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from rapidsim.files import InputError, SourceFile
from rapidsim.report.summary import Written
from rapidsim.simulation.result import Simulation

TRACE_STEP_S = 0.012
VALUES = "values of persistents"
"""What was written into files of the program."""


@dataclass(frozen=True, slots=True)
class Outputs:
    """Files to write; None is not written."""

    recording: Path | None
    trace: Path | None
    trace_step_s: float
    events: Path | None


def new_recording(name: str) -> Path:
    """The place of a recording.

    Raises:
        InputError: If nothing of that kind can be written there.
    """
    return _new_file(name, (".rrd",))


def new_trace(name: str) -> Path:
    """The place of a trace, refused like a recording's."""
    return _new_file(name, (".csv", ".parquet", ".json"))


def new_events(name: str) -> Path:
    """The place of an event log, refused like a recording's."""
    return _new_file(name, (".jsonl",))


def new_profile(name: str) -> Path:
    """The place of a profile of the interpreter, refused like a recording's."""
    return _new_file(name, (".prof",))


def write(simulation: Simulation, outputs: Outputs) -> tuple[Written, ...]:
    """Write the files asked for. What writes them imports rerun and more, so only then."""
    written = []
    if outputs.recording:
        from rapidsim.recording.write import record

        record(simulation, outputs.recording)
        written.append(Written(outputs.recording, "recording"))
    if outputs.trace:
        from rapidsim.export.trace import write_trace

        write_trace(simulation, outputs.trace, outputs.trace_step_s)
        written.append(Written(outputs.trace, "trace"))
    if outputs.events:
        from rapidsim.export.events import write_events

        write_events(simulation, outputs.events)
        written.append(Written(outputs.events, "events"))
    return tuple(written)


def write_values(simulation: Simulation, files: Iterable[SourceFile]) -> tuple[Written, ...]:
    """Write what persistents hold into the program's files.

    Raises:
        InputError: If one of them cannot be written; then none is.
    """
    from rapidsim.export.persistents import write_persistents

    written = write_persistents(simulation.persistents, files)
    return tuple(Written(path, VALUES) for path in written)


def _new_file(name: str, suffixes: tuple[str, ...]) -> Path:
    path = Path(name)
    if path.suffix.lower() not in suffixes:
        raise InputError(f"{path} must end in {' or '.join(suffixes)}")
    if not path.parent.is_dir():
        raise InputError(f"{path} cannot be written: {path.parent} is no folder")
    if path.is_dir():
        raise InputError(f"{path} cannot be written: it is a folder")
    return path
