"""Write a file whole or not at all: nobody ever finds half a file under its final name."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rapidsim.files import InputError

_LITTLE_SPACE = 100_000_000
"""[bytes]"""


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Lend a temporary path in the same folder and move it into place when the block ends well.

    However the block ends otherwise, Ctrl-C included, the temporary file is removed and a file that
    stood there before is kept. The same folder, because a move between disks is a copy.

    Raises:
        InputError: When the folder does not exist or may not be written to, `path` is a folder, or
            what the block does fails for want of space, permission or the like.
    """
    if not path.parent.is_dir():
        raise InputError(f"cannot write `{path}`: the folder `{path.parent}` does not exist")
    if path.is_dir():
        raise InputError(f"cannot write `{path}`: it is a folder")
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise InputError(f"cannot write `{path}`: the folder `{path.parent}` may not be written to")
    # The process number keeps two runs that write the same file from mixing their halves.
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        yield temporary
        temporary.replace(path)
    except OSError as error:
        raise unwritten(path, error.strerror or str(error)) from error
    finally:
        temporary.unlink(missing_ok=True)


def unwritten(path: Path, reason: str) -> InputError:
    """The mistake that a file could not be written, with what to do about a full disk."""
    free = shutil.disk_usage(path.parent).free
    older = f"; the older `{path.name}` is as it was" if path.exists() else ""
    help = f"{free / 1e6:.1f} MB are free there" if free < _LITTLE_SPACE else None
    return InputError(f"cannot write `{path}`: {reason}{older}", help)
