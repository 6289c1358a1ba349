"""One JSON object on standard output, whatever happens: for commands with `--format json`."""

from __future__ import annotations

import io
import json
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from itertools import zip_longest

from rapidsim.cli.terminal import echo
from rapidsim.json_records.declarations import OutputRecord
from rapidsim.values import value_class

_OPTIONS = ("--format", "--output-format")
_FORMAT = "json"


def is_json_requested(arguments: Sequence[str]) -> bool:
    """Whether a command line requests JSON; read from its words, as it may be invalid."""
    wants = False
    for word, following in zip_longest(arguments, arguments[1:], fillvalue=""):
        name, equals, value = word.partition("=")
        if word == "--":
            break
        if name in _OPTIONS:
            wants = (value if equals else following).lower() == _FORMAT
    return wants


@value_class(frozen=True, slots=True)
class CommandError:
    """An error of use, or the reason why a command was broken off."""

    message: str
    help: str
    """A remedy; empty if none is known."""
    similar: tuple[str, ...]
    """Known names near an unknown one."""


@value_class(frozen=True, slots=True)
class ErrorReport(OutputRecord):
    """The object of a command that cannot do its work."""

    error: CommandError
    """Reason of the failure; next to other keys, a failure after these were known."""


@value_class(frozen=True, slots=True)
class TextReport(OutputRecord):
    """The object of a command that prints a text."""

    text: str
    """With --help or --version: their text."""


def print_object(value: dict[str, object]) -> None:
    """Print one object on standard output."""
    echo(json.dumps(value, indent=2, allow_nan=False))


class _Aside(io.StringIO):
    """Text printed in addition to an object: it goes to standard error and is collected."""

    def write(self, text: str) -> int:
        sys.stderr.write(text)
        return super().write(text)

    def isatty(self) -> bool:
        return sys.stderr.isatty()


@contextmanager
def output_to_stderr() -> Iterator[io.StringIO]:
    """Let everything that is printed in here go to standard error; yields what was printed."""
    aside = _Aside()
    with redirect_stdout(aside):
        yield aside
