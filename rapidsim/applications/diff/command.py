"""`rapidsim diff`: what changed between two programs, as a robot programmer sees it."""

from __future__ import annotations

import json

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.declared import argument, option, options_of
from rapidsim.cli.options.new_files import new_file
from rapidsim.cli.options.numbers import POSITIVE
from rapidsim.cli.terminal import current_terminal, echo, print_json, terminal_options
from rapidsim.files import InputError
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.values import value_class

_FORMATS = ("text", "json", "markdown", "html")


@value_class(frozen=True, slots=True)
class DiffOptions:
    """Options of a comparison."""

    paths: tuple[str, ...] = argument("[A B | --git REV [PATH]]", nargs=-1)
    revision: str | None = option(
        "--git", metavar="REV", help="Take A from this git revision of PATH."
    )
    robot: str | None = option(
        "--robot", metavar="NAME|FILE.urdf", help="The arm; `rapidsim robots` lists them."
    )
    station: str | None = option(
        "--station", metavar="FILE.toml", help="The station file, instead of the nearest."
    )
    task: str | None = option("--task", metavar="NAME", help="Only this task, of several.")
    proc: str = option("--proc", metavar="NAME", default="main", help="The procedure to run.")
    io: str | None = option(
        "--io", metavar="FILE.toml", help="Signals and stimuli of inputs, in both runs."
    )
    answers: str | None = option(
        "--answers", metavar="FILE", help="Answers to the programs' questions, one per line."
    )
    no_run: bool = option(
        "--no-run", is_flag=True, help="Compare texts and findings only; run nothing."
    )
    max_time: float = option(
        "--max-time",
        metavar="SECONDS",
        type=POSITIVE,
        default=3600.0,
        show_default=True,
        help="End a run after this much simulated time.",
    )
    output_format: str = option(
        "--format",
        type=click.Choice(_FORMATS),
        default="text",
        show_default=True,
        help="Output format.",
    )
    output: str | None = option(
        "--output", metavar="FILE", help="Write to this file; required for html."
    )


@click.command(short_help="Show what changed between two programs or runs.")
@options_of(DiffOptions)
@terminal_options
def diff(options: DiffOptions) -> int:
    """Show what changed from A to B: programs, folders, backups, configurations, saved runs.

    For two recordings, only whether their content is the same is reported.

    With --git, from revision REV of PATH, by default the working folder, to PATH as it is now.

    Compared are targets, tools, work objects, speeds, zones, signals and routines; the time of each
    routine and line; outputs that fire at another place or time; findings that are new or gone. For
    backups and cells also signals, wiring, axes, frames, tasks and all other system parameters, and
    the station file; these may be given alone, as a folder SYSPAR, a .cfg or a .toml file. Layout,
    comments and order do not count as changes.

    Exit codes: 0 the same, 1 different, 2 wrong usage.
    """
    from rapidsim.applications.diff.compare import compare
    from rapidsim.applications.diff.page import comparison_page
    from rapidsim.applications.diff.rendering import as_json, as_markdown, as_text
    from rapidsim.applications.diff.revision import checked_out

    if len(options.paths) > 1 if options.revision is not None else len(options.paths) != 2:
        help = "rapidsim diff A B, or rapidsim diff --git REV [PATH]"
        what = "--git takes one PATH" if options.revision is not None else "two paths are compared"
        raise InputError(f"{what}, not {len(options.paths)}", help)
    if options.output_format == "html" and options.output is None:
        raise InputError("--format html needs a file", "name it with --output FILE.html")
    suffixes = {"text": (".txt",), "json": (".json",), "markdown": (".md",)}
    target = (
        new_file(options.output, suffixes.get(options.output_format, (".html", ".htm")))
        if options.output
        else None
    )

    def request(path: str, station: str | None = options.station) -> RunRequest:
        return RunRequest(
            paths=(path,),
            robot=options.robot,
            station=station,
            task=options.task,
            io=options.io,
            entry=options.proc,
            max_time_s=options.max_time,
        )

    if options.revision is None:
        found = compare(
            request(options.paths[0]),
            request(options.paths[1]),
            run=not options.no_run,
            answers=options.answers,
        )
    else:
        path = options.paths[0] if options.paths else "."
        with checked_out(options.revision, path) as older:
            before = request(older.path, options.station or older.station)
            try:
                found = compare(
                    before,
                    request(path),
                    run=not options.no_run,
                    answers=options.answers,
                    visible=older.display_path,
                )
            except InputError as error:
                message = older.in_words(error.message)
                raise InputError(message, error.help, error.similar) from None
    if options.output_format == "json":
        print_json(as_json(found))
    match options.output_format:
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
    elif options.output_format != "json" and not current_terminal().quiet:
        echo(text, nl=False)
    return ExitCode.CLEAN if found.is_same else ExitCode.FINDINGS
