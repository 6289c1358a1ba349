"""Dialogs: what is asked, and what an answer becomes."""

import pytest
from library_controller import RecordingController

from rapidsim.language import error_numbers as errors
from rapidsim.language.data import ListItem
from rapidsim.language.errors import RapidError
from rapidsim.language.reference import Box
from rapidsim.language.single_precision import single
from rapidsim.library.predefined import DATA


@pytest.fixture
def controller() -> RecordingController:
    return RecordingController()


def value(name: str) -> object:
    return DATA[name.lower()].value


@pytest.mark.parametrize(
    ("buttons", "choice", "result"),
    [
        ("btnOK", 0, "resOK"),
        ("btnAbrtRtryIgn", 0, "resAbort"),
        ("btnAbrtRtryIgn", 1, "resRetry"),
        ("btnAbrtRtryIgn", 2, "resIgnore"),
        ("btnOKCancel", 1, "resCancel"),
        ("btnRetryCancel", 0, "resRetry"),
        ("btnYesNo", 0, "resYes"),
        ("btnYesNo", 1, "resNo"),
        ("btnYesNoCancel", 2, "resCancel"),
    ],
)
def test_buttons(controller: RecordingController, buttons: str, choice: int, result: str) -> None:
    controller.choice = choice
    pressed: Box[float] = Box(0.0)
    controller.call("UIMsgBox", "Go on?", buttons=value(buttons), result=pressed)
    assert pressed.value == value(result)
    assert controller.call("UIMessageBox", message="?", buttons=value(buttons)) == value(result)


@pytest.mark.parametrize("buttons", [6.0, 99.0, -2.0])
def test_buttons_of_another_number_are_ok_alone(
    controller: RecordingController, buttons: float
) -> None:
    pressed: Box[float] = Box(0.0)
    controller.call("UIMsgBox", "Go on?", buttons=buttons, result=pressed)
    assert pressed.value == value("resOK")
    assert controller.log == ["Go on? OK"]
    assert controller.call("UIMessageBox", message="?", buttons=value("btnNone")) == 0.0


def test_message_boxes(controller: RecordingController) -> None:
    controller.call("UIMsgBox", "line 1", header="Cell", msg_line2="line 2")
    controller.call("UIMsgBox", "only shown", buttons=value("btnNone"))
    controller.choice = 1
    own = controller.call("UIMessageBox", msg_array=["a", "b"], btn_array=["Left", "Right"])
    assert own == 2.0
    assert controller.log == ["Cell / line 1 / line 2 OK", "show only shown", "a / b Left|Right"]
    assert not controller.unsimulated


def test_a_dialog_may_end_without_an_answer(controller: RecordingController) -> None:
    flag: Box[float] = Box(9.0)
    controller.call("UIMessageBox", message="?", max_time=5.0, break_flag=flag)
    assert flag.value == 0.0
    controller.nobody = True
    controller.call("UIMessageBox", message="?", max_time=5.0, break_flag=flag)
    assert flag.value == errors.ERR_TP_MAXTIME
    with pytest.raises(RapidError, match="no answer within 5 s"):
        controller.call("UINumEntry", message="?", max_time=5.0)
    assert controller.call("UINumEntry", init_value=3.0, max_time=5.0, break_flag=flag) == 3.0


def test_numbers_are_kept_within_their_limits(controller: RecordingController) -> None:
    controller.number = 0.1
    assert controller.call("UINumEntry", message="?") == single(0.1)
    assert controller.call("UIDnumEntry", message="?") == 0.1
    assert not controller.unsimulated
    controller.number = 12.4
    assert controller.call("UINumEntry", message="?", max_value=10.0) == 10.0
    assert controller.call("UINumEntry", message="?", as_integer=True) == 12.0
    assert controller.unsimulated == [
        ("UINumEntry with the answer 12.4", "10"),
        ("UINumEntry with the answer 12.4", "12"),
    ]


@pytest.mark.parametrize(
    ("options", "errno"),
    [
        ({"min_value": 2.0, "max_value": 1.0}, errors.ERR_UI_MAXMIN),
        ({"init_value": 5.0, "max_value": 1.0}, errors.ERR_UI_INITVALUE),
    ],
)
def test_limits_that_make_no_sense(
    controller: RecordingController, options: dict[str, float], errno: float
) -> None:
    with pytest.raises(RapidError) as caught:
        controller.call("UINumEntry", message="?", **options)
    assert caught.value.errno == errno


def test_texts_and_lists(controller: RecordingController) -> None:
    assert controller.call("UIAlphaEntry", message="Name?", init_string="R2") == "R2"
    controller.text = "D2"
    assert controller.call("UIAlphaEntry", message="Name?", init_string="R2") == "D2"
    controller.choice = 1
    result: Box[float] = Box(0.0)
    items = [ListItem("", "one"), ListItem("", "two")]
    assert controller.call("UIListView", items, header="Part?", result=result) == 2.0
    assert result.value == value("resOK")
    assert controller.log[-1] == "Part? one|two"
