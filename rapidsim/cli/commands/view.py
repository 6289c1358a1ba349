"""`rapidsim view`: open a recording."""

from __future__ import annotations

from pathlib import Path

import click

from rapidsim.cli.exit_codes import ExitCode
from rapidsim.cli.terminal import terminal_options
from rapidsim.cli.viewer import require_recording, require_screen, show
from rapidsim.extras import require


@click.command()
@click.argument("recording", metavar="FILE.rrd")
@terminal_options
def view(recording: str) -> int:
    """Open a recording in the rerun viewer and wait until the window is closed.

    The viewer is a separate program: `rerun FILE.rrd` does the same.
    """
    require("rerun", "the viewer")
    path = Path(recording)
    require_recording(path)
    require_screen()
    return ExitCode.CLEAN if show(path) == 0 else ExitCode.FINDINGS
