"""Which arm a check asks about reach, and with what main is run for moves that only a run tells."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING

from rapidsim.analysis.program import Program
from rapidsim.cli.options.inputs import RobotChoice
from rapidsim.jobs.check_files import CheckMoves
from rapidsim.reach.checked_moves import ReachReport
from rapidsim.station.station import Station

if TYPE_CHECKING:
    from rapidsim.motion.robot.robot import Robot


def choose_move_check(choice: RobotChoice, cell: Station, *, run: bool) -> CheckMoves:
    """What checks moves on the arm chosen, which is opened when the first program with moves comes.

    An arm that the user named is opened at once, so that a name that is not known is refused.
    """
    opened = cache(lambda: _opened(choice.name))
    is_named = choice.reason is None or cell.robot is not None
    if is_named:
        opened()

    def check_moves(program: Program, task: str) -> ReachReport:
        from rapidsim.frames.transform import Transform
        from rapidsim.reach.reach import check_reach
        from rapidsim.simulation.options import RunOptions

        number = cell.robot_number(task)
        robot = cell.robots[number] if cell.robots else None
        arm = _opened(robot.name) if number and robot and robot.name else opened()
        options = RunOptions(
            model=cell.model,
            start_joints_deg=robot.start_joints_deg if robot else None,
            world_from_base=robot.world_from_base if robot else Transform.identity(),
            external_axes=() if number else cell.external_axes,
            io=cell.io,
            task=task,
        )
        budget_s = cell.check.cycle_budget_s
        report = check_reach(program, arm, options, run=run, cycle_budget_s=budget_s)
        if is_named:
            return report
        # Whether the program is for the default arm nobody knows.
        assumed = tuple(replace(found, assumed=True) for found in report.diagnostics)
        return replace(report, diagnostics=assumed)

    return check_moves


def arm_and_reason(choice: RobotChoice) -> str:
    """The arm as a summary names it."""
    return choice.name if choice.reason is None else f"{choice.name} ({choice.reason})"


def _opened(name: str) -> Robot:
    from rapidsim.cli.options.robot_choice import open_robot

    return open_robot(name)
