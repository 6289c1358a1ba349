"""Cycle times and places, from Python: `rapid` is a fixture that comes with rapidsim."""

import pytest


def test_a_box_takes_less_than_three_seconds(rapid):
    run = rapid.load("stack.mod").run()
    assert run.time_s / run.data["nPlaced"] < 3.0


def test_every_box_is_let_go_at_rest(rapid):
    run = rapid.load("stack.mod").run()
    for wait in run.waits:
        assert run.trajectory.at(wait.start_s).speed_mm_s == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(("box", "z_mm"), [(1, 80.0), (6, 80.0), (13, 240.0)])
def test_layers_are_as_high_as_boxes(rapid, box, z_mm):
    assert rapid.load("stack.mod").call("placeOf", box).trans.z == z_mm
