"""`rapidsim check`: find the mistakes in a program without running it."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.interrupted import limited_to
from rapidsim.cli.options.declared import argument, option, options_of, shared
from rapidsim.cli.options.job_options import (
    assume_missing_option,
    hulls_of_earlier_runs,
    job_of,
    no_cache_option,
    open_quietly,
    strict_option,
)
from rapidsim.cli.options.numbers import POSITIVE, PROCESSES
from rapidsim.cli.options.poses import scale_option
from rapidsim.cli.terminal import Terminal, current_terminal, echo, print_json, terminal_options
from rapidsim.cli.tools.check_output import FORMATS, SPOKEN_FORMATS, checked_text
from rapidsim.cli.tools.checked_jobs import checked_jobs
from rapidsim.cli.tools.differences import difference
from rapidsim.cli.tools.known_findings import (
    BaselineGroup,
    NewFindings,
    compare_with_baseline,
    group_by_settings,
)
from rapidsim.cli.tools.watch_mode import watch_option
from rapidsim.diagnostics import Severity
from rapidsim.export.edited_files import write_edits
from rapidsim.files import InputError
from rapidsim.jobs.checking.batch_check import merge_results
from rapidsim.jobs.checking.check_result import CheckResult
from rapidsim.jobs.inputs.job import Job, read_again
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.jobs.inputs.task_files import hints
from rapidsim.module_files import single_programs
from rapidsim.report.findings.checked_moves import coverage_lines
from rapidsim.report.findings.merging import Finding, errors_first, merged
from rapidsim.report.findings.statistics import rule_counts, statistics
from rapidsim.report.findings.text import summary_line
from rapidsim.values import value_class


@value_class(frozen=True, slots=True)
class CheckOptions:
    """Options of a check."""

    paths: tuple[str, ...] = argument("PATH...", nargs=-1, required=True)
    robot: str | None = option(
        "--robot", metavar="NAME|FILE.urdf", help="The arm the program is for."
    )
    scale: float | None = shared(scale_option)
    station: str | None = option(
        "--station", metavar="FILE.toml", help="The station file, instead of the nearest."
    )
    output_format: str = option(
        "--format",
        "--output-format",
        type=click.Choice(FORMATS),
        default="full",
        show_default=True,
        help="Source excerpts, one line per finding, or a format for other tools.",
    )
    sort: str | None = option(
        "--sort",
        type=click.Choice(["severity", "place"]),
        help="Order of the findings.  [default: severity in full and concise, else place]",
    )
    select: str | None = option(
        "--select", metavar="CODES", help="Only these rules: `K6,N201,syntax-error`."
    )
    extend_select: str | None = option(
        "--extend-select", metavar="CODES", help="These rules in addition, such as `S9`."
    )
    ignore: str | None = option("--ignore", metavar="CODES", help="Not these rules.")
    fix: bool = option(
        "--fix", is_flag=True, help="Apply safe fixes, which do not change what a run does."
    )
    unsafe_fixes: bool = option(
        "--unsafe-fixes", is_flag=True, help="With --fix or --diff: all other fixes too."
    )
    diff: bool = option(
        "--diff", is_flag=True, help="Show what --fix would change, without changing it."
    )
    baseline: str | None = option(
        "--baseline", metavar="FILE", help="Known findings, not reported again; created if missing."
    )
    update_baseline: bool = option(
        "--update-baseline", is_flag=True, help="Write the current findings to the baseline."
    )
    counted: bool = option("--statistics", is_flag=True, help="Count findings by rule.")
    no_reach: bool = option(
        "--no-reach",
        is_flag=True,
        help="Do not check the moves: reach, limits, configuration, path.",
    )
    no_run: bool = option(
        "--no-run",
        is_flag=True,
        help="Do not run main to find its errors and the moves that only a run can check.",
    )
    max_wall: float | None = option(
        "--max-wall",
        metavar="SECONDS",
        type=POSITIVE,
        help="End the check after this much real time; the run of main may take half of it.",
    )
    assume_missing: bool = shared(assume_missing_option)
    strict: bool = shared(strict_option)
    each: bool = option(
        "--each",
        is_flag=True,
        help="Check each PATH, and each controller of a .rspag, as a separate program.",
    )
    processes: int = option(
        "-j",
        type=PROCESSES,
        default=1,
        show_default=True,
        help="Number of parallel processes, for programs and tasks; auto is one for each core.",
    )
    no_cache: bool = shared(no_cache_option)
    no_merge: bool = option("--no-merge", is_flag=True, help="Show repeated findings one by one.")
    fail_on: str | None = option(
        "--fail-on",
        type=click.Choice([severity.value for severity in Severity]),
        help="The lowest severity that sets exit code 1.  [default: warning]",
    )


@click.command(no_args_is_help=False)
@watch_option
@options_of(CheckOptions)
@terminal_options
def check(options: CheckOptions) -> int:
    """Check RAPID modules for mistakes: syntax, names, types, flow, motion data, reach.

    PATH is a module (.mod .modx .sys .sysx .prg), a .pgf program file, a folder, a controller
    backup, a RobotStudio Pack&Go station (.rspag), or - for standard input. All PATHs together
    are checked as one task; with --each, each is a separate program.

    A comment `! rapidsim: ignore[K601] reason` after a statement, or on the line
    before it, suppresses findings.
    """
    started = time.perf_counter()
    terminal = current_terminal()
    programs = [options.paths]
    if options.each:
        programs = [(one,) for path in options.paths for one in single_programs(path)]
    jobs, unread = _jobs(programs, options)
    outcome = _outcome(programs, jobs, options)
    if options.diff and options.output_format != "json":
        echo(outcome.differences, nl=False)
        return ExitCode.FINDINGS if outcome.differences else ExitCode.CLEAN
    is_spoken = options.output_format in SPOKEN_FORMATS
    findings = merged(outcome.result.diagnostics, merge=not options.no_merge, spoken=is_spoken)
    if options.sort == "severity" or (is_spoken and options.sort is None):
        findings = errors_first(findings)
    _print_findings(findings, outcome, options, terminal)
    if is_spoken and not terminal.quiet:
        seconds = time.perf_counter() - started
        for line in _closing_lines(findings, outcome, options, seconds):
            echo(line)
    if unread:
        others = f", and {len(unread) - 1} more that cannot be read" if unread[1:] else ""
        raise InputError(f"{unread[0].message}{others}", unread[0].help)
    is_clean = not outcome.differences if options.diff else outcome.is_ok
    return ExitCode.CLEAN if is_clean else ExitCode.FINDINGS


def _request(options: CheckOptions) -> RunRequest:
    return RunRequest(
        paths=options.paths,
        robot=options.robot,
        scale=options.scale,
        station=options.station,
        select=_listed(options.select),
        extend_select=_listed(options.extend_select),
        ignore=_listed(options.ignore),
        hulls=hulls_of_earlier_runs(uses_cache=not options.no_cache),
        reach=not options.no_reach,
        trial_run=not options.no_run,
        max_wall_s=options.max_wall,
        assume_missing=options.assume_missing,
        strict=options.strict,
        fail_on=Severity(options.fail_on) if options.fail_on else None,
    )


def _jobs(
    programs: Sequence[tuple[str, ...]], options: CheckOptions
) -> tuple[list[Job], list[InputError]]:
    """The jobs of the programs, and why others cannot be read."""
    request = _request(options)
    jobs: list[Job] = []
    unread: list[InputError] = []
    for program in programs:
        try:
            jobs.append(job_of(replace(request, paths=program), open_robot=open_quietly))
        except InputError as error:
            # One encoded module among hundreds of programs is no reason to check none of them.
            if not options.each:
                raise
            unread.append(error)
    if unread and not jobs:
        raise unread[0]
    return jobs, unread


@value_class(frozen=True, slots=True)
class _FixedCheck:
    """The result of a check after its fixes were applied."""

    result: CheckResult
    fixed: int = 0
    left_out: int = 0
    """Fixes that would leave more errors."""


@value_class(frozen=True, slots=True)
class _Outcome:
    """The results of all programs."""

    programs: Sequence[tuple[str, ...]]
    jobs: Sequence[Job]
    arms: str
    """The arms that moves were checked with."""
    fixed: Sequence[_FixedCheck]
    judged: Sequence[NewFindings]
    """The results without known findings, by settings."""
    result: CheckResult
    """Those results as one."""
    differences: str
    """The text of `--diff`."""

    @property
    def is_ok(self) -> bool:
        """Whether nothing fails the check."""
        return all(group.result.ok for group in self.judged)


def _outcome(
    programs: Sequence[tuple[str, ...]], jobs: Sequence[Job], options: CheckOptions
) -> _Outcome:
    """Check the programs, apply fixes, and compare with the baselines."""
    baselines = [
        Path(options.baseline) if options.baseline else job.station.check.baseline for job in jobs
    ]
    if options.unsafe_fixes and not (options.fix or options.diff):
        raise click.UsageError("--unsafe-fixes goes with --fix or --diff")
    if options.update_baseline and None in baselines:
        raise click.UsageError("--update-baseline needs --baseline FILE")
    uses_cache = not (options.no_cache or options.fix or options.diff)
    differences = ""
    with limited_to(options.max_wall):
        results = checked_jobs(jobs, options.processes, uses_cache=uses_cache)
        if options.diff:
            differences = _differences(jobs, results, unsafe=options.unsafe_fixes)
        fixed = [_FixedCheck(result) for result in results]
        if options.fix:
            pairs = zip(jobs, results, strict=True)
            fixed = [_apply_fixes(*pair, unsafe=options.unsafe_fixes) for pair in pairs]
    groups = group_by_settings(jobs, [one.result for one in fixed], baselines)
    judged = _compared(groups, options)
    result = merge_results([group.result for group in judged])
    arms = _arms(jobs, results)
    return _Outcome(programs, jobs, arms, fixed, judged, result, differences)


def _arms(jobs: Sequence[Job], results: Sequence[CheckResult]) -> str:
    """Return the arms that moves were checked with, each once, and why the first was taken."""
    first = [result.arm or job.robot for job, result in zip(jobs, results, strict=True)]
    named = {arm.name for arm in first}
    further = (robot.name for job in jobs for robot in job.station.robots[1:])
    others = [name for name in further if name is not None and name not in named]
    return ", ".join(dict.fromkeys([*(arm.text for arm in first), *others]))


def _compared(groups: Sequence[BaselineGroup], options: CheckOptions) -> list[NewFindings]:
    """Return the results without the findings of their baselines."""
    if options.diff and options.output_format != "json":
        return [NewFindings(group.result) for group in groups]
    # A setting alone writes nothing: the repository that holds it is not trusted.
    creates, updates = options.baseline is not None, options.update_baseline
    return [compare_with_baseline(group, update=updates, create=creates) for group in groups]


def _print_findings(
    findings: Sequence[Finding], outcome: _Outcome, options: CheckOptions, terminal: Terminal
) -> None:
    result = outcome.result
    if options.output_format == "json":
        from rapidsim.json_records.encoding import json_of
        from rapidsim.report.findings.check_report import check_report

        report = check_report(
            findings,
            result,
            is_ok=outcome.is_ok,
            counts=rule_counts(result.diagnostics) if options.counted else None,
            differences=outcome.differences if options.diff else None,
        )
        print_json(json_of(report))
        return
    if options.counted:
        text = statistics(result.diagnostics, terminal.palette)
    else:
        text = checked_text(options.output_format, findings, result, terminal, is_ok=outcome.is_ok)
    echo(text, palette=terminal.palette, nl=False)


def _closing_lines(
    findings: Sequence[Finding], outcome: _Outcome, options: CheckOptions, seconds: float
) -> Iterator[str]:
    """The lines after the findings: counts, remarks, and what was not checked."""
    result = outcome.result
    yield summary_line(
        findings, files=len(result.files), seconds=seconds, baseline_count=len(result.known)
    )
    yield from _remarks(outcome.programs, result, outcome.fixed)
    for group in outcome.judged:
        yield from group.remarks
    has_budget = any(job.station.check.cycle_budget_s for job in outcome.jobs)
    if has_budget and (options.no_run or options.no_reach):
        yield "The cycle budget was not checked, because main was not run."
    if not options.no_reach:
        yield from coverage_lines(result.coverage, outcome.arms)
    if any(group.result.strict for group in outcome.judged) and result.qualifications:
        yield f"Fails, because the check is strict: {'; '.join(result.qualifications)}."


def _listed(option: str | None) -> tuple[str, ...]:
    return tuple(code.strip() for code in (option or "").split(",") if code.strip())


def _apply_fixes(job: Job, result: CheckResult, *, unsafe: bool) -> _FixedCheck:
    """Write the fixes into the files and check again."""
    from rapidsim.jobs.checking.check_files import check_job
    from rapidsim.jobs.checking.fixes import apply_fixes

    cure = apply_fixes(
        job.tasks,
        result.diagnostics,
        lambda new: check_job(replace(job, tasks=tuple(new))).diagnostics,
        unsafe=unsafe,
    )
    if cure.count:
        write_edits(cure.edits_of(job.tasks), job.files, subject="fixes")
        result = check_job(read_again(job))
    return _FixedCheck(result, cure.count, cure.skipped)


def _differences(jobs: Sequence[Job], results: Sequence[CheckResult], *, unsafe: bool) -> str:
    """The text of what fixes would change; empty if nothing."""
    from rapidsim.jobs.checking.fixes import harmless_fixes

    parts = []
    for job, result in zip(jobs, results, strict=True):
        chosen = harmless_fixes(result.diagnostics, job.tasks, unsafe=unsafe)
        files = [file for task in job.tasks for file in task.files]
        parts.append(difference(chosen.edits, files))
    return "".join(parts)


def _remarks(
    programs: Sequence[Sequence[str]], result: CheckResult, mended: Sequence[_FixedCheck]
) -> Iterator[str]:
    """Remarks after the findings, one line each."""
    found = [diagnostic for one in mended for diagnostic in one.result.diagnostics]
    if fixed := sum(one.fixed for one in mended):
        yield f"Fixed {fixed}."
    elif ("-",) not in programs and (
        curable := sum(bool(one.fix and one.fix.safe) for one in found)
    ):
        yield f"`--fix` can fix {curable} of them."
    if left_out := sum(one.left_out for one in mended):
        yield f"Fixes not applied, because they would cause more errors: {left_out}."
    if result.known:
        yield f"{len(result.known)} more are in the baseline."
    for paths, one in zip(programs, mended, strict=True):
        yield from hints(paths, one.result.diagnostics)
