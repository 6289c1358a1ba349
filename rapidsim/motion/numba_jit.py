"""Loops compiled by numba if it is installed: identical code and results.

No result depends on it. numba is imported for the first batch that is long enough to justify it,
never by a mere check. RAPIDSIM_NUMBA=0 switches it off.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from hashlib import sha256
from importlib import import_module
from pathlib import Path
from threading import RLock
from types import FunctionType, ModuleType
from typing import Any, Final

from rapidsim.extras import is_installed

WORTH_COMPILING = 20_000
"""Number of rows of a batch from which on loading compiled code (half a second) pays."""
COMPILING: Final = RLock()
"""Held while numba is imported, compiles or loads: an exception that another thread raises in the
middle of it breaks numba for the rest of the process. Code that raises one acquires it first."""
_SWITCH = "RAPIDSIM_NUMBA"

_loaded = False


@contextmanager
def jit_reconsidered() -> Iterator[None]:
    """Reset the decision to compile, so that a run is identical to the last digit after any other.

    Compiled code rounds like NumPy, except for the last digit.
    """
    global _loaded
    _loaded = False
    try:
        yield
    finally:
        _loaded = False


def jit_function(module: ModuleType, name: str, rows: int) -> Callable[..., Any] | None:
    """Return a compiled function of a module; None if numba is not to be used for so few rows.

    Args:
        module: The module of the function; its `COMPILED` lists all it needs, in order, including
            functions of other modules.
        name: The function's name.
        rows: Number of rows of the current batch.
    """
    global _loaded
    if os.environ.get(_SWITCH) == "0" or (rows < WORTH_COMPILING and not _loaded):
        return None
    if not is_installed("numba"):
        return None
    _loaded = True
    with COMPILING:
        return _functions(module)[name]


@cache
def _functions(module: ModuleType) -> dict[str, Callable[..., Any]]:
    """Return all functions of `module.COMPILED`, compiled, with compiled calls of each other."""
    numba = import_module("numba")

    functions: Sequence[FunctionType] = module.COMPILED
    modules = [import_module(name) for name in dict.fromkeys(f.__module__ for f in functions)]
    space: dict[str, Any] = {}
    for one in modules:
        space.update(vars(one))
    # numba recompiles when the file of a function has changed, but ignores the files of its
    # callees; so the name under which it caches a function contains a digest of all of them.
    sources = b"".join(Path(one.__file__).read_bytes() for one in modules if one.__file__)
    digest = sha256(sources).hexdigest()[:16]
    for function in functions:
        # A copy with the compiled functions as globals: compiled code calls nothing else.
        own = FunctionType(function.__code__, space, function.__name__)
        own.__qualname__ = f"{function.__name__}_{digest}"
        try:
            dispatcher = numba.njit(own, cache=True, no_cfunc_wrapper=True)
        except RuntimeError:
            # No writable cache folder: compile in each run.
            dispatcher = numba.njit(own)
        # The first call with arguments of some types compiles, through this method.
        dispatcher.compile = _uninterrupted(dispatcher.compile)
        space[function.__name__] = dispatcher
    return {function.__name__: space[function.__name__] for function in functions}


def _uninterrupted(compile_for: Callable[..., Any]) -> Callable[..., Any]:
    """Wrap a function so that it holds `COMPILING`."""

    def held(*arguments: Any) -> Any:
        with COMPILING:
            return compile_for(*arguments)

    return held
