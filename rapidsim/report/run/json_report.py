"""A run as one record of JSON, finished or rejected: finite numbers, keys in a fixed order."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Annotated, Any, ClassVar

from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.diagnostics import Diagnostic
from rapidsim.json_records.declarations import (
    Key,
    Lenient,
    OrAbsent,
    OutputRecord,
    Rounded,
    ValueForm,
)
from rapidsim.json_records.encoding import json_of
from rapidsim.report.findings.diagnostic_records import DiagnosticRecord, diagnostic_record
from rapidsim.report.findings.merging import merged
from rapidsim.report.run.belt_records import BeltRecord, belt_records
from rapidsim.report.run.collision_records import RunCollisions, run_collisions
from rapidsim.report.run.error_records import ErrorRecord, error_records
from rapidsim.report.run.figures import Figures, JointMargin, OffPath, SingularityMargin
from rapidsim.report.run.long_programs import (
    RegionRecord,
    SlowSectionRecord,
    region_record,
    slow_section_record,
)
from rapidsim.report.run.records import MoveRecord, WaitRecord, move_records, wait_records
from rapidsim.report.run.run_models import RunModels, models
from rapidsim.report.run.timings import RunTimings
from rapidsim.report.run.verdicts import (
    NOTHING_ASKED,
    AssertionVerdict,
    BudgetVerdict,
    Verdicts,
)
from rapidsim.simulation.results.event_values import EventRecord, event_record
from rapidsim.simulation.results.regions import by_comment
from rapidsim.simulation.results.simulation import End, Simulation, WrittenFile
from rapidsim.simulation.results.slow_sections import slow_sections
from rapidsim.simulation.results.time_shares import Share
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class StationedRobot:
    """A robot of a cell with several."""

    task: str
    """Task that moves it."""
    robot: str
    position_mm: tuple[Rounded, ...]
    """Position of its base in the world."""
    quaternion: tuple[Rounded, ...]
    """Orientation of its base in the world, scalar first."""


@value_class(frozen=True, slots=True)
class SlowMove:
    """The moves of a line."""

    file: str
    line: int
    routine: str
    instruction: str
    to: str
    """The target as the program writes it."""
    time_s: Rounded
    times: int
    """Number of executions."""


@value_class(frozen=True, slots=True)
class SlowWait:
    """The waits of a line."""

    file: str
    line: int
    routine: str
    instruction: str
    awaited: Annotated[str, Key("for")]
    """Condition as the program writes it."""
    time_s: Rounded
    times: int
    """Number of executions."""


@value_class(frozen=True, slots=True)
class MomentOfMove:
    """An instant during a move."""

    time_s: Rounded
    move: int
    """Index in `moves`."""
    file: str
    line: int


@value_class(frozen=True, slots=True)
class LeastJointMargin:
    """Least margin of a joint to its limit."""

    margin_deg: Rounded
    """In mm for a joint that slides; negative beyond the limit."""
    joint: int
    """Number of the joint, from 1."""
    moment: Annotated[MomentOfMove, ValueForm.INLINE]


@value_class(frozen=True, slots=True)
class LeastSingularValue:
    """Least distance from a singularity."""

    smallest_singular_value: Rounded
    """Singular value of the flange's Jacobian in m and rad; 0 in a singularity."""
    moment: Annotated[MomentOfMove, ValueForm.INLINE]


@value_class(frozen=True, slots=True)
class GreatestOffPath:
    """Greatest distance of the TCP from the commanded path, due to smoothing."""

    distance_mm: Rounded
    moment: Annotated[MomentOfMove, ValueForm.INLINE]


@value_class(frozen=True, slots=True)
class SkippedRoutine:
    """A routine that no module declares."""

    name: str
    count: int
    """Number of skipped calls."""


@value_class(frozen=True, slots=True)
class UnsimulatedRoutine:
    """A routine of RAPID that is not simulated."""

    name: str
    count: int
    """Number of calls."""
    treated_as: str
    """Effect of a call."""


@value_class(frozen=True, slots=True)
class PersistentRecord:
    """A persistent whose final value differs from its declaration."""

    name: str
    module: str
    old: str
    """Declared value, as RAPID text."""
    new: str
    """Final value, as RAPID text."""


@value_class(frozen=True, slots=True)
class RunFiles:
    """Paths of the files written, by kind."""

    recording: OrAbsent[str] = None
    report: OrAbsent[str] = None
    plots: OrAbsent[str] = None
    """A folder."""
    trace: OrAbsent[str] = None
    events: OrAbsent[str] = None
    profile: OrAbsent[str] = None
    program: OrAbsent[tuple[str, ...]] = None
    """Files of the program into which values of persistents were written."""
    home: OrAbsent[tuple[WrittenFile, ...]] = None
    """Files of the home folder that the program wrote."""


@value_class(frozen=True, slots=True)
class RunReport(OutputRecord):
    """The object of `rapidsim run --format json`; by default that of a rejected program."""

    schema: ClassVar[int] = 3
    program: tuple[str, ...]
    """Files, as the user named them."""
    robot: Lenient[str]
    """The arm; of several robots, the first."""
    robots: OrAbsent[tuple[StationedRobot, ...]] = None
    """Robots with their tasks and bases; absent if there is only one."""
    conveyors: OrAbsent[tuple[BeltRecord, ...]] = None
    """Belts of the cell; absent if there are none."""
    ok: bool = False
    """Whether the run succeeded: the exit code is 0."""
    qualifications: tuple[str, ...] = ()
    """Reservations about the result."""
    end: End = End.ERROR
    """Reason for the end of the run."""
    time_s: Rounded = 0.0
    motion_s: Rounded = 0.0
    """Time during which a robot moves."""
    wait_s: Rounded = 0.0
    """The remaining time."""
    path_mm: Rounded = 0.0
    """Distance travelled by the TCP, corners cut."""
    moves: tuple[MoveRecord, ...] = ()
    slowest: tuple[SlowMove, ...] = ()
    """Lines whose moves took longest."""
    min_joint_margin: LeastJointMargin | None = None
    min_singularity: LeastSingularValue | None = None
    max_off_path: GreatestOffPath | None = None
    """Null if the arm stays on its path."""
    diagnostics: Lenient[tuple[DiagnosticRecord, ...]] = ()
    waits: Lenient[tuple[WaitRecord, ...]] = ()
    slowest_waits: tuple[SlowWait, ...] = ()
    """Lines that waited longest."""
    stretches: tuple[SlowSectionRecord, ...] = ()
    """Sections in which the TCP stays below its programmed speed; the most expensive first, 200 at
    most."""
    regions: tuple[RegionRecord, ...] = ()
    """Time of moves and waits after each comment of a routine, the longest first."""
    events: tuple[EventRecord, ...] = ()
    errors: tuple[ErrorRecord, ...] = ()
    """Errors of the program and their outcomes, merged by place, ERROR clause and outcome."""
    unsimulated: tuple[UnsimulatedRoutine, ...] = ()
    """Routines that were called and not simulated."""
    skipped: tuple[SkippedRoutine, ...] = ()
    """Routines that no module declares, whose calls were skipped."""
    persistents: tuple[PersistentRecord, ...] = ()
    """Persistents whose final values differ from their declarations."""
    assertions: tuple[AssertionVerdict, ...] = ()
    cycle_budget: BudgetVerdict | None = None
    models: Lenient[RunModels] = RunModels()
    timings: OrAbsent[RunTimings] = None
    """Processor time by parts, with `--timings` only."""
    files: RunFiles = RunFiles()
    cell: Annotated[RunCollisions | None, ValueForm.INLINE] = None


def run_json(
    simulation: Simulation,
    figures: Figures,
    findings: Sequence[Diagnostic],
    files: RunFiles,
    judgement: Verdicts = NOTHING_ASKED,
    timings: RunTimings | None = None,
) -> dict[str, Any]:
    """The object that `rapidsim run --format json` prints."""
    report = run_report(simulation, figures, findings, files, judgement)
    return json_of(replace(report, timings=timings))


def run_report(
    simulation: Simulation,
    figures: Figures,
    findings: Sequence[Diagnostic],
    files: RunFiles,
    judgement: Verdicts = NOTHING_ASKED,
) -> RunReport:
    """The record of a run.

    Args:
        simulation: The run.
        figures: Its figures.
        findings: Findings of the check and of the run.
        files: Paths of the files written.
        judgement: Verdicts on assertions and the cycle budget.
    """
    verdict = judgement.verdict_of(simulation)
    times = {f"{other.factor:g}": other.time_s for other in figures.sensitivity}
    return replace(
        course_report(simulation, findings),
        ok=verdict.ok,
        qualifications=tuple(verdict.qualifications),
        slowest=tuple(SlowMove(*_share(share)) for share in figures.slowest),
        min_joint_margin=_margin(figures.joint_margin),
        min_singularity=_singularity(figures.singularity),
        max_off_path=_off_path(figures.off_path),
        slowest_waits=tuple(SlowWait(*_share(share)) for share in figures.slowest_waits),
        stretches=tuple(map(slow_section_record, slow_sections(simulation))),
        regions=tuple(map(region_record, by_comment(simulation.moves, simulation.waits))),
        unsimulated=tuple(
            UnsimulatedRoutine(one.name, one.count, one.treated_as)
            for one in simulation.unsimulated
        ),
        skipped=tuple(SkippedRoutine(one.name, one.count) for one in simulation.skipped),
        persistents=tuple(
            PersistentRecord(one.name, one.module, one.old, one.new)
            for one in simulation.persistents
        ),
        assertions=judgement.assertions,
        cycle_budget=judgement.budget,
        models=models(simulation, times),
        files=replace(files, home=simulation.home_files),
        cell=run_collisions(simulation),
    )


def course_report(simulation: Simulation, findings: Sequence[Diagnostic]) -> RunReport:
    """The record with events and moves, without the figures, which take long.

    It is what two runs are compared by.
    """
    first = simulation.robots[0].robot.name
    return replace(
        rejected_report(simulation.program, first, findings),
        robots=_robots(simulation) or None,
        conveyors=belt_records(simulation) or None,
        end=simulation.end,
        time_s=simulation.time_s,
        motion_s=simulation.motion_s,
        wait_s=simulation.wait_s,
        path_mm=simulation.path_m * 1000.0,
        moves=move_records(simulation),
        waits=wait_records(simulation),
        events=tuple(map(event_record, simulation.events)),
        errors=error_records(simulation),
        models=models(simulation),
    )


def rejected_report(
    program: Sequence[str], robot: str, findings: Sequence[Diagnostic]
) -> RunReport:
    """The record for a program that cannot run because of its errors."""
    diagnostics = tuple(map(diagnostic_record, merged(findings)))
    return RunReport(program=tuple(program), robot=robot, diagnostics=diagnostics)


def _robots(simulation: Simulation) -> tuple[StationedRobot, ...]:
    """Robots with their tasks and base frames; empty if there is only one robot."""
    if len(simulation.robots) == 1:
        return ()
    return tuple(
        StationedRobot(
            task=one.task,
            robot=one.robot.name,
            position_mm=tuple(x * 1000.0 for x in one.world_from_base.translation),
            quaternion=tuple(one.world_from_base.quaternion),
        )
        for one in simulation.robots
    )


def _share(share: Share) -> tuple[str, int, str, str, str, float, int]:
    span, routine = share.place.span, share.place.routine
    what = share.instruction, share.goal, share.seconds, share.times
    return (span.file, span.line, routine, *what)


def _moment(time_s: float, move: ExecutedMove) -> MomentOfMove:
    return MomentOfMove(time_s, move.index, move.place.span.file, move.place.span.line)


def _margin(margin: JointMargin | None) -> LeastJointMargin | None:
    if margin is None:
        return None
    return LeastJointMargin(margin.degrees, margin.joint, _moment(margin.time_s, margin.move))


def _singularity(least: SingularityMargin | None) -> LeastSingularValue | None:
    if least is None:
        return None
    return LeastSingularValue(least.smallest_singular_value, _moment(least.time_s, least.move))


def _off_path(off: OffPath | None) -> GreatestOffPath | None:
    return None if off is None else GreatestOffPath(off.mm, _moment(off.time_s, off.move))
