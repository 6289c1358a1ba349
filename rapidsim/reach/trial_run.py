"""Trial run of main: moves that only a run determines, and the error that ends it.

The run is short and has no side effects: files are written to a temporary folder, and it ends after
a limit of virtual time, or at a question to the operator. It ends earlier if the arm cannot
continue, but not at an unreachable stored configuration: the moves after it are worth checking.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

from rapidsim.analysis.program import Program
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.diagnostics import Diagnostic, Severity, Span
from rapidsim.files import InputError
from rapidsim.findings.collisions import is_of_cell, is_of_parts
from rapidsim.findings.reach_and_motion_data import MainAxesSwitched
from rapidsim.findings.runs import (
    EndlessWait,
    NobodyAnswers,
    NobodyConnects,
    NobodyGuides,
    NotDeclaredHere,
    QuestionUnanswered,
    is_of_runs,
)
from rapidsim.frames.transform import Array
from rapidsim.interpreter.limits import NotExecutableError
from rapidsim.language.errors import Stopped
from rapidsim.language.moves import MotionSettings, Place
from rapidsim.motion.robot.robot import Robot
from rapidsim.reach.checked_moves import MOST_MOVES, MOST_MOVES_FOR_ERRORS
from rapidsim.reach.dataflow.known_moves import KnownMove, WalkedProgram
from rapidsim.reach.taint import is_set_externally, reads_external_state, reads_inputs
from rapidsim.reach.valueless_persistents import doubt_valueless, is_valueless
from rapidsim.simulation.options import RunOptions
from rapidsim.simulation.results.simulation import End, Simulation
from rapidsim.simulation.simulate import run_tasks, simulate
from rapidsim.simulation.task_run import TaskSetup
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.collisions.scene import Scene

LONGEST_RUN_S = 120.0
"""Virtual time [s] after which the trial run ends."""
LONGEST_WORK_S = 10.0
"""Processor time [s] after which it ends, too: many times the time that a program which makes
progress needs for that much virtual time."""
LONGEST_WORK_FOR_ERRORS_S = 2.0
"""Limit of the processor time [s] of a run for errors only."""
_TOLD_BY_RUN = frozenset({"conf_j", "conf_l"})
"""Settings whose findings the run reports itself."""
_NOBODY_THERE = (NobodyAnswers, NobodyConnects, EndlessWait)
"""Findings of a run whose cause may be a peer that a check does not have."""
_ENDS = {
    End.ENDED: "it ended without coming here",
    End.STOPPED: "the program stopped before, or asked the operator something",
    End.TIME_LIMIT: "its time was over before it came here",
    End.CYCLE_LIMIT: "it ended without coming here",
    End.ERROR: "it stopped with an error before",
}


@value_class(frozen=True, slots=True, eq=False)
class RunMoves:
    """Moves and findings of a trial run."""

    moves: tuple[KnownMove, ...]
    """The moves it made, in order; `previous` counts from `first_row`."""
    instructions: tuple[int, ...]
    """Numbers of their instructions."""
    executed: tuple[ExecutedMove, ...]
    met: frozenset[int]
    """Numbers of the instructions that it made, and of those that it could not make."""
    diagnostics: tuple[Diagnostic, ...]
    """Its findings about moves."""
    time_s: float | None
    """Duration of the run; None if it did not reach its end."""
    duration_unknown: str
    """Phrase on the duration of a run that did not reach its end."""
    outcome: str
    """Phrase on the reason why moves were not reached, to follow "a run of main"."""
    scene: Scene | None = None
    """Bodies of the cell, with the pairs in which neither is ever carried; None if the station
    describes no bodies."""
    left_out: str = ""
    """See `Coverage.main_left_out`."""

    @property
    def end_joints(self) -> Iterator[Array]:
        """Joints (n,) [rad] at the end of each move that the run made."""
        return (move.joints for move in self.executed)


def run_for_moves(
    program: Program,
    robot: Robot,
    options: RunOptions,
    walked: WalkedProgram,
    first_row: int,
    longest_s: float = LONGEST_RUN_S,
) -> RunMoves:
    """Run main and collect its moves.

    Args:
        program: The program.
        robot: The arm.
        options: Inputs of the run.
        walked: The moves known from its text.
        first_row: The row of the run's first move among all known moves.
        longest_s: Limit of virtual time [s].
    """
    if not _can_start(program, options.entry):
        return _not_run(f"is not possible: there is no `{options.entry}`")
    if len(walked.written) > MOST_MOVES:
        return _not_run("is skipped in a check of so many moves; `rapidsim run` makes it")
    with TemporaryDirectory(prefix="rapidsim-") as home:
        limited = _limited(options, longest_s, LONGEST_WORK_S)
        asked = replace(
            limited,
            home=Path(home),
            nearest_configuration=True,
            functions_fail=not options.nearest_configuration,
            guesses_frames=_is_all(options),
        )
        try:
            run = simulate(program, robot, options=asked)
        except (InputError, NotExecutableError) as error:
            return _not_run(f"is not possible: {error}")
    made = [(one, at) for one in run.moves if (at := _number(one.place, walked)) is not None]
    moves = tuple(
        KnownMove(
            call,
            module,
            one.place.routine,
            one.move,
            MotionSettings(),
            _TOLD_BY_RUN | walked.settings_set,
            first_row + position - 1 if position else None,
        )
        for position, (one, number) in enumerate(made)
        for call, module in [walked.written[number]]
    )
    return RunMoves(
        moves,
        tuple(number for _, number in made),
        tuple(one for one, _ in made),
        _met(run, walked),
        tuple(
            _as_sure(one, run, (program,), options)
            for one in run.diagnostics
            # A run of all tasks has the values that they pass to each other.
            if _is_reported(one) and (_is_all(options) or not is_valueless(one, (program,)))
        ),
        run.time_s if run.end in (End.ENDED, End.CYCLE_LIMIT) else None,
        f"more than {run.time_s:.0f} s"
        if run.end is End.TIME_LIMIT
        else "a time that is not known: its run stopped before the end",
        f"does not tell: {_ENDS[run.end]}",
        None if run.collisions is None else run.collisions.uncarried,
        _cut_off(run, limited),
    )


def _can_start(program: Program, entry: str) -> bool:
    """Whether a program has an entry procedure that needs no arguments."""
    symbol = program.routines.get(entry.lower())
    return symbol is not None and all(parameter.optional for parameter in symbol.parameters)


@value_class(frozen=True, slots=True, eq=False)
class ErrorRun:
    """Findings of a run of main for its error."""

    diagnostics: tuple[Diagnostic, ...] = ()
    left_out: str = ""
    """Reason why there are no findings, if a check lacks a service that main needs."""
    met: frozenset[int] = frozenset()
    """Numbers of the instructions that it made, and of that at which it ended."""


def run_for_error(
    program: Program, robot: Robot, options: RunOptions, walked: WalkedProgram
) -> ErrorRun:
    """Return the error that ends a run of main, for a program with statically known moves."""
    if not _can_start(program, options.entry):
        return ErrorRun()
    limited = _limited(options, LONGEST_RUN_S, LONGEST_WORK_FOR_ERRORS_S)
    try:
        with TemporaryDirectory(prefix="rapidsim-") as home:
            asked = _alone(limited, home, guesses_frames=_is_all(options))
            run = simulate(program, robot, options=asked)
    except NotExecutableError as error:
        return ErrorRun((error.diagnostic,))
    except InputError:
        return ErrorRun()
    met = _met(run, walked)
    if _lacked(run, (program,)):
        why = "main needs files, sockets, cameras or modules, which a check does not have"
        return ErrorRun((), why, met)
    if _was_to_be_answered(run):
        return ErrorRun(met=met)
    moves = [module.span(call) for call, module in walked.written]
    errors = (one for one in run.diagnostics if _ends_or_doubts(one, moves))
    found = tuple(_as_sure(one, run, (program,), options, moves) for one in errors)
    return ErrorRun(found, _cut_off(run, limited), met)


def _met(run: Simulation, walked: WalkedProgram) -> frozenset[int]:
    """Return the numbers of the moves that a run made, and of those that it could not make."""
    places = [one.place for one in run.moves]
    places += [one.place for robot in run.robots for one in robot.failed_moves]
    numbers = (_number(place, walked) for place in places)
    return frozenset(number for number in numbers if number is not None)


def _number(place: Place, walked: WalkedProgram) -> int | None:
    """Return the number of the instruction at a place; None if it is not one of the program."""
    return walked.written.by_place.get((place.span.file, place.span.start))


def skip_reason(walked: WalkedProgram) -> str:
    """Return the reason why main is not run for its errors alone; empty if it is."""
    if len(walked.written) > MOST_MOVES_FOR_ERRORS:
        return f"main has more than {MOST_MOVES_FOR_ERRORS} moves, all known statically"
    return ""


@value_class(frozen=True, slots=True)
class CellRun:
    """Findings of a run of all tasks of a cell."""

    errors: tuple[Diagnostic, ...] | None
    """The errors that end it; None if it is inconclusive: it depends on services that a check
    lacks, or takes too long."""
    of_bodies: tuple[Diagnostic, ...] | None
    """Findings on the bodies of the cell as far as it went; None if the station has none."""
    left_out: str = ""
    """See `Coverage.main_left_out`."""


def run_all_tasks(setups: Sequence[TaskSetup], options: RunOptions) -> CellRun | None:
    """Return the findings of a run of all tasks of a cell; None if it is impossible."""
    programs = [setup.program for setup in setups]
    limited = _limited(options, LONGEST_RUN_S, LONGEST_WORK_FOR_ERRORS_S)
    try:
        with TemporaryDirectory(prefix="rapidsim-") as home:
            run = run_tasks(setups, _alone(limited, home)).simulation
    except (InputError, NotExecutableError):
        return None
    of_bodies = None
    if run.collisions is not None:
        found = (one for one in run.diagnostics if is_of_cell(one))
        of_bodies = tuple(_as_sure(one, run, programs, options) for one in found)
    if _lacked(run, programs):
        return CellRun(None, of_bodies)
    if _was_to_be_answered(run):
        return CellRun((), of_bodies)
    errors = [one for one in run.diagnostics if one.severity is Severity.ERROR]
    errors = [one for one in errors if not is_of_cell(one)]
    if run.end is End.TIME_LIMIT and not errors:
        return CellRun(None, of_bodies, _cut_off(run, limited))
    reported = tuple(_as_sure(one, run, programs, options) for one in errors if not _of_text(one))
    return CellRun(reported, of_bodies)


def _limited(options: RunOptions, longest_s: float, work_s: float) -> RunOptions:
    """Return options for one cycle, limited in virtual time and processor time.

    A verdict should not depend on what else the computer does. If the check itself has a limit on
    the clock, half of it remains for everything else.
    """
    wall_s = None if options.max_wall_s is None else 0.5 * options.max_wall_s
    return replace(
        options,
        answers=_stop_at_question,
        max_cycles=1,
        max_time_s=min(options.max_time_s, longest_s),
        max_wall_s=wall_s,
        max_work_s=work_s,
    )


def _alone(options: RunOptions, home: str, *, guesses_frames: bool = True) -> RunOptions:
    """Return options for a run with only an empty home folder; questions end as unanswered."""
    return replace(
        options,
        answers=None,
        home=Path(home),
        ramdisk=None,
        network=None,
        guesses_frames=guesses_frames,
    )


def _cut_off(run: Simulation, limits: RunOptions) -> str:
    """Return that a run ended at its limit of the computer's time; empty if it did not."""
    if run.end is not End.TIME_LIMIT or run.time_s >= limits.max_time_s:
        return ""
    spent = f"{limits.max_work_s:g} s of processor time"
    if limits.max_wall_s is not None:
        spent += f", or {limits.max_wall_s:g} s on the clock"
    return f"it was cut off after {spent}; `rapidsim run` makes it"


def _lacked(run: Simulation, programs: Sequence[Program]) -> bool:
    """Whether a run lacked an external file, peer or service that it used."""
    nobody = any(isinstance(one.violation, _NOBODY_THERE) for one in run.diagnostics)
    return (run.lacked_files or nobody) and any(map(reads_external_state, programs))


def _was_to_be_answered(run: Simulation) -> bool:
    """Whether a run reached a question that only an answer ends."""
    return any(isinstance(one.violation, QuestionUnanswered) for one in run.diagnostics)


def _had_question(run: Simulation) -> bool:
    """Whether a run reached a question that an operator could have answered."""
    return any("prompt" in event.details for event in run.events)


def _is_all(options: RunOptions) -> bool:
    """Whether a run of one task is one of all: else the mover of its work object may be missing."""
    return len(options.cell_tasks) < 2


def _is_reported(finding: Diagnostic) -> bool:
    """Whether the check reports a finding of the run: on moves, or on the end of the program."""
    if _of_text(finding):
        return False
    return finding.violation.code[0] in "CIKM" or finding.severity is Severity.ERROR


def _of_run(finding: Diagnostic) -> bool:
    return is_of_runs(finding) and not _of_text(finding)


def _ends_or_doubts(finding: Diagnostic, moves: Sequence[Span]) -> bool:
    """Whether a finding needs a run: an error that ends it, or a function's result on reach."""
    if _of_run(finding):
        return finding.severity is Severity.ERROR
    if isinstance(finding.violation, MainAxesSwitched):
        # The start of the first move is known only in a run.
        return True
    if finding.violation.code.startswith("I"):
        return True
    if finding.severity is Severity.ERROR:
        return not _of_text(finding)
    at = finding.span
    of_reach = finding.violation.code.startswith("K")
    return of_reach and at is not None and not any(map(at.begins_in, moves))


def _of_text(finding: Diagnostic) -> bool:
    """Whether the check of the text reports the finding, too."""
    return isinstance(finding.violation, NotDeclaredHere)


def _as_sure(
    finding: Diagnostic,
    run: Simulation,
    programs: Sequence[Program],
    options: RunOptions,
    moves: Sequence[Span] | None = None,
) -> Diagnostic:
    """Return the finding, as assumed if services that a check lacks may be its cause.

    Args:
        finding: What a run has found.
        run: The run.
        programs: The programs that it executed.
        options: Its conditions.
        moves: The positions of moves: findings there are as sure as their targets. None applies
            this to all findings except those of runs.
    """
    finding = doubt_valueless(finding, programs)
    at = finding.span
    is_of_move = moves is None or (at is not None and any(map(at.begins_in, moves)))
    is_sure = is_of_move and not _of_run(finding) and not is_of_parts(finding)
    return finding if is_sure else _doubted(finding, run, programs, options)


def _doubted(
    finding: Diagnostic, run: Simulation, programs: Sequence[Program], options: RunOptions
) -> Diagnostic:
    guesses = (
        bool(run.unsimulated)
        or len(options.cell_tasks) > len(programs)
        or any(one.cell.refers_late for one in programs)
        or (len(programs) == 1 and is_set_externally(programs[0]))
        or _lacked(run, programs)
        or any(isinstance(one.violation, NobodyGuides) for one in run.diagnostics)
        or _had_question(run)
    )
    if not options.io.stimuli:
        in_vain = (
            isinstance(finding.violation, EndlessWait) and finding.violation.suggestion is None
        )
        guesses = guesses or in_vain or any(map(reads_inputs, programs))
    return replace(finding, assumed=True) if guesses else finding


def _stop_at_question(prompt: str) -> str | None:
    """End the run at a question: the rest depends on the answer."""
    raise Stopped(f"no answer to `{prompt}`")


def _not_run(outcome: str) -> RunMoves:
    return RunMoves((), (), (), frozenset(), (), None, "a time that is not known", outcome)
