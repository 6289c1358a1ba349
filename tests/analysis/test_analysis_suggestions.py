"""Which known name is suggested, and when a name is held to be a slip of the keyboard."""

import pytest

from rapidsim.analysis.suggestions import closest, is_slip

SLIPS = [
    ("pPcik", "pPick"),
    ("WaitUntill", "WaitUntil"),
    ("TPWrit", "TPWrite"),
    ("ENDPORC", "ENDPROC"),
    ("movel_safe_postion", "movel_safe_position"),
    ("ReutrnHome", "ReturnHome"),
]
RELATIVES = [
    ("Pick2", "Pick1"),
    ("p10", "p20"),
    ("MoveX", "MoveL"),
    ("GripperB", "GripperA"),
    ("rPick", "Pick"),
    ("Gripper", "GripperA"),
    ("OpenGripper_2", "OpenGripper_1"),
    ("ArcL", "ArcC"),
]


@pytest.mark.parametrize(("written", "meant"), SLIPS)
def test_slips_are_seen(written: str, meant: str) -> None:
    assert is_slip(written, meant)


@pytest.mark.parametrize(("written", "other"), RELATIVES)
def test_relatives_are_left_alone(written: str, other: str) -> None:
    assert not is_slip(written, other)


def test_the_nearest_is_suggested_and_the_first_of_equals() -> None:
    assert closest("coutn", ["Contour", "count", "court"]) == "count"
    assert closest("p1", ["p2", "p3"]) == "p2"
    assert closest("entirely", ["different"]) is None
