"""Write files atomically: no partial file ever exists under the final name."""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rapidsim.files import InputError

_LITTLE_SPACE = 100_000_000
"""Free space [bytes] below which the error message mentions it."""


@contextmanager
def whole_file(path: Path) -> Iterator[Path]:
    """Provide a temporary path in the same folder, and move it into place if the block succeeds.

    On any failure, including Ctrl-C, the temporary file is removed and an existing file is kept.
    The folder is the same, because a move between disks is a copy.

    Raises:
        InputError: If the folder does not exist or may not be written to, `path` is a folder, or
            the block fails because of space, permissions or the like.
    """
    if not path.parent.is_dir():
        raise InputError(f"cannot write `{path}`: the folder `{path.parent}` does not exist")
    if path.is_dir():
        raise InputError(f"cannot write `{path}`: it is a folder")
    if not os.access(path.parent, os.W_OK | os.X_OK):
        raise InputError(f"cannot write `{path}`: the folder `{path.parent}` may not be written to")
    # The process number prevents two runs that write the same file from mixing their output.
    temporary = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        yield temporary
        temporary.replace(path)
    except OSError as error:
        raise unwritten(path, error.strerror or str(error)) from error
    finally:
        temporary.unlink(missing_ok=True)


def unwritten(path: Path, reason: str) -> InputError:
    """Error for a file that could not be written, with a suggestion for a full disk."""
    free = shutil.disk_usage(path.parent).free
    older = f"; the older `{path.name}` is as it was" if path.exists() else ""
    help = f"{free / 1e6:.1f} MB are free there" if free < _LITTLE_SPACE else None
    return InputError(f"cannot write `{path}`: {reason}{older}", help)
