"""Which robot has which mechanical unit of a backup, and what its singles are."""

from __future__ import annotations

import pytest

from rapidsim.station.backup.external_units import UNIT_GROUP, _owners, _units

Group = dict[str, str]
BOTH = ("ROB_1", "ROB_2")


@pytest.mark.parametrize(
    ("groups", "labels", "owners"),
    [
        ([{"robot": "ROB_2", "mechanicalunit_1": "STN"}], BOTH, {"STN": 1}),
        ([{"robot": "ROB_1", "MechanicalUnit_1": "A", "mechanicalunit_2": "B"}], BOTH,
         {"A": 0, "B": 0}),
        ([{"robot": "ROB_2", "mechanicalunit_1": "A"}, {"robot": "ROB_1", "mechanicalunit_1": "A"}],
         BOTH, {"A": 0}),
        # A group whose robot is missing is that of the first, if no other group is.
        ([{"robot": "ROB_9", "mechanicalunit_1": "A"}], BOTH, {"A": 0}),
        ([{"robot": "ROB_9", "mechanicalunit_1": "A"}, {"robot": "ROB_2", "mechanicalunit_1": "B"}],
         BOTH, {"A": None, "B": 1}),
        ([{"mechanicalunit_1": "A"}], BOTH, {"A": None}),
        ([{"mechanicalunit_1": "A"}, {"robot": "ROB_2", "mechanicalunit_1": "A"}], BOTH, {"A": 1}),
        ([], BOTH, {}),
    ],
)  # fmt: skip
def test_a_unit_is_of_the_robot_of_its_group(
    groups: list[Group], labels: tuple[str, ...], owners: dict[str, int | None]
) -> None:
    assert _owners({UNIT_GROUP: groups}, labels) == owners


def test_a_single_of_no_unit_is_a_unit() -> None:
    motion = {
        "MECHANICAL_UNIT": [
            {"name": "STN", "use_single_0": "S1", "use_single_1": "S2", "use_single_5": "S6"},
            {"name": "NONE"},
            {"use_single_0": "S3"},
        ],
        "SINGLE": [{"name": "S1"}, {"name": "S3"}, {"name": "S4"}, {}],
    }
    assert _units(motion) == {"STN": ["S1", "S2", "S6"], "S3": ["S3"], "S4": ["S4"]}
    assert _units({}) == {}
