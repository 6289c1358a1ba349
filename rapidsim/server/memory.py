"""Memory of a process that stays on."""

from __future__ import annotations

import ctypes
import sys
from typing import Final

_MMAP_THRESHOLD: Final = -3
"""`M_MMAP_THRESHOLD` of glibc."""
_LARGE_BYTES: Final = 128 * 1024
"""Where glibc begins."""


def give_large_blocks_back() -> bool:
    """Let the C library give large blocks back to the system as soon as they are free.

    glibc does so only until the first one is freed; from then on it takes blocks of that size from
    its heap, in which files of all sizes that come and go leave holes.

    Returns:
        Whether this C library knows of it; others have no such habit.
    """
    if sys.platform != "linux":
        return False
    try:
        return bool(ctypes.CDLL(None).mallopt(_MMAP_THRESHOLD, _LARGE_BYTES))
    except (OSError, AttributeError):
        return False
