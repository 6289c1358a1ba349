"""Loops compiled by numba, where it is installed; the same lines of code, the same results.

Nothing here is needed for a result. numba is imported when the first batch comes that is long
enough to be worth it, never by what only checks a program. RAPIDSIM_NUMBA=0 switches it off.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import cache
from importlib import import_module
from importlib.util import find_spec
from types import FunctionType, ModuleType
from typing import Any

WORTH_COMPILING = 20_000
"""Rows of a batch from which on loading compiled code, half a second, is worth while."""
_SWITCH = "RAPIDSIM_NUMBA"

_loaded = False


def compiled(module: ModuleType, name: str, rows: int) -> Callable[..., Any] | None:
    """A function of a module, compiled; None where numba is not to be used for so many rows.

    Args:
        module: Where the function stands; its `COMPILED` lists all it needs, in order.
        name: Of the function.
        rows: How many it is asked for now.
    """
    global _loaded
    if os.environ.get(_SWITCH) == "0" or (rows < WORTH_COMPILING and not _loaded):
        return None
    if find_spec("numba") is None:
        return None
    _loaded = True
    return _functions(module)[name]


@cache
def _functions(module: ModuleType) -> dict[str, Callable[..., Any]]:
    """All functions of `module.COMPILED`, compiled; their calls of each other too."""
    numba = import_module("numba")

    functions: Sequence[FunctionType] = module.COMPILED
    space = dict(vars(module))
    for function in functions:
        # A copy whose globals hold what is compiled already: compiled code calls nothing else.
        own = FunctionType(function.__code__, space, function.__name__)
        try:
            space[function.__name__] = numba.njit(own, cache=True)
        except RuntimeError:
            # No folder that can be written to: then it is compiled anew in each run.
            space[function.__name__] = numba.njit(own)
    return {function.__name__: space[function.__name__] for function in functions}
