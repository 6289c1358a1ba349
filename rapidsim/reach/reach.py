"""Check whether the robot can make every move of a program, statically or by a run."""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Diagnostic, Severity, Span
from rapidsim.frames.transform import Array
from rapidsim.motion.numba_jit import jit_reconsidered
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.arm_configurations import Beginning, EndSolutions, ends_of
from rapidsim.reach.belt_reach import belt_findings
from rapidsim.reach.checked_moves import Coverage, ReachReport, UncheckedMove
from rapidsim.reach.cycle_time_findings import budget_findings, stop_findings
from rapidsim.reach.dataflow.abstract_interpreter import ENTRY
from rapidsim.reach.dataflow.known_moves import MoveStatement, WalkedProgram, in_tree
from rapidsim.reach.dataflow.program_walk import walk_program
from rapidsim.reach.path_findings import PathSurvey, SurveyedPaths
from rapidsim.reach.suggestions import ReachSuggestions
from rapidsim.reach.taint import tainted_calls
from rapidsim.reach.target_findings import (
    configuration_findings,
    far_turn_findings,
    margin_findings,
    orientation_findings,
    overload_findings,
    switch_findings,
    unreachable_findings,
    wind_up_findings,
)
from rapidsim.reach.target_poses import FRAME_WITHOUT_ORIENTATION, PosedMoves, posed
from rapidsim.reach.trial_run import (
    LONGEST_RUN_S,
    ErrorRun,
    RunMoves,
    run_for_error,
    run_for_moves,
    skip_reason,
)
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.task_run import start_joints

_SAID_BY_TEXT = ("M501",)
"""Warnings of a run that the check of the text already issues."""
_FAULTS_OF_PATHS = ("K604", "K614", "K615")
"""Findings about the course of a path, which corner paths may avoid."""
_GIVES_WAY = ("K603", "K606")
"""Findings at which a run that uses the nearest configuration does not stop."""


@jit_reconsidered()
def check_reach(
    program: Program,
    robot: Robot,
    options: RunOptions | None = None,
    *,
    run: bool = True,
    cycle_budget_s: float | None = None,
    by_default: bool = False,
) -> ReachReport:
    """Check the moves of a program.

    Args:
        program: A checked program.
        robot: The arm.
        options: The conditions for running main: the arm's start position, signals, motion model.
        run: Whether to run main, for the moves that only a run determines and for its error.
        cycle_budget_s: Time limit of one cycle of main; if set, needless stops are reported.
        by_default: Whether the arm is the default one, because no input names an arm.
    """
    options = options or RunOptions()
    robot = options.with_axes(robot)
    walked = walk_program(program)
    budget = cycle_budget_s if run else None
    if not walked.written and budget is None:
        of_main = _error_of_main(program, robot, options, walked) if run else ErrorRun()
        return ReachReport(of_main.diagnostics, Coverage(main_left_out=of_main.left_out))
    known = list(walked.moves)
    told: RunMoves | None = None
    joints: dict[int, Array] = {}
    base_from_world = options.world_from_base.inverse()
    placed = posed(known, robot, base_from_world, options.external_axes)
    left_out = placed.left_out
    if run and _needs_run(walked, placed, options, budget):
        longest_s = max(LONGEST_RUN_S, 2.0 * (budget or 0.0))
        told = run_for_moves(program, robot, options, walked, len(known), longest_s)
        joints = dict(enumerate(told.end_joints, start=len(known)))
        if told.moves:
            known += told.moves
            placed = posed(known, robot, base_from_world, options.external_axes)
    exact = options.exact_configuration
    ends = ends_of(placed, robot, exact=exact)
    cures = None if by_default else ReachSuggestions(program, placed, ends, robot, base_from_world)
    beginning = _beginning(robot, options)
    finder = PathSurvey(program, placed, ends, robot, options.model, joints, exact, beginning)
    ways = finder.survey()
    found = [
        *orientation_findings(program, placed, options.external_axes),
        *unreachable_findings(program, placed, ends, robot, cures),
        *belt_findings(program, walked.moves, robot, base_from_world, options.io.conveyors),
        *configuration_findings(program, placed, ends, ways.stances, robot),
        *finder.findings(ways),
        *margin_findings(program, placed, ends, ways.stances, robot),
        *wind_up_findings(program, placed, ways.stances, robot),
        *switch_findings(program, placed, ways.stances, robot),
        *far_turn_findings(program, placed, ways.stances, robot, ways.broken),
        *(() if by_default else overload_findings(program, placed, robot)),
    ]
    of_main = ErrorRun()
    if told is not None:
        found += told.diagnostics
        if told.scene is not None:
            found += _unrun_collisions(program, walked, placed, ways, robot, options, told)
        if budget is not None:
            found += budget_findings(program, told, budget, options.model.version)
            found += stop_findings(program, placed, ways)
    elif run:
        of_main = _error_of_main(program, robot, options, walked)
        found += _not_sure(program, walked, of_main.diagnostics)
    found = list(_conditional_assumptions(found, options))
    if told is not None and any(one.severity is Severity.ERROR for one in found):
        found = list(_not_sure(program, walked, found))
    run_of_main = of_main if told is None else told
    met = run_of_main.met
    distinct = tuple(_FindingKeys(walked).distinct(found, run_of_main.diagnostics, met))
    paths, unchecked_paths = _paths(placed, ends, ways, beginning, met)
    coverage = replace(
        _coverage(walked, placed, ends, told, left_out),
        main_left_out=of_main.left_out,
        paths=paths,
        unchecked_paths=unchecked_paths,
    )
    return ReachReport(distinct, coverage)


def _beginning(robot: Robot, options: RunOptions) -> Beginning | None:
    """Return the start of a run of main; None if the run does not begin with main."""
    if options.entry.lower() != ENTRY:
        return None
    degrees = options.start_joints_deg
    return Beginning(start_joints(robot, degrees), is_free=degrees is None)


def _needs_run(
    walked: WalkedProgram,
    placed: PosedMoves,
    options: RunOptions,
    cycle_budget_s: float | None,
) -> bool:
    """Whether moves, contacts or cycle time need a run of main, and no frame prevents it."""
    if FRAME_WITHOUT_ORIENTATION in placed.left_out.values():
        return False
    has_unplaced = bool(walked.unknown or placed.left_out or placed.carried.any())
    return has_unplaced or cycle_budget_s is not None or options.geometry is not None


def _conditional_assumptions(
    findings: Iterable[Diagnostic], options: RunOptions
) -> Iterator[Diagnostic]:
    """The findings, assumed where a run that takes the nearest configuration does not stop."""
    continues = options.nearest_configuration
    for one in findings:
        yield replace(one, assumed=continues) if one.violation.code in _GIVES_WAY else one


def _error_of_main(
    program: Program, robot: Robot, options: RunOptions, walked: WalkedProgram
) -> ErrorRun:
    """Return the error that ends a run of main, or the reason why main is not run for it.

    Both are empty if a cell has several tasks: these are run together.
    """
    if len(options.cell_tasks) > 1:
        return ErrorRun()
    if why := skip_reason(walked):
        return ErrorRun(left_out=why)
    return run_for_error(program, robot, options, walked)


def _unrun_collisions(
    program: Program,
    walked: WalkedProgram,
    placed: PosedMoves,
    surveyed: SurveyedPaths,
    robot: Robot,
    options: RunOptions,
    run_moves: RunMoves,
) -> Iterator[Diagnostic]:
    """Yield collisions of moves that the run did not make, if their start and end are known."""
    assert run_moves.scene is not None
    sure, broken = surveyed.stances.sure, surveyed.broken
    rows = [
        row
        for row, known in enumerate(walked.moves)
        if known.call not in run_moves.met
        and known.previous is not None
        and row not in placed.left_out
        and not placed.carried[row]
        and sure[row]
        and sure[known.previous]
        and row not in broken
        and row not in surveyed.circle_faults
    ]
    if not rows or len(run_moves.scene.arms) > 1:
        return
    # The collision check is slow to import, and few stations have bodies.
    from rapidsim.reach.unrun_collisions import MOST_MOVES, UnrunMoves  # noqa: PLC0415

    base_from_world = options.world_from_base.inverse()
    unrun = UnrunMoves(
        program, placed, surveyed.stances, robot, options.model, run_moves.scene, base_from_world
    )
    yield from unrun.findings(rows[:MOST_MOVES])


def _not_sure(
    program: Program, walked: WalkedProgram, findings: Iterable[Diagnostic]
) -> Iterator[Diagnostic]:
    """Yield the findings; those that depend on inputs, which nothing sets in a run, as assumed."""
    moved = tainted_calls(program)
    unsure = [module.span(call) for call, module in walked.written if in_tree(call) in moved]
    for one in findings:
        span = one.span
        inside = span is not None and any(span.begins_in(call) for call in unsure)
        is_reach = one.violation.code.startswith("K") or one.violation.code == "C104"
        yield replace(one, assumed=True) if inside and is_reach else one


@dataclass(eq=False)
class _FindingKeys:
    """Keys that identify findings by rule and move: equal ones of a move are reported once."""

    walked: WalkedProgram

    def __post_init__(self) -> None:
        self._starts: dict[str, list[tuple[int, int]]] = {}
        for call, module in self.walked.written:
            self._starts.setdefault(module.source.file, []).append((call.start, call.end))

    def distinct(
        self,
        diagnostics: Iterable[Diagnostic],
        of_run: Iterable[Diagnostic],
        met: frozenset[MoveStatement],
    ) -> list[Diagnostic]:
        """Return the findings without repetitions about the same move.

        Corner paths are known only in a run: its errors come first and replace static findings, and
        a path that it has executed has no fault.

        Args:
            diagnostics: All findings.
            of_run: Findings of the run of main.
            met: The moves that it made, or at which it ended.
        """
        ran = {
            (one.code, self._move_of(one.span)): one.violation
            for one in of_run
            if one.severity is Severity.ERROR
        }
        stopped = {move for _, move in ran}
        times = Counter(known.call for known in self.walked.moves)
        made = {
            (module.source.file, call.start)
            for call, module in self.walked.written
            if call in met and times[call] == 1
        } - stopped
        said: set[tuple[str, object]] = set()
        first: list[Diagnostic] = []
        others: list[Diagnostic] = []
        for diagnostic in diagnostics:
            code, move = diagnostic.violation.code, self._move_of(diagnostic.span)
            ends_run = diagnostic.violation.severity is Severity.ERROR
            if (code, move) in said or (code in _SAID_BY_TEXT and not ends_run):
                continue
            if code in _FAULTS_OF_PATHS and move in made:
                continue
            said.add((code, move))
            known = ran.get((code, move))
            if known is None:
                others.append(diagnostic)
            elif known.message == diagnostic.message:
                first.append(diagnostic)
            else:
                first.append(replace(diagnostic, violation=known))
        return first + others

    def _move_of(self, span: Span | None) -> object:
        if span is None:
            return None
        starts = self._starts.get(span.file, [])
        at = bisect_right(starts, (span.start, len(span.source.text))) - 1
        inside = at >= 0 and span.start < starts[at][1]
        return (span.file, starts[at][0] if inside else span.start)


def _coverage(
    walked: WalkedProgram,
    placed: PosedMoves,
    ends: EndSolutions,
    run_moves: RunMoves | None,
    left_out: Mapping[int, str],
) -> Coverage:
    by_value = {
        known.call
        for row, known in enumerate(walked.moves)
        if row not in left_out and ends.looked_at[row]
    }
    reasons = {walked.moves[row].call: why for row, why in left_out.items()}
    of_text = placed.carried[: len(walked.moves)]
    carried = {walked.moves[row].call for row in np.flatnonzero(of_text).tolist()}
    met = frozenset() if run_moves is None else run_moves.met
    values = runs = 0
    unchecked: list[UncheckedMove] = []
    for call, module in walked.written:
        open_ = call in walked.unknown or call in reasons or call in carried
        if call in by_value and not (open_ and call in met):
            values += 1
        elif call in met:
            runs += 1
        else:
            why = walked.unknown.get(call) or reasons.get(call) or _NOT_SEARCHED
            if run_moves is not None and call not in met:
                why = f"{why}; a run of main {run_moves.outcome}"
            unchecked.append(UncheckedMove(module.span(call), why))
    return Coverage(values, runs, tuple(unchecked))


def _paths(
    placed: PosedMoves,
    ends: EndSolutions,
    surveyed: SurveyedPaths,
    beginning: Beginning | None,
    met: frozenset[MoveStatement],
) -> tuple[int, tuple[UncheckedMove, ...]]:
    """Number of instructions with a path of the TCP, and those whose path is unchecked."""
    paths: set[MoveStatement] = set()
    unchecked: dict[MoveStatement, UncheckedMove] = {}
    for row, known in enumerate(placed.moves):
        call = known.call
        if not known.move.interpolation.leads_tcp or not (ends.looked_at[row] or call in met):
            continue
        paths.add(call)
        begins = known.begins and beginning is not None and beginning.is_free
        is_checked = (
            call in met
            or row in surveyed.surveyed
            or row in surveyed.circle_faults
            or (begins and bool(surveyed.stances.sure[row]))
            or not ends.reachable[row]
        )
        if not is_checked:
            unchecked[call] = UncheckedMove(known.span, _START_UNKNOWN)
    return len(paths), tuple(unchecked.values())


_START_UNKNOWN = "it is not known where the arm begins with it, or how it turns on the way"
_NOT_SEARCHED = "this arm is solved by search, which a check does for a few targets only"
