"""The rerun viewer, as a program of its own that shows a recording."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from rapidsim.files import InputError, unreadable

_MAGIC = b"RRF"
"""What a recording begins with."""


def require_screen() -> None:
    """Refuse to open a window where there is none.

    Raises:
        InputError: On a machine without a screen.
    """
    if sys.platform != "linux" or os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"):
        return
    raise InputError(
        "there is no screen here to open the viewer on",
        "copy the recording to a machine with one, or `rerun --serve-web FILE.rrd`",
    )


def require_recording(path: Path) -> None:
    """Refuse what the viewer would not show.

    Raises:
        InputError: If there is no recording at `path`.
    """
    if not path.is_file():
        raise InputError(f"there is no recording {path}")
    try:
        with path.open("rb") as file:
            begin = file.read(len(_MAGIC))
    except OSError as error:
        raise unreadable(path, error) from error
    if begin != _MAGIC:
        raise InputError(
            f"{path} is no recording", "`rapidsim run PROGRAM --record FILE.rrd` writes one"
        )


def show(path: Path) -> int:
    """Show a recording until the window is closed; returns the viewer's exit code."""
    return subprocess.run(_command(path), check=False).returncode


def leave_open(path: Path) -> None:
    """Show a recording in a window that outlives this command."""
    subprocess.Popen(
        _command(path),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )


def _command(path: Path) -> list[str]:
    # The module and not the script: it is there whatever PATH says. Without -P Python would look
    # for modules in the working directory first, which may be a checkout that nobody trusts.
    return [sys.executable, "-P", "-m", "rerun", str(path)]
