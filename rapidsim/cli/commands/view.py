"""`rapidsim view`: open a recording, or make a page of it."""

from __future__ import annotations

from pathlib import Path

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.options.new_files import new_page
from rapidsim.cli.terminal import current_terminal, echo, terminal_options
from rapidsim.cli.viewer import require_recording, require_screen, show
from rapidsim.extras import require


@click.command()
@click.argument("recording", metavar="FILE.rrd")
@click.option(
    "--export",
    metavar="FOLDER",
    help="Write a page with viewer and recording to this folder; browsers need no server for it.",
)
@terminal_options
def view(recording: str, export: str | None) -> int:
    """Open a recording in the rerun viewer and wait until the window is closed.

    The viewer is a separate program: `rerun FILE.rrd` does the same.
    """
    require("rerun", "the viewer")
    path = Path(recording)
    require_recording(path)
    if export is not None:
        folder = new_page(export)
        from rapidsim.recording.page.write_page import write_page

        page = write_page(path, folder)
        if not current_terminal().quiet:
            echo(f"{page} shows it in any browser ({page.stat().st_size / 1e6:.1f} MB)")
        return ExitCode.CLEAN
    require_screen()
    return ExitCode.CLEAN if show(path) == 0 else ExitCode.FINDINGS
