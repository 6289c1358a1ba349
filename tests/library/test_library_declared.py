"""Routines that are declared and not simulated: what a run says it does in place of them."""

from __future__ import annotations

import pytest
from library_controller import RecordingController

from rapidsim.language.data import Pose
from rapidsim.library.catalogue import ROUTINES
from rapidsim.library.declared import read_declared


@pytest.mark.parametrize(
    ("name", "treated_as"),
    [
        ("Search_Part", "skipped"),
        ("STIsCalib", "returns FALSE"),
        ("STCalcForce", "returns 0"),
        ("SafetyControllerGetChecksum", 'returns ""'),
        ("CalcRotAxisFrame", "returns [[0,0,0],[0,0,0,0]]"),
        ("SoftAct", "accepted without effect: axes stay stiff"),
        ("SpotL", "MoveL"),
    ],
)
def test_a_run_says_what_is_done_instead(name: str, treated_as: str) -> None:
    row = read_declared()[name.lower()]
    assert (row.name, row.treated_as) == (name, treated_as)
    assert ROUTINES[name.lower()] is row


def test_a_function_returns_the_initial_value_of_its_type_and_says_so() -> None:
    controller = RecordingController()
    assert controller.call("STIsCalib") is False
    assert controller.call("STCalcForce") == 0.0
    assert controller.call("Search_Part") is None
    pose = controller.call("PoseAdd")
    assert isinstance(pose, Pose)
    assert controller.unsimulated == [
        ("STIsCalib", "returns FALSE"),
        ("STCalcForce", "returns 0"),
        ("Search_Part", "skipped"),
        ("PoseAdd", "returns [[0,0,0],[0,0,0,0]]"),
    ]


def test_what_the_interpreter_carries_out_is_not_called() -> None:
    row = read_declared()["argname"]
    assert row.treated_as is None
    with pytest.raises(AssertionError, match="ArgName is carried out by the interpreter"):
        row.body()
