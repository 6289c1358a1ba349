"""The group of commands; each is imported when it is used.

The core's commands are listed here. Those that it does without are entry points, so that nothing
in the core refers to them, and other packages may add their own.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache
from importlib import import_module
from types import MappingProxyType
from typing import TYPE_CHECKING, cast

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import echo, terminal_options
from rapidsim.files import InputError, did_you_mean
from rapidsim.syntax.garbage_collection import gc_paused

if TYPE_CHECKING:
    from importlib.metadata import EntryPoint

# In the order of the help page, which is written from here: it must not import every command.
# `rapidsim.cli.commands.<name>` holds the command of that name.
_CORE: Mapping[str, str] = MappingProxyType(
    {
        "run": "Run a program and report what happens.",
        "serve": "Serve a controller to clients of Robot Web Services.",
        "view": "Open a recording.",
        "check": "Check a program for mistakes.",
        "fmt": "Lay out RAPID: indentation, reserved words, white space.",
        "explain": "Explain a rule, with an example and a fix.",
        "init": "Write a first station file for a program, a folder or a backup.",
        "robots": "List the robots, or show one.",
        "frames": "Show the frames of a program: tools, work objects, targets.",
        "sweep": "Try a program with the robot in many places.",
    }
)
_ENTRY_POINTS = "rapidsim.commands"
"""Group of entry points of the other commands, in `rapidsim.applications` and other packages.

They are read only if a name is not one of the core's, for reading them takes as long as a small
check.
"""


class _Commands(click.Group):
    def list_commands(self, ctx: click.Context) -> list[str]:
        return [*_CORE, *_applications()]

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        with gc_paused():
            if cmd_name in _CORE:
                module = import_module(f"rapidsim.cli.commands.{cmd_name}")
                return cast(click.Command, getattr(module, cmd_name))
            found = _applications().get(cmd_name)
            return None if found is None else cast(click.Command, found.load())

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        name = args[0]
        if name not in _CORE and name not in _applications():
            names = self.list_commands(ctx)
            raise InputError(
                f"there is no command `{name}`",
                did_you_mean(name, names) or f"there are {', '.join(names)}",
            )
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl([*_CORE.items(), *self._application_rows(ctx)])

    def _application_rows(self, ctx: click.Context) -> Iterator[tuple[str, str]]:
        for name in _applications():
            command = self.get_command(ctx, name)
            if command is not None:
                yield name, command.short_help or command.get_short_help_str()


@cache
def _applications() -> Mapping[str, EntryPoint]:
    """Entry points of commands, by name."""
    from importlib.metadata import entry_points

    return {entry.name: entry for entry in entry_points(group=_ENTRY_POINTS)}


@click.command(cls=_Commands, invoke_without_command=True)
@terminal_options
@click.pass_context
def commands(context: click.Context) -> int | None:
    """Run and check RAPID programs of ABB robots, without a robot."""
    if context.invoked_subcommand is None:
        echo(context.get_help())
        return ExitCode.USAGE
    return None
