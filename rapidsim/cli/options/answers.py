"""Sources of answers to operator dialogs: a file, the terminal, or none."""

from __future__ import annotations

import sys

import click

from rapidsim.controller.cell.inputs import Answers
from rapidsim.jobs.inputs.answers import answers_of_file
from rapidsim.report.findings.source_frame import printable_lines


def answers_from(file: str | None) -> Answers | None:
    """Answers from a file, else from the terminal; none without a terminal.

    Raises:
        InputError: If the file cannot be read.
    """
    if file is not None:
        return answers_of_file(file)
    return _prompt_operator if sys.stdin.isatty() and sys.stderr.isatty() else None


def _prompt_operator(prompt: str) -> str | None:
    answer = click.prompt(printable_lines(prompt), default="", show_default=False, err=True)
    return str(answer) or None
