r"""Questions that end without an answer: \MaxTime, \DIBreak, \DOBreak, \PersBoolBreak.

An operator answers at once; in a served controller that stays on, at any later time. Without an
answer the question remains open until one of its end conditions holds; \BreakFlag then receives the
reason, and without \BreakFlag it is an error. A condition that holds already ends the question
before it is shown.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "TPReadNum",
"UIMessageBox".
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypedDict, TypeVar

from rapidsim.language.annotations import (
    Bool,
    ErrNum,
    InOut,
    Num,
    Pers,
    SignalDi,
    SignalDo,
    Switch,
    Var,
)
from rapidsim.language.controller import Controller, Signals
from rapidsim.language.data import Signal
from rapidsim.language.error_numbers import (
    ERR_TP_DIBREAK,
    ERR_TP_DOBREAK,
    ERR_TP_MAXTIME,
    ERR_TP_PERSBOOLBREAK,
    rapid_error,
)
from rapidsim.language.reference import Reference
from rapidsim.library.signals import connected

T = TypeVar("T")


class QuestionBreakOptions(TypedDict, total=False):
    """Conditions that end a question before the operator answers."""

    max_time: Num
    di_break: Var[SignalDi]
    di_passive: Switch
    do_break: Var[SignalDo]
    do_passive: Switch
    pers_bool_break: Pers[Bool]
    pers_bool_passive: Switch
    break_flag: InOut[ErrNum]


_End = tuple[float, str, Callable[[], bool]]
"""Error number, description of the event, and a test whether it has happened."""

_LOOKS_EVERY_S = 0.02
BREAKS = (
    r"\MaxTime \DIBreak \DIPassive \DOBreak \DOPassive \PersBoolBreak \PersBoolPassive \BreakFlag"
)
"""The options in the order of the table's rows."""


def answered(
    controller: Controller,
    name: str,
    breaks: QuestionBreakOptions,
    put_question: Callable[[bool], T | None],
    default: T,
) -> T:
    r"""The operator's answer, or `default` with the reason in \BreakFlag if a condition ended it.

    Args:
        controller: Controller of the task.
        name: The instruction or function.
        breaks: The conditions that may end the question.
        put_question: Asks the operator; its argument is whether a condition may end the question.
            Returns None if no operator is there and a condition may end it.
        default: The value without an answer.

    Raises:
        RapidError: ERR_TP_MAXTIME or the error of another condition, without \BreakFlag.
    """
    flag, max_time = breaks.get("break_flag"), breaks.get("max_time")
    ends = list(_ends(controller.signals, breaks))
    operator = controller.operator
    found = _happened(ends)
    if found is None:
        with operator.asking(name):
            value = put_question(bool(ends) or max_time is not None)
            if value is None:
                controller.signals.wait_until(
                    lambda: operator.has_answered or _happened(ends) is not None,
                    max_time=max_time,
                    poll_s=_LOOKS_EVERY_S,
                )
            if operator.has_answered:
                value = put_question(True)
        if value is not None:
            if flag is not None:
                flag.value = 0.0
            return value
        timeout = (ERR_TP_MAXTIME, f"no answer within {max_time or 0.0:g} s")
        found = _happened(ends) or timeout
    errno, happened = found
    if flag is None:
        raise rapid_error(errno, f"{name}: {happened}")
    flag.value = errno
    return default


def _ends(signals: Signals, breaks: QuestionBreakOptions) -> Iterator[_End]:
    def is_set(signal: Reference[Signal]) -> bool:
        return signals.read_signal(connected(signal)) != 0.0

    if (di := breaks.get("di_break")) is not None:
        wanted = not breaks.get("di_passive")
        yield ERR_TP_DIBREAK, rf"`{connected(di)}` of \DIBreak came", lambda: is_set(di) is wanted
    if (do := breaks.get("do_break")) is not None:
        active = not breaks.get("do_passive")
        yield ERR_TP_DOBREAK, rf"`{connected(do)}` of \DOBreak came", lambda: is_set(do) is active
    if (flag := breaks.get("pers_bool_break")) is not None:
        value = not breaks.get("pers_bool_passive")
        yield ERR_TP_PERSBOOLBREAK, r"\PersBoolBreak came", lambda: bool(flag.value) is value


def _happened(ends: list[_End]) -> tuple[float, str] | None:
    return next(((errno, words) for errno, words, has_happened in ends if has_happened()), None)
