"""Limits beyond which a program is not translated to Python, and the error for exceeding them."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, cast

from rapidsim.diagnostics import Diagnostic, Span, Violation

MAX_LOOPS = 15
"""Nested loops; CPython allows 20 blocks, and error handling takes up to five."""
MAX_EXPRESSION = 200
"""Depth of an expression."""
MAX_BRANCHES = 1000
"""ELSEIF or CASE branches of one statement, which nest in Python."""
MAX_ARRAY_BYTES = 500_000_000
"""Memory [bytes] of all arrays that a program declares, once every element has its own value; and
of those of all routines that are active at one time.
"""
_POINTER_BYTES = 8
_DEPTH = re.compile(r"at the recursion depth (\d+)")
RUNNING_DEPTH = 10_000
"""Maximum depth of Python calls while a program runs; calls of RAPID routines use no C stack."""
TRANSLATING_DEPTH = 10_000
"""Maximum depth of Python calls during translation: the parser limits nesting, and each level
takes several calls. Not for `compile`, whose recursion does use the C stack.
"""


@contextmanager
def recursion_limit(limit: int) -> Iterator[None]:
    """Temporarily allow Python calls to nest this much deeper.

    The limit counts from the current depth, so that a program gets the same depth from any caller.
    The stack of a task begins anew, but the depth that Python counts does not: there the limit is
    not lowered, for what started the tasks has set it for all of them.
    """
    before, wanted = sys.getrecursionlimit(), _depth() + limit
    sys.setrecursionlimit(max(before, wanted) if _is_in_task() else wanted)
    try:
        yield
    finally:
        sys.setrecursionlimit(before)


def _is_in_task() -> bool:
    """Whether a task of several is running."""
    # Most runs have one task, and import nothing to switch between them.
    greenlet = sys.modules.get("greenlet")
    return greenlet is not None and greenlet.getcurrent().parent is not None


def _depth() -> int:
    """Depth of calls as Python counts it: not only of frames, which a program could count itself.

    Python has no function for it, but names it when it refuses a limit.
    """
    try:
        sys.setrecursionlimit(1)
    except RecursionError as refusal:
        if (found := _DEPTH.search(str(refusal))) is not None:
            return int(found[1])
        raise
    raise AssertionError("the depth of calls is at least one")


def array_bytes(array: list[Any]) -> int:
    """Return the memory [bytes] of an array, once every element has its own value."""
    count, value = 1, cast(object, array)
    while isinstance(value, list):
        count *= len(value)
        value = value[0] if value else None
    return count * element_bytes(value)


def element_bytes(value: object) -> int:
    """Return the memory [bytes] of an element of an array with a value of its own."""
    return _POINTER_BYTES + _value_bytes(value)


def _value_bytes(value: object) -> int:
    """Memory [bytes] of a value with its components."""
    components = value if isinstance(value, tuple) else ()
    return sys.getsizeof(value) + sum(map(_value_bytes, components))


class NotExecutable(Violation, code="E190"):
    subject: str


class NotExecutableError(Exception):
    """Raised by `load` instead of running a program incorrectly."""

    def __init__(self, subject: str, span: Span) -> None:
        """Build the message with the unsupported construct, as in the program, and its position."""
        self.diagnostic = Diagnostic(NotExecutable(subject), span)
        super().__init__(f"{span.file}:{span.line}: {self.diagnostic.violation.message}")
