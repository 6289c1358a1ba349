"""Picking cycles of arms against published and remembered figures; the latter bound directions."""

from __future__ import annotations

import math

import pytest

from rapidsim.jobs.running.picking_cycle import PickingCycle, picking_cycle
from rapidsim.motion.model import MODELS
from rapidsim.motion.robot.robot import load_robot

SPHERICAL = (
    "irb120-3-0.58",
    "irb120t-3-0.58",
    "irb1100-4-0.475",
    "irb1100-4-0.58",
    "irb1200-7-0.7",
    "irb1200-5-0.9",
    "irb140-6-0.81",
)


def _off(name: str, cycle: PickingCycle) -> float:
    """Logarithm of our time with fly-by low points over the known figure."""
    known = load_robot(name).picking
    assert known is not None
    return math.log(cycle.fly_by_s / known.time_s)


@pytest.mark.parametrize(
    ("name", "within"),
    [("irb910sc-3-0.65", 0.05), ("irb910sc-3-0.55", 0.2), ("irb910sc-3-0.45", 0.2)],
)
def test_scaras(name: str, within: float) -> None:
    """One of them was fitted, to the only published figure."""
    robot = load_robot(name)
    cycle = picking_cycle(robot)
    assert abs(_off(name, cycle)) < within
    assert picking_cycle(robot, MODELS["2"]).fly_by_s > 2.0 * cycle.fly_by_s


def test_spherical_wrists_come_nearer_than_with_version_2() -> None:
    cycles = {name: picking_cycle(load_robot(name)) for name in SPHERICAL}
    off = [_off(name, cycle) for name, cycle in cycles.items()]
    assert math.sqrt(sum(one * one for one in off) / len(off)) < 0.18
    assert all(cycle.fly_by_s < cycle.stop_s for cycle in cycles.values())
    before = [_off(name, picking_cycle(load_robot(name), MODELS["2"])) for name in SPHERICAL[:3]]
    assert all(old > new for old, new in zip(before, off[:3], strict=True))


def test_an_offset_wrist_comes_nearer_than_with_version_2() -> None:
    robot = load_robot("crb15000-5-0.95")
    off = _off(robot.name, picking_cycle(robot))
    assert 0.0 < off < 0.2
    assert off < _off(robot.name, picking_cycle(robot, MODELS["2"])) - 0.2
