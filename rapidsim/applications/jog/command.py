"""`rapidsim jog`: move an arm by hand on a page, and teach targets."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.declared import argument, option, options_of
from rapidsim.cli.terminal import current_terminal, echo, terminal_options
from rapidsim.extras import require
from rapidsim.files import InputError
from rapidsim.jobs.inputs.robot_choice import DEFAULT_ROBOT
from rapidsim.jobs.inputs.run_request import RunRequest
from rapidsim.values import value_class

if TYPE_CHECKING:
    from rapidsim.applications.jog.jog_cell import JogCell


@value_class(frozen=True, slots=True)
class JogOptions:
    """Options of an arm that is moved by hand."""

    paths: tuple[str, ...] = argument("[PATH]...", nargs=-1)
    robot: str | None = option(
        "--robot", metavar="NAME|FILE.urdf", help="The arm; `rapidsim robots` lists them."
    )
    station: str | None = option(
        "--station", metavar="FILE.toml", help="The station file, instead of the nearest."
    )
    task: str | None = option("--task", metavar="NAME", help="Only this task, of several.")
    port: int = option(
        "--port",
        metavar="N",
        type=click.IntRange(0, 65535),
        default=0,
        show_default=True,
        help="The port of the page on this computer; 0 picks a free one.",
    )


@click.command(short_help="Move an arm by hand on a page, and teach targets.")
@options_of(JogOptions)
@terminal_options
def jog(options: JogOptions) -> int:
    """Move an arm by hand on a page, and teach targets.

    PATH is as for `rapidsim run`: its station, tools and work objects are those of the page; no
    program is executed. Without PATH, the page has only the arm of --robot. The first line on
    stdout is the address of the page, which works on this computer only, until Ctrl-C.

    Exit codes: 0 ended on request, 1 the program has errors, 2 wrong usage or a port in use.
    """
    require("aiohttp", "rapidsim jog")
    from rapidsim.applications.jog.jog_page import jog_page, page_key
    from rapidsim.cli.tools.run_output import print_rejected_on_stderr
    from rapidsim.jobs.running.run_files import ProgramRejectedError
    from rapidsim.server.http.local_page import serve_page

    try:
        cell = _cell(options)
    except ProgramRejectedError as rejected:
        print_rejected_on_stderr(_request(options), rejected.diagnostics)
        return ExitCode.FINDINGS
    for remark in () if current_terminal().quiet else cell.remarks:
        echo(f"note: {remark}", err=True)
    serve_page(jog_page(cell), page_key(), options.port, echo)
    return ExitCode.CLEAN


def _cell(options: JogOptions) -> JogCell:
    """Return the arm of a program, or one alone.

    Raises:
        InputError: If an input is missing.
        ProgramRejectedError: If checking the program finds an error.
    """
    from rapidsim.applications.jog.jog_cell import bare_cell, cell_of
    from rapidsim.cli.options.robot_choice import open_robot

    if "-" in options.paths:
        raise InputError("jog reads no program from standard input", "name a file or a folder")
    if not options.paths:
        return bare_cell(open_robot(options.robot or DEFAULT_ROBOT))
    return cell_of(_request(options))


def _request(options: JogOptions) -> RunRequest:
    return RunRequest(
        paths=options.paths,
        robot=options.robot,
        station=options.station,
        task=options.task,
        may_be_empty=True,
        assume_missing=True,
    )
