"""Compare two programs with their cells, or two saved runs."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import field, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TypeAlias

import numpy as np

from rapidsim.applications.diff.cell_configuration import (
    CellConfiguration,
    cell_configuration,
    is_configuration_file,
)
from rapidsim.applications.diff.changes import Comparison, FindingChange, RunChange, SourcePosition
from rapidsim.applications.diff.configuration_changes import configuration_changes
from rapidsim.applications.diff.program_changes import program_changes
from rapidsim.applications.diff.program_parts import ProgramParts, parts_of
from rapidsim.applications.diff.run_changes import ProgramRun, run_changes
from rapidsim.applications.diff.run_record import RunRecord, read_run_record
from rapidsim.cli.viewer import require_recording
from rapidsim.diagnostics import Diagnostic, Source
from rapidsim.extras import require
from rapidsim.files import InputError, decode, input_bytes
from rapidsim.jobs.checking.check_files import check_job
from rapidsim.jobs.inputs.answers import answers_of_file
from rapidsim.jobs.inputs.job import Job, job
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.running.run_files import ProgramRejectedError, run_job
from rapidsim.json_records.encoding import json_of
from rapidsim.module_files import TaskFiles, backup_among, has_modules, opened
from rapidsim.report.run.json_report import course_report
from rapidsim.simulation.results.simulation import RobotRun, Simulation
from rapidsim.station.tasks import DEFAULT_TASK
from rapidsim.syntax.parser import parse
from rapidsim.values import value_class

_PATH_STEP_S = 0.024
_MOST_POINTS = 4000


@value_class(frozen=True, slots=True)
class _Side:
    """One side of a comparison."""

    name: str
    parts: Mapping[str, ProgramParts]
    """Parts by task; empty for a saved run."""
    findings: tuple[Diagnostic, ...] = ()
    run: ProgramRun | None = None
    path: tuple[tuple[float, ...], ...] = ()
    no_run_reason: str | None = None
    configuration: CellConfiguration = field(default_factory=CellConfiguration)


Shown: TypeAlias = Callable[[str], str]
"""Returns the displayed name of a file."""


def compare(
    old: RunRequest,
    new: RunRequest,
    *,
    run: bool = True,
    answers: str | None = None,
    visible: Shown = str,
) -> Comparison:
    """Compare two programs, configurations, runs or recordings.

    Args:
        old: Request for files, a folder, a backup, a configuration, the JSON of a run, or its
            recording.
        new: Request for the other side.
        run: Whether to run the programs.
        answers: File of the operator's answers in both runs.
        visible: Returns the displayed names of the files of `old`.

    Raises:
        InputError: If an input is missing, unreadable, or not RAPID.
    """
    recordings = [side.paths[0] for side in (old, new) if _is_recording(side.paths[0])]
    if len(recordings) == 1:
        raise InputError(f"{recordings[0]} can only be compared with another recording")
    if recordings:
        return _compared_recordings(Path(recordings[0]), Path(recordings[1]), visible)
    a, b = _side(old, run, answers, visible), _side(new, run, answers, str)
    if not run and bool(a.run) != bool(b.run):
        raise InputError("a saved run can only be compared with a run", "leave out --no-run")
    changes = [
        change
        for task in dict.fromkeys((*a.parts, *b.parts))
        if a.parts and b.parts
        for change in program_changes(
            a.parts.get(task, ProgramParts()), b.parts.get(task, ProgramParts())
        )
    ]
    ran: RunChange | None = run_changes(a.run, b.run) if a.run and b.run else None
    return Comparison(
        (a.name, b.name),
        tuple(changes),
        _finding_changes(a.findings, b.findings, visible) if a.parts and b.parts else (),
        ran,
        None if ran or not run else a.no_run_reason or b.no_run_reason,
        (a.path, b.path),
        configuration_changes(a.configuration, b.configuration),
        tuple(_not_compared(a, b)),
    )


def _is_recording(path: str) -> bool:
    return path.lower().endswith(".rrd")


def _compared_recordings(old: Path, new: Path, visible: Shown) -> Comparison:
    for file in (old, new):
        require_recording(file)
    require("rerun", "the comparison of recordings")
    from rapidsim.recording.equality import have_same_content

    names = (visible(str(old)), str(new))
    return Comparison(names, (), (), None, recordings_differ=not have_same_content(old, new))


def _not_compared(a: _Side, b: _Side) -> Iterator[str]:
    """Yield notes on parts that only one side has."""
    for one, other in ((a, b), (b, a)):
        if other.configuration.parameters and not one.configuration.parameters:
            yield f"configuration was not compared: {one.name} has none"
        if other.parts and not one.parts and one.run is None:
            yield f"program was not compared: {one.name} has none"


def _side(request: RunRequest, run: bool, answers: str | None, visible: Shown) -> _Side:
    path = request.paths[0]
    name = visible(path)
    if path.lower().endswith(".json"):
        return _Side(name, {}, run=ProgramRun(_saved(Path(path))))
    configuration = cell_configuration(request)
    if _has_no_program(path):
        if configuration.is_empty:
            # Raises an error about the missing file.
            job(request)
        return _Side(name, {}, configuration=configuration)
    found = job(request)
    parts = {task.name or DEFAULT_TASK: _parts(task, visible) for task in found.tasks}
    findings = check_job(replace(found, request=replace(request, trial_run=run))).diagnostics
    side = _Side(name, parts, findings, configuration=configuration)
    if not run:
        return side
    try:
        simulation = _ran(found, answers)
    except ProgramRejectedError as error:
        return replace(side, no_run_reason=f"{name} does not run: {error}")
    report = json_of(course_report(simulation, simulation.diagnostics))
    single = simulation.robots[0] if len(simulation.robots) == 1 else None
    position = None if single is None else _position(single)
    record = read_run_record(report, name)
    return replace(side, run=ProgramRun(record, position), path=_path(simulation))


def _has_no_program(path: str) -> bool:
    """Whether a path contains only a configuration."""
    if path == "-" or is_configuration_file(path):
        return path != "-"
    folder = opened(path)
    return folder.is_dir() and not has_modules(folder) and backup_among([path]) is None


def _ran(found_job: Job, answers: str | None) -> Simulation:
    """Run without side effects."""
    with TemporaryDirectory(prefix="rapidsim-") as home:
        given = answers_of_file(answers) if answers else None
        asked = replace(found_job.request, home=home, answers=given)
        return run_job(replace(found_job, request=asked)).simulation


def _parts(task: TaskFiles, visible: Shown) -> ProgramParts:
    trees = [parse(Source(visible(file.name), file.text)).file for file in task.files]
    return parts_of([module for one in trees for module in one.modules])


def _saved(file: Path) -> RunRecord:
    text, _ = decode(input_bytes(file))
    try:
        report = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(f"{file} is not JSON: {error}") from None
    return read_run_record(report, str(file))


def _position(run: RobotRun) -> Callable[[float], Sequence[float]]:
    def at(time_s: float) -> Sequence[float]:
        place = 1000.0 * run.sample(time_s).base_from_tcp.translation[0]
        return [float(x) for x in place]

    return at


def _path(simulation: Simulation) -> tuple[tuple[float, ...], ...]:
    only = simulation.robots[0]
    count = min(_MOST_POINTS, int(only.trajectory.duration / _PATH_STEP_S) + 2)
    times = np.linspace(0.0, only.trajectory.duration, count)
    places = 1000.0 * only.sample(times).base_from_tcp.translation
    return tuple(tuple(round(float(x), 2) for x in place) for place in places)


def _finding_changes(
    old: Sequence[Diagnostic], new: Sequence[Diagnostic], visible: Shown
) -> tuple[FindingChange, ...]:
    """Return new and removed findings, independent of their positions."""
    before, after = Counter(map(_key, old)), Counter(map(_key, new))
    changes = []
    for is_new, found, surplus in ((True, new, after - before), (False, old, before - after)):
        for one in found:
            if surplus[_key(one)] > 0:
                surplus[_key(one)] -= 1
                at = SourcePosition(visible(one.span.file), one.span.line) if one.span else None
                changes.append(
                    FindingChange(is_new, one.code, str(one.severity), one.message, one.routine, at)
                )
    return tuple(changes)


def _key(finding: Diagnostic) -> tuple[str, str]:
    # Without the routine: a finding reported once may be in another one after a reordering.
    return finding.code, finding.message.lower()
