"""Choice of the arm that suits the targets best, for a job without a named arm."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from rapidsim.analysis.program import Program
from rapidsim.jobs.inputs.job import Job
from rapidsim.jobs.inputs.robot_choice import DEFAULT_ROBOT, RobotChoice

if TYPE_CHECKING:
    from rapidsim.reach.arm_ranking import ProgramTargets, RankedArm

_RUNNERS_UP = 3
_NAMED_PARTS = 4
_STATIONS = (".rsstn", ".rspag", ".pgf")


def with_best_arm(job: Job, programs: Sequence[Program]) -> Job:
    """Return the job with the arm that suits the targets of its programs, if none is named.

    The default arm is kept if it reaches all targets as stored and no text names another arm.

    Raises:
        RunNotFollowedError: See `walk_program`.
    """
    if job.is_arm_named or job.unknown_arm or not programs:
        return job
    # Most jobs name their arm, and a program without moves does not import one.
    from rapidsim.motion.robot.robot import load_robot
    from rapidsim.reach.arm_ranking import hints_of, rank_arms, ranked_arm

    found = job_targets(job, programs)
    if not found.count:
        return job
    hints = hints_of(texts_of(job), names_of(job))
    usual = ranked_arm(load_robot(DEFAULT_ROBOT), found)
    if not hints and usual.makes_all:
        return job
    ranked = rank_arms(found, hints, DEFAULT_ROBOT)
    best = ranked[0]
    if best.reached == 0 or (best.name == DEFAULT_ROBOT and not best.deviation):
        return job
    return replace(job, robot=RobotChoice(best.name, _reason(job, ranked)))


def job_targets(job: Job, programs: Sequence[Program]) -> ProgramTargets:
    """Return the targets of a job's programs, in the base of its first robot."""
    from rapidsim.frames.transform import Transform
    from rapidsim.reach.arm_ranking import program_targets

    place = job.station.world_from_base or Transform.identity()
    has_axis_a = any(axis.letter == "a" for axis in job.station.external_axes)
    return program_targets(programs, place.inverse(), has_axis_a=has_axis_a)


def texts_of(job: Job) -> tuple[str, ...]:
    """Return the texts that may name the arm: those of files, and the type in a backup."""
    types = (named for robot in job.station.robots if (named := robot.unknown or robot.name))
    return (*types, *(file.text for file in job.files))


def names_of(job: Job) -> tuple[str, ...]:
    """Return the names that may name the arm: those of files, folders, tasks and stations.

    The folders are those from three levels above the path down to the files.
    A RobotStudio file next to the path, or in the folder above, is a station.
    """
    names: dict[str, None] = {}
    for path in job.request.paths:
        place = Path(path).resolve()
        folder = place if place.is_dir() else place.parent
        stations = (entry.name for above in (folder, folder.parent) for entry in _entries(above))
        names |= dict.fromkeys(place.parts[-_NAMED_PARTS:])
        names |= dict.fromkeys(name for name in stations if name.lower().endswith(_STATIONS))
        for file in job.files:
            with suppress(ValueError):
                names |= dict.fromkeys(Path(file.name).resolve().relative_to(folder).parts)
    names |= dict.fromkeys(task.name for task in job.tasks if task.name)
    return tuple(names)


def _entries(folder: Path) -> Sequence[Path]:
    """Return the entries of a folder; empty if it cannot be read."""
    try:
        return sorted(folder.iterdir())
    except OSError:
        return ()


def _reason(job: Job, ranked: Sequence[RankedArm]) -> str:
    first = next(iter(job.station.robots), None)
    lacking = f"the catalogue has no {first.unknown}; " if first and first.unknown else ""
    best, *others = ranked
    counts = f"{best.reached} of {best.tried} targets reached, {best.satisfied} as stored"
    next_ones = ", ".join(
        f"{one.name} {one.reached}/{one.satisfied}" for one in others[:_RUNNERS_UP]
    )
    return f"{lacking}best of the catalogue: {counts}; next {next_ones}; --robot names another"
