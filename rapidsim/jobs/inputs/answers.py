"""Operator's answers that are defined before the run."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from rapidsim.files import decode, input_bytes

if TYPE_CHECKING:
    from rapidsim.controller.cell.inputs import Answers


def answers_in_order(lines: Iterable[str]) -> Answers:
    """Return answers in the order of the questions; after the last one, there are no answers."""
    waiting = iter(tuple(lines))
    return lambda _: next(waiting, None)


def answers_of_file(file: str) -> Answers:
    """Read answers from a file, one per line; empty lines and lines starting with `#` are skipped.

    Raises:
        InputError: If the file cannot be read.
    """
    text, _ = decode(input_bytes(Path(file)))
    lines = (line.strip() for line in text.splitlines())
    return answers_in_order(line for line in lines if line and not line.startswith("#"))
