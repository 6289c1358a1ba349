"""Where the time of a run goes: its moves added up by routine and by line."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.report.run.figures import end_point


@dataclass(frozen=True, slots=True)
class Share:
    """The moves of one routine or line."""

    name: str
    text: str
    """What the line moves to; empty for a routine."""
    seconds: float
    length_mm: float
    times: int
    task: str
    moves: tuple[int, ...]
    """Their numbers."""


def by_routine(moves: Iterable[ExecutedMove]) -> tuple[Share, ...]:
    """The time in the moves of each routine, the longest first."""
    return _added_up(moves, lambda move: (move.task, _file(move), move.place.routine), _routine)


def by_line(moves: Iterable[ExecutedMove]) -> tuple[Share, ...]:
    """The time in the moves of each line, the longest first."""
    return _added_up(moves, lambda move: (move.task, _file(move), move.place.span.start), _line)


def _added_up(
    moves: Iterable[ExecutedMove],
    key_of: Callable[[ExecutedMove], tuple[object, ...]],
    words: Callable[[ExecutedMove], tuple[str, str]],
) -> tuple[Share, ...]:
    groups: dict[tuple[object, ...], list[ExecutedMove]] = {}
    for move in moves:
        groups.setdefault(key_of(move), []).append(move)
    shares = [
        Share(
            *words(group[0]),
            seconds=sum(move.end_s - move.start_s for move in group),
            length_mm=1000.0 * sum(move.length_m for move in group),
            times=len(group),
            task=group[0].task,
            moves=tuple(move.index for move in group),
        )
        for group in groups.values()
    ]
    return tuple(sorted(shares, key=lambda share: -share.seconds))


def _routine(move: ExecutedMove) -> tuple[str, str]:
    return move.place.routine, ""


def _line(move: ExecutedMove) -> tuple[str, str]:
    place = f"{Path(_file(move)).name}:{move.place.span.line}"
    return place, f"{move.move.instruction} {end_point(move)}"


def _file(move: ExecutedMove) -> str:
    return move.place.span.file
