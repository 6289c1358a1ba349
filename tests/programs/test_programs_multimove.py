"""The programs with two robots: each waits for the other, and what both carry keeps its length."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest

import rapidsim
from rapidsim.controller.moves.queued_move import QueuedMove
from rapidsim.controller.queue.motion_queue import MotionQueue
from rapidsim.controller.task_moves import TaskMoves
from rapidsim.frames.transform import Array
from rapidsim.language.moves import Move
from rapidsim.simulation.results.simulation import RobotRun, Simulation

PROGRAMS = Path(__file__).parents[2] / "programs"


def ran(program: str) -> Simulation:
    return rapidsim.simulate([PROGRAMS / program / "Left.mod"])


def tcp(robot: RobotRun, times: Array) -> Array:
    """Positions of the TCP in the world, shape (k, 3) [m]."""
    base_from_tcp = robot.trajectory.at(times).base_from_tcp
    return (robot.world_from_base @ base_from_tcp).translation


def test_a_beam_that_two_robots_carry_keeps_its_length() -> None:
    run = ran("multimove")
    left, right = run.robots
    carried = [move for move in left.moves if move.move.sync_id is not None]
    times = np.linspace(carried[0].start_s, carried[-1].end_s, 400)
    beam = tcp(right, times) - tcp(left, times)
    assert run.end == "ended"
    # Each axis of either robot is smoothed by itself: 17 um.
    assert np.abs(beam - [0.3, 0.0, 0.0]).max() < 2e-5
    way = np.ptp(tcp(left, times), axis=0)
    assert way == pytest.approx([0.0, 0.25, 0.25], abs=0.01)


def test_robots_that_share_a_place_take_turns() -> None:
    run = ran("two_robots")
    assert run.end == "ended"
    times = np.arange(0.0, run.time_s, 0.05)
    left, right = (tcp(robot, times) for robot in run.robots)
    assert np.linalg.norm(left - right, axis=1).min() > 0.1


@pytest.mark.parametrize("program", ["two_robots", "multimove"])
def test_looking_ahead_after_every_move_changes_nothing(
    program: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Planning is tentative, for robots that wait for each other and for those that move as one."""
    plain = ran(program)
    put, append = TaskMoves.put, MotionQueue.append
    looked: list[object] = []

    def put_and_look(
        self: TaskMoves, move: Move, before: Callable[[QueuedMove], None], *, wait: bool = True
    ) -> None:
        def look(queued: QueuedMove) -> None:
            before(queued)
            looked.append(self.unit.preview())

        put(self, move, look, wait=wait)

    def append_and_look(self: MotionQueue, parts: Sequence[QueuedMove], now_s: float) -> None:
        append(self, parts, now_s)
        looked.append(self.preview(0))

    monkeypatch.setattr(TaskMoves, "put", put_and_look)
    monkeypatch.setattr(MotionQueue, "append", append_and_look)
    other = ran(program)
    assert len(looked) > len(plain.robots[0].moves)
    assert [(e.time_s, e.message) for e in other.events] == [
        (e.time_s, e.message) for e in plain.events
    ]
    times = np.arange(0.0, plain.time_s, 0.01)
    for one, same in zip(plain.robots, other.robots, strict=True):
        assert np.array_equal(one.trajectory.at(times).joints, same.trajectory.at(times).joints)
