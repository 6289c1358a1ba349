r"""Dialogs of the FlexPendant: message boxes, entries, lists.

All questions are answered as in `operator`. Icons, images and line wrapping have no effect.

Source: Technical reference manual RAPID Instructions, Functions and Data types, "UIMsgBox",
"UIMessageBox", "UINumEntry", "UINumTune", "UIAlphaEntry", "UIListView".
"""

from __future__ import annotations

from typing import TypedDict, Unpack

from rapidsim.language.annotations import (
    Bool,
    BtnRes,
    ButtonData,
    Dnum,
    IconData,
    InOut,
    Num,
    SignalDo,
    String,
    Switch,
    Var,
)
from rapidsim.language.controller import Controller, FidelityReporter
from rapidsim.language.data import ListItem
from rapidsim.language.error_numbers import (
    ERR_UI_INITVALUE,
    ERR_UI_MAXMIN,
    ERR_UI_NOTINT,
    rapid_error,
)
from rapidsim.library.fidelity_notes import note_ignored_options
from rapidsim.library.questions import BREAKS, QuestionBreakOptions, answered
from rapidsim.library.table import routine, table
from rapidsim.library.traits import Trait

NO_RESULT, OK_RESULT = 0.0, 1.0
"""The constants resUnkwn and resOK."""
NO_BUTTONS = -1.0
"""The constant btnNone."""
OK_BUTTON = 0.0
"""The constant btnOK."""

# Buttons and their results, by the constants btnOK to btnYesNoCancel and resOK to resNo.
_BUTTONS: tuple[tuple[tuple[str, float], ...], ...] = (
    (("OK", 1.0),),
    (("Abort", 2.0), ("Retry", 3.0), ("Ignore", 4.0)),
    (("OK", 1.0), ("Cancel", 5.0)),
    (("Retry", 3.0), ("Cancel", 5.0)),
    (("Yes", 6.0), ("No", 7.0)),
    (("Yes", 6.0), ("No", 7.0), ("Cancel", 5.0)),
)


class Options(QuestionBreakOptions, total=False):
    """Options of every dialog."""

    icon: IconData
    ui_active_signal: Var[SignalDo]


class Text(TypedDict, total=False):
    """The heading and the text of a dialog, in one piece or line by line."""

    header: String
    message: String
    msg_array: list[String]
    wrap: Switch


class DialogOptions(Options, Text, total=False):
    """Text and options of a dialog."""


def ui_msg_box(
    controller: Controller,
    msg_line1: String,
    *,
    header: String | None = None,
    msg_line2: String | None = None,
    msg_line3: String | None = None,
    msg_line4: String | None = None,
    msg_line5: String | None = None,
    wrap: Switch = False,
    buttons: ButtonData | None = None,
    image: String | None = None,
    result: InOut[BtnRes] | None = None,
    **options: Unpack[Options],
) -> None:
    """Show a message with buttons."""
    del wrap, image
    _report(controller.fidelity, "UIMsgBox", options)
    lines = (header, msg_line1, msg_line2, msg_line3, msg_line4, msg_line5)
    prompt = " / ".join(line for line in lines if line)
    if buttons == NO_BUTTONS:
        controller.operator.show(prompt)
        return
    pressed = _pressed(controller, "UIMsgBox", options, prompt, buttons, None)
    if result is not None:
        result.value = pressed


def ui_message_box(
    controller: Controller,
    *,
    buttons: ButtonData | None = None,
    btn_array: list[String] | None = None,
    default_btn: BtnRes | None = None,
    image: String | None = None,
    **asked: Unpack[DialogOptions],
) -> BtnRes:
    r"""Show a message with buttons; returns the button, or its number in the program's own list.

    Ended without an answer, it returns \DefaultBtn.
    """
    del image
    _report(controller.fidelity, "UIMessageBox", asked)
    if buttons == NO_BUTTONS:
        controller.operator.show(_prompt(asked))
        return NO_RESULT
    unanswered = NO_RESULT if default_btn is None else default_btn
    prompt = _prompt(asked)
    return _pressed(controller, "UIMessageBox", asked, prompt, buttons, btn_array, unanswered)


def ui_num_entry(
    controller: Controller,
    *,
    init_value: Num | None = None,
    min_value: Num | None = None,
    max_value: Num | None = None,
    as_integer: Switch = False,
    **asked: Unpack[DialogOptions],
) -> Num:
    """Ask for a number within limits."""
    _report(controller.fidelity, "UINumEntry", asked)
    return _number(controller, "UINumEntry", asked, init_value, min_value, max_value, as_integer)


def ui_dnum_entry(
    controller: Controller,
    *,
    init_value: Dnum | None = None,
    min_value: Dnum | None = None,
    max_value: Dnum | None = None,
    as_integer: Switch = False,
    **asked: Unpack[DialogOptions],
) -> Dnum:
    """Ask for a number within limits, in double precision."""
    _report(controller.fidelity, "UIDnumEntry", asked)
    return _number(controller, "UIDnumEntry", asked, init_value, min_value, max_value, as_integer)


def ui_alpha_entry(
    controller: Controller, *, init_string: String | None = None, **asked: Unpack[DialogOptions]
) -> String:
    """Ask for a text."""
    _report(controller.fidelity, "UIAlphaEntry", asked)
    proposal = init_string or ""

    def ask(ends: bool) -> str | None:
        return controller.operator.ask_text(_prompt(asked), proposal, ends=ends)

    return answered(controller, "UIAlphaEntry", asked, ask, proposal)


def ui_list_view(
    controller: Controller,
    list_items: list[ListItem],
    *,
    result: InOut[BtnRes] | None = None,
    header: String | None = None,
    buttons: ButtonData | None = None,
    btn_array: list[String] | None = None,
    default_index: Num | None = None,
    **options: Unpack[Options],
) -> Num:
    """Ask for one line of a list; returns its number. The first button ends the choice."""
    _report(controller.fidelity, "UIListView", options)

    def ask(ends: bool) -> int | None:
        lines = [item.text for item in list_items]
        return controller.operator.ask_choice(header or "", lines, ends=ends)

    chosen = answered(controller, "UIListView", options, ask, None)
    first = OK_RESULT if btn_array or buttons is None else _buttons(buttons)[0][1]
    if result is not None:
        result.value = NO_RESULT if chosen is None else first
    return (default_index or 0.0) if chosen is None else float(chosen + 1)


def ui_num_tune(
    controller: Controller,
    init_value: Num,
    increment: Num,
    *,
    min_value: Num | None = None,
    max_value: Num | None = None,
    **asked: Unpack[DialogOptions],
) -> Num:
    """Let the operator change a number step by step, within limits."""
    return _tuned(controller, "UINumTune", asked, init_value, increment, min_value, max_value)


def ui_dnum_tune(
    controller: Controller,
    init_value: Dnum,
    increment: Dnum,
    *,
    min_value: Dnum | None = None,
    max_value: Dnum | None = None,
    **asked: Unpack[DialogOptions],
) -> Dnum:
    """Let the operator change a number step by step, within limits, in double precision."""
    return _tuned(controller, "UIDnumTune", asked, init_value, increment, min_value, max_value)


def ui_msg_write(
    controller: Controller,
    header: String,
    message: String | list[String],
    *,
    wrap: Switch = False,
    icon: IconData | None = None,
    image: String | None = None,
    pers_bool: Bool | None = None,
    pers_bool_name: String | None = None,
    abort_value: Bool | None = None,
    ui_active_signal: Var[SignalDo] | None = None,
) -> None:
    """Show a message and continue."""
    del wrap, icon, image, pers_bool, pers_bool_name, abort_value
    note_ignored_options(controller.fidelity, "UIMsgWrite", {r"\UIActiveSignal": ui_active_signal})
    lines = message if isinstance(message, list) else [message]
    controller.operator.show(" / ".join(line for line in (header, *lines) if line))


def ui_msg_write_abort() -> None:
    """Remove a message of UIMsgWrite."""


def _tuned(
    controller: Controller,
    name: str,
    options: DialogOptions,
    initial: float,
    step: float,
    least: float | None,
    most: float | None,
) -> float:
    del step
    _report(controller.fidelity, name, options)
    return _number(controller, name, options, initial, least, most, False)


def _pressed(
    controller: Controller,
    name: str,
    options: QuestionBreakOptions,
    prompt: str,
    buttons: float | None,
    own: list[str] | None,
    unanswered: float = NO_RESULT,
) -> float:
    keys = _buttons(buttons)
    texts = [text for text, _ in keys] if own is None else own

    def ask(ends: bool) -> int | None:
        return controller.operator.ask_choice(prompt, texts, ends=ends)

    pressed = answered(controller, name, options, ask, None)
    if pressed is None:
        return unanswered
    return keys[pressed][1] if own is None else pressed + 1.0


def _buttons(buttons: float | None) -> tuple[tuple[str, float], ...]:
    chosen = int(OK_BUTTON if buttons is None else buttons)
    return _BUTTONS[chosen] if 0 <= chosen < len(_BUTTONS) else _BUTTONS[0]


def _number(
    controller: Controller,
    name: str,
    options: DialogOptions,
    initial: float | None,
    least: float | None,
    most: float | None,
    is_integer: bool,
) -> float:
    low = -float("inf") if least is None else least
    high = float("inf") if most is None else most
    if low > high:
        raise rapid_error(ERR_UI_MAXMIN, f"{name}: the least value {low:g} is above {high:g}")
    if initial is not None and not low <= initial <= high:
        raise rapid_error(ERR_UI_INITVALUE, f"{name}: {initial:g} is not within {low:g}..{high:g}")
    if is_integer and initial is not None and initial != round(initial):
        raise rapid_error(ERR_UI_NOTINT, f"{name}: {initial:g} is not a whole number")

    def ask(ends: bool) -> float | None:
        return controller.operator.ask_number(_prompt(options), ends=ends)

    answer = answered(controller, name, options, ask, None)
    if answer is None:
        return initial or 0.0
    taken = min(max(float(round(answer)) if is_integer else answer, low), high)
    if taken != answer:
        # A FlexPendant would not accept such a number.
        controller.fidelity.not_simulated(f"{name} with the answer {answer:g}", f"{taken:g}")
    return taken


def _prompt(options: DialogOptions) -> str:
    lines = [options.get("header"), options.get("message"), *(options.get("msg_array") or ())]
    return " / ".join(line for line in lines if line)


def _report(controller: FidelityReporter, name: str, options: Options) -> None:
    note_ignored_options(controller, name, {r"\UIActiveSignal": options.get("ui_active_signal")})


_BREAKS = rf"{BREAKS} \UIActiveSignal"
_TEXT = r"\Header \Message|\MsgArray \Wrap"
_LIMITS = r"\Icon \InitValue \MinValue \MaxValue \AsInteger"

DIALOGS = table(
    routine(
        "UIMsgBox",
        ui_msg_box,
        r"\Header MsgLine1 \MsgLine2 \MsgLine3 \MsgLine4 \MsgLine5 \Wrap \Buttons \Icon \Image "
        rf"\Result {_BREAKS}",
    ),
    routine(
        "UIMessageBox",
        ui_message_box,
        rf"{_TEXT} \Buttons|\BtnArray \DefaultBtn \Icon \Image {_BREAKS}",
    ),
    routine("UINumEntry", ui_num_entry, rf"{_TEXT} {_LIMITS} {_BREAKS}"),
    routine("UIDnumEntry", ui_dnum_entry, rf"{_TEXT} {_LIMITS} {_BREAKS}"),
    routine("UIAlphaEntry", ui_alpha_entry, rf"{_TEXT} \Icon \InitString {_BREAKS}"),
    routine(
        "UINumTune",
        ui_num_tune,
        rf"{_TEXT} \Icon InitValue Increment \MinValue \MaxValue {_BREAKS}",
    ),
    routine(
        "UIDnumTune",
        ui_dnum_tune,
        rf"{_TEXT} \Icon InitValue Increment \MinValue \MaxValue {_BREAKS}",
    ),
    routine(
        "UIMsgWrite",
        ui_msg_write,
        r"Header Message \Wrap \Icon \Image \PersBool|\PersBoolName \AbortValue \UIActiveSignal",
        does=Trait.TELL,
    ),
    routine("UIMsgWriteAbort", ui_msg_write_abort, does=Trait.TELL),
    routine(
        "UIListView",
        ui_list_view,
        rf"\Result \Header ListItems \Buttons|\BtnArray \Icon \DefaultIndex {_BREAKS}",
    ),
)
