"""Memory of a long-running process."""

from __future__ import annotations

import ctypes
import sys
from typing import Final

_MMAP_THRESHOLD: Final = -3
"""`M_MMAP_THRESHOLD` of glibc."""
_LARGE_BYTES: Final = 128 * 1024
"""Initial threshold of glibc."""


def give_large_blocks_back() -> bool:
    """Make the C library return large blocks to the system as soon as they are freed.

    glibc does so only until the first one is freed; then it allocates blocks of that size from its
    heap, which files of various sizes fragment.

    Returns:
        Whether the C library has this setting; others do not need it.
    """
    if sys.platform != "linux":
        return False
    try:
        return bool(ctypes.CDLL(None).mallopt(_MMAP_THRESHOLD, _LARGE_BYTES))
    except (OSError, AttributeError):
        return False
