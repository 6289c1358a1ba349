"""`rapidsim check`: find the mistakes in a program without running it."""

from __future__ import annotations

import json
import time
from collections.abc import Sequence

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.inputs import all_tasks, choose_robot, choose_station, missing_neighbours
from rapidsim.cli.selectors import expect_rules
from rapidsim.cli.terminal import current_terminal, terminal_options
from rapidsim.diagnostics import Severity
from rapidsim.report.diagnostics import concise, diagnostic_json, full, summary_line
from rapidsim.report.merging import Finding, merged, selected
from rapidsim.simulation.check_files import CheckResult, check_tasks

_SEVERITIES = tuple(Severity)


@click.command(no_args_is_help=False)
@click.argument("paths", metavar="PATH...", nargs=-1, required=True)
@click.option("--robot", metavar="NAME|FILE.urdf", help="The arm the program is for.")
@click.option("--station", metavar="FILE.toml", help="The station file, instead of a near one.")
@click.option(
    "--output-format",
    type=click.Choice(["full", "concise", "json"]),
    default="full",
    show_default=True,
    help="Source frames, one line a finding, or one JSON object.",
)
@click.option("--select", metavar="CODES", help="Only these rules: `K6,N201,syntax-error`.")
@click.option("--ignore", metavar="CODES", help="Not these rules.")
@click.option("--no-merge", is_flag=True, help="Show each of the findings that repeat.")
@click.option(
    "--fail-on",
    type=click.Choice([severity.value for severity in Severity]),
    default="warning",
    show_default=True,
    help="The least severity that makes the exit code 1.",
)
@terminal_options
def check(
    paths: tuple[str, ...],
    robot: str | None,
    station: str | None,
    output_format: str,
    select: str | None,
    ignore: str | None,
    no_merge: bool,
    fail_on: str,
) -> int:
    """Find the mistakes in RAPID modules: syntax, names, types, flow.

    PATH is a module (.mod .modx .sys .sysx .prg), a .pgf program file, a folder, a controller
    backup, or - for standard input. What is named together is checked together, as one task.
    """
    started = time.perf_counter()
    terminal = current_terminal()
    cell = choose_station(paths, station)
    if robot is not None or cell.robot is not None:
        _expect_robot(choose_robot(robot, cell).name)
    wanted, unwanted = _codes(select), (*_codes(ignore), *expect_rules(cell.ignore))
    result = check_tasks(all_tasks(paths, cell))
    kept = selected(result.diagnostics, wanted, unwanted)
    findings = merged(kept, merge=not no_merge)
    match output_format:
        case "json":
            click.echo(json.dumps(_report(findings, result), indent=2, allow_nan=False))
        case "full":
            click.echo(full(findings, terminal.palette, width=terminal.width), nl=False)
        case _:
            click.echo(concise(findings, terminal.palette), nl=False)
    if output_format != "json" and not terminal.quiet:
        seconds = time.perf_counter() - started
        click.echo(summary_line(findings, files=len(result.files), seconds=seconds))
        if hint := missing_neighbours(paths, kept):
            click.echo(hint)
        if moves := len(result.unchecked_moves):
            what = "1 move was" if moves == 1 else f"{moves} moves were"
            click.echo(f"{what} not checked for reach and limits; `rapidsim run` does that.")
    failing = _SEVERITIES[: _SEVERITIES.index(Severity(fail_on)) + 1]
    failed = any(diagnostic.severity in failing for diagnostic in kept)
    return ExitCode.FINDINGS if failed else ExitCode.CLEAN


def _codes(option: str | None) -> tuple[str, ...]:
    codes = [code.strip() for code in (option or "").split(",")]
    return expect_rules([code for code in codes if code])


def _expect_robot(name: str) -> None:
    """Refuse a robot that is not known, though no rule looks at it yet."""
    from rapidsim.cli.robot_choice import open_robot

    open_robot(name)


def _report(findings: Sequence[Finding], result: CheckResult) -> dict[str, object]:
    unchecked = [{"file": move.file, "line": move.line} for move in result.unchecked_moves]
    return {
        "schema": 1,
        "files": len(result.files),
        "diagnostics": [diagnostic_json(finding) for finding in findings],
        "coverage": {
            "moves": len(unchecked),
            "checked": 0,
            "by_value": 0,
            "by_run": 0,
            "unchecked": unchecked,
        },
    }
