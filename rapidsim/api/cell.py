"""A program with its cell: found once as a command would find it, then checked, run and called."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING

from rapidsim.jobs.checking.check_files import check_job, with_best_arm_of_files
from rapidsim.jobs.checking.check_result import CheckResult
from rapidsim.jobs.inputs.answers import answers_in_order, answers_of_file
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.run_request import RunRequest

if TYPE_CHECKING:
    from rapidsim.analysis.literals import Value
    from rapidsim.api.run import Run
    from rapidsim.controller.cell.inputs import Answers
    from rapidsim.motion.robot.robot import Robot

PathLike_ = str | PathLike[str]


def load(
    paths: PathLike_ | Iterable[PathLike_],
    *,
    robot: Robot | str | None = None,
    station: PathLike_ | None = None,
    task: str | None = None,
    home: PathLike_ | None = None,
    assume_missing: bool = False,
    strict: bool = False,
    texts: Mapping[PathLike_, str] | None = None,
) -> Cell:
    """Load a program, a folder, a program file or a controller backup.

    Args:
        paths: One or several; together they are one task, unless a backup or the station file
            says which modules belong to which.
        robot: An arm, its name in the catalogue, or a URDF file; None takes that of the station or
            the default.
        station: The station file; None takes `rapidsim.toml` in the program's folder or above.
        task: Only this one of several tasks.
        home: The folder for HOME: of runs that name none; None is `<program>.home`.
        assume_missing: Whether what no module declares is assumed to exist: calls are skipped.
        strict: Whether what is unknown, not simulated or not checked fails: `ok` is false.
        texts: Texts of files of the program, by path, in place of those on the disk, such as those
            that an editor has not saved. The files themselves must exist.

    Raises:
        InputError: If something is missing, unreadable, or not RAPID.
    """
    named = (paths,) if isinstance(paths, str | PathLike) else tuple(paths)
    asked = RunRequest(
        paths=tuple(fspath(path) for path in named),
        robot=robot,
        station=None if station is None else fspath(station),
        task=task,
        home=None if home is None else fspath(home),
        assume_missing=assume_missing,
        strict=strict,
        texts=tuple((fspath(path), text) for path, text in (texts or {}).items()),
    )
    return Cell(asked)


class Cell:
    """A program with its station. Each call reads the files again, so edits take effect."""

    def __init__(self, request: RunRequest) -> None:
        """Find the files and the station; `load` makes one of paths.

        Raises:
            InputError: See `load`.
        """
        self._asked = request
        found = job(request)
        self._files = tuple(file.name for file in found.files)
        self._robot = found.robot.name if found.is_arm_named else None

    @property
    def files(self) -> tuple[str, ...]:
        """The files of all tasks, as they were found."""
        return self._files

    @property
    def robot(self) -> str:
        """The name of the arm, of the first where there are several."""
        if self._robot is None:
            self._robot = with_best_arm_of_files(job(self._asked)).robot.name
        return self._robot

    def check(
        self,
        *,
        select: Sequence[str] = (),
        ignore: Sequence[str] = (),
        run: bool = True,
    ) -> CheckResult:
        """Check the program for mistakes, as `rapidsim check` does.

        Args:
            select: Codes or beginnings of codes of the rules to check; none means those
                that are on by default.
            ignore: Codes of the rules to skip.
            run: Whether to run main, for its errors and for moves that only a run can check.

        Raises:
            InputError: If a file no longer exists, or a selector is not known.
        """
        asked = replace(self._asked, select=tuple(select), ignore=tuple(ignore), trial_run=run)
        return check_job(job(asked))

    def run(
        self,
        *,
        proc: str = "main",
        io: PathLike_ | Mapping[str, object] | None = None,
        answers: PathLike_ | Sequence[str] | Callable[[str], str | None] | None = None,
        home: PathLike_ | None = None,
        max_time_s: float = 3600.0,
        max_wall_s: float | None = None,
        cycles: int = 1,
        starts_at: datetime | None = None,
    ) -> Run:
        """Run the program, as `rapidsim run` does; write only the program's own files.

        Args:
            proc: The procedure to run.
            io: Signals and what happens to inputs; adds to the station. A file, or its tables as
                Python has them, such as `{"stimulus": [{"at": 2.0, "set": {"diStop": 1}}]}`.
            answers: What the operator answers: a file, the answers in order, or a function of the
                question. Without answers, a question gets its default, and a finding reports it.
            home: The folder for HOME:; None takes the one of `load`.
            max_time_s: Virtual time at which the run ends.
            max_wall_s: Wall-clock time [s] after which it is cut off.
            cycles: How many times the procedure runs.
            starts_at: The controller's clock at the start.

        Returns:
            The run. A program that stops with an error is a result, not an exception.

        Raises:
            InputError: If something that the run needs is missing.
            ProgramRejectedError: If checking finds an error.
        """
        from rapidsim.api.run import run_of
        from rapidsim.jobs.running.run_files import run_job

        asked = replace(
            self._with(max_time_s, max_wall_s, home),
            entry=proc,
            io=fspath(io) if isinstance(io, str | PathLike) else io,
            answers=None if answers is None else _answers(answers),
            max_cycles=cycles,
            starts_at=starts_at,
        )
        return run_of(run_job(job(asked), keeps_data=True))

    def call(
        self,
        routine: str,
        *arguments: object,
        home: PathLike_ | None = None,
        max_time_s: float = 3600.0,
        max_wall_s: float | None = None,
        **optional: object,
    ) -> Value | tuple[Value, ...] | None:
        """Call a FUNC or PROC, with all data as the program declares them and the robot at start.

        Args:
            routine: Its name; LOCAL routines can be called, too.
            *arguments: The required arguments: numbers, bool, str, the name of a signal, sequences
                for records and arrays.
            home: See `run`.
            max_time_s: See `run`.
            max_wall_s: See `run`.
            **optional: Optional arguments by name; True for a switch.

        Returns:
            The value of a FUNC, None for a PROC. Where parameters are INOUT, VAR or PERS, what they
            hold afterwards follows: a tuple, or the only value there is.

        Raises:
            InputError: If there is no such routine, or an argument does not fit.
            ProgramRejectedError: If the program has errors.
            CallError: If the routine stops with an error, or at a limit.
        """
        from rapidsim.jobs.running.routine_call import call_routine

        asked = self._with(max_time_s, max_wall_s, home)
        back = call_routine(job(asked), routine, arguments, optional)
        values = (back.result, *back.outputs) if back.is_function else back.outputs
        return values[0] if len(values) == 1 else values or None

    def _with(
        self, max_time_s: float, max_wall_s: float | None, home: PathLike_ | None
    ) -> RunRequest:
        return replace(
            self._asked,
            max_time_s=max_time_s,
            max_wall_s=max_wall_s,
            home=self._asked.home if home is None else fspath(home),
        )

    def __reduce__(self) -> tuple[Callable[[RunRequest], Cell], tuple[RunRequest]]:
        """The request; its receiver reads the files."""
        return Cell, (self._asked,)

    def __repr__(self) -> str:
        """One line."""
        name = Path(self._asked.paths[0]).name[:50]
        return f"<cell {name}, files: {len(self._files)}, robot: {self.robot[:30]}>"


def _answers(answers: PathLike_ | Sequence[str] | Callable[[str], str | None]) -> Answers:
    if callable(answers):
        return answers
    if isinstance(answers, str | PathLike):
        return answers_of_file(fspath(answers))
    return answers_in_order(answers)
