"""The program pointer, the path queue and the clock, driven by hand.

Source of the rules: Technical reference manual RAPID Overview, "Motion and I/O principles".
"""

from collections.abc import Callable
from itertools import cycle, pairwise

import numpy as np
import pytest
from simulation_cell import Cell

from rapidsim.controller import task_moves
from rapidsim.controller.journal.events import EventKind
from rapidsim.controller.journal.stop_reasons import TimeLimitReached, WaitsForever
from rapidsim.controller.moves.executed_move import CornerKind
from rapidsim.language.data import FINE
from rapidsim.simulation.options import RunOptions

CORNERS = [(800.0, 200.0), (1000.0, 200.0), (1000.0, 0.0), (900.0, -100.0)]


def drive_round(cell: Cell, *, look: bool) -> list[tuple[float, np.ndarray]]:
    """Round four corners; with `look`, the program asks for the time after each move."""
    cell.approach()
    seen = []
    for x, y in CORNERS:
        cell.move(x, y, 600.0)
        if look:
            now_s = cell.controller.clock.now()
            target = cell.controller.motion.current_target(None, None)
            seen.append((now_s, np.array(target.trans)))
    cell.move(800.0, 0.0, 600.0, zone=FINE)
    cell.controller.motion.finish()
    return seen


def test_looking_at_the_clock_does_not_change_the_motion() -> None:
    lazy, looked = Cell(), Cell()
    drive_round(lazy, look=False)
    drive_round(looked, look=True)
    assert len(looked.trajectory.pieces) > len(lazy.trajectory.pieces)
    for a, b in zip(lazy.moves(), looked.moves(), strict=True):
        assert a.start_s == pytest.approx(b.start_s, abs=1e-3)
        assert a.end_s == pytest.approx(b.end_s, abs=1e-3)
        assert a.zone_m == pytest.approx(b.zone_m)
        assert a.corner is b.corner
    places = np.linspace(0.0, lazy.trajectory.length, 500)
    at_a = lazy.trajectory.at(lazy.trajectory.time_at_place(places))
    at_b = looked.trajectory.at(looked.trajectory.time_at_place(places))
    gap = at_a.base_from_tcp.translation - at_b.base_from_tcp.translation
    assert np.max(np.abs(gap)) < 1e-6


def test_a_position_the_program_saw_lies_on_the_final_trajectory() -> None:
    cell = Cell()
    for time_s, position_mm in drive_round(cell, look=True):
        sample = cell.trajectory.at(np.array([time_s]))
        assert sample.base_from_tcp.translation[0] * 1e3 == pytest.approx(position_mm, abs=1e-6)


def test_after_a_fly_by_move_the_program_goes_on_when_the_robot_starts_it() -> None:
    cell = Cell()
    cell.approach()
    cell.move(800.0, 200.0, 600.0)
    cell.move(1000.0, 200.0, 600.0)
    cell.controller.concerns.signals.write_signal("doGlue", 1.0)
    cell.move(1000.0, 0.0, 600.0, zone=FINE)
    cell.controller.motion.finish()
    (event,) = [e for e in cell.journal.events() if e.kind is EventKind.SIGNAL]
    second = cell.moves()[2]
    # The output follows the command, which the arm lags behind by the smoothing.
    lag_s = second.start_s - event.time_s
    assert 0.0 < lag_s < cell.options.model.window


def test_a_long_wait_after_a_fly_by_turns_the_corner_into_a_stop() -> None:
    cell = Cell()
    cell.approach()
    cell.move(800.0, 200.0, 600.0)
    cell.controller.clock.wait(5.0)
    cell.move(1000.0, 200.0, 600.0, zone=FINE)
    cell.controller.motion.finish()
    stopped, after = cell.moves()[1:]
    assert stopped.corner is CornerKind.STOP_CORNER_PATH_FAILURE
    assert stopped.zone_m == 0.0
    rest = cell.trajectory.at(np.array([stopped.end_s]))
    assert rest.base_from_tcp.translation[0] == pytest.approx([0.8, 0.2, 0.6], abs=1e-9)
    assert after.start_s == pytest.approx(stopped.start_s + 5.0, abs=0.1)


def test_a_short_wait_after_a_fly_by_keeps_the_corner() -> None:
    cell, plain = Cell(), Cell()
    for one, wait_s in ((cell, 0.4), (plain, 0.0)):
        one.approach()
        one.move(800.0, 200.0, 600.0)
        one.controller.clock.wait(wait_s)
        one.move(1000.0, 200.0, 600.0, zone=FINE)
        one.controller.motion.finish()
    assert cell.moves()[1].corner is CornerKind.FLY_BY
    assert cell.moves()[1].zone_m == pytest.approx(0.010)
    assert cell.moves()[2].end_s == pytest.approx(plain.moves()[2].end_s, abs=1e-3)


def test_timer_interrupts_come_on_time_while_the_robot_moves() -> None:
    cell = Cell()
    controller = cell.controller
    interrupts = controller.concerns.interrupts
    seen: list[tuple[float, np.ndarray]] = []

    def trap() -> None:
        target = controller.motion.current_target(None, None)
        seen.append((controller.clock.now(), np.array(target.trans)))

    interrupts.order_timer(interrupts.connect(trap, "Read"), 0.5, single=False)
    drive_round(cell, look=False)
    times = [time_s for time_s, _ in seen]
    assert times == pytest.approx([0.5 * (k + 1) for k in range(len(times))])
    assert len(times) == int(controller.clock.end_time_s() / 0.5)
    for time_s, position_mm in seen:
        sample = cell.trajectory.at(np.array([time_s]))
        assert sample.base_from_tcp.translation[0] * 1e3 == pytest.approx(position_mm, abs=1e-6)


def test_a_trap_does_not_interrupt_a_trap_and_none_is_lost() -> None:
    cell = Cell()
    controller = cell.controller
    interrupts = controller.concerns.interrupts
    order: list[str] = []

    def slow() -> None:
        order.append(f"slow {controller.clock.now():.2f}")
        controller.clock.wait(0.35)

    def quick() -> None:
        order.append(f"quick {controller.clock.now():.2f}")

    interrupts.order_timer(interrupts.connect(slow, "slow"), 0.2, single=True)
    interrupts.order_timer(interrupts.connect(quick, "quick"), 0.3, single=True)
    controller.clock.wait(1.0)
    assert order == ["slow 0.20", "quick 0.55"]
    assert controller.clock.now() == pytest.approx(1.0)


def spin(cell: Cell) -> None:
    """A loop turn that uses up its ticks."""
    cell.controller.clock.ticks_left = -1
    cell.controller.clock.service()


@pytest.mark.parametrize(
    "act",
    [
        pytest.param(lambda cell: drive_round(cell, look=False), id="motion"),
        pytest.param(lambda cell: cell.controller.clock.wait(10.0), id="wait"),
        pytest.param(spin, id="loop"),
    ],
)
def test_the_time_limit_ends_what_would_go_on(act: Callable[[Cell], None]) -> None:
    cell = Cell(RunOptions(max_time_s=0.5))

    def forever() -> None:
        while True:
            act(cell)

    with pytest.raises(TimeLimitReached):
        forever()
    assert cell.controller.clock.end_time_s() == pytest.approx(0.5)


def test_an_endless_row_of_fly_by_moves_meets_the_time_limit(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(task_moves, "MAX_OPEN_MOVES", 100)
    cell = Cell(RunOptions(max_time_s=2.0))
    cell.approach()

    def forever() -> None:
        for x, y in cycle(CORNERS):
            cell.move(x, y, 600.0, speed=1000.0)

    with pytest.raises(TimeLimitReached):
        forever()
    assert len(cell.unit.moves) < 250


def test_a_long_row_of_fly_by_moves_is_planned_whenever_enough_are_open(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """What is fixed is no longer open: planning at each move of a long row takes for ever."""
    monkeypatch.setattr(task_moves, "MAX_OPEN_MOVES", 20)
    cell = Cell()
    cell.approach()
    pieces, still_open = [], []
    for k in range(100):
        cell.move(800.0 + 10.0 * (k % 2), -300.0 + 6.0 * k, 600.0, speed=100.0)
        pieces.append(len(cell.trajectory.pieces))
        still_open.append(cell.unit.queue.open_moves)
    assert max(still_open) == 20
    planned = np.flatnonzero(np.diff(pieces))
    assert 5 <= len(planned) <= 10
    assert np.diff(planned).min() > 10
    cell.controller.motion.finish()
    assert {move.corner for move in cell.moves()[1:-1]} == {CornerKind.FLY_BY}


def test_waiting_for_a_signal_nobody_sets_ends_the_run() -> None:
    cell = Cell()
    with pytest.raises(WaitsForever, match="diGripped"):
        cell.controller.concerns.signals.wait_for_signal("diGripped", lambda value: value == 1.0)
    assert not cell.controller.concerns.signals.wait_for_signal("diGripped", bool, max_time=2.0)
    assert cell.controller.clock.now() == pytest.approx(2.0)


def test_a_delayed_output_wakes_a_wait_at_its_instant() -> None:
    cell = Cell()
    cell.controller.concerns.signals.write_signal("doA", 1.0, delay_s=0.7)
    assert cell.controller.concerns.signals.read_signal("doA") == 0.0
    assert cell.controller.concerns.signals.wait_for_signal("doA", bool, max_time=5.0)
    assert cell.controller.clock.now() == pytest.approx(0.7)


def test_moves_follow_each_other_without_gaps_or_overlaps() -> None:
    cell = Cell()
    drive_round(cell, look=False)
    for before, after in pairwise(cell.moves()):
        assert after.start_s >= before.end_s - 1e-6
