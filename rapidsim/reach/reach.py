"""Check whether the robot can make every move of a program, statically or by a run."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np

from rapidsim.analysis.program import Program
from rapidsim.diagnostics import Diagnostic, Severity, Span
from rapidsim.findings.collisions import is_of_cell
from rapidsim.frames.transform import Array
from rapidsim.language.target_violations import QuaternionNotUnit
from rapidsim.motion.kinematics.arm import Mask
from rapidsim.motion.numba_jit import jit_reconsidered
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.arm_configurations import Beginning, EndSolutions, ends_of
from rapidsim.reach.belt_reach import belt_findings
from rapidsim.reach.checked_moves import Coverage, ReachReport, UncheckedMove
from rapidsim.reach.cycle_time_findings import budget_findings, stop_findings
from rapidsim.reach.dataflow.abstract_interpreter import ENTRY
from rapidsim.reach.dataflow.known_moves import KnownMoves, WalkedProgram
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
    known = walked.moves
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
            known = known.followed_by(told.moves, told.instructions)
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
    keys = _FindingKeys(walked)
    found = list(_possible(walked, keys, told, found))
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
    distinct = tuple(keys.distinct(found, run_of_main.diagnostics, met))
    paths, unchecked_paths = _paths(placed, ends, ways, beginning, met)
    coverage = replace(
        _coverage(walked, placed, ends, told, left_out),
        main_left_out=run_of_main.left_out,
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
    sure, moves = surveyed.stances.sure, placed.moves
    open_ = ~surveyed.is_broken & (moves.previous >= 0) & placed.is_placed & ~placed.carried
    open_ &= sure & sure[moves.previous] & ~_met(run_moves.met, moves)
    open_[[*range(len(walked.moves), len(moves)), *surveyed.circle_faults]] = False
    rows = np.flatnonzero(open_)
    if not len(rows) or len(run_moves.scene.arms) > 1:
        return
    # The collision check is slow to import, and few stations have bodies.
    from rapidsim.reach.unrun_collisions import MOST_MOVES, UnrunMoves  # noqa: PLC0415

    base_from_world = options.world_from_base.inverse()
    unrun = UnrunMoves(
        program, placed, surveyed.stances, robot, options.model, run_moves.scene, base_from_world
    )
    yield from unrun.findings(rows[:MOST_MOVES])


def _met(met: frozenset[int], moves: KnownMoves) -> Mask:
    """Shape (k,): whether a run of main made or met the instruction of each move."""
    return np.isin(moves.instruction, list(met))


def _not_sure(
    program: Program, walked: WalkedProgram, findings: Iterable[Diagnostic]
) -> Iterator[Diagnostic]:
    """Yield the findings; those that depend on inputs, which nothing sets in a run, as assumed."""
    unsure: list[Span] | None = None
    for one in findings:
        if (one.violation.code.startswith("K") or one.violation.code == "C104") and one.span:
            if unsure is None:
                unsure = list(walked.written.spans(tainted_calls(program)))
            if any(map(one.span.begins_in, unsure)):
                one = replace(one, assumed=True)
        yield one


def _possible(
    walked: WalkedProgram,
    keys: _FindingKeys,
    main_run: RunMoves | None,
    findings: Sequence[Diagnostic],
) -> Iterator[Diagnostic]:
    """Yield the findings; as assumed if the program need not come to the move with these values.

    Under an unknown condition, data may have been written by another branch in an earlier round: a
    program that serves commands gets a target with one command, and moves there with a later one.

    Args:
        walked: The program.
        keys: Keys of findings.
        main_run: A run of main, which is sure of its error.
        findings: Findings about moves known from the text.
    """
    of_run = () if main_run is None else main_run.diagnostics
    sure = {keys.key(one) for one in of_run if one.severity is Severity.ERROR}
    is_open = walked.changing or walked.set_elsewhere
    for one in findings:
        if is_open and one.severity is Severity.ERROR and (key := keys.key(one)) not in sure:
            number = None if key[1] is None else walked.written.by_place.get(key[1])
            found = one.violation
            is_unset = number in walked.set_elsewhere
            if is_unset and isinstance(found, QuaternionNotUnit) and found.length == 0.0:
                unset = QuaternionNotUnit(found.target, 0.0, found.refused, set_elsewhere=True)
                one = replace(one, violation=unset, assumed=True)
            elif number in walked.changing:
                one = replace(one, assumed=True)
        yield one


_Place: TypeAlias = tuple[str, int]
"""File and offset of a statement."""


@dataclass(eq=False)
class _FindingKeys:
    """Keys that identify findings by rule and move: equal ones of a move are reported once.

    Crashes and faults of parts are events of a run, which may have several at a move.
    """

    walked: WalkedProgram

    def distinct(
        self,
        diagnostics: Iterable[Diagnostic],
        of_run: Iterable[Diagnostic],
        met: frozenset[int],
    ) -> list[Diagnostic]:
        """Return the findings without repetitions about the same move.

        Corner paths are known only in a run: its errors come first and replace static findings, and
        a path that it has executed has no fault.

        Args:
            diagnostics: All findings.
            of_run: Findings of the run of main.
            met: The moves that it made, or at which it ended.
        """
        ran = {self.key(one): one.violation for one in of_run if one.severity is Severity.ERROR}
        stopped = {move for _, move, _ in ran}
        times = np.bincount(self.walked.moves.instruction, minlength=1)
        made = {
            (module.source.file, call.start)
            for number in met
            if number < len(times) and times[number] == 1
            for call, module in [self.walked.written[number]]
        } - stopped
        said: set[tuple[str, _Place | None, str]] = set()
        first: list[Diagnostic] = []
        others: list[Diagnostic] = []
        for diagnostic in diagnostics:
            key = code, move, _ = self.key(diagnostic)
            ends_run = diagnostic.violation.severity is Severity.ERROR
            if key in said or (code in _SAID_BY_TEXT and not ends_run):
                continue
            if code in _FAULTS_OF_PATHS and move in made:
                continue
            said.add(key)
            known = ran.get(key)
            if known is None:
                others.append(diagnostic)
            elif known.message == diagnostic.message:
                first.append(diagnostic)
            else:
                first.append(replace(diagnostic, violation=known))
        return first + others

    def key(self, finding: Diagnostic) -> tuple[str, _Place | None, str]:
        """Return rule, place of the move, and event of a finding."""
        event = finding.message if is_of_cell(finding) else ""
        return finding.violation.code, self._move_of(finding.span), event

    def _move_of(self, span: Span | None) -> _Place | None:
        if span is None:
            return None
        start = self.walked.written.start_around(span.file, span.start)
        return (span.file, span.start if start is None else start)


def _coverage(
    walked: WalkedProgram,
    placed: PosedMoves,
    ends: EndSolutions,
    run_moves: RunMoves | None,
    left_out: Mapping[int, str],
) -> Coverage:
    moves, written = walked.moves, walked.written
    of_text = slice(len(moves))
    instruction, looked_at = moves.instruction, ends.looked_at[of_text].copy()
    skipped = list(left_out)
    looked_at[skipped] = False
    by_value, is_open, is_met = (np.zeros(len(written), dtype=bool) for _ in range(3))
    by_value[instruction[looked_at]] = True
    is_open[instruction[skipped]] = is_open[instruction[placed.carried[of_text]]] = True
    is_open[list(walked.unknown)] = True
    is_met[list(frozenset() if run_moves is None else run_moves.met)] = True
    by_value &= ~(is_open & is_met)
    reasons = dict(zip(instruction[skipped].tolist(), left_out.values(), strict=True))
    unchecked: list[UncheckedMove] = []
    for number in np.flatnonzero(~(by_value | is_met)).tolist():
        why = walked.unknown.get(number) or reasons.get(number) or _NOT_SEARCHED
        if run_moves is not None:
            why = f"{why}; a run of main {run_moves.outcome}"
        call, module = written[number]
        unchecked.append(UncheckedMove(module.span(call), why))
    by_run = int((is_met & ~by_value).sum())
    return Coverage(int(by_value.sum()), by_run, tuple(unchecked))


def _paths(
    placed: PosedMoves,
    ends: EndSolutions,
    surveyed: SurveyedPaths,
    beginning: Beginning | None,
    met: frozenset[int],
) -> tuple[int, tuple[UncheckedMove, ...]]:
    """Number of instructions with a path of the TCP, and those whose path is unchecked."""
    moves = placed.moves
    is_met = _met(met, moves)
    led = moves.each(lambda known: known.move.interpolation.leads_tcp)
    paths = led & (ends.looked_at | is_met)
    checked = is_met | surveyed.is_surveyed | ~ends.reachable
    checked[list(surveyed.circle_faults)] = True
    if beginning is not None and beginning.is_free:
        checked |= moves.begins & surveyed.stances.sure
    unchecked: list[UncheckedMove] = []
    for number in np.unique(moves.instruction[paths & ~checked]).tolist():
        call, module = moves.instructions[number]
        unchecked.append(UncheckedMove(module.span(call), _START_UNKNOWN))
    return len(np.unique(moves.instruction[paths])), tuple(unchecked)


_START_UNKNOWN = "it is not known where the arm begins with it, or how it turns on the way"
_NOT_SEARCHED = "this arm is solved by search, which a check does for a few targets only"
