r"""The FlexPendant: writing lines, and asking for numbers, keys and texts.

The answers of the run answer a question at once. Without an answer the result is a default with a
warning, or the outcome that `questions` defines for a question with an end condition.

Source: Technical reference manual RAPID Instructions, Functions and Data types.
"""

from __future__ import annotations

from typing import Unpack

from rapidsim.language.annotations import Bool, Dnum, InOut, Num, String
from rapidsim.language.controller import Controller, Operator
from rapidsim.language.data import Orient, Pos
from rapidsim.language.errors import NotAllowed
from rapidsim.language.records import record_of
from rapidsim.language.reference import Reference
from rapidsim.library.questions import BREAKS, QuestionBreakOptions, answered
from rapidsim.library.table import routine, table
from rapidsim.library.text import dnum_text, number_text, value_text
from rapidsim.library.traits import Trait


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
    **breaks: Unpack[QuestionBreakOptions],
) -> None:
    """Ask for a number."""
    _read_number(controller, "TPReadNum", tp_answer, tp_text, breaks)


def tp_read_dnum(
    controller: Controller,
    tp_answer: InOut[Dnum],
    tp_text: String,
    **breaks: Unpack[QuestionBreakOptions],
) -> None:
    """Ask for a number in double precision."""
    _read_number(controller, "TPReadDnum", tp_answer, tp_text, breaks)


def tp_read_fk(
    controller: Controller,
    tp_answer: InOut[Num],
    tp_text: String,
    tpfk1: String,
    tpfk2: String,
    tpfk3: String,
    tpfk4: String,
    tpfk5: String,
    **breaks: Unpack[QuestionBreakOptions],
) -> None:
    """Ask for one of five keys; the answer is its number."""
    keys = (tpfk1, tpfk2, tpfk3, tpfk4, tpfk5)
    if not any(keys):
        raise NotAllowed("TPReadFK has no text for any key, so no answer is possible")

    def ask(ends: bool) -> int | None:
        return controller.operator.ask_choice(tp_text, keys, ends=ends)

    before = int(tp_answer.value) - 1
    tp_answer.value = float(answered(controller, "TPReadFK", breaks, ask, before) + 1)


def _read_number(
    controller: Controller,
    name: str,
    answer: Reference[float],
    prompt: str,
    breaks: QuestionBreakOptions,
) -> None:
    """Ask for a number; it keeps its value without an answer."""

    def ask(ends: bool) -> float | None:
        return controller.operator.ask_number(prompt, ends=ends)

    answer.value = answered(controller, name, breaks, ask, answer.value)


def option_text(
    num: float | None,
    bool_: bool | None,
    pos: Pos | None,
    orient: Orient | None,
    dnum: float | None,
) -> str:
    r"""Text of the one value that TPWrite and Write append to their text; "" without a value."""
    if num is not None:
        return number_text(num)
    if bool_ is not None:
        return "TRUE" if bool_ else "FALSE"
    if pos is not None:
        return value_text(pos, record_of(Pos))
    if orient is not None:
        return value_text(orient, record_of(Orient))
    return "" if dnum is None else dnum_text(dnum)


OPERATOR = table(
    routine("TPWrite", tp_write, r"TPText \Num|\Bool|\Pos|\Orient|\Dnum", does=Trait.TELL),
    routine("TPErase", tp_erase, does=Trait.TELL),
    routine("TPReadNum", tp_read_num, rf"TPAnswer TPText {BREAKS}"),
    routine("TPReadDnum", tp_read_dnum, rf"TPAnswer TPText {BREAKS}"),
    routine("TPReadFK", tp_read_fk, rf"TPAnswer TPText TPFK1 TPFK2 TPFK3 TPFK4 TPFK5 {BREAKS}"),
)
