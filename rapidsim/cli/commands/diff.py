"""`rapidsim diff`: what changed between two programs, as a robot programmer sees it."""

from __future__ import annotations

import json

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.numbers import POSITIVE
from rapidsim.cli.options.outputs import new_file
from rapidsim.cli.terminal import current_terminal, echo, print_json, terminal_options
from rapidsim.files import InputError
from rapidsim.jobs.run_request import RunRequest

_FORMATS = ("text", "json", "markdown", "html")


@click.command()
@click.argument("paths", metavar="[A B | --git REV [PATH]]", nargs=-1)
@click.option("--git", "revision", metavar="REV", help="Take A from this git revision of PATH.")
@click.option("--robot", metavar="NAME|FILE.urdf", help="The arm; `rapidsim robots` lists them.")
@click.option("--station", metavar="FILE.toml", help="The station file, instead of the nearest.")
@click.option("--task", metavar="NAME", help="Only this task, of several.")
@click.option("--proc", metavar="NAME", default="main", help="The procedure to run.")
@click.option("--io", metavar="FILE.toml", help="Signals and what happens to inputs, in both runs.")
@click.option("--answers", metavar="FILE", help="Answers to the programs' questions, one per line.")
@click.option("--no-run", is_flag=True, help="Compare texts and findings only; run nothing.")
@click.option(
    "--max-time",
    metavar="SECONDS",
    type=POSITIVE,
    default=3600.0,
    show_default=True,
    help="End a run after this much simulated time.",
)
@click.option(
    "--format",
    "output_format",
    type=click.Choice(_FORMATS),
    default="text",
    show_default=True,
    help="What is printed.",
)
@click.option("--output", metavar="FILE", help="Write to this file; required for html.")
@terminal_options
def diff(
    paths: tuple[str, ...],
    revision: str | None,
    robot: str | None,
    station: str | None,
    task: str | None,
    proc: str,
    io: str | None,
    answers: str | None,
    no_run: bool,
    max_time: float,
    output_format: str,
    output: str | None,
) -> int:
    """Show what changed from A to B: programs, folders, backups, configurations, saved runs.

    With --git, from revision REV of PATH, by default the working folder, to PATH as it is now.

    Targets, tools, work objects, speeds, zones, signals and routines; the time of each routine and
    line before and after; outputs that fire at another place or time; findings that are new or
    gone. Of backups and cells also signals, wiring, axes, frames, tasks and all other system
    parameters, and the station file; these may stand alone, as a folder SYSPAR, a .cfg or a .toml
    file. Layout, comments and order do not count as changes.

    Exit codes: 0 the same, 1 different, 2 wrong usage.
    """
    from rapidsim.comparison.compare import compare
    from rapidsim.comparison.page import comparison_page
    from rapidsim.comparison.rendering import as_json, as_markdown, as_text
    from rapidsim.comparison.revision import checked_out

    if len(paths) > 1 if revision is not None else len(paths) != 2:
        help = "rapidsim diff A B, or rapidsim diff --git REV [PATH]"
        what = "--git takes one PATH" if revision is not None else "two paths are compared"
        raise InputError(f"{what}, not {len(paths)}", help)
    if output_format == "html" and output is None:
        raise InputError("--format html needs a file", "name it with --output FILE.html")
    suffixes = {"text": (".txt",), "json": (".json",), "markdown": (".md",)}
    target = new_file(output, suffixes.get(output_format, (".html", ".htm"))) if output else None

    def asked(path: str, station: str | None = station) -> RunRequest:
        return RunRequest(
            paths=(path,),
            robot=robot,
            station=station,
            task=task,
            io=io,
            entry=proc,
            max_time_s=max_time,
        )

    if revision is None:
        found = compare(asked(paths[0]), asked(paths[1]), run=not no_run, answers=answers)
    else:
        path = paths[0] if paths else "."
        with checked_out(revision, path) as older:
            before = asked(older.path, station or older.station)
            try:
                found = compare(
                    before, asked(path), run=not no_run, answers=answers, visible=older.display_path
                )
            except InputError as error:
                message = older.in_words(error.message)
                raise InputError(message, error.help, error.similar) from None
    if output_format == "json":
        print_json(as_json(found))
    match output_format:
        case "json":
            text = json.dumps(as_json(found), indent=2, allow_nan=False) + "\n"
        case "markdown":
            text = as_markdown(found)
        case "html":
            text = comparison_page(found)
        case _:
            text = as_text(found)
    if target is not None:
        from rapidsim.output_files import whole_file

        with whole_file(target) as temporary:
            temporary.write_text(text, encoding="utf-8", newline="\n")
    elif output_format != "json" and not current_terminal().quiet:
        echo(text, nl=False)
    return ExitCode.CLEAN if found.is_same else ExitCode.FINDINGS
