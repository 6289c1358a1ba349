"""Frequency of Python's garbage collection: rare for short runs, frequent for servers."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

_SELDOM = 70_000
"""Number of new objects after which the collector runs."""
_OFTEN = 700
"""Number of new objects after which the collector runs in a permanent process."""

_FEW = 200_000
"""Number of objects, some 90 MB, below which none of them is worth a search for garbage."""

_frozen = False
"""Whether objects are known to be frozen. Python counts them one by one, which takes longer than
checking a program where a million are frozen."""
_made, _kept = 0, 0
"""Number of objects made during pauses since the last collection, and of those that it kept."""


@contextmanager
def gc_paused(*, of_known_program: bool = False) -> Iterator[None]:
    """Pause the collector, which would traverse a growing tree repeatedly.

    What was created meanwhile counts as old afterwards, or the next new object would cause a
    traversal of all of it. Python does not count those towards its next full collection, so one
    takes place here, when a pause begins and the last program is no longer needed: in a process
    that runs many programs their number at most doubles. A process that has frozen objects keeps
    them so.

    Args:
        of_known_program: Whether the pause is for a program that has been read already: then its
            objects are needed, and there is no collection.
    """
    global _frozen, _made, _kept
    was_enabled = gc.isenabled()
    if was_enabled and not of_known_program and _made > max(_FEW, _kept):
        gc.collect()
        _made, _kept = 0, len(gc.get_objects())
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            _frozen = _frozen or gc.get_freeze_count() > 0
            if not _frozen:
                _made += gc.get_count()[0]
                gc.freeze()
                gc.unfreeze()
            gc.enable()


@contextmanager
def gc_rarely() -> Iterator[None]:
    """Run the collector a hundred times less often, because a run keeps most of its objects.

    Garbage that it creates in a loop is still found.
    """
    with _collected_every(_SELDOM):
        yield


@contextmanager
def gc_for_server() -> Iterator[None]:
    """Collect garbage frequently in a permanent process, but not among the existing objects.

    Each connection leaves some garbage with reference cycles. Python scans all old objects only
    after their number has grown by a quarter since the last time, and so much garbage would
    accumulate.
    """
    global _frozen
    gc.collect()
    gc.freeze()
    # Frozen objects count as old ones until the next collection.
    gc.collect()
    try:
        with _collected_every(_OFTEN):
            yield
    finally:
        gc.unfreeze()
        _frozen = False


@contextmanager
def _collected_every(objects: int) -> Iterator[None]:
    """Collect garbage after this many new objects, if collection is enabled."""
    thresholds = gc.get_threshold()
    if thresholds[0]:
        gc.set_threshold(objects, *thresholds[1:])
    try:
        yield
    finally:
        gc.set_threshold(*thresholds)
