"""`rapidsim frames`: the frame tree of a program, without running it."""

from __future__ import annotations

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.job_options import job_of
from rapidsim.cli.options.poses import scale_option
from rapidsim.cli.terminal import (
    current_terminal,
    echo,
    print_json,
    table_or_json,
    terminal_options,
)
from rapidsim.cli.tools.findings_text import findings_text
from rapidsim.jobs.checking.best_arm import with_best_arm
from rapidsim.jobs.checking.checked_program import load
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.json_records.declarations import OrAbsent, OutputRecord
from rapidsim.json_records.encoding import json_of
from rapidsim.language.data import IDENTITY_POSE
from rapidsim.motion.configurations.targets import pose
from rapidsim.report.findings.diagnostic_records import DiagnosticRecord, diagnostic_record
from rapidsim.report.findings.merging import merged
from rapidsim.report.findings.text import summary_line
from rapidsim.report.tables.frame_text import FrameRecord, frame_record, frame_text
from rapidsim.report.tables.frame_tree import frame_tree
from rapidsim.simulation.start_values import start_values
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class FramesReport(OutputRecord):
    """The object that `rapidsim frames --format json` prints."""

    root: FrameRecord | None
    """Null if the program has errors."""
    diagnostics: OrAbsent[tuple[DiagnosticRecord, ...]] = None
    """Errors of a program without a tree."""


@click.command()
@click.argument("paths", metavar="PATH...", nargs=-1, required=True)
@click.option("--robot", metavar="NAME|FILE.urdf", help="The arm; `rapidsim robots` lists them.")
@scale_option
@click.option("--station", metavar="FILE.toml", help="The station file, instead of the nearest.")
@click.option("--task", metavar="NAME", help="Only this task, of several.")
@table_or_json
@terminal_options
def frames(
    paths: tuple[str, ...],
    robot: str | None,
    scale: float | None,
    station: str | None,
    task: str | None,
    output_format: str,
) -> int:
    """Show the frames of a program: world, base, tools, work objects, targets.

    Positions are in mm in the frame above, angles in degrees about z, y and x as OrientZYX takes
    them. Values are those before the program runs.
    """
    terminal = current_terminal()
    job = job_of(RunRequest(paths=paths, robot=robot, scale=scale, station=station, task=task))
    task_files = job.only_task
    files = task_files.files
    loaded = load(files, cell=job.cell, unseen=task_files.unseen)
    if loaded.program is None:
        findings = merged(loaded.diagnostics)
        if output_format == "json":
            found = tuple(map(diagnostic_record, findings))
            print_json(json_of(FramesReport(None, found)))
        echo(findings_text(findings, terminal), palette=terminal.palette, nl=False, err=True)
        echo(summary_line(findings, files=len(files), seconds=None), err=True)
        return ExitCode.FINDINGS
    arm = with_best_arm(job, [loaded.program]).arm()
    place = job.station.world_from_base
    stands = IDENTITY_POSE if place is None else pose(place)
    root = frame_tree(loaded.program, start_values(loaded.program), arm.name, stands)
    if output_format == "json":
        print_json(json_of(FramesReport(frame_record(root))))
    else:
        terminal.show(frame_text(root))
    return ExitCode.CLEAN
