"""What the instructions of servo grippers refuse before anything moves."""

from __future__ import annotations

from typing import Any

import pytest

from rapidsim.language.errors import NotAllowed
from rapidsim.library.catalogue import ROUTINES


class Gripper:
    """Keeps what it is adjusted to."""

    def __init__(self) -> None:
        self.adjusted: list[dict[str, Any]] = []

    def adjust(self, **settings: Any) -> None:
        self.adjusted.append(settings)


@pytest.mark.parametrize(
    ("name", "options", "said"),
    [
        ("g_Init", {"max_spd": 0.0}, "maxSpd of the gripper is 0; it must be greater than 0"),
        ("g_Init", {"phy_limit": -1.0}, "phyLimit of the gripper is -1; it must be greater than"),
        ("Hand_Initialize", {"phy_limit": 0.0}, "phyLimit of the gripper is 0; it must be"),
    ],
)
def test_a_gripper_needs_a_speed_and_a_limit(
    name: str, options: dict[str, float], said: str
) -> None:
    gripper = Gripper()
    with pytest.raises(NotAllowed, match=said):
        ROUTINES[name.lower()].body(gripper, **options)
    assert gripper.adjusted == []
    ROUTINES[name.lower()].body(gripper, max_spd=5.0, hold_force=0.0, phy_limit=1.0)
    assert gripper.adjusted == [{"speed_mm_s": 5.0, "force_n": 0.0, "limit_mm": 1.0}]
