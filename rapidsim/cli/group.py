"""The group of commands; each is imported when it is used."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from types import MappingProxyType
from typing import cast

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import echo, terminal_options
from rapidsim.files import InputError, did_you_mean
from rapidsim.syntax.garbage_collection import gc_paused

# In the order of the help page, which is written from here: it must not import every command.
# `rapidsim.cli.commands.<name>` holds the command of that name.
_COMMANDS: Mapping[str, str] = MappingProxyType(
    {
        "run": "Run a program and report what happens.",
        "serve": "Serve a controller to clients of Robot Web Services.",
        "view": "Open a recording.",
        "check": "Check a program for mistakes.",
        "fmt": "Lay out RAPID: indentation, reserved words, white space.",
        "diff": "Show what changed between two programs or runs.",
        "lsp": "Serve an editor, on standard input and output.",
        "dap": "Debug from an editor, on standard input and output.",
        "mcp": "Serve tools to agents that write RAPID.",
        "explain": "Explain a rule, with an example and a fix.",
        "init": "Write a first station file for a program, a folder or a backup.",
        "robots": "List the robots, or show one.",
        "frames": "Show the frames of a program: tools, work objects, targets.",
        "calibrate": "Fit the motion model to logs of a real controller.",
        "kin": "Forward and inverse kinematics and Jacobian of one pose.",
        "follow": "Follow points of a table in lines, splines or joint polynomials.",
        "points": "Print random points, for follow.",
        "sweep": "Try a program with the robot in many places.",
        "protocol": "Ask a controller twenty questions, and compare.",
    }
)


class _Commands(click.Group):
    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(_COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in _COMMANDS:
            return None
        with gc_paused():
            module = import_module(f"rapidsim.cli.commands.{cmd_name}")
        return cast(click.Command, getattr(module, cmd_name))

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        name = args[0]
        if name not in _COMMANDS:
            help = did_you_mean(name, _COMMANDS) or f"there are {', '.join(_COMMANDS)}"
            raise InputError(f"there is no command `{name}`", help)
        return super().resolve_command(ctx, args)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        with formatter.section("Commands"):
            formatter.write_dl(list(_COMMANDS.items()))


@click.command(cls=_Commands, invoke_without_command=True)
@terminal_options
@click.pass_context
def commands(context: click.Context) -> int | None:
    """Run and check RAPID programs of ABB robots, without a robot."""
    if context.invoked_subcommand is None:
        echo(context.get_help())
        return ExitCode.USAGE
    return None
