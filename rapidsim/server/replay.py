"""Replay of a journal: the same requests at the same virtual times, without clients or a clock."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import zip_longest
from pathlib import Path
from typing import Final

from rapidsim.files import InputError, require_regular
from rapidsim.interpreter.limits import RUNNING_DEPTH, recursion_limit
from rapidsim.server.engine import Engine, LockStep
from rapidsim.server.journal import RecordedSession, read_journal
from rapidsim.server.loading import ReadyController
from rapidsim.server.sensors import RecordingSensors, ReplayedSensors
from rapidsim.server.versions import served_versions
from rapidsim.server.wire import RecordingWire, ReplayedWire
from rapidsim.simulation.live.controller import LiveController
from rapidsim.simulation.progress import RunInProgress
from rapidsim.simulation.result_builder import FinishedRun
from rapidsim.simulation.results.simulation import End

_SHOWN: Final = 160
"""Largest number of characters shown of a line."""


def replay_journal(path: Path) -> RecordedSession:
    """Read a journal to replay.

    Raises:
        InputError: If the file does not exist or is not a journal.
    """
    try:
        require_regular(path)
        with path.open(encoding="utf-8", newline="\n") as file:
            return read_journal(file, str(path))
    except OSError as error:
        raise InputError(f"--replay: {path}: {error.strerror or error}") from None
    except UnicodeDecodeError:
        raise InputError(f"--replay: {path} is no journal") from None


def replayed(
    ready: ReadyController,
    session: RecordedSession,
    on_line: Callable[[str], None],
    watch: Callable[[RunInProgress], None] | None = None,
) -> FinishedRun:
    """Replay a journal on a controller.

    Args:
        ready: The controller's programs and cell.
        session: The journal.
        on_line: Called with a line about the first difference from the journal, which another
            program or other files in the home folder cause.
        watch: Receives the run before it begins.

    Raises:
        InputError: If an arm cannot be timed, or no task moves one.
    """
    began = session.began
    live = LiveController(
        ready.setups,
        ready.options,
        motors=began.motors,
        mode=began.mode,
        wire=RecordingWire(ReplayedWire(session.refusals)),
        sensors=RecordingSensors(ReplayedSensors(session.answers)),
        keeps_all=True,
    )
    if watch is not None:
        watch(RunInProgress(live.cell, lambda: [task.run for task in live.tasks.values()]))
    lines: list[str] = []
    # Time advances only on the commands below.
    versions = served_versions(ready.robotware, began.robotware)
    engine = Engine(live, LockStep(0.0), lambda told: None, lines.append, versions)
    limit_s = ready.options.max_time_s
    with recursion_limit(RUNNING_DEPTH):
        for one in session.recorded:
            if one.time_s > limit_s:
                break
            live.advance(one.time_s)
            engine.reply(one.message)
        live.advance(min(session.end_s, limit_s))
        engine.switch_off()
    if session.end_s <= limit_s:
        _report_difference(session.lines, lines, on_line)
        return live.finished()
    on_line(f"note: --max-time ended it {session.end_s - limit_s:.3f} s before the journal ends")
    finished = live.finished()
    return replace(finished, simulation=replace(finished.simulation, end=End.TIME_LIMIT))


def _report_difference(
    recorded: tuple[str, ...], lived: list[str], on_line: Callable[[str], None]
) -> None:
    for number, (then, now) in enumerate(zip_longest(recorded, lived, fillvalue=""), start=1):
        # A controller that was killed has no last line.
        if then != now and then:
            on_line(f"note: the run departs from line {number} of the journal: {_cut(then)}")
            on_line(f"note: it continues as follows: {_cut(now)}" if now else "note: it ends there")
            return


def _cut(line: str) -> str:
    line = line.strip()
    return line if len(line) <= _SHOWN else f"{line[:_SHOWN]}..."
