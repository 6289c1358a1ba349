"""Arm with which a check examines the moves of a task, and the options for running main."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from functools import cache
from typing import Protocol

from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Diagnostic
from rapidsim.findings.runs import is_of_runs
from rapidsim.jobs.checking.target_attribution import attribute_to_targets
from rapidsim.jobs.inputs.job import Job
from rapidsim.reach.checked_moves import ReachReport


class CheckMoves(Protocol):
    """Check of the moves of a program."""

    def __call__(self, program: Program, task: str, *, runs: bool) -> ReachReport | str:
        """Check the moves on the robot of a task, or return the reason why not.

        Args:
            program: A program without errors.
            task: Name of the task.
            runs: Whether main may be run.
        """
        ...


def choose_move_check(job: Job) -> CheckMoves | None:
    """Return the check of moves on the arms of a job; None if not requested.

    An arm is loaded for the first program with moves, but immediately if the user named it, so that
    an unknown name is an error.
    """
    opened = cache(job.arm)
    station = job.station
    if job.is_arm_named:
        opened()

    def check_moves(program: Program, task: str, *, runs: bool) -> ReachReport | str:
        from rapidsim.jobs.inputs.run_options import run_options
        from rapidsim.reach.reach import check_reach
        from rapidsim.station.robot import StationRobot

        number = station.robot_number(task)
        if station.robots and number >= len(station.robots):
            return f"{task} moves none of the robots: there are {len(station.robots)}"
        robot = station.robots[number] if station.robots else StationRobot()
        if robot is job.unknown_arm:
            return f"arm unknown: the catalogue has no {robot.unknown}; --robot names another"
        if robot.carried_by and not station.external_axes:
            return f"{robot.label} is mounted on {robot.carried_by}, whose axes are not known"
        is_further = number > 0 and bool(station.robots)
        if is_further and robot.name:
            arm = robot.fitted(job.open_robot(robot.name, robot.scale))
        else:
            arm = opened()
        options = replace(
            run_options(job),
            start_joints_deg=robot.start_joints_deg,
            world_from_base=robot.world_from_base,
            external_axes=robot.external if is_further else station.external_axes,
            task=task,
            entry=job.entry(task),
            queue=next((one.queue for one in station.tasks if one.name == task), None),
        )
        is_stand_in = bool(robot.unknown) and job.request.robot is None
        is_guess = is_stand_in or not job.is_arm_named
        budget_s = station.check.cycle_budget_s
        trial_run = job.request.trial_run and runs
        report = check_reach(
            program,
            arm,
            options,
            run=trial_run,
            cycle_budget_s=budget_s,
            by_default=is_guess,
        )
        # Findings of a run of main refer to the instruction.
        pointed = attribute_to_targets(report.diagnostics, (program,))
        found = of_unnamed_arm(pointed) if is_guess else pointed
        return replace(report, diagnostics=found)

    return check_moves if job.request.reach else None


def of_unnamed_arm(findings: Iterable[Diagnostic]) -> tuple[Diagnostic, ...]:
    """Mark findings as assumed, for a program that may be meant for another arm.

    Errors that end a run do not depend on the arm.
    """
    return tuple(one if is_of_runs(one) else replace(one, assumed=True) for one in findings)
