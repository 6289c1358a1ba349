"""The files that `rapidsim run` writes."""

from __future__ import annotations

import functools
import os
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

from rapidsim.cli.open_command import open_command
from rapidsim.cli.options.declared import option, options_of
from rapidsim.cli.options.new_files import new_file, new_plots, new_trace
from rapidsim.cli.options.numbers import POSITIVE
from rapidsim.cli.viewer import require_screen
from rapidsim.extras import is_installed, require
from rapidsim.files import InputError, SourceFile
from rapidsim.report.run.summary import OutputFile
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.values import value_class

TRACE_STEP_S = 0.012
VALUES = "values of persistents"
"""Values written into files of the program."""


@value_class(frozen=True, slots=True)
class OutputFileOptions:
    """Options of the files to write, as typed."""

    record: str | None = option(
        "--record", metavar="FILE.rrd", help="Where to write the recording; default <program>.rrd."
    )
    no_record: bool = option("--no-record", is_flag=True, help="Write no recording.")
    record_dt: float | None = option(
        "--record-dt",
        metavar="SECONDS",
        type=POSITIVE,
        help="Time step of the recording; default 0.012, or more if it would exceed 100 MB.",
    )
    view: bool = option("--view", is_flag=True, help="Open the recording when it is written.")
    report: str | None = option(
        "--report", metavar="FILE.html", help="Write a report: one file that needs no network."
    )
    plots: str | None = option(
        "--plots", metavar="DIR", help="Write pictures of path, joints, speed and times."
    )
    trace: str | None = option(
        "--trace", metavar="FILE", help="Write joints and TCP: .csv .parquet .json .ros.json"
    )
    dt: float = option(
        "--dt",
        metavar="SECONDS",
        type=POSITIVE,
        default=TRACE_STEP_S,
        show_default=True,
        help="Time step of the trace.",
    )
    events: str | None = option(
        "--events", metavar="FILE.jsonl", help="Write events, one JSON object per line."
    )


output_options = options_of(OutputFileOptions, "files")
"""Adds the options of output files to a command, which receives them as `files`."""


@value_class(frozen=True, slots=True)
class Outputs:
    """Files to write; None is not written."""

    recording: Path | None
    recording_step_s: float | None
    """None leaves it to the length of the run."""
    view: bool
    report: Path | None
    plots: Path | None
    trace: Path | None
    trace_step_s: float
    events: Path | None
    lacks_recorder: bool
    """Whether there is no recording because the package that writes it is not installed."""


def new_outputs(options: OutputFileOptions, program: str) -> Outputs:
    """The places to write to, for a program of some name.

    Raises:
        InputError: If something contradicts itself or cannot be written.
    """
    for name, given in (
        ("--record", options.record),
        ("--record-dt", options.record_dt),
        ("--view", options.view),
    ):
        if given and options.no_record:
            raise InputError(f"{name} and --no-record exclude each other")
        if given:
            require("rerun", name)
    if options.view:
        require_screen()
    recording = None if options.no_record else options.record or f"{program}.rrd"
    lacks_recorder = recording is not None and not is_installed("rerun")
    if lacks_recorder:
        recording = None
    return Outputs(
        recording=new_file(recording, (".rrd",)) if recording else None,
        recording_step_s=options.record_dt,
        view=options.view,
        report=new_file(options.report, (".html", ".htm")) if options.report else None,
        plots=new_plots(options.plots) if options.plots else None,
        trace=new_trace(options.trace) if options.trace else None,
        trace_step_s=options.dt,
        events=new_file(options.events, (".jsonl",)) if options.events else None,
        lacks_recorder=lacks_recorder,
    )


def write(
    simulation: Simulation, outputs: Outputs
) -> tuple[tuple[OutputFile, ...], InputError | None]:
    """Write the requested files; a failure of one does not prevent the others.

    Args:
        simulation: The run.
        outputs: What to write.

    Returns:
        The files written, and the first mistake that kept one from being written.
    """
    written: list[OutputFile] = []
    refused: InputError | None = None
    for what, path, writer in _writers(simulation, outputs):
        try:
            writer()
            shown_by = open_command(path) if path.suffix == ".rrd" else None
            written.append(OutputFile(path, what, shown_by))
        except InputError as error:
            refused = refused or error
    return tuple(written), refused


def _writers(
    simulation: Simulation, outputs: Outputs
) -> Iterator[tuple[str, Path, Callable[[], object]]]:
    """The requested files with their writers, whose imports (rerun) are slow."""
    if outputs.recording:
        # rerun would repeat our messages on stderr in other words.
        os.environ.setdefault("RUST_LOG", "off")
        from rapidsim.recording.layout.write import record

        step = outputs.recording_step_s
        yield (
            "recording",
            outputs.recording,
            functools.partial(record, simulation, outputs.recording, dt=step),
        )
    if outputs.report:
        from rapidsim.report.html.write import write_report

        writer = functools.partial(write_report, simulation, simulation.diagnostics, outputs.report)
        yield "report", outputs.report, writer
    if outputs.plots:
        from rapidsim.plots.write import write_plots

        yield "plots", outputs.plots, functools.partial(write_plots, simulation, outputs.plots)
    if outputs.trace:
        from rapidsim.export.trace import write_trace

        trace = functools.partial(write_trace, simulation, outputs.trace, outputs.trace_step_s)
        yield "trace", outputs.trace, trace
    if outputs.events:
        from rapidsim.export.events import write_events

        yield "events", outputs.events, functools.partial(write_events, simulation, outputs.events)


def write_values(simulation: Simulation, files: Iterable[SourceFile]) -> tuple[OutputFile, ...]:
    """Write what persistents hold into the program's files.

    Raises:
        InputError: If one of them cannot be written; then none is.
    """
    from rapidsim.export.persistents import write_persistents

    written = write_persistents(simulation.persistents, files)
    return tuple(OutputFile(path, VALUES) for path in written)
