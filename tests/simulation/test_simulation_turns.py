"""One door for time: whoever stands in it may hold virtual time up and let others act meanwhile."""

from collections.abc import Callable
from dataclasses import dataclass, field

import pytest
from simulation_cell import Cell

from rapidsim.controller.cell.cell import SingleTaskScheduler, TimeScheduler
from rapidsim.controller.journal.journal import Instant, Moment
from rapidsim.controller.journal.stop_reasons import WaitsForever
from rapidsim.language.data import FINE


@dataclass
class Posted:
    """Implements `cell.TimeScheduler`: external posts take effect at their time."""

    inner: TimeScheduler = field(default_factory=SingleTaskScheduler)
    posts: list[tuple[float, Callable[[Moment], None]]] = field(default_factory=list)
    current: object = None

    def request_advance(self, task: object, time_s: float) -> float:
        reached_s = self.inner.request_advance(task, time_s)
        if not self.posts or self.posts[0][0] > reached_s:
            return reached_s
        post_s, act = self.posts.pop(0)
        act(Moment(Instant(post_s)))
        return post_s

    def next_s(self, task: object) -> float:
        return min(self.inner.next_s(task), *(post_s for post_s, _ in self.posts[:1]), 1e9)

    def frame_of(self, task: object) -> None:
        return None

    def wake_at(self, time_s: float) -> None:
        self.inner.wake_at(time_s)

    def mark_waiting(self, task: object) -> bool:
        return not self.posts and self.inner.mark_waiting(task)


def outside(cell: Cell, *changes: tuple[float, str, float]) -> None:
    """Let somebody outside set signals at times [s]."""

    def setting(name: str, value: float) -> Callable[[Moment], None]:
        cause = cell.controller.clock.cause()

        def act(moment: Moment) -> None:
            cell.shared.set_signal(cause, moment, name, value)

        return act

    cell.shared.attach_scheduler(
        Posted(posts=[(at_s, setting(name, v)) for at_s, name, v in changes])
    )


def test_a_posted_signal_ends_a_wait_at_its_instant() -> None:
    cell = Cell()
    outside(cell, (1.47, "diGo", 1.0))
    signals, clock = cell.controller.concerns.signals, cell.controller.clock
    assert signals.wait_for_signal("diGo", bool)
    assert clock.now() == 1.47
    with pytest.raises(WaitsForever):
        signals.wait_for_signal("diStop", bool)


def test_a_post_before_the_deadline_is_in_time_and_one_after_it_is_not() -> None:
    cell = Cell()
    outside(cell, (0.5, "diGo", 1.0), (2.5, "diStop", 1.0))
    signals, clock = cell.controller.concerns.signals, cell.controller.clock
    assert signals.wait_for_signal("diGo", bool, max_time=1.0)
    assert clock.now() == 0.5
    assert not signals.wait_for_signal("diStop", bool, max_time=1.0)
    assert clock.now() == 1.5


def two_moves(*changes: tuple[float, str, float]) -> tuple[list[float], list[tuple[float, float]]]:
    """When a trap for `diPart` ran while the robot made two moves, and when it made them."""
    cell = Cell()
    heard: list[float] = []
    outside(cell, *changes)
    clock, concerns = cell.controller.clock, cell.controller.concerns
    number = concerns.interrupts.connect(lambda: heard.append(clock.now()), "Part")
    concerns.interrupts.order_signal(number, "diPart", bool, single=True)
    cell.approach()
    cell.move(800, 200, 600)
    concerns.signals.write_signal("doGlue", 1.0)
    cell.move(800, 200, 800, zone=FINE)
    return heard, [(move.start_s, move.end_s) for move in cell.moves()]


def test_a_post_interrupts_a_robot_on_its_way_which_goes_on_as_if_nothing_had_been() -> None:
    undisturbed, disturbed = two_moves(), two_moves((1.3, "diPart", 1.0))
    assert undisturbed[0] == []
    assert disturbed[0] == [1.3]
    assert disturbed[1] == undisturbed[1]
