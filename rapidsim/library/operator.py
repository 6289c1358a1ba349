r"""The FlexPendant: writing lines, asking for numbers, keys and texts.

A question never waits: it is answered from the run's answers, or with a default, at once. Options
that end a wait (\MaxTime, \DIBreak and their like) therefore never act and are reported.

Source: Technical reference manual RAPID Instructions, Functions and Data types.
"""

from __future__ import annotations

from typing import TypedDict, Unpack

from rapidsim.language.annotations import (
    Bool,
    Dnum,
    ErrNum,
    InOut,
    Num,
    Pers,
    SignalDi,
    SignalDo,
    String,
    Switch,
    Var,
)
from rapidsim.language.controller import Controller, Honesty, Operator
from rapidsim.language.data import Orient, Pos
from rapidsim.language.records import record_of
from rapidsim.library.honesty import ignored
from rapidsim.library.table import routine, table
from rapidsim.library.text import dnum_text, number_text, value_text
from rapidsim.library.traits import Does


class Breaks(TypedDict, total=False):
    """What may end a question before the operator answers."""

    max_time: Num
    di_break: Var[SignalDi]
    di_passive: Switch
    do_break: Var[SignalDo]
    do_passive: Switch
    pers_bool_break: Pers[Bool]
    pers_bool_passive: Switch
    break_flag: InOut[ErrNum]


def tp_write(
    controller: Operator,
    tp_text: String,
    *,
    num: Num | None = None,
    bool_: Bool | None = None,
    pos: Pos | None = None,
    orient: Orient | None = None,
    dnum: Dnum | None = None,
) -> None:
    """Write a line: a text and a value."""
    controller.show(tp_text + option_text(num, bool_, pos, orient, dnum))


def tp_erase(controller: Operator) -> None:
    """Clear the screen."""
    controller.clear_screen()


def tp_read_num(
    controller: Controller,
    tp_answer: InOut[Num],
    tp_text: String,
    **breaks: Unpack[Breaks],
) -> None:
    """Ask for a number."""
    no_breaks(controller.honesty, "TPReadNum", breaks)
    tp_answer.value = controller.operator.ask_number(tp_text)


def tp_read_dnum(
    controller: Controller,
    tp_answer: InOut[Dnum],
    tp_text: String,
    **breaks: Unpack[Breaks],
) -> None:
    """Ask for a number in double precision."""
    no_breaks(controller.honesty, "TPReadDnum", breaks)
    tp_answer.value = controller.operator.ask_number(tp_text)


def tp_read_fk(
    controller: Controller,
    tp_answer: InOut[Num],
    tp_text: String,
    tpfk1: String,
    tpfk2: String,
    tpfk3: String,
    tpfk4: String,
    tpfk5: String,
    **breaks: Unpack[Breaks],
) -> None:
    """Ask for one of five keys; the answer is its number."""
    no_breaks(controller.honesty, "TPReadFK", breaks)
    keys = (tpfk1, tpfk2, tpfk3, tpfk4, tpfk5)
    tp_answer.value = float(controller.operator.ask_choice(tp_text, keys) + 1)


def option_text(
    num: float | None,
    bool_: bool | None,
    pos: Pos | None,
    orient: Orient | None,
    dnum: float | None,
) -> str:
    r"""The text of the one value that TPWrite and Write take after their text; "" without."""
    if num is not None:
        return number_text(num)
    if bool_ is not None:
        return "TRUE" if bool_ else "FALSE"
    if pos is not None:
        return value_text(pos, record_of(Pos))
    if orient is not None:
        return value_text(orient, record_of(Orient))
    return "" if dnum is None else dnum_text(dnum)


def no_breaks(controller: Honesty, name: str, breaks: Breaks) -> None:
    """Report what would end a question early, and say that nothing did."""
    given = {
        r"\MaxTime": breaks.get("max_time"),
        r"\DIBreak": breaks.get("di_break"),
        r"\DOBreak": breaks.get("do_break"),
        r"\PersBoolBreak": breaks.get("pers_bool_break"),
    }
    ignored(controller, name, given)
    flag = breaks.get("break_flag")
    if flag is not None:
        flag.value = 0.0


_BREAKS = (
    r"\MaxTime \DIBreak \DIPassive \DOBreak \DOPassive \PersBoolBreak \PersBoolPassive \BreakFlag"
)

OPERATOR = table(
    routine("TPWrite", tp_write, r"TPText \Num|\Bool|\Pos|\Orient|\Dnum", does=Does.TELL),
    routine("TPErase", tp_erase, does=Does.TELL),
    routine("TPReadNum", tp_read_num, rf"TPAnswer TPText {_BREAKS}"),
    routine("TPReadDnum", tp_read_dnum, rf"TPAnswer TPText {_BREAKS}"),
    routine("TPReadFK", tp_read_fk, rf"TPAnswer TPText TPFK1 TPFK2 TPFK3 TPFK4 TPFK5 {_BREAKS}"),
)
