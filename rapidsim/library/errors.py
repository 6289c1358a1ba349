"""Error numbers and messages. RAISE, RETRY and TRYNEXT are statements of the language.

Source: Technical reference manual RAPID Instructions, Functions and Data types.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import PurePath

from rapidsim.language.annotations import ErrNum, ErrStr, HandlerType, Num, String, Switch, Var
from rapidsim.language.controller import Controller, ErrorNumbers
from rapidsim.language.error_log import (
    ERROR,
    PROCESS_DOMAIN,
    STATE,
    USER_DOMAIN,
    WARNING,
    LoggedError,
)
from rapidsim.language.error_numbers import ERR_ARGVALERR, MAX_RETRIES, NUMBERS, rapid_error
from rapidsim.language.errors import RaisedError, RaisedToUser
from rapidsim.library.fidelity_notes import note_ignored_options
from rapidsim.library.predefined import ERRSTR_CONTEXT, ERRSTR_TASK, TYPES
from rapidsim.library.table import routine, table
from rapidsim.library.text import number_text
from rapidsim.library.traits import Trait


def book_err_no(controller: ErrorNumbers, error_name: Var[ErrNum]) -> None:
    """Assign a unique error number to a variable, unless it already has one."""
    if error_name.value == -1.0:
        error_name.value = controller.book_error_number()


def err_write(
    controller: Controller,
    header: String,
    reason: String,
    *,
    w: Switch = False,
    i: Switch = False,
    rl2: String | None = None,
    rl3: String | None = None,
    rl4: String | None = None,
) -> None:
    """Show a message and keep it in the event log."""
    lines = [line for line in (reason, rl2, rl3, rl4) if line]
    controller.operator.show(f"{_kind(w, i)} {header}: {' / '.join(lines)}")
    number = 2.0 if w else 3.0 if i else 1.0
    controller.interrupts.log_error(
        LoggedError(USER_DOMAIN, number, _type(w, i), header, tuple(lines))
    )


def err_log(
    controller: Controller,
    error_id: Num,
    argument1: ErrStr,
    argument2: ErrStr,
    argument3: ErrStr,
    argument4: ErrStr,
    argument5: ErrStr,
    *,
    w: Switch = False,
    i: Switch = False,
) -> None:
    """Show a numbered message of the program's own text file, with its placeholders filled."""
    given = (argument1, argument2, argument3, argument4, argument5)
    arguments = error_texts(controller, given)
    controller.operator.show(f"{_kind(w, i)} {number_text(error_id)}: {' / '.join(arguments)}")
    entry = LoggedError(PROCESS_DOMAIN, error_id, _type(w, i), texts=tuple(arguments))
    controller.interrupts.log_error(entry)


def err_raise(
    controller: Controller,
    error_name: String,
    error_id: Num,
    argument1: ErrStr,
    argument2: ErrStr,
    argument3: ErrStr,
    argument4: ErrStr,
    argument5: ErrStr,
) -> None:
    """Log a warning as ErrLog does, and raise a booked error by its name.

    In an ERROR clause the error propagates to the caller, as with RAISE.
    """
    number = controller.symbols.read(error_name, TYPES["errnum"], None)
    given = (argument1, argument2, argument3, argument4, argument5)
    texts = error_texts(controller, given)
    controller.operator.show(f"warning {number_text(error_id)}: {' / '.join(texts)}")
    entry = LoggedError(PROCESS_DOMAIN, error_id, WARNING, error_name, tuple(texts))
    controller.interrupts.log_error(entry)
    assert isinstance(number, float)
    told = f"{error_name}, which ErrRaise raised: {' / '.join(texts)}"
    raise RaisedError(number, told, name=error_name)


def skip_warn() -> None:
    """Remove the last warning from the event log; the run still reports it."""


def error_texts(controller: Controller, texts: Sequence[str]) -> list[str]:
    """Texts of an error, with placeholders replaced by the task and the position in the program."""
    place = controller.clock.place
    file_name = PurePath(place.span.file).name
    meant = {
        ERRSTR_TASK: controller.tasks.task_name,
        ERRSTR_CONTEXT: f"{place.routine}, {file_name}:{place.span.line}",
    }
    return [meant.get(text, text) for text in texts if text]


def reset_retry_count(controller: Controller) -> None:
    """Restart the count of retries in an ERROR clause, which then may never end."""
    controller.error_numbers.retries = 0
    controller.clock.tick()


def remaining_retries(controller: ErrorNumbers) -> Num:
    """The number of retries that remain for the ERROR clause."""
    return max(0.0, float(MAX_RETRIES - controller.retries))


def exec_handler(controller: ErrorNumbers) -> HandlerType:
    """Which clause of a routine is running: none, ERROR or UNDO."""
    return controller.handler


def raise_to_user(
    controller: Controller,
    *,
    continue_: Switch = False,
    break_off: Switch = False,
    error_number: ErrNum | None = None,
) -> None:
    r"""Pass an error on to the ERROR clause of the first routine whose module is not NOSTEPIN.

    With \Continue that clause would continue inside the NOSTEPIN routines; a run leaves them as
    with \BreakOff.
    """
    if not (continue_ or break_off):
        raise rapid_error(ERR_ARGVALERR, r"RaiseToUser needs \Continue or \BreakOff")
    note_ignored_options(controller.fidelity, "RaiseToUser", {r"\Continue": continue_})
    numbers = controller.error_numbers
    number = numbers.errno if error_number is None else error_number
    names = [name for name, value in NUMBERS.items() if value == number]
    what = names[0] if names else f"{number:g}"
    raise RaisedToUser(number, f"the program raised error {what} to the user")


def _kind(warning: bool, information: bool) -> str:
    return "warning" if warning else "information" if information else "error"


def _type(warning: bool, information: bool) -> float:
    return WARNING if warning else STATE if information else ERROR


ERRORS = table(
    routine("ResetRetryCount", reset_retry_count),
    routine("RemainingRetries", remaining_retries),
    routine("ExecHandler", exec_handler),
    routine("RaiseToUser", raise_to_user, r"\Continue \BreakOff \ErrorNumber", does=Trait.LEAVE),
    routine("BookErrNo", book_err_no),
    routine("ErrWrite", err_write, r"\W|\I Header Reason \RL2 \RL3 \RL4", does=Trait.TELL),
    routine("SkipWarn", skip_warn, does=Trait.TELL),
    routine("ErrRaise", err_raise, does=Trait.LEAVE),
    routine(
        "ErrLog",
        err_log,
        r"ErrorId \W|\I Argument1 Argument2 Argument3 Argument4 Argument5",
        does=Trait.TELL,
    ),
)
