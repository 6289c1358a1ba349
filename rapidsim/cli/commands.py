"""The group of commands; each is imported when it is used."""

from __future__ import annotations

from importlib import import_module
from typing import cast

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import terminal_options
from rapidsim.files import InputError, did_you_mean

# In the order of the help page. `rapidsim.cli.<name>` holds a command of the same name.
_NAMES = ("run", "check", "explain", "robots", "frames")


class _Commands(click.Group):
    def list_commands(self, ctx: click.Context) -> list[str]:
        return list(_NAMES)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        if cmd_name not in _NAMES:
            return None
        return cast(click.Command, getattr(import_module(f"rapidsim.cli.{cmd_name}"), cmd_name))

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        name = args[0]
        if self.get_command(ctx, name) is None:
            help = did_you_mean(name, _NAMES) or f"there are {', '.join(_NAMES)}"
            raise InputError(f"there is no command `{name}`", help)
        return super().resolve_command(ctx, args)


@click.command(cls=_Commands, invoke_without_command=True)
@terminal_options
@click.pass_context
def commands(context: click.Context) -> int | None:
    """Run and check RAPID programs of ABB robots, without a robot."""
    if context.invoked_subcommand is None:
        click.echo(context.get_help())
        return ExitCode.USAGE
    return None
