"""Whether two recordings have the same content: entities, instants and values.

Their bytes differ from run to run, as the viewer's library numbers pieces anew and orders them as
they come.
"""

from __future__ import annotations

import subprocess
from pathlib import Path

from rapidsim.files import InputError
from rapidsim.recording.page.viewer_files import viewer_program


def have_same_content(old: Path, new: Path) -> bool:
    """Compare two recordings, but for rounding and the order of their pieces.

    Raises:
        InputError: If one of them is damaged.
    """
    if _are_equal(old, new):
        return True
    for file in (old, new):
        if not _are_equal(file, file):
            raise InputError(f"{file} is a damaged recording")
    return False


def _are_equal(old: Path, new: Path) -> bool:
    command = [str(viewer_program()), "rrd", "compare", "--unordered", str(old), str(new)]
    done = subprocess.run(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        check=False,
    )
    return done.returncode == 0
