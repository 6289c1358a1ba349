"""Errors become messages and exit codes here only. Users never see a traceback."""

from __future__ import annotations

import errno
import os
import signal
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from traceback import format_exception
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

import click

from rapidsim import __version__
from rapidsim.cli.completion import COMPLETE, complete
from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.group import commands
from rapidsim.cli.interrupted import Terminated, TimeOverError
from rapidsim.cli.machine_output import (
    CommandError,
    ErrorReport,
    TextReport,
    is_json_requested,
    output_to_stderr,
    print_object,
)
from rapidsim.cli.successors import send_exit_code
from rapidsim.cli.terminal import PLAIN_CHARACTERS, Terminal, echo
from rapidsim.files import InputError, did_you_mean
from rapidsim.json_records.encoding import json_of
from rapidsim.syntax.garbage_collection import gc_rarely
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.jobs.cache.processes import DefectError

_LONGEST = 500
"""Characters of a line of a message; a name in a file may have millions."""
_UNWRITABLE = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO)
"""Error numbers of writing standard output to a full or failing disk."""


def run_commands(arguments: Sequence[str]) -> int:
    """Run the command line.

    Args:
        arguments: Without the program's name.

    Returns:
        One of `ExitCode`, whatever happens.
    """
    code = _run_commands(arguments)
    send_exit_code(code)
    return code


def _run_commands(arguments: Sequence[str]) -> int:
    _require_streams()
    try:
        with _terminable():
            instruction = os.environ.get(COMPLETE)
            if instruction:
                return complete(instruction)
            return _code_of(arguments)
    except BrokenPipeError:
        # The reader has closed the pipe.
        _give_up_output()
        return ExitCode.USAGE
    except (KeyboardInterrupt, click.Abort) as broken_off:
        _broken_off("interrupted", broken_off)
        return ExitCode.INTERRUPTED
    except Terminated as broken_off:
        _broken_off("terminated", broken_off)
        return ExitCode.TERMINATED


@value_class(frozen=True, slots=True)
class _Failure:
    """Why a command did not do what it was for."""

    code: ExitCode
    message: str
    help: str | None = None
    similar: tuple[str, ...] = ()


def _code_of(arguments: Sequence[str]) -> int:
    for stream in (sys.stdout, sys.stderr):
        # A terminal that cannot show a character shall not end a run.
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(errors=PLAIN_CHARACTERS)
    terminal = Terminal()
    if is_json_requested(arguments):
        return _printing_an_object(arguments, terminal)
    ended = _invoked(arguments, terminal)
    code = ended.code if isinstance(ended, _Failure) else ended
    return code if terminal.report is None else _print_report(terminal.report, code, terminal)


def _printing_an_object(arguments: Sequence[str], terminal: Terminal) -> int:
    """Run a command and print one object, also for an error."""
    ended: _Failure | int
    with output_to_stderr() as aside:
        try:
            ended = _invoked(arguments, terminal)
        except (KeyboardInterrupt, click.Abort) as broken_off:
            ended = _Failure(ExitCode.INTERRUPTED, _broken_off("interrupted", broken_off))
        except Terminated as broken_off:
            ended = _Failure(ExitCode.TERMINATED, _broken_off("terminated", broken_off))
    report = terminal.report
    if isinstance(ended, _Failure):
        error = CommandError(_shortened(ended.message), ended.help or "", ended.similar)
        report = (
            json_of(ErrorReport(error)) if report is None else {**report, "error": json_of(error)}
        )
    code = ended.code if isinstance(ended, _Failure) else ended
    return _print_report(report or json_of(TextReport(aside.getvalue())), code, terminal)


def _print_report(report: dict[str, object], code: int, terminal: Terminal) -> int:
    """Print the object of a command; what JSON cannot represent is a defect."""
    try:
        print_object(report)
    except ValueError as error:
        failure = _defect(error, terminal)
        print_object(json_of(ErrorReport(CommandError(failure.message, "", ()))))
        code = failure.code
    sys.stdout.flush()
    return code


def _invoked(arguments: Sequence[str], terminal: Terminal) -> _Failure | int:
    """Run a command; errors go to standard error."""
    try:
        with (
            gc_rarely(),
            commands.make_context("rapidsim", list(arguments), obj=terminal) as context,
        ):
            code = commands.invoke(context)
        sys.stdout.flush()
        return int(code or ExitCode.CLEAN)
    except click.exceptions.Exit as exit:
        return exit.exit_code
    except click.ClickException as error:
        failure = _usage_error(error)
    except InputError as error:
        failure = _Failure(ExitCode.USAGE, error.message, error.help, error.similar)
    except TimeOverError as over:
        failure = _Failure(ExitCode.LIMIT, f"--max-wall ended the command{over}")
    except (BrokenPipeError, KeyboardInterrupt, click.Abort, SystemExit, Terminated):
        raise
    except BaseException as error:
        # What a run ends with is no `Exception`; should one of those come here, it is a defect too.
        refusal = _refusal_of_system(error)
        if refusal is None:
            return _defect(error, terminal)
        if terminal.verbose:
            echo("".join(format_exception(error)), err=True)
        failure = refusal
    echo("error: " + _shortened(failure.message), err=True)
    if failure.help:
        echo(f" help: {failure.help}", err=True)
    return failure


def _refusal_of_system(error: BaseException) -> _Failure | None:
    """The failure where the system refused a file or memory; None for a defect.

    Commands say more of the files that they read and write; this is for all others.
    """
    if isinstance(error, MemoryError):
        return _Failure(ExitCode.LIMIT, "the memory does not suffice")
    if not isinstance(error, OSError):
        return None
    reason = error.strerror or str(error)
    if error.filename is not None:
        name = os.fsdecode(error.filename) if isinstance(error.filename, bytes) else error.filename
        return _Failure(ExitCode.USAGE, f"{name}: {reason}")
    if error.errno in _UNWRITABLE:
        _give_up_output()
        return _Failure(ExitCode.USAGE, f"the output cannot be written: {reason}")
    if not _has_working_folder():
        return _Failure(ExitCode.USAGE, "the working folder does not exist any more")
    return _Failure(ExitCode.USAGE, f"the system refused: {reason}")


def _has_working_folder() -> bool:
    try:
        Path.cwd()
    except OSError:
        return False
    return True


def _defect(error: BaseException, terminal: Terminal) -> _Failure:
    from rapidsim.jobs.cache.processes import defect_of

    defect = defect_of(error)
    if terminal.verbose:
        echo(defect.report, err=True)
    message = _defect_line(defect)
    echo(f"error: {message}", err=True)
    return _Failure(ExitCode.DEFECT, message)


def _broken_off(word: str, exception: BaseException) -> str:
    """Say that a command was broken off, and how far it was."""
    message = word + "".join(map(str, exception.args))
    _echo_last(message)
    return message


@contextmanager
def _terminable() -> Iterator[None]:
    """Raise `Terminated` on SIGTERM within the context, unless SIGTERM has another handler."""
    # Windows ends a process without a signal; only the main thread receives signals.
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
    """Discard output to a closed stream, so that the command still does its work."""
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


def _echo_last(word: str) -> None:
    with suppress(BrokenPipeError):
        echo(word, err=True)


def _shortened(message: str) -> str:
    """A message with long lines truncated."""
    lines = (
        line if len(line) <= _LONGEST else f"{line[:_LONGEST]}..." for line in message.split("\n")
    )
    return "\n".join(lines)


def _usage_error(error: click.ClickException) -> _Failure:
    """A mistake on the command line."""
    context = getattr(error, "ctx", None)
    shown = f"`{context.command_path} --help` lists them all" if context else None
    match error:
        case click.NoSuchOption():
            options = [o for p in context.command.params for o in p.opts] if context else []
            near = did_you_mean(error.option_name, [o for o in options if o.startswith("--")])
            message = f"there is no option `{error.option_name}`"
            return _Failure(ExitCode.USAGE, message, near or shown, near.names if near else ())
        case click.MissingParameter(param=click.Argument() as argument):
            wanted = argument.make_metavar(context)  # type: ignore[arg-type]
            if wanted == "PATH..." and context:
                shown = f"`{context.command_path} .` takes this folder; --help lists the options"
            return _Failure(ExitCode.USAGE, f"{wanted} is missing", shown)
        case _:
            message = error.format_message().rstrip(".")
            return _Failure(ExitCode.USAGE, message[:1].lower() + message[1:], shown)


def _defect_line(defect: DefectError) -> str:
    """One line with the failure, its place, and how to report it."""
    return (
        f"rapidsim {__version__} has a defect ({defect.what}, at {defect.place}); please "
        f"report this line with the program and the command, and with the output of the same "
        f"command with -v"
    )
