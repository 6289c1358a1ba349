"""How often Python collects garbage: rarely where there is little, often where it would pile up."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager

_SELDOM = 70_000
"""The number of new objects after which the collector runs."""
_OFTEN = 700
"""The same for a process that stays on."""


@contextmanager
def gc_paused() -> Iterator[None]:
    """Keep the collector from walking through a growing tree again and again."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


@contextmanager
def gc_rarely() -> Iterator[None]:
    """Let the collector come a hundred times less often: what a run makes stays, but for little.

    What it makes in a loop and drops is found all the same.
    """
    with _collected_every(_SELDOM):
        yield


@contextmanager
def gc_for_server() -> Iterator[None]:
    """Look for garbage often in a process that stays on, and not among what is there already.

    Each connection leaves some behind that refers to itself. Python looks through all that is there
    once a quarter has been added, and so much of it would pile up.
    """
    gc.collect()
    gc.freeze()
    try:
        with _collected_every(_OFTEN):
            yield
    finally:
        gc.unfreeze()


@contextmanager
def _collected_every(objects: int) -> Iterator[None]:
    """Collect garbage after this many new objects, if Python collects it at all."""
    thresholds = gc.get_threshold()
    if thresholds[0]:
        gc.set_threshold(objects, *thresholds[1:])
    try:
        yield
    finally:
        gc.set_threshold(*thresholds)
