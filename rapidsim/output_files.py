"""Write a file whole or not at all: nobody ever finds half a file under its final name."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rapidsim.files import InputError


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Lend a temporary path in the same folder and move it into place when the block ends well.

    However the block ends otherwise, Ctrl-C included, the temporary file is removed and a file that
    stood there before is kept. The same folder, because a move between disks is a copy.

    Raises:
        InputError: When the folder does not exist or `path` is a folder.
    """
    if not path.parent.is_dir():
        raise InputError(f"cannot write `{path}`: the folder `{path.parent}` does not exist")
    if path.is_dir():
        raise InputError(f"cannot write `{path}`: it is a folder")
    # The process number keeps two runs that write the same file from mixing their halves.
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        yield temporary
        temporary.replace(path)
    finally:
        temporary.unlink(missing_ok=True)
