"""The rerun viewer, a separate program that shows a recording."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from rapidsim.files import InputError, unreadable

_MAGIC = b"RRF"
"""First bytes of a recording."""
_SETTLED_AFTER_S = 1.0
"""By then a viewer that finds no screen has ended."""


def require_screen() -> None:
    """Raise an error if there is no screen for a window.

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
            f"{path} is not a recording", "`rapidsim run PROGRAM --record FILE.rrd` writes one"
        )


def show(path: Path) -> int:
    """Show a recording until the window is closed; returns the viewer's exit code."""
    return subprocess.run(_command(path), check=False).returncode


def leave_open(path: Path) -> str | None:
    """Show a recording in a window that outlives this command; returns why none opened."""
    # A file and no pipe: the viewer continues to write without a reader.
    with tempfile.TemporaryFile() as errors:
        viewer = subprocess.Popen(
            _command(path),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=errors,
            start_new_session=True,
        )
        try:
            # It ends at once where there is no window, and also where it hands the recording to
            # one that is open.
            code = viewer.wait(_SETTLED_AFTER_S)
        except subprocess.TimeoutExpired:
            return None
        if code:
            errors.seek(0)
            lines = errors.read().decode(errors="replace").strip().splitlines()
            return lines[-1].rpartition(": ")[2] if lines else f"exit code {code}"
        return None


def _command(path: Path) -> list[str]:
    # The module and not the script, which PATH may lack. Without -P, Python would search
    # the working directory for modules first, which may be an untrusted checkout.
    return [sys.executable, "-P", "-m", "rerun", str(path)]
