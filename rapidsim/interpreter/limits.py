"""Limits beyond which a program is not translated to Python, and the error for exceeding them."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

from rapidsim.diagnostics import Diagnostic, Span, Violation

MAX_LOOPS = 15
"""Nested loops; CPython allows 20 blocks, and error handling takes up to five."""
MAX_EXPRESSION = 200
"""Depth of an expression."""
MAX_BRANCHES = 1000
"""ELSEIF or CASE branches of one statement, which nest in Python."""
MAX_ARRAY_BYTES = 500_000_000
"""Memory [bytes] of all arrays that a program declares, once every element has its own value."""
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
    """
    before = sys.getrecursionlimit()
    sys.setrecursionlimit(_calls_so_far() + limit)
    try:
        yield
    finally:
        sys.setrecursionlimit(before)


def _calls_so_far() -> int:
    frame: FrameType | None = sys._getframe()
    calls = 0
    while frame is not None:
        frame = frame.f_back
        calls += 1
    return calls


class NotExecutable(Violation, code="E190"):
    subject: str


class NotExecutableError(Exception):
    """Raised by `load` instead of running a program incorrectly."""

    def __init__(self, subject: str, span: Span) -> None:
        """Build the message with the unsupported construct, as in the program, and its position."""
        self.diagnostic = Diagnostic(NotExecutable(subject), span)
        super().__init__(f"{span.file}:{span.line}: {self.diagnostic.violation.message}")
