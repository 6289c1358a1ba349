"""`rapidsim.check`: find the errors in the files of a job without running it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from os import PathLike
from typing import TYPE_CHECKING, TypeAlias

from rapidsim.analysis.can_fail import can_fail
from rapidsim.analysis.cell_names import NO_CELL, CellNames
from rapidsim.analysis.passes.checker import Find
from rapidsim.analysis.program import Program
from rapidsim.analysis.program_parts import ENTRY
from rapidsim.analysis.rules.control_flow.traps import NeverConnected
from rapidsim.analysis.rules.table import detectors_of
from rapidsim.analysis.suppressions import without_suppressed
from rapidsim.diagnostics import Diagnostic
from rapidsim.findings.collisions import is_of_cell
from rapidsim.findings.runs import EndlessWait, UncaughtError, is_of_runs
from rapidsim.jobs.checking.baseline import read_baseline
from rapidsim.jobs.checking.bulk_representatives import bulk_reading, findings_of_all
from rapidsim.jobs.checking.check_result import CheckResult
from rapidsim.jobs.checking.checked_program import LoadedProgram, load_task
from rapidsim.jobs.checking.error_free_subset import ErrorFreeSubset, error_free_subset
from rapidsim.jobs.checking.misspelt_signals import misspelt_in
from rapidsim.jobs.checking.move_checks import CheckMoves, choose_move_check
from rapidsim.jobs.checking.undriven_inputs import find_never_driven, unreported_waits
from rapidsim.jobs.checking.watched_tasks import WatchedTasks
from rapidsim.jobs.inputs.api_options import api_request
from rapidsim.jobs.inputs.job import Job, job
from rapidsim.jobs.inputs.selection import Selection, choose_selection
from rapidsim.language.error_numbers import ERR_UNKINO, event_of
from rapidsim.module_files import TaskFiles
from rapidsim.reach.checked_moves import MOST_MOVES, Coverage, ReachReport, UncheckedMove
from rapidsim.reach.dataflow.written_moves import (
    RunNotFollowedError,
    written_move_count,
    written_moves,
)
from rapidsim.station.tasks import DEFAULT_TASK
from rapidsim.syntax.garbage_collection import gc_rarely
from rapidsim.syntax.parser import may_have_runs

if TYPE_CHECKING:
    from rapidsim.motion.robot.robot import Robot
    from rapidsim.reach.trial_run import CellRun
    from rapidsim.simulation.options import RunOptions

CheckTogether: TypeAlias = "Callable[[Sequence[tuple[TaskFiles, LoadedProgram]]], CellRun | None]"
"""Returns the findings of a run of all tasks; None if such a run is impossible."""
TaskMoves: TypeAlias = Callable[[TaskFiles, LoadedProgram, Callable[[], ReachReport]], ReachReport]
"""Returns the report on the moves of a loaded task: from its function argument, or from a cache."""


def made_now(
    _task: TaskFiles, _loaded: LoadedProgram, make: Callable[[], ReachReport]
) -> ReachReport:
    """Return a new report on the moves of a task."""
    return make()


def check(
    paths: Iterable[str | PathLike[str]],
    *,
    robot: Robot | str | None = None,
    options: RunOptions | None = None,
    run: bool = True,
) -> CheckResult:
    """Check modules, program files or folders, as `rapidsim check` does.

    Args:
        paths: Paths to check; together they form one task, unless a backup or the station file
            assigns the modules to tasks. The nearest station file is used.
        robot: An arm, or its name in the catalogue; None takes that of the station or
            backup; if neither names one, the default arm, or the arm that suits the targets best.
        options: Settings that override the station file, and how main is run for moves that only a
            run determines.
        run: Whether main is run at all.

    Raises:
        InputError: If something is missing, unreadable, or not RAPID.
        RobotError: If the catalogue has no such robot.
    """
    asked = job(replace(api_request(paths, robot, options), trial_run=run))
    result, baseline = check_job(asked), asked.station.check.baseline
    return result if baseline is None else result.against(read_baseline(baseline).counts)


@gc_rarely()
def check_job(
    job: Job,
    moves_for: Callable[[Job], TaskMoves] | None = None,
    open_tasks: WatchedTasks | None = None,
) -> CheckResult:
    """Check a job with the requested rules and those of the settings.

    Args:
        job: The job.
        moves_for: Returns, for the job with its arm, what reports on the moves of each task.
        open_tasks: The tasks as they were at the last check; None checks once.
    """
    station, selection = job.station, _selection(job)
    rules = detectors_of(selection.includes)
    if open_tasks is None or _has_bulk_moves(job):
        tasks = [_loaded(task, rules, job.cell) for task in job.tasks]
    else:
        # Tasks are compared by their programs.
        has_program = job.request.reach or len(job.tasks) > 1
        tasks = [
            open_tasks.load(task, rules, job.cell, has_program=has_program) for task in job.tasks
        ]
    job, loaded = _with_arm(job, tasks, rules)
    result = check_tasks(
        job.tasks,
        rules,
        choose_move_check(job),
        even_without_moves=_checks_without_moves(job),
        cell=job.cell,
        check_cell=_cell_check(job),
        moves_of=made_now if moves_for is None else moves_for(job),
        loaded=loaded,
    )
    undriven = find_never_driven(result.trees, station.io)
    if selection.is_looked_for(EndlessWait.rule.code):
        undriven = unreported_waits(undriven, result.diagnostics)
    unsuppressed = without_suppressed(
        (*result.diagnostics, *undriven, *misspelt_in(job, result.diagnostics)),
        result.trees,
        is_looked_for=lambda code: selection.is_looked_for(code) and result.looked_for(code),
    )
    return replace(
        result,
        diagnostics=tuple(_without_repeats(selection.filter(unsuppressed))),
        fail_on=station.check.fails_from,
        strict=job.is_strict,
        arm=job.robot,
    )


def with_best_arm_of_files(job: Job) -> Job:
    """Return the job with the arm that suits its targets best, if none is named."""
    rules = detectors_of(_selection(job).includes)
    return _with_arm(job, [_loaded(task, rules, job.cell) for task in job.tasks], rules)[0]


def programs_of(job: Job) -> list[Program]:
    """Return the programs of a job's tasks, without the statements that have errors."""
    return _programs(job, [load_task(task, job.cell, ()) for task in job.tasks])


def _with_arm(
    job: Job, loaded: Sequence[LoadedProgram], rules: Sequence[Find]
) -> tuple[Job, tuple[LoadedProgram, ...]]:
    """Return the job with its arm, and its tasks as they were loaded for this choice."""
    is_chosen = job.is_arm_named or not job.request.reach
    if is_chosen or not any(written_move_count(one.files) for one in loaded):
        return job, tuple(loaded)
    # A program without moves imports no arm.
    from rapidsim.jobs.checking.best_arm import with_best_arm

    try:
        return with_best_arm(job, _programs(job, loaded)), tuple(loaded)
    except RunNotFollowedError:
        whole = tuple(load_task(task, job.cell, rules) for task in job.tasks)
        return with_best_arm(job, _programs(job, whole)), whole


def _programs(job: Job, loaded: Iterable[LoadedProgram]) -> list[Program]:
    """Return the programs of tasks; erroneous statements are removed."""
    parts = (one.program or error_free_subset(one, job.cell) for one in loaded)
    found = (part.program if isinstance(part, ErrorFreeSubset) else part for part in parts)
    return [program for program in found if program is not None]


def moves_of_task(job: Job, task: TaskFiles) -> ReachReport:
    """Return the report on the moves of one task of a job, as in `check_job`."""
    rules = detectors_of(_selection(job).includes)
    checks, moves = _checks_without_moves(job), choose_move_check(job)
    loaded = _loaded(task, rules, job.cell)
    return _checked(task, loaded, rules, moves, checks, job.cell, made_now)[1]


def _checks_without_moves(job: Job) -> Callable[[Program], bool]:
    """Return which programs without moves are checked like those with moves."""
    if job.station.check.cycle_budget_s is not None:
        return lambda program: True
    return _may_end_badly if job.request.trial_run else lambda program: False


def _may_end_badly(program: Program) -> bool:
    """Whether a run of main can find an error in a program without moves."""
    return ENTRY in program.routines and can_fail(program)


def _selection(job: Job) -> Selection:
    asked = job.request
    return choose_selection(job.station.check, asked.select, asked.extend_select, asked.ignore)


def _cell_check(job: Job) -> CheckTogether | None:
    if len(job.tasks) < 2 or not (job.request.reach and job.request.trial_run):
        return None
    from rapidsim.jobs.checking.multitask_run import multitask_findings

    return partial(multitask_findings, job)


def check_tasks(
    tasks: Iterable[TaskFiles],
    rules: Sequence[Find] | None = None,
    moves: CheckMoves | None = None,
    *,
    even_without_moves: Callable[[Program], bool] = _may_end_badly,
    cell: CellNames = NO_CELL,
    check_cell: CheckTogether | None = None,
    moves_of: TaskMoves = made_now,
    loaded: Sequence[LoadedProgram] | None = None,
) -> CheckResult:
    """Check tasks that have been read, each independently, and then all together.

    Args:
        tasks: Tasks with their files.
        rules: Rules in addition to the errors that prevent a run; None for the defaults.
        moves: Checks the moves; None leaves them unchecked.
        even_without_moves: Whether `moves` also checks a program without moves, for instance its
            cycle time.
        cell: Names that the configuration declares in addition to the modules.
        check_cell: Runs all tasks together; None runs none.
        moves_of: Returns the report on the moves of a task, perhaps from a cache.
        loaded: The tasks as loaded with these rules; None loads them.
    """
    wanted, tasks = detectors_of() if rules is None else rules, tuple(tasks)
    if loaded is None:
        loaded = [_loaded(task, wanted, cell) for task in tasks]
    checked = [
        (task, *_checked(task, one, wanted, moves, even_without_moves, cell, moves_of))
        for task, one in zip(tasks, loaded, strict=True)
    ]
    looked_at = [(task, one) for task, one, _ in checked]
    disagreements = _disagreements([one for _, one in looked_at])
    of_moves = [diagnostic for *_, report in checked for diagnostic in report.diagnostics]
    of_all = None if check_cell is None or disagreements else check_cell(looked_at)
    of_cell = Coverage(main_left_out="" if of_all is None else of_all.left_out)
    if of_all is not None:
        of_moves = _as_all_tasks(of_moves, of_all.errors, is_of_runs)
        of_moves = _as_all_tasks(of_moves, of_all.of_bodies, is_of_cell)
    found = [
        *(diagnostic for _, one in looked_at for diagnostic in one.diagnostics),
        *of_moves,
        *disagreements,
    ]
    return CheckResult(
        files=tuple(file.name for task, *_ in checked for file in task.files),
        diagnostics=tuple(sorted(found, key=lambda diagnostic: diagnostic.order)),
        trees=tuple(file for _, one, _ in checked for file in one.files),
        coverage=sum((report.coverage for *_, report in checked), of_cell),
    )


def _without_repeats(findings: Sequence[Diagnostic]) -> Iterator[Diagnostic]:
    """Yield the findings, without warnings of interrupts at which the run has stopped."""
    stopped = {
        (finding.span.file, finding.span.line)
        for finding in findings
        if finding.span is not None
        and isinstance(finding.violation, UncaughtError)
        and finding.violation.event == event_of(ERR_UNKINO)
    }
    for finding in findings:
        span = finding.span if isinstance(finding.violation, NeverConnected) else None
        if span is None or (span.file, span.line) not in stopped:
            yield finding


def _as_all_tasks(
    alone: list[Diagnostic],
    of_all: Iterable[Diagnostic] | None,
    replaces: Callable[[Diagnostic], bool],
) -> list[Diagnostic]:
    """Replace findings of runs of single tasks by those of the more reliable run of all tasks."""
    if of_all is None:
        return alone
    kept = [one for one in alone if not replaces(one)]
    told = {(one.code, one.order) for one in kept}
    return [*kept, *(one for one in of_all if (one.code, one.order) not in told)]


def _has_bulk_moves(job: Job) -> bool:
    """Whether a file is so long that its moves may be excluded from the tree."""
    return any(may_have_runs(file.text, MOST_MOVES) for file in job.files)


def _loaded(task: TaskFiles, rules: Sequence[Find], cell: CellNames) -> LoadedProgram:
    """Load a task, with long sequences of moves in bulk if their statements have no findings.

    Only rules that are on by default support bulk statements.
    """
    if frozenset(rules) <= frozenset(detectors_of()):
        loaded = load_task(task, cell, rules, bulk=bulk_reading(MOST_MOVES))
        with suppress(RunNotFollowedError):
            found = findings_of_all(loaded.files, loaded.diagnostics, cell)
            if found is not None:
                return replace(loaded, diagnostics=found)
    return load_task(task, cell, rules)


def _checked(
    task: TaskFiles,
    loaded: LoadedProgram,
    rules: Sequence[Find],
    moves: CheckMoves | None,
    even_without_moves: Callable[[Program], bool],
    cell: CellNames,
    moves_of: TaskMoves,
) -> tuple[LoadedProgram, ReachReport]:
    """Return one task, and the report on its moves."""
    name = task.name or DEFAULT_TASK

    def report(loaded: LoadedProgram) -> ReachReport:
        make = partial(_moves_checked, loaded, name, moves, even_without_moves, cell)
        return moves_of(task, loaded, make)

    try:
        return loaded, report(loaded)
    except RunNotFollowedError:
        whole = load_task(task, cell, rules)
        return whole, report(whole)


def _disagreements(tasks: Sequence[LoadedProgram]) -> tuple[Diagnostic, ...]:
    """Return the findings on persistents that tasks share but declare differently."""
    programs = [one.program for one in tasks if one.program is not None]
    if len(programs) < 2:
        return ()
    from rapidsim.jobs.checking.load_tasks import shared_findings

    return shared_findings(programs)


def _moves_checked(
    loaded: LoadedProgram,
    task: str,
    moves: CheckMoves | None,
    even_without_moves: Callable[[Program], bool],
    cell: CellNames,
) -> ReachReport:
    has_moves = written_move_count(loaded.files) > 0
    why = "not requested" if moves is None else "the program cannot run as it is"
    program = loaded.program
    if moves is not None and program is not None and (has_moves or even_without_moves(program)):
        report = moves(program, task, runs=True)
        if isinstance(report, ReachReport):
            return report
        why = report
    part = None
    if has_moves and moves is not None and loaded.program is None:
        part = error_free_subset(loaded, cell)
    if part is not None and moves is not None:
        # The moves that are known statically, for the program cannot run.
        report = moves(part.program, task, runs=False)
        if isinstance(report, ReachReport):
            replaced = {(one.file, one.start) for one in part.replaced}
            faulty = tuple(
                UncheckedMove(span, "there is an error in it")
                for span in written_moves(loaded.files)
                if (span.file, span.start) in replaced
            )
            return replace(report, coverage=report.coverage + Coverage(unchecked=faulty))
        why = report
    unchecked = tuple(UncheckedMove(span, why) for span in written_moves(loaded.files))
    return ReachReport((), Coverage(unchecked=unchecked))
