"""The files that `rapidsim run` writes: refused before a long run rather than after it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from rapidsim.files import InputError
from rapidsim.report.summary import Written
from rapidsim.simulation.result import Simulation

TRACE_STEP_S = 0.012


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


def _new_file(name: str, suffixes: tuple[str, ...]) -> Path:
    path = Path(name)
    if path.suffix.lower() not in suffixes:
        raise InputError(f"{path} must end in {' or '.join(suffixes)}")
    if not path.parent.is_dir():
        raise InputError(f"{path} cannot be written: {path.parent} is no folder")
    if path.is_dir():
        raise InputError(f"{path} cannot be written: it is a folder")
    return path
