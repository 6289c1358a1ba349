"""The programs with two robots: each waits for the other, and what both carry keeps its length."""

from pathlib import Path

import numpy as np
import pytest

from rapidsim.cli.inputs import all_tasks, choose_station
from rapidsim.frames.transform import Array
from rapidsim.motion.robot import load_robot
from rapidsim.simulation.cell_tasks import task_setups
from rapidsim.simulation.load_tasks import load_tasks
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.result import RobotRun, Simulation
from rapidsim.simulation.simulate import simulate_tasks

PROGRAMS = Path(__file__).parents[2] / "programs"


def ran(program: str) -> Simulation:
    paths = [str(PROGRAMS / program / "Left.mod")]
    station = choose_station(paths, None)
    loaded = load_tasks(all_tasks(paths, station))
    setups = task_setups(loaded.tasks, station, load_robot(station.robot or ""), load_robot)
    return simulate_tasks(setups, RunOptions(model=station.model, io=station.io))


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
    assert np.abs(beam - [0.3, 0.0, 0.0]).max() < 1e-8
    way = np.ptp(tcp(left, times), axis=0)
    assert way == pytest.approx([0.0, 0.25, 0.25], abs=0.01)


def test_robots_that_share_a_place_take_turns() -> None:
    run = ran("two_robots")
    assert run.end == "ended"
    times = np.arange(0.0, run.time_s, 0.05)
    left, right = (tcp(robot, times) for robot in run.robots)
    assert np.linalg.norm(left - right, axis=1).min() > 0.1
