"""The one place where mistakes become messages and exit codes. Users never see a traceback."""

from __future__ import annotations

import os
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path
from types import FrameType

import click

from rapidsim import __version__
from rapidsim.cli.commands import commands
from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import Terminal
from rapidsim.files import InputError, did_you_mean


def run_commands(arguments: Sequence[str]) -> int:
    """Run the command line.

    Args:
        arguments: Without the program's name.

    Returns:
        The exit code.
    """
    for stream in (sys.stdout, sys.stderr):
        # A terminal that cannot show a character shall not end a run.
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors="backslashreplace")
    terminal = Terminal()
    try:
        with commands.make_context("rapidsim", list(arguments), obj=terminal) as context:
            code = commands.invoke(context)
        sys.stdout.flush()
        return int(code or ExitCode.CLEAN)
    except click.exceptions.Exit as exit:
        return exit.exit_code
    except click.ClickException as error:
        _say(*_usage_error(error))
        return ExitCode.USAGE
    except InputError as error:
        _say(error.message, error.help)
        return ExitCode.USAGE
    except (KeyboardInterrupt, click.Abort):
        click.echo("interrupted", err=True)
        return ExitCode.INTERRUPTED
    except BrokenPipeError:
        # Whoever reads has seen enough; Python would complain once more when it closes the stream.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return ExitCode.BROKEN_PIPE
    except Exception as error:
        if terminal.verbose:
            traceback.print_exc()
        click.echo(_defect(error), err=True)
        return ExitCode.DEFECT


def _say(message: str, help: str | None) -> None:
    click.echo(f"error: {message}", err=True)
    if help:
        click.echo(f" help: {help}", err=True)


def _usage_error(error: click.ClickException) -> tuple[str, str | None]:
    """Message and help line of a mistake on the command line."""
    context = getattr(error, "ctx", None)
    shown = f"`{context.command_path} --help` shows what there is" if context else None
    match error:
        case click.NoSuchOption():
            options = [o for p in context.command.params for o in p.opts] if context else []
            near = did_you_mean(error.option_name, [o for o in options if o.startswith("--")])
            return f"there is no option `{error.option_name}`", near or shown
        case click.MissingParameter(param=click.Argument() as argument):
            return f"{argument.make_metavar(context)} is missing", shown  # type: ignore[arg-type]
        case _:
            message = error.format_message().rstrip(".")
            return message[:1].lower() + message[1:], shown


def _defect(error: Exception) -> str:
    """One line that says what failed, where, and how to report it."""
    frames: list[FrameType] = [frame for frame, _ in traceback.walk_tb(error.__traceback__)]
    lines = [line for _, line in traceback.walk_tb(error.__traceback__)]
    place = f"{Path(frames[-1].f_code.co_filename).name}:{lines[-1]}" if frames else "?"
    what = f"{type(error).__name__}: {error}".splitlines()[0]
    return (
        f"error: rapidsim {__version__} has a defect ({what}, at {place}); please report this line "
        f"with the program and the command, and with the output of the same command with -v"
    )
