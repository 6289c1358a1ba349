"""Moves of all kinds through the resolver: circles, turns, what is refused."""

from dataclasses import replace

import numpy as np
import pytest
from simulation_cell import DOWN, Z10, Cell, place

from rapidsim.controller.journal.stop_reasons import MoveImpossible
from rapidsim.language.data import (
    FINE,
    NO_EXTERNAL_AXES,
    TOOL0,
    WOBJ0,
    ConfData,
    JointTarget,
    Orient,
    Pos,
    RobJoint,
    RobTarget,
    SpeedData,
    ToolData,
    ZoneData,
)
from rapidsim.language.moves import Interpolation, Move

V200 = SpeedData(200.0, 500.0, 5000.0, 1000.0)


def target(x: float, y: float, z: float, rot: Orient = DOWN) -> RobTarget:
    return RobTarget(Pos(x, y, z), rot, ConfData(0, 0, 0, 0), NO_EXTERNAL_AXES)


def circle(cell: Cell, via: RobTarget, to: RobTarget, zone: ZoneData) -> None:
    cell.controller.clock.place = place("c")
    cell.controller.motion.move(
        Move("MoveC", Interpolation.CIRCLE, to, V200, zone, TOOL0, WOBJ0, circle_point=via)
    )


def test_two_half_circles_with_one_orientation_keep_it_all_the_way() -> None:
    cell = Cell()
    cell.move(1000.0, 0.0, 600.0, zone=FINE, kind=Interpolation.JOINT)
    circle(cell, target(900.0, 100.0, 600.0), target(800.0, 0.0, 600.0), Z10)
    circle(cell, target(900.0, -100.0, 600.0), target(1000.0, 0.0, 600.0), FINE)
    cell.controller.motion.finish()
    first = cell.moves()[1]
    times = np.linspace(first.start_s, cell.trajectory.duration, 400)
    tcp = cell.trajectory.at(times).base_from_tcp
    radius = np.linalg.norm(tcp.translation[:, :2] - np.array([0.9, 0.0]), axis=1)
    # Where two arcs of one circle meet, the corner path cuts less than a tenth of a millimetre.
    assert radius == pytest.approx(0.1, abs=1e-4)
    z_down = np.array([0.0, 0.0, -1.0])
    assert tcp.rotation[:, :, 2] == pytest.approx(np.tile(z_down, (400, 1)), abs=1e-9)
    assert tcp.rotation[:, 0, 0].max() < -0.99
    assert first.length_m == pytest.approx(np.pi * 0.1)


@pytest.mark.parametrize("size", [-0.001, -32_000.0])
def test_a_zone_below_zero_is_one_without_size(size: float) -> None:
    zone = ZoneData(False, *[size] * 6)
    cell = Cell()
    cell.move(1000.0, 0.0, 600.0, zone=zone, kind=Interpolation.JOINT)
    circle(cell, target(900.0, 100.0, 600.0), target(800.0, 0.0, 600.0), zone)
    cell.move(800.0, 0.0, 700.0, zone=FINE)
    cell.controller.motion.finish()
    moves = cell.moves()[:2]
    assert [(one.zone_m, one.corner_reason) for one in moves] == [(0.0, "zone without size")] * 2


@pytest.mark.parametrize(
    ("via", "to", "why"),
    [
        ((850.0, 50.0), (850.0, 100.0), "on one line"),
        ((850.0, 0.05), (800.0, 100.0), "from the start"),
        ((880.0, 20.0), (850.02, 0.5), "240 deg"),
    ],
)
def test_uncertain_circles_are_refused(
    via: tuple[float, float], to: tuple[float, float], why: str
) -> None:
    cell = Cell()
    cell.move(850.0, 0.0, 600.0, zone=FINE, kind=Interpolation.JOINT)
    with pytest.raises(MoveImpossible, match=why) as caught:
        circle(cell, target(*via, 600.0), target(*to, 600.0), FINE)
    assert caught.value.violation.cf == "ABB 50063"


def test_targets_out_of_reach_say_by_how_much() -> None:
    cell = Cell()
    cell.approach()
    with pytest.raises(MoveImpossible, match=r"wrist centre \d+\.\d mm beyond reach"):
        cell.move(2500.0, 0.0, 600.0)


def test_axes_past_their_limits_say_which_and_by_how_much() -> None:
    cell = Cell()
    to = JointTarget(RobJoint(0.0, 0.0, 0.0, 0.0, 30.0, 420.0), NO_EXTERNAL_AXES)
    move = Move("MoveAbsJ", Interpolation.AXES, to, V200, FINE, TOOL0, WOBJ0)
    with pytest.raises(MoveImpossible, match=r"axis 6 at 420\.0 deg, 20\.0 deg past"):
        cell.controller.motion.move(move)


def test_orientations_that_are_none_are_refused_and_sloppy_ones_reported() -> None:
    cell = Cell()
    sloppy = Move(
        "MoveJ",
        Interpolation.JOINT,
        target(800.0, 0.0, 600.0, Orient(0.0, 0.0, 1.001, 0.0)),
        V200,
        FINE,
        TOOL0,
        WOBJ0,
    )
    cell.controller.motion.move(sloppy)
    assert [d.violation.code for d in cell.journal.diagnostics()] == ["M501"]
    unset = replace(sloppy, to=target(800.0, 0.0, 600.0, Orient(0.0, 0.0, 0.0, 0.0)))
    with pytest.raises(MoveImpossible, match="length 0"):
        cell.controller.motion.move(unset)


def test_a_tool_that_nothing_moves_is_refused_in_words() -> None:
    cell = Cell()
    fixed = ToolData(False, TOOL0.tframe, TOOL0.tload)
    move = Move("MoveJ", Interpolation.JOINT, target(800.0, 0.0, 600.0), V200, FINE, fixed, WOBJ0)
    with pytest.raises(MoveImpossible, match="neither tool nor work object"):
        cell.controller.motion.move(move)
    in_hand = replace(move, tool=TOOL0, wobj=WOBJ0._replace(robhold=True))
    with pytest.raises(MoveImpossible, match="both tool and work object"):
        cell.controller.motion.move(in_hand)


def test_a_pure_turn_takes_the_time_of_its_reorientation_speed() -> None:
    cell = Cell()
    cell.approach()
    turned = Orient(0.0, 0.5**0.5, 0.5**0.5, 0.0)
    speed = SpeedData(200.0, 45.0, 5000.0, 1000.0)
    cell.controller.motion.move(
        Move(
            "MoveL",
            Interpolation.LINE,
            target(800.0, 0.0, 600.0, turned),
            speed,
            FINE,
            TOOL0,
            WOBJ0,
        )
    )
    cell.controller.motion.finish()
    turn = cell.moves()[1]
    assert turn.length_m == pytest.approx(0.0, abs=1e-9)
    assert turn.end_s - turn.start_s == pytest.approx(2.0, abs=0.25)
