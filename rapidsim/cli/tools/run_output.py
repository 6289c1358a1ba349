"""Output of a run: a rejected program, findings, the summary or JSON, and verdicts."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from typing import TYPE_CHECKING, Any

from rapidsim.cli.options.outputs import VALUES
from rapidsim.cli.terminal import Terminal, current_terminal, echo, print_json
from rapidsim.cli.tools.findings_text import findings_text
from rapidsim.diagnostics import Diagnostic, Severity
from rapidsim.jobs.inputs.job import job
from rapidsim.jobs.inputs.robot_choice import RobotChoice
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.inputs.task_files import hints
from rapidsim.jobs.running.run_files import LoadedJob, loaded
from rapidsim.json_records.encoding import json_of
from rapidsim.report.findings.merging import errors_first, merged
from rapidsim.report.findings.source_frame import printable
from rapidsim.report.findings.text import summary_line
from rapidsim.report.run.course_text import course_lines
from rapidsim.report.run.figures import Figures
from rapidsim.report.run.json_report import RunFiles, rejected_report, run_json
from rapidsim.report.run.summary import ASCII_BARS, BLOCK_BARS, OutputFile, summary
from rapidsim.report.run.timings import RunTimings
from rapidsim.report.run.verdicts import Verdicts
from rapidsim.simulation.results.simulation import Simulation
from rapidsim.simulation.results.verdict import Verdict
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rich.console import RenderableType

    from rapidsim.cli.tools.profiler import RunProfile

FORMATS = ("table", "json", "none")


def print_rejected(
    loaded: LoadedJob, findings: Sequence[Diagnostic], output_format: str, terminal: Terminal
) -> None:
    """Say why a program does not run."""
    files = loaded.job.files
    if output_format == "json":
        names = [file.name for file in files]
        print_json(json_of(rejected_report(names, loaded.robot.name, findings)))
    elif output_format == "table":
        _print_findings(findings, terminal)
        if not terminal.quiet:
            echo(summary_line(merged(findings), files=len(files), seconds=None))
            for hint in hints(loaded.job.request.paths, findings):
                echo(hint)


def print_rejected_on_stderr(request: RunRequest, findings: Sequence[Diagnostic]) -> None:
    """Say why a program is not loaded; stdout is for who starts a server."""
    with redirect_stdout(sys.stderr):
        print_rejected(loaded(job(request)), findings, "table", current_terminal())


@value_class(frozen=True, slots=True)
class RunDone:
    """A run and what is known of it."""

    simulation: Simulation
    figures: Callable[[], Figures]
    """Computed at first use."""
    judgement: Verdicts
    profile: RunProfile | None
    timings: RunTimings | None = None

    @property
    def verdict(self) -> Verdict:
        """Verdict of the run, its assertions and budget included."""
        return self.judgement.verdict_of(self.simulation)


def print_run(
    done: RunDone,
    choice: RobotChoice,
    written: Sequence[OutputFile],
    output_format: str,
    terminal: Terminal,
) -> None:
    """Print the result, the written files, and the verdicts."""
    findings = done.simulation.diagnostics
    if output_format == "json":
        files = _json_files(written)
        figures, judgement = done.figures(), done.judgement
        print_json(run_json(done.simulation, figures, findings, files, judgement, done.timings))
    elif output_format == "table":
        _print_findings(findings, terminal)
        if not terminal.quiet:
            _print_summary(done, choice, written, terminal)
    _print_judgement(done.judgement, output_format, terminal)


def _json_files(written: Sequence[OutputFile]) -> RunFiles:
    program = tuple(str(one.path) for one in written if one.what == VALUES)
    files: dict[str, Any] = {one.what: str(one.path) for one in written if one.what != VALUES}
    return RunFiles(**files, program=program or None)


def _print_findings(findings: Sequence[Diagnostic], terminal: Terminal) -> None:
    if terminal.quiet:
        findings = [finding for finding in findings if finding.severity is Severity.ERROR]
    shown = errors_first(merged(findings))
    echo(findings_text(shown, terminal), palette=terminal.palette, nl=False)


def _print_judgement(judgement: Verdicts, output_format: str, terminal: Terminal) -> None:
    """Print the verdicts on assertions and budget; with JSON only failures."""
    is_table = output_format == "table"
    palette = terminal.palette
    for verdict in judgement.verdicts:
        if (is_table and not terminal.quiet) or not verdict.holds:
            colour = {True: palette.help, None: palette.warning, False: palette.error}
            text = palette.paint(printable(verdict.text), colour[verdict.holds])
            echo(text, palette=palette, err=not is_table)


def _print_summary(
    done: RunDone, choice: RobotChoice, written: Sequence[OutputFile], terminal: Terminal
) -> None:
    plain = not terminal.console().encoding.startswith("utf")
    terminal.show(
        summary(
            done.simulation,
            done.verdict,
            done.figures(),
            robot_reason=choice.reason,
            written=written,
            bars=ASCII_BARS if plain else BLOCK_BARS,
        )
    )
    if terminal.verbose:
        echo("")
        for line in course_lines(done.simulation):
            echo(line)
    if done.timings is not None:
        echo(done.timings.text)
    if done.profile:
        from rapidsim.cli.tools.profiler import costs_table

        terminal.show(costs_table(done.profile.routines))


@contextmanager
def stage(subject: str, terminal: Terminal, meter: RenderableType | None = None) -> Iterator[None]:
    """Show the current stage and its progress on a terminal; nothing elsewhere."""
    if terminal.quiet or not sys.stderr.isatty():
        yield
        return
    from rich.console import Console
    from rich.status import Status

    with Status(meter or f"{subject} ...", console=Console(stderr=True)):
        yield
