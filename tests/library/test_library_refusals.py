"""What routines refuse at once, and the nearest that they still accept."""

from __future__ import annotations

from typing import Any

import pytest
from library_controller import RecordingController

from rapidsim.language.data import TOOL0, SpeedData
from rapidsim.language.errors import NotAllowed
from rapidsim.language.reference import Box

REFUSED: list[tuple[str, tuple[Any, ...], dict[str, Any], str]] = [
    ("AccSet", (0.0, 50.0), {}, "AccSet 0,50: both must be greater than 0 and at most 100"),
    ("AccSet", (50.0, 0.0), {}, "AccSet 50,0: both must be"),
    ("AccSet", (100.5, 50.0), {}, "AccSet 100.5,50: both must be"),
    ("AccSet", (50.0, 101.0), {}, "AccSet 50,101: both must be"),
    ("VelSet", (0.0, 800.0), {}, "VelSet 0,800: both must be greater than 0"),
    ("VelSet", (50.0, 0.0), {}, "VelSet 50,0: both must be greater than 0"),
    ("TPReadFK", (Box(0.0), "?", "", "", "", "", ""), {}, "TPReadFK has no text for any key"),
    ("ProcerrRecovery", (), {}, r"ProcerrRecovery needs \\SyncOrgMoveInst or"),
    ("FSSize", ("HOME:",), {}, r"FSSize needs \\Total or \\Free"),
    ("GetTrapData", (Box(None),), {}, "GetTrapData can be used in a trap only"),
]


@pytest.mark.parametrize(("name", "arguments", "options", "message"), REFUSED)
def test_what_a_routine_does_not_take(
    name: str, arguments: tuple[Any, ...], options: dict[str, Any], message: str
) -> None:
    controller = RecordingController()
    with pytest.raises(NotAllowed, match=message):
        controller.call(name, *arguments, **options)
    assert controller.log == []


def test_the_largest_and_the_smallest_that_are_taken() -> None:
    controller = RecordingController()
    controller.call("AccSet", 100.0, 100.0)
    controller.call("AccSet", 0.5, 0.5)
    controller.call("VelSet", 0.1, 0.1)
    controller.choice = 4
    key: Box[float] = Box(0.0)
    controller.call("TPReadFK", key, "?", "", "", "", "", "E")
    assert key.value == 5.0


@pytest.mark.parametrize(("speed", "stops"), [(100.0, True), (101.0, False)])
def test_only_a_slow_search_leaves_its_path(speed: float, stops: bool) -> None:
    controller = RecordingController()
    found: Box[Any] = Box(None)
    target = controller.current_target(TOOL0, None)
    fast = SpeedData(speed, 500.0, 5000.0, 1000.0)
    signal: Box[Any] = Box("di1")
    arguments = (signal, found, target, fast, Box(TOOL0))
    if stops:
        controller.call("SearchL", *arguments, stop=True)
        assert len(controller.moves) == 1
    else:
        with pytest.raises(NotAllowed, match="Stop"):
            controller.call("SearchL", *arguments, stop=True)
        assert controller.moves == []
    controller.call("SearchL", *arguments, sup=True)
