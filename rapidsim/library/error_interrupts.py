"""Interrupts on entries of the event log, and reading the entry in the trap.

Entries come from ErrWrite and ErrLog of any task and from corner path failures. An error that stops
the program is too late for a trap of its own task, as on a controller; tasks that continue receive
it, as on a controller that stays on.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "IError",
"GetTrapData", "ReadErrData".
"""

from __future__ import annotations

from rapidsim.language.annotations import ErrDomain, ErrType, IntNum, Num, String, TrapData, Var
from rapidsim.language.controller import Interrupts
from rapidsim.language.error_numbers import ERR_ARGVALERR, rapid_error
from rapidsim.language.errors import NotAllowed
from rapidsim.library.table import routine, table


def i_error(
    controller: Interrupts,
    error_domain: ErrDomain,
    error_type: ErrType,
    interrupt: Var[IntNum],
    *,
    error_id: Num | None = None,
) -> None:
    """Order an interrupt when an error, a warning or a change of state is logged."""
    controller.order_logged(
        interrupt.value, lambda entry: entry.is_meant_by(error_domain, error_id, error_type)
    )


def get_trap_data(controller: Interrupts, trap_event: Var[TrapData]) -> None:
    """Store the event that caused the trap."""
    if not controller.in_trap:
        raise NotAllowed("GetTrapData can be used in a trap only")
    trap_event.value = controller.trap_cause()


def read_err_data(
    trap_event: Var[TrapData],
    error_domain: Var[ErrDomain],
    error_id: Var[Num],
    error_type: Var[ErrType],
    *,
    title: Var[String] | None = None,
    str1: Var[String] | None = None,
    str2: Var[String] | None = None,
    str3: Var[String] | None = None,
    str4: Var[String] | None = None,
    str5: Var[String] | None = None,
) -> None:
    """Read the parts of the event that caused the trap."""
    entry = trap_event.value
    if entry is None:
        raise rapid_error(
            ERR_ARGVALERR,
            "ReadErrData: the data hold no error; GetTrapData in a trap that IError ordered "
            "gives them one",
        )
    error_domain.value, error_id.value = entry.domain, entry.number
    error_type.value = entry.type
    if title is not None:
        title.value = entry.title
    texts = entry.texts + ("",) * 5
    for given, text in zip((str1, str2, str3, str4, str5), texts, strict=False):
        if given is not None:
            given.value = text


ERROR_INTERRUPTS = table(
    routine("IError", i_error, r"ErrorDomain \ErrorId ErrorType Interrupt"),
    routine("GetTrapData", get_trap_data),
    routine("ReadErrData", read_err_data),
)
