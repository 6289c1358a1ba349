"""`rapidsim check`: find the mistakes in a program without running it."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.asked import asked_job
from rapidsim.cli.options.poses import scale_option
from rapidsim.cli.terminal import current_terminal, say, terminal_options
from rapidsim.cli.tools.check_output import FORMATS, SPOKEN_FORMATS, checked_text
from rapidsim.cli.tools.fixes import cured, difference, harmless_fixes
from rapidsim.cli.tools.repeated import watch_option
from rapidsim.diagnostics import Severity
from rapidsim.export.text_edits import write_edits
from rapidsim.jobs.asked import Asked
from rapidsim.jobs.baseline import baseline_text, read_baseline
from rapidsim.jobs.check_files import CheckResult, check_job
from rapidsim.jobs.job import Job, read_again
from rapidsim.jobs.task_files import missing_neighbours
from rapidsim.output_files import whole_file
from rapidsim.report.findings.checked_moves import coverage_lines
from rapidsim.report.findings.merging import merged
from rapidsim.report.findings.statistics import statistics
from rapidsim.report.findings.text import summary_line
from rapidsim.values import dataclass

_SEVERITIES = tuple(Severity)


@click.command(no_args_is_help=False)
@watch_option
@click.argument("paths", metavar="PATH...", nargs=-1, required=True)
@click.option("--robot", metavar="NAME|FILE.urdf", help="The arm the program is for.")
@scale_option
@click.option("--station", metavar="FILE.toml", help="The station file, instead of the nearest.")
@click.option(
    "--output-format",
    type=click.Choice(FORMATS),
    default="full",
    show_default=True,
    help="Source excerpts, one line per finding, or a format for other tools.",
)
@click.option("--select", metavar="CODES", help="Only these rules: `K6,N201,syntax-error`.")
@click.option("--extend-select", metavar="CODES", help="These rules in addition, such as `S9`.")
@click.option("--ignore", metavar="CODES", help="Not these rules.")
@click.option("--fix", is_flag=True, help="Apply safe fixes, which do not change what a run does.")
@click.option("--unsafe-fixes", is_flag=True, help="With --fix or --diff: all other fixes too.")
@click.option("--diff", is_flag=True, help="Show what --fix would change, without changing it.")
@click.option(
    "--baseline",
    metavar="FILE",
    help="Known findings, not reported again; created if missing.",
)
@click.option("--update-baseline", is_flag=True, help="Write the current findings to the baseline.")
@click.option("--statistics", "counted", is_flag=True, help="Count findings by rule.")
@click.option(
    "--no-reach", is_flag=True, help="Do not check the moves: reach, limits, configuration, path."
)
@click.option(
    "--no-run",
    is_flag=True,
    help="Do not run main to find its errors and the moves that only a run can check.",
)
@click.option("--no-merge", is_flag=True, help="Show repeated findings one by one.")
@click.option(
    "--fail-on",
    type=click.Choice([severity.value for severity in Severity]),
    help="The lowest severity that sets exit code 1.  [default: warning]",
)
@terminal_options
def check(
    paths: tuple[str, ...],
    robot: str | None,
    scale: float | None,
    station: str | None,
    output_format: str,
    select: str | None,
    extend_select: str | None,
    ignore: str | None,
    fix: bool,
    unsafe_fixes: bool,
    diff: bool,
    baseline: str | None,
    update_baseline: bool,
    counted: bool,
    no_reach: bool,
    no_run: bool,
    no_merge: bool,
    fail_on: str | None,
) -> int:
    """Check RAPID modules for mistakes: syntax, names, types, flow, motion data, reach.

    PATH is a module (.mod .modx .sys .sysx .prg), a .pgf program file, a folder, a controller
    backup, a RobotStudio Pack&Go station (.rspag), or - for standard input. All PATHs together
    are checked as one task.

    A comment `! rapidsim: ignore[K601] reason` after a statement, or on the line
    before it, suppresses findings.
    """
    started = time.perf_counter()
    terminal = current_terminal()
    asked = Asked(
        paths=paths,
        robot=robot,
        scale=scale,
        station=station,
        select=_listed(select),
        extend_select=_listed(extend_select),
        ignore=_listed(ignore),
        reach=not no_reach,
        trial_run=not no_run,
    )
    job = asked_job(asked)
    settings = job.station.check
    known_file = Path(baseline) if baseline else settings.baseline
    if unsafe_fixes and not (fix or diff):
        raise click.UsageError("--unsafe-fixes goes with --fix or --diff")
    if update_baseline and known_file is None:
        raise click.UsageError("--update-baseline needs --baseline FILE")
    result = check_job(job)
    if diff:
        chosen = harmless_fixes(result.diagnostics, job.tasks, unsafe=unsafe_fixes)
        say(difference(chosen.edits, job.tasks), nl=False)
        return ExitCode.FINDINGS if chosen.edits else ExitCode.CLEAN
    mended = _mended(job, result, unsafe=unsafe_fixes) if fix else _Mended(result)
    result, made, outdated = mended.result, None, ""
    model = job.station.model.version
    if known_file is not None:
        # A setting alone writes nothing: the repository that holds it is not trusted.
        if update_baseline or (baseline is not None and not known_file.exists()):
            made = known_file
            _write_baseline(made, result, model)
        against = read_baseline(known_file)
        outdated = against.outdated(model, result.diagnostics)
        result = result.against(against.known)
    spoken = output_format in SPOKEN_FORMATS
    findings = merged(result.diagnostics, merge=not no_merge, spoken=spoken)
    if counted:
        say(statistics(result.diagnostics, terminal.palette), palette=terminal.palette, nl=False)
    else:
        text = checked_text(output_format, findings, result, terminal)
        say(text, palette=terminal.palette, nl=False)
    if output_format in SPOKEN_FORMATS and not terminal.quiet:
        seconds, files, known = time.perf_counter() - started, len(result.files), len(result.known)
        say(summary_line(findings, files=files, seconds=seconds, known=known))
        for line in _remarks(paths, result, mended):
            say(line)
        if made is not None:
            say(f"Written: {made} (baseline)")
        if outdated:
            say(outdated)
        if settings.cycle_budget_s is not None and (no_run or no_reach):
            say("The cycle budget was not checked, because main was not run.")
        for line in () if no_reach else coverage_lines(result.coverage, job.robot.text):
            say(line)
    least = Severity(fail_on) if fail_on else settings.fail_on or Severity.WARNING
    failing = _SEVERITIES[: _SEVERITIES.index(least) + 1]
    failed = any(diagnostic.severity in failing for diagnostic in result.diagnostics)
    return ExitCode.FINDINGS if failed else ExitCode.CLEAN


def _listed(option: str | None) -> tuple[str, ...]:
    return tuple(code.strip() for code in (option or "").split(",") if code.strip())


@dataclass(frozen=True, slots=True)
class _Mended:
    """What a check finds when the fixes it found are applied."""

    result: CheckResult
    fixed: int = 0
    left_out: int = 0
    """Fixes that would leave more errors."""


def _mended(job: Job, result: CheckResult, *, unsafe: bool) -> _Mended:
    """Write the fixes into the files and check again."""
    cure = cured(
        job.tasks,
        result.diagnostics,
        lambda new: check_job(replace(job, tasks=tuple(new))).diagnostics,
        unsafe=unsafe,
    )
    if cure.count:
        write_edits(cure.edits_of(job.tasks), job.files, what="fixes")
        result = check_job(read_again(job))
    return _Mended(result, cure.count, cure.left_out)


def _write_baseline(file: Path, found: CheckResult, motion_model: str) -> None:
    """Make all that was found known; what is not a baseline is not written over."""
    if file.exists():
        read_baseline(file)
    with whole_file(file) as temporary:
        temporary.write_text(baseline_text(found.diagnostics, motion_model), encoding="utf-8")


def _remarks(paths: Sequence[str], result: CheckResult, mended: _Mended) -> Iterator[str]:
    """What a person wants to know besides the findings, one line each."""
    found = mended.result.diagnostics
    if mended.fixed:
        yield f"Fixed {mended.fixed}."
    elif "-" not in paths and (curable := sum(bool(one.fix and one.fix.safe) for one in found)):
        yield f"`--fix` can fix {curable} of them."
    if mended.left_out:
        yield f"Fixes left out, because they would leave more errors: {mended.left_out}."
    if result.known:
        yield f"{len(result.known)} more are in the baseline."
    if hint := missing_neighbours(paths, found):
        yield hint
