"""A run: figures, moves, waits, events, signals, data, and the files that show it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from rapidsim.analysis.literals import Value
from rapidsim.analysis.program import DataSymbol
from rapidsim.analysis.types.operators import has_value
from rapidsim.api.moves import Moves
from rapidsim.api.views import (
    ArmMotion,
    Datum,
    Named,
    SignalHistory,
    data_by_name,
    signals_by_name,
)
from rapidsim.controller.journal.events import Event
from rapidsim.controller.moves.executed_move import ExecutedMove
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.export.events import write_events
from rapidsim.export.table import DEFAULT_DT
from rapidsim.export.trace import write_trace
from rapidsim.extras import require
from rapidsim.interpreter.linking.loader import Task
from rapidsim.interpreter.runtime.memory import module_data
from rapidsim.notebook import card, line_drawing
from rapidsim.report.html.write import write_report
from rapidsim.report.run.error_records import ErrorRecord, error_records
from rapidsim.report.run.figures import figures
from rapidsim.report.run.json_report import RunFiles, run_json
from rapidsim.report.run.records import WaitRecord, wait_records
from rapidsim.simulation.result_builder import FinishedRun
from rapidsim.simulation.results.simulation import End, RobotRun, Simulation
from rapidsim.simulation.results.time_shares import argument
from rapidsim.simulation.results.verdict import run_verdict

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Path_ = str | PathLike[str]
_SHOWN_MOVES = 5
_DRAWN_PLACES = 400


@dataclass(frozen=True, eq=False, repr=False)
class Run:
    """The result of a run; times in s, lengths in mm, angles in degrees."""

    simulation: Simulation
    """The whole result, in m and rad."""
    all_data: tuple[Datum, ...]
    """Every CONST, PERS and VAR of the modules, with the value that the run left."""

    @property
    def end(self) -> str:
        """End of the run: `ended`, `stopped`, `time_limit`, `cycle_limit` or `error`."""
        return self.simulation.end.value

    @property
    def ok(self) -> bool:
        """Whether the run succeeded: `rapidsim run` exits with 0."""
        return run_verdict(self.simulation).ok

    @property
    def time_s(self) -> float:
        """The cycle time [s]."""
        return self.simulation.time_s

    @property
    def motion_s(self) -> float:
        """Time in which a robot is moving [s]."""
        return self.simulation.motion_s

    @property
    def wait_s(self) -> float:
        """The rest of the time [s]."""
        return self.simulation.wait_s

    @property
    def path_mm(self) -> float:
        """The distance that the TCPs travel, with corners cut."""
        return 1000.0 * self.simulation.path_m

    @cached_property
    def moves(self) -> Moves:
        """The moves of all robots, robot after robot; `moves.columns` are arrays."""
        return Moves(self.simulation)

    @cached_property
    def waits(self) -> tuple[WaitRecord, ...]:
        """The waits, in order of time."""
        return wait_records(self.simulation)

    @property
    def events(self) -> tuple[Event, ...]:
        """Texts, outputs, interrupts, files and corners, in order of time."""
        return self.simulation.events

    @cached_property
    def errors(self) -> tuple[ErrorRecord, ...]:
        """The errors of the program and what became of them, in order of their first times."""
        return error_records(self.simulation)

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """The findings of the check, then the findings of the run."""
        return self.simulation.diagnostics

    @property
    def headline(self) -> str:
        """Headline of the summary: the end of the run, with its qualifications."""
        return run_verdict(self.simulation).headline

    @property
    def skipped(self) -> dict[str, int]:
        """Routines that no module declares, with how many of their calls were skipped."""
        return {one.name: one.count for one in self.simulation.skipped}

    @property
    def error(self) -> Diagnostic | None:
        """The error that ended the run, or None."""
        if self.simulation.end is not End.ERROR:
            return None
        errors = [one for one in self.diagnostics if one.severity is Severity.ERROR]
        return errors[-1] if errors else None

    @cached_property
    def data(self) -> Mapping[str, Value]:
        """The values that data have at the end, by name in any case.

        Numbers are float, records named tuples, arrays lists. Where several modules or tasks
        declare a name with different values, use `Module/name` or `Task/Module/name`.
        """
        return data_by_name(self.all_data)

    @cached_property
    def signals(self) -> Named[SignalHistory]:
        """Every signal that is declared or set, by name in any case."""
        return signals_by_name(self.simulation)

    @property
    def trajectory(self) -> ArmMotion:
        """The motion of the robot.

        Raises:
            InputError: If there are several; use `trajectory_of`.
        """
        return self.trajectory_of(self.simulation.only.task)

    def trajectory_of(self, task: str) -> ArmMotion:
        """The motion of the robot of a task.

        Raises:
            InputError: If the task moves none.
        """
        found = self.simulation.robot_of(task)
        offset = self.simulation.move_offsets[self.simulation.robots.index(found)]
        return ArmMotion(found, offset)

    def as_json(self) -> dict[str, Any]:
        """The object that `rapidsim run --format json` prints."""
        run = self.simulation
        return run_json(run, figures(run), run.diagnostics, RunFiles())

    def record(self, path: Path_, *, dt: float | None = None) -> Path:
        """Write a recording for the rerun viewer; needs the extra `view`.

        Args:
            path: Ends in `.rrd`.
            dt: Time between samples [s]; None leaves it to the length of the run.

        Raises:
            InputError: If it cannot be written, or rerun is not installed.
        """
        require("rerun", "a recording")
        from rapidsim.recording.layout.write import record  # noqa: PLC0415 - Not everybody has it.

        return record(self.simulation, fspath(path), dt=dt)

    def report(self, path: Path_) -> Path:
        """Write a report: one HTML file to mail.

        Raises:
            InputError: If it cannot be written.
        """
        return write_report(self.simulation, self.diagnostics, fspath(path))

    def trace(self, path: Path_, *, dt: float = DEFAULT_DT) -> Path:
        """Write joints and TCP as a table; the suffix decides how, as with `--trace`.

        Raises:
            InputError: If it cannot be written, or in a form that is not known.
        """
        return write_trace(self.simulation, fspath(path), dt)

    def write_events(self, path: Path_) -> Path:
        """Write the events, a JSON object a line.

        Raises:
            InputError: If they cannot be written.
        """
        return write_events(self.simulation, fspath(path))

    def plot(self, picture: str = "path", *, task: str | None = None, dark: bool = False) -> Figure:
        """Draw a picture of the motion as a matplotlib figure; needs the extra `plots`.

        Args:
            picture: `path`, `arm`, `joints`, `speed`, `orientation`, `lines`, `movej-movel`,
                `frames` or `clearance`, as the files of `--plots`.
            task: The task whose robot moves; None where only one does.
            dark: Whether it is for a dark page.

        Raises:
            InputError: If there is no such picture, nothing moves, or matplotlib is missing.
        """
        require("matplotlib", "a picture")
        from rapidsim.plots.write import draw  # noqa: PLC0415 - Not everybody has matplotlib.

        found = self.simulation.only if task is None else self.simulation.robot_of(task)
        return draw(self.simulation, found, picture, dark=dark)

    def _repr_html_(self) -> str:
        """Card for notebooks: how it ended, its figures, path from above, the longest moves."""
        moves = self.simulation.moves
        # Records of all moves take much longer than their columns.
        lasts_s = moves.columns.end_s - moves.columns.start_s
        longest = np.argsort(-lasts_s, kind="stable")[:_SHOWN_MOVES].tolist()
        rows = [(f"{lasts_s[at]:.3f} s", *_instruction_and_place(moves[at])) for at in longest]
        figures = {
            "time": f"{self.time_s:.3f} s",
            "in motion": f"{self.motion_s:.3f} s",
            "waiting": f"{self.wait_s:.3f} s",
            "path": f"{self.path_mm:.1f} mm",
            "moves": str(len(self.moves)),
            **({"ended by": self.error.message} if self.error is not None else {}),
        }
        return card(
            self.headline,
            figures,
            heads=("longest moves", "", ""),
            rows=rows,
            drawing="".join(map(_path_from_above, self.simulation.robots)),
        )

    def __repr__(self) -> str:
        """One line."""
        name = self.simulation.title[:50] or "?"
        return f"<run of {name}: {self.end} after {self.time_s:.3f} s, {len(self.moves)} moves>"


def _instruction_and_place(move: ExecutedMove) -> tuple[str, str]:
    target, span = argument(move.place, "topoint", "tojointpos"), move.place.span
    return f"{move.move.instruction} {target}", f"{span.file}:{span.line}"


def _path_from_above(robot_run: RobotRun) -> str:
    """SVG element of the TCP's path in the x-y plane of the base, x to the right."""
    if not robot_run.moves:
        return ""
    times = np.linspace(0.0, robot_run.trajectory.duration, _DRAWN_PLACES)
    places = robot_run.trajectory.at(times).base_from_tcp.translation[:, :2]
    points = [(float(x), float(y)) for x, y in places]
    return line_drawing(points, f"{robot_run.task}: path of the TCP from above")


def run_of(finished: FinishedRun) -> Run:
    """A run with the values that its programs have left."""
    data = [one for name, task in finished.tasks.items() for one in _data(name, task)]
    return Run(finished.simulation, tuple(data))


def _data(name: str, task: Task) -> list[Datum]:
    return [
        Datum(
            name,
            _module(symbol),
            symbol.name,
            symbol.type.name,
            symbol.storage.value,
            task.value(symbol.name, _module(symbol)),
        )
        for symbol in module_data(task.program)
        if has_value(symbol.type)
    ]


def _module(symbol: DataSymbol) -> str:
    assert symbol.module is not None
    return symbol.module.name.text
