"""The one place where mistakes become messages and exit codes. Users never see a traceback."""

from __future__ import annotations

import errno
import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

import click

from rapidsim import __version__
from rapidsim.cli.broken_off import Terminated, TimeOverError
from rapidsim.cli.completion import COMPLETE, complete
from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.group import commands
from rapidsim.cli.terminal import PLAIN_CHARACTERS, Terminal, say
from rapidsim.files import InputError, did_you_mean
from rapidsim.syntax.collection import seldom_collected

if TYPE_CHECKING:
    from rapidsim.jobs.processes import DefectError

_LONGEST = 500
"""Characters of a line of a message; a name in a file may have millions."""
_UNWRITABLE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
"""What the system answers when standard output goes to a full disk, or one that fails."""


def run_commands(arguments: Sequence[str]) -> int:
    """Run the command line.

    Args:
        arguments: Without the program's name.

    Returns:
        One of `ExitCode`, whatever happens.
    """
    _require_streams()
    try:
        with _terminable():
            instruction = os.environ.get(COMPLETE)
            if instruction:
                return complete(instruction)
            return _code_of(arguments)
    except BrokenPipeError:
        # Whoever reads has seen enough.
        _give_up_output()
        return ExitCode.USAGE
    except (KeyboardInterrupt, click.Abort) as broken_off:
        _say_last("interrupted" + "".join(map(str, broken_off.args)))
        return ExitCode.INTERRUPTED
    except Terminated as broken_off:
        _say_last("terminated" + "".join(map(str, broken_off.args)))
        return ExitCode.TERMINATED


def _code_of(arguments: Sequence[str]) -> int:
    for stream in (sys.stdout, sys.stderr):
        # A terminal that cannot show a character shall not end a run.
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors=PLAIN_CHARACTERS)
    terminal = Terminal()
    try:
        with (
            seldom_collected(),
            commands.make_context("rapidsim", list(arguments), obj=terminal) as context,
        ):
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
    except TimeOverError as over:
        _say(f"--max-wall ended the command{over}", None)
        return ExitCode.LIMIT
    except (BrokenPipeError, KeyboardInterrupt, click.Abort, SystemExit, Terminated):
        raise
    except BaseException as error:
        # What a run ends with is no `Exception`; should one of those come here, it is a defect too.
        if isinstance(error, OSError) and error.errno in _UNWRITABLE:
            # Files have messages of their own; what is left is what was to be printed.
            _give_up_output()
            _say(f"the output cannot be written: {error.strerror}", None)
            return ExitCode.USAGE
        from rapidsim.jobs.processes import defect_of

        defect = defect_of(error)
        if terminal.verbose:
            say(defect.told, err=True)
        say(_told(defect), err=True)
        return ExitCode.DEFECT


@contextmanager
def _terminable() -> Iterator[None]:
    """Raise `Terminated` in here on SIGTERM, where it ends a process and nobody has put it off."""
    # Windows ends a process without asking it; signals come to the main thread alone.
    is_asked = os.name == "posix" and threading.current_thread() is threading.main_thread()
    if not is_asked or signal.getsignal(signal.SIGTERM) is not signal.SIG_DFL:
        yield
        return
    signal.signal(signal.SIGTERM, _terminate)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_DFL)


def _terminate(_number: int, _frame: FrameType | None) -> NoReturn:
    raise Terminated


def _require_streams() -> None:
    """Print into nothing where the caller has closed a stream: what was asked for still happens."""
    for name in ("stdout", "stderr"):
        if getattr(sys, name) is None:
            nothing = os.open(os.devnull, os.O_WRONLY)
            setattr(sys, name, os.fdopen(nothing, "w", encoding="utf-8"))


def _give_up_output() -> None:
    """Keep Python from complaining once more when it closes its streams."""
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except OSError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _say_last(word: str) -> None:
    with suppress(BrokenPipeError):
        say(word, err=True)


def _say(message: str, help: str | None) -> None:
    lines = (
        line if len(line) <= _LONGEST else f"{line[:_LONGEST]}..." for line in message.split("\n")
    )
    say("error: " + "\n".join(lines), err=True)
    if help:
        say(f" help: {help}", err=True)


def _usage_error(error: click.ClickException) -> tuple[str, str | None]:
    """Message and help line of a mistake on the command line."""
    context = getattr(error, "ctx", None)
    shown = f"`{context.command_path} --help` lists them all" if context else None
    match error:
        case click.NoSuchOption():
            options = [o for p in context.command.params for o in p.opts] if context else []
            near = did_you_mean(error.option_name, [o for o in options if o.startswith("--")])
            return f"there is no option `{error.option_name}`", near or shown
        case click.MissingParameter(param=click.Argument() as argument):
            wanted = argument.make_metavar(context)  # type: ignore[arg-type]
            if wanted == "PATH..." and context:
                shown = f"`{context.command_path} .` takes this folder; --help lists the options"
            return f"{wanted} is missing", shown
        case _:
            message = error.format_message().rstrip(".")
            return message[:1].lower() + message[1:], shown


def _told(defect: DefectError) -> str:
    """One line that says what failed, where, and how to report it."""
    return (
        f"error: rapidsim {__version__} has a defect ({defect.what}, at {defect.place}); please "
        f"report this line with the program and the command, and with the output of the same "
        f"command with -v"
    )
