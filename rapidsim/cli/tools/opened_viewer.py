"""The viewer, left open on what a command has recorded."""

from __future__ import annotations

from pathlib import Path

from rapidsim.cli.terminal import echo
from rapidsim.cli.viewer import leave_open


def open_viewer(recording: Path) -> None:
    """Show a recording; that no window opened is a note, and no failure of the command."""
    reason = leave_open(recording)
    if reason is not None:
        echo(f"note: the viewer did not open: {reason}", err=True)
