"""Appearance of the output, from options, environment and terminal."""

from __future__ import annotations

import codecs
import os
import shutil
import sys
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

import click

from rapidsim import __version__
from rapidsim.report.findings.source_frame import printable_lines
from rapidsim.report.palette import COLOURED, PLAIN, Palette

if TYPE_CHECKING:
    from rich.console import Console, RenderableType

_LEAST_COLUMNS = 40
_MOST_COLUMNS = 120
_PIPED_COLUMNS = 80

PLAIN_CHARACTERS = "rapidsim.plain"
"""Fallback for characters that a code page lacks: a similar sign, or the number."""
_LIKE = {
    "\N{BOX DRAWINGS LIGHT HORIZONTAL}": "-",
    "\N{DEGREE SIGN}": " deg",
    "\N{HORIZONTAL ELLIPSIS}": "~",
}

Command = TypeVar("Command", bound=Callable[..., Any])

table_or_json = click.option(
    "--format",
    "output_format",
    type=click.Choice(["table", "json"]),
    default="table",
    show_default=True,
    help="Output format.",
)
"""The option of commands that print a table for people or an object for programs."""


@dataclass(slots=True)
class Terminal:
    """Settings by the options of every command."""

    quiet: bool = False
    verbose: bool = False
    no_color: bool = False
    report: dict[str, object] | None = None
    """Object to be printed as JSON when the command has ended."""

    @property
    def coloured(self) -> bool:
        """Whether standard output supports colours and they are not disabled."""
        return (
            not self.no_color
            and not os.environ.get("NO_COLOR")
            and os.environ.get("TERM") != "dumb"
            and sys.stdout.isatty()
        )

    @property
    def palette(self) -> Palette:
        """Colours for findings."""
        return COLOURED if self.coloured else PLAIN

    @property
    def width(self) -> int:
        """Columns to fill: the terminal's, but not more than a person likes to read across."""
        fallback = (_PIPED_COLUMNS, 24)
        columns = shutil.get_terminal_size(fallback).columns
        return max(_LEAST_COLUMNS, min(columns, _MOST_COLUMNS))

    @property
    def headline_width(self) -> int | None:
        """Columns after which messages are broken; None in a file or a pipe: a line each."""
        return self.width if sys.stdout.isatty() else None

    def console(self) -> Console:
        """A rich console on standard output with the same colours and width."""
        from rich.console import Console

        return Console(
            width=self.width,
            color_system="standard" if self.coloured else None,
            force_terminal=self.coloured,
            highlight=False,
            emoji=False,
            markup=False,
        )

    def show(self, renderable: RenderableType, *, soft_wrap: bool = False) -> None:
        """Print something of rich's on standard output, without the spaces it fills lines with."""
        from rich.segment import Segment, Segments

        console = self.console()
        options = console.options
        if soft_wrap:
            options = options.update(no_wrap=True, overflow="ignore")
        # Before rich adds colours, so that the text has no others.
        plain = [
            Segment(printable_lines(text), style, control)
            for text, style, control in console.render(renderable, options)
        ]
        with console.capture() as captured:
            console.print(Segments(plain), crop=False, soft_wrap=True)
        # Not click's echo, which writes UTF-8 although the environment declares ASCII.
        sys.stdout.writelines(f"{line.rstrip()}\n" for line in captured.get().splitlines())


def echo(text: str, *, palette: Palette = PLAIN, nl: bool = True, err: bool = False) -> None:
    """Print a text. All terminal output passes here or through `Terminal.show`.

    Names of files and texts of programs may hold what moves its cursor, changes its colours or its
    title, or turns the direction of writing. None of that is let through.

    Args:
        text: One line or more.
        palette: The colours that the text may contain.
        nl: Whether its last line is ended.
        err: Whether it goes to standard error.
    """
    click.echo(palette.map_plain_text(printable_lines, text), nl=nl, err=err)


def print_result(text: str) -> None:
    """Print a text that another program reads, as it is; on a terminal as `echo` does."""
    if sys.stdout.isatty():
        echo(text, nl=False)
    else:
        click.echo(text.encode(), nl=False)


def print_json(report: dict[str, object]) -> None:
    """Print one object when the command ends; the boundary adds what goes wrong until then."""
    current_terminal().report = report


def terminal_options(command: Command) -> Command:
    """Add the options of every command; the command itself does not receive them."""
    # The help page lists decorators from the last applied to the first.
    for option in (
        click.help_option("-h", "--help"),
        click.version_option(__version__, message="rapidsim %(version)s"),
        click.option("--no-color", **_setting("no_color"), help="No colours, like NO_COLOR."),
        click.option("-v", "--verbose", **_setting("verbose"), help="Verbose output."),
        click.option("-q", "--quiet", **_setting("quiet"), help="Print only problems."),
    ):
        command = option(command)
    return command


def current_terminal() -> Terminal:
    """The terminal of the command that runs."""
    terminal = click.get_current_context().find_object(Terminal)
    assert terminal is not None
    return terminal


def _setting(name: str) -> dict[str, Any]:
    """A flag stored in the terminal, at any position of the command line."""

    def note(context: click.Context, _: click.Parameter, is_set: bool) -> None:
        terminal = context.find_object(Terminal)
        if is_set and terminal is not None:
            setattr(terminal, name, True)

    return {"is_flag": True, "expose_value": False, "callback": note}


def _plain(error: UnicodeError) -> tuple[str, int]:
    """Replacement of characters that a code page lacks, and the position after them."""
    assert isinstance(error, UnicodeEncodeError)
    lacking = error.object[error.start : error.end]
    return "".join(_LIKE.get(one) or _number_of(one) for one in lacking), error.end


def _number_of(character: str) -> str:
    return character.encode("ascii", "backslashreplace").decode()


codecs.register_error(PLAIN_CHARACTERS, _plain)
