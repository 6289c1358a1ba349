"""Time of a run by the comments of its program, with which people and generators head sections."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import chain

from rapidsim.controller.journal.events import Wait
from rapidsim.controller.moves.executed_moves import ExecutedMoves
from rapidsim.diagnostics import Source
from rapidsim.simulation.results.time_shares import Step
from rapidsim.values import value_class

_ROUTINE = re.compile(r"\s*(?:(?:LOCAL|TASK)\s+)?(?:PROC|FUNC|TRAP)\b", re.IGNORECASE)
_COMMENT = re.compile(r"\s*!\s*(?P<words>.*?)\s*$")
_SUPPRESSION = re.compile(r"rapidsim\s*:", re.IGNORECASE)
_BORDER = re.compile(r"^\W+|\W+$")
_LONGEST = 60


@value_class(frozen=True, slots=True)
class Region:
    """Statements after a comment on its own lines."""

    task: str
    file: str
    line: int
    """Line of the comment."""
    routine: str
    comment: str
    steps: int
    """Number of moves and waits that were executed."""
    seconds: float


def by_comment(moves: ExecutedMoves, waits: Sequence[Wait]) -> tuple[Region, ...]:
    """Time after each comment of a routine, the longest first; empty without comments."""
    found: dict[tuple[str, str, int], Region] = {}
    texts = (*moves.columns.sources, *(wait.place.span.source for wait in waits))
    sources = {source.file: source for source in reversed(texts)}
    heads = {file: _heads(source) for file, source in sources.items()}
    if not any(any(of_file) for of_file in heads.values()):
        return ()
    for step in chain[Step](moves, waits):
        span = step.place.span
        head = heads[span.file][span.line - 1] if span.line <= len(heads[span.file]) else None
        if head is None:
            continue
        key = (step.task, span.file, head[0])
        known = found.get(key)
        count, seconds = (known.steps, known.seconds) if known else (0, 0.0)
        found[key] = Region(
            *(step.task, span.file, head[0], step.place.routine, head[1]),
            steps=count + 1,
            seconds=seconds + step.end_s - step.start_s,
        )
    return tuple(sorted(found.values(), key=lambda one: -one.seconds))


def _heads(source: Source) -> list[tuple[int, str] | None]:
    """Return, for each line, the first comment line of the block that heads it, and its words."""
    lines = (source.line(number + 1) for number in range(len(source.line_starts)))
    found: list[tuple[int, str] | None] = []
    head: tuple[int, str] | None = None
    in_block = False
    for number, line in enumerate(lines, start=1):
        comment = _COMMENT.match(line)
        words = "" if comment is None else _BORDER.sub("", comment["words"])
        if _ROUTINE.match(line):
            head = None
        elif words and not in_block and not _SUPPRESSION.match(words):
            head = (number, words[:_LONGEST])
        in_block = comment is not None and (in_block or bool(words))
        found.append(head)
    return found
