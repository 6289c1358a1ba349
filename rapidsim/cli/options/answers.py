"""Who answers what a program asks its operator: a file, the person at the terminal, or nobody."""

from __future__ import annotations

import sys
from pathlib import Path

import click

from rapidsim.controller.cell.inputs import Answers
from rapidsim.files import decode, input_bytes
from rapidsim.report.findings.source_frame import printable_lines


def answers_from(file: str | None) -> Answers | None:
    """Answers from a file, one a line in the order of the questions; else from the terminal.

    Empty lines and lines that begin with `#` in the file are left out. Without a file and without
    a terminal nobody answers.

    Raises:
        InputError: If the file cannot be read.
    """
    if file is not None:
        text, _ = decode(input_bytes(Path(file)))
        lines = (line.strip() for line in text.splitlines())
        waiting = iter([line for line in lines if line and not line.startswith("#")])
        return lambda _: next(waiting, None)
    return _ask if sys.stdin.isatty() and sys.stderr.isatty() else None


def _ask(prompt: str) -> str | None:
    answer = click.prompt(printable_lines(prompt), default="", show_default=False, err=True)
    return str(answer) or None
