"""Program text during a run: a window of lines with the two pointers of the controller.

The program pointer runs ahead of the robot; the motion pointer is at the active move. The window
scrolls only when a pointer would leave it, so that the text does not jump at every line.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np
import rerun as rr

from rapidsim.controller.journal.events import ExecutedLine
from rapidsim.controller.journal.executed_lines import times_of
from rapidsim.controller.moves.executed_moves import ExecutedMoves
from rapidsim.diagnostics import Source
from rapidsim.frames.transform import Array
from rapidsim.recording.samples import RecordedRobot
from rapidsim.values import value_class

ENTITY = "program/text"

WINDOW = 18
"""Number of lines in the window."""
_MARGIN = 3
"""Number of lines kept above and below the pointer."""
MOST_TEXTS = 5000
"""Maximum number of logged texts; in a long run their instants are evenly spread."""
_WIDTH = 78
"""Characters per line; longer ones would wrap and push the pointer out of sight."""

PROGRAM_POINTER = "▶"
MOTION_POINTER = "●"


@value_class(frozen=True, slots=True, eq=False)
class _Pointers:
    """Positions of the pointers from an instant on; lines are counted from 1."""

    time_s: float
    source: Source
    program_line: int | None
    motion_line: int | None


def log_listing(stream: rr.RecordingStream, run: RecordedRobot) -> tuple[str, ...]:
    """Log the program text, once for each time a pointer moves.

    Returns:
        Remarks on content that the viewer cannot show correctly, one per line.
    """
    lines, moves = run.robot_run.lines, run.robot_run.moves
    times = np.concatenate([[0.0], times_of(lines), moves.columns.start_s])
    instants = np.unique(times)
    remarks: tuple[str, ...] = ()
    if len(instants) > MOST_TEXTS:
        apart_s = run.sampled.end_s / MOST_TEXTS
        instants = np.array(list(_thin_out(instants, apart_s)))
        remarks = (f"the pointers in the program text are shown every {apart_s:.3g} s only",)
    rows = list(_texts(_pointers(instants.tolist(), lines, moves)))
    if rows:
        stream.send_columns(
            run.entity(ENTITY),
            indexes=run.clock.columns([time_s for time_s, _ in rows]),
            columns=rr.TextDocument.columns(
                text=[text for _, text in rows],
                media_type=[rr.MediaType.MARKDOWN] * len(rows),
            ),
        )
    return remarks


def _thin_out(instants: Array, spacing_s: float) -> Iterator[float]:
    """Yield some of increasing instants (k,) that are some time apart."""
    at = 0
    while at < len(instants):
        time_s = float(instants[at])
        yield time_s
        at += int(np.searchsorted(instants[at:], time_s + spacing_s))


def _pointers(
    instants: Sequence[float], lines: Sequence[ExecutedLine], moves: ExecutedMoves
) -> Iterator[_Pointers]:
    """Yield both pointers at instants [s], in order."""
    line_times, move_times = times_of(lines), moves.columns.start_s
    for time_s in instants:
        # Before the first statement the pointer waits at it.
        line = lines[max(int(line_times.searchsorted(time_s, "right")) - 1, 0)] if lines else None
        begun = int(move_times.searchsorted(time_s, "right")) - 1
        move = moves[begun] if begun >= 0 else None
        # The text follows the robot during motion, else the program.
        under_way = move if move is not None and time_s < move.end_s else None
        place = under_way.place if under_way else line.place if line else None
        if place is None:
            continue
        source = place.span.source
        in_sight = line is not None and line.place.span.source is source
        yield _Pointers(
            time_s,
            source,
            line.place.span.line if line is not None and in_sight else None,
            under_way.place.span.line if under_way else None,
        )


def _texts(states: Iterable[_Pointers]) -> Iterator[tuple[float, str]]:
    """Yield the text of the window at each change."""
    shown: str | None = None
    source: Source | None = None
    top = 1
    for state in states:
        line = state.motion_line or state.program_line or 1
        if state.source is not source:
            source, top = state.source, 1
        top = _scrolled(top, line, len(state.source.line_starts))
        text = _window(state, top)
        if text != shown:
            shown = text
            yield state.time_s, text


def _scrolled(top: int, line: int, count: int) -> int:
    """Return the first line of the window that has `line` well inside it."""
    if not top + _MARGIN <= line < top + WINDOW - _MARGIN:
        top = line - WINDOW // 3
    return max(1, min(top, count - WINDOW + 1))


def _window(state: _Pointers, top: int) -> str:
    """Return Markdown with the lines and their pointers."""
    source = state.source
    last = min(top + WINDOW - 1, len(source.line_starts))
    rows = []
    for number in range(top, last + 1):
        program = PROGRAM_POINTER if number == state.program_line else " "
        motion = MOTION_POINTER if number == state.motion_line else " "
        text = source.line(number).expandtabs(2).replace("```", "'''")
        if len(text) > _WIDTH:
            text = text[: _WIDTH - 1] + "…"
        rows.append(f"{program}{motion}{number:>4} {text}".rstrip())
    # A fence keeps blanks and needs no escapes.
    return f"```\n{chr(10).join(rows)}\n```"
